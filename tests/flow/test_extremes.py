"""The range that a motion covers, against the roots of its slope and against samples."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

import gearpair as gp
from gearpair._flow.closed_form import TERMS, evaluate
from gearpair._flow.newton import newton
from gearpair._flow.observe import exponents
from gearpair._flow.reach import begin_reach, only_turn, segment_extremes
from gearpair._flow.records import CROSSING, REST, SEGMENT_COLUMNS, Segments
from gearpair._flow.walk import Details, walk


def true_range(series, end):
    """Smallest and largest value of a polynomial on [0, end], from numpy's roots of its derivative."""
    p = Polynomial(series)
    roots = p.deriv().roots()
    turns = roots.real[(abs(roots.imag) < 1e-9) & (roots.real > 0.0) & (roots.real < end)]
    values = p(np.concatenate([[0.0, end], turns]))
    return values.min(), values.max()


def ours(series, end, low=np.inf, high=-np.inf):
    x, slope, _ = evaluate(series, end)
    return segment_extremes(series, end, x, slope, low, high)


def random_series(rng, decay):
    """A power series whose terms fall like those of a cell of a motion (small `decay`) or of a much wilder one."""
    return rng.normal(size=TERMS) * decay ** np.arange(TERMS)


@pytest.mark.parametrize("decay", [0.1, 0.3, 0.6, 0.9])
def test_range_of_a_power_series_against_the_roots_of_its_slope(decay):
    """Monotone, of one turn, and of several: all three ways of the search are taken."""
    rng = np.random.default_rng(3)
    turns = []
    for _ in range(300):
        series, end = random_series(rng, decay), rng.uniform(0.05, 1.0)
        assert ours(series, end) == pytest.approx(true_range(series, end), rel=0.0, abs=1e-13)
        roots = Polynomial(series).deriv().roots()
        turns.append(np.sum((abs(roots.imag) < 1e-9) & (roots.real > 0.0) & (roots.real < end)))
    assert {0, 1} <= set(turns) and (decay < 0.6 or max(turns) > 1)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("at", [1e-9, 1e-3, 0.5, 1.0 - 1e-3, 1.0 - 1e-9])
def test_a_turn_near_the_end_of_a_segment(at, sign):
    """p' = (t - at) (1 + t / 2 + t^2 / 3), whose curvature may change its sign, integrated."""
    series = np.zeros(TERMS)
    slope = sign * Polynomial([-at, 1.0]) * Polynomial([1.0, 0.5, 1.0 / 3.0])
    series[: len(slope.coef) + 1] = slope.integ().coef
    assert ours(series, 1.0) == pytest.approx(true_range(series, 1.0), rel=0.0, abs=1e-15)


@pytest.mark.parametrize("far", [1.0, 30.0])
def test_the_one_turn_of_a_convex_segment(far):
    """Where the slope bends so much that Newton's step leaves the bracket, it is halved."""
    series = np.array([0.0, -1.0, 1.0, 0.0, *[far**n / n for n in range(4, TERMS)]])
    slope = Polynomial(series).deriv()
    root = next(r.real for r in slope.roots() if abs(r.imag) < 1e-9 and 0.0 < r.real < 1.0)
    assert only_turn(series, 1.0, slope(1.0)) == pytest.approx(Polynomial(series)(root), rel=0.0, abs=1e-15)


def test_what_stays_within_the_range_so_far_leaves_it_alone():
    series = random_series(np.random.default_rng(1), 0.3)
    low, high = true_range(series, 0.7)
    assert ours(series, 0.7, low - 0.5, high + 0.5) == (low - 0.5, high + 0.5)
    assert ours(series, 0.7, low - 0.5, high - 0.1) == pytest.approx((low - 0.5, high), rel=0.0, abs=1e-14)
    assert ours(series, 0.7, low + 0.1, high + 0.5) == pytest.approx((low, high + 0.5), rel=0.0, abs=1e-14)


WAVES = {
    "three levels": gp.StiffnessWave((0.0, 0.3, 0.75), (1.3, 0.6, 1.0)),
    "twelve levels": gp.StiffnessWave(tuple(np.arange(12) / 12), tuple(1.0 + 0.4 * np.sin(np.arange(12)))),
}
OSCILLATORS = {
    "baseline": gp.Oscillator(),
    "chaotic": gp.Oscillator(mesh_frequency=1.219),
    "slow": gp.Oscillator(mesh_frequency=0.3),
    "undamped": gp.Oscillator(damping_ratio=0.0),
    "overdamped": gp.Oscillator(damping_ratio=1.7, mesh_frequency=0.8),
    "unloaded": gp.Oscillator(mean_force=0.0, error_amplitude=0.6, mesh_frequency=0.7),
    **{name: gp.Oscillator(mesh_frequency=0.7, stiffness=wave) for name, wave in WAVES.items()},
}


