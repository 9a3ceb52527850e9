"""A curve of solutions of n equations in n + 1 unknowns, walked both ways by pseudo-arclength (Keller, 1977)."""

from collections.abc import Callable, Iterator, Sequence
from copy import copy
from dataclasses import dataclass
from typing import Generic, NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count, check_number
from gearpair.motion.outcome import Outcome

Vector = NDArray[np.float64]
Data = TypeVar("Data")
# Residual (n,) and Jacobian (n, n + 1) at u; None where the equations cannot be evaluated.
Equations = Callable[[Vector], tuple[Vector, NDArray[np.float64]] | None]
NEWTON_STEPS = 12
QUICK = 4  # Newton steps below which the next arc step may grow
CLOSE = 1e-11  # convergence: the last Newton step, in scaled unknowns
LEAST_COSINE = 0.97  # between successive tangents, below which a step is repeated, halved
ON_BOUND = 1e-9  # a solution this close to a bound, in scaled unknowns, is on it
REACHES = (1e-4, 1e-5)  # how far beyond a solution to look for the equations beyond a kink
ALIGNED = 0.5  # cosine between the tangents of a walk's first step and of the one that comes back to it


class End(Outcome):
    """Why a branch or a curve ends: a string, with a `remedy` that says what a user may do.

    Examples
    --------
    >>> End("closed").remedy
    'it came back to its start: there is no more of it'
    """

    BOUND = "bound", "it reached a bound of a parameter: widen the range to follow it further"
    CLOSED = "closed", "it came back to its start: there is no more of it"
    MERGED = (
        "merged",
        "its orbit became one of half its period, at a flip of that orbit: continue that one from there",
    )
    TOO_LARGE = (
        "too_large",
        "its orbit grew far beyond the backlash, as by contact's parametric resonance: "
        "raise damping_ratio, or narrow the range",
    )
    MAX_STEPS = "max_steps", "it was cut short after max_steps steps: raise max_steps"
    GRAZES = (
        "grazes",
        "its orbit also touches X = +-1 there, a point of codimension two: one more contact moves the multipliers like "
        "a square root, so that the curve goes on along the grazing, too close to be followed: continue from beyond",
    )
    LOST = (
        "lost",
        "no further step converged, as at a degenerate point, or at a kink, which the curve of a bifurcation passes "
        "unless over_kinks=False: continue from an orbit beyond it, or change another parameter a little",
    )


class StepSizes(NamedTuple):
    """The first, the smallest and the largest step, in scaled arc length."""

    first: float
    smallest: float
    largest: float


@dataclass(frozen=True)
class Step(Generic[Data]):
    """A point of the curve, in scaled unknowns."""

    u: Vector
    tangent: Vector
    newton_steps: int
    data: Data


class Problem(Protocol[Data]):
    """What a walk asks: equations in (x, v, parameters / scales), and when to stop."""

    scales: NDArray[np.float64]

    def equations(self, u: Vector) -> tuple[Vector, NDArray[np.float64]] | None:
        """As `Equations`."""

    def describe(self, u: Vector) -> Data:
        """What is kept of the solution `u`, to which the walk has just come."""

    def values(self, u: Vector) -> Vector:
        """The parameters' values."""

    def ending(self, last: Step[Data], step: Step[Data]) -> tuple[list[Step[Data]], End] | None:
        """Where the walk ends at `step`, after `last`: the steps to end with, and why; None where it goes on."""

    def stop(self, step: Step[Data]) -> End:
        """Why no step beyond `step` converges, kinks aside."""


def null_vector(matrix: NDArray[np.float64]) -> Vector:
    """The unit vector that a matrix maps nearest to zero."""
    return np.linalg.svd(matrix)[2][-1]


def newton_step(system: NDArray[np.float64], residual: Vector) -> Vector | None:
    """The change that Newton's method asks for; None where the system is singular or the change leaves the scales."""
    try:
        change = np.asarray(np.linalg.solve(system, -residual), dtype=np.float64)
    except np.linalg.LinAlgError:
        return None
    return change if np.max(np.abs(change)) < 1.0 else None


def correct(equations: Equations, guess: Vector, normal: Vector) -> tuple[Vector, Vector, int] | None:
    """Newton's method in the plane through `guess` across `normal`: (u, tangent, steps), or None."""
    u = guess.copy()
    for step in range(1, NEWTON_STEPS + 1):
        found = equations(u)
        if found is None:
            return None
        residual, jacobian = found
        system = np.vstack([jacobian, normal])
        change = newton_step(system, np.append(residual, normal @ (u - guess)))
        if change is None:
            return None
        u = u + change
        if np.max(np.abs(change)) < CLOSE:
            tangent = null_vector(jacobian)
            return u, tangent if tangent @ normal > 0.0 else -tangent, step
    return None


