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

import numpy as np

from ._kernel import Array, allocating_kernel, kernel
from .capture import OWNER, inside
from .cells import Cells, build_cells
from .describe import copy_row, describe_floating, describe_orbit, describe_span, fill_exponents
from .newton import distance
from .observe import exponents, mean_damping
from .reach import HIGHEST, LOWEST, begin_reach
from .stable_orbits import PROMISING, RETURNED, approached, attempt, beside
from .states import (
    APERIODIC,
    CAPPED,
    EXHAUSTED,
    FLOATING,
    GONE,
    UNSETTLED,
    Course,
    Known,
    Lanes,
    Limits,
    Orbit,
    Scratch,
    Settled,
    captured,
    coefficients_of,
    make_scratch,
    undecided,
)
from .walk import ESCAPED, OK, inlined_walk, walk
from .way import arrive, begin_way, end_way, limit_of, neighbourhoods_of, see_out

# Where no neighbourhood can be certified, a return within RETURNED counts if the stable orbit lies within CAPTURED.
CAPTURED = 1e-6
# Periods after which a motion is first compared with where it was; the span doubles up to the longest period.
FIRST_SPAN = 4
# An unsuccessful search lets the next return be LESS as far.
LESS = 0.1
# An exponent is resolved when it exceeds this many standard errors, and what rounding leaves of one that is 0.
RESOLVED, ROUNDING = 4.0, 1e-9
EXPONENT_BLOCKS = 20
# Chaotic motions whose ranges and exponents differ by no more than this are on one set.
SAME_RANGE, SAME_EXPONENT = 0.25, 0.1


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
def floats(cells: Cells, x: float, v: float, work: Scratch) -> bool:
    """Whether a motion repeats within the backlash, as only without a mean force: one of a family, shifted at will.

    The family ends where a motion grazes a flank, and those that strike it come to rest there.
    """
    if cells.flight_damping == 0.0 and cells.damping_ratio == 0.0:  # no drift would ever have died
        return False
    begin_reach(work.reach, x)
    status, x1, v1 = walk(cells, x, v, 1, work.series, None, work.reach)
    repeats = status == OK and distance(x1, v1, x, v) <= RETURNED
    return repeats and work.reach[LOWEST] > -1.0 - RETURNED and work.reach[HIGHEST] < 1.0 + RETURNED


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
    damping = mean_damping(cells, course.x, course.v, observed_periods(n_exponent), work.series, work.measures)
    fill_exponents(largest, damping, error, out.exponents[i])
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
    n_watch = limits.n_watch if max(cells.damping_ratio, cells.flight_damping) > 0.0 else 0
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
        damping = mean_damping(cells, course.x, course.v, n_watch, work.series, work.measures)
        fill_exponents(largest, damping, error, out.exponents[i])
    out.status[i] = APERIODIC if resolved(out.exponents[i]) else UNSETTLED
    return course


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
    if captured(course) and cells.force == 0.0 and floats(cells, out.final[i, 0], out.final[i, 1], work):
        # Over a cycle the forces on the teeth have the mean 0: none strikes one flank alone.
        course = Course(OK, out.final[i, 0], out.final[i, 1], -1, Orbit(0, course.x, course.v, 0))
        out.status[i] = FLOATING
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
        if i % chain != 0 and not (GONE <= out.status[i - 1] <= CAPPED):
            x, v = out.final[i - 1, 0], out.final[i - 1, 1]
        settle(cells, x, v, lanes.n_transient[i], limits, work, out, i)
