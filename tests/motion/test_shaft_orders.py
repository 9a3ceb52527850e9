"""Errors that repeat once a revolution: the base period is the revolution, and everything counts in it."""

import itertools

import numpy as np
import pytest

import gearpair as gp
from gearpair.boundaries import at_phase, backward_map
from gearpair.design.linear import linear_response
from gearpair.methods import Integrator, integrated_trajectory, runge_kutta_section
from gearpair.motion import impact_measures
from tests.support.reference import dop853_period

ZERO = [(34, 0.0, 0.3), (20, 0.0)]
ROUGH = gp.Oscillator(damping_ratio=0.05, harmonics=[(2, 0.03, 0.5)], shaft_orders=[(4, 0.5, 0.4), (6, 0.3, 1.0, 2)])
# Run-out of one wheel of twenty teeth: contact is kept without it.
IDLE = gp.Oscillator(mean_force=0.01, error_amplitude=0.005, damping_ratio=0.03, mesh_frequency=1.5)
TURNING = IDLE.replace(shaft_orders=[(20, 1.0)])


def sidebands_osc(amplitude: float, wave: gp.StiffnessWave) -> gp.Oscillator:
    """A loaded pair that keeps contact."""
    return gp.Oscillator(
        mean_force=2.0, error_amplitude=0.05, error_phase=0.2, damping_ratio=0.05, mesh_frequency=0.7, stiffness=wave,
        harmonics=[(2, 0.01, 0.1)], shaft_orders=[(20, amplitude, 0.4), (30, 0.5 * amplitude, 1.0, 7)],
    )  # fmt: skip


def settled_turn(osc: gp.Oscillator) -> gp.Trajectory:
    """One base period of the motion from (3, 0)."""
    state = gp.steady_state(osc, 3.0, 0.0)
    assert state.period == 1
    return gp.trajectory(osc, *state.points[0].tolist(), 1)


@pytest.mark.slow
def test_a_revolution_against_dop853():
    for x, v in ((1.0, 0.0), (-1.7, 0.4), (0.2, -1.1)):
        end = gp.stroboscopic_map(ROUGH, x, v)
        assert np.allclose(end, dop853_period(ROUGH, x, v), rtol=0.0, atol=1e-10)
    assert len(gp.trajectory(ROUGH, 1.0, 0.0, 1).impacts) > 10


@pytest.mark.slow
def test_the_other_methods_follow():
    exact = gp.trajectory(ROUGH, 1.0, 0.0, 2)
    drawn = integrated_trajectory(ROUGH, 1.0, 0.0, 2, method="DOP853", rtol=1e-10, atol=1e-10)
    assert np.array_equal(drawn.tau, exact.tau) and np.allclose(drawn.x, exact.x, rtol=0.0, atol=1e-4)
    ends = runge_kutta_section(ROUGH, 1.0, 0.0, 2, rtol=1e-11, atol=1e-12)
    assert np.allclose(ends, exact.section, rtol=0.0, atol=1e-5)
    fixed = Integrator(steps=4000).sections([ROUGH], 1.0, 0.0, 0, 3)[0]
    assert np.allclose(fixed, exact.section, rtol=0.0, atol=1e-3)


def test_lines_of_a_linear_pair():
    """With constant stiffness each part of the error gives a line of amplitude F w^2 / |1 - w^2 + 2 i zeta w|."""
    osc = sidebands_osc(0.3, gp.StiffnessWave((0.0,), (1.0,)))
    lines = gp.spectrum(settled_turn(osc))
    assert lines.frequency[1] == pytest.approx(1 / 60, rel=1e-12)
    for order, amplitude, _phase in ((1, 0.05, 0), (2, 0.01, 0), (1 / 20, 0.3, 0), (7 / 30, 0.15, 0)):
        rate = osc.mesh_frequency * order
        expected = amplitude * rate**2 / abs(1.0 - rate**2 + 0.1j * rate)
        assert lines.line(order) == pytest.approx(expected, rel=1e-9)


def test_sidebands_of_a_varying_stiffness():
    """Always in contact the equation is linear: what a shaft adds grows with it, at n +- order / teeth alone."""
    x = {size: settled_turn(sidebands_osc(size, gp.StiffnessWave.rectangular())).x for size in (1e-13, 0.2, 0.4)}
    assert np.allclose(x[0.4] - x[1e-13], 2.0 * (x[0.2] - x[1e-13]), rtol=0.0, atol=1e-10)
    size = 2.0 * np.abs(np.fft.rfft((x[0.4] - x[1e-13])[:-1])) / (len(x[0.4]) - 1)
    beside = {n * 60 + side for n in range(-8, 9) for side in (3, -3, 14, -14)}
    lines = set(np.flatnonzero(size[: 8 * 60] > 1e-9).tolist())
    assert {57, 63, 46, 74} <= lines <= beside


