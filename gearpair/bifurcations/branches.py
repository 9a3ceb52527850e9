"""Branches of periodic orbits along one parameter, with their folds, flips and grazings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count, check_number
from gearpair.bifurcations._arclength import Step, Vector, correct, follow
from gearpair.bifurcations._orbit_problem import Cycle, OrbitProblem
from gearpair.bifurcations.locating import Bifurcation, _bifurcations, _merging
from gearpair.bifurcations.orbits import PeriodicOrbit
from gearpair.motion.impacts import ImpactState, impact_state
from gearpair.motion.stability import multipliers_of
from gearpair.oscillator import Oscillator

FIRST_STEP, SMALLEST_STEP, LARGEST_STEP = 2e-3, 1e-9, 2e-2  # in scaled arc length
LARGEST_X = 20.0  # where branches that run to infinity, by contact's parametric resonance, are left; see largest_x


@dataclass(frozen=True)
class Branch:
    """A branch of periodic orbits in the order walked; arrays have one row an orbit.

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
    x_min, x_max : ndarray of float, shape (n,)
    contacts : ndarray of int, shape (n, 2)
        Contacts per cycle, drive and coast side.
    newton_steps : ndarray of int, shape (n,)
    bifurcations : list of Bifurcation
        In the order met.
    ends : tuple of str
        Why the branch ends where it does, at its first and at its last orbit.
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
    ends: tuple[str, str]

    def impact_states(self) -> list[ImpactState]:
        """The impact state of each orbit."""
        return [impact_state(low, high) for low, high in zip(self.x_min.tolist(), self.x_max.tolist(), strict=True)]


def continue_orbit(
    orbit: PeriodicOrbit,
    parameter: str,
    lower: float,
    upper: float,
    *,
    largest_step: float = LARGEST_STEP,
    max_steps: int = 2000,
) -> Branch:
    """The branch of periodic orbits through `orbit` along one parameter, in both directions.

    Parameters
    ----------
    orbit : PeriodicOrbit
        Converged, stable or not.
    parameter : str
        One of ``orbit.oscillator.parameters``.
    lower, upper : float
        The range of the parameter, which the orbit's own value lies in.
    largest_step : float
        The longest step in arc length, in units of X, X' and the parameter's range.
    max_steps : int
        Steps at most in each direction.

    Returns
    -------
    Branch

    Raises
    ------
    ValueError
        For an orbit that has not converged, an unknown parameter, or a range that leaves out its value.

    Notes
    -----
    Pseudo-arclength continuation (Keller, 1977) on the period map with its exact derivative by the state and a central
    difference by the parameter. Folds and flips are zeros of (mu_1 - 1)(mu_2 - 1) and (mu_1 + 1)(mu_2 + 1), grazings
    zeros of a turning point's distance from X = +-1; each is located by Brent's method along the branch.
    Beyond a grazing multipliers move like the square root of the distance, so the steps shrink
    there by themselves.

    Examples
    --------
    >>> from gearpair import periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(mesh_frequency=1.7), 0.8, -0.1, 2)
    >>> branch = continue_orbit(orbit, "mesh_frequency", 1.6, 1.7)
    >>> branch.ends[1]
    'reached mesh_frequency = 1.7'
    """
    if not orbit.converged:
        raise ValueError(f"orbit must have converged, got status {str(orbit.status)!r}: {orbit.status.remedy}")
    lower, upper = check_number("lower", lower), check_number("upper", upper)
    value = orbit.oscillator.parameter(parameter)
    if not lower < upper or not lower <= value <= upper:
        raise ValueError(
            f"lower and upper must enclose the orbit's {parameter} = {value}, got lower = {lower} and upper = {upper}"
        )
    check_number("largest_step", largest_step, above=0.0)
    check_count("max_steps", max_steps)
    problem = OrbitProblem(orbit.oscillator, orbit.period, {parameter: upper - lower})
    start = problem.unknowns(*orbit.points[0])
    back, back_end = _walk(problem, start, -1.0, lower, upper, largest_step, max_steps)
    if back_end == CLOSED:
        steps, ends = back, (CLOSED, CLOSED)
    else:
        forth, forth_end = _walk(problem, start, 1.0, lower, upper, largest_step, max_steps)
        steps, ends = back[:0:-1] + forth, (back_end, forth_end)
    found = [b for a, c in zip(steps, steps[1:], strict=False) for b in _bifurcations(problem, a, c)]
    cycles = [step.data for step in steps]
    multipliers = multipliers_of(np.array([c.monodromy for c in cycles]).reshape(-1, 2, 2))
    return Branch(
        parameter=parameter,
        period=orbit.period,
        oscillator=orbit.oscillator,
        values=np.array([problem.values(step.u)[0] for step in steps]),
        points=np.array([c.points for c in cycles]),
        multipliers=multipliers,
        stable=np.abs(multipliers[:, 0]) < 1.0,
        x_min=np.array([c.x_min for c in cycles]),
        x_max=np.array([c.x_max for c in cycles]),
        contacts=np.array([c.contacts for c in cycles]),
        newton_steps=np.array([step.newton_steps for step in steps]),
        bifurcations=found,
        ends=ends,
    )


