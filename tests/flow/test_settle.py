"""The machine that settles, state by state (see the table in `gearpair._flow.settle`); quick in plain Python, too."""

import numpy as np
import pytest

import gearpair as gp
from gearpair._flow.settle import CAPTURED, observed_periods, settle_lanes
from gearpair._flow.stable_orbits import PROMISING
from gearpair._flow.states import APERIODIC, CAPPED, EXHAUSTED, FLOATING, GONE, NOT_RUN, PERIODIC, UNSETTLED, Limits
from gearpair.ensembles.capture import known_attractors
from gearpair.motion.settling import SettleSettings, blank, lanes_of, nothing_known

DAMPED = gp.Oscillator(damping_ratio=0.1)
DOUBLED = gp.Oscillator()  # period 2
CHAOTIC = gp.Oscillator(mesh_frequency=1.219)
SHORT = {"n_exponent": 200, "n_watch": 300, "n_samples": 6, "n_transient": 400, "max_period": 8}


def settled(oscillators, starts, *, known=None, chain=1, most=10**9, **settings):
    """The rows that the kernel fills."""
    given = SettleSettings(**(SHORT | settings))
    out = blank(len(starts), given)
    limits = Limits(given.max_period, given.n_exponent, given.n_watch, most)
    lanes = lanes_of(oscillators, np.array(starts, dtype=float), given)
    settle_lanes(0, len(starts), lanes, chain, limits, known or nothing_known(given), out)
    return out