def walk_both_ways(
    problem: Problem[Data],
    start: Vector,
    bounds: Sequence[tuple[float, float]],
    sizes: StepSizes,
    max_steps: int,
    *,
    over_kinks: bool = False,
) -> tuple[list[Step[Data]], tuple[End, End]]:
    """The steps through the solution `start`, the first parameter rising there, and why they end at either end.

    It takes `max_steps` at most each way within `bounds` of the parameters, each way on a copy of the problem, which
    may remember what it passed. Where the equations have a kink it ends, or goes `over_kinks`.
    """
    check_number("largest_step", sizes.largest, above=0.0)
    check_count("max_steps", max_steps)
    found = problem.equations(start)
    if found is None:
        raise RuntimeError(f"the motion cannot be followed from X = {start[0]:.5g}, X' = {start[1]:.5g}")
    tangent = null_vector(found[1])
    onwards = tangent if tangent[2] >= 0.0 else -tangent

    def walk(direction: Vector) -> tuple[list[Step[Data]], End]:
        own = copy(problem)
        steps: list[Step[Data]] = []
        for step in _steps_along(own, start, direction, sizes, over_kinks):
            if steps:
                on_bound = _at_bound(own, steps[-1], step, bounds)
                if on_bound is not None:
                    return steps + on_bound, End.BOUND
                ending = own.ending(steps[-1], step)
                if ending is not None:
                    return steps + ending[0], ending[1]
                if _comes_back(steps, step):
                    return [*steps, steps[0]], End.CLOSED
            steps.append(step)
            if len(steps) > max_steps:
                return steps, End.MAX_STEPS
        return steps, own.stop(steps[-1]) if over_kinks else End.LOST

    forth, forth_end = walk(onwards)
    if forth_end == End.CLOSED:
        return forth, (End.CLOSED, End.CLOSED)
    back, back_end = walk(-onwards)
    return back[:0:-1] + forth, (back_end, forth_end)


def _steps_along(
    problem: Problem[Data], u: Vector, tangent: Vector, sizes: StepSizes, over_kinks: bool
) -> Iterator[Step[Data]]:
    """The solution `u` and those beyond it along its tangent, until no step converges.

    The step grows after quick convergence and shrinks after none or at a sharp bend.
    """
    yield Step(u, tangent, 0, problem.describe(u))
    size, walked = sizes.first, [u]
    while True:
        corrected = None
        if size >= sizes.smallest:
            corrected = correct(problem.equations, u + size * tangent, tangent)
            if corrected is None or (corrected[1] @ tangent < LEAST_COSINE and size > 8.0 * sizes.smallest):
                size *= 0.5
                continue
        elif over_kinks:
            corrected, size = _beyond_kink(problem.equations, np.array(walked), tangent, sizes), sizes.first
        if corrected is None:
            return
        u, tangent, steps = corrected
        walked.append(u)
        yield Step(u, tangent, steps, problem.describe(u))
        size = min(sizes.largest, size * (1.5 if steps <= QUICK else 0.8))


def _beyond_kink(
    equations: Equations, walked: NDArray[np.float64], tangent: Vector, sizes: StepSizes
) -> tuple[Vector, Vector, int] | None:
    """The first solution beyond a kink, next to which a walk came to a stand, as from `correct`; None where none is.

    Two half curves meet at a kink, each along the null vector of the Jacobian on its own side, either way. The one that
    has not been `walked` leads on.
    """
    u = walked[-1]
    for reach in REACHES:
        sides = equations(u + reach * tangent), equations(u - reach * tangent)
        vectors = [null_vector(side[1]) for side in sides if side is not None]
        for size in sizes.first * 0.5 ** np.arange(4):
            for onwards in (sign * vector for vector in vectors for sign in (1.0, -1.0)):
                guess = u + size * onwards
                found = correct(equations, guess, onwards)
                if found is None or found[1] @ onwards < LEAST_COSINE or np.linalg.norm(found[0] - guess) > size:
                    continue
                if _distance(found[0], walked) > 0.1 * size:
                    return found
    return None


def _distance(point: Vector, path: NDArray[np.float64]) -> float:
    """From a point to a path of straight pieces."""
    start, along = path[:-1], np.diff(path, axis=0)
    share = np.clip(np.sum((point - start) * along, axis=1) / np.sum(along**2, axis=1), 0.0, 1.0)
    return float(np.min(np.linalg.norm(start + share[:, np.newaxis] * along - point, axis=1), initial=np.inf))


def _comes_back(steps: list[Step[Data]], step: Step[Data]) -> bool:
    """Whether the walk is back at its start: nearer to it than its last step was long, and on its way again.

    Successive tangents turn by little, so that only a closed curve does both.
    """
    away, stride = np.linalg.norm(step.u - steps[0].u), np.linalg.norm(step.u - steps[-1].u)
    return bool(away < stride and step.tangent @ steps[0].tangent > ALIGNED)


def _at_bound(
    problem: Problem[Data], inside: Step[Data], outside: Step[Data], bounds: Sequence[tuple[float, float]]
) -> list[Step[Data]] | None:
    """The solution on the first bound between two steps, no more where it is `inside` itself; None where none lies."""
    passed = []
    before, after = problem.values(inside.u), problem.values(outside.u)
    for k, (lower, upper) in enumerate(bounds):
        if not lower <= after[k] <= upper:
            bound = lower if after[k] < lower else upper
            passed.append(((bound - before[k]) / (after[k] - before[k]), k + 2, bound / problem.scales[k]))
    if not passed:
        return None
    share, k, bound = min(passed)
    guess = inside.u + share * (outside.u - inside.u)
    guess[k] = bound
    found = correct(problem.equations, guess, np.eye(len(guess))[k])
    if found is None or np.max(np.abs(found[0] - inside.u)) < ON_BOUND:
        return []
    return [Step(*found, problem.describe(found[0]))]
