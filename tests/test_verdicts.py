"""The verdicts follow one rule, cover every item once, and agree with what is known independently."""

import numpy as np
import pytest

from gearpair import article as hy
from gearpair.article import published, verdicts
from gearpair.bifurcations import continue_orbit, periodic_orbit


@pytest.mark.parametrize(
    ("printed", "best", "word"),
    [
        (True, True, "confirmed"),
        (True, False, "corrected"),
        (False, True, "corrected"),
        (False, False, "refuted"),
    ],
)
def test_the_rule(printed, best, word):
    assert verdicts.judge(printed, best) == word
    assert verdicts.both("F1", ["a", "b"], [printed, best]) == verdicts.Verdict("F1", "a", "b", word)


@pytest.mark.parametrize(
    ("printed", "best", "word"),
    [
        (0.805, 0.804, "confirmed"),  # within 1 % of an axis of length 1
        (None, 0.804, "corrected"),
        (None, 0.84, "corrected"),  # another number, within 5 %
        (None, 0.86, "refuted"),
        (0.84, None, "refuted"),
        (None, None, "refuted"),
    ],
)
def test_the_rule_for_numbers(printed, best, word):
    assert verdicts.judge_number(printed, best, 0.8, 1.0) == word


def test_the_table_wants_every_item_exactly_once():
    items = [verdicts.Verdict(s.item, "", "", "vacuous") for s in published.STATEMENTS]
    assert [row[0] for row in hy.verdict_table(reversed(items)).rows] == [s.item for s in published.STATEMENTS]
    with pytest.raises(ValueError, match="look at F3"):
        hy.verdict_table([v for v in items if v.item != "F3"])
    with pytest.raises(ValueError, match="exactly once"):
        hy.verdict_table(items, items[:1])


@pytest.fixture(scope="module")
def swapped_changes():
    osc = hy.SWAPPED.oscillator(damping_ratio=0.01)
    third = continue_orbit(periodic_orbit(osc, 0.446, -0.347, 3), "damping_ratio", 0.0005, 0.03)
    return hy.period_two(hy.SWAPPED) + third.bifurcations


def test_the_swapped_reading_has_the_published_saddle_node(swapped_changes):
    """D4: period 3 ends at 0.0165 in a saddle-node; the exact fold lies within 1 % of the axis."""
    change = hy.nearest(0.0165, [b for b in swapped_changes if b.parameter == "damping_ratio"])
    assert (change.kind, change.period) == ("fold", 3)
    assert abs(change.value - 0.0165) < 0.01 * 0.025


def test_the_swapped_reading_has_the_published_doubling_to_period_4(swapped_changes):
    """F4: a doubling at 0.865; the exact flip of period 2 lies within 1 % of the axis."""
    change = hy.nearest(0.865, [b for b in swapped_changes if b.parameter == "mesh_frequency"])
    assert (change.kind, change.period) == ("flip", 2)
    assert abs(change.value - 0.865) < 0.01


def test_distance_is_certain_for_far_and_impossible_for_exact(swapped_changes):
    (fold,) = [b for b in swapped_changes if b.parameter == "damping_ratio" and b.kind == "fold"]
    distance, chance = hy.distance_from_bifurcations("damping_ratio", [fold])
    expected = np.mean([abs(b.value - fold.value) for b in published.DAMPING_BOUNDARIES])
    assert distance == pytest.approx(expected)
    assert 0.0 < chance < 1.0


def test_existence_in_the_swapped_reading_and_not_in_the_printed():
    reached = [
        hy.reached([hy.PRINTED, hy.SWAPPED], p, 20, n_discarded=200) for p in ("mesh_frequency", "damping_ratio")
    ]
    words = {v.item: v for v in hy.range_items(*zip(*reached, strict=True))}
    assert {words[item].verdict for item in ("F3", "F5", "F10", "F11", "D3")} == {"corrected"}
    assert words["F11"].best == "on all of it"
    assert "D1" not in words


def test_chaos_at_small_damping_is_a_transient():
    d1, d2 = hy.transient_items(hy.PRINTED, hy.SWAPPED)
    assert d1.verdict == d2.verdict == "refuted"
    assert d1.best == "after 30 000 periods chaotic at 0 of 5 values"


def test_one_period_two_impact_states():
    """I4: in the swapped reading every start leads to period 1, and yet to one of two impact states."""
    items = {v.item: v for v in hy.start_items(hy.PRINTED, hy.SWAPPED)}
    assert items["I4"].verdict == "corrected"
    assert items["I4"].best == "2 attractors, period 1: double and single_drive"
    assert items["C3"].verdict == "confirmed"


def test_statements_about_the_model():
    items = {v.item: v for v in hy.model_items(hy.PRINTED, hy.SWAPPED)}
    assert items["M5"].verdict == "refuted" and "0.9464" in items["M5"].printed and "0.7556" in items["M5"].best
    assert items["F14"].verdict == "vacuous"
    assert items["K2"].verdict == "corrected"
