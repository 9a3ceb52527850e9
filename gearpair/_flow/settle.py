"""The settled motion from one start, and batches of it: many oscillators, many starts.

A motion is followed until it is *captured*: in a neighbourhood of a stable cycle that no motion leaves (see `capture`).
The cycles are those known beforehand, and the one that the motion itself was last seen to return near.
"""

from typing import NamedTuple

import numpy as np

from ._kernel import allocating_kernel, kernel
from .capture import COLUMNS, OWNER, V, X, inside, surround
from .cells import Parameters, build_cells
from .closed_form import TERMS
from .exponents import exponents
from .march import ESCAPED, OK, march
from .observe import extremes, measure, widen
from .tangent import NEWTON_STEPS, march_tangent, newton

PERIODIC, APERIODIC, UNSETTLED, GONE, CAPPED, NOT_RUN, EXHAUSTED = 0, 1, 2, 3, 4, 5, 6

# A return as close as PROMISING, relative to max(1, |X|, |X'|), is worth a Newton search for a stable orbit whose
# neighbourhood may capture the motion: a short one, for most are in vain, and then the next return must be LESS as far.
PROMISING, LESS, FEW_STEPS = 1e-2, 0.1, 7
# The trace of a stable orbit is below 2 in modulus; a search is given up where it exceeds this.
MOST_TRACE = 10.0
# Where no neighbourhood can be certified, a return within RETURNED counts if the stable orbit lies within CAPTURED.
RETURNED, CAPTURED = 1e-8, 1e-6
# Periods after which a motion is first compared with where it was; the span doubles up to the longest period.
FIRST_SPAN = 4
# Multipliers nearer to the unit circle than this attract nothing in any time; without damping they lie on it.
STABLE = 1.0 - 1e-9
# After the whole transient slower motions count too: a stable orbit within NEAR that the motion approaches.
NEAR = 1e-2
# Section points of one cycle closer than this are one point: its period is shorter than it returned with.
SAME_POINT = 1e-9
# An exponent is resolved when it exceeds this many standard errors.
RESOLVED = 4.0
EXPONENT_BLOCKS = 20


class Lanes(NamedTuple):
    """A batch of oscillators and starts, one lane each."""

    scalars: np.ndarray  # (n, 5): mean force, error amplitude, error phase, damping ratio, mesh frequency
    edges: np.ndarray  # (n, n_levels + 1)
    levels: np.ndarray  # (n, n_levels)
    harmonics: np.ndarray  # (n, n_harmonics, 3)
    starts: np.ndarray  # (n, 2)
    n_transient: np.ndarray  # (n,)


class Settled(NamedTuple):
    """What became of each lane; the arrays have one row a lane, filled with nan beforehand."""

    status: np.ndarray  # (n,) PERIODIC ... NOT_RUN
    period: np.ndarray  # (n,) 0 unless PERIODIC
    points: np.ndarray  # (n, n_samples, 2) successive section points; a cycle starts at its smallest X
    monodromy: np.ndarray  # (n, 2, 2) nan unless PERIODIC
    extremes: np.ndarray  # (n, 2)
    exponents: np.ndarray  # (n, 3): largest, smallest, standard error
    final: np.ndarray  # (n, 2) the last section point marched to; of a periodic motion, that of its orbit
    attractor: np.ndarray  # (n,) row of the known attractor that captured the motion, or -1
    way: np.ndarray  # (n, 4) until captured or judged: mesh periods, impacts, smallest and largest X
    measures: np.ndarray  # (n, N_MEASURES), or (n, 0) where they are not asked for


class Known(NamedTuple):
    """Attractors known beforehand."""

    settled: Settled  # one row an attractor
    neighbourhoods: np.ndarray  # (m, COLUMNS), OWNER the attractor's row


@allocating_kernel
def parameters_of(lanes, i):
    """The oscillator of lane `i`."""
    s = lanes.scalars[i]
    return Parameters(s[0], s[1], s[2], s[3], s[4], lanes.edges[i], lanes.levels[i], lanes.harmonics[i])


