"""The way of a captured motion: until it had settled, and on for as long as the rest can change its range."""

import numpy as np

from ._kernel import Array, allocating_kernel, kernel
from .capture import OWNER, SPREAD, V, X, inside, square, surround
from .cells import Cells
from .reach import COAST, DRIVE, HIGHEST, LOWEST, begin_reach
from .stable_orbits import smallest_point
from .states import Course, Orbit, Scratch, Settled
from .walk import OK, inlined_walk, walk

# The rest of the way is not followed where it can widen the range by less than this, nor for longer than that.
SEEN, SEEN_OUT = 1e-9, 20_000


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
