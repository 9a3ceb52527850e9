"""The machine that settles: what a motion becomes, for one start or for many.

| state | what leads on | to |
|---|---|---|
| on its way | it enters a neighbourhood of an attractor known beforehand | captured |
| on its way | it returns near itself | attempt |
| attempt | a stable orbit is found whose neighbourhood holds the motion, or to which it has returned | captured |
| attempt | anything else | on its way; the next return must be closer |
| on its way | the transient has passed | observed, or exhausted where the work left is too little |
| observed | it slowly approaches a stable orbit | captured |
| observed | it floats in the backlash and stays there | floating |
| observed | it is on a chaotic set that is known to last | aperiodic |
| observed | anything else | watched |
| watched | it enters a neighbourhood, returns, or slowly approaches a stable orbit, as before | captured |
| watched | the work is spent | exhausted |
| watched | its exponent is positive, well outside its error | aperiodic |
| watched | anything else | unsettled |
| any | the walk ends early | escaped, or capped |

A captured motion is periodic: its limit is described, or copied where it is known. The neighbourhoods, which no motion
leaves, are those of `capture`: of the cycles known beforehand, and of the one that the motion was last seen to
return near. It has settled when it first entered one of its own cycle, whichever way that cycle became known; from
there on it is followed for as long as the rest can still change the range of its way.
"""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, Integers, allocating_kernel, kernel
from .capture import COLUMNS, OWNER, SPREAD, V, X, inside, square, surround
from .cells import Cells, Coefficients, build_cells
from .closed_form import TERMS
from .newton import NEWTON_STEPS, SAME_POINT, derivative, distance, minimal_period, newton
from .observe import exponents, measure
from .reach import COAST, DRIVE, HIGHEST, LOWEST, begin_reach
from .walk import ESCAPED, OK, inlined_walk, walk

PERIODIC, APERIODIC, UNSETTLED, GONE, CAPPED, NOT_RUN, EXHAUSTED, TRANSIENT, FLOATING = 0, 1, 2, 3, 4, 5, 6, 7, 8

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
# An exponent is resolved when it exceeds this many standard errors, and what rounding leaves of one that is 0.
RESOLVED, ROUNDING = 4.0, 1e-9
EXPONENT_BLOCKS = 20
# Chaotic motions whose ranges and exponents differ by no more than this are on one set.
SAME_RANGE, SAME_EXPONENT = 0.25, 0.1
# The rest of the way is not followed where it can widen the range by less than this, nor for longer than that.
SEEN, SEEN_OUT = 1e-9, 20_000


class Limits(NamedTuple):
    """How far to look."""

    max_period: int  # the longest period looked for
    n_exponent: int  # mesh periods over which exponents are measured
    n_watch: int  # mesh periods that a motion is then watched for; without damping nothing settles, and it is not
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
    way: Array  # (n, 4): mesh periods and impacts until settled, or the transient has passed; smallest and largest X
    lasted: Integers  # (n,) mesh periods followed; of a periodic motion, until it had settled
    chaos: Array  # (n, 3) what it was when observed: smallest and largest X, largest exponent; nan if captured before
    measures: Array  # (n, N_MEASURES), or (n, 0) where they are not asked for


class Known(NamedTuple):
    """Attractors known beforehand."""

    settled: Settled  # one row an attractor
    neighbourhoods: Array  # (m, COLUMNS), OWNER the attractor's row
    lasting: Array  # (k, 4) rows as of `Settled.chaos` of motions on sets that last, and mesh periods watched


class Scratch(NamedTuple):
    """What a thread works with."""

    known: Known
    neighbourhoods: Array  # the known ones first, then room for those of one more cycle
    m: Array  # (2, 2)
    reach: Array  # (4,)
    way: Array  # (4,) the whole way of a motion, as in `Settled`
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
    x: float  # the last point reached
    v: float
    held: int  # the neighbourhood that holds it, among the scratch, or -1
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
    return Scratch(known, neighbourhoods, np.empty((2, 2)), np.empty(4), np.empty(4), np.empty(TERMS))


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
        # From the same point of the cycle, whoever finds it.
        xs, vs = smallest_point(cells, found.x, found.v, found.period, work.series)
        certain = surround(cells, xs, vs, found.period, -1.0, rows[n_known:], work.series)
        n = found.period if certain else 0
    return True, Orbit(found.period, found.x, found.v, n)


