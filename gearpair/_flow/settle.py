"""The settled motion from one start, and batches of it: many oscillators, many starts."""

from typing import NamedTuple

import numpy as np

from ._kernel import kernel
from .cells import Parameters, build_cells
from .closed_form import TERMS
from .march import ESCAPED, OK, march
from .observe import extremes
from .tangent import exponents, march_tangent, newton

PERIODIC, APERIODIC, UNSETTLED, GONE, CAPPED, NOT_RUN = 0, 1, 2, 3, 4, 5

# A return this close, relative to max(1, |X|, |X'|), is worth a Newton search; the stable orbit it
# finds must lie within CAPTURED of the motion.
RETURNED, CAPTURED = 1e-8, 1e-6
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
    final: np.ndarray  # (n, 2) the last section point marched to


@kernel
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
def find_return(cells, x, v, max_period, closeness, capture, m, series):
    """March until the motion returns to a stable orbit's neighbourhood: (status, period, x, v, x*, v*).

    The period is 0 where it did not within `max_period` periods; (x*, v*) is then meaningless.
    """
    x0, v0 = x, v
    for period in range(1, max_period + 1):
        status, x, v = march(cells, x, v, 1, series)
        if status != OK:
            return status, 0, x, v, x, v
        if distance(x, v, x0, v0) <= closeness:
            converged, xs, vs, _residual = newton(cells, x, v, period, m, series)
            if converged and spectral_radius(m) < STABLE and distance(x, v, xs, vs) <= capture:
                return OK, minimal_period(cells, xs, vs, period, m, series), x, v, xs, vs
    return OK, 0, x, v, x, v


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
    """`find_return` for slow motions: the stable orbit must come nearer over twenty of its cycles."""
    status, period, x, v, xs, vs = find_return(cells, x, v, max_period, NEAR, NEAR, m, series)
    if period > 0:
        before = distance(x, v, xs, vs)
        status, x, v = march(cells, x, v, 20 * period, series)
        if status != OK or distance(x, v, xs, vs) > max(before, RETURNED):
            period = 0
    return status, period, x, v, xs, vs


@kernel
def settle(cells, x, v, n_transient, max_period, n_exponent, out, i, series):
    """Follow one motion until it is settled and fill row `i` of `out`."""
    m = np.empty((2, 2))
    out.period[i] = 0
    done = 0
    period = 0
    status = OK
    xs, vs = x, v
    while done < n_transient and period == 0 and status == OK:
        status, period, x, v, xs, vs = find_return(cells, x, v, max_period, RETURNED, CAPTURED, m, series)
        done += max_period
    if period == 0 and status == OK:
        status, period, x, v, xs, vs = approached(cells, x, v, max_period, m, series)
    if period == 0 and status == OK:
        status, x, v, largest, smallest, error = exponents(cells, x, v, n_exponent, EXPONENT_BLOCKS, series)
        out.exponents[i, 0], out.exponents[i, 1], out.exponents[i, 2] = largest, smallest, error
        if status == OK and largest > RESOLVED * error:
            out.status[i] = APERIODIC
        elif status == OK:
            out.status[i] = UNSETTLED
            status, period, x, v, xs, vs = approached(cells, x, v, max_period, m, series)
    out.final[i, 0], out.final[i, 1] = x, v
    if status != OK:
        out.status[i] = GONE if status == ESCAPED else CAPPED
        return
    if period > 0:
        out.status[i] = PERIODIC
        out.period[i] = period
        for k in range(4):
            out.monodromy[i, k // 2, k % 2] = m[k // 2, k % 2]
        xs, vs = smallest_point(cells, xs, vs, period, series)
        x, v = xs, vs
        span = period * cells.period
        out.exponents[i, 0] = np.log(spectral_radius(m)) / span
        out.exponents[i, 1] = -2.0 * cells.damping_ratio - out.exponents[i, 0]
        out.exponents[i, 2] = 0.0
    for k in range(out.points.shape[1]):
        if period > 0 and k % period == 0:
            x, v = xs, vs
        out.points[i, k, 0], out.points[i, k, 1] = x, v
        status, x, v = march(cells, x, v, 1, series)
    n = period if period > 0 else n_exponent
    x, v = out.points[i, 0, 0], out.points[i, 0, 1]
    status, x, v, low, high, _drive, _coast = extremes(cells, x, v, n, series)
    out.extremes[i, 0], out.extremes[i, 1] = low, high


@kernel
def smallest_point(cells, x, v, period, series):
    """The point of a cycle with the smallest X on the section."""
    xs, vs = x, v
    for _ in range(period - 1):
        _status, x, v = march(cells, x, v, 1, series)
        if x < xs:
            xs, vs = x, v
    return xs, vs


@kernel
def settle_rows(first, last, lanes, chain, max_period, n_exponent, out):
    """`settle` for lanes `first` to `last`, which form chains of `chain` lanes each (1: every lane for itself).

    In a chain each lane but the first starts where the one before it ended, if that motion stayed bounded.
    """
    series = np.empty(TERMS)
    for i in range(first, last):
        x, v = lanes.starts[i, 0], lanes.starts[i, 1]
        if i % chain != 0 and out.status[i - 1] < GONE:
            x, v = out.final[i - 1, 0], out.final[i - 1, 1]
        cells = build_cells(parameters_of(lanes, i))
        settle(cells, x, v, lanes.n_transient[i], max_period, n_exponent, out, i, series)
