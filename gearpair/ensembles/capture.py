"""Many starts of one oscillator: attractors found on a few of them capture the others."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearpair._flow.capture import COLUMNS
from gearpair._flow.settle import APERIODIC, PERIODIC, UNSETTLED, Known, Settled, surround_rows
from gearpair.ensembles.datasets import settled_columns
from gearpair.motion.same_orbit import SAME_ORBIT
from gearpair.motion.settling import SettleSettings, nothing_known, settle_batch
from gearpair.oscillator import Oscillator

SCOUTS = 256  # starts that are settled first, at most an eighth of all
# Chaotic motions no farther apart than this, in a chain, are one set.
SAME_SET = {"x_min": 0.25, "x_max": 0.25, "exponent": 0.1}


def scouts(n: int) -> NDArray[np.int64]:
    """Which of `n` starts to look for attractors from: steps of the golden section, even over a grid of any shape."""
    m = min(SCOUTS, n // 8)
    return np.unique((np.arange(1, m + 1) * 0.6180339887498949 % 1.0 * n).astype(np.int64))


def known_attractors(osc: Oscillator, starts: NDArray[np.float64], settings: SettleSettings) -> Known:
    """The periodic attractors that starts (n, 2) reach, with the neighbourhoods that capture other motions.

    It depends on the starts and the settings alone, not on threads.
    """
    if len(starts) == 0:
        return nothing_known(settings)
    return known_among(osc, settle_batch([osc], starts, settings))


def known_among(osc: Oscillator, out: Settled) -> Known:
    """The periodic attractors among settled motions, in the order in which they turn up."""
    found, _ = found_in(settled_columns(out))
    rows = np.sort(found.first[found.columns["status"] == PERIODIC])
    settled = Settled._make(column[rows] for column in out)
    settled.way[:] = np.nan
    neighbourhoods = np.empty((int(settled.period.sum()), COLUMNS))
    filled = surround_rows(osc.cells, settled.points[:, 0].copy(), settled.period, neighbourhoods)
    return Known(settled, neighbourhoods[:filled].copy())


class Found(NamedTuple):
    """The distinct attractors of some motions, in no order."""

    marks: NDArray[np.int64]  # (m, 5): see `marks_of`
    first: NDArray[np.int64]  # (m,) the first motion that shows it
    counts: NDArray[np.int64]  # (m,) motions
    columns: dict[str, NDArray[Any]]  # what that first motion is, (m,) each


def marks_of(columns: Mapping[str, NDArray[Any]]) -> NDArray[np.int64]:
    """Whole numbers (n, 5) for each motion: those of one attractor are equal, or chains of them differ by 1 at most.

    Periodic orbits by period and section point; chaotic sets by the extremes of X and the exponent, both measured over
    a finite span; status and period in steps of ten, so that none is next to another.
    """
    status, period = columns["status"].astype(np.int64), columns["period"].astype(np.int64)
    marks = np.zeros((len(status), 5), np.int64)
    marks[:, 0], marks[:, 1] = 10 * status, 10 * period
    orbit, chaos = status == PERIODIC, status == APERIODIC
    for k, name in enumerate(("section_x", "section_v")):
        marks[orbit, 2 + k] = np.round(columns[name][orbit] / SAME_ORBIT)
    for k, (name, width) in enumerate(SAME_SET.items()):
        marks[chaos, 2 + k] = np.floor(columns[name][chaos] / width)
    return marks


def found_in(columns: Mapping[str, NDArray[Any]], offset: int = 0) -> tuple[Found, NDArray[np.int64]]:
    """The distinct attractors among motions that are counted from `offset`, and for each motion its place, or -1."""
    judged = np.isin(columns["status"], (PERIODIC, APERIODIC, UNSETTLED))
    marks = marks_of(columns)[judged]
    # One number instead of five sorts much faster.
    mixed = np.zeros(len(marks), np.uint64)
    for column in marks.T:
        mixed = mixed * np.uint64(0x9E3779B97F4A7C15) + column.astype(np.uint64)
    _, first, own, counts = np.unique(mixed, return_index=True, return_inverse=True, return_counts=True)
    places = np.full(len(judged), -1)
    places[judged] = own.ravel()
    rows = np.flatnonzero(judged)[first]
    return Found(marks[first], rows + offset, counts, {name: c[rows] for name, c in columns.items()}), places


def numbered(columns: Mapping[str, NDArray[Any]]) -> tuple[NDArray[np.int64], dict[str, NDArray[Any]]]:
    """The number of each motion's attractor, or -1, and what each attractor is: `number_attractors` of one part."""
    found, places = found_in(columns)
    (numbers,), table = number_attractors([found])
    return numbers[places], table


def number_attractors(found: Sequence[Found]) -> tuple[list[NDArray[np.int64]], dict[str, NDArray[Any]]]:
    """One numbering for the attractors of several parts: the number of each part's places, and what each attractor is.

    Periodic attractors come first, by period and X; then chaotic sets, by their smallest X; then all unsettled motions
    as one. The table has their columns, the ``first`` motion of each and ``counts``.
    """
    from scipy.sparse.csgraph import connected_components  # here, so that importing gearpair stays quick
    from scipy.spatial import cKDTree

    marks, first = np.concatenate([f.marks for f in found]), np.concatenate([f.first for f in found])
    columns = {name: np.concatenate([f.columns[name] for f in found]) for name in found[0].columns}
    n, sets = 0, np.zeros(0, int)
    if len(marks):
        tree = cKDTree(marks)
        n, sets = connected_components(tree.sparse_distance_matrix(tree, 1.0, p=np.inf).tocsr())
    shown = np.array([np.flatnonzero(sets == k)[np.argmin(first[sets == k])] for k in range(n)], dtype=int)
    orbit = columns["status"][shown] == PERIODIC
    keys = [
        np.where(orbit, columns[f"section_{a}"][shown], columns[b][shown]) for a, b in (("v", "x_max"), ("x", "x_min"))
    ]
    order = np.lexsort((*keys, columns["period"][shown], columns["status"][shown]))
    rank = np.empty(n, int)
    rank[order] = np.arange(n)
    counts = np.concatenate([f.counts for f in found])
    table = {name: column[shown[order]] for name, column in columns.items()}
    table["first"] = first[shown[order]]
    table["counts"] = np.bincount(rank[sets], weights=counts, minlength=n)
    ends = np.cumsum([len(f.first) for f in found])[:-1]
    # The last entry of each part serves the place -1.
    return [np.append(numbers, -1) for numbers in np.split(rank[sets], ends)], table
