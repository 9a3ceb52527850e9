"""One motion of one oscillator: from a start, what it settles on, how stable it is, and what it is called."""

from gearpair.motion.energy import EnergyBalance, energy_balance
from gearpair.motion.impacts import ImpactState, impact_state
from gearpair.motion.measures import ImpactMeasures, impact_measures
from gearpair.motion.names import CHAOS, Motion, motions_of, periodic
from gearpair.motion.passages import passage
from gearpair.motion.settling import BatchOptions, SettleOptions, Status, transient_periods
from gearpair.motion.spectra import Spectrum, spectrum
from gearpair.motion.stability import lyapunov_exponents, multipliers_of
from gearpair.motion.steady import SteadyState, steady_state
from gearpair.motion.trajectories import Impacts, Trajectory, stroboscopic_map, trajectory
from gearpair.motion.zero_one import zero_one_test

__all__ = [
    "CHAOS",
    "BatchOptions",
    "EnergyBalance",
    "ImpactMeasures",
    "ImpactState",
    "Impacts",
    "Motion",
    "SettleOptions",
    "Spectrum",
    "Status",
    "SteadyState",
    "Trajectory",
    "energy_balance",
    "impact_measures",
    "impact_state",
    "lyapunov_exponents",
    "motions_of",
    "multipliers_of",
    "passage",
    "periodic",
    "spectrum",
    "steady_state",
    "stroboscopic_map",
    "trajectory",
    "transient_periods",
    "zero_one_test",
]
