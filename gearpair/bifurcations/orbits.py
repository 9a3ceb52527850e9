"""Periodic orbits, stable or not, by Newton's method on the period map."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count
from gearpair._cores import on_all_cores
from gearpair._flow.closed_form import TERMS
from gearpair._flow.cycle import map_at, newton_starts, turns_at
from gearpair._flow.march import OK, march
from gearpair._flow.tangent import newton
from gearpair.motion.impacts import ImpactState, impact_state
from gearpair.motion.names import Motion, periodic
from gearpair.motion.stability import multipliers_of
from gearpair.motion.trajectories import check_start, check_starts
from gearpair.oscillator import Oscillator

SAME_POINT = 1e-9  # section points of one orbit closer than this are one
STARTS_AT_ONCE = 16  # of Newton searches, between two chances to stop
SAME_ORBIT = 1e-7  # two orbits whose points lie this close are one
MAX_TURNS_PER_PERIOD = 64


class NewtonStatus(StrEnum):
    """How Newton's method ended; a string, so that it compares with its name."""

    CONVERGED = "converged"
    DIVERGED = "diverged"

    @property
    def remedy(self) -> str:
        """A sentence: what the status means and what a user may do."""
        return {
            NewtonStatus.CONVERGED: "the residual is at rounding",
            NewtonStatus.DIVERGED: "no orbit of this period was found from this start: start nearer to it, "
            "or search from many starts with find_orbits",
        }[self]


@dataclass(frozen=True)
class PeriodicOrbit:
    """A periodic orbit, stable or not.

    Attributes
    ----------
    oscillator : Oscillator
    status : NewtonStatus
        ``"converged"`` or ``"diverged"``; where diverged, the rest describes the best state reached.
    period : int
        The minimal period, in mesh periods; it divides the period asked for.
    points : ndarray of float, shape (period, 2)
        X and X' on the section, in the order visited, from the smallest X.
    monodromy : ndarray of float, shape (2, 2)
        The derivative of the period map at ``points[0]``; its determinant is ``exp(-2 zeta period T)``.
    multipliers : ndarray of complex, shape (2,)
        Floquet multipliers, the largest modulus first.
    residual : float
        Largest component of map(point) - point.
    x_min, x_max : float
        Extremes of X over the cycle, at exact roots of X'.
    contacts : tuple of int
        Contacts begun per cycle on the drive and on the coast side.
    """

    oscillator: Oscillator
    status: NewtonStatus
    period: int
    points: NDArray[np.float64]
    monodromy: NDArray[np.float64]
    multipliers: NDArray[np.complex128]
    residual: float
    x_min: float
    x_max: float
    contacts: tuple[int, int]

    @property
    def converged(self) -> bool:
        """Whether `status` is ``"converged"``."""
        return self.status == NewtonStatus.CONVERGED

    @property
    def stable(self) -> bool:
        """Whether both multipliers lie inside the unit circle."""
        return bool(np.abs(self.multipliers[0]) < 1.0)

    @property
    def impact_state(self) -> ImpactState:
        """The impact state of the cycle."""
        return impact_state(self.x_min, self.x_max)

    @property
    def motion(self) -> Motion:
        """Its period and impact state as one."""
        return periodic(self.period, self.impact_state)


def periodic_orbit(osc: Oscillator, x: float, v: float, period: int) -> PeriodicOrbit:
    """The periodic orbit near (x, v), by Newton's method on the `period`-fold map with its exact derivative.

    Parameters
    ----------
    osc : Oscillator
    x, v : float
        A guess of one of its points on the section.
    period : int
        In mesh periods, at least 1; the orbit found may have a shorter one that divides it.

    Returns
    -------
    PeriodicOrbit
        Look at its `status` first.

    Raises
    ------
    ValueError
        For an argument out of range.

    Examples
    --------
    >>> orbit = periodic_orbit(Oscillator(), 0.9, -0.3, 1)
    >>> str(orbit.status), orbit.period, orbit.stable
    ('converged', 1, False)
    """
    x, v = check_start(x, v)
    period = check_count("period", period)
    converged, x, v, _ = newton(osc._cells, x, v, period, np.empty((2, 2)), np.empty(TERMS))
    if converged:
        period = _minimal_period(osc, x, v, period)
    return orbit_at(osc, x, v, period, NewtonStatus.CONVERGED if converged else NewtonStatus.DIVERGED)


