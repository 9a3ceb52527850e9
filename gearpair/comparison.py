"""The article's table of motions beside what was found."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from gearpair.published import Boundary, Range
from gearpair.ranges import MotionRange, attractor_names, symbol
from gearpair.tables import Table

if TYPE_CHECKING:
    import xarray as xr


def compare_ranges(published: Iterable[Range], found: Sequence[MotionRange], digits: int = 3) -> Table:
    """The published ranges beside what was found inside each.

    Parameters
    ----------
    published : iterable of Range
        As `gearpair.published.ranges` gives them.
    found : sequence of MotionRange
        As `found_ranges` gives them.
    digits : int
        Decimals shown.

    Returns
    -------
    Table
        The last column is the share of the published range where the published motion was found; a range
        published as complex or chaotic has none.
    """
    rows = []
    for stated in published:
        inside = [
            MotionRange(max(run.lower, stated.lower), min(run.upper, stated.upper), run.motion)
            for run in found
            if run.lower < stated.upper and run.upper > stated.lower
        ]
        texts = [f"{run.motion} ({run.lower:.{digits}f}–{run.upper:.{digits}f})" for run in inside]
        same = sum(run.width for run in inside if run.motion == f"period {stated.period}")
        share = f"{same / (stated.upper - stated.lower):.0%}" if stated.period else "–"
        interval = f"{stated.lower:.{digits}f}–{stated.upper:.{digits}f}"
        name = f"period {stated.period}" if stated.period else stated.motion
        rows.append([stated.item, interval, name, ", ".join(texts) or "none this wide", share])
    return Table(["item", "range", "published", "periodic motions found", "agreement"], rows)


def compare_attractors(
    published: Iterable[Range], planes: Mapping[float, xr.Dataset], least_share: float, digits: int = 3
) -> Table:
    """The published motion at some values of the parameter beside every attractor found there.

    Parameters
    ----------
    published : iterable of Range
        As `gearpair.published.ranges` gives them.
    planes : mapping of float to xarray.Dataset
        Of `gearpair.basins`, by the value of the parameter.
    least_share : float
        Attractors that fewer of the starts reach are left out.
    digits : int
        Decimals shown.

    Returns
    -------
    Table
    """
    ranges = list(published)
    rows = []
    for value, plane in planes.items():
        stated = next((r for r in ranges if value in r or value == ranges[-1].upper == r.upper), None)
        motion = "–" if stated is None else f"period {stated.period}" if stated.period else stated.motion
        counts = Counter(attractor_names(plane, least_share))
        texts = [name if count == 1 else f"{name} ({count} of them)" for name, count in counts.items()]
        rows.append([f"{value:.{digits}f}", stated.item if stated else "–", motion, "; ".join(texts)])
    return Table([symbol(ranges[0].parameter), "item", "published", "attractors found"], rows)


def compare_boundaries(
    published: Iterable[Boundary], stated: Sequence[Range], found: Sequence[MotionRange], *, gap: float, digits: int = 3
) -> Table:
    """The published boundaries beside the nearest change between the same two kinds of motion.

    Parameters
    ----------
    published : iterable of Boundary
        As `gearpair.published.boundaries` gives them.
    stated : sequence of Range
        The published ranges that they separate.
    found : sequence of MotionRange
        As `found_ranges` gives them.
    gap : float
        Two ranges follow on each other when no more than this lies between them; a periodic motion with nothing that
        follows on it changes into something complex.
    digits : int
        Decimals shown.

    Returns
    -------
    Table
    """
    changes = _changes(found, gap)
    rows = []
    for boundary, below, above in zip(published, stated[:-1], stated[1:], strict=True):
        change = tuple(f"period {r.period}" if r.period else "complex" for r in (below, above))
        places = [place for place, kind in changes if kind == change]
        nearest = min(places, key=lambda place: abs(place - boundary.value), default=None)
        shown = (
            ("none", "–") if nearest is None else (f"{nearest:.{digits}f}", f"{nearest - boundary.value:+.{digits}f}")
        )
        rows.append([boundary.item, f"{boundary.value:.{digits}f}", " to ".join(change), boundary.event or "", *shown])
    return Table(["item", "published", "change", "said to be", "nearest found", "difference"], rows)


def _changes(found: Sequence[MotionRange], gap: float) -> list[tuple[float, tuple[str, str]]]:
    """Where one kind of motion gives way to another, the parameter rising; the ends of all found are no changes."""
    if not found:
        return []
    first, last = min(run.lower for run in found), max(run.upper for run in found)
    changes = []
    for run in found:
        after = [other for other in found if abs(other.lower - run.upper) <= gap and other.upper > run.upper]
        before = [other for other in found if abs(other.upper - run.lower) <= gap and other.lower < run.lower]
        changes += [(run.upper, (run.motion, other.motion)) for other in after]
        if not after and run.upper < last:
            changes.append((run.upper, (run.motion, "complex")))
        if not before and run.lower > first:
            changes.append((run.lower, ("complex", run.motion)))
    return changes
