"""Capture: neighbourhoods that no motion leaves, and labels that full settling confirms."""

import numpy as np
import pytest

import gearpair as gp
from benchmarks.labels import Case, cases, compare
from gearpair import _cores
from gearpair._flow.capture import COLUMNS, OWNER, QVV, QXV, QXX, inside, surround
from gearpair._flow.closed_form import TERMS
from gearpair._flow.states import APERIODIC, GONE, PERIODIC, TRANSIENT
from gearpair.ensembles.capture import (
    POOL,
    found_in,
    known_attractors,
    number_attractors,
    numbered,
    scouts,
    with_sets,
)
from gearpair.ensembles.chaos import chaotic_sets, observed_in
from gearpair.ensembles.datasets import settled_columns
from gearpair.motion.settling import MANY, SettleSettings, settle_batch
from tests.support.oscillators import level

BASELINE = gp.Oscillator()
CYCLES = {
    "rattle": (BASELINE, 1.0, 0.0),
    "clatter": (BASELINE, -2.0, 1.5),
    "period 3": (BASELINE.replace(mesh_frequency=1.3), 1.0, 0.0),
    "weak damping": (BASELINE.replace(damping_ratio=0.001), 1.0, 0.0),
    "strong damping": (BASELINE.replace(damping_ratio=0.5), 1.0, 0.0),
}


def neighbourhoods(osc, x, v):
    state = gp.steady_state(osc, x, v)
    rows = np.empty((state.period, COLUMNS))
    assert surround(osc.cells, *map(float, state.points[0]), state.period, 0.0, rows, np.empty(TERMS))
    return state, rows


def edge(row, n):
    """Points on the rim of a neighbourhood."""
    form = np.array([[row[QXX], row[QXV]], [row[QXV], row[QVV]]])
    angles = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False)
    return row[:2] + np.linalg.solve(np.linalg.cholesky(form).T, np.stack([np.cos(angles), np.sin(angles)])).T


def size(row, points):
    """The neighbourhood's form at points: 1 on its rim."""
    dx, dv = (points - row[:2]).T
    return row[QXX] * dx**2 + 2.0 * row[QXV] * dx * dv + row[QVV] * dv**2


@pytest.mark.parametrize(("osc", "x", "v"), CYCLES.values(), ids=CYCLES)
def test_a_neighbourhood_is_mapped_into_itself(osc, x, v):
    """The rim bounds the image of what lies within, for the map is one to one; and both phases lead to the cycle."""
    state, rows = neighbourhoods(osc, x, v)
    for row in rows:
        rim = edge(row, 720)
        np.testing.assert_allclose(size(row, rim), 1.0, rtol=1e-9)
        image = np.stack(gp.stroboscopic_map(osc, rim[:, 0], rim[:, 1], state.period), axis=1)
        assert size(row, image).max() < 1.0
    n = state.period * (40 + int(3.0 / osc.damping_ratio))
    far = np.stack(gp.stroboscopic_map(osc, *edge(rows[0], 50).T, n), axis=1)
    assert np.abs(far - state.points[0]).max() < 1e-6


def test_the_certificate_is_not_idle():
    """Neighbourhoods are of a useful size, and one some times as large is no longer mapped into itself."""
    state, rows = neighbourhoods(BASELINE, 1.0, 0.0)
    assert 1e-3 < (rows[0, QXX] * rows[0, QVV] - rows[0, QXV] ** 2) ** -0.25 < 0.1
    swollen = rows[0].copy()
    swollen[2:5] /= 300.0**2
    rim = edge(swollen, 720)
    image = np.stack(gp.stroboscopic_map(BASELINE, rim[:, 0], rim[:, 1], state.period), axis=1)
    assert size(swollen, image).max() > 1.0


def test_inside_finds_the_first_that_holds_a_state():
    _, rows = neighbourhoods(BASELINE, 1.0, 0.0)
    for k, row in enumerate(rows):
        assert inside(rows, len(rows), row[0], row[1]) == k
        out, within = edge(row, 8) * 1.0, row[:2] + 0.999 * (edge(row, 8) - row[:2])
        out = row[:2] + 1.001 * (out - row[:2])
        assert all(inside(rows, len(rows), *map(float, p)) == k for p in within)
        assert all(inside(rows, len(rows), *map(float, p)) == -1 for p in out)
    assert np.all(rows[:, OWNER] == 0.0)


