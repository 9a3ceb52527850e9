"""Motions of one oscillator, from a single trajectory to basins of attraction, and what they are called."""

from gearpair.motion.datasets import symbol
from gearpair.motion.impacts import ImpactState, impact_state
from gearpair.motion.initial_conditions import (
    attractor_motions,
    attractor_states,
    basin_stability,
    basins,
    motion_shares,
)
from gearpair.motion.measures import ImpactMeasures, impact_measures
from gearpair.motion.names import CHAOS, Motion, motions_of, periodic
from gearpair.motion.ranges import (
    MotionRange,
    follow,
    found_ranges,
    joined_ranges,
    motion_ranges,
    range_of,
    representatives,
)
from gearpair.motion.settling import Status, transient_periods
from gearpair.motion.spectra import Spectrum, spectrum
from gearpair.motion.stability import lyapunov_exponents, multipliers_of
from gearpair.motion.steady import SteadyState, steady_state
from gearpair.motion.stores import decoded
from gearpair.motion.sweeps import parameter_map, sweep
from gearpair.motion.tipping import continue_attractors
from gearpair.motion.trajectories import Impacts, Trajectory, stroboscopic_map, trajectory
from gearpair.motion.uncertainty import BasinEntropy, UncertaintyExponent, basin_entropy, uncertainty_exponent
from gearpair.motion.zero_one import zero_one_test

__all__ = [
    "BasinEntropy",
    "CHAOS",
    "ImpactMeasures",
    "ImpactState",
    "Impacts",
    "Motion",
    "MotionRange",
    "Spectrum",
    "Status",
    "SteadyState",
    "Trajectory",
    "UncertaintyExponent",
    "attractor_motions",
    "attractor_states",
    "basin_entropy",
    "basin_stability",
    "basins",
    "continue_attractors",
    "decoded",
    "follow",
    "found_ranges",
    "impact_measures",
    "impact_state",
    "joined_ranges",
    "lyapunov_exponents",
    "motion_ranges",
    "motion_shares",
    "motions_of",
    "multipliers_of",
    "parameter_map",
    "periodic",
    "range_of",
    "representatives",
    "spectrum",
    "steady_state",
    "stroboscopic_map",
    "sweep",
    "symbol",
    "trajectory",
    "transient_periods",
    "uncertainty_exponent",
    "zero_one_test",
]
