"""A passage: the same as the plain flow where nothing changes and continuous where it does."""

import numpy as np
import pytest
from scipy.linalg import expm

import gearpair as gp
from gearpair.motion import impact_measures

BASE = gp.Oscillator(mesh_frequency=0.5, error_amplitude=0.05, damping_ratio=0.05)


def test_equal_oscillators_are_the_plain_flow() -> None:
    osc = gp.Oscillator(harmonics=[(2, 0.05, 0.3)])
    run = gp.passage([osc] * 40, 0.3, -0.2)
    for cycle in (0, 1, 17, 39):
        expected = [*map(float, gp.stroboscopic_map(osc, 0.3, -0.2, cycle))]
        assert (float(run.x[cycle]), float(run.v[cycle])) == pytest.approx(expected, abs=1e-12)
    assert (float(run.end_x), float(run.end_v)) == pytest.approx(
        [*map(float, gp.stroboscopic_map(osc, 0.3, -0.2, 40))], abs=1e-12
    )
    motion = gp.trajectory(osc, 0.3, -0.2, 40)
    made = motion.impacts.contact & (motion.impacts.side == 1)
    assert float(run.drive_impacts.sum()) == made.sum()
    assert float(run.drive_velocity.max()) == motion.impacts.velocity[made].max()
    assert float(run.end_tau) == pytest.approx(40 * osc.period, rel=1e-14)


def test_measures_are_those_of_the_steady_motion() -> None:
    osc = gp.Oscillator(mesh_frequency=0.7)
    state = gp.steady_state(osc)
    run, measures = gp.passage([osc] * 4, *state.points[0].tolist()), impact_measures(state)
    assert run.largest_force.values.max() == pytest.approx(max(measures.drive_force, measures.coast_force), rel=1e-9)
    assert (run.x_min.values.min(), run.x_max.values.max()) == pytest.approx((state.x_min, state.x_max), rel=1e-9)
    assert set(run.impact_state.values) == {str(state.impact_state)}


def test_the_dynamic_transmission_error_and_its_rate_go_on() -> None:
    wave = gp.StiffnessWave((0.0, 0.4), (1.2, 0.8))
    first = BASE.replace(error_phase=0.7, harmonics=[(3, 0.02, 1.0)])
    second = first.replace(mesh_frequency=0.9, error_amplitude=0.11, error_phase=-0.4, stiffness=wave, mean_force=0.2)
    run = gp.passage([first, second], 1.2, 0.1)
    x, v = gp.stroboscopic_map(first, 1.2, 0.1)
    h = 1e-6
    rates = [float(osc.error(h) - osc.error(-h)) / (2.0 * h) for osc in (first, second)]
    assert float(run.x[1]) + float(second.error(0.0)) == pytest.approx(x + float(first.error(0.0)), abs=1e-14)
    assert float(run.v[1]) + rates[1] == pytest.approx(v + rates[0], abs=1e-10)
    assert abs(float(run.v[1]) - v) > 1e-3
    expected = [*map(float, gp.stroboscopic_map(second, float(run.x[1]), float(run.v[1])))]
    assert (float(run.end_x), float(run.end_v)) == pytest.approx(expected, abs=1e-13)


def test_a_load_step_in_contact_is_the_step_of_a_linear_oscillator() -> None:
    # k = 1, no error: X about its rest decays as exp(-zeta tau) (cos w tau + zeta / w sin w tau).
    osc = gp.Oscillator(mean_force=0.2, error_amplitude=0.0, mesh_frequency=0.6, stiffness=gp.StiffnessWave((0,), (1,)))
    run = gp.passage([osc] * 2 + [osc.replace(mean_force=0.3)] * 8, 1.2, 0.0, samples_per_period=50)
    tau = run.sample_tau.values[2:] - 2 * osc.period
    zeta = osc.damping_ratio
    w = np.sqrt(1.0 - zeta**2)
    expected = 1.3 - 0.1 * np.exp(-zeta * tau) * (np.cos(w * tau) + zeta / w * np.sin(w * tau))
    assert run.sample_x.values[2:] == pytest.approx(expected, abs=1e-13)
    assert run.x_max.values[2] == pytest.approx(1.3 + 0.1 * np.exp(-zeta * np.pi / w), abs=1e-12)


def energy(x: float, v: float, stiffness: float) -> float:
    """Kinetic and stored energy of a state."""
    return 0.5 * v * v + 0.5 * stiffness * max(abs(x) - 1.0, 0.0) ** 2


