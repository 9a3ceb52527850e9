"""Chaotic sets among many motions: which were on one, how many left it, and for how long they were watched.

The motions of a set are one experiment: as soon as one has left it, the set is a transient, and what is still there is
no attractor; as long as none has, it lasts for all that is known, with a mean life that has a lower bound.
"""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearpair._flow.settle import SAME_EXPONENT, SAME_RANGE
from gearpair._flow.states import APERIODIC, GONE, PERIODIC, TRANSIENT
from gearpair.ensembles.escape_rates import EscapeRate, counted_rate

# Motions whose smallest X, largest X and exponent, in these steps, are equal or next to one another are on one set. A
# few of many reach farther than the others in the same time, so the steps of the range are wide.
STEPS = (2.0 * SAME_RANGE, 2.0 * SAME_RANGE, SAME_EXPONENT)
NAMES = ("chaos_x_min", "chaos_x_max", "chaos_exponent")
LIFE = ("mean_life", "mean_life_low", "mean_life_high")


class Observed(NamedTuple):
    """Motions that were on chaotic sets when they were observed, gathered by what they were."""

    cells: NDArray[np.int64]  # (m, 3) in whole `STEPS`
    motions: NDArray[np.int64]  # (m,) how many
    watched: NDArray[np.int64]  # (m,) of these, how many were watched
    periods: NDArray[np.int64]  # (m,) mesh periods, together
    escapes: NDArray[np.int64]  # (m,) how many left
    x_min: NDArray[np.float64]  # (m,)
    x_max: NDArray[np.float64]  # (m,)
    exponents: NDArray[np.float64]  # (m,) their sum


class ChaoticSets(NamedTuple):
    """Chaotic sets, by their smallest X."""

    seen: Observed  # all that was seen, a row a cell
    own: NDArray[np.int64]  # (m,) the set of each
    observed: Observed  # one row a set

    @property
    def rates(self) -> list[EscapeRate]:
        """The escape rate of each."""
        return [counted_rate(*map(int, row)) for row in zip(*self.observed[2:5], strict=True)]

    @property
    def transient(self) -> NDArray[np.bool_]:
        """Whether motions have left it, (n,)."""
        return self.observed.escapes > 0

    @property
    def exponents(self) -> NDArray[np.float64]:
        """The mean exponent of the motions of each, (n,); rounded, as a sum depends on the order of its terms."""
        return np.round(self.observed.exponents / np.maximum(self.observed.motions, 1), 12)


def on_sets(columns: Mapping[str, NDArray[Any]], discard: int) -> NDArray[np.bool_]:
    """Which motions were on a chaotic set when they were observed, ``discard`` mesh periods after their start.

    That is what has not settled, or has settled or escaped only later.
    """
    still = np.isin(columns["status"], (APERIODIC, TRANSIENT))
    left = np.isin(columns["status"], (PERIODIC, GONE)) & (columns["lasted"] > discard)
    return np.asarray(still | (left & (columns["chaos_exponent"] > 0.0)))


def cells_of(columns: Mapping[str, NDArray[Any]], chosen: NDArray[np.bool_]) -> NDArray[np.int64]:
    """What the `chosen` motions were, (n, 3) in whole `STEPS`."""
    return np.stack([np.floor(columns[name][chosen] / step) for name, step in zip(NAMES, STEPS, strict=True)], axis=1)


def observed_in(columns: Mapping[str, NDArray[Any]], discard: int) -> Observed:
    """The motions of some columns that were on chaotic sets."""
    chosen = on_sets(columns, discard)
    n, periods = int(chosen.sum()), columns["lasted"][chosen] - discard
    escapes = np.isin(columns["status"][chosen], (PERIODIC, GONE)).astype(np.int64)
    low, high, exponents = (columns[name][chosen] for name in NAMES)
    each = np.ones(n, np.int64), (periods > 0).astype(np.int64), periods, escapes
    return _gathered(Observed(cells_of(columns, chosen).astype(np.int64), *each, low, high, exponents))


