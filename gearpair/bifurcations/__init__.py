"""Periodic orbits, stable or not, their branches, and the folds, flips and grazings on them."""

from gearpair.bifurcations._walk import End
from gearpair.bifurcations.branch_search import find_branches
from gearpair.bifurcations.branches import Branch, continue_orbit
from gearpair.bifurcations.curves import BifurcationCurve, continue_bifurcation
from gearpair.bifurcations.doubling import doubled_orbit, doubling_cascade
from gearpair.bifurcations.locating import Bifurcation
from gearpair.bifurcations.moving import fold_shift, move_bifurcation
from gearpair.bifurcations.orbits import NewtonStatus, PeriodicOrbit, find_orbits, periodic_orbit
from gearpair.bifurcations.structure import (
    bifurcation_table,
    cascade_table,
    coexistence,
    coexistence_table,
    stable_ranges,
)

__all__ = [
    "Bifurcation",
    "BifurcationCurve",
    "Branch",
    "End",
    "NewtonStatus",
    "PeriodicOrbit",
    "bifurcation_table",
    "cascade_table",
    "coexistence",
    "coexistence_table",
    "continue_bifurcation",
    "continue_orbit",
    "doubled_orbit",
    "doubling_cascade",
    "find_branches",
    "find_orbits",
    "fold_shift",
    "move_bifurcation",
    "periodic_orbit",
    "stable_ranges",
]