def test_without_run_out_it_is_the_plain_pair():
    for plain in (gp.Oscillator(), gp.Oscillator(mesh_frequency=1.219, harmonics=[(2, 0.05), (7, 0.01, 1.0)])):
        osc = plain.replace(shaft_orders=ZERO)
        assert (osc.mesh_periods, osc.period) == (1, plain.period)
        x, v = np.linspace(-2.0, 2.0, 9), np.linspace(-1.0, 1.0, 9)
        assert np.array_equal(gp.stroboscopic_map(osc, x, v, 5), gp.stroboscopic_map(plain, x, v, 5))
        a, b = gp.trajectory(osc, 1.0, 0.0, 4), gp.trajectory(plain, 1.0, 0.0, 4)
        assert np.array_equal(a.x, b.x) and np.array_equal(a.v, b.v) and np.array_equal(a.impacts.tau, b.impacts.tau)
        a, b = gp.steady_state(osc), gp.steady_state(plain)
        assert a.motion == b.motion and np.array_equal(a.points, b.points) and a.lasted == b.lasted
        a, b = (gp.sweep(each, "mesh_frequency", [0.7, 0.75, 1.2]) for each in (osc, plain))
        assert a.equals(b)
        tau = np.linspace(0.0, 30.0, 50)
        assert np.array_equal(osc.force(tau), plain.force(tau)) and np.array_equal(osc.error(tau), plain.error(tau))


def test_error_and_force_of_two_wheels():
    """The base period is the least revolution of all wheels; the force is m_e e'' of the error."""
    osc = gp.Oscillator(shaft_orders=[(12, 0.3, 0.4), (18, 0.2, 1.0, 5), (7, 0.0)])
    assert osc.mesh_periods == 36 and osc.period == pytest.approx(36 * osc.mesh_period, rel=1e-15)
    tau = np.linspace(0.0, osc.period, 500)
    angle = osc.mesh_frequency * tau
    expected = 0.2 * np.sin(angle) + 0.3 * np.sin(angle / 12 + 0.4) + 0.2 * np.sin(5 * angle / 18 + 1.0)
    assert np.allclose(osc.error(tau), expected, rtol=0.0, atol=1e-13)
    h = 1e-3
    bend = (osc.error(tau + h) - 2.0 * osc.error(tau) + osc.error(tau - h)) / h**2
    assert np.allclose(osc.force(tau) - osc.mean_force, -bend, rtol=0.0, atol=1e-6)
    assert np.allclose(osc.error(tau + osc.period), osc.error(tau), rtol=0.0, atol=1e-12)


def test_rattle_comes_and_goes_once_a_turn():
    """Contact is kept without run-out; with it the teeth part in five of twenty mesh periods, and nowhere else."""
    assert str(gp.steady_state(IDLE, 1.02).motion) == "period 1, no impact"
    state = gp.steady_state(TURNING, 1.02)
    assert str(state.motion) == "period 1, single-sided" and state.lasted % 20 == 0
    contacts = gp.trajectory(TURNING, *state.points[0].tolist(), 1).impacts
    at = contacts.tau[contacts.contact] / TURNING.mesh_period
    assert np.floor(at).tolist() == [13, 14, 15, 16, 17]
    measures = impact_measures(state)
    assert measures.drive_impacts == pytest.approx(5 / 20, rel=1e-15)  # per mesh period
    assert measures.drive_impulse == pytest.approx(IDLE.mean_force * IDLE.period, rel=1e-9)


def test_a_map_and_a_sweep_of_run_out():
    name = "shaft_orders[0].amplitude"
    grid = gp.parameter_map(TURNING, {name: [0.5, 1.0]}, x=1.02, measures=True)
    assert grid.period.values.tolist() == [1, 1] and np.all(grid.lasted.values % 20 == 0)
    assert grid.drive_impacts.values.tolist() == [0.0, 0.25]
    assert gp.Oscillator.from_attrs(grid) == TURNING and grid[name].attrs["long_name"]
    assert TURNING.parameter(name) == 1.0 and TURNING.replace(**{name: 0.5}).shaft_orders == ((20, 0.5, 0.0, 1),)
    with pytest.raises(ValueError, match="same base period, got some of 1 and some of 20 mesh periods"):
        gp.sweep(TURNING, name, [0.0, 0.5])


def test_an_orbit_over_a_revolution():
    """det M = exp(-2 zeta T) over the base period; continued in the run-out it stays the sweep's motion."""
    state = gp.steady_state(TURNING, 1.02)
    orbit = gp.periodic_orbit(TURNING, *state.points[0].tolist(), 1)
    assert orbit.stable and np.allclose(orbit.points, state.points, rtol=0.0, atol=1e-11)
    shrinks = np.exp(-2.0 * 0.03 * TURNING.period)
    assert abs(np.prod(orbit.multipliers)) == pytest.approx(shrinks, rel=1e-8)
    branch = gp.continue_orbit(orbit, "shaft_orders[0].amplitude", 0.0, 1.0)
    assert any(b.kind == "grazing" for b in branch.bifurcations) and branch.values.min() < 0.01


