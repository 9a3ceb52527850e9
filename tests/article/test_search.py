"""A search through many settings meets boundaries by chance, and knows how many."""

from dataclasses import replace

import numpy as np
import pytest

from gearpair import article
from gearpair.article import case, published
from gearpair.methods import Integrator


def drawn(shifts, integrator=None):
    """A trial whose two tables are the published ones with boundaries shifted, in units of their tolerances."""
    scores, k = [], 0
    for parameter, tolerance in case.TOLERANCES.items():
        ranges, values = published.ranges(parameter), case.axis(parameter, 20001)
        cuts = []
        for boundary in published.boundaries(parameter):
            cuts.append(boundary.value + shifts[k] * tolerance)
            k += 1
        periods = np.array([r.motion.period or 0 for r in ranges])[np.searchsorted(cuts, values, side="right")]
        scores.append(case.score(parameter, values, periods))
    return case.Trial(article.SWAPPED, case.Protocol("up"), integrator, *scores)


@pytest.mark.parametrize(
    ("shifts", "met"), [([0.0] * 8, 8), ([0.9] * 8, 8), ([1.2, -1.2] + [0.0] * 6, 6), ([-2.0] * 7 + [0.5], 1)]
)
def test_boundaries_are_met_within_their_tolerances(shifts, met):
    assert case.boundaries_met(drawn(shifts)) == met


def test_chance_meets_what_the_widths_say():
    """One diagram with one boundary of each kind: each random table's k-th boundary meets it with its own density."""
    one = drawn([0.0] * 8)
    counts = case.most_met_by_chance([one], 20_000, seed=1)
    rng = np.random.default_rng(1)
    expected = np.zeros(20_000, int)
    for parameter, tolerance in case.TOLERANCES.items():
        ends, stated = case.axis(parameter, 2), published.boundaries(parameter)
        random = np.sort(rng.uniform(*ends, (20_000, len(stated))), axis=1)
        for k, boundary in enumerate(stated):
            expected += np.abs(random[:, k] - boundary.value) <= tolerance
    assert abs(counts.mean() - expected.mean()) < 0.01
    assert counts.max() <= 8


@pytest.mark.slow
def test_more_settings_meet_more_by_chance_and_never_less():
    few = [drawn([0.0] * 8)]
    many = few + [drawn(list(row)) for row in np.random.default_rng(0).uniform(-15, 15, (30, 8))]
    alone, together = (case.most_met_by_chance(trials, 500) for trials in (few, many))
    assert np.all(together >= alone) and together.mean() > alone.mean() + 0.2


def test_the_table_names_the_best_setting():
    good = drawn([0.5] * 4 + [3.0] * 4, Integrator(steps=50))
    bad = drawn([3.0] * 8, Integrator(steps=20))
    (row,) = case.search_table({"steps": ([bad, good], [replace(bad, hypothesis=article.PRINTED)])}).rows
    assert row[:5] == ("steps", "2", "4 of 8", "RK4, 50 steps, up", "0")
