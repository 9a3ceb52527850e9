"""Settled motions: status, minimal period, exact extremes, multipliers."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.motion.settling import Status, transient_periods
from tests.support.oscillators import level


@pytest.fixture(scope="module")
def along_frequency():
    """Settled motions over the article's range, restarted at each value."""
    osc = gp.Oscillator()
    return [gp.steady_state(osc.replace(mesh_frequency=omega), n_exponent=500) for omega in np.linspace(0.7, 1.7, 41)]


def test_every_status_of_a_bounded_motion_has_what_it_promises(along_frequency):
    found = {state.status for state in along_frequency}
    assert {"periodic", "aperiodic"} <= found
    for state in along_frequency:
        two_zeta = 2 * state.oscillator.damping_ratio
        assert state.lyapunov_exponents.sum() == pytest.approx(-two_zeta, abs=1e-9)
        assert isinstance(state.status, Status)
        if state.status == "periodic":
            assert state.points.shape == (state.period, 2)
            assert np.all(np.abs(state.multipliers) < 1.0)
            assert state.exponent_error == 0.0
        else:
            assert state.period is None
            assert np.all(np.isnan(state.multipliers))
        if state.status == "aperiodic":
            assert state.lyapunov_exponents[0] > 4 * state.exponent_error > 0.0


def test_the_period_is_minimal_and_the_points_are_a_cycle(along_frequency):
    periods = set()
    for state in along_frequency:
        if state.period is None:
            continue
        periods.add(state.period)
        x, v = gp.stroboscopic_map(state.oscillator, state.points[:, 0], state.points[:, 1])
        np.testing.assert_allclose(np.roll(state.points, -1, axis=0), np.stack([x, v], axis=1), rtol=0.0, atol=1e-10)
        assert state.points[0, 0] == state.points[:, 0].min()
        for a in range(state.period):
            for b in range(a):
                assert np.max(np.abs(state.points[a] - state.points[b])) > 1e-6
    assert len(periods) >= 3


def test_multipliers_multiply_to_the_contraction_and_match_finite_differences(along_frequency):
    step = 1e-6
    for state in along_frequency[::5]:
        if state.period is None:
            continue
        osc, n = state.oscillator, state.period
        assert np.prod(state.multipliers) == pytest.approx(np.exp(-2 * osc.damping_ratio * n * osc.period), rel=1e-9)
        shifts = np.array([[step, 0], [-step, 0], [0, step], [0, -step]]) + state.points[0]
        ends = np.stack(gp.stroboscopic_map(osc, shifts[:, 0], shifts[:, 1], n), axis=1)
        difference = np.stack([ends[0] - ends[1], ends[2] - ends[3]], axis=1) / (2 * step)
        expected = np.sort_complex(np.linalg.eigvals(difference))
        np.testing.assert_allclose(np.sort_complex(state.multipliers), expected, rtol=0.0, atol=1e-4)


def test_extremes_are_exact_beside_dense_samples(along_frequency):
    """No sample passes them, and the largest of dense samples comes as near as its parabola says."""
    for state in along_frequency[::4]:
        if state.period is None:
            continue
        motion = gp.trajectory(state.oscillator, *state.points[0], state.period, samples_per_period=4096)
        h = motion.tau[1]
        assert state.x_min - 1e-12 <= motion.x.min() <= state.x_min + h**2
        assert state.x_max - h**2 <= motion.x.max() <= state.x_max + 1e-12
        turning = np.abs(np.gradient(motion.v, h)).max()
        assert motion.x.max() > state.x_max - turning * h**2 / 4
        assert str(state.impact_state) == str(gp.impact_state(state.x_min, state.x_max))


def test_a_sharp_extreme_between_samples_is_found():
    """A stiff mesh turns the motion round within a thousandth of the period."""
    osc = level(1e5, damping_ratio=0.5, mean_force=0.2, error_amplitude=0.3, mesh_frequency=0.8)
    state = gp.steady_state(osc, n_transient=300)
    motion = gp.trajectory(osc, *state.points[0], state.period or 50, samples_per_period=20_000)
    assert state.x_max >= motion.x.max() - 1e-13
    assert state.x_max - motion.x.max() < 1e-6


@pytest.mark.parametrize("x", [1.1, 4.0])
def test_at_rest_without_excitation(x):
    """A constant stiffness, no error: the gear comes to rest at X = 1 + F / k, which has no turning points at all."""
    state = gp.steady_state(level(1.0, error_amplitude=0.0, damping_ratio=0.1), x, 0.0)
    assert (state.status, state.period, state.impact_state) == ("periodic", 1, "none_drive")
    assert [state.x_min, state.x_max] == pytest.approx([1.1, 1.1], abs=1e-12)


