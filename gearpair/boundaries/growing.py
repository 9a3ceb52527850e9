"""The stable and unstable manifolds of a saddle orbit, grown from it by the exact map and its inverse."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count, check_number, check_reach, checked
from gearpair._equality import equal_by_value
from gearpair._flow.closed_form import TERMS
from gearpair._flow.newton import derivative
from gearpair._flow.walk import OK
from gearpair.bifurcations.orbits import PeriodicOrbit
from gearpair.boundaries.sections import PeriodMap, backward, forward
from gearpair.motion.stability import multipliers_of

# How far from the orbit a manifold is begun, relative to max(1, |X|, |X'|): there it departs from its tangent by the
# square of that. Points of the first piece.
BEGIN, SEEDS = 1e-7, 5
# A curve departs from the chord between two of its points by about an eighth of their distance times the angle to the
# next chord; that product is at most BENT of the spacing, down to LEAST of it, where a fold is a point.
BENT, LEAST = 0.1, 1e-3
BEYOND = 2.0  # half widths of the window, about its middle, beyond which a curve is not followed
STANDSTILL = 1e-2  # in spacings: a piece as short as this shows that the curve has come to an attractor


@equal_by_value
@dataclass(frozen=True, repr=False)
class Manifolds:
    """The curves on which motions approach a saddle orbit, and on which they leave it.

    Attributes
    ----------
    orbit : PeriodicOrbit
    stable, unstable : tuple of ndarray of float, shape (n, 2)
        X and X' on the section along each branch, from a section point of the orbit outwards: for each of these points
        one branch after the other, 2 * `orbit.period` in all. Rows of nan part the pieces of a branch between which it
        was not followed.
    spacing : float
        The largest distance of neighbours.
    complete : bool
        Whether each branch was followed to where it leaves the window or comes to rest; otherwise some are as long, or
        have as many points, as was allowed, or are stretched so much that rounding parts neighbours.
    """

    orbit: PeriodicOrbit
    stable: tuple[NDArray[np.float64], ...]
    unstable: tuple[NDArray[np.float64], ...]
    spacing: float
    complete: bool

    def __repr__(self) -> str:
        """One line."""
        told = []
        for name in ("stable", "unstable"):
            curves = getattr(self, name)
            told.append(f"{name} of length {sum(map(length_of, curves)):.4g} ({sum(map(len, curves))} points)")
        x, v = self.orbit.points[0]
        return f"manifolds of the orbit of period {self.orbit.period} at X = {x:.5g}, X' = {v:.5g}: " + ", ".join(told)


@checked
def manifolds(
    orbit: PeriodicOrbit,
    *,
    x: tuple[float, float] = (-4.0, 4.0),
    v: tuple[float, float] = (-3.0, 3.0),
    spacing: float = 0.02,
    length: float = 100.0,
    max_points: int = 100_000,
) -> Manifolds:
    """The stable and the unstable manifold of a saddle orbit, as curves on the section.

    The stable manifold of the saddle between two basins is their boundary.

    Parameters
    ----------
    orbit : PeriodicOrbit
        A saddle: real multipliers, one inside and one outside the unit circle.
    x, v : tuple of float
        The window that the curves are followed in, and somewhat beyond: within twice its size.
    spacing : float
        The largest distance of neighbours along a curve. Where it bends they are nearer: the chord between two is
        within about an eightieth of this of the curve.
    length : float
        How long one branch becomes at most.
    max_points : int
        How many points one branch has at most.

    Raises
    ------
    ValueError
        For an orbit that is no saddle, or outside the window.

    Notes
    -----
    A branch begins on the eigenvector of the monodromy matrix, 1e-7 away from the orbit; the piece between
    that point and its image is mapped on and on. Where images of neighbours are too far apart, or bend too much, points
    are put between them on the first piece and mapped as often (Hobson, 1993; the bend as in Krauskopf and Osinga,
    1998): nothing is interpolated but on the first piece, whose error of 1e-14 shrinks with each map. The stable
    manifold grows by the same rule and the map backward in time, `backward_map`.

    What leaves twice the window is not followed, so a piece that would come back from beyond is missing.

    Examples
    --------
    >>> from gearpair import Oscillator, periodic_orbit
    >>> saddle = periodic_orbit(Oscillator(), -1.5688, -1.0135, 1)
    >>> found = manifolds(saddle, length=3.0)
    >>> len(found.stable), len(found.unstable), float(found.stable[0][0].round(4)[0])
    (2, 2, -1.5688)
    """
    spacing, length = check_number("spacing", spacing, above=0.0), check_number("length", length, above=0.0)
    max_points = check_count("max_points", max_points)
    window = np.array([check_reach("x", x), check_reach("v", v)])
    check_saddle(orbit)
    if not np.all((orbit.points >= window[:, 0]) & (orbit.points <= window[:, 1])):
        raise ValueError(f"x and v must hold the orbit, which is at {orbit.points.tolist()}, got {x} and {v}")
    curves: dict[str, list[NDArray[np.float64]]] = {"stable": [], "unstable": []}
    complete = True
    for k in range(orbit.period):
        for name, branch in branches_at(orbit, k, window, spacing):
            curve, _places, ended = branch.grown(length, max_points)
            curves[name].append(curve)
            complete &= ended
    return Manifolds(orbit, tuple(curves["stable"]), tuple(curves["unstable"]), spacing, complete)


def branches_at(
    orbit: PeriodicOrbit, k: int, window: NDArray[np.float64], spacing: float
) -> Iterator[tuple[str, Branch]]:
    """The two unstable and the two stable branches at section point `k` of a saddle, ready to grow."""
    osc, (x, v), m = orbit.oscillator, orbit.points[k].tolist(), np.empty((2, 2))
    derivative(osc.cells, x, v, orbit.period, m, np.empty(TERMS))
    large, small = multipliers_of(m).real.tolist()
    for name, step, multiplier, growth in (
        ("unstable", forward(osc), large, large),
        ("stable", backward(osc), small, 1.0 / small),
    ):
        direction = eigenvector(m, multiplier)
        turns = 1 if growth > 0.0 else 2  # a negative multiplier takes one branch to the other
        for side in (1.0, -1.0):
            seed = Seed(orbit.points[k], side * direction, growth**turns)
            yield name, Branch(step, turns * orbit.period, seed, window, spacing)


def eigenvector(m: NDArray[np.float64], multiplier: float) -> NDArray[np.float64]:
    """The eigenvector of a matrix (2, 2), of length one and with X rising: the larger column of ``m - other``.

    By Cayley and Hamilton ``m - other multiplier`` takes everything to it.
    """
    columns = m - (np.trace(m) - multiplier) * np.eye(2)
    lengths = np.hypot(*columns)
    direction = columns[:, np.argmax(lengths)] / lengths.max()
    return np.asarray(direction if direction[0] >= 0.0 else -direction)


@dataclass(frozen=True)
class Seed:
    """The first piece of a branch, over t from 0 to 1: from the begin to its image."""

    point: NDArray[np.float64]
    direction: NDArray[np.float64]  # of length one
    growth: float  # above 1

    def points(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        """The points at `t` (n,), shape (n, 2)."""
        begin = BEGIN * max(1.0, float(np.abs(self.point).max()))
        return self.point + (begin * self.growth**t)[:, None] * self.direction


class Branch:
    """One branch of a manifold while it grows, image by image of its first piece."""

    def __init__(self, step: PeriodMap, period: int, seed: Seed, window: NDArray[np.float64], spacing: float) -> None:
        self._step, self._period, self._seed, self._spacing = step, period, seed, spacing
        self._middle, self._half = window.mean(axis=1), 0.5 * np.ptp(window, axis=1)

    def at(self, place: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The point (2,) at a place of the branch, and the direction (2,) of the curve there, outwards."""
        n, way, m = int(place), (1.0, self._step.way), np.empty((2, 2))
        x, v = (self._seed.points(np.array([place - n]))[0] * way).tolist()
        status, x, v = derivative(self._step.cells, x, v, n * self._period, m, np.empty(TERMS))
        if status != OK:
            return np.full(2, np.nan), np.full(2, np.nan)
        direction = (m @ (self._seed.direction * way)) * way
        return np.array([x, v]) * way, direction / float(np.hypot(*direction))

    def grown(self, length: float, max_points: int) -> tuple[NDArray[np.float64], NDArray[np.float64], bool]:
        """The curve (n, 2) from the orbit outwards, the places (n,) of its points, and whether nothing is left to grow.

        A place is the number of the image of the first piece, and the share of this piece.
        """
        t = np.linspace(0.0, 1.0, SEEDS)
        points, joined = self._seed.points(t), np.ones(SEEDS - 1, bool)
        points[-1] = self._step(points[:1], self._period)[0]  # so that each image begins where the one before it ends
        curve = [np.append(self._seed.point, -np.inf)[None]]
        total, count, n = 0.0, 1, 0
        while True:
            t, points, joined, full = self._filled(t, points, joined, n, max_points - count)
            curve += pieces_of(t, np.column_stack([points, n + t]), joined, n > 0)
            added = np.hypot(*np.diff(points, axis=0)[joined].T)
            total, count = total + float(added.sum()), count + len(points)
            grown = float(np.hypot(*(points - self._seed.point).T).max())
            ended = not joined.any() or (grown > self._spacing and added.sum() < STANDSTILL * self._spacing)
            if ended or total >= length or not full:
                return *cut(joined_pieces(curve), length), ended and full
            keep = np.concatenate([joined, [False]]) | np.concatenate([[False], joined])
            joined = (joined & keep[1:])[np.flatnonzero(keep)[:-1]]
            if count + keep.sum() > max_points:
                return *cut(joined_pieces(curve), length), False
            t, points, n = t[keep], self._step(points[keep], self._period), n + 1
            joined &= self._followed(points)

    def _followed(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Whether each chord between `points` (n, 2) has an end where the curve is followed; shape (n - 1,)."""
        inside = np.abs((points - self._middle) / self._half).max(axis=1) <= BEYOND
        known = np.isfinite(points[:, 0])
        return (inside[1:] | inside[:-1]) & known[1:] & known[:-1]

    def _filled(
        self, t: NDArray[np.float64], points: NDArray[np.float64], joined: NDArray[np.bool_], n: int, room: int
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_], bool]:
        """The image number `n` with points put in until it is fine enough, and whether it became so.

        Where there is no room, or no number left between two neighbours on the first piece, it ends before.
        """
        while True:
            coarse = joined & self._coarse(points, joined)
            if not coarse.any():
                return t, points, joined, True
            at, middle = np.flatnonzero(coarse), 0.5 * (t[1:] + t[:-1])
            stuck = (middle[at] <= t[at]) | (middle[at] >= t[at + 1])
            if stuck.any() or len(points) + len(at) > room:
                end = int(at[0]) + 1
                return t[:end], points[:end], joined[: end - 1], False
            between = self._step(self._seed.points(middle[at]), n * self._period)
            t, points = np.insert(t, at + 1, middle[at]), np.insert(points, at + 1, between, axis=0)
            joined = np.insert(joined, at + 1, True) & self._followed(points)

    def _coarse(self, points: NDArray[np.float64], joined: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Whether each chord is too long, or bends too much against its neighbours; shape (n - 1,)."""
        chords = np.diff(points, axis=0)
        sizes = np.hypot(*chords.T)
        cross = chords[:-1, 0] * chords[1:, 1] - chords[:-1, 1] * chords[1:, 0]
        angles = np.abs(np.arctan2(cross, (chords[:-1] * chords[1:]).sum(axis=1)))
        angles[~(joined[:-1] & joined[1:])] = 0.0
        bend = np.maximum(np.append(angles, 0.0), np.append(0.0, angles))
        return (sizes > self._spacing) | ((sizes * bend > BENT * self._spacing) & (sizes > LEAST * self._spacing))


def pieces_of(
    t: NDArray[np.float64], points: NDArray[np.float64], joined: NDArray[np.bool_], follows: bool
) -> list[NDArray[np.float64]]:
    """The runs of joined points, one a row, of one image, at `t`: a row of nan between them and for lost ends.

    One that `follows` another begins where that ends, and leaves this point out.
    """
    gap = np.full((1, points.shape[1]), np.nan)
    out = [gap] if t[0] > 0.0 else []
    for run in np.split(points, np.flatnonzero(~joined) + 1):
        out += [run, gap] if len(run) > 1 else [gap]
    if follows and t[0] == 0.0 and len(joined) > 0 and joined[0]:
        out[0] = out[0][1:]
    return out if t[-1] < 1.0 or not joined[-1] else out[:-1]


def joined_pieces(curve: list[NDArray[np.float64]]) -> NDArray[np.float64]:
    """One array, in which no row of nan follows another or ends it."""
    rows = np.concatenate(curve)
    lost = np.isnan(rows[:, 0])
    return rows[~(lost & np.concatenate([lost[1:], [True]]))]


def cut(rows: NDArray[np.float64], length: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The points (n, 2) and the places (n,) of a curve up to the first point at `length`."""
    sizes = np.nan_to_num(np.hypot(*np.diff(rows[:, :2], axis=0).T))
    rows = rows[: int(np.searchsorted(np.cumsum(sizes), length)) + 2]
    return np.ascontiguousarray(rows[:, :2]), rows[:, 2]


def length_of(curve: NDArray[np.float64]) -> float:
    """The length of a curve's pieces together."""
    return float(np.nansum(np.hypot(*np.diff(curve, axis=0).T)))


def check_saddle(orbit: PeriodicOrbit) -> None:
    """A ValueError unless `orbit` is a saddle."""
    if orbit.multipliers is None or orbit.multipliers.imag.any() or not _parts(np.abs(orbit.multipliers)):
        raise ValueError(f"orbit must be a saddle, with one multiplier outside the unit circle, got: {orbit!r}")


def _parts(moduli: NDArray[np.float64]) -> bool:
    return bool(moduli[0] > 1.0 > moduli[1])
