"""How close a computed table of motions comes to the published one.

Everything in `score` was fixed before the first hypothesis was computed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_count
from gearpair.article import published
from gearpair.article.published import CHAOTIC, COMPLEX
from gearpair.motion.names import Motion, periodic


def axis(parameter: str, n_values: int) -> NDArray[np.float64]:
    """Evenly spaced values over the published axis of a parameter.

    Examples
    --------
    >>> axis("mesh_frequency", 5).round(3).tolist()
    [0.7, 0.95, 1.2, 1.45, 1.7]
    """
    ranges = published.ranges(parameter)
    return np.linspace(ranges[0].lower, ranges[-1].upper, check_count("n_values", n_values, at_least=2))


def random_tables(parameter: str, n: int, *, seed: int = 0, n_values: int = 101) -> list[Score]:
    """Scores of tables with the published motions in their order and boundaries at random.

    They are what a table scores by chance that already knows the motions and their order.

    Examples
    --------
    >>> len(random_tables("damping_ratio", 3))
    3
    """
    values = axis(parameter, n_values)
    periods = np.array([r.motion.period or 0 for r in published.ranges(parameter)])
    draw = np.random.default_rng(seed).random((check_count("n", n), len(periods) - 1))
    cuts = values[0] + (values[-1] - values[0]) * np.sort(draw, axis=1)
    return [score(parameter, values, periods[np.searchsorted(row, values, side="right")]) for row in cuts]


NARROW = 1 / 50  # of the axis: narrower runs are dropped before boundaries and sequence are read off
FARTHEST = 1 / 10  # of the axis: a boundary found this far from the published one earns nothing


@dataclass(frozen=True)
class Change:
    """Where one kind of motion gives way to another in a table, the parameter rising."""

    below: Motion
    above: Motion
    value: float


@dataclass(frozen=True)
class Match:
    """A published boundary and the nearest computed boundary between the same two kinds of motion.

    Attributes
    ----------
    found : float or None
        None where the table has no such boundary.
    """

    boundary: published.Boundary
    found: float | None

    @property
    def distance(self) -> float | None:
        """How far the found boundary lies above the published one (dimensionless)."""
        return None if self.found is None else self.found - self.boundary.value


@dataclass(frozen=True)
class Score:
    """How a table of motions along one parameter compares with the published table; each part from 0 to 1.

    Attributes
    ----------
    agreement : float
        Fraction of the axis on which the motion is the published one.
    closeness : float
        Mean over the published boundaries of ``max(0, 1 - distance / (axis / 10))``, 0 where none was found.
    sequence : float
        ``2 L / (m + n)``: L is the longest common subsequence of the two sequences of motions, m and n their lengths.
    motions : tuple of Motion
        The sequence found.
    changes : tuple of Change
        Its boundaries.
    matches : tuple of Match
        One per published boundary.
    """

    parameter: str
    agreement: float
    closeness: float
    sequence: float
    motions: tuple[Motion, ...]
    changes: tuple[Change, ...]
    matches: tuple[Match, ...]

    @property
    def total(self) -> float:
        """The mean of the three parts."""
        return (self.agreement + self.closeness + self.sequence) / 3.0


def published_kind(period: int, parameter: str) -> Motion:
    """The published table's word for a motion.

    Parameters
    ----------
    period : int
        In mesh periods, 0 where the motion is not periodic.
    parameter : {"mesh_frequency", "damping_ratio"}

    Returns
    -------
    Motion
        On the frequency axis period 1, 2 or 4, and `COMPLEX` for all else: the article's complex zone holds chaotic
        bands and windows of other periods. On the damping axis the period, and `CHAOTIC` for none. Whether chaos
        lasts is not asked: that hangs on how many periods were discarded before the period was read off.

    Examples
    --------
    >>> print(published_kind(3, "mesh_frequency"), published_kind(3, "damping_ratio"), sep="; ")
    complex; period 3
    """
    if parameter == "mesh_frequency":
        return periodic(period) if period in (1, 2, 4) else COMPLEX
    return periodic(period) if period else CHAOTIC


def published_motions(parameter: str) -> tuple[Motion, ...]:
    """The published sequence of motions along one parameter.

    Examples
    --------
    >>> print(*published_motions("damping_ratio"), sep="; ")
    chaotic; period 3; period 1
    """
    return tuple(r.motion for r in published.ranges(parameter))


def published_at(parameter: str, values: NDArray[np.float64]) -> list[Motion]:
    """The published motion at each value; a boundary belongs to the range above it."""
    ranges = published.ranges(parameter)
    ends = [r.upper for r in ranges[:-1]]
    return [ranges[k].motion for k in np.searchsorted(ends, values, side="right")]


def score(parameter: str, values: ArrayLike, periods: ArrayLike) -> Score:
    """Compare a computed table of motions with the published one.

    Parameters
    ----------
    parameter : {"mesh_frequency", "damping_ratio"}
    values : array_like of float, shape (n,)
        Parameter values, ascending, evenly spaced over the published axis.
    periods : array_like of int, shape (n,)
        The period at each value, 0 where the motion is not periodic.

    Notes
    -----
    The table is a staircase: each value stands for the interval up to the middle between it and its neighbours. Its
    runs of one motion, without those narrower than 1/50 of the axis, give the sequence and the boundaries. A
    published boundary is matched by the nearest computed boundary with the same motions on either side; several
    published boundaries may share one.

    Examples
    --------
    >>> values = np.linspace(0.0, 0.025, 101)
    >>> perfect = score("damping_ratio", values, np.select([values < 0.00275, values < 0.0165], [0, 3], 1))
    >>> perfect.agreement, perfect.sequence, round(perfect.total, 2)
    (1.0, 1.0, 0.98)
    """
    ranges = published.ranges(parameter)
    grid, found = np.asarray(values, dtype=float), np.asarray(periods)
    if grid.ndim != 1 or grid.shape != found.shape or grid.size < 2 or np.any(np.diff(grid) <= 0.0):
        raise ValueError(f"values of {parameter} must ascend, one per period, at least 2; got shape {grid.shape}")
    motions = [published_kind(int(period), parameter) for period in found]
    expected = published_motions(parameter)
    agreement = float(np.mean([a == b for a, b in zip(motions, published_at(parameter, grid), strict=True)]))
    width = ranges[-1].upper - ranges[0].lower
    runs = _runs(grid, motions, NARROW * width)
    changes = tuple(Change(left[0], right[0], right[1]) for left, right in pairwise(runs))
    matches = []
    for boundary, kinds in zip(published.boundaries(parameter), pairwise(expected), strict=True):
        places = [change.value for change in changes if (change.below, change.above) == kinds]
        matches.append(Match(boundary, min(places, key=lambda place: abs(place - boundary.value), default=None)))
    closeness = [0.0 if m.distance is None else max(0.0, 1.0 - abs(m.distance) / (FARTHEST * width)) for m in matches]
    sequence = tuple(run[0] for run in runs)
    common = 2.0 * _common(sequence, expected) / (len(sequence) + len(expected))
    return Score(parameter, agreement, float(np.mean(closeness)), common, sequence, changes, tuple(matches))


def _runs(grid: NDArray[np.float64], motions: Sequence[Motion], narrow: float) -> list[tuple[Motion, float]]:
    """Motion and lower end of each run that is wide enough, neighbours of one motion merged."""
    middles = np.concatenate([[grid[0]], 0.5 * (grid[1:] + grid[:-1]), [grid[-1]]])
    wide: list[tuple[Motion, float]] = []
    i = 0
    for motion, group in groupby(motions):
        n = len(list(group))
        if middles[i + n] - middles[i] >= narrow and not (wide and wide[-1][0] == motion):
            wide.append((motion, float(middles[i])))
        i += n
    return wide


def _common(a: Sequence[Motion], b: Sequence[Motion]) -> int:
    """Length of the longest common subsequence."""
    lengths = [0] * (len(b) + 1)
    for x in a:
        before = lengths.copy()
        for j, y in enumerate(b):
            lengths[j + 1] = before[j] + 1 if x == y else max(lengths[j], before[j + 1])
    return lengths[-1]
