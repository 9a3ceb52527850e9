"""Counts and times of impacts against the brute-force search in seventy digits."""

import numpy as np
import pytest

import gearpair as gp
from gearpair._flow.event_search import certified_step
from tests.support.oscillators import level, random_case
from tests.support.reference import Piece, mpmath_period

DISTANCES = [sign * 10.0**-n for n in range(2, 13, 2) for sign in (1, -1)]


def compare(osc, x, v):
    """One period's crossings, ours against the reference's; returns the reference."""
    expected = mpmath_period(osc, x, v)
    motion = gp.trajectory(osc, x, v, 1, samples_per_period=1)
    impacts = motion.impacts
    assert len(impacts) == len(expected.crossings)
    speeds = [1.0]
    for k, (tau, side, velocity, contact) in enumerate(expected.crossings):
        assert (impacts.side[k], impacts.contact[k]) == (side, contact)
        # A crossing's time is as good as the position, over its speed; errors grow along the period.
        speeds.append(abs(velocity))
        tolerance = 1e-14 * expected.amplification * max(1.0, abs(x), abs(v)) / min(speeds)
        assert abs(impacts.tau[k] - tau * osc.period) <= 2.0 * tolerance + 1e-15 * osc.period
        assert abs(impacts.velocity[k] - velocity) <= 20.0 * tolerance
    for end in ((motion.x[-1], motion.v[-1]), tuple(map(float, gp.stroboscopic_map(osc, x, v)))):
        assert expected.error(*end) <= 1e-13 * expected.amplification
    return expected


def start_before(osc, region, at, x, v):
    """A start on the section (rounded) whose motion in `region` reaches about (x, v) at the fraction `at`."""
    piece = Piece(osc, osc.stiffness.levels[0], region, osc.mesh_frequency * at * osc.period + osc.error_phase, x, v)
    before = -at * osc.period
    return float(piece.derivative(0, before)), float(piece.derivative(1, before))


# X'' at a grazing contact is the force alone: positive at tau = 0.05 T, negative at tau = 0.3 T with a phase of pi.
FROM_CONTACT = gp.Oscillator(mesh_frequency=1.2)
FROM_FLIGHT = gp.Oscillator(mesh_frequency=1.2, error_phase=np.pi, error_amplitude=0.3)


@pytest.mark.parametrize("distance", DISTANCES)
@pytest.mark.parametrize("side", [1, -1])
def test_contact_that_nearly_separates(distance, side):
    """In contact down to a `distance` above the boundary: no separation; below it: a short flight."""
    osc = FROM_CONTACT
    x, v = start_before(osc, 1, 0.05, 1.0 + distance, 0.0)
    if side < 0:
        osc, x, v = mirrored(osc), -x, -v
    expected = compare(osc, x, v)
    early = [c for c in expected.crossings if c[0] < 0.2]
    # At 1e-2 below, the start itself is in flight already.
    assert len(early) == (0 if distance > 0 else 2 if abs(x) > 1.0 else 1)


@pytest.mark.parametrize("distance", DISTANCES)
@pytest.mark.parametrize("side", [1, -1])
def test_flight_that_nearly_touches(distance, side):
    """In flight up to a `distance` below the boundary: no contact; above it: a short contact."""
    osc = FROM_FLIGHT
    x, v = start_before(osc, 0, 0.25, 1.0 - distance, 0.0)
    if side < 0:
        osc, x, v = mirrored(osc), -x, -v
    expected = compare(osc, x, v)
    at_graze = [c for c in expected.crossings if abs(c[0] - 0.25) < 0.1]
    assert len(at_graze) == (0 if distance > 0 else 2)


@pytest.mark.parametrize("distance", [1e-13, -1e-13, 1e-15, -1e-15, 1e-17, 0.0])
def test_closer_than_rounding_the_state_is_right_whatever_the_count(distance):
    for osc, region, at, x in ((FROM_CONTACT, 1, 0.05, 1.0 + distance), (FROM_FLIGHT, 0, 0.25, 1.0 - distance)):
        start = start_before(osc, region, at, x, 0.0)
        expected = mpmath_period(osc, *start)
        assert expected.error(*map(float, gp.stroboscopic_map(osc, *start))) <= 1e-13 * expected.amplification


@pytest.mark.parametrize("lasting", [1e-3, 1e-4, 1e-6])
def test_two_crossings_within_a_thousandth_of_a_period(lasting):
    """A flight of the given share of a period, from its depth X'' t^2 / 8, where a time step would never look."""
    osc = FROM_CONTACT
    force = float(osc.force(0.05 * osc.period))
    depth = force * (lasting * osc.period) ** 2 / 8.0
    expected = compare(osc, *start_before(osc, 1, 0.05, 1.0 - depth, 0.0))
    first, second = (crossing[0] for crossing in expected.crossings[:2])
    assert second - first == pytest.approx(lasting, rel=0.05)