@pytest.mark.parametrize("case", [0, 3, 9, 11])
def test_no_label_is_changed(case):
    """Weak damping, chaos and escape among them; `python -m benchmarks.labels` does it for 10^5 starts of twelve."""
    chosen = cases()[case]
    got = compare(chosen, 150, seed=case)
    assert (got.changed, got.missed) == (0, 0)
    assert sum(got.statuses.values()) == 150


def test_a_wrong_label_is_noticed():
    """The comparison itself: with every start of the period-2 basin called period 1, it finds them."""
    osc = BASELINE
    starts = np.random.default_rng(3).uniform(-1.0, 1.0, (100, 2)) * (4.0, 3.0)
    settings = SettleSettings(n_samples=64)
    known = known_attractors(osc, starts, settings)
    one = int(np.flatnonzero(known.settled.period == 1)[0])
    lying = known._replace(
        neighbourhoods=known.neighbourhoods * np.array([1, 1, 1e-8, 1e-8, 1e-8, 0, 1]) + [0, 0, 0, 0, 0, one, 0]
    )
    assert np.all(settle_batch([osc], starts, settings, known=lying).period == 1)
    assert compare(Case("honest", osc), 100, seed=3).changed == 0


@pytest.mark.slow
def test_basins_do_not_depend_on_threads_or_order(monkeypatch):
    osc = BASELINE.replace(mesh_frequency=0.9)
    x, v = np.linspace(-3.0, 3.0, 24), np.linspace(-2.0, 2.0, 16)
    plain = gp.basins(osc, x, v, n_exponent=100)
    monkeypatch.setattr(_cores.config, "NUMBA_NUM_THREADS", 1)
    assert gp.basins(osc, x, v, n_exponent=100).identical(plain)
    starts = np.stack(np.meshgrid(x, v), axis=-1).reshape(-1, 2)
    settings = SettleSettings(n_exponent=100, n_samples=1)
    known = known_attractors(osc, starts[scouts(len(starts))], settings)
    shuffled = np.random.default_rng(0).permutation(len(starts))
    there, back = (
        settle_batch([osc], starts, settings, known=known),
        settle_batch([osc], starts[shuffled], settings, known=known),
    )
    for one, other in zip(there, back, strict=True):
        np.testing.assert_array_equal(one[shuffled], other)


def test_the_way_to_the_attractor_is_what_the_trajectory_shows():
    osc = BASELINE
    plane = gp.basins(osc, np.linspace(-4, 4, 9), np.linspace(-3, 3, 5))
    for j, i in ((0, 0), (2, 8), (4, 3), (1, 5)):
        start = float(plane.x[i]), float(plane.v[j])
        n = int(plane.settling_time[j, i])
        motion = gp.trajectory(osc, *start, n, samples_per_period=500)
        assert int(plane.impacts_before[j, i]) == int(motion.impacts.contact.sum())
        low = min(motion.x.min(), float(plane.x_min[j, i]))
        high = max(motion.x.max(), float(plane.x_max[j, i]))
        assert float(plane.largest_displacement[j, i]) == pytest.approx(max(-low, high), abs=2e-3)
        assert plane.worst_impact_state[j, i] == gp.impact_state(low, high)
        cycle = gp.steady_state(osc, *start).points
        assert np.abs(cycle - (motion.x[-1], motion.v[-1])).max(axis=1).min() < 0.1


def chaotic(low, high, exponent, status=None, lasted=None):
    """Columns of motions that were chaotic after 1000 mesh periods, told by their ranges and exponents."""
    n = len(low)
    columns = {
        "status": np.full(n, APERIODIC) if status is None else np.array(status),
        "period": np.zeros(n, np.int64),
        "section_x": np.full(n, np.nan),
        "section_v": np.full(n, np.nan),
        "lasted": np.full(n, 21_000) if lasted is None else np.array(lasted),
    }
    for name, column in (("x_min", low), ("x_max", high), ("exponent", exponent)):
        columns[name] = columns[f"chaos_{name}"] = np.array(column)
    return columns | {"smallest_exponent": -0.1 - columns["exponent"]}