def largest_x(osc: Oscillator) -> float:
    """Where a branch is left: `LARGEST_X` times the static position, 1 + |F_m| / (mean stiffness)."""
    return LARGEST_X * (1.0 + abs(osc.mean_force) / osc.stiffness.mean)


CLOSED = "closed: the branch returned to its start"


def _walk(
    problem: OrbitProblem, start: Vector, sign: float, lower: float, upper: float, largest: float, max_steps: int
) -> tuple[list[Step[Cycle]], str]:
    """The steps from `start` in one direction, and why they end."""
    name, scale = problem.names[0], problem.scales[0]
    limit = largest_x(problem.osc)
    direction = np.array([0.0, 0.0, sign])
    steps: list[Step[Cycle]] = []
    walk = follow(
        problem.equations, problem.cycle, start, direction, first=FIRST_STEP, smallest=SMALLEST_STEP, largest=largest
    )
    for step in walk:
        value = step.u[2] * scale
        if steps and not lower <= value <= upper:
            bound = lower if value < lower else upper
            edge = _at_value(problem, steps[-1], step, bound)
            if edge is not None and np.max(np.abs(edge.u - steps[-1].u)) > SMALLEST_STEP:
                steps.append(edge)
            return steps, f"reached {name} = {bound:g}"
        merged = _merging(problem, steps[-1], step) if steps else None
        if merged is not None:
            steps.append(merged)
            return steps, f"merges at {name} = {merged.u[2] * scale:.8g} with the orbit of half its period (flip)"
        steps.append(step)
        if max(-step.data.x_min, step.data.x_max) > limit:
            return steps, f"grows beyond |X| = {limit:g} at {name} = {value:.8g}"
        away = np.linalg.norm(step.u - start)
        if len(steps) > 20 and away < np.linalg.norm(step.u - steps[-2].u) and step.tangent @ steps[0].tangent > 0.5:
            return steps, CLOSED
        if len(steps) >= max_steps:
            return steps, f"stopped after max_steps = {max_steps} steps"
    return steps, f"no step of {SMALLEST_STEP:g} or more converged beyond {name} = {_last_value(problem, steps):.8g}"


def _last_value(problem: OrbitProblem, steps: list[Step[Cycle]]) -> float:
    return float(problem.values(steps[-1].u)[0]) if steps else problem.osc.parameter(problem.names[0])


def _at_value(problem: OrbitProblem, inside: Step[Cycle], outside: Step[Cycle], bound: float) -> Step[Cycle] | None:
    share = (bound / problem.scales[0] - inside.u[2]) / (outside.u[2] - inside.u[2])
    guess = inside.u + share * (outside.u - inside.u)
    guess[2] = bound / problem.scales[0]
    found = correct(problem.equations, guess, np.array([0.0, 0.0, 1.0]))
    return Step(*found, problem.cycle(found[0])) if found is not None else None
