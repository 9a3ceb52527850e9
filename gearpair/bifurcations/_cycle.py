"""One cycle of an orbit, as a search for orbits and a continuation describe it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearpair._flow.cells import Parameters
from gearpair._flow.cycle import cycle_at
from gearpair._flow.records import Extrema
from gearpair._flow.walk import OK

MAX_EXTREMA_PER_PERIOD = 64


@dataclass(frozen=True)
class Cycle:
    """A cycle from one of its section points on.

    Attributes
    ----------
    points : ndarray of float, shape (period, 2)
        X and X' on the section, in the order visited.
    monodromy : ndarray of float, shape (2, 2)
        The derivative of the period map at ``points[0]``.
    residual : float
        Largest component of map(point) - point; inf where the motion could not be followed.
    x_min, x_max : float
        Extremes of X, at exact roots of X'.
    contacts : tuple of int
        Contacts begun on the drive and on the coast side.
    extrema : ndarray of float, shape (n, 2)
        Mesh periods since ``points[0]`` and X where X' = 0.
    """

    points: NDArray[np.float64]
    monodromy: NDArray[np.float64]
    residual: float
    x_min: float
    x_max: float
    contacts: tuple[int, int]
    extrema: NDArray[np.float64]

    @property
    def nearest_extremum(self) -> tuple[float, float]:
        """Of the extremum nearest to a boundary: when it is (mesh periods), and that boundary."""
        away = np.abs(np.abs(self.extrema[:, 1]) - 1.0)
        when, x = self.extrema[np.argmin(away)]
        return float(when), 1.0 if x > 0.0 else -1.0

    @property
    def gap(self) -> float:
        """Signed distance of the extremum nearest to a boundary from it."""
        return self.gap_of(*self.nearest_extremum)

    def gap_of(self, when: float, boundary: float) -> float:
        """Signed distance from `boundary` of the extremum nearest in time to `when`."""
        return float(self.extrema[np.argmin(self.apart(self.extrema[:, 0], when)), 1] - boundary)

    def apart(self, times: NDArray[np.float64], when: float) -> NDArray[np.float64]:
        """How far times are from `when` around the cycle (mesh periods)."""
        n = len(self.points)
        return np.abs((times - when + 0.5 * n) % n - 0.5 * n)

    @property
    def fold_test(self) -> float:
        """(mu_1 - 1)(mu_2 - 1)."""
        return float((self.monodromy[0, 0] - 1.0) * (self.monodromy[1, 1] - 1.0) - self._off)

    @property
    def flip_test(self) -> float:
        """(mu_1 + 1)(mu_2 + 1)."""
        return float((self.monodromy[0, 0] + 1.0) * (self.monodromy[1, 1] + 1.0) - self._off)

    @property
    def half_gap(self) -> NDArray[np.float64]:
        """Difference of the points half a period apart: zero where the period halves; ones for odd periods."""
        n = len(self.points)
        return self.points[n // 2] - self.points[0] if n % 2 == 0 else np.ones(2)

    @property
    def _off(self) -> float:
        return float(self.monodromy[0, 1] * self.monodromy[1, 0])


def describe_cycle(parameters: Parameters, x: float, v: float, period: int) -> Cycle:
    """The cycle of `period` mesh periods through (x, v), which is closed as far as its residual says."""
    points, monodromy = np.empty((period, 2)), np.empty((2, 2))
    found = Extrema(np.empty((MAX_EXTREMA_PER_PERIOD * period, 2)), np.zeros(3, np.int64))
    status, residual = cycle_at(parameters, x, v, points, monodromy, found)
    n, drive, coast = found.counts.tolist()
    extrema = found.rows[:n].copy()
    reached = np.concatenate([extrema[:, 1], points[:, 0]])
    return Cycle(
        points=points,
        monodromy=monodromy,
        residual=float(residual) if status == OK else np.inf,
        x_min=float(reached.min()),
        x_max=float(reached.max()),
        contacts=(drive, coast),
        extrema=extrema,
    )
