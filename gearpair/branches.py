"""Branches of periodic orbits along one parameter, with their folds, flips and grazings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from gearpair._arclength import Step, Vector, between, correct, follow
from gearpair._checks import check_count, check_number
from gearpair._flow.cycle import map_at
from gearpair._orbit_problem import Cycle, OrbitProblem
from gearpair.impacts import ImpactState, impact_state
from gearpair.orbits import NewtonStatus, PeriodicOrbit, multipliers_of, orbit_at
from gearpair.oscillator import Oscillator

Kind = Literal["fold", "flip", "grazing"]
FIRST_STEP, SMALLEST_STEP, LARGEST_STEP = 2e-3, 1e-9, 2e-2  # in scaled arc length
MERGED = 0.1  # where two points pass each other by less than this share of how far they moved, they have met
LARGEST_X = 20.0  # where branches that run to infinity, by contact's parametric resonance, are left; see largest_x
TOUCHING = 1e-9  # two points, or a turning point and a boundary, that lie closer than this touch


@dataclass(frozen=True)
class Bifurcation:
    """A bifurcation of a branch.

    Attributes
    ----------
    kind : {"fold", "flip", "grazing"}
        Multiplier +1, multiplier -1, or an extremum of the orbit touching X = +-1.
    parameter : str
    value : float
        Of the parameter, to 1e-8 or better.
    period : int
        Of the orbit, in mesh periods.
    x, v : float
        The section point of the orbit with the smallest X.
    oscillator : Oscillator
        At that value.
    contacts : tuple of two tuples of int
        Contacts per cycle (drive, coast) before and after it along the branch; equal but for a grazing.
    impact_state : ImpactState
        Of the orbit there; at a grazing, of the side with fewer contacts.
    """

    kind: Kind
    parameter: str
    value: float
    period: int
    x: float
    v: float
    oscillator: Oscillator
    contacts: tuple[tuple[int, int], tuple[int, int]]
    impact_state: ImpactState


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


def _merging(problem: OrbitProblem, a: Step[Cycle], b: Step[Cycle]) -> Step[Cycle] | None:
    """Where the points half a period apart meet between two steps, if they do: the flip of the shorter orbit.

    There the doubled branch and the shorter orbit's own cross, so the flip's own equations are solved.
    """
    before, after = a.data.half_gap, b.data.half_gap
    collapsed = np.linalg.norm(after) < TOUCHING  # the step has landed on the shorter orbit's own branch
    if before @ after >= 0.0 and not collapsed:
        return None
    share = before @ (before - after) / np.sum((before - after) ** 2)
    if not collapsed and np.linalg.norm(before + share * (after - before)) > MERGED * np.linalg.norm(before - after):
        return None
    from scipy.optimize import root  # here, so that importing gearpair stays quick

    half = OrbitProblem(
        problem.osc, problem.period // 2, dict(zip(problem.names, problem.scales.tolist(), strict=True))
    )

    def flip(u: Vector) -> Vector:
        found = half.equations(u)
        return np.append(found[0], half.cycle(u).flip_test) if found is not None else np.full(3, np.inf)

    middle = a.u.copy() if collapsed else (1.0 - share) * a.u + share * b.u
    middle[:2] += 0.5 * before if collapsed else 0.5 * ((1.0 - share) * before + share * after)
    solution = root(flip, middle, tol=1e-13)
    lost = np.max(np.abs(solution.fun)) > 1e-9 or np.linalg.norm(solution.x - middle) > np.linalg.norm(b.u - a.u)
    if lost:
        return a if collapsed else None
    return Step(solution.x, a.tangent, int(solution.nfev), problem.cycle(solution.x))


def _last_value(problem: OrbitProblem, steps: list[Step[Cycle]]) -> float:
    return float(problem.values(steps[-1].u)[0]) if steps else problem.osc.parameter(problem.names[0])


def _at_value(problem: OrbitProblem, inside: Step[Cycle], outside: Step[Cycle], bound: float) -> Step[Cycle] | None:
    share = (bound / problem.scales[0] - inside.u[2]) / (outside.u[2] - inside.u[2])
    guess = inside.u + share * (outside.u - inside.u)
    guess[2] = bound / problem.scales[0]
    found = correct(problem.equations, guess, np.array([0.0, 0.0, 1.0]))
    return Step(*found, problem.cycle(found[0])) if found is not None else None


def _locate(
    problem: OrbitProblem, a: Step[Cycle], b: Step[Cycle], test: Callable[[Cycle], float]
) -> Step[Cycle] | None:
    """The step between `a` and `b` where `test` is zero (it changes sign), or None where the branch is lost."""

    from scipy.optimize import brentq  # here, so that importing gearpair stays quick

    def signed(share: float) -> float:
        found = between(problem.equations, a.u, b.u, share)
        if found is None:
            raise ArithmeticError
        return test(problem.cycle(found[0]))

    try:
        share = brentq(signed, 0.0, 1.0, xtol=1e-14, rtol=1e-14)
    except (ArithmeticError, ValueError):
        return None
    found = between(problem.equations, a.u, b.u, share)
    return Step(*found, problem.cycle(found[0])) if found is not None else None


def _bifurcations(problem: OrbitProblem, a: Step[Cycle], b: Step[Cycle]) -> list[Bifurcation]:
    """Every bifurcation between two steps, in order along the chord."""
    found: list[tuple[Kind, Step[Cycle], tuple[int, int], tuple[int, int]]] = []
    tests: list[tuple[Kind, Callable[[Cycle], float]]] = [
        ("fold", lambda cycle: cycle.fold_test),
        ("flip", lambda cycle: cycle.flip_test),
    ]
    for kind, test in tests:
        if test(a.data) * test(b.data) < 0.0:
            at = _locate(problem, a, b, test)
            if at is not None:
                found.append((kind, at, at.data.contacts, at.data.contacts))
    found += [("grazing", at, before, after) for at, before, after in _grazings(problem, a, b)]
    found.sort(key=lambda item: float(np.linalg.norm(item[1].u - a.u)))
    return [_bifurcation(problem, *item) for item in found]


def _grazings(
    problem: OrbitProblem, a: Step[Cycle], b: Step[Cycle]
) -> list[tuple[Step[Cycle], tuple[int, int], tuple[int, int]]]:
    """Between two steps with different contacts: bisect until one turning point crosses one boundary, then Brent."""
    before, after = a.data.contacts, b.data.contacts
    if before == after:
        return []
    if abs(before[0] - after[0]) + abs(before[1] - after[1]) == 1 and a.data.gap * b.data.gap < 0.0:
        at = _locate(problem, a, b, lambda cycle: cycle.gap)
        if at is not None and abs(at.data.gap) < TOUCHING:
            return [(at, before, after)]
    if np.linalg.norm(b.u - a.u) < 1e-10:  # two grazings at once
        return [(a, before, after)]
    middle = between(problem.equations, a.u, b.u, 0.5)
    if middle is None:
        return []
    step = Step(*middle, problem.cycle(middle[0]))
    return _grazings(problem, a, step) + _grazings(problem, step, b)


def _bifurcation(
    problem: OrbitProblem, kind: Kind, at: Step[Cycle], before: tuple[int, int], after: tuple[int, int]
) -> Bifurcation:
    point = at.data.points[np.argmin(at.data.points[:, 0])]
    x_min, x_max = at.data.x_min, at.data.x_max
    if kind == "grazing":  # touching is not yet impacting
        x_min, x_max = (round(x, 8) if abs(abs(x) - 1.0) < 1e-8 else x for x in (x_min, x_max))
    return Bifurcation(
        kind=kind,
        parameter=problem.names[0],
        value=float(problem.values(at.u)[0]),
        period=problem.period,
        x=float(point[0]),
        v=float(point[1]),
        oscillator=problem.oscillator(at.u),
        contacts=(before, after),
        impact_state=impact_state(x_min, x_max),
    )


def doubled_orbit(bifurcation: Bifurcation) -> PeriodicOrbit:
    """An orbit of twice the period close to a flip: the start of the doubled branch.

    Parameters
    ----------
    bifurcation : Bifurcation
        Of kind ``"flip"``.

    Returns
    -------
    PeriodicOrbit
        At a parameter value next to the flip's, on the side where the doubled branch is born.

    Raises
    ------
    ValueError
        For another kind.
    RuntimeError
        Where no doubled orbit was found, as when the flip lies on a grazing.
    """
    if bifurcation.kind != "flip":
        raise ValueError(f"bifurcation must be a flip, got a {bifurcation.kind} at {bifurcation.value}")
    osc, name = bifurcation.oscillator, bifurcation.parameter
    monodromy = np.empty((2, 2))
    map_at(osc._flow_parameters, bifurcation.x, bifurcation.v, bifurcation.period, monodromy)
    across = np.linalg.svd(monodromy + np.eye(2))[2][-1]
    problem = OrbitProblem(osc, 2 * bifurcation.period, {name: max(abs(bifurcation.value), 1e-3)})
    u = problem.unknowns(bifurcation.x, bifurcation.v)
    normal = np.array([*across, 0.0])
    for distance in (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-3, 1e-2):
        found = correct(problem.equations, u + distance * normal, normal)
        if found is not None and np.max(np.abs(problem.cycle(found[0]).half_gap)) > distance:
            x, v = found[0][:2].tolist()
            return orbit_at(problem.oscillator(found[0]), x, v, problem.period, NewtonStatus.CONVERGED)
    raise RuntimeError(
        f"no orbit of period {2 * bifurcation.period} was found near the flip at {name} = {bifurcation.value}"
    )
