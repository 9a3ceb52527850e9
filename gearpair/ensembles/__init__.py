"""Ensembles of motions: sweeps and maps over parameters, basins over starts, and where each motion lives."""

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
from gearpair.ensembles.shares import basin_stability, motion_shares
from gearpair.ensembles.stores import decoded
from gearpair.ensembles.sweeps import parameter_map, sweep
from gearpair.ensembles.tipping import continue_attractors
from gearpair.ensembles.uncertainty import BasinEntropy, UncertaintyExponent, basin_entropy, uncertainty_exponent

__all__ = [
    "BasinEntropy",
    "MotionRange",
    "UncertaintyExponent",
    "attractor_motions",
    "attractor_states",
    "basin_entropy",
    "basin_stability",
    "basins",
    "carried_sweeps",
    "continue_attractors",
    "decoded",
    "found_ranges",
    "joined_ranges",
    "motion_ranges",
    "motion_shares",
    "motion_table",
    "parameter_map",
    "range_of",
    "representatives",
    "sweep",
    "uncertainty_exponent",
]
