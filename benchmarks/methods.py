"""The ways of computing one oscillator's motion that are compared."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec

import numpy as np
from scipy.integrate import solve_ivp

import gearpair as gp

State = tuple[float, float]


@dataclass(frozen=True)
class Method:
    """One way of marching over mesh periods.

    Attributes
    ----------
    name : str
    prepare : callable
        From an oscillator to a march: (x, v, number of periods) -> (x, v).
    periods : int
        Mesh periods in one timing, so that each takes some hundredths of a second.
    """

    name: str
    prepare: Callable[[gp.Oscillator], Callable[[float, float, int], State]]
    periods: int


def exact(osc: gp.Oscillator) -> Callable[[float, float, int], State]:
    """This library's exact flow."""
    return lambda x, v, n: tuple(map(float, gp.stroboscopic_map(osc, x, v, n)))


def compiled(rtol: float, atol: float) -> Callable[[gp.Oscillator], Callable[[float, float, int], State]]:
    """Dormand-Prince 5(4), compiled by numba."""
    return lambda osc: lambda x, v, n: tuple(gp.runge_kutta_section(osc, x, v, n, n_kept=1, rtol=rtol, atol=atol)[-1])


def scipys(name: str, rtol: float, atol: float) -> Callable[[gp.Oscillator], Callable[[float, float, int], State]]:
    """One of scipy's integrators with the right-hand side in plain Python, as one writes it."""

    def prepare(osc: gp.Oscillator) -> Callable[[float, float, int], State]:
        omega, zeta, force = osc.mesh_frequency, osc.damping_ratio, osc.mean_force
        amplitude, phase, period = osc.error_amplitude * omega**2, osc.error_phase, osc.period
        edges, levels = osc.stiffness.edges, osc.stiffness.levels

        def slope(tau: float, y: np.ndarray) -> State:
            x, v = y
            gap = x - 1.0 if x > 1.0 else x + 1.0 if x < -1.0 else 0.0
            fraction = tau / period % 1.0
            stiffness = levels[sum(edge <= fraction for edge in edges) - 1]
            return v, force + amplitude * np.sin(omega * tau + phase) - 2.0 * zeta * v - stiffness * gap

        def march(x: float, v: float, n: int) -> State:
            return tuple(solve_ivp(slope, (0.0, n * period), (x, v), name, rtol=rtol, atol=atol).y[:, -1])

        return march

    return prepare


def heyoka_taylor(osc: gp.Oscillator) -> Callable[[float, float, int], State]:
    """heyoka's Taylor integrator at machine precision: terminal events at X = +-1, restarts where k switches."""
    import heyoka as hy

    x, v = hy.make_vars("x", "v")
    stiffness, rest = hy.par[0], hy.par[1]
    amplitude = osc.error_amplitude * osc.mesh_frequency**2
    force = osc.mean_force + amplitude * hy.sin(osc.mesh_frequency * hy.time + osc.error_phase)
    level = [0.0]

    def enter(integrator, region: int) -> None:
        integrator.pars[0], integrator.pars[1] = level[0] * abs(region), region

    def crossing(boundary: int):
        def callback(integrator, direction: int) -> bool:
            enter(integrator, boundary if direction * boundary > 0 else 0)
            return True

        return hy.t_event(x - boundary, callback=callback, cooldown=1e-9)

    integrator = hy.taylor_adaptive(
        [(x, v), (v, force - 2.0 * osc.damping_ratio * v - stiffness * (x - rest))],
        [0.0, 0.0],
        pars=[0.0, 0.0],
        t_events=[crossing(1), crossing(-1)],
    )
    ends = [*osc.stiffness.edges[1:], 1.0]

    def march(x0: float, v0: float, n: int) -> State:
        integrator.state[:] = x0, v0
        for _ in range(n):
            integrator.time = 0.0
            for level[0], end in zip(osc.stiffness.levels, ends, strict=True):
                at = integrator.state[0]
                enter(integrator, 1 if at > 1.0 else -1 if at < -1.0 else 0)
                integrator.propagate_until(end * osc.period)
        return tuple(integrator.state)

    return march


def all_methods() -> list[Method]:
    """Ours first; heyoka where it is installed."""
    methods = [
        Method("gearpair, exact flow", exact, 50_000),
        Method("numba Dormand-Prince, 1e-6", compiled(1e-6, 1e-6), 1000),
        Method("numba Dormand-Prince, 1e-9", compiled(1e-9, 1e-9), 400),
        Method("scipy RK45, default tolerances", scipys("RK45", 1e-3, 1e-6), 20),
        Method("scipy RK45, 1e-6", scipys("RK45", 1e-6, 1e-6), 5),
    ]
    if find_spec("heyoka"):
        methods.append(Method("heyoka, Taylor and events", heyoka_taylor, 500))
    return methods
