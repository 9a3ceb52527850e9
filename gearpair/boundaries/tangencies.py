"""Where along a parameter the manifolds of a saddle begin to cross: the homoclinic tangency, which marks a crisis."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_number, check_reach, checked
from gearpair._equality import equal_by_value
from gearpair.bifurcations.branches import continue_orbit
from gearpair.bifurcations.orbits import PeriodicOrbit, periodic_orbit
from gearpair.boundaries.growing import Branch, branches_at, check_saddle
from gearpair.motion.outcome import Outcome

MOST_POINTS = 100_000  # of one branch
HALVINGS = 8, 12  # of the range: after so many Newton's method is tried, and for the last time
CANDIDATES = 6  # pairs of neighbouring crossings that Newton's method is begun between
NEAR, SAME = 0.1, 1e-6  # of the range: how far from the bisection's value a tangency may be, and two that are images
# Newton's steps, and the differences of its derivative, in places and shares of the range. It ends with a step of the
# parameter below SETTLED of the range; by then the distance and the sine of the angle are below SOLVED, to which
# rounding grows on the way along the curves.
STEPS, DIFFERENCE, SETTLED, SOLVED = 12, 1e-5, 1e-9, 1e-5


class TangencyStatus(Outcome):
    """How well the tangency is known: a string, with a `remedy` that says what a user may do."""

    LOCATED = "located", "the equations of the tangency are solved to rounding"
    BRACKETED = (
        "bracketed",
        "on one side the curves cross and on the other they do not, but no tangency was found between: the end of a "
        "curve may pass over the other one; raise the length, or lower the spacing",
    )


@equal_by_value
@dataclass(frozen=True, repr=False)
class HomoclinicTangency:
    """The value of a parameter at which the stable and the unstable manifold of a saddle touch.

    Attributes
    ----------
    status : TangencyStatus
        ``"located"`` or ``"bracketed"``; ``status.remedy`` says what to do.
    parameter : str
    value : float
    error : float
        Of the value: how far those of several images of the tangency differ; where bracketed, half of the range that is
        left, which leaves out how far the chords between the curves' points are off.
    crosses_above : bool
        Whether the manifolds cross above the value; else they do below it.
    orbit : PeriodicOrbit
        The saddle, at that value.
    point : ndarray of float, shape (2,)
        X and X' where they touch, at one of the points that the map takes to each other; nan where bracketed.
    length : float
        To which the branches were grown.
    """

    status: TangencyStatus
    parameter: str
    value: float
    error: float
    crosses_above: bool
    orbit: PeriodicOrbit
    point: NDArray[np.float64]
    length: float

    def __repr__(self) -> str:
        """One line."""
        side = "above" if self.crosses_above else "below"
        return (
            f"{self.parameter} = {self.value:.8g} ± {self.error:.1e} ({self.status}): {side} it the manifolds cross, "
            f"grown to {self.length:g}, of the saddle of period {self.orbit.period}"
        )


@checked
def homoclinic_tangency(
    orbit: PeriodicOrbit,
    parameter: str,
    lower: float,
    upper: float,
    *,
    x: tuple[float, float] = (-4.0, 4.0),
    v: tuple[float, float] = (-3.0, 3.0),
    spacing: float = 0.02,
    length: float = 30.0,
) -> HomoclinicTangency:
    """Where along a parameter the stable and the unstable manifold of a saddle begin to cross.

    Of the saddle on the edge of a chaotic attractor's basin it is where this attractor ends, in a crisis: beyond it
    motions leave through the lobes between the curves.

    Parameters
    ----------
    orbit : PeriodicOrbit
        A saddle.
    parameter : str
        One of ``orbit.oscillator.parameters``.
    lower, upper : float
        The range of the parameter, which the orbit's own value lies in. At one end the manifolds must cross, at the
        other not.
    x, v, spacing, length
        As in `manifolds`.

    Raises
    ------
    ValueError
        For an orbit that is no saddle; where the saddle does not reach from `lower` to `upper`; where the manifolds
        cross at both or at neither.
    RuntimeError
        Where the parameter cannot be varied.

    Notes
    -----
    The saddle is continued; its manifolds are grown where the range is halved, and looked at for crossings. Between two
    crossings that are about to merge Newton's method then solves for the two places on the curves and the parameter:
    the points are one and the directions parallel. That takes no chord for the curve.

    It is the first tangency *of the length grown*. Every image of a tangency is one at the same value, so a longer
    curve shows no other value for the same one; but it may meet the other curve in another tangency, somewhat
    earlier. Raise `length` and see whether the value stays. Where the attractor that a branch of the unstable manifold
    leads to is chaotic, this branch comes near all of it, and the crisis is where it first touches the stable manifold
    (Grebogi, Ott, Romeiras and Yorke, 1987).

    Examples
    --------
    >>> from gearpair import Oscillator, periodic_orbit
    >>> osc = Oscillator(mesh_frequency=1.219, damping_ratio=0.011)
    >>> saddle = periodic_orbit(osc, -0.29164, -1.2262, 2)
    >>> found = homoclinic_tangency(saddle, "damping_ratio", 0.0105, 0.0115, spacing=0.05, length=10.0)
    >>> found.status.value, round(found.value, 9), found.crosses_above
    ('located', 0.011109035, False)
    """
    lower, upper = check_number("lower", lower), check_number("upper", upper)
    check_number("spacing", spacing, above=0.0)
    check_number("length", length, above=0.0)
    check_saddle(orbit)
    window = np.array([check_reach("x", x), check_reach("v", v)])
    line = SaddleLine(orbit, parameter, (lower, upper), window, spacing)
    at_lower, at_upper = line.crossings(lower, length), line.crossings(upper, length)
    if bool(at_lower) == bool(at_upper):
        where = "both" if at_lower else "neither"
        raise ValueError(
            f"lower and upper must have the tangency between them: the manifolds, grown to {length}, cross at {where}, "
            f"{lower} and {upper}"
        )
    crosses_above, crossings = bool(at_upper), at_upper or at_lower
    for halving in range(1, HALVINGS[-1] + 1):
        middle = 0.5 * (lower + upper)
        found = line.crossings(middle, length)
        crossings = found or crossings
        if bool(found) == crosses_above:
            upper = middle
        else:
            lower = middle
        touch = line.touch(crossings, 0.5 * (lower + upper)) if halving in HALVINGS else None
        if touch is not None:
            value, error, point = touch
            saddle, status = line.saddle(value), TangencyStatus.LOCATED
            return HomoclinicTangency(status, parameter, value, error, crosses_above, saddle, point, length)
    value, error, nowhere = 0.5 * (lower + upper), 0.5 * (upper - lower), np.full(2, np.nan)
    saddle, status = line.saddle(value), TangencyStatus.BRACKETED
    return HomoclinicTangency(status, parameter, value, error, crosses_above, saddle, nowhere, length)


class Crossing(NamedTuple):
    """Where an unstable and a stable branch cross: their numbers, and the places on them (see `Branch.grown`)."""

    unstable: int
    stable: int
    unstable_place: float
    stable_place: float


class SaddleLine:
    """A saddle along a parameter, with its branches."""

    def __init__(
        self,
        orbit: PeriodicOrbit,
        parameter: str,
        reach: tuple[float, float],
        window: NDArray[np.float64],
        spacing: float,
    ) -> None:
        lower, upper = reach
        self._osc, self._parameter, self._period = orbit.oscillator, parameter, orbit.period
        self._window, self._spacing, self._range = window, spacing, upper - lower
        branch = continue_orbit(orbit, parameter, lower, upper)
        away = np.abs(branch.points - orbit.points[0]).max(axis=2).min(axis=1)
        row = int(np.argmin(away + np.abs(branch.values - self._osc.parameter(parameter)) / self._range))
        turns = np.flatnonzero(np.diff(np.sign(np.diff(branch.values)))) + 1
        first, last = turns[turns <= row].max(initial=0), turns[turns > row].min(initial=len(branch.values) - 1)
        rows = slice(first, last + 1)
        order = np.argsort(branch.values[rows])
        self._values, self._points = branch.values[rows][order], branch.points[rows][order]
        if self._values[0] > lower + SAME * self._range or self._values[-1] < upper - SAME * self._range:
            raise ValueError(
                f"the saddle must reach from lower to upper, got {lower} and {upper}: it was followed from "
                f"{parameter} = {self._values[0]:.8g} to {self._values[-1]:.8g}"
            )

    def saddle(self, value: float) -> PeriodicOrbit:
        """The saddle at a value of the parameter."""
        osc = self._osc.replace(**{self._parameter: value})
        x, v = (float(np.interp(value, self._values, self._points[:, 0, i])) for i in range(2))
        orbit = periodic_orbit(osc, x, v, self._period)
        check_saddle(orbit)
        return orbit

    def _branches(self, value: float) -> tuple[list[Branch], list[Branch]]:
        """The unstable and the stable branches."""
        orbit = self.saddle(value)
        pairs = [each for k in range(self._period) for each in branches_at(orbit, k, self._window, self._spacing)]
        unstable, stable = ([branch for name, branch in pairs if name == which] for which in ("unstable", "stable"))
        return unstable, stable

    def crossings(self, value: float, length: float) -> list[Crossing]:
        """Every crossing of the branches, grown to a length."""
        unstable, stable = ([each.grown(length, MOST_POINTS)[:2] for each in kind] for kind in self._branches(value))
        return [
            Crossing(i, j, *places)
            for i, (curve, at) in enumerate(unstable)
            for j, (other, other_at) in enumerate(stable)
            for places in crossing_places(curve, at, other, other_at).tolist()
        ]

    def touch(self, crossings: list[Crossing], value: float) -> tuple[float, float, NDArray[np.float64]] | None:
        """The tangency near `value` at which two of the crossings merge: value, error and point."""
        ordered = sorted(crossings)
        pairs = [(a, b) for a, b in pairwise(ordered) if a[:2] == b[:2]]
        apart = [abs(a.unstable_place - b.unstable_place) + abs(a.stable_place - b.stable_place) for a, b in pairs]
        found = []
        for k in np.argsort(apart)[:CANDIDATES].tolist():
            a, b = pairs[k]
            places = 0.5 * (a.unstable_place + b.unstable_place), 0.5 * (a.stable_place + b.stable_place)
            solved = self._solved(a, np.array([*places, value / self._range]))
            if solved is not None and abs(solved[0] - value) <= NEAR * self._range:
                found.append(solved)
        if not found:
            return None
        best, point = min(found, key=lambda each: abs(each[0] - value))
        images = [abs(each - best) for each, _ in found if abs(each - best) <= SAME * self._range]
        return best, max([*images, SETTLED * self._range]), point

    def _solved(self, crossing: Crossing, u: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]] | None:
        """Newton's method for the places on two branches and the parameter, in units of the range: value and point."""
        for _ in range(STEPS):
            gap, point = self._gap(crossing, u)
            steps = DIFFERENCE * np.eye(3)
            slopes = [self._gap(crossing, u + each)[0] - self._gap(crossing, u - each)[0] for each in steps]
            if not np.isfinite([gap, *slopes]).all() or np.linalg.det(slopes) == 0.0:
                return None
            step = -2.0 * DIFFERENCE * np.linalg.solve(np.transpose(slopes), gap)
            if abs(step[2]) < SETTLED and np.abs(gap).max() < SOLVED:
                return float(u[2]) * self._range, point
            u = u + step
            if u[:2].min() < 1.0 or not self._values[0] < u[2] * self._range < self._values[-1]:
                return None
        return None

    def _gap(self, crossing: Crossing, u: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """What is zero at a tangency, the distance of the points and the sine of the angle; and the unstable point."""
        unstable, stable = self._branches(float(u[2]) * self._range)
        point, along = unstable[crossing.unstable].at(float(u[0]))
        other, other_along = stable[crossing.stable].at(float(u[1]))
        return np.append(point - other, along[0] * other_along[1] - along[1] * other_along[0]), point


def crossing_places(
    curve: NDArray[np.float64], at: NDArray[np.float64], other: NDArray[np.float64], other_at: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The places on two curves, whose points are `at` theirs, where their chords cross; shape (n, 2)."""
    from scipy.spatial import cKDTree  # here, so that importing gearpair stays quick

    chords = []
    for points, places in ((curve[1:], at[1:]), (other[1:], other_at[1:])):  # without the saddle, where all begin
        whole = np.isfinite(points[1:, 0]) & np.isfinite(points[:-1, 0])
        chords.append((points[:-1][whole], np.diff(points, axis=0)[whole], places[:-1][whole], np.diff(places)[whole]))
    (a, along, place, grows), (b, other_along, other_place, other_grows) = chords
    longest = max(np.hypot(*along.T).max(initial=0.0), np.hypot(*other_along.T).max(initial=0.0))
    if not len(a) or not len(b):
        return np.empty((0, 2))
    near = cKDTree(a + 0.5 * along).sparse_distance_matrix(
        cKDTree(b + 0.5 * other_along), longest, output_type="coo_matrix"
    )
    i, j = near.row, near.col
    between, sine = b[j] - a[i], cross(along[i], other_along[j])
    with np.errstate(divide="ignore", invalid="ignore"):
        share, other_share = cross(between, other_along[j]) / sine, cross(between, along[i]) / sine
    meet = (share >= 0.0) & (share < 1.0) & (other_share >= 0.0) & (other_share < 1.0)
    i, j, share, other_share = i[meet], j[meet], share[meet], other_share[meet]
    return np.column_stack([place[i] + share * grows[i], other_place[j] + other_share * other_grows[j]])


def cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """The cross products of vectors in the plane, one a row."""
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