@kernel
def spectral_radius(m):
    """The larger modulus of the eigenvalues of a 2 x 2 matrix."""
    half = 0.5 * (m[0, 0] + m[1, 1])
    determinant = m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
    square = half * half - determinant
    if square < 0.0:
        return np.sqrt(determinant)
    return abs(half) + np.sqrt(square)


@kernel
def distance(x, v, x0, v0):
    """How far two states lie apart, relative to max(1, |X|, |X'|)."""
    return max(abs(x - x0), abs(v - v0)) / max(1.0, max(abs(x0), abs(v0)))


@kernel
def stable_orbit(cells, x, v, period, steps, most_trace, m, series):
    """The stable orbit that Newton's method finds from (x, v): (minimal period or 0, x*, v*); `m` its monodromy."""
    converged, xs, vs, _residual = newton(cells, x, v, period, m, series, steps, most_trace)
    if converged and spectral_radius(m) < STABLE:
        return minimal_period(cells, xs, vs, period, m, series), xs, vs
    return 0, xs, vs


@kernel
def beside(neighbourhoods, n, x, v):
    """Whether (x, v) is near the centre of one of the first `n` neighbourhoods: that it returns there is no news."""
    nearest = np.inf
    for i in range(n):
        nearest = min(nearest, distance(x, v, neighbourhoods[i, X], neighbourhoods[i, V]))
    return nearest <= PROMISING


@kernel
def follow(cells, x, v, n_transient, max_period, n_known, neighbourhoods, way, m, series):
    """Follow a motion until it is captured: (status, owner, period, x, v, x*, v*).

    The `owner` is the row of the known attractor that captured it, or -1; the period, if not 0, is that of an orbit
    of its own through (x*, v*), with monodromy `m`. (x, v) is the captured motion's limit, or the last point reached.
    Rows of `neighbourhoods` from `n_known` on are scratch. Fills `way` (4,).
    """
    low, high = x, x
    done, impacts, n, period = 0, 0, n_known, 0
    xs, vs = x, v
    closeness, span, within = PROMISING, FIRST_SPAN, 0
    x0, v0 = x, v
    status = OK
    held = inside(neighbourhoods, n, x, v)
    while held < 0 and done < n_transient:
        status, x, v, low, high, drive, coast = widen(cells, x, v, 1, low, high, series)
        if status != OK:
            break
        done += 1
        impacts += drive + coast
        within += 1
        held = inside(neighbourhoods, n, x, v)
        gap = distance(x, v, x0, v0)
        if held < 0 and gap <= closeness and (gap <= RETURNED or not beside(neighbourhoods, n, x, v)):
            steps, most_trace = (NEWTON_STEPS, np.inf) if gap <= RETURNED else (FEW_STEPS, MOST_TRACE)
            found, xo, vo = stable_orbit(cells, x, v, within, steps, most_trace, m, series)
            if found > 0 and inside(neighbourhoods, n_known, xo, vo) < 0:
                new = inside(neighbourhoods, n, xo, vo) < 0 and (period == 0 or distance(xo, vo, xs, vs) > SAME_POINT)
                period, xs, vs = found, xo, vo
                if new:
                    n = n_known
                    if surround(cells, xs, vs, period, -1.0, neighbourhoods[n_known:], series):
                        n += period
                    held = inside(neighbourhoods, n, x, v)
                if held < 0 and gap <= RETURNED and distance(x, v, xs, vs) <= CAPTURED:
                    way[0], way[1], way[2], way[3] = done, impacts, low, high
                    return OK, -1, period, xs, vs, xs, vs
            closeness = max(RETURNED, LESS * closeness)
        if within >= min(span, max_period):
            x0, v0, within, span = x, v, 0, 2 * span
    way[0], way[1], way[2], way[3] = done, impacts, low, high
    if held < 0:
        return status, -1, 0, x, v, x, v
    x, v = neighbourhoods[held, X], neighbourhoods[held, V]
    if held < n_known:
        return OK, int(neighbourhoods[held, OWNER]), 0, x, v, x, v
    m[0, 0], m[0, 1], m[1, 0], m[1, 1] = 1.0, 0.0, 0.0, 1.0
    march_tangent(cells, xs, vs, period, m, series)
    return OK, -1, period, x, v, xs, vs


