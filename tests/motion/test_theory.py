"""Steady motions against exact theory: boundary problem, energy, harmonic balance, Meissner's equation."""

import numpy as np
import pytest
from scipy.optimize import fsolve

import gearpair as gp
from gearpair.design import find_jumps
from gearpair.design.charts import carried_runs
from gearpair.motion import impact_measures
from tests.support.oscillators import SINGLE


def impact_motion(osc):
    """The period-1 motion of constant stiffness 1 with one contact a period, as a boundary problem by hand.

    Unknowns: the phases of separation and of contact, and the velocity at separation. In flight from X = 1 the exact
    solution with damping must come back to X = 1; in contact it must end as it began. Nothing is the library's.
    """
    z, w, force = osc.damping_ratio, osc.mesh_frequency, osc.mean_force
    size = osc.error_amplitude * w**2

    def flown(t0, v0, t):
        """X, X' at t of free flight from (1, v0) at t0."""
        g = size / (w * (w * w + 4 * z * z))  # x_p = g (-w sin - 2 z cos)
        xp = lambda s: g * (-w * np.sin(w * s) - 2 * z * np.cos(w * s)) + force / (2 * z) * s  # noqa: E731
        vp = lambda s: g * w * (-w * np.cos(w * s) + 2 * z * np.sin(w * s)) + force / (2 * z)  # noqa: E731
        c = v0 - vp(t0)
        e = np.exp(-2 * z * (t - t0))
        return 1.0 - xp(t0) + xp(t) + c * (1 - e) / (2 * z), vp(t) + c * e

    def pressed(t0, v0, t):
        """X - 1, X' at t of contact from (0, v0) at t0."""
        amplitude = size / complex(1 - w * w, 2 * z * w)
        yp = lambda s: force + (amplitude * np.exp(1j * w * s)).imag  # noqa: E731
        up = lambda s: (1j * w * amplitude * np.exp(1j * w * s)).imag  # noqa: E731
        d = np.sqrt(1 - z * z)
        y, u = -yp(t0), v0 - up(t0)
        e, c, s = np.exp(-z * (t - t0)), np.cos(d * (t - t0)), np.sin(d * (t - t0)) / d
        return yp(t) + e * (y * (c + z * s) + u * s), up(t) + e * (u * (c - z * s) - y * s)

    def equations(unknowns):
        leave, touch, v = unknowns
        x, speed = flown(leave, v, touch)
        y, end = pressed(touch, speed, leave + 2 * np.pi / w)
        return x - 1.0, y, end - v

    return equations, flown


def test_a_single_sided_motion_solved_by_hand_as_a_boundary_problem():
    osc = gp.Oscillator(
        mean_force=0.15, error_amplitude=0.08, damping_ratio=0.05, mesh_frequency=0.95, stiffness=SINGLE
    )
    state = gp.steady_state(osc, 1.3, 0.0)
    assert str(state.impact_state) == "single_drive" and state.period == 1
    motion = gp.trajectory(osc, *map(float, state.points[0]), 2)
    left = next(i for i in range(len(motion.impacts)) if not motion.impacts.contact[i])
    near = motion.impacts.tau[left], motion.impacts.tau[left + 1], motion.impacts.velocity[left]
    equations, flown = impact_motion(osc)
    solved = fsolve(equations, np.array(near) + 1e-3, xtol=1e-13)
    assert np.abs(equations(solved)).max() < 1e-12
    assert solved == pytest.approx(near, abs=1e-11)
    speed = impact_measures(state).drive_velocity
    assert abs(flown(*solved[[0, 2]], solved[1])[1]) == pytest.approx(speed, abs=1e-11)


def test_energy_over_a_cycle_balances():
    """Constant stiffness: what the force does in a cycle is what damping takes, impacts or not."""
    osc = gp.Oscillator(
        mean_force=0.15, error_amplitude=0.08, damping_ratio=0.05, mesh_frequency=0.95, stiffness=SINGLE,
        harmonics=[(2, 0.02, 0.5)],
    )  # fmt: skip
    state = gp.steady_state(osc, 1.3, 0.0)
    motion = gp.trajectory(osc, *map(float, state.points[0]), state.period, samples_per_period=8192)
    step = motion.tau[1]
    work = np.trapezoid(osc.force(motion.tau) * motion.v, dx=step)
    lost = np.trapezoid(2 * osc.damping_ratio * motion.v**2, dx=step)
    assert lost > 1e-3
    assert work == pytest.approx(lost, rel=1e-6)


