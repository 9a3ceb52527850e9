"""Nonlinear dynamics of a spur gear pair with backlash and time-varying mesh stiffness.

Start with an `Oscillator`; then `trajectory`, `steady_state`, `sweep`, `basins`.
"""

from gearpair import published
from gearpair.batches import Status
from gearpair.comparison import apparent_period, runge_kutta_section, runge_kutta_sweep
from gearpair.impacts import ImpactState, impact_state
from gearpair.initial_conditions import basins
from gearpair.maps import parameter_map
from gearpair.motion import Impacts, Trajectory, stroboscopic_map, trajectory
from gearpair.oscillator import Oscillator
from gearpair.spectra import Spectrum, spectrum
from gearpair.steady import SteadyState, steady_state
from gearpair.stiffness import StiffnessWave
from gearpair.sweeps import sweep

__all__ = [
    "ImpactState",
    "Impacts",
    "Oscillator",
    "Spectrum",
    "Status",
    "SteadyState",
    "StiffnessWave",
    "Trajectory",
    "apparent_period",
    "basins",
    "impact_state",
    "parameter_map",
    "published",
    "runge_kutta_section",
    "runge_kutta_sweep",
    "spectrum",
    "steady_state",
    "stroboscopic_map",
    "sweep",
    "trajectory",
]
