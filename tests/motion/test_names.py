"""A motion is one value: compared, ordered and counted as such, and text only where it is shown."""

import itertools

import numpy as np
import xarray as xr

import gearpair as gp
from gearpair.article.published import CHAOTIC, COMPLEX
from gearpair.ensembles import MotionRange, joined_ranges
from gearpair.motion import CHAOS, Motion, motions_of, periodic

DOUBLE, SINGLE = gp.ImpactState.DOUBLE, gp.ImpactState.SINGLE_DRIVE


def test_periodic_motions_come_first_by_period_then_chaos_then_the_rest():
    """Numbers are ordered as numbers: period 10 comes after period 2, as text it would not."""
    expected = [periodic(1), periodic(2), periodic(10), CHAOS, Motion("escaped"), Motion("unsettled")]
    for some in itertools.permutations(expected):
        assert sorted(some) == expected


def test_the_impact_state_orders_what_has_one_period():
    assert sorted([periodic(2, SINGLE), periodic(2), periodic(1, SINGLE), periodic(2, DOUBLE)]) == [
        periodic(1, SINGLE), periodic(2), periodic(2, DOUBLE), periodic(2, SINGLE),
    ]  # fmt: skip


def test_text_is_made_where_it_is_shown():
    shown = [periodic(3), periodic(2, DOUBLE), CHAOS, Motion("escaped"), COMPLEX, CHAOTIC]
    assert list(map(str, shown)) == ["period 3", "period 2, double-sided", "chaos", "escaped", "complex", "chaotic"]


def test_one_motion_is_one_key():
    """A status read from a dataset is text, one from the kernels an enumeration: both are the same motion."""
    assert {periodic(2): 1}[Motion("periodic", 2)] == 1
    assert Motion("aperiodic") == CHAOS != CHAOTIC
    assert periodic(2, DOUBLE) != periodic(2) == periodic(2, DOUBLE).kind


def test_motions_keep_the_shape_of_their_result():
    result = xr.Dataset(
        {
            "status": (("v", "x"), [["periodic", "aperiodic"], ["escaped", "periodic"], ["periodic", "unsettled"]]),
            "period": (("v", "x"), [[2, 0], [0, 1], [2, 0]]),
        }
    )
    motions = motions_of(result)
    assert motions.shape == (3, 2)
    assert np.array_equal(motions == periodic(2), [[True, False], [False, False], [True, False]])
    assert motions[1, 0] == Motion("escaped") and motions[1, 0].period is None


def test_a_settled_motion_and_its_orbit_are_the_same_motion():
    state = gp.steady_state(gp.Oscillator())
    orbit = gp.periodic_orbit(state.oscillator, *map(float, state.points[0]), state.period)
    assert state.motion == orbit.motion == periodic(2, SINGLE)


def test_ranges_are_joined_by_motion_whatever_their_order():
    """Against the union of intervals, told on a fine grid; one contains another, two touch, two stay apart."""
    ranges = [
        MotionRange(0.0, 4.0, CHAOS), MotionRange(1.0, 2.0, CHAOS), MotionRange(4.0, 5.0, CHAOS),
        MotionRange(7.0, 8.0, CHAOS), MotionRange(3.0, 7.5, periodic(2)), MotionRange(0.0, 0.5, periodic(1)),
    ]  # fmt: skip
    expected = (
        MotionRange(0.0, 0.5, periodic(1)), MotionRange(0.0, 5.0, CHAOS), MotionRange(3.0, 7.5, periodic(2)),
        MotionRange(7.0, 8.0, CHAOS),
    )  # fmt: skip
    for some in itertools.permutations(ranges):
        assert joined_ranges(some) == expected
