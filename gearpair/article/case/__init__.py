"""The case about the article's numbers: readings drawn and scored, what they reach, and the verdict on every item.

A *protocol* is one way to draw a diagram; a *trial* is a reading drawn by a protocol.
"""

from gearpair.article.case.boundaries import (
    bifurcations_of,
    boundary_table,
    distance_from_bifurcations,
    named_bifurcation,
)
from gearpair.article.case.existence import STARTS, WATCHED, Reached, reached, shared_boundaries
from gearpair.article.case.findings import (
    after_watching,
    behind,
    best_durations,
    best_phase,
    chaos_at_small_damping,
    headline,
    how_they_differ,
    met_by_chance,
    score_headline,
    which_reading,
)
from gearpair.article.case.items import Evidence, judge_items
from gearpair.article.case.scoring import Match, Score, axis, published_motions, random_tables, score
from gearpair.article.case.search import (
    TOLERANCES,
    asked_phase_table,
    asked_phases,
    boundaries_met,
    most_met_by_chance,
    search_table,
)
from gearpair.article.case.trials import (
    Protocol,
    Ranked,
    Trial,
    all_hypotheses,
    all_protocols,
    periods,
    ranking,
    run_trials,
    score_by_choice,
    score_by_start,
)
from gearpair.article.case.two_rotors import two_rotor_difference
from gearpair.article.case.verdicts import Verdict, count_verdicts, counter_evidence, verdict_table

__all__ = [
    "Evidence",
    "Match",
    "Protocol",
    "Ranked",
    "Reached",
    "STARTS",
    "Score",
    "TOLERANCES",
    "Trial",
    "Verdict",
    "WATCHED",
    "after_watching",
    "all_hypotheses",
    "all_protocols",
    "asked_phase_table",
    "asked_phases",
    "axis",
    "behind",
    "best_durations",
    "best_phase",
    "bifurcations_of",
    "boundaries_met",
    "boundary_table",
    "chaos_at_small_damping",
    "count_verdicts",
    "counter_evidence",
    "distance_from_bifurcations",
    "headline",
    "how_they_differ",
    "judge_items",
    "met_by_chance",
    "most_met_by_chance",
    "named_bifurcation",
    "periods",
    "published_motions",
    "random_tables",
    "ranking",
    "reached",
    "run_trials",
    "score",
    "score_by_choice",
    "score_by_start",
    "score_headline",
    "search_table",
    "shared_boundaries",
    "two_rotor_difference",
    "verdict_table",
    "which_reading",
]
