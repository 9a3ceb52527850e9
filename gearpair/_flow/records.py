"""What a walk writes down, row by row: samples and crossings, whole segments, extrema of X.

A list has a counter that goes on when the rows are full: with no rows at all it tells how many are needed.
Where a list is not asked for it is None, and these kernels do nothing.
"""

from typing import NamedTuple

from ._kernel import Array, Integers, kernel
from .cells import START, WIDTH, Cells
from .closed_form import TERMS, evaluate
from .event_search import least_step, next_turn
from .segment import Segment, region_after

# Columns of a row of `Segments` before the coefficients of the power series.
STARTS, SPAN, REGION, REST, FOURTH, CROSSING = range(6)
SEGMENT_COLUMNS = 6 + TERMS


class Samples(NamedTuple):
    """X and X' at equal steps, and the crossings on the way."""

    per_period: int
    values: Array  # (n, 2)
    crossings: Array  # (m, 4): mesh periods since the start, side, velocity, 1 on contact or 0 on separation
    counts: Integers  # (2,): samples and crossings


class Segments(NamedTuple):
    """Every segment."""

    rows: Array  # (n, SEGMENT_COLUMNS)
    counts: Integers  # (1,)


class Extrema(NamedTuple):
    """The roots of X'."""

    rows: Array  # (n, 2): mesh periods since the start, X
    counts: Integers  # (3,): extrema, contacts made on the drive and on the coast side


@kernel
def sample(samples: Samples | None, cells: Cells, segment: Segment) -> None:
    """Take the samples that lie on a segment, and the crossing that it ends with."""
    if samples is None:
        return
    row, crossing = samples.counts
    j, period, per_period = segment.cell, segment.period, samples.per_period
    start, span = cells.clock[j, START], cells.clock[j, WIDTH] / cells.period
    while row < (period + 1) * per_period:
        at = ((row - period * per_period) / per_period - start) / span - segment.start
        if at >= segment.duration:
            break
        samples.values[row, 0], slope, _ = evaluate(segment.series, max(at, 0.0))
        samples.values[row, 1] = slope / cells.clock[j, WIDTH]
        row += 1
    if segment.left:
        if crossing < samples.crossings.shape[0]:
            samples.crossings[crossing, 0] = period + start + (segment.start + segment.duration) * span
            samples.crossings[crossing, 1] = segment.x
            samples.crossings[crossing, 2] = segment.v
            samples.crossings[crossing, 3] = segment.region == 0
        crossing += 1
    samples.counts[0], samples.counts[1] = row, crossing


@kernel
def list_segment(segments: Segments | None, cells: Cells, segment: Segment) -> None:
    """Append a segment."""
    if segments is None:
        return
    n, clock = segments.counts[0], cells.clock[segment.cell]
    segments.counts[0] += 1
    if n >= segments.rows.shape[0]:
        return
    row, span = segments.rows[n], clock[WIDTH] / cells.period
    row[STARTS], row[SPAN] = segment.period + clock[START] + segment.start * span, span
    row[REGION], row[REST] = segment.region, 1.0 - segment.start
    row[FOURTH], row[CROSSING] = segment.fourth, segment.duration if segment.left else -1.0
    for k in range(TERMS):
        row[CROSSING + 1 + k] = segment.series[k]


@kernel
def list_extrema(extrema: Extrema | None, cells: Cells, segment: Segment) -> None:
    """Append the extrema of a segment, and count the contact that it ends with."""
    if extrema is None:
        return
    series, end, clock = segment.series, segment.duration, cells.clock[segment.cell]
    span, n = clock[WIDTH] / cells.period, extrema.counts[0]
    t = next_turn(series, 0.0, end)
    while t <= end and n < extrema.rows.shape[0]:
        extrema.rows[n, 0] = segment.period + clock[START] + (segment.start + t) * span
        extrema.rows[n, 1], _slope, _curvature = evaluate(series, t)
        n += 1
        t = next_turn(series, t + least_step(series, end), end)
    extrema.counts[0] = n
    if segment.left:
        region = region_after(segment.region, segment.x)
        extrema.counts[1] += region == 1
        extrema.counts[2] += region == -1
