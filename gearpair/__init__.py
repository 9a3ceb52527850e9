"""Nonlinear dynamics of a spur gear pair with backlash and time-varying mesh stiffness.

Start with an `Oscillator`; then `trajectory`, `steady_state`, `sweep`, `basins`.
"""

from gearpair import published
from gearpair.batches import Status
from gearpair.bifurcation_curves import BifurcationCurve, continue_bifurcation
from gearpair.branches import Bifurcation, Branch, continue_orbit, doubled_orbit, find_branches
from gearpair.drive import GearDrive
from gearpair.exponents import lyapunov_exponents
from gearpair.impacts import ImpactState, impact_state
from gearpair.initial_conditions import basins
from gearpair.maps import parameter_map
from gearpair.motion import Impacts, Trajectory, stroboscopic_map, trajectory
from gearpair.orbits import NewtonStatus, PeriodicOrbit, find_orbits, periodic_orbit
from gearpair.oscillator import Oscillator
from gearpair.spectra import Spectrum, spectrum
from gearpair.steady import SteadyState, steady_state
from gearpair.stiffness import StiffnessWave
from gearpair.sweeps import sweep

__all__ = [
    "Bifurcation",
    "BifurcationCurve",
    "Branch",
    "GearDrive",
    "ImpactState",
    "Impacts",
    "NewtonStatus",
    "Oscillator",
    "PeriodicOrbit",
    "Spectrum",
    "Status",
    "SteadyState",
    "StiffnessWave",
    "Trajectory",
    "basins",
    "continue_bifurcation",
    "continue_orbit",
    "doubled_orbit",
    "find_branches",
    "find_orbits",
    "impact_state",
    "lyapunov_exponents",
    "parameter_map",
    "published",
    "runge_kutta_section",
    "runge_kutta_sweep",
    "periodic_orbit",
    "published",
    "spectrum",
    "steady_state",
    "stroboscopic_map",
    "sweep",
    "trajectory",
]