def test_the_section_elsewhere_and_backward():
    motion = gp.trajectory(ROUGH, 1.0, 0.0, 2, samples_per_period=8)
    k = 5 * 8 + 2  # 5.25 mesh periods
    x, v = gp.stroboscopic_map(at_phase(ROUGH, 5.25), motion.x[k], motion.v[k])
    assert (x, v) == pytest.approx((motion.x[k + 12 * 8], motion.v[k + 12 * 8]), abs=1e-10)
    assert backward_map(ROUGH, *motion.section[1]) == pytest.approx(motion.section[0], abs=1e-8)


def test_the_linear_response_has_the_shafts():
    osc = sidebands_osc(0.3, gp.StiffnessWave((0.0,), (1.0,)))
    motion, found = settled_turn(osc), linear_response(osc)
    moved = (motion.x + osc.error(motion.tau))[:-1]
    assert found.x_rms == pytest.approx(moved.std(), rel=1e-10)
    assert found.largest_force == pytest.approx((motion.x - 1.0).max(), rel=1e-5)


def test_counts_are_rounded_up_to_revolutions():
    state = gp.steady_state(TURNING, 1.02, n_transient=21, n_watch=1)
    assert state.period == 1
    result = gp.survival(TURNING, [1.02, 0.0], 0.0, n_periods=1001, discard=21)
    assert (result.attrs["n_periods"], result.attrs["discard"]) == (1020, 40)
    assert np.all(result.escape_time.values % 20 == 0)
    plane = gp.basins(TURNING, [0.9, 1.02], [0.0])
    assert np.all(plane.settling_time.values % 20 == 0) and plane.attractor_period.values.tolist() == [1]


def test_a_base_period_of_many_mesh_periods():
    """Chaos, and strong damping, over a revolution in which the tangent leaves the range of floats."""
    chaotic = gp.Oscillator(mesh_frequency=1.219, shaft_orders=[(25, 1e-6), (71, 1e-6)])
    plain = gp.lyapunov_exponents(chaotic.replace(shaft_orders=()), 1.0, 0.0, 20_000)
    assert chaotic.mesh_periods == 1775
    assert gp.lyapunov_exponents(chaotic, 1.0, 0.0, 10, n_transient=1) == pytest.approx(plain, abs=2e-3)
    damped = gp.steady_state(chaotic.replace(damping_ratio=0.5, mesh_frequency=0.7))
    assert damped.period == 1 and np.allclose(damped.lyapunov_exponents, -0.5)
    lasting = gp.steady_state(chaotic)
    assert lasting.status == "aperiodic" and lasting.lasted < 120_000


def test_spacing_of_samples_and_of_the_section():
    motion = gp.trajectory(ROUGH, 1.0, 0.0, 3, samples_per_period=4)
    assert len(motion.x) == 3 * 12 * 4 + 1 and motion.section.shape == (4, 2)
    x, v = np.stack([gp.stroboscopic_map(ROUGH, 1.0, 0.0, n) for n in range(4)], axis=1)
    assert np.allclose(motion.section, np.column_stack([x, v]), rtol=0.0, atol=1e-10)
    assert motion.tau[4] == pytest.approx(ROUGH.mesh_period)
    taus = motion.impacts.tau
    assert all(a < b for a, b in itertools.pairwise(taus.tolist())) and taus[-1] <= motion.tau[-1]


WRONG = {
    "shaft_orders must be a sequence of (teeth, amplitude, phase, order), got 3": 3,
    "shaft_orders[0] must be (teeth, amplitude, phase, order), got 34": [34],
    "shaft_orders[0] teeth must be a whole number of at least 1, got 0": [(0, 0.1)],
    "shaft_orders[1] teeth must be a whole number of at least 1, got 2.5": [(20, 0.1), (2.5, 0.1)],
    "shaft_orders[0] amplitude must be a finite number at least 0, got -0.1": [(20, -0.1)],
    "shaft_orders[0] phase must be a finite number, got inf": [(20, 0.1, float("inf"))],
    "shaft_orders[0] order must be a whole number of at least 1, got 0": [(20, 0.1, 0.0, 0)],
    "shaft_orders[0] order must be a finite number at most 4000, got 4001": [(20, 0.1, 0.0, 4001)],
    "shaft_orders must repeat together within 10000 mesh periods, got teeth [101, 103], which need 10403": [
        (101, 0.1),
        (103, 0.1),
    ],
}


@pytest.mark.parametrize("message", WRONG)
def test_bad_shaft_orders_are_named(message):
    with pytest.raises(ValueError) as failure:
        gp.Oscillator(shaft_orders=WRONG[message])
    assert message in str(failure.value)


def test_a_base_period_that_is_too_long_for_a_slow_mesh():
    with pytest.raises(ValueError, match="with a base period of 9900 mesh periods"):
        gp.Oscillator(mesh_frequency=0.01, shaft_orders=[(99, 0.1), (100, 0.1)])
