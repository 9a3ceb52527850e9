"""The integrators that are compared: scipy's, a compiled Dormand-Prince, heyoka's Taylor method and the exact flow."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass

from scipy.integrate import solve_ivp

import gearpair as gp

try:
    import heyoka
except ImportError:
    heyoka = None

Run = Callable[[float, float, int], tuple[float, float]]

CHAOTIC = 1.219  # Omega_h of the comparison: a chaotic motion, so that no method profits from a short cycle
FREQUENCIES = (0.7, 0.95, CHAOTIC, 1.6)


@dataclass(frozen=True)
class Method:
    """An integrator of one oscillator.

    Parameters
    ----------
    name : str
        As the table shows it.
    oscillator : gearpair.Oscillator
    run : callable
        (X, X', n) at the start of a mesh period -> (X, X') after n mesh periods.
    n_periods : int
        Mesh periods of one timing: some tens of milliseconds' work.
    exact : bool
        Whether this is the exact flow, whose accuracy is promised.
    """

    name: str
    oscillator: gp.Oscillator
    run: Run
    n_periods: int
    exact: bool = False


def has_heyoka() -> bool:
    """Whether heyoka is installed."""
    return heyoka is not None


def all_methods() -> list[Method]:
    """Everything that can run here, the slowest first; the last four are the exact flow."""
    osc = gp.Oscillator(mesh_frequency=CHAOTIC)
    methods = [
        Method("scipy RK45, default tolerances", osc, scipy_rk45(osc, 1e-3, 1e-6), 40),
        Method("scipy RK45, 1e-6", osc, scipy_rk45(osc, 1e-6, 1e-6), 15),
        Method("compiled Dormand-Prince, 1e-6", osc, compiled_rk45(osc, 1e-6), 1000),
        Method("compiled Dormand-Prince, 1e-9", osc, compiled_rk45(osc, 1e-9), 500),
    ]
    if has_heyoka():
        methods.append(Method("heyoka, Taylor with terminal events", osc, heyoka_taylor(osc), 1000))
    for omega in FREQUENCIES:
        osc = gp.Oscillator(mesh_frequency=omega)
        methods.append(Method("gearpair, exact flow", osc, exact_flow(osc), 20_000, exact=True))
    return methods


def exact_flow(osc: gp.Oscillator) -> Run:
    """This library's own map."""

    def run(x: float, v: float, n: int) -> tuple[float, float]:
        x1, v1 = gp.stroboscopic_map(osc, x, v, n)
        return float(x1), float(v1)

    return run


def compiled_rk45(osc: gp.Oscillator, tolerance: float) -> Run:
    """This library's Dormand-Prince, step for step scipy's RK45."""

    def run(x: float, v: float, n: int) -> tuple[float, float]:
        x1, v1 = gp.methods.runge_kutta_section(osc, x, v, n, n_kept=1, rtol=tolerance, atol=tolerance)[0]
        return float(x1), float(v1)

    return run


def scipy_rk45(osc: gp.Oscillator, rtol: float, atol: float) -> Run:
    """scipy's RK45 over the whole span, with a right-hand side as lean as Python allows."""
    force, omega, phase = osc.mean_force, osc.mesh_frequency, osc.error_phase
    amplitude, damping = osc.error_amplitude * omega**2, 2.0 * osc.damping_ratio
    period, edges, levels = osc.period, osc.stiffness.edges, osc.stiffness.levels

    def slope(tau: float, y: list[float]) -> tuple[float, float]:
        x, v = y
        acceleration = force + amplitude * math.sin(omega * tau + phase) - damping * v
        if x > 1.0 or x < -1.0:
            level = levels[bisect_right(edges, tau / period % 1.0) - 1]
            acceleration -= level * (x - 1.0 if x > 1.0 else x + 1.0)
        return v, acceleration

    def run(x: float, v: float, n: int) -> tuple[float, float]:
        end = n * period
        x1, v1 = solve_ivp(slope, (0.0, end), (x, v), "RK45", (end,), rtol=rtol, atol=atol).y[:, -1]
        return float(x1), float(v1)

    return run


def heyoka_taylor(osc: gp.Oscillator) -> Run:
    """heyoka's Taylor method at its default tolerance, the machine epsilon.

    X = +-1 are terminal events that change the side of contact; the integration stops at the switches of the
    stiffness, which come at known times.
    """
    x, v = heyoka.make_vars("x", "v")
    stiffness, side = heyoka.par[0], heyoka.par[1]
    omega = osc.mesh_frequency
    force = osc.error_amplitude * omega**2 * heyoka.sin(omega * heyoka.time + osc.error_phase)
    acceleration = osc.mean_force + force - 2.0 * osc.damping_ratio * v - stiffness * (x - side)
    level = [0.0]

    def crossing(boundary: float) -> Callable[[heyoka.taylor_adaptive, int], bool]:
        def change_side(integrator: heyoka.taylor_adaptive, direction: int) -> bool:
            contact = direction * boundary > 0.0
            integrator.pars[0] = level[0] if contact else 0.0
            integrator.pars[1] = boundary if contact else 0.0
            return True  # go on

        return change_side

    integrator = heyoka.taylor_adaptive(
        [(x, v), (v, acceleration)],
        [0.0, 0.0],
        pars=[0.0, 0.0],
        t_events=[heyoka.t_event(x - b, callback=crossing(b)) for b in (1.0, -1.0)],
    )
    state, pars = integrator.state, integrator.pars
    cells = list(zip(osc.stiffness.levels, (*osc.stiffness.edges[1:], 1.0), strict=True))

    def run(x: float, v: float, n: int) -> tuple[float, float]:
        integrator.time = 0.0
        integrator.reset_cooldowns()
        state[:] = x, v
        pars[1] = 1.0 if x > 1.0 else -1.0 if x < -1.0 else 0.0
        for i in range(n):
            for level[0], end in cells:
                pars[0] = level[0] if pars[1] else 0.0
                integrator.propagate_until((i + end) * osc.period)
        return float(state[0]), float(state[1])

    return run
