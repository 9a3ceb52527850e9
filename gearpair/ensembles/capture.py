"""Many starts of one oscillator: attractors found on a few of them capture the others."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearpair._flow.capture import COLUMNS, surround_rows
from gearpair._flow.states import APERIODIC, FLOATING, PERIODIC, UNSETTLED, Known, Settled
from gearpair.ensembles.chaos import (
    ChaoticSets,
    Observed,
    chained,
    chaotic_sets,
    judged_status,
    observed_in,
    scouted,
    sets_of,
)
from gearpair.ensembles.datasets import settled_columns
from gearpair.motion.impacts import impact_codes
from gearpair.motion.same_orbit import SAME_ORBIT
from gearpair.motion.settling import SettleSettings, nothing_known, settle_batch
from gearpair.oscillator import Oscillator

SCOUTS, STARTS_PER_SCOUT = 256, 8  # starts that are settled first, at most an eighth of all
# Mesh periods that a chaotic set is watched for without an escape, by all scouts on it together, before other motions
# on it are believed to stay: at 95 % its mean life is then at least a third of them.
POOL = 1_000_000


def scouts(n: int) -> NDArray[np.int64]:
    """Which of `n` starts to look for attractors from: steps of the golden section, even over a grid of any shape."""
    m = min(SCOUTS, n // STARTS_PER_SCOUT)
    return np.unique((np.arange(1, m + 1) * 0.6180339887498949 % 1.0 * n).astype(np.int64))


def known_attractors(osc: Oscillator, starts: NDArray[np.float64], settings: SettleSettings) -> Known:
    """What the scouts (n, 2) show: periodic attractors with the neighbourhoods that capture others, and lasting chaos.

    It depends on the starts and the settings alone, not on threads.
    """
    if len(starts) == 0:
        return nothing_known(settings)
    out = settle_batch([osc], starts, settings)
    return known_among(osc, out)._replace(lasting=lasting_chaos(osc, out, settings))


def lasting_chaos(osc: Oscillator, out: Settled, settings: SettleSettings) -> NDArray[np.float64]:
    """What scouts on chaotic sets that lasted for `POOL` mesh periods were, with the periods each was watched; (k, 4).

    The scouts of a set share the watch, which goes on where it is not long enough yet; not of sets with so few of them
    that watching every motion on it costs no more.
    """
    columns, discard = settled_columns(out), settings.before_watch(osc)
    sets = chaotic_sets([observed_in(columns, discard)])
    labels = sets_of(sets, columns, discard)
    found = [np.empty((0, 4))]
    for k in np.flatnonzero(~sets.transient).tolist():
        rows = np.flatnonzero(labels == k)
        watched = out.lasted[rows] - discard
        more = max(0, -(-(POOL - int(watched.sum())) // len(rows)))
        if more >= STARTS_PER_SCOUT * settings.n_watch:
            continue
        on = settle_batch([osc], out.final[rows], replace(settings, n_transient=more, n_watch=0, n_exponent=1))
        if np.all(np.isin(on.status, (APERIODIC, UNSETTLED))):
            found.append(np.column_stack([out.chaos[rows], watched + more]))
    return np.concatenate(found)


def known_among(osc: Oscillator, out: Settled) -> Known:
    """The periodic attractors among settled motions, in the order in which they turn up."""
    found, _ = found_in(settled_columns(out) | {"chaotic_set": np.full(len(out.status), -1)})
    rows = np.sort(found.first[found.columns["status"] == PERIODIC])
    settled = Settled._make(column[rows] for column in out)
    settled.way[:] = np.nan
    neighbourhoods = np.empty((int(settled.period.sum()), COLUMNS))
    filled = surround_rows(osc.cells, settled.points[:, 0].copy(), settled.period, neighbourhoods)
    return Known(settled, neighbourhoods[:filled].copy(), np.empty((0, 4)))


def joined(osc: Oscillator, known: Known, out: Settled) -> Known:
    """The attractors known, and after them those that settled motions show besides."""
    return known_among(osc, Settled._make(map(np.concatenate, zip(known.settled, out, strict=True))))


class Found(NamedTuple):
    """The distinct attractors of some motions, in no order."""

    marks: NDArray[np.int64]  # (m, 4): see `marks_of`
    first: NDArray[np.int64]  # (m,) the first motion that shows it
    counts: NDArray[np.int64]  # (m,) motions
    columns: dict[str, NDArray[Any]]  # what that first motion is, (m,) each


def marks_of(columns: Mapping[str, NDArray[Any]]) -> NDArray[np.int64]:
    """Whole numbers (n, 4) for each motion: those of one attractor are equal, or chains of them differ by 1 at most.

    Periodic orbits by period and section point, chaotic sets by their number; status and period in steps of ten, so
    that none is next to another.
    """
    status, period = columns["status"].astype(np.int64), columns["period"].astype(np.int64)
    marks = np.zeros((len(status), 4), np.int64)
    marks[:, 0], marks[:, 1] = 10 * status, 10 * period
    orbit, chaos = status == PERIODIC, status == APERIODIC
    for k, name in enumerate(("section_x", "section_v")):
        marks[orbit, 2 + k] = np.round(np.nan_to_num(columns[name][orbit]) / SAME_ORBIT)  # nan where not kept
    marks[chaos, 2] = 10 * columns["chaotic_set"][chaos]
    return marks


def found_in(columns: Mapping[str, NDArray[Any]], offset: int = 0) -> tuple[Found, NDArray[np.int64]]:
    """The distinct attractors among motions that are counted from `offset`, and for each motion its place, or -1."""
    judged = np.isin(columns["status"], (PERIODIC, APERIODIC, UNSETTLED, FLOATING))
    marks = marks_of(columns)[judged]
    # One number instead of four sorts much faster.
    mixed = np.zeros(len(marks), np.uint64)
    for column in marks.T:
        mixed = mixed * np.uint64(0x9E3779B97F4A7C15) + column.astype(np.uint64)
    _, first, own, counts = np.unique(mixed, return_index=True, return_inverse=True, return_counts=True)
    places = np.full(len(judged), -1)
    places[judged] = own.ravel()
    rows = np.flatnonzero(judged)[first]
    return Found(marks[first], rows + offset, counts, {name: c[rows] for name, c in columns.items()}), places


class Numbers(NamedTuple):
    """Attractors that have numbers, which they keep among others."""

    numbers: NDArray[np.int64]  # (k,)
    columns: dict[str, NDArray[Any]]  # what each is, (k,) each
    observed: Observed  # what else has been seen of chaotic sets
    unused: int  # from here on no number has been given


class Numbered(NamedTuple):
    """What motions from many starts lead to."""

    columns: dict[str, NDArray[Any]]  # of each motion, with ``attractor`` and ``chaotic_set``, -1 where there is none
    table: dict[str, NDArray[Any]]  # of each attractor, by its number
    sets: ChaoticSets
    leads_to: NDArray[np.int64]  # (sets, attractors) how many motions that left a set went where


def numbered(
    columns: dict[str, NDArray[Any]], discard: int, lasting: NDArray[np.float64], before: Numbers | None = None
) -> Numbered:
    """Numbers for the attractors and chaotic sets of motions, those from `before` kept: what stores do in parts."""
    sets = chaotic_sets([observed_in(columns, discard), seen_before(lasting, before)])
    columns = with_sets(sets, columns, discard)
    found, places = found_in(columns)
    (numbers,), table = number_attractors([found], sets, before, len(places))
    columns = columns | {"attractor": numbers[places]}
    return Numbered(columns, table, sets, leading(columns, sets, table["number"]))


def seen_before(lasting: NDArray[np.float64], before: Numbers | None) -> Observed:
    """What is known of chaotic sets besides the motions that are numbered."""
    return scouted(lasting) if before is None else before.observed


def with_sets(sets: ChaoticSets, columns: dict[str, NDArray[Any]], discard: int) -> dict[str, NDArray[Any]]:
    """The columns with the number of each motion's chaotic set, and the status that follows from what others did."""
    labels = sets_of(sets, columns, discard)
    return columns | {"status": judged_status(sets, labels, columns), "chaotic_set": labels}


