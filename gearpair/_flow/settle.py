"""The machine that settles: what a motion becomes, for one start or for many.

| state | what leads on | to |
|---|---|---|
| on its way | it enters a neighbourhood of an attractor known beforehand | captured |
| on its way | it returns near itself | attempt |
| attempt | a stable orbit is found whose neighbourhood holds the motion, or to which it has returned | captured |
| attempt | anything else | on its way; the next return must be closer |
| on its way | the transient has passed | judged, or exhausted where the work left is too little |
| judged | it slowly approaches a stable orbit | captured |
| judged | its exponent is positive, well outside its error | aperiodic |
| judged | anything else, also after that time | unsettled |
| any | the walk ends early | escaped, or capped |

A captured motion is periodic: its limit is described, or copied where it is known. The neighbourhoods, which no motion
leaves, are those of `capture`: of the cycles known beforehand, and of the one that the motion was last seen to
return near.
"""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, Integers, allocating_kernel, kernel
from .capture import COLUMNS, OWNER, V, X, inside, surround
from .cells import Cells, Coefficients, build_cells
from .closed_form import TERMS
from .newton import NEWTON_STEPS, SAME_POINT, derivative, distance, minimal_period, newton
from .observe import exponents, measure
from .reach import COAST, DRIVE, HIGHEST, LOWEST, begin_reach
from .walk import ESCAPED, OK, inlined_walk, walk

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
# An exponent is resolved when it exceeds this many standard errors.
RESOLVED = 4.0
EXPONENT_BLOCKS = 20


class Limits(NamedTuple):
    """How far to look."""

    max_period: int  # the longest period looked for
    n_exponent: int  # mesh periods over which exponents are measured
    most: int  # mesh periods of one motion at most; one that would need more is followed for as many and not judged


class Lanes(NamedTuple):
    """A batch of motions, one lane each, of some oscillators."""

    scalars: Array  # (m, 5): mean force, error amplitude, error phase, damping ratio, mesh frequency
    edges: Array  # (m, n_levels + 1)
    levels: Array  # (m, n_levels)
    harmonics: Array  # (m, n_harmonics, 3)
    own: Integers  # (n,) row of the lane's oscillator
    starts: Array  # (n, 2)
    n_transient: Integers  # (n,)


class Settled(NamedTuple):
    """What became of each lane; the arrays have one row a lane, filled beforehand with what stands for "not run"."""

    status: Integers  # (n,) PERIODIC ... NOT_RUN
    period: Integers  # (n,) 0 unless PERIODIC
    points: Array  # (n, n_samples, 2) successive section points; a cycle starts at its smallest X
    monodromy: Array  # (n, 2, 2) nan unless PERIODIC
    extremes: Array  # (n, 2)
    exponents: Array  # (n, 3): largest, smallest, standard error
    final: Array  # (n, 2) the last section point walked to; of a periodic motion, that of its orbit
    attractor: Integers  # (n,) row of the known attractor that captured the motion, or -1
    way: Array  # (n, 4) until captured or judged: mesh periods, impacts, smallest and largest X
    measures: Array  # (n, N_MEASURES), or (n, 0) where they are not asked for


class Known(NamedTuple):
    """Attractors known beforehand."""

    settled: Settled  # one row an attractor
    neighbourhoods: Array  # (m, COLUMNS), OWNER the attractor's row


class Scratch(NamedTuple):
    """What a thread works with."""

    known: Known
    neighbourhoods: Array  # the known ones first, then room for those of one more cycle
    m: Array  # (2, 2)
    reach: Array  # (4,)
    series: Array  # (TERMS,)


class Orbit(NamedTuple):
    """A stable orbit."""

    period: int  # 0: there is none
    x: float
    v: float
    n_neighbourhoods: int  # certified for it, among the scratch


class Course(NamedTuple):
    """Where a motion has been followed to."""

    status: int  # of the walk
    x: float  # the last point reached; of a captured motion, its limit
    v: float
    owner: int  # row of the known attractor that captured it, or -1
    orbit: Orbit  # that captured it, where it is not known


@allocating_kernel
def coefficients_of(lanes: Lanes, i: int) -> Coefficients:
    """Oscillator `i` of a batch."""
    s = lanes.scalars[i]
    return Coefficients(s[0], s[1], s[2], s[3], s[4], lanes.edges[i], lanes.levels[i], lanes.harmonics[i])


