"""Nonlinear dynamics of a spur gear pair with backlash and time-varying mesh stiffness.

Start with an `Oscillator`; then `trajectory`, `steady_state`, `sweep`, `basins`.
"""

from gearpair import published
from gearpair.batches import Status
from gearpair.bifurcation_curves import BifurcationCurve, continue_bifurcation
from gearpair.branch_search import doubling_cascade, find_branches
from gearpair.branches import Bifurcation, Branch, continue_orbit, doubled_orbit
from gearpair.chaos_test import zero_one_test
from gearpair.comparison import compare_attractors, compare_boundaries, compare_ranges
from gearpair.drive import GearDrive
from gearpair.exponents import lyapunov_exponents
from gearpair.impacts import ImpactState, impact_state
from gearpair.initial_conditions import basins
from gearpair.integrators import apparent_period, runge_kutta_section, runge_kutta_sweep
from gearpair.iso6336 import IsoStiffness, iso_stiffness
from gearpair.maps import parameter_map
from gearpair.meshing import MeshStiffness, mesh_stiffness
from gearpair.motion import Impacts, Trajectory, stroboscopic_map, trajectory
from gearpair.orbits import NewtonStatus, PeriodicOrbit, find_orbits, periodic_orbit
from gearpair.oscillator import Oscillator
from gearpair.ranges import (
    MotionRange,
    attractor_names,
    attractor_states,
    follow,
    found_ranges,
    motion_name,
    motion_names,
    motion_ranges,
    motion_shares,
    motion_table,
    range_of,
    representatives,
)
from gearpair.spectra import Spectrum, spectrum
from gearpair.spurpair import SpurPair
from gearpair.steady import SteadyState, steady_state
from gearpair.stiffness import StiffnessWave
from gearpair.structure import bifurcation_table, cascade_table, coexistence, coexistence_table, stable_ranges
from gearpair.sweeps import sweep
from gearpair.tables import Table

__all__ = [
    "Bifurcation",
    "BifurcationCurve",
    "Branch",
    "GearDrive",
    "ImpactState",
    "Impacts",
    "IsoStiffness",
    "MeshStiffness",
    "MotionRange",
    "NewtonStatus",
    "Oscillator",
    "PeriodicOrbit",
    "Spectrum",
    "SpurPair",
    "Status",
    "SteadyState",
    "StiffnessWave",
    "Table",
    "Trajectory",
    "apparent_period",
    "attractor_names",
    "attractor_states",
    "basins",
    "bifurcation_table",
    "cascade_table",
    "coexistence",
    "coexistence_table",
    "compare_attractors",
    "compare_boundaries",
    "compare_ranges",
    "continue_bifurcation",
    "continue_orbit",
    "doubled_orbit",
    "doubling_cascade",
    "find_branches",
    "find_orbits",
    "follow",
    "found_ranges",
    "impact_state",
    "iso_stiffness",
    "lyapunov_exponents",
    "mesh_stiffness",
    "motion_name",
    "motion_names",
    "motion_ranges",
    "motion_shares",
    "motion_table",
    "parameter_map",
    "periodic_orbit",
    "published",
    "range_of",
    "representatives",
    "runge_kutta_section",
    "runge_kutta_sweep",
    "spectrum",
    "stable_ranges",
    "steady_state",
    "stroboscopic_map",
    "sweep",
    "trajectory",
    "zero_one_test",
]
