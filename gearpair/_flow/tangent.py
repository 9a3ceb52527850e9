"""The variational flow along the march, and Newton's method on the period map.

The force is continuous at X = +-1 and the stiffness switches at fixed times, so the variational flow
has no jump: its matrix is the product of the linear pieces' own, and its determinant is exp(-2 zeta n T).
"""

import numpy as np

from ._kernel import inlined_kernel, kernel
from .cells import VV, VX, WIDTH, XV, XX
from .closed_form import evaluate
from .event_search import INSIDE, UNDECIDED
from .march import (
    ESCAPED,
    EVENT_UNDECIDED,
    MAX_EVENTS_PER_PERIOD,
    OK,
    TOO_MANY_EVENTS,
    first_region,
    follow_block,
    follow_cell,
    next_segment,
    region_after,
)

NEWTON_STEPS = 40
NEWTON_ROUNDING = 1e-13


@kernel
def apply(xx, xv, vx, vv, m):
    """Multiply the 2 x 2 matrix `m` from the left, in place."""
    for k in range(2):
        m[0, k], m[1, k] = xx * m[0, k] + xv * m[1, k], vx * m[0, k] + vv * m[1, k]


@kernel
def apply_segment(cells, j, region, duration, m):
    """Multiply `m` by the variational matrix of a segment of `duration` (in widths of cell `j`)."""
    basis, width = cells.bases[cells.level[j], abs(region)], cells.clock[j, WIDTH]
    xx, vx, _ = evaluate(basis[0], duration)
    xv, vv, _ = evaluate(basis[1], duration)
    apply(xx, xv, vx / width, vv / width, m)


@kernel
def apply_map(row, m):
    """Multiply `m` by the linear part of the affine map in `row`."""
    apply(row[XX], row[XV], row[VX], row[VV], m)


@inlined_kernel
def cross_block_tangent(cells, b, x, v, region, m, series):
    """`cross_block` that also multiplies `m`: (status, number of events, x, v, region)."""
    events = 0
    first, last = cells.blocks[b], cells.blocks[b + 1]
    for j in range(first, last):
        if last - first > 1:
            certain, x1, v1, _low, _high = follow_cell(cells, j, x, v, region)
            if certain:
                apply_map(cells.maps[j, region + 1], m)
                x, v = x1, v1
                continue
        t = 0.0
        while True:
            outcome, duration, x, v = next_segment(cells, j, t, x, v, region, series)
            if outcome == UNDECIDED:
                return EVENT_UNDECIDED, events, x, v, region
            apply_segment(cells, j, region, duration, m)
            if outcome == INSIDE:
                break
            t += duration
            region = region_after(region, x)
            events += 1
            if events > MAX_EVENTS_PER_PERIOD:
                return TOO_MANY_EVENTS, events, x, v, region
    return OK, events, x, v, region


@kernel
def march_tangent(cells, x, v, n_periods, m, series):
    """`march` that also multiplies `m` (2, 2) by the monodromy matrix of the span: (status, x, v)."""
    region = first_region(cells, x, v)
    for _ in range(n_periods):
        events = 0
        for b in range(cells.block_width.size):
            certain, x1, v1, _low, _high = follow_block(cells, b, x, v, region)
            if certain:
                apply_map(cells.block_maps[b, region + 1], m)
                x, v = x1, v1
                continue
            status, n, x, v, region = cross_block_tangent(cells, b, x, v, region, m, series)
            events += n
            if status != OK:
                return status, x, v
            if events > MAX_EVENTS_PER_PERIOD:
                return TOO_MANY_EVENTS, x, v
        if not abs(x) + abs(v) <= cells.escape_radius:
            return ESCAPED, x, v
    return OK, x, v


@kernel
def newton(cells, x, v, period, m, series, steps=NEWTON_STEPS, most_trace=np.inf):
    """A fixed point of the `period`-fold map near (x, v): (converged, x, v, residual); `m` its monodromy.

    The search ends where the trace of the monodromy exceeds `most_trace`; at a stable orbit it is below 2.
    """
    residual = np.inf
    best_x, best_v = x, v
    for _ in range(steps):
        m[0, 0], m[0, 1], m[1, 0], m[1, 1] = 1.0, 0.0, 0.0, 1.0
        status, x1, v1 = march_tangent(cells, x, v, period, m, series)
        if status != OK or abs(m[0, 0] + m[1, 1]) > most_trace:
            return False, x, v, np.inf
        rx, rv = x1 - x, v1 - v
        size = max(abs(rx), abs(rv))
        if size < residual:
            residual, best_x, best_v = size, x, v
        elif residual <= NEWTON_ROUNDING * max(1.0, abs(x)):
            break
        determinant = (1.0 - m[0, 0]) * (1.0 - m[1, 1]) - m[0, 1] * m[1, 0]
        if determinant == 0.0:
            break
        dx = ((1.0 - m[1, 1]) * rx + m[0, 1] * rv) / determinant
        dv = (m[1, 0] * rx + (1.0 - m[0, 0]) * rv) / determinant
        if not abs(dx) + abs(dv) < 1e3:
            return False, x, v, np.inf
        x, v = x + dx, v + dv
    m[0, 0], m[0, 1], m[1, 0], m[1, 1] = 1.0, 0.0, 0.0, 1.0
    status, _x, _v = march_tangent(cells, best_x, best_v, period, m, series)
    converged = status == OK and residual <= 1e3 * NEWTON_ROUNDING * max(1.0, abs(best_x))
    return converged, best_x, best_v, residual
