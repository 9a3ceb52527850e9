"""The equations of a periodic orbit for continuation, and the cycle that solves them."""

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from gearpair._flow.cells import Coefficients
from gearpair._flow.cycle import cycle_at, equations_at
from gearpair._flow.records import Extrema
from gearpair._flow.walk import OK
from gearpair.bifurcations._walk import End, Step, Vector, correct
from gearpair.oscillator import SCALARS, Oscillator

Kind = Literal["fold", "flip", "grazing"]
MULTIPLIERS = {"fold": 1.0, "flip": -1.0}
DIFFERENCE = 1e-6  # relative step of a central difference
MAX_EXTREMA_PER_PERIOD = 64


@dataclass(frozen=True)
class Cycle:
    """A cycle from one of its section points on, as a `PeriodicOrbit` has it, and its `extrema`.

    Of shape (n, 2), they are the mesh periods since ``points[0]`` and X where X' = 0.
    """

    points: NDArray[np.float64]
    monodromy: NDArray[np.float64]
    residual: float
    x_min: float
    x_max: float
    contacts: tuple[int, int]
    extrema: NDArray[np.float64]

    def test(self, kind: Kind) -> float:
        """What is zero at a bifurcation: (mu_1 - mu)(mu_2 - mu), or an extremum's distance from a boundary."""
        if kind == "grazing":
            return self.gap(*self.nearest_extremum())
        (a, b), (c, d) = self.monodromy
        return float((a - MULTIPLIERS[kind]) * (d - MULTIPLIERS[kind]) - b * c)

    def nearest_extremum(self) -> tuple[float, float]:
        """Of the extremum nearest to a boundary: when it is (mesh periods), and that boundary."""
        when, x = self.extrema[np.argmin(np.abs(np.abs(self.extrema[:, 1]) - 1.0))]
        return float(when), 1.0 if x > 0.0 else -1.0

    def gap(self, when: float, boundary: float) -> float:
        """Signed distance from `boundary` of the extremum nearest in time to `when`."""
        return float(self.extrema[np.argmin(self.apart(self.extrema[:, 0], when)), 1] - boundary)

    def apart(self, times: NDArray[np.float64], when: float) -> NDArray[np.float64]:
        """How far times are from `when` around the cycle (mesh periods)."""
        n = len(self.points)
        return np.abs((times - when + 0.5 * n) % n - 0.5 * n)

    def half_gap(self) -> NDArray[np.float64]:
        """Difference of the points half a period apart: zero where the period halves; ones for odd periods."""
        n = len(self.points)
        return self.points[n // 2] - self.points[0] if n % 2 == 0 else np.ones(2)


def describe_cycle(p: Coefficients, x: float, v: float, period: int) -> Cycle:
    """The cycle of `period` mesh periods through (x, v), which is closed as far as its residual says."""
    points, monodromy = np.empty((period, 2)), np.empty((2, 2))
    found = Extrema(np.empty((MAX_EXTREMA_PER_PERIOD * period * p.mesh_periods, 2)), np.zeros(3, np.int64))
    status, residual = cycle_at(p, x, v, points, monodromy, found)
    n, drive, coast = found.counts.tolist()
    extrema = found.rows[:n].copy()
    reached = np.concatenate([extrema[:, 1], points[:, 0]])
    return Cycle(
        points=points,
        monodromy=monodromy,
        residual=float(residual) if status == OK else np.inf,
        x_min=float(reached.min()),
        x_max=float(reached.max()),
        contacts=(drive, coast),
        extrema=extrema,
    )


class OrbitProblem:
    """The equations map(x, v; parameters) = (x, v) in scaled unknowns (x, v, parameters / scales)."""

    def __init__(self, osc: Oscillator, period: int, scales: dict[str, float]) -> None:
        self.osc, self.period = osc, period
        self.names, self.scales = tuple(scales), np.array(list(scales.values()))

    def unknowns(self, x: float, v: float) -> Vector:
        """The scaled unknowns of a state at the oscillator's own parameters."""
        return np.array([x, v, *(np.array([self.osc.parameter(name) for name in self.names]) / self.scales)])

    def values(self, u: Vector) -> Vector:
        """The parameters' values."""
        return u[2:] * self.scales

    def _changes(self, u: Vector) -> dict[str, Any]:
        return dict(zip(self.names, self.values(u).tolist(), strict=True))

    def oscillator(self, u: Vector) -> Oscillator:
        """The oscillator at `u`."""
        return self.osc.replace(**self._changes(u))

    def coefficients(self, u: Vector) -> Coefficients:
        """The kernels' coefficients at `u`."""
        if set(self.names) <= set(SCALARS):  # the quick way, free to step a little out of range
            changes = self._changes(u)
            if self.osc.flight_damping is None and "damping_ratio" in changes:  # it is the one in contact
                changes.setdefault("flight_damping", changes["damping_ratio"])
            return self.osc.coefficients._replace(**changes)
        osc = self.oscillator(u)
        if osc.mesh_periods != self.osc.mesh_periods:
            raise ValueError("an error of a shaft has become 0, and the base period another one")
        return osc.coefficients

    def equations(self, u: Vector) -> tuple[Vector, NDArray[np.float64]] | None:
        """Residual and Jacobian; None where the motion cannot be followed."""
        steps = DIFFERENCE * np.maximum(1.0, np.abs(u))
        try:
            here = self.coefficients(u)
            beside = tuple(self.coefficients(u + side) for step in np.diag(steps)[2:] for side in (step, -step))
        except ValueError:  # a part's parameter out of range
            return None
        residual, jacobian = np.empty(2), np.empty((2, len(u)))
        status = equations_at(here, beside, u[0], u[1], self.period, steps[2:], residual, jacobian)
        return (residual, jacobian) if status == OK else None

    def cycle(self, u: Vector) -> Cycle:
        """The orbit at a solution `u`."""
        return describe_cycle(self.coefficients(u), u[0], u[1], self.period)

    def stop(self, step: Step[Any]) -> End:
        """Why no step beyond `step` converges."""
        return End.LOST

    def between(self, a: Step[Cycle], b: Step[Cycle], share: float) -> Step[Cycle] | None:
        """The step across the chord from `a` to `b` at `share` of its length, if Newton's method finds it."""
        chord = b.u - a.u
        found = correct(self.equations, a.u + share * chord, chord / np.linalg.norm(chord))
        return None if found is None else Step(*found, self.cycle(found[0]))
