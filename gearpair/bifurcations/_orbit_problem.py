"""The equations of a periodic orbit for continuation, and the orbit as the continuation sees it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearpair._flow.cells import Parameters
from gearpair._flow.cycle import map_at, plain_map_at, turns_at
from gearpair._flow.march import OK
from gearpair.bifurcations._arclength import Vector
from gearpair.bifurcations.orbits import MAX_TURNS_PER_PERIOD
from gearpair.oscillator import SCALARS, Oscillator

DIFFERENCE = 1e-6  # relative step of the central difference by a parameter


@dataclass(frozen=True)
class Cycle:
    """One orbit of a branch as the continuation sees it."""

    points: NDArray[np.float64]
    monodromy: NDArray[np.float64]
    x_min: float
    x_max: float
    contacts: tuple[int, int]
    turns: NDArray[np.float64]  # (n, 2): mesh periods since the first point and X where X' = 0

    @property
    def grazing_turn(self) -> tuple[float, float]:
        """Of the turning point nearest to a boundary: when it is (mesh periods), and that boundary."""
        away = np.abs(np.abs(self.turns[:, 1]) - 1.0)
        when, x = self.turns[np.argmin(away)]
        return float(when), 1.0 if x > 0.0 else -1.0

    @property
    def gap(self) -> float:
        """Signed distance of the turning point nearest to a boundary from it."""
        return self.gap_of(*self.grazing_turn)

    def gap_of(self, when: float, boundary: float) -> float:
        """Signed distance from `boundary` of the turning point nearest in time to `when`."""
        n = len(self.points)
        apart = np.abs((self.turns[:, 0] - when + 0.5 * n) % n - 0.5 * n)
        return float(self.turns[np.argmin(apart), 1] - boundary)

    @property
    def fold_test(self) -> float:
        """(mu_1 - 1)(mu_2 - 1)."""
        return float((self.monodromy[0, 0] - 1.0) * (self.monodromy[1, 1] - 1.0) - self._off)

    @property
    def flip_test(self) -> float:
        """(mu_1 + 1)(mu_2 + 1)."""
        return float((self.monodromy[0, 0] + 1.0) * (self.monodromy[1, 1] + 1.0) - self._off)

    @property
    def half_gap(self) -> Vector:
        """Difference of the points half a period apart: zero where the period halves; ones for odd periods."""
        n = len(self.points)
        return self.points[n // 2] - self.points[0] if n % 2 == 0 else np.ones(2)

    @property
    def _off(self) -> float:
        return float(self.monodromy[0, 1] * self.monodromy[1, 0])


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
            return self.osc._flow_parameters._replace(**changes)
        return self.osc.replace(**changes)._flow_parameters

    def equations(self, u: Vector) -> tuple[Vector, NDArray[np.float64]] | None:
        """Residual and Jacobian; None where the motion cannot be followed."""
        try:
            monodromy = np.empty((2, 2))
            status, x, v = map_at(self.parameters(u), u[0], u[1], self.period, monodromy)
            jacobian = np.empty((2, len(u)))
            jacobian[:, :2] = monodromy - np.eye(2)
            for k in range(2, len(u)):
                step = np.zeros(len(u))
                step[k] = DIFFERENCE * max(1.0, abs(u[k]))
                right = plain_map_at(self.parameters(u + step), u[0], u[1], self.period)
                left = plain_map_at(self.parameters(u - step), u[0], u[1], self.period)
                if status != OK or right[0] != OK or left[0] != OK:
                    return None
                jacobian[:, k] = (np.array(right[1:]) - np.array(left[1:])) / (2.0 * step[k])
        except ValueError:  # a wave parameter out of range
            return None
        return np.array([x - u[0], v - u[1]]), jacobian

    def cycle(self, u: Vector) -> Cycle:
        """The orbit at a solution `u`."""
        p = self.parameters(u)
        points = np.empty((self.period, 2))
        points[0] = u[:2]
        for i in range(1, self.period):
            points[i] = plain_map_at(p, *points[i - 1], 1)[1:]
        monodromy = np.empty((2, 2))
        map_at(p, u[0], u[1], self.period, monodromy)
        turns = np.empty((MAX_TURNS_PER_PERIOD * self.period, 3))
        _, n, drive, coast = turns_at(p, u[0], u[1], self.period, turns)
        x = np.concatenate([turns[:n, 1], points[:, 0]])
        return Cycle(points, monodromy, float(x.min()), float(x.max()), (drive, coast), turns[:n, :2].copy())