@kernel
def minimal_period(cells, xs, vs, period, m, series):
    """The shortest period of the cycle through (xs, vs); `m` becomes its monodromy."""
    x, v = xs, vs
    for shorter in range(1, period):
        _status, x, v = march(cells, x, v, 1, series)
        if period % shorter == 0 and distance(x, v, xs, vs) <= SAME_POINT:
            m[0, 0], m[0, 1], m[1, 0], m[1, 1] = 1.0, 0.0, 0.0, 1.0
            march_tangent(cells, xs, vs, shorter, m, series)
            return shorter
    return period


@kernel
def approached(cells, x, v, max_period, m, series):
    """March until the motion returns to a stable orbit that it slowly approaches: (status, period, x, v, x*, v*).

    The orbit lies within `NEAR`, and comes nearer over twenty of its cycles. The period is 0 where there is none within
    `max_period` periods; (x*, v*) is then meaningless.
    """
    x0, v0 = x, v
    for within in range(1, max_period + 1):
        status, x, v = march(cells, x, v, 1, series)
        if status != OK:
            return status, 0, x, v, x, v
        if distance(x, v, x0, v0) > NEAR:
            continue
        period, xs, vs = stable_orbit(cells, x, v, within, NEWTON_STEPS, MOST_TRACE, m, series)
        before = distance(x, v, xs, vs)
        if period > 0 and before <= NEAR:
            status, x, v = march(cells, x, v, 20 * period, series)
            if status != OK or distance(x, v, xs, vs) > max(before, RETURNED):
                period = 0
            return status, period, x, v, xs, vs
    return OK, 0, x, v, x, v


