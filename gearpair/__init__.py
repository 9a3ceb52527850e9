"""Nonlinear dynamics of a spur gear pair with backlash and time-varying mesh stiffness.

Start with an `Oscillator`; then `trajectory`, `steady_state`, `sweep`, `basins`.
"""

from gearpair import published
from gearpair.anatomy import CertifiedStep, Segment, certificate_table, segments, series_table, telling_segments
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
from gearpair.precision import (
    Precision,
    coarse_share,
    disorder_table,
    impact_time_error,
    numerical_chaos,
    plain_sweep,
    recut,
    work_precision,
)
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
    "CertifiedStep",
    "GearDrive",
    "ImpactState",
    "Impacts",
    "IsoStiffness",
    "MeshStiffness",
    "MotionRange",
    "NewtonStatus",
    "Oscillator",
    "PeriodicOrbit",
    "Precision",
    "Segment",
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
    "certificate_table",
    "coarse_share",
    "coexistence",
    "coexistence_table",
    "compare_attractors",
    "compare_boundaries",
    "compare_ranges",
    "continue_bifurcation",
    "continue_orbit",
    "disorder_table",
    "doubled_orbit",
    "doubling_cascade",
    "find_branches",
    "find_orbits",
    "follow",
    "found_ranges",
    "impact_state",
    "impact_time_error",
    "iso_stiffness",
    "lyapunov_exponents",
    "mesh_stiffness",
    "motion_name",
    "motion_names",
    "motion_ranges",
    "motion_shares",
    "motion_table",
    "numerical_chaos",
    "parameter_map",
    "periodic_orbit",
    "plain_sweep",
    "published",
    "range_of",
    "recut",
    "representatives",
    "runge_kutta_section",
    "runge_kutta_sweep",
    "segments",
    "series_table",
    "spectrum",
    "stable_ranges",
    "steady_state",
    "stroboscopic_map",
    "sweep",
    "telling_segments",
    "trajectory",
    "work_precision",
    "zero_one_test",
]
