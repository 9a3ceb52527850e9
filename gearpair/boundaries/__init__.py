"""The boundary between two motions: the saddle on it, its manifolds, and the smallest shock that crosses it."""

from gearpair.boundaries.dips import CriticalDip, critical_dip
from gearpair.boundaries.edges import EdgeState, EdgeStatus, edge_state
from gearpair.boundaries.growing import Manifolds, manifolds
from gearpair.boundaries.sections import at_phase, backward_map
from gearpair.boundaries.shocks import CriticalShock, critical_shock
from gearpair.boundaries.tangencies import HomoclinicTangency, TangencyStatus, homoclinic_tangency

__all__ = [
    "CriticalDip",
    "CriticalShock",
    "EdgeState",
    "EdgeStatus",
    "HomoclinicTangency",
    "Manifolds",
    "TangencyStatus",
    "at_phase",
    "backward_map",
    "critical_dip",
    "critical_shock",
    "edge_state",
    "homoclinic_tangency",
    "manifolds",
]
