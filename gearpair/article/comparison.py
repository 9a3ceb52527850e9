"""The article's table of motions beside what was found."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from gearpair._checks import check_count, checked
from gearpair.article import published
from gearpair.article.published import Boundary, Range
from gearpair.ensembles.planes import attractor_motions
from gearpair.ensembles.ranges import MotionRange, joined_ranges
from gearpair.motion.names import Motion
from gearpair.quantities import symbol
from gearpair.table import Table

if TYPE_CHECKING:
    import xarray as xr


@checked
def compare_ranges(stated: Iterable[Range], found: Sequence[MotionRange], digits: int = 3) -> Table:
    """The published ranges beside what was found inside each.

    Parameters
    ----------
    stated : iterable of Range
        Of `gearpair.published.ranges`.
    found : sequence of MotionRange
        Of `found_ranges`, `stable_ranges` or both: ranges of one motion that overlap are told once.
    digits : int
        Decimals shown.

    Returns
    -------
    Table
        The last column is the share of the published range where the published motion was found; a range
        published as complex or chaotic has none.

    Examples
    --------
    >>> from gearpair.motion import periodic
    >>> found = [MotionRange(0.004, 0.014, periodic(3)), MotionRange(0.0165, 0.025, periodic(1))]
    >>> [row[-1] for row in compare_ranges(published.ranges("damping_ratio"), found).rows]
    ['–', '73%', '100%']
    """
    check_count("digits", digits, at_least=0)
    told_once = joined_ranges(found)
    rows = []
    for each in stated:
        inside = [
            MotionRange(max(run.lower, each.lower), min(run.upper, each.upper), run.motion)
            for run in told_once
            if run.lower < each.upper and run.upper > each.lower
        ]
        texts = [f"{run.motion} ({run.lower:.{digits}f}–{run.upper:.{digits}f})" for run in inside]
        same = sum(run.width for run in inside if run.motion == each.motion)
        share = f"{same / (each.upper - each.lower):.0%}" if each.motion.period else "–"
        interval = f"{each.lower:.{digits}f}–{each.upper:.{digits}f}"
        rows.append([each.item, interval, each.motion, ", ".join(texts) or "none this wide", share])
    return Table(["item", "range", "published", "periodic motions found", "agreement"], rows)


@checked
def compare_attractors(
    stated: Iterable[Range], planes: Mapping[float, xr.Dataset], least_share: float, digits: int = 3
) -> Table:
    """The published motion at some values of the parameter beside every attractor found there.

    Parameters
    ----------
    stated, digits
        As in `compare_ranges`.
    planes : mapping of float to xarray.Dataset
        Of `gearpair.basins`, by the value of the parameter; a chaotic transient is none of their attractors.
    least_share : float
        Attractors that fewer of the starts reach are left out.

    Examples
    --------
    >>> from gearpair import Oscillator, basins
    >>> plane = basins(Oscillator(damping_ratio=0.022), [-2.0, 1.0], [0.0])
    >>> compare_attractors(published.ranges("damping_ratio"), {0.022: plane}, least_share=0.1).rows[0]
    ('0.022', 'D5', 'period 1', 'period 1, double-sided; period 2, single-sided')
    """
    check_count("digits", digits, at_least=0)
    ranges = list(stated)
    if not ranges:
        raise ValueError("stated must hold one range at least, got none")
    rows = []
    for value, plane in planes.items():
        here = next((r for r in ranges if value in r or value == ranges[-1].upper == r.upper), None)
        counts = Counter(attractor_motions(plane, least_share))
        # Cycles can be counted. How many chaotic sets there are hangs on how long they were watched.
        texts = [
            f"{motion} ({count} of them)" if motion.period and count > 1 else str(motion)
            for motion, count in counts.items()
        ]
        item, motion = ("–", "–") if here is None else (here.item, str(here.motion))
        rows.append([f"{value:.{digits}f}", item, motion, "; ".join(texts)])
    return Table([symbol(ranges[0].parameter), "item", "published", "attractors found"], rows)


@checked
def compare_boundaries(
    boundaries: Iterable[Boundary],
    stated: Sequence[Range],
    found: Sequence[MotionRange],
    *,
    gap: float,
    digits: int = 3,
) -> Table:
    """The published boundaries beside the nearest change between the same two kinds of motion.

    Parameters
    ----------
    boundaries : iterable of Boundary
    stated : sequence of Range
        The published ranges that they separate.
    found, digits
        As in `compare_ranges`.
    gap : float
        Two ranges follow on each other when no more than this lies between them; a periodic motion with nothing that
        follows on it changes into something complex.

    Examples
    --------
    >>> from gearpair.motion import periodic
    >>> found = [MotionRange(0.003, 0.016, periodic(3)), MotionRange(0.0162, 0.025, periodic(1))]
    >>> stated = published.ranges("damping_ratio")
    >>> table = compare_boundaries(published.boundaries("damping_ratio"), stated, found, gap=0.001, digits=4)
    >>> table.rows[-1][-2:]
    ('0.0160', '-0.0005')
    """
    check_count("digits", digits, at_least=0)
    boundaries = list(boundaries)
    if len(boundaries) + 1 != len(stated):
        raise ValueError(f"stated must be the ranges between {len(boundaries)} boundaries, one more, got {len(stated)}")
    changes = _changes(found, gap)
    rows = []
    for boundary, below, above in zip(boundaries, stated[:-1], stated[1:], strict=True):
        change = tuple(r.motion if r.motion.period else published.COMPLEX for r in (below, above))
        places = [place for place, kind in changes if kind == change]
        nearest = min(places, key=lambda place: abs(place - boundary.value), default=None)
        shown = (
            ("none", "–") if nearest is None else (f"{nearest:.{digits}f}", f"{nearest - boundary.value:+.{digits}f}")
        )
        rows.append(
            [boundary.item, f"{boundary.value:.{digits}f}", " to ".join(map(str, change)), boundary.event or "", *shown]
        )
    return Table(["item", "published", "change", "said to be", "nearest found", "difference"], rows)


def _changes(found: Sequence[MotionRange], gap: float) -> list[tuple[float, tuple[Motion, Motion]]]:
    """Where one kind of motion gives way to another, the parameter rising; the ends of all found are no changes."""
    first = min((run.lower for run in found), default=0.0)
    last = max((run.upper for run in found), default=0.0)
    changes = []
    for run in found:
        after = [other for other in found if abs(other.lower - run.upper) <= gap and other.upper > run.upper]
        before = [other for other in found if abs(other.upper - run.lower) <= gap and other.lower < run.lower]
        changes += [(run.upper, (run.motion, other.motion)) for other in after]
        if not after and run.upper < last:
            changes.append((run.upper, (run.motion, published.COMPLEX)))
        if not before and run.lower > first:
            changes.append((run.lower, (published.COMPLEX, run.motion)))
    return changes