@kernel
def follow(
    cells: Cells, x: float, v: float, n_periods: int, max_period: int, work: Scratch, reach: Array | None
) -> Course:
    """Follow a motion until it is captured, `n_periods` at most. Widens `reach` and adds to the periods of the way."""
    rows, n_known = work.neighbourhoods, len(work.known.neighbourhoods)
    orbit = Orbit(0, x, v, 0)
    done, within, span, closeness = 0, 0, FIRST_SPAN, PROMISING
    x0, v0 = x, v
    status, returned = OK, False
    held = inside(rows, n_known, x, v)
    while held < 0 and done < n_periods and not returned:
        status, x, v = inlined_walk(cells, x, v, 1, work.series, None, reach)
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
    work.way[0] += done
    if held < n_known and (held >= 0 or not returned):
        orbit = Orbit(0, x, v, 0)
    return Course(status, x, v, held, orbit)


@kernel
def begin_way(work: Scratch, x: float) -> None:
    """Begin a way at `x`."""
    work.way[0], work.way[1], work.way[2], work.way[3] = 0.0, 0.0, x, x
    begin_reach(work.reach, x)


@kernel
def end_way(work: Scratch) -> None:
    """Note what the reach was over the periods of a way."""
    work.way[1] = work.reach[DRIVE] + work.reach[COAST]
    work.way[2], work.way[3] = work.reach[LOWEST], work.reach[HIGHEST]


@kernel
def undecided(course: Course) -> bool:
    """Whether a motion stayed bounded and nothing has captured it."""
    return course.status == OK and not captured(course)


@kernel
def captured(course: Course) -> bool:
    """Whether an orbit has captured a motion."""
    return course.held >= 0 or course.orbit.period > 0


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
def floats(cells: Cells, x: float, v: float, work: Scratch) -> bool:
    """Whether a motion repeats within the backlash, as only without a mean force: one of a family, shifted at will."""
    if cells.damping_ratio == 0.0:
        return False
    begin_reach(work.reach, x)
    status, x1, v1 = walk(cells, x, v, 1, work.series, None, work.reach)
    repeats = status == OK and distance(x1, v1, x, v) <= RETURNED
    return repeats and work.reach[LOWEST] > -1.0 and work.reach[HIGHEST] < 1.0