def leading(columns: Mapping[str, NDArray[Any]], sets: ChaoticSets, numbers: NDArray[np.int64]) -> NDArray[np.int64]:
    """How many motions have left each set for each attractor of the rising `numbers`."""
    left = (columns["chaotic_set"] >= 0) & (columns["status"] == PERIODIC)
    counts = np.zeros((len(sets.observed.motions), len(numbers)), np.int64)
    np.add.at(counts, (columns["chaotic_set"][left], np.searchsorted(numbers, columns["attractor"][left])), 1)
    return counts


def number_attractors(
    found: Sequence[Found], sets: ChaoticSets, before: Numbers | None = None, n: int = 0
) -> tuple[list[NDArray[np.int64]], dict[str, NDArray[Any]]]:
    """One numbering for the attractors of several parts: the number of each part's places, and what each attractor is.

    Periodic attractors come first, by period and X; then chaotic sets, by their smallest X; then all unsettled motions
    as one, and all that float. The table has their ``number`` and columns, the ``first`` motion of each and ``counts``;
    a chaotic set has the range and the mean exponent of all its motions.

    Attractors from `before` keep their numbers and come first, reached or not, but for chaotic sets that motions have
    left since. Their ``first`` goes on after the `n` motions of the parts.
    """
    if before is None:
        ranks, table = _ranked(found, sets)
        return ranks, table | {"number": np.arange(len(table["counts"]))}
    again, places = found_in(with_sets(sets, before.columns, 0), n)
    ranks, table = _ranked([*found, again._replace(counts=0 * again.counts)], sets)
    numbers = np.full(len(table["counts"]), -1)
    kept = ranks.pop()[places]
    numbers[kept[kept >= 0][::-1]] = before.numbers[kept >= 0][::-1]  # of two that are one now the first number
    numbers[numbers < 0] = before.unused + np.arange(np.sum(numbers < 0))
    order = np.argsort(numbers)
    table = {name: column[order] for name, column in table.items()} | {"number": numbers[order]}
    return [np.append(numbers, -1)[each] for each in ranks], table


