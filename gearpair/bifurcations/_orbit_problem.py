"""The equations of a periodic orbit for continuation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gearpair._flow.cells import Parameters
from gearpair._flow.cycle import maps_at
from gearpair._flow.walk import OK
from gearpair.bifurcations._arclength import Vector
from gearpair.bifurcations._cycle import Cycle, describe_cycle
from gearpair.oscillator import SCALARS, Oscillator

DIFFERENCE = 1e-6  # relative step of the central difference by a parameter


class OrbitProblem:
    """The equations map(x, v; parameters) = (x, v) in scaled unknowns (x, v, parameters / scales)."""

    def __init__(self, osc: Oscillator, period: int, scales: dict[str, float]) -> None:
        for name in scales:
            osc.parameter(name)
        self.osc, self.period = osc, period
        self.names, self.scales = tuple(scales), np.array(list(scales.values()))

    def unknowns(self, x: float, v: float) -> Vector:
        """The scaled unknowns of a state at the oscillator's own parameters."""
        return np.array([x, v, *(self.osc.parameter(n) / s for n, s in zip(self.names, self.scales, strict=True))])

    def values(self, u: Vector) -> Vector:
        """The parameters' values."""
        return u[2:] * self.scales

    def oscillator(self, u: Vector) -> Oscillator:
        """The oscillator at `u`."""
        return self.osc.replace(**dict(zip(self.names, self.values(u).tolist(), strict=True)))

    def parameters(self, u: Vector) -> Parameters:
        """The kernels' parameters at `u`."""
        changes = dict(zip(self.names, self.values(u).tolist(), strict=True))
        if all(name in SCALARS for name in changes):  # the quick way, free to step a little out of range
            return self.osc.flow_parameters._replace(**changes)
        return self.osc.replace(**changes).flow_parameters

    def equations(self, u: Vector) -> tuple[Vector, NDArray[np.float64]] | None:
        """Residual and Jacobian; None where the motion cannot be followed."""
        steps = DIFFERENCE * np.maximum(1.0, np.abs(u[2:]))
        asides = np.zeros((len(steps), len(u)))
        asides[:, 2:] = np.diag(steps)
        try:
            here = self.parameters(u)
            beside = tuple(self.parameters(u + side) for aside in asides for side in (aside, -aside))
        except ValueError:  # a wave parameter out of range
            return None
        monodromy, ends = np.empty((2, 2)), np.empty((len(beside), 2))
        status, x, v = maps_at(here, beside, u[0], u[1], self.period, monodromy, ends)
        if status != OK:
            return None
        slopes = (ends[::2] - ends[1::2]) / (2.0 * steps[:, np.newaxis])
        return np.array([x - u[0], v - u[1]]), np.hstack([monodromy - np.eye(2), slopes.T])

    def cycle(self, u: Vector) -> Cycle:
        """The orbit at a solution `u`."""
        return describe_cycle(self.parameters(u), u[0], u[1], self.period)