@kernel
def observed_periods(n_exponent: int) -> int:
    """Mesh periods of `observe`: a block to turn the direction, and those that count, in whole blocks."""
    return max(1, n_exponent // EXPONENT_BLOCKS) * (EXPONENT_BLOCKS + 1)


@kernel
def observe(cells: Cells, course: Course, n_exponent: int, work: Scratch, out: Settled, i: int) -> Course:
    """The exponents and extremes over `n_exponent` periods, into row `i` of `out`, and where these began."""
    out.points[i, 0, 0], out.points[i, 0, 1] = course.x, course.v
    per_block = max(1, n_exponent // EXPONENT_BLOCKS)
    status, x, v, largest, error = exponents(
        cells, course.x, course.v, per_block, n_exponent, EXPONENT_BLOCKS, work.reach
    )
    work.way[0] += observed_periods(n_exponent)
    fill_exponents(cells, largest, error, out.exponents[i])
    out.extremes[i, 0], out.extremes[i, 1] = work.reach[LOWEST], work.reach[HIGHEST]
    out.chaos[i, 0], out.chaos[i, 1], out.chaos[i, 2] = work.reach[LOWEST], work.reach[HIGHEST], largest
    return Course(status, x, v, -1, course.orbit)


@kernel
def lasts(lasting: Array, chaos: Array) -> bool:
    """Whether an observed motion is on a chaotic set that is known to last."""
    for row in lasting:
        if (
            max(abs(row[0] - chaos[0]), abs(row[1] - chaos[1])) <= SAME_RANGE
            and abs(row[2] - chaos[2]) <= SAME_EXPONENT
        ):
            return True
    return False


@kernel
def resolved(exponents: Array) -> bool:
    """Whether the largest exponent of a row is positive, well outside its error."""
    return exponents[0] > max(RESOLVED * exponents[2], ROUNDING)


@kernel
def judge(cells: Cells, course: Course, limits: Limits, work: Scratch, out: Settled, i: int) -> Course:
    """What a motion is that was not captured when its transient had passed: row `i` of `out` gets its status.

    It is captured all the same if it settles while it is watched.
    """
    begun = course
    course = approached(cells, begun.x, begun.v, limits.max_period, work)
    if not undecided(course):
        return course
    if floats(cells, begun.x, begun.v, work):
        out.status[i] = FLOATING
        return begun
    course = observe(cells, begun, limits.n_exponent, work, out, i)
    if course.status != OK:
        return course
    if lasts(work.known.lasting, out.chaos[i]):
        out.status[i] = APERIODIC
        return course
    n_watch = limits.n_watch if cells.damping_ratio > 0.0 else 0
    left = max(0, min(n_watch, limits.most - int(work.way[0])))
    course = follow(cells, course.x, course.v, left, limits.max_period, work, None)
    if not undecided(course):
        return course
    if left < n_watch:
        out.status[i] = EXHAUSTED
        return course
    late = approached(cells, course.x, course.v, limits.max_period, work)
    if not undecided(late):
        return late
    if n_watch > limits.n_exponent and not resolved(out.exponents[i]):
        _status, _x, _v, largest, error = exponents(cells, course.x, course.v, 1, n_watch, EXPONENT_BLOCKS, work.reach)
        fill_exponents(cells, largest, error, out.exponents[i])
    out.status[i] = APERIODIC if resolved(out.exponents[i]) else UNSETTLED
    return course


@kernel
def fill_exponents(cells: Cells, largest: float, error: float, row: Array) -> None:
    """Both exponents, whose sum is -2 zeta (Liouville), and the standard error."""
    row[0], row[1], row[2] = largest, -2.0 * cells.damping_ratio - largest, error


@allocating_kernel
def settle(
    cells: Cells, x: float, v: float, n_transient: int, limits: Limits, work: Scratch, out: Settled, i: int
) -> None:
    """Follow one motion until it is settled and fill row `i` of `out`."""
    begin_way(work, x)
    course = follow(cells, x, v, min(n_transient, limits.most), limits.max_period, work, work.reach)
    end_way(work)
    out.way[i] = work.way
    if undecided(course):
        out.status[i] = EXHAUSTED
        if n_transient + limits.n_exponent <= limits.most:
            course = judge(cells, course, limits, work, out, i)
    out.lasted[i] = int(work.way[0])
    out.final[i, 0], out.final[i, 1] = limit_of(course, work)
    if captured(course):
        if 0 <= course.held < len(work.known.neighbourhoods):
            out.attractor[i] = int(work.neighbourhoods[course.held, OWNER])
            copy_row(work.known.settled, out.attractor[i], out, i)
        else:
            describe_orbit(cells, course.orbit, work, out, i)
        first, n = neighbourhoods_of(cells, course, work)
        if course.orbit.period > 0 or out.lasted[i] > n_transient:
            course = arrive(cells, x, v, first, n, work)
        out.way[i] = work.way
        out.lasted[i] = int(work.way[0])
        see_out(cells, course, first, n, work, out, i)
    elif course.status != OK:
        out.status[i] = GONE if course.status == ESCAPED else CAPPED
        out.points[i], out.extremes[i] = np.nan, np.nan
    elif out.status[i] == FLOATING:
        describe_floating(cells, course, work, out, i)
    elif np.isfinite(out.extremes[i, 0]):
        describe_span(cells, out.points[i, 0, 0], out.points[i, 0, 1], limits.n_exponent, work, out, i)


@kernel
def limit_of(course: Course, work: Scratch) -> tuple[float, float]:
    """The section point of its limit that a captured motion is near; else the last one it reached."""
    if course.held >= 0:
        return work.neighbourhoods[course.held, X], work.neighbourhoods[course.held, V]
    if course.orbit.period > 0:
        return course.orbit.x, course.orbit.v
    return course.x, course.v


@allocating_kernel
def neighbourhoods_of(cells: Cells, course: Course, work: Scratch) -> tuple[int, int]:
    """The first of the neighbourhoods, among the scratch, of the orbit that captured a motion, and how many it has."""
    first, orbit, rows = len(work.known.neighbourhoods), course.orbit, work.neighbourhoods
    if orbit.period == 0:
        first = course.held
        while first > 0 and rows[first - 1, OWNER] == rows[course.held, OWNER]:
            first -= 1
        return first, work.known.settled.period[int(rows[first, OWNER])]
    if orbit.n_neighbourhoods > 0:
        return first, orbit.period
    xs, vs = smallest_point(cells, orbit.x, orbit.v, orbit.period, work.series)
    return first, orbit.period if surround(cells, xs, vs, orbit.period, -1.0, rows[first:], work.series) else 0


@kernel
def arrive(cells: Cells, x: float, v: float, first: int, n: int, work: Scratch) -> Course:
    """Walk once more from the start until the first of `n` neighbourhoods holds the motion. Fills the work's way.

    An orbit that was not known was found when the motion had come near already, and what is observed or watched is
    not asked for its range.
    """
    rows, most, done = work.neighbourhoods[first : first + n], int(work.way[0]), 0
    begin_way(work, x)
    held = inside(rows, n, x, v)
    while held < 0 and done < most:
        _status, x, v = inlined_walk(cells, x, v, 1, work.series, None, work.reach)
        done += 1
        held = inside(rows, n, x, v)
    work.way[0] = done
    end_way(work)
    return Course(OK, x, v, first + held if held >= 0 else -1, Orbit(0, x, v, 0))


@kernel
def see_out(cells: Cells, course: Course, first: int, n: int, work: Scratch, out: Settled, i: int) -> None:
    """Follow a captured motion on for as long as the rest of its way can change the range of row `i` of `out`.

    The `n` neighbourhoods of its cycle follow on one another, and the motion never leaves them; see `capture` for the
    bound.
    """
    rows, k, way = work.neighbourhoods, course.held, out.way[i]
    if k < 0:
        return
    x, v = course.x, course.v
    begin_reach(work.reach, x)
    for _ in range(SEEN_OUT):
        margin = np.sqrt(square(rows[k], x, v)) * rows[k, SPREAD]
        if margin <= SEEN or nothing_new(way, out.extremes[i], margin):
            break
        _status, x, v = walk(cells, x, v, 1, work.series, None, work.reach)
        way[2], way[3] = min(way[2], work.reach[LOWEST]), max(way[3], work.reach[HIGHEST])
        k = first + (k - first + 1) % n


@kernel
def nothing_new(way: Array, extremes: Array, margin: float) -> bool:
    """Whether a motion within `margin` of a cycle's range cannot add to what the way and the cycle show together.

    That is the largest displacement, and which boundaries of the backlash X passes.
    """
    low, high = extremes[0] - margin, extremes[1] + margin
    lowest, highest = min(way[2], extremes[0]), max(way[3], extremes[1])
    if max(abs(low), abs(high)) > max(abs(lowest), abs(highest)):
        return False
    passes = low < -1.0 <= lowest or low < 1.0 <= lowest
    return not (passes or highest <= 1.0 < high or highest <= -1.0 < high)


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
def describe_floating(cells: Cells, course: Course, work: Scratch, out: Settled, i: int) -> None:
    """Fill row `i` of `out` with what a motion is that floats: neutral to a shift of X, damped otherwise."""
    fill_exponents(cells, 0.0, 0.0, out.exponents[i])
    begin_reach(work.reach, course.x)
    walk(cells, course.x, course.v, 1, work.series, None, work.reach)
    out.extremes[i, 0], out.extremes[i, 1] = work.reach[LOWEST], work.reach[HIGHEST]
    describe_span(cells, course.x, course.v, 1, work, out, i)


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
        if i % chain != 0 and not (GONE <= out.status[i - 1] <= NOT_RUN):
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