def _ranked(found: Sequence[Found], sets: ChaoticSets) -> tuple[list[NDArray[np.int64]], dict[str, NDArray[Any]]]:
    """The order of the attractors of several parts, and what they are; see `number_attractors`."""
    marks, first = np.concatenate([f.marks for f in found]), np.concatenate([f.first for f in found])
    names = [name for name in found[0].columns if all(name in f.columns for f in found)]
    columns = {name: np.concatenate([f.columns[name] for f in found]) for name in names}
    groups = chained(marks)
    n = int(groups.max(initial=-1)) + 1
    shown = np.array([np.flatnonzero(groups == k)[np.argmin(first[groups == k])] for k in range(n)], dtype=int)
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
    table["counts"] = np.bincount(rank[groups], weights=counts, minlength=n)
    chaos = table["status"] == APERIODIC
    own = table["chaotic_set"][chaos]
    both = table["exponent"] + table["smallest_exponent"]  # what the damping takes, the same for all on a set
    for name, values in (("x_min", sets.observed.x_min), ("x_max", sets.observed.x_max), ("exponent", sets.exponents)):
        table[name][chaos] = values[own]
    table["smallest_exponent"][chaos] = (both - table["exponent"])[chaos]
    table["impact_state"] = impact_codes(table["x_min"], table["x_max"])
    ends = np.cumsum([len(f.first) for f in found])[:-1]
    # The last entry of each part serves the place -1.
    return [np.append(numbers, -1) for numbers in np.split(rank[groups], ends)], table
