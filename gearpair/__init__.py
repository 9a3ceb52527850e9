"""Nonlinear dynamics of a spur gear pair with backlash and time-varying mesh stiffness.

Start with an `Oscillator`; then `trajectory`, `steady_state`, `sweep`, `basins`. What is not here is in the folder that
its subject names: `teeth`, `motion`, `ensembles`, `bifurcations`, `boundaries`, `design`, `methods`, `article`,
`plotting`.
"""

import importlib
from typing import Any

from gearpair import article, bifurcations, boundaries, design, ensembles, methods, motion, teeth
from gearpair.article import published
from gearpair.bifurcations import (
    Bifurcation,
    Branch,
    PeriodicOrbit,
    continue_bifurcation,
    continue_orbit,
    find_branches,
    find_orbits,
    periodic_orbit,
)
from gearpair.boundaries import critical_shock, edge_state, manifolds
from gearpair.drive import GearDrive
from gearpair.ensembles import Attractors, attractors, basins, parameter_map, survival, sweep
from gearpair.motion import (
    ImpactState,
    Status,
    SteadyState,
    Trajectory,
    impact_state,
    lyapunov_exponents,
    passage,
    spectrum,
    steady_state,
    stroboscopic_map,
    trajectory,
)
from gearpair.oscillator import Oscillator
from gearpair.stiffness import StiffnessWave
from gearpair.table import Table
from gearpair.teeth import SpurPair, mesh_stiffness

__all__ = [
    "Attractors",
    "Bifurcation",
    "Branch",
    "GearDrive",
    "ImpactState",
    "Oscillator",
    "PeriodicOrbit",
    "SpurPair",
    "Status",
    "SteadyState",
    "StiffnessWave",
    "Table",
    "Trajectory",
    "article",
    "attractors",
    "basins",
    "bifurcations",
    "boundaries",
    "continue_bifurcation",
    "continue_orbit",
    "critical_shock",
    "design",
    "edge_state",
    "ensembles",
    "find_branches",
    "find_orbits",
    "impact_state",
    "lyapunov_exponents",
    "manifolds",
    "mesh_stiffness",
    "methods",
    "motion",
    "parameter_map",
    "passage",
    "periodic_orbit",
    "plotting",
    "published",
    "spectrum",
    "steady_state",
    "stroboscopic_map",
    "survival",
    "sweep",
    "teeth",
    "trajectory",
]


def __dir__() -> list[str]:
    """What there is, with what is imported when it is first used."""
    return sorted({*globals(), *__all__})


def __getattr__(name: str) -> Any:
    """`gearpair.plotting`, imported when it is first used: it brings matplotlib."""
    if name == "plotting":
        return importlib.import_module("gearpair.plotting")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
