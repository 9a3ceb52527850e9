"""The balance of energy: it closes, and its parts are those of closed forms and of another integration."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

import gearpair as gp
from gearpair.motion import energy, energy_balance
from tests.flow.test_invariants import OSCILLATORS, STARTS
from tests.support.oscillators import SINGLE

DOUBLE, ONE = 1.116, 0.586  # levels of the printed wave
PARTS = ("stiffness_work", "mean_force_work", "error_work", "damping_loss")


@settings(max_examples=100, deadline=None, derandomize=True)
@given(OSCILLATORS, STARTS, st.integers(1, 4), st.sampled_from([None, 0.0, 0.4]))
def test_the_balance_closes_to_rounding(osc, start, n, flight_damping):
    osc = osc.replace(flight_damping=flight_damping, harmonics=[(3, 0.05, 0.4)])
    balance = energy_balance(osc, *start, n)
    size = sum(np.abs(getattr(balance, part)) for part in PARTS) + balance.energy.max()
    assume(np.all(np.isfinite(size)) and size.max() < 1e4)
    assert np.all(np.abs(balance.remainder) <= 1e-11 * size + 1e-15)
    x, v = gp.stroboscopic_map(osc, *start, n)
    level = osc.stiffness.levels[0]
    assert balance.energy[-1] == pytest.approx(v**2 / 2 + level * (x - np.clip(x, -1, 1)) ** 2 / 2, rel=1e-8, abs=1e-12)
    assert balance.mean_force_work.sum() == pytest.approx(osc.mean_force * (x - start[0]), rel=1e-8, abs=1e-10)
    assert np.all(balance.damping_loss >= 0.0)


def test_the_parts_are_those_of_an_integral_over_time():
    """Quadrature of sampled speed, and the steps by hand from the states where k switches."""
    osc = gp.Oscillator(damping_ratio=0.05, flight_damping=0.01, error_phase=0.3)
    balance = energy_balance(osc, 1.4, 0.2, 1)
    motion = gp.trajectory(osc, 1.4, 0.2, 1, samples_per_period=20_000)
    zeta = np.where(np.abs(motion.x) > 1.0, 0.05, 0.01)
    assert np.trapezoid(2.0 * zeta * motion.v**2, motion.tau) == pytest.approx(balance.damping_loss[0], rel=1e-3)
    push = osc.force(motion.tau) - osc.mean_force
    assert np.trapezoid(push * motion.v, motion.tau) == pytest.approx(balance.error_work[0], abs=1e-7)
    pressed = motion.x - np.clip(motion.x, -1.0, 1.0)
    at_edge = np.interp(0.68 * osc.period, motion.tau, pressed)
    steps = (ONE - DOUBLE) * at_edge**2 / 2 + (DOUBLE - ONE) * pressed[-1] ** 2 / 2
    assert steps == pytest.approx(balance.stiffness_work[0], abs=1e-7)


def test_error_work_of_a_known_motion():
    """Constant k, in contact for good: X is the sum of a constant and a sinusoid, whose works are in any textbook."""
    osc = gp.Oscillator(mean_force=1.0, error_amplitude=0.1, damping_ratio=0.05, mesh_frequency=1.3, stiffness=SINGLE)
    state = gp.steady_state(osc, 2.0, 0.0)
    balance = energy_balance(osc, *state.points[0], 1)
    size = 0.1 * 1.3**2 / np.hypot(1.0 - 1.3**2, 2 * 0.05 * 1.3)
    expected, _ = quad(lambda tau: 2 * 0.05 * (size * 1.3 * np.cos(1.3 * tau)) ** 2, 0.0, osc.period)
    assert balance.damping_loss[0] == pytest.approx(expected, rel=1e-12)
    assert balance.error_work[0] == pytest.approx(expected, rel=1e-12)
    assert balance.stiffness_work[0] == 0.0


def test_without_damping_and_error_only_the_steps_work():
    osc = gp.Oscillator(damping_ratio=0.0, error_amplitude=0.0)
    balance = energy_balance(osc, 1.3, 0.2, 6)
    total = balance.energy - osc.mean_force * np.array([1.3, *section_x(osc, 6)])
    np.testing.assert_allclose(np.diff(total), balance.stiffness_work, atol=1e-14)
    assert np.abs(balance.stiffness_work).max() > 1e-3
    assert not balance.damping_loss.any() and not balance.error_work.any()


def section_x(osc, n):
    return gp.trajectory(osc, 1.3, 0.2, n, samples_per_period=1).x[1:]


def test_a_slow_pair_pays_for_both_switches_of_its_stiffness():
    """So slow that the teeth have come to rest before the next switch.

    A switch from k_1 to k_2 leaves the deflection F / k_1, whose distance to F / k_2 rings down; so does the other.
    """
    osc = gp.Oscillator(error_amplitude=0.0, mesh_frequency=0.001)
    state = gp.steady_state(osc)
    balance = energy_balance(osc, *state.points[0], 1)
    expected = (DOUBLE + ONE) / 2 * (0.1 / ONE - 0.1 / DOUBLE) ** 2
    assert balance.stiffness_work[0] == pytest.approx(expected, rel=1e-9)
    assert balance.damping_loss[0] == pytest.approx(expected, rel=1e-9)


def test_the_periods_of_a_revolution_are_told_apart():
    osc = gp.Oscillator(shaft_orders=[(5, 0.3)])
    balance = energy_balance(osc, 1.2, 0.0, 2)
    assert balance.stiffness_work.shape == (10,) and balance.energy.shape == (11,)
    assert np.abs(balance.remainder).max() < 1e-14


def test_a_long_motion_is_listed_in_pieces(monkeypatch):
    whole = energy_balance(gp.Oscillator(), 1.2, 0.0, 40)
    monkeypatch.setattr(energy, "AT_ONCE", 7)
    parts = energy_balance(gp.Oscillator(), 1.2, 0.0, 40)
    for part in (*PARTS, "energy"):
        np.testing.assert_allclose(getattr(whole, part), getattr(parts, part), rtol=0.0, atol=1e-13)


def test_what_escapes_has_no_balance():
    osc = gp.Oscillator(mesh_frequency=1.85, damping_ratio=0.0)
    with pytest.raises(RuntimeError, match="escapes to infinity"):
        energy_balance(osc, 1e5, 0.0, 10_000)