@pytest.mark.parametrize("x", [1.0, -1.0])
@pytest.mark.parametrize(
    "force, phase",
    [(0.3, 0.0), (-0.3, 0.0), (0.0, 0.0), (0.0, np.nextafter(np.pi, 4.0)), (0.0, 0.5), (0.0, -0.5)],
)
def test_start_at_rest_on_a_boundary(x, force, phase):
    """Decided by X'' = F + A sin(phi); where that is 0 (but for rounding), by X''' = A Omega cos(phi)."""
    osc = gp.Oscillator(mean_force=force, error_amplitude=0.5, error_phase=phase, mesh_frequency=1.0)
    compare(osc, x, 0.0)
    pull = force + 0.5 * np.sin(phase)
    moved = gp.trajectory(osc, x, 0.0, 1, samples_per_period=1000).x[1] - x
    assert np.sign(moved) == np.sign(pull if abs(pull) > 1e-9 else np.cos(phase))


@pytest.mark.parametrize("x", [1.0, -1.0])
@pytest.mark.parametrize("force", [0.5, -0.5])
def test_start_at_rest_on_a_boundary_left_with_the_fourth_power_of_time(x, force):
    """X'' = X''' = 0 but for rounding, so that the count is arbitrary; the state is not."""
    osc = gp.Oscillator(
        mean_force=force, error_amplitude=0.5, error_phase=-np.copysign(np.pi / 2, force), mesh_frequency=1.0
    )
    expected = mpmath_period(osc, x, 0.0)
    assert expected.error(*map(float, gp.stroboscopic_map(osc, x, 0.0))) <= 1e-13 * expected.amplification


@pytest.mark.parametrize("x", [1.0, -1.0])
@pytest.mark.parametrize("v", [1e-12, -1e-12, 1e-6, -1e-6, 1e-3, -1e-3])
def test_start_on_a_boundary_with_a_small_velocity(x, v):
    """A contact or a flight as short as 2 v / X'', where the force turns it back."""
    compare(gp.Oscillator(mean_force=np.copysign(0.3, v), mesh_frequency=1.1), x, v)
    back = gp.Oscillator(mean_force=-np.copysign(0.3, v), mesh_frequency=1.1)
    assert compare(back, x, v).crossings[0][0] * back.period == pytest.approx(2.0 * abs(v) / 0.3, rel=0.02)


def test_bounces_that_die_out_like_chatter():
    """A stiff, damped mesh under a steady load: ever shorter flights, then rest in contact."""
    osc = level(400.0, mean_force=1.0, error_amplitude=0.0, damping_ratio=0.6, mesh_frequency=2.0)
    expected = compare(osc, 1.0, -0.3)
    assert len(expected.crossings) > 9
    flights = np.diff([c[0] for c in expected.crossings])[1::2]
    assert np.all(np.diff(flights) < 0.0)


@pytest.mark.parametrize("seed", range(4))
def test_random_oscillators(seed):
    rng = np.random.default_rng(300 + seed)
    crossings = sum(len(compare(*random_case(rng)).crossings) for _ in range(6))
    assert crossings > 0


def test_more_events_than_any_gear_makes_has_a_sentence_not_a_hang():
    """A mesh period long enough for ten thousand bounces of a stiff, undamped mesh."""
    osc = level(1e4, mean_force=1.0, error_amplitude=0.0, damping_ratio=0.0, mesh_frequency=2 * np.pi / 500)
    for run in (
        lambda: gp.stroboscopic_map(osc, 1.0, -0.01),
        lambda: gp.trajectory(osc, 1.0, -0.01, 1),
    ):
        with pytest.raises(RuntimeError, match="more than 10000 contacts and separations in one mesh period: raise"):
            run()
    state = gp.steady_state(osc, 1.0, -0.01, n_transient=1)
    assert state.status == "capped"
    assert "events" in state.status.remedy
    assert len(state.points) == 0


def test_certified_step_never_passes_a_crossing_and_converges_quadratically():
    """On p(t) = cos t - c, |p''| <= 1: each step falls short of the root, the errors square."""
    root = np.arccos(0.3)
    t, errors = 0.0, []
    for _ in range(8):
        t += certified_step(np.cos(t) - 0.3, -np.sin(t), -1.0)
        errors.append(root - t)
    assert min(errors) > -1e-15
    orders = np.log(errors[2:4]) / np.log(errors[1:3])
    assert np.all(orders > 1.9)
    assert errors[-1] < 1e-15
    assert certified_step(0.0, -1.0, -2.0) == 0.0
    assert certified_step(0.0, 1.0, -2.0) == pytest.approx(1.0)
    assert certified_step(1.0, -1.0, 0.0) == pytest.approx(1.0)
    assert certified_step(1.0, -1.0, 0.48) == pytest.approx(1.0 / 0.6)
    assert certified_step(1.0, -1.0, 0.51) == certified_step(0.0, 0.0, 1.0) == np.inf


def mirrored(osc):
    """The oscillator whose motions are those of `osc` with X -> -X."""
    return osc.replace(mean_force=-osc.mean_force, error_phase=osc.error_phase + np.pi)
