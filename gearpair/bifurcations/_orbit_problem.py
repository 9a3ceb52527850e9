"""The equations of a periodic orbit for continuation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gearpair._flow.cells import Parameters
from gearpair._flow.cycle import equations_at
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
        try:
            here = self.parameters(u)
            beside = tuple(self._beside(u, k, step) for k, size in enumerate(steps, 2) for step in (size, -size))
        except ValueError:  # a wave parameter out of range
            return None
        residual, jacobian = np.empty(2), np.empty((2, len(u)))
        status = equations_at(here, beside, u[0], u[1], self.period, steps, residual, jacobian)
        return (residual, jacobian) if status == OK else None

    def _beside(self, u: Vector, k: int, step: float) -> Parameters:
        """The kernels' parameters with unknown `k` a step away."""
        aside = u.copy()
        aside[k] += step
        return self.parameters(aside)

    def cycle(self, u: Vector) -> Cycle:
        """The orbit at a solution `u`."""
        return describe_cycle(self.parameters(u), u[0], u[1], self.period)