def harmonic_balance_folds(osc):
    """The folds (run up, run down) of the bent resonance of constant stiffness, by one-term harmonic balance.

    X = m + a cos(theta): the mean of f(X) is the mean force and gives m; its first harmonic over a is the stiffness
    k(a). Then ``a^2 ((k - w^2)^2 + (2 zeta w)^2) = e^2 w^4``: two frequencies for each a, beside the backbone.
    """
    theta = np.linspace(0.0, 2 * np.pi, 2001)[:-1]
    left, right = [], []
    for a in np.linspace(0.02, 1.5, 600):
        low, high = 1.0 - a - 1.0, 3.0
        for _ in range(45):  # bisection for m
            m = 0.5 * (low + high)
            pressed = np.clip(m + a * np.cos(theta) - 1.0, 0.0, None)
            low, high = (m, high) if pressed.mean() < osc.mean_force else (low, m)
        k = 2 * np.mean(pressed * np.cos(theta)) / a
        lead, half = 1.0 - (osc.error_amplitude / a) ** 2, k - 2 * osc.damping_ratio**2
        root = half**2 - k**2 * lead
        if root >= 0.0 and lead > 0.0:
            left.append(np.sqrt((half - np.sqrt(root)) / lead))
            right.append(np.sqrt((half + np.sqrt(root)) / lead))
    return max(left), min(right)


def test_the_softening_folds_lie_where_harmonic_balance_puts_them():
    """One harmonic gives both folds to within a per cent, and no better: its errors are shown and bounded both ways."""
    osc = gp.Oscillator(mean_force=0.16, error_amplitude=0.05, damping_ratio=0.06, stiffness=SINGLE)
    omegas = np.linspace(0.6, 1.1, 51)
    ups, downs = carried_runs([[osc.replace(mesh_frequency=float(w)) for w in omegas]], None)[0]
    exact = {jump.run: jump for jump in find_jumps(ups, downs)}
    assert {jump.kind for jump in exact.values()} == {"fold"}
    for run, estimate in zip(("up", "down"), harmonic_balance_folds(osc), strict=True):
        error = estimate / exact[run].mesh_frequency - 1.0
        print(f"fold run {run}: exact {exact[run].mesh_frequency:.5f}, harmonic balance {estimate:.5f}, {error:+.2%}")
        assert 1e-4 < abs(error) < 0.01


def test_the_tongue_of_the_linear_problem_is_where_contact_is_lost():
    """Stiffness 1 +- h in halves of the period: Meissner's equation, unstable where its trace exceeds 2.

    Without transmission error the motion in contact, disturbed a little, returns outside the tongue and parts inside.
    """
    h, zeta = 0.4, 0.02
    wave = gp.StiffnessWave((0.0, 0.5), (1.0 + h, 1.0 - h))
    omegas = np.linspace(1.7, 2.3, 25)
    parted, unstable = [], []
    for omega in omegas:
        half = np.pi / omega
        product = np.eye(2)
        for k in wave.levels:
            d = np.sqrt(k - zeta**2)
            c, s = np.cos(d * half), np.sin(d * half) / d
            product = np.exp(-zeta * half) * np.array([[c + zeta * s, s], [-k * s, c - zeta * s]]) @ product
        unstable.append(np.abs(np.linalg.eigvals(product)).max() > 1.0)
        osc = gp.Oscillator(
            mean_force=0.2, error_amplitude=0.0, damping_ratio=zeta, mesh_frequency=float(omega), stiffness=wave
        )
        x, v = gp.periodic_orbit(osc, 1.2, 0.0, 1).points[0]
        parted.append(gp.steady_state(osc, float(x) + 1e-3, float(v)).impact_state != "none_drive")
    assert any(unstable) and not all(unstable)
    assert parted == unstable
