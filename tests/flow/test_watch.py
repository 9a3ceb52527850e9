"""The watch: a motion is followed as by the map until a neighbourhood holds it; quick in plain Python, too."""

import numpy as np
import pytest

import gearpair as gp
from gearpair._flow.capture import COLUMNS, inside
from gearpair._flow.closed_form import TERMS
from gearpair._flow.walk import ESCAPED, OK
from gearpair._flow.watch import Watched, watch, watch_starts
from gearpair.ensembles.capture import known_attractors
from gearpair.motion.settling import MANY

DAMPED = gp.Oscillator(damping_ratio=0.1)
NOWHERE = np.empty((0, COLUMNS))


def neighbourhoods(osc):
    return known_attractors(osc, np.array([[1.0, 0.0]]), MANY).neighbourhoods


def watching(starts):
    n = len(starts)
    return Watched(np.full(n, OK), np.full(n, -1), np.zeros(n, np.int64), np.array(starts, dtype=float))


def test_a_motion_is_watched_until_the_first_period_in_which_a_neighbourhood_holds_it():
    rows = neighbourhoods(DAMPED)
    status, owner, periods, x, v = watch(DAMPED.cells, 2.0, 1.0, 1000, rows, np.empty(TERMS))
    assert (status, owner) == (OK, 0) and 1 < periods < 100
    way = [(2.0, 1.0)]
    for _ in range(periods):
        way.append(tuple(map(float, gp.stroboscopic_map(DAMPED, *way[-1]))))
    assert way[-1] == pytest.approx((x, v), abs=1e-12)
    assert [inside(rows, len(rows), *point) for point in way] == [-1] * periods + [0]


def test_a_watch_that_captures_nothing_is_the_map():
    status, owner, periods, x, v = watch(DAMPED.cells, 2.0, 1.0, 20, NOWHERE, np.empty(TERMS))
    assert (status, owner, periods) == (OK, -1, 20)
    np.testing.assert_allclose((x, v), gp.stroboscopic_map(DAMPED, 2.0, 1.0, 20), rtol=0.0, atol=1e-12)


def test_what_is_held_from_the_beginning_is_not_followed():
    rows = neighbourhoods(DAMPED)
    x, v = rows[0, :2].tolist()
    assert watch(DAMPED.cells, x, v, 10, rows, np.empty(TERMS)) == (OK, 0, 0, x, v)


def test_rows_go_on_from_where_they_stand_and_those_that_have_ended_stay():
    rows, starts = neighbourhoods(DAMPED), [(2.0, 1.0), (-3.0, 0.5), (0.5, -2.0)]
    whole, parts = watching(starts), watching(starts)
    watch_starts(0, 3, DAMPED.cells, rows, 300, whole)
    for _ in range(100):
        watch_starts(0, 3, DAMPED.cells, rows, 3, parts)
    for one, other in zip(whole, parts, strict=True):
        np.testing.assert_array_equal(one, other)
    assert np.all(whole.owner == 0) and len(set(whole.periods.tolist())) > 1


def test_a_motion_that_grows_without_bound_ends_in_the_period_in_which_it_does():
    escaping = gp.Oscillator(mesh_frequency=1.95, damping_ratio=0.001)
    alone = watching([(3e5, 0.0), (3e5, 0.0)])
    watch_starts(0, 1, escaping.cells, NOWHERE, 10_000, alone)
    assert alone.status.tolist() == [ESCAPED, OK]
    periods = int(alone.periods[0])
    before, after = (gp.stroboscopic_map(escaping, 3e5, 0.0, n)[0] for n in (periods - 1, periods))
    assert np.isfinite(before) and np.isinf(after)
