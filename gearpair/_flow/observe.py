"""What the march sees on its way: exact extremes, impacts and samples."""

import numpy as np

from ._kernel import kernel
from .cells import START, WIDTH
from .closed_form import TERMS, evaluate
from .event_search import INSIDE, UNDECIDED, least_step, next_turn
from .march import (
    ESCAPED,
    EVENT_UNDECIDED,
    MAX_EVENTS_PER_PERIOD,
    OK,
    TOO_MANY_EVENTS,
    first_region,
    follow_cell,
    next_segment,
    region_after,
)


@kernel
def segment_extremes(series, end, low, high):
    """Widen [low, high] to the range of the power series on [0, end]: its ends and every root of its slope."""
    p, _dp, _ddp = evaluate(series, end)
    low, high = min(low, min(series[0], p)), max(high, max(series[0], p))
    t = next_turn(series, 0.0, end)
    while t <= end:
        p, _dp, _ddp = evaluate(series, t)
        low, high = min(low, p), max(high, p)
        t = next_turn(series, t + least_step(series, end), end)
    return low, high


@kernel
def extremes(cells, x, v, n_periods, series):
    """Range of X and events over `n_periods`: (status, x, v, x_min, x_max, contacts of each side)."""
    region = first_region(cells, x, v)
    low, high = x, x
    drive, coast = 0, 0
    for _ in range(n_periods):
        events = 0
        for j in range(cells.level.size):
            certain, x1, v1, hull_low, hull_high = follow_cell(cells, j, x, v, region)
            if certain and hull_low >= low and hull_high <= high:
                x, v = x1, v1
                continue
            t = 0.0
            while True:
                outcome, duration, x, v = next_segment(cells, j, t, x, v, region, series)
                if outcome == UNDECIDED:
                    return EVENT_UNDECIDED, x, v, low, high, drive, coast
                low, high = segment_extremes(series, duration, low, high)
                if outcome == INSIDE:
                    break
                t += duration
                region = region_after(region, x)
                drive += region == 1
                coast += region == -1
                events += 1
                if events > MAX_EVENTS_PER_PERIOD:
                    return TOO_MANY_EVENTS, x, v, low, high, drive, coast
        if not abs(x) + abs(v) <= cells.escape_radius:
            return ESCAPED, x, v, low, high, drive, coast
    return OK, x, v, low, high, drive, coast


@kernel
def record(cells, x, v, n_periods, samples_per_period, samples, impacts):
    """Sample the motion and list its crossings: (status, periods done, crossings).

    Fills ``samples`` (n_periods * samples_per_period + 1, 2) with X and X' at equal steps from the
    start, end included, and ``impacts`` with (mesh periods since the start, side, velocity, 1 on contact
    or 0 on separation), as many rows as it has; call once with none to learn how many there are.
    """
    series = np.empty(TERMS)
    region = first_region(cells, x, v)
    crossings = 0
    row = 0
    for period in range(n_periods):
        events = 0
        for j in range(cells.level.size):
            start, span = cells.clock[j, START], cells.clock[j, WIDTH] / cells.period
            t = 0.0
            while True:
                outcome, duration, x, v = next_segment(cells, j, t, x, v, region, series)
                if outcome == UNDECIDED:
                    return EVENT_UNDECIDED, period, crossings
                while row < (period + 1) * samples_per_period:
                    at = ((row - period * samples_per_period) / samples_per_period - start) / span - t
                    if at >= duration:
                        break
                    samples[row, 0], slope, _ = evaluate(series, max(at, 0.0))
                    samples[row, 1] = slope / cells.clock[j, WIDTH]
                    row += 1
                if outcome == INSIDE:
                    break
                t += duration
                contact = region == 0
                region = region_after(region, x)
                if crossings < impacts.shape[0]:
                    impacts[crossings, 0] = period + start + t * span
                    impacts[crossings, 1] = x
                    impacts[crossings, 2] = v
                    impacts[crossings, 3] = contact
                crossings += 1
                events += 1
                if events > MAX_EVENTS_PER_PERIOD:
                    return TOO_MANY_EVENTS, period, crossings
        if not abs(x) + abs(v) <= cells.escape_radius:
            return ESCAPED, period + 1, crossings
    samples[row, 0], samples[row, 1] = x, v
    return OK, n_periods, crossings
