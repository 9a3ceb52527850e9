"""What a continuation asks of one oscillator: the period map with its derivative, and a cycle with its extrema."""

import numpy as np

from ._kernel import allocating_kernel, kernel
from .cells import START, WIDTH, build_cells
from .closed_form import TERMS, evaluate
from .event_search import INSIDE, UNDECIDED, least_step, next_turn
from .march import EVENT_UNDECIDED, OK, first_region, march, next_segment, region_after
from .tangent import march_tangent, newton


@allocating_kernel
def map_at(p, x, v, period, m):
    """The `period`-fold map of oscillator `p` and its monodromy `m`: (status, x, v)."""
    return map_of(build_cells(p), x, v, period, m)


@allocating_kernel
def map_of(cells, x, v, period, m):
    """`map_at` of the cells of an oscillator."""
    m[0, 0], m[0, 1], m[1, 0], m[1, 1] = 1.0, 0.0, 0.0, 1.0
    return march_tangent(cells, x, v, period, m, np.empty(TERMS))


@allocating_kernel
def plain_map_at(p, x, v, period):
    """`map_at` without the monodromy."""
    return march(build_cells(p), x, v, period, np.empty(TERMS))


@allocating_kernel
def cycle_at(p, x, v, points, m, extrema):
    """The cycle of oscillator `p` through (x, v): (status, residual, n_extrema, drive contacts, coast contacts).

    Fills `points` (period, 2) with X and X' on the section, `m` (2, 2) with the monodromy, and the first n_extrema rows
    of `extrema` (n, 2) with (mesh periods since the start, X) where X' = 0.
    """
    cells, series, period = build_cells(p), np.empty(TERMS), points.shape[0]
    points[0, 0], points[0, 1] = x, v
    for i in range(1, period):
        _status, points[i, 0], points[i, 1] = march(cells, points[i - 1, 0], points[i - 1, 1], 1, series)
    status, x1, v1 = map_of(cells, x, v, period, m)
    searched, n, drive, coast = extrema_of(cells, x, v, period, extrema)
    return max(status, searched), max(abs(x1 - x), abs(v1 - v)), n, drive, coast


@allocating_kernel
def extrema_of(cells, x, v, period, extrema):
    """The extrema of X and the contacts begun over `period` mesh periods: (status, n_extrema, drive, coast)."""
    series = np.empty(TERMS)
    region = first_region(cells, x, v)
    n, drive, coast = 0, 0, 0
    for cycle in range(period):
        for j in range(cells.level.size):
            t = 0.0
            while True:
                outcome, duration, x, v = next_segment(cells, j, t, x, v, region, series)
                if outcome == UNDECIDED:
                    return EVENT_UNDECIDED, n, drive, coast
                n = segment_extrema(cells, j, cycle, t, series, duration, extrema, n)
                if outcome == INSIDE:
                    break
                t += duration
                region = region_after(region, x)
                drive += region == 1
                coast += region == -1
    return OK, n, drive, coast


@kernel
def segment_extrema(cells, j, cycle, start, series, end, extrema, n):
    """Append the extrema of a segment of cell `j` that starts at `start` and lasts `end` (widths)."""
    span = cells.clock[j, WIDTH] / cells.period
    t = next_turn(series, 0.0, end)
    while t <= end and n < extrema.shape[0]:
        extrema[n, 0] = cycle + cells.clock[j, START] + (start + t) * span
        extrema[n, 1], _slope, _curvature = evaluate(series, t)
        n += 1
        t = next_turn(series, t + least_step(series, end), end)
    return n


@allocating_kernel
def newton_starts(first, last, cells, starts, period, ends, found):
    """Newton's method from rows `first` to `last` of `starts` (n, 2), filling the same of `ends` and `found`."""
    m, series = np.empty((2, 2)), np.empty(TERMS)
    for i in range(first, last):
        found[i], ends[i, 0], ends[i, 1], _residual = newton(cells, starts[i, 0], starts[i, 1], period, m, series)
