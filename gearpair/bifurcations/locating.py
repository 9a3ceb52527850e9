"""Where along a branch the folds, flips and grazings are: each located by Brent's method between two steps."""

from copy import copy
from dataclasses import dataclass

import numpy as np

from gearpair.bifurcations._orbit_problem import Cycle, Kind, OrbitProblem
from gearpair.bifurcations._walk import Step, Vector
from gearpair.motion.impacts import ImpactState, impact_state
from gearpair.oscillator import Oscillator

Contacts = tuple[int, int]
MERGED = 0.1  # where two points pass each other by less than this share of how far they moved, they have met
TOUCHING = 1e-9  # two points, or an extremum and a boundary, that lie closer than this touch


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
    contacts: tuple[Contacts, Contacts]
    impact_state: ImpactState


def merging(problem: OrbitProblem, a: Step[Cycle], b: Step[Cycle]) -> Step[Cycle] | None:
    """Where the points half a period apart meet between two steps, if they do: the flip of the shorter orbit.

    There the doubled branch and the shorter orbit's own cross, so the flip's own equations are solved.
    """
    before, after = a.data.half_gap(), b.data.half_gap()
    collapsed = np.linalg.norm(after) < TOUCHING  # the step has landed on the shorter orbit's own branch
    if before @ after >= 0.0 and not collapsed:
        return None
    share = 0.0 if collapsed else before @ (before - after) / np.sum((before - after) ** 2)
    if not collapsed and np.linalg.norm(before + share * (after - before)) > MERGED * np.linalg.norm(before - after):
        return None
    from scipy.optimize import root  # here, so that importing gearpair stays quick

    half = copy(problem)
    half.period //= 2

    def flip(u: Vector) -> Vector:
        found = half.equations(u)
        return np.append(found[0], half.cycle(u).test("flip")) if found is not None else np.full(3, np.inf)

    middle = (1.0 - share) * a.u + share * b.u
    middle[:2] += 0.5 * ((1.0 - share) * before + share * after)
    solution = root(flip, middle, tol=1e-13)
    if np.max(np.abs(solution.fun)) > 1e-9 or np.linalg.norm(solution.x - middle) > np.linalg.norm(b.u - a.u):
        return a if collapsed else None
    return Step(solution.x, a.tangent, int(solution.nfev), problem.cycle(solution.x))


def bifurcations_between(problem: OrbitProblem, a: Step[Cycle], b: Step[Cycle]) -> list[Bifurcation]:
    """Every bifurcation between two steps, in order along the chord."""
    multipliers: tuple[Kind, ...] = ("fold", "flip")
    located = [(kind, _located(problem, a, b, kind)) for kind in multipliers]
    found = [(kind, at, at.data.contacts, at.data.contacts) for kind, at in located if at is not None]
    found += _grazings(problem, a, b)
    found.sort(key=lambda item: float(np.linalg.norm(item[1].u - a.u)))
    return [bifurcation_at(problem, *item) for item in found]


def _located(problem: OrbitProblem, a: Step[Cycle], b: Step[Cycle], kind: Kind) -> Step[Cycle] | None:
    """The step where the test of a kind changes sign; None where it does not, or where the branch is lost."""
    if not a.data.test(kind) * b.data.test(kind) < 0.0:
        return None
    from scipy.optimize import brentq  # here, so that importing gearpair stays quick

    def signed(share: float) -> float:
        step = problem.between(a, b, share)
        if step is None:
            raise ArithmeticError
        return step.data.test(kind)

    try:
        return problem.between(a, b, brentq(signed, 0.0, 1.0, xtol=1e-14, rtol=1e-14))
    except (ArithmeticError, ValueError):
        return None


def _grazings(
    problem: OrbitProblem, a: Step[Cycle], b: Step[Cycle]
) -> list[tuple[Kind, Step[Cycle], Contacts, Contacts]]:
    """Between two steps with different contacts: bisect until one extremum crosses one boundary, then Brent."""
    before, after = a.data.contacts, b.data.contacts
    if before == after:
        return []
    if abs(before[0] - after[0]) + abs(before[1] - after[1]) == 1:
        at = _located(problem, a, b, "grazing")
        if at is not None and abs(at.data.test("grazing")) < TOUCHING:
            return [("grazing", at, before, after)]
    if np.linalg.norm(b.u - a.u) < 1e-10:  # two grazings at once
        return [("grazing", a, before, after)]
    middle = problem.between(a, b, 0.5)
    return [] if middle is None else _grazings(problem, a, middle) + _grazings(problem, middle, b)


def bifurcation_at(
    problem: OrbitProblem, kind: Kind, at: Step[Cycle], before: Contacts, after: Contacts
) -> Bifurcation:
    """What a solution of its equations is, with the contacts before and after it along the branch."""
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
