"""The sentences on a search follow what it found: many equals, none, the printed reading among them."""

import numpy as np
import pytest

from gearpair.article import PRINTED, SWAPPED, case, published
from gearpair.article.readings import Hypothesis

TRUE_MEAN = Hypothesis(stiff_for="2 - eps", damping="2 zeta sqrt(mean)")
COSINE = Hypothesis(stiff_for="2 - eps", phase=90.0)
ANOTHER = Hypothesis(phase=90.0)


@pytest.mark.parametrize(
    ("best", "head", "durations"),
    [
        ([SWAPPED], "Not from the equation as printed.", "It interchanges the two durations"),
        ([SWAPPED, TRUE_MEAN], "Not from the equation as printed.", "Both interchange the two durations"),
        ([ANOTHER], "Not from the equation as printed.", "as printed: stiff for ε − 1"),
        ([ANOTHER, COSINE, SWAPPED], "Not from the equation as printed.", "Of these 3, 2 interchange"),
        ([PRINTED, SWAPPED], "This run does not tell", "Of these 2, 1 interchange"),
        ([PRINTED], "This run does not tell", "It has the two durations of the stiffness wave as printed"),
    ],
)
def test_the_head_follows_the_best_readings(best, head, durations):
    assert case.headline(best).startswith(head)
    assert durations in case.best_durations(best)


def test_the_verdict_names_what_is_decided_and_what_is_not():
    told = case.which_reading([SWAPPED, TRUE_MEAN])
    assert "Of order, phase, forcing, mean and shape the printed choice fits best" in told
    assert told.endswith("on the damping this run does not decide.")
    assert "of phase another than the printed choice fits best" in case.which_reading([COSINE])
    for best in ([PRINTED], [PRINTED, SWAPPED], [ANOTHER, COSINE]):
        assert case.which_reading(best).startswith("This run does not tell")


def test_what_the_best_differ_in_and_whether_they_still_lead():
    assert case.how_they_differ([SWAPPED]) == "one does best"
    assert case.how_they_differ([SWAPPED, TRUE_MEAN]) == "2 do best, which differ in the damping only"
    assert case.after_watching([SWAPPED, TRUE_MEAN], [TRUE_MEAN, SWAPPED]) == "the same 2 lead"
    assert case.after_watching([SWAPPED, TRUE_MEAN], [SWAPPED]) == "one of these leads"
    assert case.after_watching([SWAPPED], [COSINE, ANOTHER]) == "2 lead, none of them among these"


@pytest.mark.parametrize(
    ("values", "chaotic", "sentence"),
    [
        ([0.004, 0.01], [True, True], "No damping as small"),
        ([0.001, 0.01], [False, True], "none has chaos"),
        ([0.001, 0.01], [True, False], "one has chaos"),
    ],
)
def test_chaos_counts_where_it_is_published(values, chaotic, sentence):
    motions = tuple(frozenset({published.CHAOTIC} if each else ()) for each in chaotic)
    found = case.Reached(SWAPPED, "damping_ratio", np.array(values), motions)
    assert sentence in case.chaos_at_small_damping([found])


def test_phases_that_do_as_well_are_all_named():
    phases = np.arange(-180.0, 181.0, 30.0)
    flat = np.ones(phases.size)
    assert case.best_phase(phases, flat).endswith("12 of the 12 phases tried, 0 among them")
    assert case.best_phase(phases, -np.abs(phases - 60.0)) == "the peak is at 60 degrees"
    assert case.best_phase(phases, np.where(phases == 0.0, 0.0, flat)).endswith(
        "11 of the 12 phases tried, 0 not among them"
    )


def test_the_score_may_prefer_either_wave_or_none():
    assert case.score_headline(0.4, 0.4).endswith("does not prefer the swapped wave in this run.")
    assert case.score_headline(0.8, 0.4).endswith("and clearly.")
    assert case.behind(-0.3) == "0.30 ahead of" and case.behind(0.0) == "level with"


def test_a_share_of_random_tables_too_small_to_count_is_not_called_none():
    assert "tables fewer than one in a hundred are met" in case.met_by_chance(3, 0.004)
    assert "tables 60 in a hundred are met" in case.met_by_chance(1, 0.6)
    assert case.met_by_chance(0, 1.0).startswith("A search that meets none says nothing")
