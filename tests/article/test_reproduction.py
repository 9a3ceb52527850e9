"""The score of a reproduction is what its docstring says, on tables made by hand."""

import numpy as np
import pytest

from gearpair.article import published
from gearpair.article.case.scoring import FARTHEST, published_kind, published_motions, score
from gearpair.motion import periodic

PARAMETERS = ("mesh_frequency", "damping_ratio")


def table(parameter, cuts=None, motions=None, n=2001):
    """A staircase of motions on a fine grid; the published one where nothing is given."""
    ranges = published.ranges(parameter)
    cuts = [b.value for b in published.boundaries(parameter)] if cuts is None else cuts
    motions = [r.motion.period or 0 for r in ranges] if motions is None else motions
    values = np.linspace(ranges[0].lower, ranges[-1].upper, n)
    return values, np.array(motions)[np.searchsorted(cuts, values, side="right")]


@pytest.mark.parametrize("parameter", PARAMETERS)
def test_the_published_table_scores_one(parameter):
    perfect = score(parameter, *table(parameter))
    assert perfect.agreement == 1.0
    assert perfect.sequence == 1.0
    assert perfect.motions == published_motions(parameter)
    assert perfect.total == pytest.approx(1.0, abs=2e-3)  # the grid: half a step in each boundary
    assert all(abs(m.distance) < 1e-3 * (values := table(parameter)[0])[-1] for m in perfect.matches), values


@pytest.mark.parametrize(("index", "shift"), [(0, 0.02), (1, -0.03), (3, 0.05), (5, 0.1)])
def test_a_shifted_boundary_costs_what_the_docstring_says(index, shift):
    cuts = [b.value for b in published.FREQUENCY_BOUNDARIES]
    width = 1.0  # of the frequency axis
    cuts[index] += shift
    moved = score("mesh_frequency", *table("mesh_frequency", cuts))
    assert moved.agreement == pytest.approx(1.0 - abs(shift) / width, abs=1e-3)
    assert moved.closeness == pytest.approx(1.0 - abs(shift) / (FARTHEST * width) / len(cuts), abs=4e-3)
    assert moved.sequence == 1.0
    assert moved.matches[index].distance == pytest.approx(shift, abs=1e-3)


def test_a_table_of_one_motion():
    one = score("mesh_frequency", *table("mesh_frequency", [], [1]))
    shares = sum(r.upper - r.lower for r in published.FREQUENCY_RANGES if r.motion.period == 1)
    assert one.agreement == pytest.approx(shares, abs=1e-3)
    assert one.closeness == 0.0
    assert all(m.found is None and m.distance is None for m in one.matches)
    assert one.sequence == pytest.approx(2 * 1 / (1 + 7))
    assert one.motions == (periodic(1),)


def test_a_missing_range_costs_its_boundaries_and_part_of_the_sequence():
    cuts = [b.value for b in published.FREQUENCY_BOUNDARIES]
    motions = [1, 2, 2, 2, 0, 2, 1]  # the period-4 range drawn as period 2
    found = score("mesh_frequency", *table("mesh_frequency", cuts, motions))
    assert found.agreement == pytest.approx(1.0 - (1.028 - 0.865), abs=1e-3)
    assert [m.found is None for m in found.matches] == [False, True, True, False, False, False]
    assert found.sequence == pytest.approx(2 * 5 / (5 + 7))


def test_narrow_runs_are_dropped_and_their_neighbours_merged():
    cuts = [0.5 * (0.7 + 0.799), 0.5 * (0.7 + 0.799) + 0.015, *(b.value for b in published.FREQUENCY_BOUNDARIES)]
    motions = [1, 3, 1, 2, 4, 2, 0, 2, 1]
    found = score("mesh_frequency", *table("mesh_frequency", cuts, motions))
    assert found.motions == published_motions("mesh_frequency")
    assert found.agreement == pytest.approx(1.0 - 0.015, abs=1e-3)


def test_which_chaos_it_is_does_not_matter():
    """Inside the complex zone any period but 1, 2 and 4 counts as complex, so chaos-dependent noise cannot enter."""
    values, motions = table("mesh_frequency")
    noisy = motions.copy()
    zone = np.flatnonzero(motions == 0)
    noisy[zone] = np.random.default_rng(1).choice([0, 3, 5, 6, 8, 12], zone.size)
    assert score("mesh_frequency", values, noisy) == score("mesh_frequency", values, motions)


def test_kinds_are_the_article_s():
    other, none = published.COMPLEX, published.CHAOTIC
    frequency = [published_kind(period, "mesh_frequency") for period in (0, 1, 2, 3, 4, 6)]
    assert frequency == [other, periodic(1), periodic(2), other, periodic(4), other]
    damping = [published_kind(period, "damping_ratio") for period in (0, 1, 2, 3, 12)]
    assert damping == [none, *map(periodic, (1, 2, 3, 12))]


@pytest.mark.parametrize(
    ("parameter", "values", "motions", "message"),
    [
        ("a", [0.0, 1.0], [1, 1], "got 'a'"),
        ("mesh_frequency", [1.0, 0.9], [1, 1], "must ascend"),
        ("mesh_frequency", [0.7, 1.0], [1], "one per period"),
        ("mesh_frequency", [0.7], [1], "at least 2"),
    ],
)
def test_bad_tables_are_refused(parameter, values, motions, message):
    with pytest.raises(ValueError, match=message):
        score(parameter, values, motions)
