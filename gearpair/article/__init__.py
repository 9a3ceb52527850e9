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
    named_bifurcation,
    nearest,
)
from gearpair.article.existence import STARTS, Reached, reached, shared_boundaries
from gearpair.article.items import (
    bifurcations_of,
    boundary_items,
    chaos_items,
    integrator_items,
    model_items,
    range_items,
    route_items,
    start_items,
    transient_items,
)
from gearpair.article.readings import PRINTED, SWAPPED, Hypothesis, all_hypotheses
from gearpair.article.scoring import Match, Score, axis, published_kind, published_motions, random_tables, score
from gearpair.article.search import (
    TOLERANCES,
    asked_phase_table,
    asked_phases,
    boundaries_met,
    most_met_by_chance,
    search_table,
)
from gearpair.article.trials import (
    Protocol,
    Ranked,
    Trial,
    all_protocols,
    periods,
    ranking,
    run_trials,
    score_by_choice,
    score_by_start,
)
from gearpair.article.two_rotors import two_rotor_difference
from gearpair.article.verdicts import Verdict, count_verdicts, counter_evidence, judge, verdict_table
from gearpair.article.wave_shape import SweptWave, sweep_waves

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
    "SweptWave",
    "TOLERANCES",
    "Trial",
    "Verdict",
    "all_hypotheses",
    "all_protocols",
    "asked_phase_table",
    "asked_phases",
    "axis",
    "bifurcations_of",
    "boundaries_met",
    "boundary_items",
    "boundary_table",
    "chaos_items",
    "compare_attractors",
    "compare_boundaries",
    "compare_ranges",
    "count_verdicts",
    "counter_evidence",
    "distance_from_bifurcations",
    "drawn_boundary",
    "integrator_items",
    "judge",
    "model_items",
    "most_met_by_chance",
    "named_bifurcation",
    "nearest",
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
    "score",
    "score_by_choice",
    "score_by_start",
    "search_table",
    "shared_boundaries",
    "start_items",
    "sweep_waves",
    "transient_items",
    "two_rotor_difference",
    "verdict_table",
]