@pytest.mark.parametrize(("osc", "period"), [(DAMPED, 1), (DOUBLED, 2)])
def test_a_captured_motion_is_described_as_its_orbit(osc, period):
    out = settled([osc], [(1.0, 0.0)], measures=True)
    orbit = gp.periodic_orbit(osc, *out.points[0, 0], period)
    assert (out.status[0], out.period[0], out.attractor[0]) == (PERIODIC, period, -1)
    np.testing.assert_allclose(out.points[0], np.tile(orbit.points, (6 // period, 1)), rtol=0.0, atol=1e-12)
    assert np.argmin(out.points[0, :period, 0]) == 0
    np.testing.assert_allclose(out.extremes[0], (orbit.x_min, orbit.x_max), rtol=0.0, atol=1e-12)
    assert np.linalg.eigvals(out.monodromy[0]) == pytest.approx(np.linalg.eigvals(orbit.monodromy), rel=1e-9)
    largest = np.log(np.abs(orbit.multipliers).max()) / (period * osc.period)
    assert out.exponents[0] == pytest.approx((largest, -2.0 * osc.damping_ratio - largest, 0.0), abs=1e-12)
    measures = gp.motion.impact_measures(gp.steady_state(osc))
    assert out.measures[0, 0] == measures.drive_impacts and out.measures[0, 13] == pytest.approx(measures.x_rms)


def test_the_way_ends_where_the_motion_is_captured_and_sooner_than_it_arrives():
    out = settled([DAMPED], [(1.0, 0.0)])
    waited, impacts, low, high = out.way[0]
    motion = gp.trajectory(DAMPED, 1.0, 0.0, int(waited), samples_per_period=4000)
    assert impacts == np.sum(motion.impacts.contact)
    assert (low, high) == pytest.approx((motion.x.min(), motion.x.max()), abs=1e-5)
    apart = np.abs(np.array([motion.x[-1], motion.v[-1]]) - out.final[0]).max()
    assert CAPTURED < apart < PROMISING
    on = gp.stroboscopic_map(DAMPED, motion.x[-1], motion.v[-1], 300)
    assert on == pytest.approx(tuple(out.points[0, 0]), abs=1e-9)


def test_a_known_attractor_captures_at_once_and_is_copied():
    settings = SettleSettings(**SHORT, measures=True)
    known = known_attractors(DOUBLED, np.array([[1.0, 0.0]]), settings)
    far = settled([DOUBLED], [(1.2, 0.1)], known=known, measures=True)
    near = settled([DOUBLED], [known.settled.points[0, 1] + 1e-7], known=known, measures=True)
    for out in (far, near):
        assert (out.status[0], out.period[0], out.attractor[0]) == (PERIODIC, 2, 0)
        for name in ("points", "monodromy", "extremes", "exponents", "measures"):
            np.testing.assert_array_equal(getattr(out, name), getattr(known.settled, name))
    assert near.way[0, 0] == 0.0 and far.way[0, 0] > 1.0
    assert near.final[0].tolist() == pytest.approx(known.settled.points[0, 1].tolist(), abs=1e-12)


def test_an_orbit_that_is_known_is_not_found_again():
    """Of a neighbourhood that is small the motion hears late, but no search on its way finds the orbit anew."""
    settings = SettleSettings(**SHORT)
    known = known_attractors(DAMPED, np.array([[1.0, 0.0]]), settings)
    shrunk = known.neighbourhoods.copy()
    shrunk[:, 2:5] *= 1e12
    out = settled([DAMPED], [(1.0, 0.0)], known=known._replace(neighbourhoods=shrunk))
    assert (out.status[0], out.period[0], out.attractor[0]) == (PERIODIC, 1, 0)
    assert out.way[0, 0] > settled([DAMPED], [(1.0, 0.0)]).way[0, 0]


def test_after_the_transient_a_stable_orbit_that_is_approached_counts():
    out = settled([DAMPED], [(0.6, -0.1)], n_transient=0)
    assert (out.status[0], out.period[0]) == (PERIODIC, 1)
    np.testing.assert_array_equal(out.way, settled([DAMPED], [(0.6, -0.1)]).way)


def test_a_positive_exponent_is_aperiodic_and_its_range_is_that_of_the_span():
    out = settled([CHAOTIC], [(1.0, 0.0)], n_transient=30, measures=True)
    largest, smallest, error = out.exponents[0]
    assert (out.status[0], out.period[0]) == (APERIODIC, 0)
    assert largest > 4.0 * error > 0.0 and largest + smallest == pytest.approx(-0.04, abs=1e-14)
    here = np.array(gp.stroboscopic_map(CHAOTIC, 1.0, 0.0, 30))
    np.testing.assert_allclose(out.points[0, 0], here, rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(out.points[0, 1], gp.stroboscopic_map(CHAOTIC, *out.points[0, 0]), rtol=0.0, atol=1e-9)
    span = gp.trajectory(CHAOTIC, *out.points[0, 0], 40, samples_per_period=400).x
    assert out.extremes[0, 0] <= span.min() + 1e-4 and out.extremes[0, 1] >= span.max() - 1e-4
    assert np.isnan(out.monodromy).all() and np.isfinite(out.measures).all()


def test_a_motion_that_settles_while_it_is_watched_is_periodic_and_says_when():
    """From (0, -1) the chaos at 1.09 goes on for some hundred mesh periods; the walk to its end is that of the map."""
    osc = CHAOTIC.replace(mesh_frequency=1.09)
    late = settled([osc], [(0.0, -1.0)], n_transient=20, n_exponent=40, n_watch=20_000)
    early = settled([osc], [(0.0, -1.0)], n_transient=20_000)
    for name in ("status", "period", "lasted", "way", "points", "extremes"):
        np.testing.assert_allclose(getattr(late, name), getattr(early, name), rtol=0.0, atol=1e-12)
    assert late.status[0] == PERIODIC and late.lasted[0] == late.way[0, 0] > 20 + observed_periods(40)
    assert late.chaos[0, 2] > 0.0 and np.isnan(early.chaos).all()
    x, v = gp.stroboscopic_map(osc, 0.0, -1.0, int(late.lasted[0]) + 400)
    assert np.abs(late.points[0] - (x, v)).max(axis=1).min() < 1e-9
    short = settled([osc], [(0.0, -1.0)], n_transient=20, n_exponent=40, n_watch=0)
    assert short.status[0] in (APERIODIC, UNSETTLED) and short.lasted[0] == 20 + observed_periods(40)


def test_a_motion_on_a_set_that_is_known_to_last_is_not_watched():
    nothing = nothing_known(SettleSettings(**SHORT))
    watched = settled([CHAOTIC], [(1.0, 0.0)])
    assert watched.lasted[0] == 400 + observed_periods(200) + 300
    row = np.append(watched.chaos[0], 1e6)
    for change, lasted in (
        ((0.0, 0.0, 0.0), 0),
        ((0.3, 0.0, 0.0), 300),
        ((0.0, 0.3, 0.0), 300),
        ((0.0, 0.0, 0.2), 300),
    ):
        known = nothing._replace(lasting=np.array([row + np.append(change, 0.0)]))
        out = settled([CHAOTIC], [(1.0, 0.0)], known=known)
        assert (out.status[0], out.lasted[0]) == (APERIODIC, 400 + observed_periods(200) + lasted)


def test_an_exponent_that_a_short_span_does_not_resolve_is_measured_again():
    weak = CHAOTIC.replace(mesh_frequency=0.975)  # its exponent is about 0.011
    short = settled([weak], [(1.0, 0.0)], n_exponent=100, n_watch=60)
    again = settled([weak], [(1.0, 0.0)], n_exponent=100, n_watch=4000)
    assert short.status[0] == UNSETTLED and again.status[0] == APERIODIC
    assert again.exponents[0, 2] < short.exponents[0, 2]
    assert again.exponents[0, 0] == pytest.approx(0.011, abs=4.0 * again.exponents[0, 2])


def test_without_a_mean_force_a_motion_may_float():
    """Within the backlash X'' + 2 zeta X' is the forcing alone: its amplitude in X is known in closed form."""
    osc = gp.Oscillator(mean_force=0.0, error_amplitude=0.2, damping_ratio=0.1, mesh_frequency=1.3)
    swing = 0.2 * 1.3**2 / (1.3 * np.hypot(1.3, 0.2))
    out = settled([osc], [(0.1, 0.0)])
    assert (out.status[0], out.period[0]) == (FLOATING, 0)
    assert out.extremes[0, 1] - out.extremes[0, 0] == pytest.approx(2.0 * swing, rel=1e-9)
    assert out.exponents[0].tolist() == [0.0, -0.2, 0.0]
    shifted = settled([osc], [out.final[0] + (0.1, 0.0)])
    assert shifted.status[0] == FLOATING
    assert shifted.extremes[0] - out.extremes[0] == pytest.approx([0.1, 0.1], abs=1e-9)
    loaded = settled([osc.replace(mean_force=0.01)], [(0.1, 0.0)])
    assert loaded.status[0] != FLOATING


@pytest.mark.parametrize(("frequency", "period"), [(0.318, 16), (0.766, 2)])
def test_a_cycle_without_a_neighbourhood_captures_what_returns_to_it_or_slowly_nears_it(frequency, period):
    """Near a grazing or a flip none can be certified. The limit is the orbit all the same, on which the next begins."""
    osc = gp.Oscillator(mesh_frequency=frequency)
    out = settled([osc], [(1.0, 0.0)], n_transient=500, max_period=16, n_samples=16)
    assert (out.status[0], out.period[0]) == (PERIODIC, period) and out.lasted[0] == out.way[0, 0] > 100
    orbit = gp.periodic_orbit(osc, *out.points[0, 0], period)
    assert orbit.converged and np.abs(orbit.multipliers).max() < 1.0
    assert np.abs(orbit.points - out.final[0]).max(axis=1).min() < 1e-9
    reached = gp.stroboscopic_map(osc, 1.0, 0.0, int(out.lasted[0]))
    assert 0.0 < np.abs(orbit.points - reached).max(axis=1).min() < 1e-2


def test_after_capture_the_rest_of_the_way_counts():
    """A cycle with a wide neighbourhood: the start is captured at once, and swings farther only afterwards."""
    osc = gp.Oscillator(mean_force=1.0, error_amplitude=0.05, damping_ratio=0.05)
    out = settled([osc], [(2.5, 0.0)])
    motion = gp.trajectory(osc, 2.5, 0.0, 3, samples_per_period=20_000)
    assert out.way[0, 0] == 0.0 and out.extremes[0, 1] < 2.75
    assert out.way[0, 3] == pytest.approx(motion.x.max(), abs=1e-6) and motion.x.max() > 2.79
    straddling = gp.Oscillator(mean_force=0.66, error_amplitude=0.1826, damping_ratio=0.176, mesh_frequency=0.3985)
    out = settled([straddling], [(2.6875, -0.25)])
    assert out.way[0, 0] == 0.0 and out.extremes[0, 0] > 1.0
    lowest = gp.trajectory(straddling, 2.6875, -0.25, 3, samples_per_period=20_000).x.min()
    assert out.way[0, 2] == pytest.approx(lowest, abs=1e-6) and lowest < 1.0


def test_without_damping_nothing_settles():
    in_contact = gp.Oscillator(damping_ratio=0.0, mean_force=4.0, error_amplitude=0.02, mesh_frequency=1.3)
    out = settled([in_contact], [(5.2, 0.1)], n_transient=20)
    assert (out.status[0], out.period[0]) == (UNSETTLED, 0)
    assert abs(out.exponents[0, 0]) < 5.0 * out.exponents[0, 2] and out.exponents[0, 0] == -out.exponents[0, 1]


def test_a_motion_without_bound_and_one_with_no_work_left():
    escaping = gp.Oscillator(mesh_frequency=1.95, damping_ratio=0.001)
    out = settled([escaping], [(3e5, 0.0)])
    assert out.status[0] == GONE and np.isnan(out.points).all() and np.isnan(out.extremes).all()
    assert CAPPED != GONE
    out = settled([CHAOTIC], [(1.0, 0.0)], most=50)
    assert (out.status[0], out.way[0, 0]) == (EXHAUSTED, 50.0)
    assert out.final[0] == pytest.approx(np.array(gp.stroboscopic_map(CHAOTIC, 1.0, 0.0, 50)), abs=1e-4)
    cut = settled([CHAOTIC], [(1.0, 0.0)], most=700)
    assert (cut.status[0], cut.lasted[0]) == (EXHAUSTED, 700) and np.isfinite(cut.extremes).all()
    enough = settled([DAMPED], [(1.0, 0.0)], most=300)
    assert enough.status[0] == PERIODIC


def test_lanes_have_their_own_oscillators_and_chains_hand_on():
    oscillators = [DAMPED.replace(mesh_frequency=w) for w in (0.7, 0.75, 0.8)]
    starts = [(1.0, 0.0), (5.0, 5.0), (5.0, 5.0)]
    chained = settled(oscillators, starts, chain=3)
    for i, osc in enumerate(oscillators):
        start = starts[0] if i == 0 else chained.final[i - 1]
        alone = settled([osc], [start])
        for name in ("status", "points", "way", "final"):
            np.testing.assert_array_equal(getattr(chained, name)[i], getattr(alone, name)[0])
    shared = settled(oscillators[:1], starts)
    assert not np.any(shared.status == NOT_RUN)
    np.testing.assert_array_equal(shared.way[1], shared.way[2])
