"""What a walk gathers, against an integration by scipy that shares nothing with it; quick in plain Python, too."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gearpair as gp
from gearpair._flow.closed_form import TERMS
from gearpair._flow.measures import N_MEASURES
from gearpair._flow.newton import minimal_period
from gearpair._flow.observe import exponents, measure
from gearpair._flow.reach import begin_reach
from gearpair._flow.records import SEGMENT_COLUMNS, Extrema, Samples, Segments
from gearpair._flow.walk import ESCAPED, OK, Details, walk
from gearpair.motion.measures import measure_columns
from tests.support.reference import right_hand_side

# Three levels; strikes both flanks and grazes neither. With a higher harmonic a block has several cells.
CLATTER = gp.Oscillator(
    mean_force=0.05,
    error_amplitude=0.6,
    damping_ratio=0.03,
    mesh_frequency=0.7,
    stiffness=gp.StiffnessWave((0.0, 0.3, 0.75), (1.3, 0.6, 1.0)),
)
CASES = {"one harmonic": CLATTER, "two harmonics": CLATTER.replace(harmonics=((5, 0.02, 0.3),))}
START, N = (-2.0, 1.5), 3
GRID = 20_000  # points of the reference in a mesh period


@pytest.fixture(scope="module", params=CASES.values(), ids=CASES)
def motion(request):
    """Oscillator, and times (in mesh periods), X, X' of the reference on a fine grid."""
    osc = request.param
    t = np.linspace(0.0, N, N * GRID + 1)
    run = solve_ivp(
        right_hand_side(osc), (0.0, N * osc.period), START, "DOP853", t * osc.period, rtol=1e-10, atol=1e-11,
        max_step=osc.period / 300,
    )  # fmt: skip
    return osc, t, *run.y


def walked(osc, details=None, m=None, reach=None):
    status, x, v = walk(osc.cells, *START, N, np.empty(TERMS), m, reach, details)
    assert status == OK
    return x, v


def crossings(t, x, v):
    """(time, side, velocity, contact) of every crossing of X = +-1 on the grid, by chords."""
    found = []
    for side in (1.0, -1.0):
        for i in np.flatnonzero(np.diff(np.sign(x - side))):
            share = (side - x[i]) / (x[i + 1] - x[i])
            speed = v[i] + share * (v[i + 1] - v[i])
            found.append((t[i] + share * (t[i + 1] - t[i]), side, speed, float(speed * side > 0.0)))
    return np.array(sorted(found))