@allocating_kernel
def settle(cells, x, v, n_transient, max_period, n_exponent, most, known, neighbourhoods, out, i, series):
    """Follow one motion until it is settled and fill row `i` of `out`.

    Where more than `most` mesh periods would be needed, the motion is followed for as many and not judged.
    `neighbourhoods` are the known ones and room for `max_period` more.
    """
    m = np.empty((2, 2))
    out.period[i] = 0
    n_known = len(known.neighbourhoods)
    enough = n_transient + n_exponent <= most
    status, owner, period, x, v, xs, vs = follow(
        cells, x, v, min(n_transient, most), max_period, n_known, neighbourhoods, out.way[i], m, series
    )
    out.attractor[i] = owner
    out.final[i, 0], out.final[i, 1] = x, v
    if owner >= 0:
        copy_row(known.settled, owner, out, i)
        return
    if period == 0 and status == OK:
        if not enough:
            out.status[i] = EXHAUSTED
            return
        status, period, x, v, xs, vs = judge(cells, x, v, max_period, n_exponent, out, i, m, series)
    if status != OK:
        out.status[i] = GONE if status == ESCAPED else CAPPED
        out.points[i], out.extremes[i] = np.nan, np.nan
        return
    if period > 0:
        out.status[i] = PERIODIC
        out.period[i] = period
        for k in range(4):
            out.monodromy[i, k // 2, k % 2] = m[k // 2, k % 2]
        xs, vs = smallest_point(cells, xs, vs, period, series)
        span = period * cells.period
        out.exponents[i, 0] = np.log(spectral_radius(m)) / span
        out.exponents[i, 1] = -2.0 * cells.damping_ratio - out.exponents[i, 0]
        out.exponents[i, 2] = 0.0
        _status, _x, _v, low, high, _drive, _coast = extremes(cells, xs, vs, period, series)
        out.extremes[i, 0], out.extremes[i, 1] = low, high
    else:
        xs, vs = out.points[i, 0, 0], out.points[i, 0, 1]
    x, v = xs, vs
    for k in range(out.points.shape[1]):
        if period > 0 and k % period == 0:
            x, v = xs, vs
        out.points[i, k, 0], out.points[i, k, 1] = x, v
        _status, x, v = march(cells, x, v, 1, series)
    if out.measures.shape[1] > 0:
        measure(cells, xs, vs, period if period > 0 else n_exponent, series, out.measures[i])


@kernel
def judge(cells, x, v, max_period, n_exponent, out, i, m, series):
    """What a motion is that was not captured: (status, period, x, v, x*, v*), as of `approached`.

    Of one that does not return, row `i` of `out` gets the exponents and extremes over `n_exponent` periods, and where
    these began.
    """
    status, period, x, v, xs, vs = approached(cells, x, v, max_period, m, series)
    if period == 0 and status == OK:
        out.points[i, 0, 0], out.points[i, 0, 1] = x, v
        status, x, v, largest, smallest, error, low, high = exponents(cells, x, v, n_exponent, EXPONENT_BLOCKS, series)
        out.exponents[i, 0], out.exponents[i, 1], out.exponents[i, 2] = largest, smallest, error
        out.extremes[i, 0], out.extremes[i, 1] = low, high
        if status == OK and largest > RESOLVED * error:
            out.status[i] = APERIODIC
        elif status == OK:
            out.status[i] = UNSETTLED
            status, period, x, v, xs, vs = approached(cells, x, v, max_period, m, series)
    out.final[i, 0], out.final[i, 1] = x, v
    return status, period, x, v, xs, vs


@allocating_kernel
def copy_row(known, k, out, i):
    """What is known of attractor `k`, into row `i` of `out`."""
    out.status[i], out.period[i] = known.status[k], known.period[k]
    out.points[i], out.monodromy[i] = known.points[k], known.monodromy[k]
    out.extremes[i], out.exponents[i] = known.extremes[k], known.exponents[k]
    if out.measures.shape[1] > 0:
        out.measures[i] = known.measures[k]


@kernel
def smallest_point(cells, x, v, period, series):
    """The point of a cycle with the smallest X on the section; of points with the same X that with the smaller X'."""
    xs, vs = x, v
    for _ in range(period - 1):
        _status, x, v = march(cells, x, v, 1, series)
        if x < xs - SAME_POINT or (x <= xs + SAME_POINT and v < vs):
            xs, vs = x, v
    return xs, vs


@allocating_kernel
def scratch(known, max_period):
    """The known neighbourhoods, with room for those of one more cycle."""
    n = len(known.neighbourhoods)
    neighbourhoods = np.empty((n + max_period, COLUMNS))
    neighbourhoods[:n] = known.neighbourhoods
    return neighbourhoods


@allocating_kernel
def settle_rows(first, last, lanes, chain, max_period, n_exponent, most, known, out):
    """`settle` for lanes `first` to `last`, which form chains of `chain` lanes each (1: every lane for itself).

    In a chain each lane but the first starts where the one before it ended, if that motion stayed bounded.
    """
    series = np.empty(TERMS)
    neighbourhoods = scratch(known, max_period)
    for i in range(first, last):
        x, v = lanes.starts[i, 0], lanes.starts[i, 1]
        if i % chain != 0 and out.status[i - 1] < GONE:
            x, v = out.final[i - 1, 0], out.final[i - 1, 1]
        cells = build_cells(parameters_of(lanes, i))
        settle(cells, x, v, lanes.n_transient[i], max_period, n_exponent, most, known, neighbourhoods, out, i, series)


@allocating_kernel
def settle_starts(first, last, cells, starts, n_transient, max_period, n_exponent, most, known, out):
    """`settle` from rows `first` to `last` of `starts` (n, 2), all of one oscillator."""
    series = np.empty(TERMS)
    neighbourhoods = scratch(known, max_period)
    for i in range(first, last):
        x, v = starts[i, 0], starts[i, 1]
        settle(cells, x, v, n_transient, max_period, n_exponent, most, known, neighbourhoods, out, i, series)


@allocating_kernel
def surround_rows(cells, points, periods, rows):
    """Neighbourhoods of the cycles through `points` (n, 2), filled into `rows`: how many there are."""
    series = np.empty(TERMS)
    filled = 0
    for i in range(len(points)):
        if periods[i] > 0 and surround(cells, points[i, 0], points[i, 1], periods[i], i, rows[filled:], series):
            filled += periods[i]
    return filled