MIRRORED = [-0.2, -2.1, -0.1, -2.2, -0.3], [2.1, 0.2, 2.2, 0.1, 2.0], [0.08, 0.08, 0.09, 0.08, 0.07]
NOTHING = np.empty((0, 4))


def test_chaotic_sets_that_differ_are_told_apart():
    """Two sets of one flank each, the mirror images of each other; and one that is more chaotic."""
    result = numbered(chaotic(*MIRRORED), 1000, NOTHING)
    assert result.columns["attractor"].tolist() == [1, 0, 1, 0, 1]
    assert result.table["counts"].tolist() == [2, 3]
    assert result.table["x_min"].tolist() == [-2.2, -0.3] and result.table["x_max"].tolist() == [0.2, 2.2]
    assert result.table["exponent"] == pytest.approx([0.08, 0.08])
    assert result.table["smallest_exponent"] == pytest.approx([-0.18, -0.18])  # of the same set, though of its mean
    apart = numbered(chaotic(*MIRRORED[:2], [0.08, 0.08, 0.38, 0.08, 0.07]), 1000, NOTHING)
    assert len(np.unique(apart.columns["attractor"])) == 3
    for low, high in (([-0.2, -2.1], [2.0, 2.0]), ([-0.2, -0.2], [2.0, 0.2])):
        assert len(numbered(chaotic(low, high, [0.08, 0.08]), 1000, NOTHING).table["counts"]) == 2


def test_a_set_that_one_motion_has_left_is_no_attractor():
    """The third of the mirrored motions settles at last: its set is a transient, the other one is not."""
    status, lasted = np.full(5, APERIODIC), np.full(5, 21_000)
    status[2], lasted[2] = PERIODIC, 5000
    columns = chaotic(*MIRRORED, status, lasted)
    columns["period"][2], columns["section_x"][2], columns["section_v"][2] = 2, 0.1, 0.2
    result = numbered(columns, 1000, NOTHING)
    assert result.columns["status"].tolist() == [TRANSIENT, APERIODIC, PERIODIC, APERIODIC, TRANSIENT]
    assert result.columns["attractor"].tolist() == [-1, 1, 0, 1, -1]
    assert result.columns["chaotic_set"].tolist() == [1, 0, 1, 0, 1]
    assert result.leads_to.tolist() == [[0, 0], [1, 0]]
    lasting, transient = result.sets.rates
    assert (lasting.n_watched, lasting.watched_periods, lasting.escapes) == (2, 40_000, 0)
    assert lasting.mean_life_low == pytest.approx(40_000 / -np.log(0.05))
    assert (transient.n_watched, transient.watched_periods, transient.escapes) == (3, 44_000, 1)


def test_what_settles_before_the_watch_has_left_no_set_and_what_was_never_chaotic_neither():
    status, lasted = [PERIODIC, APERIODIC, PERIODIC, GONE, APERIODIC], [1000, 21_000, 5000, 5000, 21_000]
    columns = chaotic([-0.1] * 5, [2.0] * 5, [0.08, 0.08, -0.02, 0.08, 0.08], status, lasted)
    result = numbered(columns, 1000, NOTHING)
    assert result.columns["chaotic_set"].tolist() == [-1, 0, -1, 0, 0]
    assert result.sets.rates[0].escapes == 1 and not result.leads_to.any()


def test_what_scouts_have_watched_counts_for_the_set_and_not_as_motions():
    scouts_saw = np.array([[-0.15, 2.05, 0.08, 500_000.0], [-0.25, 2.15, 0.08, 500_000.0]])
    columns = chaotic(*(np.array(column)[[0, 2, 4]] for column in MIRRORED), lasted=[1000, 1000, 1000])
    result = numbered(columns, 1000, scouts_saw)
    (rate,) = result.sets.rates
    assert (rate.n_watched, rate.watched_periods) == (2, 1_000_000)
    assert result.table["counts"].tolist() == [3] and result.table["exponent"] == pytest.approx([0.08])


