"""On which side of a boundary a start lies: whether its motion settles where another one does."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array
from gearpair._flow.states import CAPPED, EXHAUSTED, GONE, PERIODIC
from gearpair.bifurcations.orbits import PeriodicOrbit
from gearpair.ensembles.capture import joined
from gearpair.motion.same_orbit import lies_on
from gearpair.motion.settling import MANY, STATUSES, SettleOptions, nothing_known, settle_batch
from gearpair.motion.steady import SteadyState
from gearpair.oscillator import Oscillator

UNBOUNDED, CHAOTIC = -1, -2  # what stands for the number of a periodic attractor
CUTS = 15  # points tried at once between two starts, to come nearer by a factor of sixteen


class Sides:
    """The starts whose motion settles where that of `home` does, and the others.

    Periodic attractors are told apart; motions that do not settle in the time watched are one, and so are those that
    escape. Attractors are learnt on the way, and capture later starts.

    Parameters
    ----------
    osc : Oscillator
    home : array_like of float, shape (2,)
        X and X' on the section.
    options : SettleOptions
    """

    def __init__(self, osc: Oscillator, home: ArrayLike, options: SettleOptions) -> None:
        self.osc = osc
        self._settings = MANY.having(options).whole_cycles()
        self._known = nothing_known(self._settings)
        self.home = int(self.numbers(np.array([home], dtype=float))[0])

    def numbers(self, points: NDArray[np.float64]) -> NDArray[np.int64]:
        """The attractor that each of `points` (n, 2) leads to, `UNBOUNDED` or `CHAOTIC`; shape (n,)."""
        out = settle_batch([self.osc], points, self._settings, known=self._known)
        for code in (CAPPED, EXHAUSTED):
            if np.any(out.status == code):
                raise RuntimeError(STATUSES[code].remedy)
        new = (out.status == PERIODIC) & (out.attractor < 0)
        if new.any():
            self._known = joined(self.osc, self._known, out)
        numbers = np.where(out.status == GONE, UNBOUNDED, np.where(out.status == PERIODIC, out.attractor, CHAOTIC))
        for i in np.flatnonzero(new).tolist():
            numbers[i] = self._number(out.points[i, 0], int(out.period[i]))
        return numbers

    def _number(self, point: NDArray[np.float64], period: int) -> int:
        """The known attractor through `point`, the one of its section points with the smallest X."""
        settled = self._known.settled
        found = [
            k for k in np.flatnonzero(settled.period == period).tolist() if lies_on(point, settled.points[k, :period])
        ]
        return found[0]

    def at_home(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Whether each of `points` (n, 2) leads where `home` does."""
        return self.numbers(points) == self.home

    def narrowed(
        self, within: NDArray[np.float64], beyond: NDArray[np.float64], apart: float
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Two points on the segment from `within` the basin to `beyond` it, on either side, at most `apart`.

        Or neighbours in floating point, where that is further. Of several boundaries between them one is found.
        """
        shares = (np.arange(1, CUTS + 1) / (CUTS + 1))[:, None]
        while np.hypot(*(beyond - within)) > apart:
            points = within + shares * (beyond - within)
            row = np.concatenate([within[None], points, beyond[None]])
            first = int(np.argmin(np.append(self.at_home(points), False))) + 1
            if np.array_equal(row[first - 1], within) and np.array_equal(row[first], beyond):
                break
            within, beyond = row[first - 1], row[first]
        return within, beyond


def start_of(name: str, given: ArrayLike | SteadyState | PeriodicOrbit, osc: Oscillator) -> NDArray[np.float64]:
    """A start (2,) as given, or a section point of a motion of `osc`; or a ValueError."""
    if isinstance(given, (SteadyState, PeriodicOrbit)) and given.oscillator != osc:
        raise ValueError(f"{name} must be a motion of the oscillator that is given, got one of another")
    point = given.points[0] if isinstance(given, (SteadyState, PeriodicOrbit)) else check_array(name, given)
    if point.shape != (2,):
        raise ValueError(f"{name} must be X and X', or a settled motion, got shape {point.shape}")
    return point
