"""Pseudo-arclength continuation of a curve of solutions of n equations in n + 1 unknowns (Keller, 1977)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
Data = TypeVar("Data")
# u -> residual (n,), Jacobian (n, n + 1); None where the equations cannot be evaluated.
Equations = Callable[[Vector], tuple[Vector, NDArray[np.float64]] | None]
NEWTON_STEPS = 12
QUICK = 4  # Newton steps below which the next arc step may grow
CLOSE = 1e-11  # convergence: the last Newton step, in scaled unknowns
LEAST_COSINE = 0.97  # between successive tangents, below which a step is repeated, halved


@dataclass(frozen=True)
class Step(Generic[Data]):
    """A point of the curve, in scaled unknowns."""

    u: Vector
    tangent: Vector
    newton_steps: int
    data: Data


def null_vector(jacobian: NDArray[np.float64]) -> Vector:
    """The unit vector that an n x (n + 1) matrix maps to zero."""
    return np.linalg.svd(jacobian)[2][-1]


def correct(equations: Equations, guess: Vector, normal: Vector) -> tuple[Vector, Vector, int] | None:
    """Newton's method in the plane through `guess` across `normal`: (u, tangent, steps), or None."""
    u = guess.copy()
    for step in range(1, NEWTON_STEPS + 1):
        found = equations(u)
        if found is None:
            return None
        residual, jacobian = found
        system = np.vstack([jacobian, normal])
        try:
            change = np.linalg.solve(system, -np.append(residual, normal @ (u - guess)))
        except np.linalg.LinAlgError:
            return None
        if not np.max(np.abs(change)) < 1.0:
            return None
        u = u + change
        if np.max(np.abs(change)) < CLOSE:
            tangent = null_vector(jacobian)
            return u, tangent if tangent @ normal > 0.0 else -tangent, step
    return None


def between(equations: Equations, a: Vector, b: Vector, share: float) -> tuple[Vector, Vector, int] | None:
    """The point of the curve across the chord from `a` to `b` at `share` of its length."""
    chord = b - a
    return correct(equations, a + share * chord, chord / np.linalg.norm(chord))


def follow(
    equations: Equations,
    describe: Callable[[Vector], Data],
    start: Vector,
    direction: Vector,
    *,
    first: float,
    smallest: float,
    largest: float,
) -> Iterator[Step[Data]]:
    """Walk along the curve from its point `start` towards `direction`; ends where no step converges.

    The step grows after quick convergence and shrinks after none or at a sharp bend.
    """
    found = equations(start)
    if found is None:
        return
    u, tangent = start, null_vector(found[1])
    tangent = tangent if tangent @ direction > 0.0 else -tangent
    yield Step(u, tangent, 0, describe(u))
    size = first
    while size >= smallest:
        corrected = correct(equations, u + size * tangent, tangent)
        if corrected is None or (corrected[1] @ tangent < LEAST_COSINE and size > 8.0 * smallest):
            size *= 0.5
            continue
        u, tangent, steps = corrected
        yield Step(u, tangent, steps, describe(u))
        size = min(largest, size * (1.5 if steps <= QUICK else 0.8))