def _minimal_period(osc: Oscillator, x: float, v: float, period: int) -> int:
    series, here = np.empty(TERMS), (x, v)
    for shorter in range(1, period):
        _, *here = march(osc._cells, *here, 1, series)
        if period % shorter == 0 and max(abs(here[0] - x), abs(here[1] - v)) <= SAME_POINT * max(1.0, abs(x), abs(v)):
            return shorter
    return period


def orbit_at(osc: Oscillator, x: float, v: float, period: int, status: NewtonStatus) -> PeriodicOrbit:
    """Describe the orbit of `period` through (x, v), which Newton's method has found."""
    series = np.empty(TERMS)
    points = np.empty((period, 2))
    points[0] = x, v
    for i in range(1, period):
        points[i] = march(osc._cells, *points[i - 1], 1, series)[1:]
    points = np.roll(points, -int(np.argmin(points[:, 0])), axis=0)
    monodromy = np.empty((2, 2))
    parameters = osc._flow_parameters
    code, *end = map_at(parameters, *points[0], period, monodromy)
    turns = np.empty((MAX_TURNS_PER_PERIOD * period, 3))
    _, n, drive, coast = turns_at(parameters, *points[0], period, turns)
    extremes = np.concatenate([turns[:n, 1], points[:, 0]])
    return PeriodicOrbit(
        oscillator=osc,
        status=status,
        period=period,
        points=points,
        monodromy=monodromy,
        multipliers=multipliers_of(monodromy),
        residual=float(np.max(np.abs(end - points[0]))) if code == OK else np.inf,
        x_min=float(extremes.min()),
        x_max=float(extremes.max()),
        contacts=(drive, coast),
    )


def find_orbits(
    osc: Oscillator,
    max_period: int,
    *,
    x: tuple[float, float] = (-2.0, 3.0),
    v: tuple[float, float] = (-1.5, 1.5),
    n_starts: int = 400,
) -> list[PeriodicOrbit]:
    """The distinct periodic orbits that Newton's method finds from many starts.

    Parameters
    ----------
    osc : Oscillator
    max_period : int
        The longest period looked for, in mesh periods.
    x, v : tuple of float
        The rectangle of starts.
    n_starts : int
        Starts per period, spread evenly (an additive recurrence of low discrepancy, the same at every call).

    Returns
    -------
    list of PeriodicOrbit
        Converged, each once, by period and smallest X. A finite search can miss some.

    Raises
    ------
    ValueError
        For an argument out of range.

    Examples
    --------
    >>> [orbit.period for orbit in find_orbits(Oscillator(damping_ratio=0.1), 2)]
    [1]
    """
    max_period, n_starts = check_count("max_period", max_period), check_count("n_starts", n_starts)
    (x_low, x_high), (v_low, v_high) = check_starts(x, (0.0, 0.0))[0], check_starts(v, (0.0, 0.0))[0]
    i = np.arange(1, n_starts + 1)[:, None]
    spread = np.mod(0.5 + i * np.array([0.7548776662466927, 0.5698402909980532]), 1.0)  # Roberts (2018), R2
    starts = np.array([x_low, v_low]) + spread * np.array([x_high - x_low, v_high - v_low])
    orbits: list[PeriodicOrbit] = []
    for period in range(1, max_period + 1):
        ends, found = np.empty_like(starts), np.zeros(n_starts, np.bool_)
        on_all_cores(newton_starts, (osc._cells, starts, period, ends, found), n_starts, STARTS_AT_ONCE)
        for x_end, v_end in ends[found].tolist():
            if not any(_passes(orbit, x_end, v_end) for orbit in orbits):
                shortest = _minimal_period(osc, x_end, v_end, period)
                orbits.append(orbit_at(osc, x_end, v_end, shortest, NewtonStatus.CONVERGED))
    return sorted(orbits, key=lambda orbit: (orbit.period, orbit.points[0, 0]))


def _passes(orbit: PeriodicOrbit, x: float, v: float) -> bool:
    return bool(np.any(np.max(np.abs(orbit.points - (x, v)), axis=1) < SAME_ORBIT))
