"""What the march sees on its way: exact extremes, impacts and samples."""

import numpy as np

from ._kernel import allocating_kernel, kernel
from .cells import START, WIDTH
from .closed_form import DEGREE, TERMS, evaluate, fourth_derivative_bound
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

# Columns of a row that `measure` fills; what belongs to a side comes twice, drive first.
IMPACTS, VELOCITY, VELOCITY_SUM, IMPULSE, SHARE, FORCE = 0, 2, 4, 6, 8, 10
MEAN, RMS, LOWEST, HIGHEST = 12, 13, 14, 15
N_MEASURES = 16

# Gauss and Legendre's rule, exact up to degree 31: the square of a segment's power series has degree 30.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(TERMS)


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
def segment_within(series, end, x, slope, low, high):
    """Whether the power series certainly stays within [low, high] on [0, end], where it is `x` with `slope`."""
    b1, b2 = series[0] + series[1] * end / 3.0, x - slope * end / 3.0
    if min(min(series[0], b1), min(b2, x)) < low or max(max(series[0], b1), max(b2, x)) > high:
        return False
    spread = fourth_derivative_bound(series, end) * end**4 / 384.0
    return min(min(series[0], b1), min(b2, x)) - spread >= low and max(max(series[0], b1), max(b2, x)) + spread <= high


@kernel
def extremes(cells, x, v, n_periods, series):
    """Range of X and events over `n_periods`: (status, x, v, x_min, x_max, contacts of each side)."""
    return widen(cells, x, v, n_periods, x, x, series)


@kernel
def widen(cells, x, v, n_periods, low, high, series):
    """`extremes` of a motion whose range so far is [low, high]: cells that stay within it need no search."""
    region = first_region(cells, x, v)
    low, high = min(low, x), max(high, x)
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
                if not segment_within(series, duration, x, v * cells.clock[j, WIDTH], low, high):
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


@allocating_kernel
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


@kernel
def measure(cells, x, v, n_periods, series, row):
    """Blows, forces and displacements over `n_periods`: the status. Fills `row` (N_MEASURES,).

    Per mesh period: impacts and impulse of each side; shares of the time in contact; the largest and the sum of the
    approach velocities and the largest mesh force of each side, all as moduli; mean of X, root mean square of X
    about it, smallest and largest X.
    """
    region = first_region(cells, x, v)
    origin = x  # moments are taken about the start, near the mean: the variance is a small difference
    first, second = 0.0, 0.0
    row[:] = 0.0
    row[LOWEST], row[HIGHEST] = x, x
    for _ in range(n_periods):
        events = 0
        for j in range(cells.level.size):
            width = cells.clock[j, WIDTH]
            t = 0.0
            while True:
                outcome, duration, x, v = next_segment(cells, j, t, x, v, region, series)
                if outcome == UNDECIDED:
                    return EVENT_UNDECIDED
                length, square = segment_moments(series, duration, origin)
                first += length * width
                second += square * width
                low, high = segment_extremes(series, duration, np.inf, -np.inf)
                row[LOWEST], row[HIGHEST] = min(row[LOWEST], low), max(row[HIGHEST], high)
                if region != 0:
                    side = 0 if region > 0 else 1
                    # The basis of contact carries k w^2; its level is that of the cell.
                    stiffness = -2.0 * cells.bases[cells.level[j], 1, 0, 2] / width**2
                    press = length + (origin - region) * duration
                    row[IMPULSE + side] += stiffness * abs(press) * width
                    row[SHARE + side] += duration * width
                    deepest = high - 1.0 if region > 0 else -1.0 - low
                    row[FORCE + side] = max(row[FORCE + side], stiffness * deepest)
                if outcome == INSIDE:
                    break
                t += duration
                region = region_after(region, x)
                if region != 0:
                    side = 0 if region > 0 else 1
                    row[IMPACTS + side] += 1.0
                    row[VELOCITY + side] = max(row[VELOCITY + side], abs(v))
                    row[VELOCITY_SUM + side] += abs(v)
                events += 1
                if events > MAX_EVENTS_PER_PERIOD:
                    return TOO_MANY_EVENTS
        if not abs(x) + abs(v) <= cells.escape_radius:
            return ESCAPED
    span = n_periods * cells.period
    for side in range(2):
        row[SHARE + side] /= span
        row[IMPULSE + side] /= n_periods
        row[IMPACTS + side] /= n_periods
        row[VELOCITY_SUM + side] /= n_periods
    row[MEAN] = origin + first / span
    row[RMS] = np.sqrt(max(second / span - (first / span) ** 2, 0.0))
    return OK


@kernel
def segment_moments(series, end, origin):
    """Integrals of p - origin and of its square over [0, end], exact but for rounding."""
    first, second = 0.0, 0.0
    for i in range(TERMS):
        t = 0.5 * end * (NODES[i] + 1.0)
        p = series[DEGREE]
        for n in range(DEGREE - 1, -1, -1):
            p = p * t + series[n]
        p -= origin
        first += WEIGHTS[i] * p
        second += WEIGHTS[i] * p * p
    return 0.5 * end * first, 0.5 * end * second
