"""Periodic orbits, stable or not, by Newton's method on the period map."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count, check_reach, checked
from gearpair._cores import aside, on_all_cores
from gearpair._equality import equal_by_value
from gearpair._flow.newton import NEWTON_STEPS, newton_starts
from gearpair.bifurcations._orbit_problem import describe_cycle
from gearpair.motion.impacts import ImpactState, impact_state
from gearpair.motion.names import Motion, periodic
from gearpair.motion.outcome import Outcome
from gearpair.motion.same_orbit import lies_on
from gearpair.motion.stability import multipliers_of
from gearpair.motion.trajectories import check_start
from gearpair.oscillator import Oscillator

STARTS_AT_ONCE = 16  # of Newton searches, between two chances to stop


class NewtonStatus(Outcome):
    """How Newton's method ended: a string, with a `remedy` that says what a user may do."""

    CONVERGED = "converged", "the residual is at rounding"
    DIVERGED = (
        "diverged",
        "no orbit of this period was found from this start: start nearer to it, "
        "or search from many starts with find_orbits",
    )


@equal_by_value
@dataclass(frozen=True, repr=False)
class PeriodicOrbit:
    """A periodic orbit, stable or not; or the best state reached, where Newton's method did not converge.

    Attributes
    ----------
    oscillator : Oscillator
    status : NewtonStatus
        ``"converged"`` or ``"diverged"``; ``status.remedy`` says what to do.
    period : int
        The minimal period, in mesh periods, which divides the period asked for; that one where diverged.
    points : ndarray of float, shape (period, 2)
        X and X' on the section, in the order visited, from the smallest X; shape (1, 2), the best state reached, where
        diverged.
    residual : float
        Largest component of map(point) - point; inf where the motion could not be followed.
    monodromy : ndarray of float, shape (2, 2), or None
        The derivative of the period map at ``points[0]``; its determinant is ``exp(-2 zeta period T)``, zeta the mean
        over time where free flight has another. Only of an orbit that meets no damping on its way can complex
        multipliers reach the unit circle: there is no other Neimark-Sacker bifurcation. This and what follows is None
        where diverged: what is no orbit has no stability.
    multipliers : ndarray of complex, shape (2,), or None
        Floquet multipliers, the largest modulus first.
    x_min, x_max : float or None
        Extremes of X over the cycle, at exact roots of X'.
    contacts : tuple of int, or None
        Contacts begun per cycle on the drive and on the coast side.
    """

    oscillator: Oscillator
    status: NewtonStatus
    period: int
    points: NDArray[np.float64]
    residual: float
    monodromy: NDArray[np.float64] | None = None
    multipliers: NDArray[np.complex128] | None = None
    x_min: float | None = None
    x_max: float | None = None
    contacts: tuple[int, int] | None = None

    @property
    def converged(self) -> bool:
        """Whether `status` is ``"converged"``."""
        return self.status == NewtonStatus.CONVERGED

    @property
    def stable(self) -> bool | None:
        """Whether both multipliers lie inside the unit circle; None where Newton's method did not converge."""
        return None if self.multipliers is None else bool(np.abs(self.multipliers[0]) < 1.0)

    @property
    def impact_state(self) -> ImpactState | None:
        """The impact state of the cycle; None where Newton's method did not converge."""
        return None if self.x_min is None or self.x_max is None else impact_state(self.x_min, self.x_max)

    @property
    def motion(self) -> Motion | None:
        """Its period and impact state as one; None where Newton's method did not converge."""
        return periodic(self.period, self.impact_state) if self.converged else None

    def __repr__(self) -> str:
        """One line; it says so where there is no orbit."""
        x, v = self.points[0]
        if self.multipliers is None:
            return (
                f"no orbit of period {self.period}: Newton's method did not converge, "
                f"at best to a residual of {self.residual:.1e} at X = {x:.5g}, X' = {v:.5g}"
            )
        stability = "stable" if self.stable else "unstable"
        first, second = self.multipliers
        pair = f"{first.real:.4g} ± {first.imag:.4g}j" if first.imag else f"{first.real:.4g} and {second.real:.4g}"
        return (
            f"{stability} orbit of period {self.period}, {self.impact_state}, "
            f"through X = {x:.5g}, X' = {v:.5g}: multipliers {pair}"
        )


