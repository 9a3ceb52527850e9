"""The march: one oscillator's motion over whole mesh periods, cell by cell, event by event."""

import numpy as np

from ._kernel import allocating_kernel, inlined_kernel, kernel
from .cells import COSINE, S0, SINE, SV, SX, V0, VV, VX, WIDTH, X0, XV, XX
from .closed_form import TERMS, add_shifted, evaluate, expand
from .event_search import INSIDE, UNDECIDED, first_exit, region_at

# Status of a march.
OK, ESCAPED, TOO_MANY_EVENTS, EVENT_UNDECIDED = 0, 1, 2, 3

MAX_EVENTS_PER_PERIOD = 10_000


@kernel
def first_region(cells, x, v):
    """The region that the motion enters from (x, v) at the start of a mesh period."""
    return region_at(x, v, cells.start_force - 2.0 * cells.damping_ratio * v, cells.start_rate)


@inlined_kernel
def start_segment(cells, j, t, x, v, region, series):
    """Fill `series` with the power series in the time since t of the motion in cell `j`; bounds its fourth derivative.

    Times are in widths of the cell.
    """
    level, width = cells.level[j], cells.clock[j, WIDTH]
    contact = abs(region)
    sine, cosine = cells.clock[j, SINE], cells.clock[j, COSINE]
    if t > 0.0:
        turn = t * width * cells.phase_per_period / cells.period
        c, s = np.cos(turn), np.sin(turn)
        sine, cosine = sine * c + cosine * s, cosine * c - sine * s
    forced_fourth, p, dp = 0.0, 0.0, 0.0
    if cells.forced.shape[0] > 0:
        if t > 0.0:
            # The response to the higher harmonics runs on from the cell's start; what is left is a state without them.
            p, dp, _ = evaluate(cells.forced[j, contact], t)
            x, v = x - p, v - dp / width
        forced_fourth = cells.forced_fourths[j, contact]
    expand(cells.bases[level, contact], region, x, v, cells.force, sine, cosine, series)
    if cells.forced.shape[0] > 0:
        series[0], series[1] = series[0] + p, series[1] + dp
        add_shifted(cells.forced[j, contact], t, series)
    fourths = cells.fourths[level, contact]
    fourth = fourths[0] * abs(x - region) + fourths[1] * abs(v)
    fourth += fourths[2] * abs(cells.force) + fourths[3] * abs(sine) + fourths[4] * abs(cosine)
    return fourth + forced_fourth


@inlined_kernel
def next_segment(cells, j, t, x, v, region, series):
    """Follow the motion in cell `j` from t to the first exit from `region` or the cell's end.

    Times are in widths of the cell. Fills `series` with the segment's power series in the time since t. Returns
    (outcome, duration, x, v), x exactly on the boundary after an exit.
    """
    width = cells.clock[j, WIDTH]
    fourth = start_segment(cells, j, t, x, v, region, series)
    end = 1.0 - t
    if t == 0.0:
        x1, v1 = map_cell(cells, j, x, v, region)
        slope1 = v1 * width
    else:
        x1, slope1, _ = evaluate(series, end)
        v1 = slope1 / width
    outcome, duration, boundary, slope = first_exit(series, region, end, x1, slope1, fourth)
    if outcome == INSIDE:
        return outcome, end, x1, v1
    return outcome, duration, boundary, slope / width


@kernel
def region_after(region, x):
    """The region beyond boundary `x`, left from `region`."""
    if region == 0:
        return 1 if x > 0.0 else -1
    return 0


@inlined_kernel
def cross_cell(cells, j, x, v, region, series):
    """The rest of cell `j` where a crossing may happen: (status, number of events, x, v, region)."""
    t = 0.0
    events = 0
    while True:
        outcome, duration, x, v = next_segment(cells, j, t, x, v, region, series)
        if outcome == INSIDE:
            return OK, events, x, v, region
        if outcome == UNDECIDED:
            return EVENT_UNDECIDED, events, x, v, region
        events += 1
        t += duration
        region = region_after(region, x)
        if events > MAX_EVENTS_PER_PERIOD:
            return TOO_MANY_EVENTS, events, x, v, region


@inlined_kernel
def cross_block(cells, b, x, v, region, series):
    """`cross_cell` for a block: its cells one by one, where there are several."""
    events = 0
    first, last = cells.blocks[b], cells.blocks[b + 1]
    for j in range(first, last):
        if last - first > 1:
            certain, x1, v1, _low, _high = follow_cell(cells, j, x, v, region)
            if certain:
                x, v = x1, v1
                continue
        status, n, x, v, region = cross_cell(cells, j, x, v, region, series)
        events += n
        if status != OK:
            return status, events, x, v, region
    return OK, events, x, v, region


@kernel
def map_cell(cells, j, x, v, region):
    """The state at the end of cell `j`, all of it spent in `region`."""
    row = cells.maps[j, region + 1]
    return row[XX] * x + (row[XV] * v + row[X0]), row[VX] * x + (row[VV] * v + row[V0])


@kernel
def follow_cell(cells, j, x, v, region):
    """The state at the end of cell `j` if the motion certainly stays in `region`: (certain, x, v, low, high).

    ``low`` and ``high`` bound X over the cell; the certificate is the first of `event_search`.
    """
    return follow(cells.maps[j, region + 1], cells.clock[j, WIDTH], x, v, region)


@kernel
def follow_block(cells, b, x, v, region):
    """`follow_cell` for a block."""
    return follow(cells.block_maps[b, region + 1], cells.block_width[b], x, v, region)


@kernel
def follow(row, width, x, v, region):
    """`follow_cell` by the map and spread in `row` over a time `width`."""
    x1, v1 = row[XX] * x + (row[XV] * v + row[X0]), row[VX] * x + (row[VV] * v + row[V0])
    third = width / 3.0
    b1, b2 = x + third * v, x1 - third * v1
    spread = row[SX] * abs(x - region) + (row[SV] * abs(v) + row[S0])
    low = min(min(x, b1), min(b2, x1)) - spread
    high = max(max(x, b1), max(b2, x1)) + spread
    certain = (region < 0 or low >= 2.0 * region - 1.0) and (region > 0 or high <= 2.0 * region + 1.0)
    return certain, x1, v1, low, high


@kernel
def march(cells, x, v, n_periods, series):
    """The state after `n_periods` mesh periods from (x, v) at the start of one: (status, x, v).

    Stops early, with the state reached, when the status is not OK.
    """
    region = first_region(cells, x, v)
    for _ in range(n_periods):
        events = 0
        for b in range(cells.block_width.size):
            certain, x1, v1, _low, _high = follow_block(cells, b, x, v, region)
            if certain:
                x, v = x1, v1
                continue
            status, n, x, v, region = cross_block(cells, b, x, v, region, series)
            events += n
            if status != OK:
                return status, x, v
            if events > MAX_EVENTS_PER_PERIOD:
                return TOO_MANY_EVENTS, x, v
        if not abs(x) + abs(v) <= cells.escape_radius:
            return ESCAPED, x, v
    return OK, x, v


@allocating_kernel
def march_starts(first, last, cells, starts, n_periods, ends, status):
    """`march` from rows `first` to `last` of `starts` (n, 2), filling the same of `ends` (n, 2) and `status` (n,)."""
    series = np.empty(TERMS)
    for i in range(first, last):
        status[i], ends[i, 0], ends[i, 1] = march(cells, starts[i, 0], starts[i, 1], n_periods, series)
