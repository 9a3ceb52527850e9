"""Branches of periodic orbits along one parameter, with their folds, flips and grazings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, root

from gearpair._arclength import Step, Vector, between, correct, follow
from gearpair._checks import check_count, check_number
from gearpair._flow.cells import Parameters
from gearpair._flow.cycle import map_at, plain_map_at, turns_at
from gearpair._flow.march import OK
from gearpair.impacts import ImpactState, impact_state
from gearpair.orbits import (
    MAX_TURNS_PER_PERIOD,
    SAME_ORBIT,
    NewtonStatus,
    PeriodicOrbit,
    find_orbits,
    multipliers_of,
    orbit_at,
    periodic_orbit,
)
from gearpair.oscillator import SCALARS, Oscillator

Kind = Literal["fold", "flip", "grazing"]
DIFFERENCE = 1e-6  # relative step of the central difference by the parameter
FIRST_STEP, SMALLEST_STEP, LARGEST_STEP = 2e-3, 1e-9, 2e-2  # in scaled arc length
MERGED = 0.1  # where two points pass each other by less than this share of how far they moved, they have met
LARGEST_X = 20.0  # branches that run to infinity, as contact's parametric resonance makes them, are left here
TOUCHING = 1e-9  # a located grazing's distance from the boundary is below this


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


CLOSED = "closed: the branch returned to its start"


def _walk(
    problem: OrbitProblem, start: Vector, sign: float, lower: float, upper: float, largest: float, max_steps: int
) -> tuple[list[Step[Cycle]], str]:
    """The steps from `start` in one direction, and why they end."""
    name, scale = problem.names[0], problem.scales[0]
    direction = np.array([0.0, 0.0, sign])
    steps: list[Step[Cycle]] = []
    walk = follow(
        problem.equations, problem.cycle, start, direction, first=FIRST_STEP, smallest=SMALLEST_STEP, largest=largest
    )
    for step in walk:
        value = step.u[2] * scale
        if not lower <= value <= upper:
            bound = lower if value < lower else upper
            edge = _at_value(problem, steps[-1], step, bound) if steps else None
            if edge is not None:
                steps.append(edge)
            return steps, f"reached {name} = {bound:g}"
        merged = _merging(problem, steps[-1], step) if steps else None
        if merged is not None:
            steps.append(merged)
            return steps, f"merges at {name} = {merged.u[2] * scale:.8g} with the orbit of half its period (flip)"
        steps.append(step)
        if max(-step.data.x_min, step.data.x_max) > LARGEST_X:
            return steps, f"grows beyond |X| = {LARGEST_X:g} at {name} = {value:.8g}"
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
    if before @ after >= 0.0:
        return None
    share = before @ (before - after) / np.sum((before - after) ** 2)
    if np.linalg.norm(before + share * (after - before)) > MERGED * np.linalg.norm(before - after):
        return None
    half = OrbitProblem(problem.osc, problem.period // 2, dict(zip(problem.names, problem.scales.tolist(), strict=True)))

    def flip(u: Vector) -> Vector:
        found = half.equations(u)
        return np.append(found[0], half.cycle(u).flip_test) if found is not None else np.full(3, np.inf)

    middle = (1.0 - share) * a.u + share * b.u
    middle[:2] += 0.5 * ((1.0 - share) * before + share * after)
    solution = root(flip, middle, tol=1e-13)
    if np.max(np.abs(solution.fun)) > 1e-9 or np.linalg.norm(solution.x - middle) > np.linalg.norm(b.u - a.u):
        return None
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
    for distance in (1e-3, 1e-4, 1e-2, 1e-5):
        found = correct(problem.equations, u + distance * normal, normal)
        if found is not None and np.max(np.abs(problem.cycle(found[0]).half_gap)) > distance:
            return orbit_at(
                problem.oscillator(found[0]), *found[0][:2].tolist(), problem.period, NewtonStatus.CONVERGED
            )
    raise RuntimeError(
        f"no orbit of period {2 * bifurcation.period} was found near the flip at {name} = {bifurcation.value}"
    )


def find_branches(
    osc: Oscillator,
    parameter: str,
    lower: float,
    upper: float,
    *,
    max_period: int = 4,
    n_values: int = 11,
    n_starts: int = 100,
    largest_step: float = LARGEST_STEP,
) -> list[Branch]:
    """The branches of periodic orbits that a search finds in a range of one parameter.

    Orbits are looked for from many starts at evenly spaced values; each that lies on no branch yet is
    continued, and so is the doubled branch of each flip, up to `max_period`.

    Parameters
    ----------
    osc : Oscillator
    parameter : str
        One of ``osc.parameters``.
    lower, upper : float
        The range of the parameter.
    max_period : int
        The longest period followed, in mesh periods.
    n_values : int
        Values at which orbits are looked for.
    n_starts : int
        Starts per value and period, as in `find_orbits`.
    largest_step : float
        As in `continue_orbit`.

    Returns
    -------
    list of Branch
        In the order found. A finite search can miss some.

    Raises
    ------
    ValueError
        For an argument out of range.
    """
    branches: list[Branch] = []
    for value in np.linspace(lower, upper, check_count("n_values", n_values)).tolist():
        waiting: list[PeriodicOrbit | Bifurcation] = [
            *find_orbits(osc.replace(**{parameter: value}), max_period, n_starts=n_starts)
        ]
        while waiting:
            orbit = _start(branches, waiting.pop(0), lower, upper)
            if orbit is not None:
                branch = continue_orbit(orbit, parameter, lower, upper, largest_step=largest_step)
                branches.append(branch)
                waiting += [b for b in branch.bifurcations if b.kind == "flip" and 2 * b.period <= max_period]
    return branches


def _start(
    branches: list[Branch], found: PeriodicOrbit | Bifurcation, lower: float, upper: float
) -> PeriodicOrbit | None:
    """The orbit to continue from an orbit or a flip, or None where that leads to nothing new."""
    if isinstance(found, PeriodicOrbit):
        large = max(-found.x_min, found.x_max) > LARGEST_X
        return None if large or any(_on_branch(branch, found) for branch in branches) else found
    for branch in branches:
        if branch.period == 2 * found.period and np.any(np.abs(branch.values[[0, -1]] - found.value) < 1e-6):
            return None
    try:
        orbit = doubled_orbit(found)
    except RuntimeError:
        return None
    return orbit if lower <= orbit.oscillator.parameter(found.parameter) <= upper else None


def _on_branch(branch: Branch, orbit: PeriodicOrbit) -> bool:
    """Whether Newton's method, started from the branch interpolated to the orbit's value, leads to the orbit."""
    if branch.period != orbit.period:
        return False
    value = orbit.oscillator.parameter(branch.parameter)
    left, right = branch.values[:-1], branch.values[1:]
    for i in np.flatnonzero((np.minimum(left, right) <= value) & (value <= np.maximum(left, right))):
        share = (value - left[i]) / (right[i] - left[i]) if right[i] != left[i] else 0.0
        x, v = (1.0 - share) * branch.points[i, 0] + share * branch.points[i + 1, 0]
        if np.min(np.max(np.abs(orbit.points - (x, v)), axis=1)) > 0.1:
            continue
        found = periodic_orbit(orbit.oscillator, x, v, orbit.period)
        if found.converged and np.min(np.max(np.abs(orbit.points - found.points[0]), axis=1)) < SAME_ORBIT:
            return True
    return False
