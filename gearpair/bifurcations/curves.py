"""Fold, flip and grazing curves in two parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import checked
from gearpair._equality import equal_by_value
from gearpair.bifurcations._orbit_problem import DIFFERENCE, Kind, OrbitProblem
from gearpair.bifurcations._walk import End, Step, StepSizes, Vector, walk_both_ways
from gearpair.bifurcations.locating import TOUCHING, Bifurcation

VANISHED = 1e-6  # residual of a bifurcation's equation from which on the extremum that grazed is there no more
GRAZES = 1e-5  # a lost orbit touches a boundary if an extremum is this close to it: ten differences of its equations
SIZES = StepSizes(first=1e-3, smallest=1e-8, largest=2e-2)


@equal_by_value
@dataclass(frozen=True, repr=False)
class BifurcationCurve:
    """A curve of folds, flips or grazings in two parameters; arrays have one row a point, the first again if closed.

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
    ends : tuple of End
        Why the curve ends where it does, at its first and at its last point; ``end.remedy`` says what to do.
    """

    kind: Kind
    period: int
    parameters: tuple[str, str]
    values: NDArray[np.float64]
    points: NDArray[np.float64]
    residual: NDArray[np.float64]
    ends: tuple[End, End]

    def __repr__(self) -> str:
        """One line: how long it is, and between what."""
        first, last = (
            f"({self.values[i, 0]:.8g}, {self.values[i, 1]:.8g}) ({end})"
            for i, end in zip((0, -1), self.ends, strict=True)
        )
        return (
            f"{self.kind} curve of period {self.period} with {len(self.values)} points, "
            f"from ({', '.join(self.parameters)}) = {first} to {last}"
        )


class CurveProblem(OrbitProblem):
    """The orbit's two equations and the bifurcation's own, in scaled (x, v, first, second parameter)."""

    def __init__(self, bifurcation: Bifurcation, scales: dict[str, float]) -> None:
        super().__init__(bifurcation.oscillator, bifurcation.period, scales)
        self.kind = bifurcation.kind
        # At a grazing: which extremum touches which boundary, followed in time from step to step.
        self.when, self.boundary = self.cycle(self.unknowns(bifurcation.x, bifurcation.v)).nearest_extremum()

    def test(self, u: Vector) -> float:
        """The bifurcation's own equation."""
        cycle = self.cycle(u)
        if self.kind == "grazing":
            return cycle.gap(self.when, self.boundary)
        return cycle.test(self.kind)

    def describe(self, u: Vector) -> float:
        """The residual at a new step, whose extremum is the one to follow from now on."""
        cycle, residual = self.cycle(u), self.test(u)
        touching = cycle.extrema[np.abs(cycle.extrema[:, 1] - self.boundary) < TOUCHING, 0]
        if self.kind == "grazing" and len(touching):
            self.when = float(touching[np.argmin(cycle.apart(touching, self.when))])
        return residual

    def equations(self, u: Vector) -> tuple[Vector, NDArray[np.float64]] | None:
        """Residual (3,) and Jacobian (3, 4); the last row by central differences."""
        orbit = super().equations(u)
        if orbit is None:
            return None
        steps = DIFFERENCE * np.maximum(1.0, np.abs(u))
        try:
            changes = np.array([self.test(u + step) - self.test(u - step) for step in np.diag(steps)])
            return np.append(orbit[0], self.test(u)), np.vstack([orbit[1], changes / (2.0 * steps)])
        except ValueError:
            return None

    def ending(self, last: Step[float], step: Step[float]) -> tuple[list[Step[float]], End] | None:
        """The end of a walk at `step`, if it is one."""
        return ([], End.LOST) if abs(step.data) > VANISHED else None

    def stop(self, step: Step[float]) -> End:
        """Why no step beyond `step` converges: at a fold or a flip a grazing besides, if that is there."""
        cycle = self.cycle(step.u)
        grazes = self.kind != "grazing" and abs(cycle.test("grazing")) < GRAZES
        return End.GRAZES if grazes else End.LOST


@checked
def continue_bifurcation(
    bifurcation: Bifurcation,
    bounds: Mapping[str, tuple[float, float]],
    *,
    largest_step: float = SIZES.largest,
    max_steps: int = 500,
    over_kinks: bool = True,
) -> BifurcationCurve:
    """The curve of a bifurcation in two parameters, in both directions.

    Parameters
    ----------
    bifurcation : Bifurcation
        Located by `continue_orbit`.
    bounds : mapping of str to (float, float)
        Two parameter names and the range of each, which the bifurcation lies in, for example
        ``{"mesh_frequency": (0.6, 1.8), "damping_ratio": (0.0, 0.1)}``.
    largest_step, max_steps
        As in `continue_orbit`; the same errors are raised.
    over_kinks : bool
        Go on where the curve has a corner too sharp to be walked around, and name a grazing that ends it; otherwise
        both end it as ``"lost"``.

    Notes
    -----
    The orbit's two equations are extended by the function whose zero is the bifurcation, see `continue_orbit`, and
    followed by pseudo-arclength. The multipliers have a kink where X passes +-1 just as the stiffness switches, as
    where a section point passes X = 1, and so has the curve: it goes on along its other half. Where a fold or a flip
    also grazes, the curve comes from the side with fewer contacts and goes on along the grazing, from which it parts
    like a parabola.

    Examples
    --------
    >>> from gearpair import Oscillator, continue_orbit, periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(), 0.34, -0.25, 2)
    >>> flip = continue_orbit(orbit, "mesh_frequency", 0.7, 0.77).bifurcations[0]
    >>> curve = continue_bifurcation(flip, {"mesh_frequency": (0.7, 0.8), "damping_ratio": (0.019, 0.021)})
    >>> sorted((round(zeta, 5), round(omega, 5)) for omega, zeta in curve.values[[0, -1]].tolist())
    [(0.019, 0.76766), (0.021, 0.76459)]
    """
    if len(bounds) != 2:
        raise ValueError(f"bounds must name two parameters, got {len(bounds)}: {', '.join(bounds)}")
    osc = bifurcation.oscillator
    for name, (lower, upper) in bounds.items():
        if not lower < upper or not lower <= osc.parameter(name) <= upper:
            raise ValueError(
                f"bounds of {name} must enclose the bifurcation's {osc.parameter(name)}, got ({lower}, {upper})"
            )
    problem = CurveProblem(bifurcation, {name: upper - lower for name, (lower, upper) in bounds.items()})
    start, sizes = problem.unknowns(bifurcation.x, bifurcation.v), SIZES._replace(largest=largest_step)
    steps, ends = walk_both_ways(problem, start, list(bounds.values()), sizes, max_steps, over_kinks=over_kinks)
    first, second = bounds
    return BifurcationCurve(
        kind=bifurcation.kind,
        period=bifurcation.period,
        parameters=(first, second),
        values=np.array([problem.values(step.u) for step in steps]),
        points=np.array([step.u[:2] for step in steps]),
        residual=np.array([step.data for step in steps]),
        ends=ends,
    )