@allocating_kernel
def make_scratch(known: Known, max_period: int) -> Scratch:
    """Scratch for motions of periods up to `max_period`."""
    n = len(known.neighbourhoods)
    neighbourhoods = np.empty((n + max_period, COLUMNS))
    neighbourhoods[:n] = known.neighbourhoods
    return Scratch(known, neighbourhoods, np.empty((2, 2)), np.empty(4), np.empty(TERMS))


@kernel
def spectral_radius(m: Array) -> float:
    """The larger modulus of the eigenvalues of a 2 x 2 matrix."""
    half = 0.5 * (m[0, 0] + m[1, 1])
    determinant = m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
    square = half * half - determinant
    if square < 0.0:
        return np.sqrt(determinant)
    return abs(half) + np.sqrt(square)


@kernel
def stable_orbit(cells: Cells, x: float, v: float, period: int, steps: int, most_trace: float, work: Scratch) -> Orbit:
    """The stable orbit that Newton's method finds from (x, v)."""
    converged, xs, vs, _residual = newton(cells, x, v, period, work.m, work.series, steps, most_trace)
    if converged and spectral_radius(work.m) < STABLE:
        return Orbit(minimal_period(cells, xs, vs, period, work.series), xs, vs, 0)
    return Orbit(0, xs, vs, 0)


@kernel
def beside(neighbourhoods: Array, n: int, x: float, v: float) -> bool:
    """Whether (x, v) is near the centre of one of the first `n` neighbourhoods: that it returns there is no news."""
    nearest = np.inf
    for i in range(n):
        nearest = min(nearest, distance(x, v, neighbourhoods[i, X], neighbourhoods[i, V]))
    return nearest <= PROMISING


@kernel
def attempt(
    cells: Cells, x: float, v: float, within: int, gap: float, orbit: Orbit, work: Scratch
) -> tuple[bool, Orbit]:
    """A search for the orbit of a motion that returned to within `gap` after `within` periods: (found, orbit).

    Not found, or one of a known attractor: the `orbit` of the last search stays. One that is new is surrounded.
    """
    rows, n_known = work.neighbourhoods, len(work.known.neighbourhoods)
    steps, most_trace = (NEWTON_STEPS, np.inf) if gap <= RETURNED else (FEW_STEPS, MOST_TRACE)
    found = stable_orbit(cells, x, v, within, steps, most_trace, work)
    if found.period == 0 or inside(rows, n_known, found.x, found.v) >= 0:
        return False, orbit
    n = orbit.n_neighbourhoods
    same = orbit.period > 0 and distance(found.x, found.v, orbit.x, orbit.v) <= SAME_POINT
    if not same and inside(rows, n_known + n, found.x, found.v) < 0:
        certain = surround(cells, found.x, found.v, found.period, -1.0, rows[n_known:], work.series)
        n = found.period if certain else 0
    return True, Orbit(found.period, found.x, found.v, n)


@kernel
def follow(cells: Cells, x: float, v: float, n_transient: int, max_period: int, way: Array, work: Scratch) -> Course:
    """Follow a motion until it is captured, `n_transient` periods at most. Fills `way` (4,)."""
    rows, n_known = work.neighbourhoods, len(work.known.neighbourhoods)
    orbit = Orbit(0, x, v, 0)
    begin_reach(work.reach, x)
    done, within, span, closeness = 0, 0, FIRST_SPAN, PROMISING
    x0, v0 = x, v
    status, returned = OK, False
    held = inside(rows, n_known, x, v)
    while held < 0 and done < n_transient and not returned:
        status, x, v = inlined_walk(cells, x, v, 1, work.series, None, work.reach)
        if status != OK:
            break
        done += 1
        within += 1
        n = n_known + orbit.n_neighbourhoods
        held = inside(rows, n, x, v)
        gap = distance(x, v, x0, v0)
        if held < 0 and gap <= closeness and (gap <= RETURNED or not beside(rows, n, x, v)):
            found, orbit = attempt(cells, x, v, within, gap, orbit, work)
            held = inside(rows, n_known + orbit.n_neighbourhoods, x, v)
            returned = found and gap <= RETURNED and distance(x, v, orbit.x, orbit.v) <= CAPTURED
            closeness = max(RETURNED, LESS * closeness)
        if within >= min(span, max_period):
            x0, v0, within, span = x, v, 0, 2 * span
    way[0], way[1] = done, work.reach[DRIVE] + work.reach[COAST]
    way[2], way[3] = work.reach[LOWEST], work.reach[HIGHEST]
    if held >= 0:
        owner = int(rows[held, OWNER]) if held < n_known else -1
        return Course(OK, rows[held, X], rows[held, V], owner, orbit)
    if returned:
        return Course(OK, orbit.x, orbit.v, -1, orbit)
    return Course(status, x, v, -1, Orbit(0, x, v, 0))