def scouted(lasting: NDArray[np.float64]) -> Observed:
    """What is known beforehand to last (see `gearpair._flow.states.Known`), of motions that are not counted again."""
    columns = dict(zip(NAMES, lasting[:, :3].T, strict=True))
    none, watched = np.zeros(len(lasting), np.int64), (lasting[:, 3] > 0).astype(np.int64)
    cells = cells_of(columns, np.ones(len(lasting), bool)).astype(np.int64)
    numbers = none, watched, lasting[:, 3].astype(np.int64), none
    return _gathered(Observed(cells, *numbers, lasting[:, 0], lasting[:, 1], 0.0 * lasting[:, 2]))


def _gathered(rows: Observed, own: NDArray[np.int64] | None = None) -> Observed:
    """Rows of one cell, or of one number of `own`, made one."""
    if own is None:
        cells, own = np.unique(rows.cells, axis=0, return_inverse=True)
        own = own.ravel()
    else:
        cells = rows.cells[np.unique(own, return_index=True)[1]]
    n = len(cells)
    low, high, exponents = np.full(n, np.inf), np.full(n, -np.inf), np.zeros(n)
    np.minimum.at(low, own, rows.x_min)
    np.maximum.at(high, own, rows.x_max)
    np.add.at(exponents, own, rows.exponents)
    counts = np.zeros((4, n), np.int64)
    for total, column in zip(counts, (rows.motions, rows.watched, rows.periods, rows.escapes), strict=True):
        np.add.at(total, own, column)
    return Observed(cells, counts[0], counts[1], counts[2], counts[3], low, high, exponents)


def chaotic_sets(parts: Iterable[Observed]) -> ChaoticSets:
    """The sets of the motions of all parts; those of one set form a chain of neighbouring cells."""
    rows = _gathered(Observed._make(map(np.concatenate, zip(*parts, strict=True))))
    own = chained(rows.cells)
    order = np.argsort(_gathered(rows, own).x_min, kind="stable")
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    own = rank[own]
    return ChaoticSets(rows, own, _gathered(rows, own))


def chained(marks: NDArray[np.int64]) -> NDArray[np.int64]:
    """The group of each row of whole numbers, where rows that differ by 1 at most in every place are in one group."""
    from scipy.sparse.csgraph import connected_components  # here, so that importing gearpair stays quick
    from scipy.spatial import cKDTree

    if not len(marks):
        return np.zeros(0, np.int64)
    tree = cKDTree(marks)
    _, groups = connected_components(tree.sparse_distance_matrix(tree, 1.0, p=np.inf).tocsr())
    return np.asarray(groups, np.int64)


def neighbours(marks: NDArray[np.int64], others: NDArray[np.int64]) -> NDArray[np.int64]:
    """For each row of `others` the row of `marks` that is nearest, and differs by 1 at most in every place; or -1."""
    from scipy.spatial import cKDTree

    if not len(marks):
        return np.full(len(others), -1)
    apart, places = cKDTree(marks).query(others, p=np.inf)
    return np.where(apart <= 1.0, places, -1)


def sets_of(sets: ChaoticSets, columns: Mapping[str, NDArray[Any]], discard: int) -> NDArray[np.int64]:
    """The set that each motion was on, or that is next to it where it was not seen there; else -1."""
    chosen = on_sets(columns, discard)
    cells, inverse = np.unique(cells_of(columns, chosen), axis=0, return_inverse=True)
    labels = np.full(len(chosen), -1)
    labels[chosen] = np.append(sets.own, -1)[neighbours(sets.seen.cells, cells)][inverse.ravel()]
    return labels


def judged_status(
    sets: ChaoticSets, labels: NDArray[np.int64], columns: Mapping[str, NDArray[Any]]
) -> NDArray[np.int8]:
    """The status of each motion, which on a set that others have left is that of a transient."""
    status = columns["status"].copy()
    still = np.isin(status, (APERIODIC, TRANSIENT))
    status[still] = np.where(np.append(sets.transient, False)[labels[still]], TRANSIENT, APERIODIC)
    return np.asarray(status)