@checked
def periodic_orbit(osc: Oscillator, x: float, v: float, period: int) -> PeriodicOrbit:
    """The periodic orbit near (x, v), by Newton's method on the `period`-fold map with its exact derivative.

    Look at its `status` first: where that is ``"diverged"`` there is no orbit to describe.

    Parameters
    ----------
    osc : Oscillator
    x, v : float
        A guess of one of its points on the section.
    period : int
        In mesh periods, at least 1; the orbit found may have a shorter one that divides it.

    Examples
    --------
    >>> periodic_orbit(Oscillator(), 0.34, -0.25, 2)
    stable orbit of period 2, single_drive, through X = 0.34629, X' = -0.25625: multipliers -0.2375 ± 0.6567j
    >>> print(periodic_orbit(Oscillator(), 300.0, 100.0, 7).stable)
    None
    """
    x, v = check_start(x, v)
    period = check_count("period", period)
    ends, periods, residuals = _newton(osc, np.array([[x, v]]), period)
    if periods[0] == 0:
        return PeriodicOrbit(osc, NewtonStatus.DIVERGED, period, ends, float(residuals[0]))
    x, v = ends[0].tolist()
    return orbit_at(osc, x, v, int(periods[0]))


def _newton(
    osc: Oscillator, starts: NDArray[np.float64], period: int
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64]]:
    """Where Newton's method ends from each start (n, 2), the orbit's own period (0: none found) and the residual."""
    n = len(starts)
    ends, periods, residuals = np.empty_like(starts), np.zeros(n, np.int64), np.empty(n)
    arguments, longest = (osc.cells, starts, period, ends, periods, residuals), NEWTON_STEPS * period * osc.mesh_periods
    on_all_cores(newton_starts, arguments, n, STARTS_AT_ONCE, longest=longest)
    return ends, periods, residuals


def orbit_at(osc: Oscillator, x: float, v: float, period: int) -> PeriodicOrbit:
    """Describe the orbit of `period` through (x, v), which Newton's method has found."""
    span = period * osc.mesh_periods
    cycle = aside(describe_cycle, osc.coefficients, x, v, period, periods=span)
    lowest = int(np.argmin(cycle.points[:, 0]))
    if lowest:
        x, v = cycle.points[lowest].tolist()
        cycle = aside(describe_cycle, osc.coefficients, x, v, period, periods=span)
    return PeriodicOrbit(
        oscillator=osc,
        status=NewtonStatus.CONVERGED,
        period=period,
        points=cycle.points,
        residual=cycle.residual,
        monodromy=cycle.monodromy,
        multipliers=multipliers_of(cycle.monodromy),
        x_min=cycle.x_min,
        x_max=cycle.x_max,
        contacts=cycle.contacts,
    )


@checked
def find_orbits(
    osc: Oscillator,
    max_period: int,
    *,
    x: tuple[float, float] = (-2.0, 3.0),
    v: tuple[float, float] = (-1.5, 1.5),
    n_starts: int = 400,
) -> list[PeriodicOrbit]:
    """The distinct periodic orbits that Newton's method finds from many starts, by period and smallest X.

    All have converged. A finite search can miss some.

    Parameters
    ----------
    osc : Oscillator
    max_period : int
        The longest period looked for, in mesh periods.
    x, v : tuple of float
        The rectangle of starts.
    n_starts : int
        Starts per period, spread evenly (an additive recurrence of low discrepancy, the same at every call).

    Examples
    --------
    >>> [orbit.period for orbit in find_orbits(Oscillator(damping_ratio=0.1), 2)]
    [1]
    """
    max_period, n_starts = check_count("max_period", max_period), check_count("n_starts", n_starts)
    (x_low, x_high), (v_low, v_high) = check_reach("x", x), check_reach("v", v)
    i = np.arange(1, n_starts + 1)[:, None]
    spread = np.mod(0.5 + i * np.array([0.7548776662466927, 0.5698402909980532]), 1.0)  # Roberts (2018), R2
    starts = np.array([x_low, v_low]) + spread * np.array([x_high - x_low, v_high - v_low])
    orbits: list[PeriodicOrbit] = []
    for period in range(1, max_period + 1):
        ends, periods, _residuals = _newton(osc, starts, period)
        for (x_end, v_end), own in zip(ends.tolist(), periods.tolist(), strict=True):
            if own and not any(lies_on((x_end, v_end), orbit.points) for orbit in orbits):
                orbits.append(orbit_at(osc, x_end, v_end, own))
    return sorted(orbits, key=lambda orbit: (orbit.period, orbit.points[0, 0]))
