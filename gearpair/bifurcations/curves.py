"""Fold, flip and grazing curves in two parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count, check_number
from gearpair.bifurcations._arclength import Step, Vector, correct, follow, null_vector
from gearpair.bifurcations._orbit_problem import DIFFERENCE, Cycle, OrbitProblem
from gearpair.bifurcations.locating import TOUCHING, Bifurcation, Kind

LOST = 1e-6  # residual of the bifurcation's equation beyond which its turning point has vanished
FIRST_STEP, SMALLEST_STEP, LARGEST_STEP = 1e-3, 1e-8, 2e-2


@dataclass(frozen=True)
class BifurcationCurve:
    """A curve of folds, flips or grazings in two parameters; arrays have one row a point.

    Attributes
    ----------
    kind : {"fold", "flip", "grazing"}
    period : int
        Of the orbit, in mesh periods.
    parameters : tuple of str
        The two parameters' names.
    values : ndarray of float, shape (n, 2)
        Of the two parameters.
    points : ndarray of float, shape (n, 2)
        A section point of the orbit.
    residual : ndarray of float, shape (n,)
        The residual of the defining equation.
    ends : tuple of str
        Why the curve ends where it does, at its first and at its last point.
    """

    kind: Kind
    period: int
    parameters: tuple[str, str]
    values: NDArray[np.float64]
    points: NDArray[np.float64]
    residual: NDArray[np.float64]
    ends: tuple[str, str]


class _CurveProblem(OrbitProblem):
    """The orbit's two equations and the bifurcation's own, in scaled (x, v, first, second parameter)."""

    def __init__(self, bifurcation: Bifurcation, scales: dict[str, float]) -> None:
        super().__init__(bifurcation.oscillator, bifurcation.period, scales)
        self.kind = bifurcation.kind
        # At a grazing: which turning point touches which boundary, followed in time from step to step.
        self.when, self.boundary = self.cycle(self.unknowns(bifurcation.x, bifurcation.v)).grazing_turn

    def test(self, u: Vector) -> float:
        """The bifurcation's own equation."""
        cycle: Cycle = self.cycle(u)
        if self.kind == "grazing":
            return cycle.gap_of(self.when, self.boundary)
        return cycle.fold_test if self.kind == "fold" else cycle.flip_test

    def accept(self, u: Vector) -> float:
        """The residual at a new step, whose turning point is the one to follow from now on."""
        residual = self.test(u)
        turns = self.cycle(u).turns
        near = turns[np.abs(turns[:, 1] - self.boundary) < TOUCHING]
        if self.kind == "grazing" and len(near):
            apart = np.abs((near[:, 0] - self.when + 0.5 * self.period) % self.period - 0.5 * self.period)
            self.when = float(near[np.argmin(apart), 0])
        return residual

    def extended(self, u: Vector) -> tuple[Vector, NDArray[np.float64]] | None:
        """Residual (3,) and Jacobian (3, 4); the last row by central differences."""
        orbit = self.equations(u)
        if orbit is None:
            return None
        row = np.empty(4)
        try:
            for k in range(4):
                step = np.zeros(4)
                step[k] = DIFFERENCE * max(1.0, abs(u[k]))
                row[k] = (self.test(u + step) - self.test(u - step)) / (2.0 * step[k])
            residual = np.append(orbit[0], self.test(u))
        except ValueError:
            return None
        return residual, np.vstack([orbit[1], row])