def test_without_damping_nothing_settles():
    state = gp.steady_state(gp.Oscillator(damping_ratio=0.0), n_transient=500, n_exponent=500)
    assert state.status in ("unsettled", "aperiodic")
    assert state.period is None
    gentle = gp.steady_state(
        gp.Oscillator(damping_ratio=0.0, mean_force=5.0, mesh_frequency=0.8), 6.0, 0.0, n_transient=200, n_exponent=500
    )
    assert gentle.status == "unsettled"
    assert "without damping there is nothing to settle on" in gentle.status.remedy


def test_a_period_beyond_the_stated_maximum_is_not_made_up(along_frequency):
    state = next(s for s in along_frequency if (s.period or 0) >= 2)
    short = gp.steady_state(state.oscillator, max_period=state.period - 1, n_exponent=500)
    assert short.status == "unsettled"
    assert short.period is None
    assert "max_period" in short.status.remedy


def test_the_transient_is_long_enough_for_the_damping():
    """At zeta = 0.00275 a stable cycle needs hundreds of periods; a start far out settles all the same."""
    assert transient_periods(gp.Oscillator(damping_ratio=0.00275)) > 800
    assert transient_periods(gp.Oscillator(damping_ratio=1e-9)) == 20_000
    assert transient_periods(gp.Oscillator(damping_ratio=0.0)) == 500
    near = gp.steady_state(gp.Oscillator(mesh_frequency=1.5, damping_ratio=0.002), 1.2, 0.0)
    assert near.status in ("periodic", "aperiodic")


def test_statuses_are_strings_with_a_remedy_each():
    assert {str(status) for status in Status} == {
        "periodic",
        "aperiodic",
        "unsettled",
        "escaped",
        "capped",
        "exhausted",
        "transient",
        "floating",
    }
    assert all(len(status.remedy) > 20 for status in Status)


@pytest.mark.parametrize("beyond", [0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_without_a_mean_force_no_motion_comes_to_strike_one_flank_alone(beyond, side):
    """Over a cycle the forces on the teeth have the mean of the load, 0: one that pushes off a flank ends beside it."""
    osc = gp.Oscillator(mean_force=0.0, error_amplitude=0.08, damping_ratio=0.05, mesh_frequency=0.7)
    free = gp.steady_state(osc, 0.0, 0.0)
    x, v = free.points[0]
    found = gp.steady_state(osc, x + side * (1.0 + beyond) - (free.x_max if side > 0.0 else free.x_min), v)
    assert found.status == "floating" and found.impact_state == "never_in_contact"
    assert (found.x_max if side > 0.0 else -found.x_min) == pytest.approx(1.0, abs=3e-8)
    assert found.x_max - found.x_min == pytest.approx(free.x_max - free.x_min, abs=1e-9)
    assert gp.motion.impact_measures(found).flight_share == 1.0


def test_chaos_is_told_by_its_exponent_not_by_its_samples():
    """Two starts on the chaotic motion at Omega = 1.219: different samples, one exponent within its error."""
    osc = gp.Oscillator(mesh_frequency=1.219)
    one, other = (gp.steady_state(osc, x, 0.0, n_exponent=5000) for x in (1.0, 1.3))
    if "periodic" in (one.status, other.status):
        pytest.skip("a window of periodic motion at this frequency")
    assert one.status == other.status == "aperiodic"
    spread = 5 * np.hypot(one.exponent_error, other.exponent_error)
    assert abs(one.lyapunov_exponents[0] - other.lyapunov_exponents[0]) < spread
    assert not np.allclose(one.points, other.points)


def test_as_many_section_points_of_chaos_as_are_asked_for():
    """They are successive: each is the map of the one before."""
    osc = gp.Oscillator(mesh_frequency=1.219)
    state = gp.steady_state(osc, samples=20_000)
    assert state.status == "aperiodic" and state.points.shape == (20_000, 2)
    np.testing.assert_array_equal(np.column_stack(gp.stroboscopic_map(osc, *state.points[:-1].T)), state.points[1:])
    assert len(np.unique(state.points, axis=0)) == 20_000
    few = gp.steady_state(osc, samples=3)
    np.testing.assert_array_equal(few.points, state.points[:3])
    assert few.lyapunov_exponents.tolist() == state.lyapunov_exponents.tolist()
    assert gp.steady_state(osc, n_samples=3) == few  # as sweeps call it


def test_of_a_periodic_motion_the_cycle_is_kept_once():
    for samples in (1, 20_000):
        assert gp.steady_state(gp.Oscillator(), samples=samples).points.shape == (2, 2)
    with pytest.raises(ValueError, match="samples must be a whole number of at least 1, got 0"):
        gp.steady_state(gp.Oscillator(), samples=0)
