"""A curve of solutions walked both ways from one of them, within bounds: branches of orbits, curves of bifurcations."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from enum import StrEnum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gearpair.bifurcations._arclength import Data, Step, Vector, correct, follow, null_vector

Bounds = Sequence[tuple[float, float]]  # of each parameter
ON_BOUND = 1e-9  # a solution this close to a bound, in scaled unknowns, is on it
ALIGNED = 0.5  # cosine between the tangents of a walk's first step and of the one that comes back to it


class End(StrEnum):
    """Why a branch or a curve ends; a string, so that it compares with its name."""

    BOUND = "bound"
    CLOSED = "closed"
    MERGED = "merged"
    TOO_LARGE = "too_large"
    MAX_STEPS = "max_steps"
    LOST = "lost"

    @property
    def remedy(self) -> str:
        """A sentence: what the end means and what a user may do.

        Examples
        --------
        >>> End("closed").remedy
        'it came back to its start: there is no more of it'
        """
        return REMEDIES[self]


REMEDIES = {
    End.BOUND: "it reached a bound of a parameter: widen the range to follow it further",
    End.CLOSED: "it came back to its start: there is no more of it",
    End.MERGED: "its orbit became one of half its period, at a flip of that orbit: continue that one from there",
    End.TOO_LARGE: "its orbit grew far beyond the backlash, as by contact's parametric resonance: "
    "raise damping_ratio, or narrow the range",
    End.MAX_STEPS: "it was cut short after max_steps steps: raise max_steps",
    End.LOST: "no further step converged, as at a degenerate point: continue from an orbit beyond it, "
    "or change another parameter a little",
}


class Problem(Protocol[Data]):
    """What a walk asks: equations in (x, v, parameters / scales), and when to stop."""

    scales: NDArray[np.float64]

    def equations(self, u: Vector) -> tuple[Vector, NDArray[np.float64]] | None:
        """Residual and Jacobian; None where they cannot be evaluated."""

    def describe(self, u: Vector) -> Data:
        """What is kept of the solution `u`, to which the walk has just come."""

    def values(self, u: Vector) -> Vector:
        """The parameters' values."""

    def ending(self, last: Step[Data], step: Step[Data]) -> tuple[list[Step[Data]], End] | None:
        """Where the walk ends at `step`, after `last`: the steps to end with, and why; None where it goes on."""


def walk_both_ways(
    problem: Problem[Data],
    start: Vector,
    bounds: Bounds,
    *,
    first: float,
    smallest: float,
    largest: float,
    max_steps: int,
) -> tuple[list[Step[Data]], tuple[End, End]]:
    """The steps through the solution `start`, the first parameter rising there, and why they end at either end.

    Parameters
    ----------
    problem : Problem
        Each way works on a copy of its own, which may remember what it passed.
    start : ndarray of float, shape (n + 1,)
    bounds : sequence of (float, float)
        Of each parameter.
    first, smallest, largest : float
        Steps in scaled arc length.
    max_steps : int
        Steps at most each way.

    Raises
    ------
    RuntimeError
        Where the equations cannot be evaluated at the start.
    """
    found = problem.equations(start)
    if found is None:
        raise RuntimeError(f"the motion cannot be followed from X = {start[0]:.5g}, X' = {start[1]:.5g}")
    tangent = null_vector(found[1])
    onwards = tangent if tangent[2] >= 0.0 else -tangent

    def walk(direction: Vector) -> tuple[list[Step[Data]], End]:
        own = copy(problem)
        way = follow(own.equations, own.describe, start, direction, first=first, smallest=smallest, largest=largest)
        steps: list[Step[Data]] = []
        for step in way:
            if steps:
                passed = _first_bound_passed(own, steps[-1], step, bounds)
                if passed is not None:
                    return steps + _at_bound(own, steps[-1], step, *passed), End.BOUND
                ending = own.ending(steps[-1], step)
                if ending is not None:
                    return steps + ending[0], ending[1]
                if _comes_back(steps, step):
                    return [*steps, steps[0]], End.CLOSED
            steps.append(step)
            if len(steps) > max_steps:
                return steps, End.MAX_STEPS
        return steps, End.LOST

    forth, forth_end = walk(onwards)
    if forth_end == End.CLOSED:
        return forth, (End.CLOSED, End.CLOSED)
    back, back_end = walk(-onwards)
    return back[:0:-1] + forth, (back_end, forth_end)


def _comes_back(steps: list[Step[Data]], step: Step[Data]) -> bool:
    """Whether the walk is back at its start: nearer to it than its last step was long, and on its way again.

    Successive tangents turn by little, so that only a closed curve does both.
    """
    away, stride = np.linalg.norm(step.u - steps[0].u), np.linalg.norm(step.u - steps[-1].u)
    return bool(away < stride and step.tangent @ steps[0].tangent > ALIGNED)


def _first_bound_passed(
    problem: Problem[Data], inside: Step[Data], outside: Step[Data], bounds: Bounds
) -> tuple[float, int, float] | None:
    """Of the bounds between two steps the first: at which share of the chord, of which unknown, its scaled value."""
    passed = []
    before, after = problem.values(inside.u), problem.values(outside.u)
    for k, (lower, upper) in enumerate(bounds):
        if not lower <= after[k] <= upper:
            bound = lower if after[k] < lower else upper
            passed.append(((bound - before[k]) / (after[k] - before[k]), k + 2, bound / problem.scales[k]))
    return min(passed, default=None)


def _at_bound(
    problem: Problem[Data], inside: Step[Data], outside: Step[Data], share: float, k: int, bound: float
) -> list[Step[Data]]:
    """The solution on the bound of unknown `k`, between two steps; none where the walk was on it already."""
    guess = inside.u + share * (outside.u - inside.u)
    guess[k] = bound
    found = correct(problem.equations, guess, np.eye(len(guess))[k])
    if found is None or np.max(np.abs(found[0] - inside.u)) < ON_BOUND:
        return []
    return [Step(*found, problem.describe(found[0]))]
