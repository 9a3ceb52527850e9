"""Ensembles of motions: sweeps and maps over parameters, basins over starts, where each motion lives, and how long."""

from gearpair.ensembles.escape_rates import EscapeRate, Persistence, escape_rate
from gearpair.ensembles.finding import attractors
from gearpair.ensembles.labelling import Attractors
from gearpair.ensembles.lifetimes import survival, survival_along
from gearpair.ensembles.planes import attractor_motions, attractor_states, basins
from gearpair.ensembles.ranges import (
    MotionRange,
    carried_sweeps,
    found_ranges,
    joined_ranges,
    motion_ranges,
    motion_table,
    range_of,
    representatives,
)
from gearpair.ensembles.saddles import chaotic_saddle
from gearpair.ensembles.shares import basin_stability, motion_shares
from gearpair.ensembles.stores import decoded
from gearpair.ensembles.sweeps import parameter_map, sweep
from gearpair.ensembles.tipping import continue_attractors
from gearpair.ensembles.uncertainty import BasinEntropy, UncertaintyExponent, basin_entropy, uncertainty_exponent

__all__ = [
    "Attractors",
    "BasinEntropy",
    "EscapeRate",
    "MotionRange",
    "Persistence",
    "UncertaintyExponent",
    "attractor_motions",
    "attractor_states",
    "attractors",
    "basin_entropy",
    "basin_stability",
    "basins",
    "carried_sweeps",
    "chaotic_saddle",
    "continue_attractors",
    "decoded",
    "escape_rate",
    "found_ranges",
    "joined_ranges",
    "motion_ranges",
    "motion_shares",
    "motion_table",
    "parameter_map",
    "range_of",
    "representatives",
    "survival",
    "survival_along",
    "sweep",
    "uncertainty_exponent",
]