def test_samples_and_crossings(motion):
    osc, t, x, v = motion
    expected = crossings(t, x, v)
    assert {*expected[:, 1]} == {1.0, -1.0}
    samples, counts = Samples(50, np.empty((N * 50, 2)), np.empty((100, 4)), np.zeros(2, np.int64)), None
    end = walked(osc, Details(samples=samples))
    counts = samples.counts.tolist()
    assert counts == [N * 50, len(expected)]
    np.testing.assert_allclose(samples.values, np.stack([x, v], 1)[: -1 : GRID // 50], rtol=0.0, atol=2e-6)
    np.testing.assert_allclose(end, (x[-1], v[-1]), rtol=0.0, atol=2e-6)
    np.testing.assert_allclose(samples.crossings[: counts[1]], expected, rtol=0.0, atol=2e-6)


def test_no_rows_count_all_the_same(motion):
    osc, t, x, v = motion
    for kind, rows in ((Segments, np.empty((0, SEGMENT_COLUMNS))), (Samples, np.empty((0, 4)))):
        counts = np.zeros(2, np.int64)
        given = Segments(rows, counts) if kind is Segments else Samples(1, np.empty((N, 2)), rows, counts)
        walked(osc, Details(**{kind.__name__.lower(): given}))
        n = len(crossings(t, x, v))
        assert counts.tolist() == ([n + N * len(osc.cells.level), 0] if kind is Segments else [N, n])


def test_segments_join_and_hold_the_motion(motion):
    osc, t, x, _v = motion
    rows, counts = np.empty((500, SEGMENT_COLUMNS)), np.zeros(1, np.int64)
    walked(osc, Details(segments=Segments(rows, counts)))
    rows = rows[: counts[0]]
    starts, width, region, rest, fourth, crossing = rows[:, :6].T
    lasts = np.where(crossing < 0.0, rest, crossing)
    np.testing.assert_allclose(starts + lasts * width, np.append(starts[1:], N), rtol=0.0, atol=1e-12)
    ends = [np.polynomial.polynomial.polyval(last, row[6:]) for row, last in zip(rows, lasts, strict=True)]
    np.testing.assert_allclose(ends[:-1], rows[1:, 6], rtol=0.0, atol=1e-12)
    middle = np.interp(starts + 0.5 * lasts * width, t, x)
    assert np.array_equal(region, np.where(middle > 1.0, 1, np.where(middle < -1.0, -1, 0)))
    bends = np.polynomial.polynomial.polyder(rows[:, 6:].T, 4)
    largest = [
        np.abs(np.polynomial.polynomial.polyval(np.linspace(0, r, 9), b)).max()
        for r, b in zip(rest, bends.T, strict=True)
    ]
    assert np.all(fourth >= np.array(largest) * (1.0 - 1e-9)) and np.all(fourth < 40.0 * np.array(largest) + 1e-3)


def test_extrema_and_contacts(motion):
    osc, t, x, v = motion
    turns = np.flatnonzero(np.diff(np.sign(v)))
    found = Extrema(np.empty((100, 2)), np.zeros(3, np.int64))
    walked(osc, Details(extrema=found))
    contacts = crossings(t, x, v)
    sides = contacts[contacts[:, 3] == 1.0, 1]
    assert found.counts.tolist() == [len(turns), np.sum(sides > 0.0), np.sum(sides < 0.0)]
    np.testing.assert_allclose(found.rows[: len(turns)], np.stack([t[turns], x[turns]], 1), rtol=0.0, atol=1e-4)


def test_reach(motion):
    osc, t, x, v = motion
    reach = np.empty(4)
    begin_reach(reach, START[0])
    walked(osc, reach=reach)
    contacts = crossings(t, x, v)
    sides = contacts[contacts[:, 3] == 1.0, 1]
    expected = x.min(), x.max(), np.sum(sides > 0.0), np.sum(sides < 0.0)
    np.testing.assert_allclose(reach, expected, rtol=0.0, atol=2e-6)


@pytest.mark.parametrize("with_reach", [False, True])
def test_monodromy_is_the_derivative(motion, with_reach):
    osc, *_ = motion
    m, reach, h = np.eye(2), np.empty(4), 1e-6
    begin_reach(reach, START[0])
    walked(osc, m=m, reach=reach if with_reach else None)
    columns = []
    for step in ((h, 0.0), (0.0, h)):
        ends = [walk(osc.cells, START[0] + s * step[0], START[1] + s * step[1], N, np.empty(TERMS)) for s in (1, -1)]
        columns.append((np.array(ends[0][1:]) - np.array(ends[1][1:])) / (2.0 * h))
    np.testing.assert_allclose(m, np.array(columns).T, rtol=0.0, atol=1e-7 * np.abs(m).max())
    assert np.linalg.det(m) == pytest.approx(np.exp(-2.0 * osc.damping_ratio * N * osc.period), rel=1e-10)


def test_measures(motion):
    osc, t, x, v = motion
    row = np.empty(N_MEASURES)
    assert measure(osc.cells, *START, N, np.empty(TERMS), row) == OK
    ours = {name: float(c[0]) for name, c in measure_columns(row[None], np.array([osc.mean_force])).items()}
    k, tau, contacts = osc.stiffness(t), t * osc.period, crossings(t, x, v)
    for side, name in ((1.0, "drive"), (-1.0, "coast")):
        press, blows = k * np.maximum(side * x - 1.0, 0.0), contacts[(contacts[:, 1] == side) & (contacts[:, 3] == 1.0)]
        expected = {
            "impacts": len(blows) / N,
            "velocity": np.abs(blows[:, 2]).max(),
            "velocity_mean": np.abs(blows[:, 2]).mean(),
            "impulse": np.trapezoid(press, tau) / N,
            "share": np.mean(side * x > 1.0),
            "force": press.max(),
        }
        for what, value in expected.items():
            assert ours[f"{name}_{what}"] == pytest.approx(value, rel=5e-4), what
    assert ours["x_mean"] == pytest.approx(np.trapezoid(x, t) / N, abs=1e-6)
    assert ours["x_rms"] == pytest.approx(np.sqrt(np.trapezoid((x - ours["x_mean"]) ** 2, t) / N), abs=1e-6)
    assert ours["peak_to_peak"] == pytest.approx(np.ptp(x), abs=2e-6)


def test_the_exponent_is_the_growth_of_the_direction_that_the_turn_leaves(motion):
    osc, *_ = motion
    reach, matrices, here = np.empty(4), [], START
    for _ in range(7):
        m = np.eye(2)
        _status, *here = walk(osc.cells, *here, 1, np.empty(TERMS), m)
        matrices.append(m)
    status, x, v, largest, error = exponents(osc.cells, *START, 1, 6, 3, reach)
    assert (status, x, v) == pytest.approx((OK, *here), rel=1e-12)
    direction = matrices[0] @ [1.0, 0.0]
    lengths = [np.linalg.norm(direction)]
    for m in matrices[1:]:
        direction = m @ direction
        lengths.append(np.linalg.norm(direction))
    rates = np.diff(np.log(lengths)[::2]) / (2.0 * osc.period)
    assert largest == pytest.approx(rates.mean(), abs=1e-10)
    assert error == pytest.approx(np.std(rates, ddof=1) / np.sqrt(3), abs=1e-10)


def test_a_walk_ends_where_the_motion_escapes():
    """Always in contact, and parametrically unstable; the state reached is the one at the end of that mesh period."""
    osc = gp.Oscillator(mesh_frequency=1.95, damping_ratio=0.001)
    status, x, v = walk(osc.cells, 2e6, 0.0, 5, np.empty(TERMS))
    assert status == ESCAPED
    assert (x, v) == walk(osc.cells._replace(escape_radius=np.inf), 2e6, 0.0, 1, np.empty(TERMS))[1:]
    assert walk(gp.Oscillator().cells, 2e6, 0.0, 1, np.empty(TERMS))[0] == OK


def test_the_minimal_period_divides_the_one_it_is_found_with():
    osc = gp.Oscillator()
    x, v = gp.steady_state(osc).points[0]
    assert [minimal_period(osc.cells, x, v, n, np.empty(TERMS)) for n in (2, 4, 6)] == [2, 2, 2]