def test_where_many_scouts_find_lasting_chaos_the_others_are_not_watched():
    osc = BASELINE.replace(mesh_frequency=1.219)
    plane = gp.basins(osc, np.linspace(-3.0, 3.0, 16), np.linspace(-2.0, 2.0, 12))
    still = plane.lasted.values[plane.status.values == "aperiodic"]
    assert still.size > 80 and np.all(still == MANY.before_watch(osc))
    assert plane.set_persistence.values.tolist() == ["lasting"]
    assert int(plane.set_watched_periods[0]) >= POOL and float(plane.set_mean_life_low[0]) > POOL / 3.0
    assert plane.set_still.values.tolist() == [still.size]
    few = gp.basins(osc, np.linspace(-3.0, 3.0, 5), np.linspace(-2.0, 2.0, 4))
    alone = few.lasted.values[few.status.values == "aperiodic"]
    assert alone.size > 5 and np.all(alone == MANY.before_watch(osc) + MANY.n_watch)


def test_numbering_does_not_depend_on_how_the_starts_are_cut():
    osc = BASELINE.replace(mesh_frequency=1.6)
    starts = np.random.default_rng(5).uniform(-3.0, 3.0, (200, 2))
    settings = SettleSettings(n_exponent=500, n_watch=5000, n_samples=1)
    discard = settings.before_watch(osc)
    columns = settled_columns(settle_batch([osc], starts, settings))
    whole = numbered(columns, discard, NOTHING)
    assert {PERIODIC, TRANSIENT} == set(whole.columns["status"].tolist())
    parts = [{name: c[part] for name, c in columns.items()} for part in (slice(0, 70), slice(70, 200))]
    sets = chaotic_sets([observed_in(part, discard) for part in parts])
    judged = [with_sets(sets, part, discard) for part in parts]
    found = [found_in(part, offset) for part, offset in zip(judged, (0, 70), strict=True)]
    numbers, again = number_attractors([each for each, _ in found], sets)
    joined = np.concatenate([n[places] for n, (_, places) in zip(numbers, found, strict=True)])
    np.testing.assert_array_equal(joined, whole.columns["attractor"])
    for name, column in whole.table.items():
        np.testing.assert_array_equal(again[name], column)
    for ours, theirs in zip(sets.observed, whole.sets.observed, strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-12)


def test_a_batch_tells_the_most_that_it_may_take_before_it_starts(capsys):
    """Without damping there is nothing to wait for: 500 mesh periods, and the 30 of the exponents."""
    osc = BASELINE.replace(damping_ratio=0.0)
    gp.basins(osc, np.linspace(-2, 2, 10), np.linspace(-1, 1, 10), n_exponent=30, progress=True)
    assert "at most 5.3e+04 mesh periods:   0%" in capsys.readouterr().err
    gp.parameter_map(osc, {"mesh_frequency": [0.7, 0.8]}, most_work=1000, progress=True)
    assert "at most 1.0e+03 mesh periods:   0%" in capsys.readouterr().err


def test_without_damping_the_limit_on_work_ends_it():
    """Nothing settles; with a limit each start gets its share."""
    osc = BASELINE.replace(damping_ratio=0.0)
    plane = gp.basins(osc, np.linspace(-2, 2, 20), np.linspace(-1, 1, 10), most_work=20_000)
    assert set(np.unique(plane.status)) <= {"exhausted", "escaped"}
    assert float((plane.status == "exhausted").mean()) > 0.9
    assert np.all(plane.attractor == -1)
    grid = gp.parameter_map(osc, {"mesh_frequency": [0.7, 0.8]}, most_work=1000)
    assert grid.status.values.tolist() == ["exhausted"] * 2
    enough = gp.basins(BASELINE, [0.0, 1.0], [0.0], most_work=10**6)
    assert np.all(enough.status == "periodic")
    with pytest.raises(ValueError, match="most_work must be a whole number of at least 1, got 0"):
        gp.basins(osc, [0.0], [0.0], most_work=0)


def test_the_cycle_of_a_linear_pair_captures_everything_at_once():
    """Far from both boundaries the neighbourhood is large: half the backlash."""
    osc = level(0.9, mean_force=4.0, damping_ratio=0.1, mesh_frequency=1.3)
    _, rows = neighbourhoods(osc, 5.0, 0.0)
    assert (rows[0, QXX] * rows[0, QVV] - rows[0, QXV] ** 2) ** -0.25 > 0.4