def works(osc: gp.Oscillator, begin: float, end: float, x: float, v: float, stiffness: float) -> tuple[float, float]:
    """What the error's inertia brings and damping takes between two events, the state being (x, v) at the first.

    By Gauss's rule of 32 points over the matrix exponential of (X, X', 1, and the sine and cosine of each harmonic).
    """
    lines = [(n * osc.mesh_frequency, size * (n * osc.mesh_frequency) ** 2, at) for n, size, at in osc.all_harmonics]
    matrix, state = np.zeros((3 + 2 * len(lines),) * 2), [x, v, 1.0]
    side = np.sign(x) if stiffness else 0.0
    matrix[0, 1], matrix[1, :3] = 1.0, (-stiffness, -2.0 * osc.damping_ratio, osc.mean_force + stiffness * side)
    for k, (omega, force, at) in enumerate(lines):
        row = 3 + 2 * k
        matrix[1, row], matrix[row, row + 1], matrix[row + 1, row] = force, omega, -omega
        state += [np.sin(omega * begin + at), np.cos(omega * begin + at)]
    nodes, weights = np.polynomial.legendre.leggauss(32)
    steps = 0.5 * (end - begin) * (nodes + 1.0)
    states = expm(matrix * steps[:, None, None]) @ np.array(state)
    weights = 0.5 * (end - begin) * weights
    force = states[:, 3::2] @ np.array([each[1] for each in lines])
    return float(weights @ (force * states[:, 1])), float(weights @ (2.0 * osc.damping_ratio * states[:, 1] ** 2))


def test_energy_of_a_passage() -> None:
    """Over each mesh period, to rounding: the work of the mean force, of the steps of the stiffness and of the error's
    inertia, less what damping takes, is what the stored energy changes by. At its start X and X' step, and the energy
    with them, so that X + e and its rate go on: all that is followed is what goes from one period to the next.
    """
    wave = gp.StiffnessWave((0.0, 0.3, 0.6), (1.1, 0.7, 1.2))
    base = BASE.replace(stiffness=wave, harmonics=[(2, 0.01, 0.4)], error_amplitude=0.08, error_phase=0.5)
    oscillators = [base.replace(mesh_frequency=each, mean_force=0.1 + 0.1 * each) for each in np.linspace(0.7, 1.0, 30)]
    run = gp.passage(oscillators, *gp.steady_state(oscillators[0]).points[0].tolist(), samples_per_period=10)
    balances, stepped, struck = [], [], 0
    for i, osc in enumerate(oscillators):
        start, period = (float(run.x[i]), float(run.v[i])), osc.period
        motion = gp.trajectory(osc, *start, 1)
        struck += len(motion.impacts)
        events = {tau: (float(side), speed) for tau, side, speed in zip(
            motion.impacts.tau.tolist(), motion.impacts.side.tolist(), motion.impacts.velocity.tolist(), strict=True
        )}  # fmt: skip
        events |= {
            edge * period: (float(run.sample_x[i, k]), float(run.sample_v[i, k])) for edge, k in ((0.3, 3), (0.6, 6))
        }
        events |= {0.0: start}
        if i + 1 < len(oscillators):  # before the step that X + e and its rate ask for
            after, now = oscillators[i + 1], osc.error(0.0)
            step = float(after.error(0.0) - now), rate(after) - rate(osc)
            end = float(run.x[i + 1]) + step[0], float(run.v[i + 1]) + step[1]
            stepped.append(energy(float(run.x[i + 1]), float(run.v[i + 1]), 1.1) - energy(*end, 1.1))
        else:
            end = float(run.end_x), float(run.end_v)
        taus = sorted(events)
        brought = osc.mean_force * (end[0] - start[0])
        for tau, until in zip(taus, [*taus[1:], period], strict=True):
            x, v = events[tau]
            outside = abs(x) > 1.0 or (abs(x) == 1.0 and x * v > 0.0)
            level = float(wave(0.5 * (tau + until) / period))
            error, damped = works(osc, tau, until, x, v, level * outside)
            brought += error - damped
        for edge, jump in ((0.3, 0.7 - 1.1), (0.6, 1.2 - 0.7)):
            brought += energy(events[edge * period][0], 0.0, jump)
        balances.append(energy(*end, 1.2) - energy(*start, 1.1) - brought)
    assert np.abs(balances).max() < 2e-14
    assert np.abs(stepped).max() > 1e-5 and struck > 30


def rate(osc: gp.Oscillator) -> float:
    """The rate of the error at the start of a mesh period, from its harmonics."""
    return osc.mesh_frequency * sum(n * size * float(np.cos(at)) for n, size, at in osc.all_harmonics)


def test_bad_input() -> None:
    with pytest.raises(ValueError, match="oscillators must hold one oscillator at least, got none"):
        gp.passage([], 0.0, 0.0)
    with pytest.raises(TypeError, match=r"oscillators\[1\] must be an Oscillator"):
        gp.passage([BASE, 3], 0.0, 0.0)
    with pytest.raises(ValueError, match="samples_per_period must be"):
        gp.passage([BASE], 0.0, 0.0, samples_per_period=-1)


def test_an_escape_is_told_with_its_cycle() -> None:
    unstable = gp.Oscillator(
        mesh_frequency=2.0, damping_ratio=0.0, stiffness=gp.StiffnessWave((0.0, 0.5), (1.8, 0.2)), mean_force=0.1
    )
    with pytest.raises(RuntimeError, match="escapes to infinity within"):
        gp.passage([unstable] * 500, 50.0, 0.0)