def continue_bifurcation(
    bifurcation: Bifurcation,
    bounds: Mapping[str, tuple[float, float]],
    *,
    largest_step: float = LARGEST_STEP,
    max_steps: int = 500,
) -> BifurcationCurve:
    """The curve of a bifurcation in two parameters, in both directions.

    Parameters
    ----------
    bifurcation : Bifurcation
        Located by `continue_orbit`.
    bounds : mapping of str to (float, float)
        Two parameter names and the range of each, for example
        ``{"mesh_frequency": (0.6, 1.8), "damping_ratio": (0.0, 0.1)}``.
    largest_step : float
        The longest step in arc length, in units of X, X' and the ranges.
    max_steps : int
        Steps at most in each direction.

    Returns
    -------
    BifurcationCurve

    Raises
    ------
    ValueError
        For other than two parameters, or bounds that leave out the bifurcation.

    Notes
    -----
    The orbit's two equations are extended by (mu_1 - 1)(mu_2 - 1) = 0, (mu_1 + 1)(mu_2 + 1) = 0 or by
    the turning point's distance from X = +-1 = 0, and followed by pseudo-arclength.
    """
    if len(bounds) != 2:
        raise ValueError(f"bounds must name two parameters, got {len(bounds)}: {', '.join(bounds)}")
    check_number("largest_step", largest_step, above=0.0)
    check_count("max_steps", max_steps)
    osc = bifurcation.oscillator
    for name, (lower, upper) in bounds.items():
        if not lower < upper or not lower <= osc.parameter(name) <= upper:
            raise ValueError(
                f"bounds of {name} must enclose the bifurcation's {osc.parameter(name)}, got ({lower}, {upper})"
            )
    problem = _CurveProblem(bifurcation, {name: upper - lower for name, (lower, upper) in bounds.items()})
    start = problem.unknowns(bifurcation.x, bifurcation.v)
    found = problem.extended(start)
    if found is None:
        raise RuntimeError("the motion cannot be followed at the bifurcation")
    direction = null_vector(found[1])
    when = problem.when
    back, back_end = _walk(problem, start, -direction, bounds, largest_step, max_steps)
    problem.when = when
    if back_end == CLOSED:
        steps, ends = back, (CLOSED, CLOSED)
    else:
        forth, forth_end = _walk(problem, start, direction, bounds, largest_step, max_steps)
        steps, ends = back[:0:-1] + forth, (back_end, forth_end)
    names = tuple(bounds)
    return BifurcationCurve(
        kind=bifurcation.kind,
        period=bifurcation.period,
        parameters=(names[0], names[1]),
        values=np.array([problem.values(step.u) for step in steps]).reshape(-1, 2),
        points=np.array([step.u[:2] for step in steps]).reshape(-1, 2),
        residual=np.array([step.data for step in steps]),
        ends=ends,
    )


CLOSED = "closed: the curve returned to its start"


def _walk(
    problem: _CurveProblem,
    start: Vector,
    direction: Vector,
    bounds: Mapping[str, tuple[float, float]],
    largest: float,
    max_steps: int,
) -> tuple[list[Step[float]], str]:
    steps: list[Step[float]] = []
    walk = follow(
        problem.extended, problem.accept, start, direction, first=FIRST_STEP, smallest=SMALLEST_STEP, largest=largest
    )
    for step in walk:
        for k, (name, (lower, upper)) in enumerate(bounds.items()):
            value = problem.values(step.u)[k]
            if not lower <= value <= upper:
                bound = lower if value < lower else upper
                edge = _at_bound(problem, steps[-1], step, k + 2, bound) if steps else None
                return steps + ([edge] if edge is not None else []), f"reached {name} = {bound:g}"
        if abs(step.data) > LOST:
            break
        steps.append(step)
        away = np.linalg.norm(step.u - start)
        if len(steps) > 20 and away < np.linalg.norm(step.u - steps[-2].u) and step.tangent @ steps[0].tangent > 0.5:
            return steps, CLOSED
        if len(steps) >= max_steps:
            return steps, f"stopped after max_steps = {max_steps} steps"
    return steps, f"no step of {SMALLEST_STEP:g} or more converged: a degenerate point is near"


def _at_bound(
    problem: _CurveProblem, inside: Step[float], outside: Step[float], k: int, bound: float
) -> Step[float] | None:
    """The point of the curve on the bound of unknown `k`, between two steps."""
    target = bound / problem.scales[k - 2]
    share = (target - inside.u[k]) / (outside.u[k] - inside.u[k])
    guess = inside.u + share * (outside.u - inside.u)
    guess[k] = target
    found = correct(problem.extended, guess, np.eye(4)[k])
    return Step(*found, problem.test(found[0])) if found is not None else None