@kernel
def approached(cells: Cells, x: float, v: float, max_period: int, work: Scratch) -> Course:
    """Walk until the motion returns to a stable orbit that it slowly approaches, `max_period` periods at most.

    The orbit lies within `NEAR`, and comes nearer over twenty of its cycles.
    """
    x0, v0 = x, v
    for within in range(1, max_period + 1):
        status, x, v = walk(cells, x, v, 1, work.series)
        if status != OK:
            return Course(status, x, v, -1, Orbit(0, x, v, 0))
        if distance(x, v, x0, v0) > NEAR:
            continue
        orbit = stable_orbit(cells, x, v, within, NEWTON_STEPS, MOST_TRACE, work)
        before = distance(x, v, orbit.x, orbit.v)
        if orbit.period > 0 and before <= NEAR:
            status, x, v = walk(cells, x, v, 20 * orbit.period, work.series)
            if status != OK or distance(x, v, orbit.x, orbit.v) > max(before, RETURNED):
                orbit = Orbit(0, x, v, 0)
            return Course(status, x, v, -1, orbit)
    return Course(OK, x, v, -1, Orbit(0, x, v, 0))


@kernel
def judge(cells: Cells, course: Course, limits: Limits, work: Scratch, out: Settled, i: int) -> Course:
    """What a motion is that was not captured.

    Of one that approaches no orbit, row `i` of `out` gets the exponents and extremes over `n_exponent` periods, and
    where these began.
    """
    course = approached(cells, course.x, course.v, limits.max_period, work)
    if course.orbit.period > 0 or course.status != OK:
        return course
    out.points[i, 0, 0], out.points[i, 0, 1] = course.x, course.v
    per_block = max(1, limits.n_exponent // EXPONENT_BLOCKS)
    status, x, v, largest, error = exponents(
        cells, course.x, course.v, per_block, limits.n_exponent, EXPONENT_BLOCKS, work.reach
    )
    fill_exponents(cells, largest, error, out.exponents[i])
    out.extremes[i, 0], out.extremes[i, 1] = work.reach[LOWEST], work.reach[HIGHEST]
    if status == OK and not largest > RESOLVED * error:
        out.status[i] = UNSETTLED
        return approached(cells, x, v, limits.max_period, work)
    out.status[i] = APERIODIC
    return Course(status, x, v, -1, Orbit(0, x, v, 0))


@kernel
def fill_exponents(cells: Cells, largest: float, error: float, row: Array) -> None:
    """Both exponents, whose sum is -2 zeta (Liouville), and the standard error."""
    row[0], row[1], row[2] = largest, -2.0 * cells.damping_ratio - largest, error


@allocating_kernel
def settle(
    cells: Cells, x: float, v: float, n_transient: int, limits: Limits, work: Scratch, out: Settled, i: int
) -> None:
    """Follow one motion until it is settled and fill row `i` of `out`."""
    course = follow(cells, x, v, min(n_transient, limits.most), limits.max_period, out.way[i], work)
    undecided = course.status == OK and course.owner < 0 and course.orbit.period == 0
    exhausted = undecided and n_transient + limits.n_exponent > limits.most
    if undecided and not exhausted:
        course = judge(cells, course, limits, work, out, i)
    out.attractor[i], out.final[i, 0], out.final[i, 1] = course.owner, course.x, course.v
    if course.owner >= 0:
        copy_row(work.known.settled, course.owner, out, i)
    elif exhausted:
        out.status[i] = EXHAUSTED
    elif course.status != OK:
        out.status[i] = GONE if course.status == ESCAPED else CAPPED
        out.points[i], out.extremes[i] = np.nan, np.nan
    elif course.orbit.period > 0:
        describe_orbit(cells, course.orbit, work, out, i)
    else:
        describe_span(cells, out.points[i, 0, 0], out.points[i, 0, 1], limits.n_exponent, work, out, i)


@allocating_kernel
def describe_orbit(cells: Cells, orbit: Orbit, work: Scratch, out: Settled, i: int) -> None:
    """Fill row `i` of `out` with what a stable orbit is."""
    period, m = orbit.period, out.monodromy[i]
    out.status[i], out.period[i] = PERIODIC, period
    derivative(cells, orbit.x, orbit.v, period, m, work.series)
    fill_exponents(cells, np.log(spectral_radius(m)) / (period * cells.period), 0.0, out.exponents[i])
    x, v = smallest_point(cells, orbit.x, orbit.v, period, work.series)
    begin_reach(work.reach, x)
    walk(cells, x, v, period, work.series, None, work.reach)
    out.extremes[i, 0], out.extremes[i, 1] = work.reach[LOWEST], work.reach[HIGHEST]
    describe_span(cells, x, v, period, work, out, i)


@kernel
def describe_span(cells: Cells, x: float, v: float, n_periods: int, work: Scratch, out: Settled, i: int) -> None:
    """Fill row `i` of `out` with the section points from (x, v) on, and with the measures over `n_periods`."""
    if out.measures.shape[1] > 0:
        measure(cells, x, v, n_periods, work.series, out.measures[i])
    points, period = out.points[i], out.period[i]
    for k in range(len(points)):
        if 0 < period <= k:  # a cycle is copied
            x, v = points[k - period, 0], points[k - period, 1]
        points[k, 0], points[k, 1] = x, v
        if period == 0 or k + 1 < period:
            _status, x, v = walk(cells, x, v, 1, work.series)


@allocating_kernel
def copy_row(known: Settled, k: int, out: Settled, i: int) -> None:
    """What is known of attractor `k`, into row `i` of `out`."""
    out.status[i], out.period[i] = known.status[k], known.period[k]
    out.points[i], out.monodromy[i] = known.points[k], known.monodromy[k]
    out.extremes[i], out.exponents[i] = known.extremes[k], known.exponents[k]
    if out.measures.shape[1] > 0:
        out.measures[i] = known.measures[k]


@kernel
def smallest_point(cells: Cells, x: float, v: float, period: int, series: Array) -> tuple[float, float]:
    """The point of a cycle with the smallest X on the section; of points with the same X that with the smaller X'."""
    xs, vs = x, v
    for _ in range(period - 1):
        _status, x, v = walk(cells, x, v, 1, series)
        if x < xs - SAME_POINT or (x <= xs + SAME_POINT and v < vs):
            xs, vs = x, v
    return xs, vs


@allocating_kernel
def settle_lanes(first: int, last: int, lanes: Lanes, chain: int, limits: Limits, known: Known, out: Settled) -> None:
    """`settle` for lanes `first` to `last`, which form chains of `chain` lanes each (1: every lane for itself).

    In a chain each lane but the first starts where the one before it ended, if that motion stayed bounded.
    """
    work = make_scratch(known, limits.max_period)
    built = lanes.own[first]
    cells = build_cells(coefficients_of(lanes, built))
    for i in range(first, last):
        if lanes.own[i] != built:
            built = lanes.own[i]
            cells = build_cells(coefficients_of(lanes, built))
        x, v = lanes.starts[i, 0], lanes.starts[i, 1]
        if i % chain != 0 and out.status[i - 1] < GONE:
            x, v = out.final[i - 1, 0], out.final[i - 1, 1]
        settle(cells, x, v, lanes.n_transient[i], limits, work, out, i)


@allocating_kernel
def surround_rows(cells: Cells, points: Array, periods: Integers, rows: Array) -> int:
    """Neighbourhoods of the cycles through `points` (n, 2), filled into `rows`: how many there are."""
    series = np.empty(TERMS)
    filled = 0
    for i in range(len(points)):
        if periods[i] > 0 and surround(cells, points[i, 0], points[i, 1], periods[i], float(i), rows[filled:], series):
            filled += periods[i]
    return filled
