"""Trajectories: samples, impacts and the comparison methods."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.methods import integrated_trajectory
from tests.support.reference import Piece, dop853_period, mpmath_period

BASELINE = gp.Oscillator()


def test_samples_lie_on_the_exact_motion():
    """Against seventy digits, piece by piece between the crossings, at a sampling that no cell's edge falls on."""
    osc, x, v = BASELINE, 1.3, 0.2
    motion = gp.trajectory(osc, x, v, 1, samples_per_period=13)
    expected = mpmath_period(osc, x, v)
    first = expected.crossings[0][0]
    piece = Piece(osc, osc.stiffness.levels[0], 1, osc.error_phase, x, v)
    checked = 0
    for k in range(13):
        if k / 13 < first:
            truth = [float(piece.derivative(n, k * osc.period / 13)) for n in (0, 1)]
            assert [motion.x[k], motion.v[k]] == pytest.approx(truth, abs=1e-14)
            checked += 1
    assert checked >= 2
    assert [motion.x[-1], motion.v[-1]] == pytest.approx([float(expected.x), float(expected.v)], abs=1e-14)


def test_samples_of_a_finer_sampling_contain_those_of_a_coarser_one():
    coarse = gp.trajectory(BASELINE, 0.3, 0.1, 3, samples_per_period=8)
    fine = gp.trajectory(BASELINE, 0.3, 0.1, 3, samples_per_period=32)
    np.testing.assert_allclose(fine.x[::4], coarse.x, rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(fine.tau[::4], coarse.tau, rtol=0.0, atol=1e-13)
    assert len(fine.impacts) == len(coarse.impacts)


def test_velocity_is_the_derivative_and_the_equation_holds_at_the_samples():
    """Central differences of X and X' on a fine sampling, away from crossings and switches of the stiffness."""
    osc = gp.Oscillator(mesh_frequency=1.219)
    motion = gp.trajectory(osc, 1.2, 0.3, 2, samples_per_period=4096)
    h = motion.tau[1]
    x, v, tau = motion.x[1:-1], motion.v[1:-1], motion.tau[1:-1]
    slope, acceleration = (motion.x[2:] - motion.x[:-2]) / (2 * h), (motion.v[2:] - motion.v[:-2]) / (2 * h)
    np.testing.assert_allclose(slope, v, rtol=0.0, atol=1e-5)
    gap = np.where(x > 1.0, x - 1.0, np.where(x < -1.0, x + 1.0, 0.0))
    expected = osc.force(tau) - 2 * osc.damping_ratio * v - osc.stiffness(tau / osc.period) * gap
    near_kink = np.minimum(np.abs(np.abs(x) - 1.0), 1.0) < 2 * h * np.abs(v) + 1e-9
    for edge in (0.0, 0.68, 1.0):
        near_kink |= np.abs(np.mod(tau / osc.period, 1.0) - edge) < 2 / 4096
    assert near_kink.mean() < 0.02
    assert np.max(np.abs(acceleration - expected)[~near_kink]) < 1e-5


def test_transient_is_discarded_and_time_starts_after_it():
    whole = gp.trajectory(BASELINE, 0.2, 0.0, 7, samples_per_period=4)
    late = gp.trajectory(BASELINE, 0.2, 0.0, 2, n_transient=5, samples_per_period=4)
    assert late.tau[0] == 0.0
    np.testing.assert_allclose(late.x, whole.x[20:], rtol=0.0, atol=1e-13)
    kept = whole.impacts.tau >= 5 * BASELINE.period
    np.testing.assert_allclose(late.impacts.tau, whole.impacts.tau[kept] - 5 * BASELINE.period, rtol=0.0, atol=1e-12)


def test_contacts_and_separations_alternate_and_know_their_side():
    motion = gp.trajectory(gp.Oscillator(mesh_frequency=1.219, damping_ratio=0.005), 0.0, 1.5, 200)
    impacts = motion.impacts
    assert set(impacts.side) == {1, -1}
    assert np.all(np.diff(impacts.tau) > 0.0)
    np.testing.assert_array_equal(impacts.contact, impacts.side * impacts.velocity > 0.0)
    assert np.all(impacts.contact[1:] != impacts.contact[:-1])
    separated = ~impacts.contact[1:]
    assert np.all(impacts.side[1:][separated] == impacts.side[:-1][separated])


@pytest.mark.parametrize("method, tolerance", [("RK45", 1e-6), ("DOP853", 1e-7), ("LSODA", 1e-6), ("Radau", 1e-5)])
def test_the_integrators_agree_with_the_exact_motion_to_their_tolerances(method, tolerance):
    exact = gp.trajectory(BASELINE, 1.3, 0.2, 2, samples_per_period=16)
    other = integrated_trajectory(BASELINE, 1.3, 0.2, 2, samples_per_period=16, method=method, rtol=1e-10, atol=1e-10)
    assert other.method == method
    np.testing.assert_allclose(other.x, exact.x, rtol=0.0, atol=tolerance)
    np.testing.assert_allclose(other.impacts.tau, exact.impacts.tau, rtol=0.0, atol=tolerance)
    np.testing.assert_array_equal(other.impacts.side, exact.impacts.side)
    np.testing.assert_array_equal(other.impacts.contact, exact.impacts.contact)


def test_rk45_s_default_tolerances_are_much_worse_than_exact():
    """The article's integrator at scipy's defaults errs in the second digit within one mesh period; exact does not."""
    osc = gp.Oscillator(mesh_frequency=1.219)
    rng = np.random.default_rng(0)
    errors = []
    for x, v in rng.normal(size=(10, 2)):
        loose = integrated_trajectory(osc, x, v, 1, samples_per_period=1).x[-1]
        errors.append(abs(loose - dop853_period(osc, x, v)[0]))
    assert max(errors) > 1e-3
    assert max(errors) < 1.0


def test_the_map_broadcasts():
    x, v = gp.stroboscopic_map(BASELINE, [[0.0], [1.0]], [0.0, 0.5, 1.0], 3)
    assert x.shape == v.shape == (2, 3)
    assert (x[1, 2], v[1, 2]) == tuple(map(float, gp.stroboscopic_map(BASELINE, 1.0, 1.0, 3)))
    nothing, _ = gp.stroboscopic_map(BASELINE, [], [])
    assert nothing.shape == (0,)
    same = gp.stroboscopic_map(BASELINE, 0.25, 0.5, 0)
    assert tuple(map(float, same)) == (0.25, 0.5)


def test_starts_in_parallel_are_those_one_by_one():
    x = np.linspace(-2.0, 2.0, 203)
    together = gp.stroboscopic_map(BASELINE, x, 0.1, 400)
    alone = [gp.stroboscopic_map(BASELINE, start, 0.1, 400) for start in x[::29]]
    np.testing.assert_array_equal(together[0][::29], [a[0] for a in alone])
