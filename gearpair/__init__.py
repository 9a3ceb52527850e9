"""Nonlinear dynamics of a spur gear pair with backlash and time-varying mesh stiffness.

Start with an `Oscillator`; then `trajectory`, `steady_state`, `sweep`, `basins`.
"""

from gearpair import published
from gearpair.batches import Status
from gearpair.comparison import compare_attractors, compare_boundaries, compare_ranges
from gearpair.drive import GearDrive
from gearpair.exponents import lyapunov_exponents
from gearpair.impacts import ImpactState, impact_state
from gearpair.initial_conditions import basins
from gearpair.maps import parameter_map
from gearpair.motion import Impacts, Trajectory, stroboscopic_map, trajectory
from gearpair.orbits import NewtonStatus, PeriodicOrbit, find_orbits, periodic_orbit
from gearpair.oscillator import Oscillator
from gearpair.ranges import (
    MotionRange,
    attractor_names,
    follow,
    found_ranges,
    motion_name,
    motion_ranges,
    motion_shares,
    motion_table,
    range_of,
    representatives,
)
from gearpair.spectra import Spectrum, spectrum
from gearpair.steady import SteadyState, steady_state
from gearpair.stiffness import StiffnessWave
from gearpair.sweeps import sweep
from gearpair.tables import Table

__all__ = [
    "GearDrive",
    "ImpactState",
    "Impacts",
    "MotionRange",
    "NewtonStatus",
    "Oscillator",
    "PeriodicOrbit",
    "Spectrum",
    "Status",
    "SteadyState",
    "StiffnessWave",
    "Table",
    "Trajectory",
    "attractor_names",
    "basins",
    "compare_attractors",
    "compare_boundaries",
    "compare_ranges",
    "find_orbits",
    "follow",
    "found_ranges",
    "impact_state",
    "lyapunov_exponents",
    "motion_name",
    "motion_ranges",
    "motion_shares",
    "motion_table",
    "parameter_map",
    "periodic_orbit",
    "published",
    "range_of",
    "representatives",
    "spectrum",
    "steady_state",
    "stroboscopic_map",
    "sweep",
    "trajectory",
]
