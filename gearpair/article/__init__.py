"""What the published article states, how it can be read, and the case about its numbers.

A *reading* is one way to understand the article's equation: of its wave alone (`StiffnessWave.rectangular`) or of all
of it (`Hypothesis`). A *protocol* is one way to draw a diagram; a *trial* is a reading drawn by a protocol.
"""

from gearpair.article import published
from gearpair.article.comparison import (
    boundary_table,
    compare_attractors,
    compare_boundaries,
    compare_ranges,
    distance_from_bifurcations,
    drawn_boundary,
    nearest,
)
from gearpair.article.existence import STARTS, Reached, reached
from gearpair.article.items import (
    boundary_items,
    chaos_items,
    integrator_items,
    model_items,
    period_two,
    range_items,
    route_items,
    start_items,
    transient_items,
)
from gearpair.article.readings import PRINTED, SWAPPED, Hypothesis, all_hypotheses
from gearpair.article.scoring import Match, Score, axis, published_kind, published_motions, random_tables, score
from gearpair.article.trials import (
    Protocol,
    Ranked,
    Trial,
    all_protocols,
    periods,
    ranking,
    run_trials,
    runge_kutta_trials,
    score_by_choice,
)
from gearpair.article.verdicts import Verdict, judge, judge_number, verdict_table

__all__ = [
    "Hypothesis",
    "Match",
    "PRINTED",
    "Protocol",
    "Ranked",
    "Reached",
    "STARTS",
    "SWAPPED",
    "Score",
    "Trial",
    "Verdict",
    "all_hypotheses",
    "all_protocols",
    "axis",
    "boundary_items",
    "boundary_table",
    "chaos_items",
    "compare_attractors",
    "compare_boundaries",
    "compare_ranges",
    "distance_from_bifurcations",
    "drawn_boundary",
    "integrator_items",
    "judge",
    "judge_number",
    "model_items",
    "nearest",
    "period_two",
    "periods",
    "published",
    "published_kind",
    "published_motions",
    "random_tables",
    "range_items",
    "ranking",
    "reached",
    "route_items",
    "run_trials",
    "runge_kutta_trials",
    "score",
    "score_by_choice",
    "start_items",
    "transient_items",
    "verdict_table",
]