@pytest.mark.parametrize("harmonics", [(), ((2, 0.02, 0.3), (5, 0.01, 0.1), (9, 0.005, 1.0))], ids=["one", "four"])
@pytest.mark.parametrize("name", OSCILLATORS)
def test_range_of_a_walk_is_that_of_all_its_segments(name, harmonics):
    """Whatever is passed over by a map, cell by cell or a block at once, has nothing new in it."""
    osc, n, series = OSCILLATORS[name].replace(harmonics=harmonics), 3, np.empty(TERMS)
    rng = np.random.default_rng(5)
    for start in rng.uniform((-4.0, -3.0), (4.0, 3.0), (6, 2)):
        segments, reach = Segments(np.empty((800, SEGMENT_COLUMNS)), np.zeros(1, np.int64)), np.empty(4)
        walk(osc.cells, *start, n, series, None, None, Details(segments=segments))
        assert segments.counts[0] <= len(segments.rows)
        rows = segments.rows[: segments.counts[0]]
        ends = np.where(rows[:, CROSSING] < 0.0, rows[:, REST], rows[:, CROSSING])
        ranges = [true_range(row[CROSSING + 1 :], end) for row, end in zip(rows, ends, strict=True)]
        begin_reach(reach, start[0])
        walk(osc.cells, *start, n, series, None, reach)
        assert tuple(reach[:2]) == pytest.approx((np.min(ranges), np.max(ranges)), rel=0.0, abs=1e-11)


@pytest.mark.parametrize("mesh_frequency", [0.7, 1.219])
def test_range_monodromy_and_contacts_in_one_pass(mesh_frequency):
    """One walk sees what trajectories show, and multiplies the matrix of a walk that gathers nothing else."""
    osc = gp.Oscillator(mesh_frequency=mesh_frequency)
    m, alone, reach, series = np.eye(2), np.eye(2), np.empty(4), np.empty(TERMS)
    begin_reach(reach, 2.0)
    assert walk(osc.cells, 2.0, 0.5, 6, series, m, reach) == walk(osc.cells, 2.0, 0.5, 6, series, alone)
    low, high, drive, coast = reach
    np.testing.assert_allclose(m, alone, rtol=1e-12)
    motion = gp.trajectory(osc, 2.0, 0.5, 6, samples_per_period=20_000)
    assert [low, high] == pytest.approx([motion.x.min(), motion.x.max()], abs=1e-6)
    assert low <= motion.x.min() and high >= motion.x.max()
    contacts = motion.impacts.side[motion.impacts.contact]
    assert (drive, coast) == (np.sum(contacts > 0), np.sum(contacts < 0))


def test_range_while_the_exponents_are_measured():
    """The block before the count belongs to it; it is the range that a walk alone sees, and holds all points."""
    osc, series = gp.Oscillator(mesh_frequency=1.219), np.empty(TERMS)
    measured, reach = np.empty(4), np.empty(4)
    exponents(osc.cells, 1.0, 0.0, 10, 200, 20, measured)
    begin_reach(reach, 1.0)
    walk(osc.cells, 1.0, 0.0, 210, series, None, reach)
    np.testing.assert_array_equal(measured, reach)
    state = gp.steady_state(osc, 1.0, 0.0, n_samples=256)
    assert state.status == "aperiodic"
    assert state.x_min <= state.points[:, 0].min() and state.points[:, 0].max() <= state.x_max


def test_newton_gives_up_where_nothing_is_stable():
    """At the unstable orbit of a flipped branch the trace is far from a stable one's."""
    osc, series, m = gp.Oscillator(mesh_frequency=1.219), np.empty(TERMS), np.empty((2, 2))
    orbit = next(o for o in gp.find_orbits(osc, 1) if abs(o.monodromy.trace()) > 2.0)
    converged, x, v, _residual = newton(osc.cells, *orbit.points[0], 1, m, series, 40, np.inf)
    assert converged and abs(np.trace(m)) == pytest.approx(abs(orbit.monodromy.trace()))
    below = 0.9 * abs(np.trace(m))
    converged, *_ = newton(osc.cells, x, v, 1, m, series, 40, below)
    assert not converged
