"""Branches of periodic orbits along one parameter, with their folds, flips and grazings."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_number, checked
from gearpair._equality import equal_by_value
from gearpair.bifurcations._orbit_problem import Cycle, OrbitProblem
from gearpair.bifurcations._walk import End, Step, StepSizes, walk_both_ways
from gearpair.bifurcations.locating import Bifurcation, bifurcations_between, merging
from gearpair.bifurcations.orbits import PeriodicOrbit, periodic_orbit
from gearpair.motion.impacts import IMPACT_STATES, ImpactState, impact_codes
from gearpair.motion.stability import multipliers_of
from gearpair.motion.steady import SteadyState
from gearpair.oscillator import Oscillator

SIZES = StepSizes(first=2e-3, smallest=1e-9, largest=2e-2)
ROOM = 2.0  # times the start's own size, which a branch may reach at least
LARGEST_X = 20.0  # where branches that run to infinity, by contact's parametric resonance, are left; see limit_of


@equal_by_value
@dataclass(frozen=True, repr=False)
class Branch:
    """A branch of periodic orbits in the order walked; arrays have one row an orbit, the first again where it closes.

    Attributes
    ----------
    parameter : str
    period : int
        In mesh periods.
    oscillator : Oscillator
        The one started from.
    values : ndarray of float, shape (n,)
        Of the parameter.
    points : ndarray of float, shape (n, period, 2)
        X and X' on the section.
    multipliers : ndarray of complex, shape (n, 2)
        The largest modulus first.
    stable : ndarray of bool, shape (n,)
        Where the branch merges with a shorter orbit, a multiplier is 1: there it is as the orbit next to it.
    x_min, x_max : ndarray of float, shape (n,)
    contacts : ndarray of int, shape (n, 2)
        Contacts per cycle, drive and coast side.
    newton_steps : ndarray of int, shape (n,)
    bifurcations : list of Bifurcation
        In the order met.
    bifurcation_rows : ndarray of int, shape (n_bifurcations,)
        The row of the orbit before each.
    ends : tuple of End
        Why the branch ends where it does, at its first and at its last orbit; ``end.remedy`` says what to do.
    """

    parameter: str
    period: int
    oscillator: Oscillator
    values: NDArray[np.float64]
    points: NDArray[np.float64]
    multipliers: NDArray[np.complex128]
    stable: NDArray[np.bool_]
    x_min: NDArray[np.float64]
    x_max: NDArray[np.float64]
    contacts: NDArray[np.int64]
    newton_steps: NDArray[np.int64]
    bifurcations: list[Bifurcation]
    bifurcation_rows: NDArray[np.int64]
    ends: tuple[End, End]

    def impact_states(self) -> list[ImpactState]:
        """The impact state of each orbit."""
        return [IMPACT_STATES[code] for code in impact_codes(self.x_min, self.x_max)]

    def __repr__(self) -> str:
        """One line: how long it is, between what, and what lies on it."""
        first, last = (f"{self.values[i]:.8g} ({end})" for i, end in zip((0, -1), self.ends, strict=True))
        n = len(self.bifurcations)
        return (
            f"branch of {len(self.values)} orbits of period {self.period} with {n} bifurcation{'s' * (n != 1)}, "
            f"from {self.parameter} = {first} to {last}"
        )


@checked
def continue_orbit(
    orbit: PeriodicOrbit | SteadyState,
    parameter: str,
    lower: float,
    upper: float,
    *,
    largest_step: float = SIZES.largest,
    largest_x: float = LARGEST_X,
    max_steps: int = 2000,
) -> Branch:
    """The branch of periodic orbits through `orbit` along one parameter, in both directions.

    Parameters
    ----------
    orbit : PeriodicOrbit or SteadyState
        Converged, stable or not; or a settled motion that is periodic.
    parameter : str
        One of ``orbit.oscillator.parameters``.
    lower, upper : float
        The range of the parameter, which the orbit's own value lies in.
    largest_step : float
        The longest step in arc length, in units of X, X' and the parameter's range.
    largest_x : float
        Where a branch is left that runs away, in multiples of the static position, ``1 + |F_m| / (mean stiffness)``;
        never below twice the largest modulus of X of the orbit itself.
    max_steps : int
        Steps at most in each direction.

    Raises
    ------
    RuntimeError
        Where the parameter cannot be varied, as a contact ratio next to the end of what is possible.

    Notes
    -----
    Pseudo-arclength continuation (Keller, 1977) on the period map with its exact derivative by the state and a central
    difference by the parameter. Folds and flips are zeros of (mu_1 - 1)(mu_2 - 1) and (mu_1 + 1)(mu_2 + 1), grazings
    zeros of an extremum's distance from X = +-1; each is located by Brent's method along the branch.
    Beyond a grazing multipliers move like the square root of the distance, so the steps shrink
    there by themselves.

    Examples
    --------
    >>> from gearpair import periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(mesh_frequency=1.7), 0.8, -0.1, 2)
    >>> branch = continue_orbit(orbit, "mesh_frequency", 1.6, 1.7)
    >>> [(b.kind, round(b.value, 5)) for b in branch.bifurcations], str(branch.ends[0])
    ([('flip', 1.6139)], 'bound')
    """
    if isinstance(orbit, SteadyState):
        if orbit.period is None:
            raise ValueError(f"orbit must be periodic, got a motion of status {str(orbit.status)!r}: only cycles go on")
        x, v = map(float, orbit.points[0])
        orbit = periodic_orbit(orbit.oscillator, x, v, orbit.period)
    if not orbit.converged or orbit.x_min is None or orbit.x_max is None:
        raise ValueError(f"orbit must have converged, got status {str(orbit.status)!r}: {orbit.status.remedy}")
    lower, upper = check_number("lower", lower), check_number("upper", upper)
    value = orbit.oscillator.parameter(parameter)
    if not lower < upper or not lower <= value <= upper:
        raise ValueError(
            f"lower and upper must enclose the orbit's {parameter} = {value}, got lower = {lower} and upper = {upper}"
        )
    limit = max(
        limit_of(orbit.oscillator, check_number("largest_x", largest_x, above=0.0)),
        ROOM * max(-orbit.x_min, orbit.x_max),
    )
    problem = _BranchProblem(orbit.oscillator, orbit.period, {parameter: upper - lower}, limit)
    start, sizes = problem.unknowns(*orbit.points[0]), SIZES._replace(largest=largest_step)
    steps, ends = walk_both_ways(problem, start, [(lower, upper)], sizes, max_steps)
    found = [(b, i) for i, (a, c) in enumerate(pairwise(steps)) for b in bifurcations_between(problem, a, c)]
    cycles = [step.data for step in steps]
    multipliers = multipliers_of(np.array([c.monodromy for c in cycles]))
    stable = np.abs(multipliers[:, 0]) < 1.0
    for end, last, beside in zip(ends, (0, -1), (1, -2), strict=True):
        if end == End.MERGED:  # rounding does not decide
            stable[last] = stable[beside]
    return Branch(
        parameter=parameter,
        period=orbit.period,
        oscillator=orbit.oscillator,
        values=np.array([problem.values(step.u)[0] for step in steps]),
        points=np.array([c.points for c in cycles]),
        multipliers=multipliers,
        stable=stable,
        x_min=np.array([c.x_min for c in cycles]),
        x_max=np.array([c.x_max for c in cycles]),
        contacts=np.array([c.contacts for c in cycles]),
        newton_steps=np.array([step.newton_steps for step in steps]),
        bifurcations=[bifurcation for bifurcation, _ in found],
        bifurcation_rows=np.array([row for _, row in found], dtype=np.int64),
        ends=ends,
    )


def limit_of(osc: Oscillator, multiple: float) -> float:
    """Where a branch is left: a multiple of the static position, 1 + |F_m| / (mean stiffness)."""
    return multiple * (1.0 + abs(osc.mean_force) / osc.stiffness.mean)


class _BranchProblem(OrbitProblem):
    """A branch of orbits: it ends where its orbit merges with a shorter one or grows without bound."""

    describe = OrbitProblem.cycle

    def __init__(self, osc: Oscillator, period: int, scales: dict[str, float], limit: float) -> None:
        super().__init__(osc, period, scales)
        self.limit = limit

    def ending(self, last: Step[Cycle], step: Step[Cycle]) -> tuple[list[Step[Cycle]], End] | None:
        """The end of a walk at `step`, if it is one."""
        merged = merging(self, last, step)
        if merged is not None:
            return [merged], End.MERGED
        if max(-step.data.x_min, step.data.x_max) > self.limit:
            return [step], End.TOO_LARGE
        return None
