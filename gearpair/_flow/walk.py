"""The walk: one oscillator's motion over whole base periods, cell by cell, event by event. The only loop of its kind.

What is gathered on the way is handed over as accumulators, each None where it is not asked for: the compiler then
leaves it out. ``m`` is the monodromy matrix (`tangent`), ``reach`` the range of X with the contacts (`reach`); what
needs every segment is in a `Details`.

A block of cells, and then a cell, is followed by its map where the motion certainly stays in its region and, with a
`reach`, within its range. Details ask for every segment.
"""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, Integers, allocating_kernel, inlined_kernel, kernel
from .cells import WIDTH, Cells
from .closed_form import TERMS
from .event_search import INSIDE, UNDECIDED
from .growth import Growth, grow
from .measures import Measures, measure_segment
from .reach import holds, widen
from .records import Extrema, Samples, Segments, list_extrema, list_segment, sample
from .segment import Segment, first_region, follow_row, next_segment, region_after
from .tangent import apply_map, apply_segment

# Status of a walk.
OK, ESCAPED, TOO_MANY_EVENTS, EVENT_UNDECIDED = 0, 1, 2, 3

MAX_EVENTS_PER_PERIOD = 10_000


class Details(NamedTuple):
    """What is gathered segment by segment."""

    samples: Samples | None = None
    segments: Segments | None = None
    extrema: Extrema | None = None
    measures: Measures | None = None
    growth: Growth | None = None


class Place(NamedTuple):
    """Where the walk is, and how many events this mesh period has had."""

    x: float
    v: float
    region: int
    events: int


@inlined_kernel
def see(details: Details | None, cells: Cells, segment: Segment) -> None:
    """Gather what a segment shows."""
    if details is None:
        return
    sample(details.samples, cells, segment)
    list_segment(details.segments, cells, segment)
    list_extrema(details.extrema, cells, segment)
    measure_segment(details.measures, cells, segment)
    grow(details.growth, cells, segment)


@kernel
def walk(
    cells: Cells,
    x: float,
    v: float,
    n_periods: int,
    series: Array,
    m: Array | None = None,
    reach: Array | None = None,
    details: Details | None = None,
) -> tuple[int, float, float]:
    """The state after `n_periods` base periods from (x, v) at the start of one: (status, x, v).

    Stops early, with the state reached, when the status is not OK. `series` (TERMS,) is scratch; `m` (2, 2) is
    multiplied by the monodromy matrix of the span, `reach` (4,) widened, `details` gathered.
    """
    return inlined_walk(cells, x, v, n_periods, series, m, reach, details)


@inlined_kernel
def inlined_walk(
    cells: Cells,
    x: float,
    v: float,
    n_periods: int,
    series: Array,
    m: Array | None = None,
    reach: Array | None = None,
    details: Details | None = None,
) -> tuple[int, float, float]:
    """`walk` for kernels that ask for one period at a time: a call, two dozen arrays, costs a tenth of a period.

    Or three periods, where the processor stalls at what is copied; that hangs on the chance of where it lies.
    """
    place = Place(x, v, first_region(cells, x, v), 0)
    for period in range(n_periods):
        for turn in range(cells.mesh_periods):
            status, place = walk_mesh_period(cells, period, turn, place, series, m, reach, details)
            if status != OK:
                return status, place.x, place.v
    return OK, place.x, place.v


@inlined_kernel
def walk_mesh_period(
    cells: Cells,
    period: int,
    turn: int,
    place: Place,
    series: Array,
    m: Array | None,
    reach: Array | None,
    details: Details | None,
) -> tuple[int, Place]:
    """Mesh period `turn` of a base period: (status, place)."""
    place = Place(place.x, place.v, place.region, 0)
    if details is None:
        # A division takes a hundredth of a mesh period.
        n = cells.block_width.size if cells.mesh_periods == 1 else cells.block_width.size // cells.mesh_periods
        for b in range(turn * n, (turn + 1) * n):
            row = cells.block_maps[b, place.region + 1]
            certain, x, v, low, high = follow_row(row, cells.block_width[b], place.x, place.v, place.region)
            if certain and holds(reach, low, high):
                apply_map(m, row)
                place = Place(x, v, place.region, place.events)
                continue
            span = cells.blocks[b], cells.blocks[b + 1]
            status, place = walk_cells(cells, period, span, place, series, m, reach, details)
            if status != OK:
                return status, place
    else:
        n = cells.level.size // cells.mesh_periods
        status, place = walk_cells(cells, period, (turn * n, (turn + 1) * n), place, series, m, reach, details)
        if status != OK:
            return status, place
    if not abs(place.x) + abs(place.v) <= cells.escape_radius:
        return ESCAPED, place
    return OK, place


@inlined_kernel
def walk_cells(
    cells: Cells,
    period: int,
    span: tuple[int, int],
    place: Place,
    series: Array,
    m: Array | None,
    reach: Array | None,
    details: Details | None,
) -> tuple[int, Place]:
    """The cells of a `span`, first and beyond the last, one by one: by their maps, or event by event."""
    x, v, region, events = place
    first, last = span
    for j in range(first, last):
        if details is None and last - first > 1:
            row = cells.maps[j, region + 1]
            certain, x1, v1, low, high = follow_row(row, cells.clock[j, WIDTH], x, v, region)
            if certain and holds(reach, low, high):
                apply_map(m, row)
                x, v = x1, v1
                continue
        t = 0.0
        while True:
            outcome, duration, x, v, fourth = next_segment(cells, j, t, x, v, region, series)
            if outcome == UNDECIDED:
                return EVENT_UNDECIDED, Place(x, v, region, events)
            segment = Segment(period, j, t, duration, region, outcome != INSIDE, x, v, fourth, series)
            apply_segment(m, cells, segment)
            widen(reach, cells, segment)
            see(details, cells, segment)
            if outcome == INSIDE:
                break
            t += duration
            region = region_after(region, x)
            events += 1
            if events > MAX_EVENTS_PER_PERIOD:
                return TOO_MANY_EVENTS, Place(x, v, region, events)
    return OK, Place(x, v, region, events)


@allocating_kernel
def walk_starts(
    first: int, last: int, cells: Cells, starts: Array, n_periods: int, ends: Array, status: Integers
) -> None:
    """`walk` from rows `first` to `last` of `starts` (n, 2), filling the same of `ends` (n, 2) and `status` (n,)."""
    series = np.empty(TERMS)
    for i in range(first, last):
        status[i], ends[i, 0], ends[i, 1] = inlined_walk(cells, starts[i, 0], starts[i, 1], n_periods, series)
