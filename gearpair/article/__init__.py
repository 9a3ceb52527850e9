"""What the published article states, how it can be read, and the case about its numbers."""

from gearpair.article import published
from gearpair.article.comparison import (
    boundary_table,
    compare_attractors,
    compare_boundaries,
    compare_ranges,
    drawn_boundary,
    nearest,
    nearness,
)
from gearpair.article.existence import Reached, reached
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
from gearpair.article.scoring import Match, Score, axis, label, published_labels, random_tables, score
from gearpair.article.trials import (
    Protocol,
    Ranked,
    Trial,
    all_protocols,
    periods,
    ranking,
    run_trials,
    runge_kutta_trials,
    worth,
)
from gearpair.article.verdicts import Verdict, judge, judge_number, verdict_table

__all__ = [
    "Hypothesis",
    "Match",
    "PRINTED",
    "Protocol",
    "Ranked",
    "Reached",
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
    "drawn_boundary",
    "integrator_items",
    "judge",
    "judge_number",
    "label",
    "model_items",
    "nearest",
    "nearness",
    "period_two",
    "periods",
    "published",
    "published_labels",
    "random_tables",
    "range_items",
    "ranking",
    "reached",
    "route_items",
    "runge_kutta_trials",
    "score",
    "start_items",
    "transient_items",
    "run_trials",
    "verdict_table",
    "worth",
]
