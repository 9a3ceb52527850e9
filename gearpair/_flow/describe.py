"""What a settled motion is, put into its row of the results."""

import numpy as np

from ._kernel import Array, allocating_kernel, kernel
from .cells import Cells
from .newton import derivative
from .observe import mean_damping, measure
from .reach import HIGHEST, LOWEST, begin_reach
from .stable_orbits import RETURNED, smallest_point, spectral_radius
from .states import PERIODIC, Course, Orbit, Scratch, Settled
from .walk import walk


@kernel
def fill_exponents(largest: float, damping: float, error: float, row: Array) -> None:
    """Both exponents, whose sum is that of Liouville's formula for a mean `damping`, and the standard error."""
    row[0], row[1], row[2] = largest, -2.0 * damping - largest, error


@allocating_kernel
def describe_orbit(cells: Cells, orbit: Orbit, work: Scratch, out: Settled, i: int) -> None:
    """Fill row `i` of `out` with what a stable orbit is."""
    period, m = orbit.period, out.monodromy[i]
    out.status[i], out.period[i] = PERIODIC, period
    derivative(cells, orbit.x, orbit.v, period, m, work.series)
    damping = mean_damping(cells, orbit.x, orbit.v, period, work.series, work.measures)
    radius = spectral_radius(m)  # after very long it may be below all floats: then damping alone is told
    rate = np.log(radius) / (period * cells.period) if radius > 0.0 else -damping
    fill_exponents(rate, damping, 0.0, out.exponents[i])
    x, v = smallest_point(cells, orbit.x, orbit.v, period, work.series)
    begin_reach(work.reach, x)
    walk(cells, x, v, period, work.series, None, work.reach)
    out.extremes[i, 0], out.extremes[i, 1] = work.reach[LOWEST], work.reach[HIGHEST]
    describe_span(cells, x, v, period, work, out, i)


@kernel
def describe_floating(cells: Cells, course: Course, work: Scratch, out: Settled, i: int) -> None:
    """Fill row `i` of `out` with what a motion is that floats: neutral to a shift of X, damped otherwise.

    One at rest at a flank, which it touches by a rounding, is described by its neighbour that does not touch.
    """
    fill_exponents(0.0, cells.flight_damping, 0.0, out.exponents[i])
    begin_reach(work.reach, course.x)
    walk(cells, course.x, course.v, 1, work.series, None, work.reach)
    free = 1.0 - RETURNED
    over = max(work.reach[HIGHEST] - free, 0.0) - max(-free - work.reach[LOWEST], 0.0)
    out.extremes[i, 0], out.extremes[i, 1] = work.reach[LOWEST] - over, work.reach[HIGHEST] - over
    describe_span(cells, course.x - over, course.v, 1, work, out, i)


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
