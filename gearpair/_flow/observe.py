"""What the march sees on its way: exact extremes, impacts and samples."""

import numpy as np

from ._kernel import allocating_kernel, inlined_kernel, kernel
from .cells import START, WIDTH
from .closed_form import DEGREE, TERMS, evaluate, fourth_derivative_bound
from .event_search import INSIDE, MONOTONE, UNDECIDED, least_step, next_turn
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
from .tangent import apply_map, apply_segment

# Columns of a row that `measure` fills; what belongs to a side comes twice, drive first.
IMPACTS, VELOCITY, VELOCITY_SUM, IMPULSE, SHARE, FORCE = 0, 2, 4, 6, 8, 10
MEAN, RMS, LOWEST, HIGHEST = 12, 13, 14, 15
N_MEASURES = 16

# Gauss and Legendre's rule, exact up to degree 31: the square of a segment's power series has degree 30.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(TERMS)


@kernel
def segment_extremes(series, end, x, slope, low, high):
    """Widen [low, high] to the range of the power series on [0, end], where it ends at `x` with `slope`.

    The certificates are those of `event_search`: within [low, high], monotone, or with a curvature of one sign and so
    of one turn at most. Where none holds, every root of the slope is looked for.
    """
    b0, b1, b2, b3 = series[0], series[0] + series[1] * end / 3.0, x - slope * end / 3.0, x
    fourth = fourth_derivative_bound(series, end)
    spread = fourth * end**4 / 384.0
    if min(min(b0, b1), min(b2, b3)) - spread >= low and max(max(b0, b1), max(b2, b3)) + spread <= high:
        return low, high
    low, high = min(low, min(b0, b3)), max(high, max(b0, b3))
    margin = MONOTONE * spread
    rise = min(b1 - b0, min(b2 - b1, b3 - b2))
    fall = min(b0 - b1, min(b1 - b2, b2 - b3))
    if max(rise, fall) > margin:
        return low, high
    _p, _dp, bend = evaluate(series, end)
    sag = fourth * end * end / 8.0  # between its ends the curvature is off its chord by at most this
    if min(2.0 * series[2], bend) > sag or max(2.0 * series[2], bend) < -sag:
        if series[1] * slope < 0.0:
            p = only_turn(series, end, slope)
            low, high = min(low, p), max(high, p)
        return low, high
    t = next_turn(series, 0.0, end)
    while t <= end:
        p, _dp, _ddp = evaluate(series, t)
        low, high = min(low, p), max(high, p)
        t = next_turn(series, t + least_step(series, end), end)
    return low, high


@kernel
def only_turn(series, end, slope):
    """The extremum inside [0, end] of a power series whose curvature keeps its sign and whose slope ends at `slope`."""
    before, after = 0.0, end
    t = end * series[1] / (series[1] - slope)
    p = series[0]
    for _ in range(60):
        p, dp, ddp = evaluate(series, t)
        step = dp / ddp
        if abs(step) <= 1e-6 * end:  # its cube is below rounding
            return p - 0.5 * step * dp
        if dp * slope > 0.0:
            after = t
        else:
            before = t
        t -= step
        if not before < t < after:
            t = 0.5 * (before + after)
    return p


@kernel
def extremes(cells, x, v, n_periods, series):
    """Range of X and events over `n_periods`: (status, x, v, x_min, x_max, contacts of each side)."""
    return widen(cells, x, v, n_periods, x, x, series)


@inlined_kernel
def widen(cells, x, v, n_periods, low, high, series, m=None):
    """`extremes` of a motion whose range so far is [low, high]: cells that stay within it need no search.

    Where `m` (2, 2) is given, it is multiplied by the monodromy matrix of the span.
    """
    region = first_region(cells, x, v)
    low, high = min(low, x), max(high, x)
    drive, coast = 0, 0
    for _ in range(n_periods):
        events = 0
        for j in range(cells.level.size):
            certain, x1, v1, hull_low, hull_high = follow_cell(cells, j, x, v, region)
            if certain and hull_low >= low and hull_high <= high:
                if m is not None:
                    apply_map(cells.maps[j, region + 1], m)
                x, v = x1, v1
                continue
            t = 0.0
            while True:
                outcome, duration, x, v = next_segment(cells, j, t, x, v, region, series)
                if outcome == UNDECIDED:
                    return EVENT_UNDECIDED, x, v, low, high, drive, coast
                if m is not None:
                    apply_segment(cells, j, region, duration, m)
                low, high = segment_extremes(series, duration, x, v * cells.clock[j, WIDTH], low, high)
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
                low, high = segment_extremes(series, duration, x, v * width, np.inf, -np.inf)
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
