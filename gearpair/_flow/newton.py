"""Newton's method on the period map, and the cycle that it finds."""

import numpy as np

from ._kernel import Array, Integers, allocating_kernel, kernel
from .cells import Cells
from .closed_form import TERMS
from .tangent import set_identity
from .walk import OK, walk

NEWTON_STEPS = 40
NEWTON_ROUNDING = 1e-13
# Section points of one cycle closer than this are one point: its period is shorter than it returned with.
SAME_POINT = 1e-9


@kernel
def distance(x: float, v: float, x0: float, v0: float) -> float:
    """How far two states lie apart, relative to max(1, |X|, |X'|)."""
    return max(abs(x - x0), abs(v - v0)) / max(1.0, max(abs(x0), abs(v0)))


@kernel
def derivative(cells: Cells, x: float, v: float, period: int, m: Array, series: Array) -> tuple[int, float, float]:
    """The `period`-fold map with its derivative, which becomes `m` (2, 2): (status, x, v)."""
    set_identity(m)
    return walk(cells, x, v, period, series, m)


@kernel
def newton(
    cells: Cells, x: float, v: float, period: int, m: Array, series: Array, steps: int, most_trace: float
) -> tuple[bool, float, float, float]:
    """A fixed point of the `period`-fold map near (x, v): (converged, x, v, residual); `m` its monodromy.

    The search takes at most `steps`, and ends where the trace of the monodromy exceeds `most_trace`; at a stable orbit
    it is below 2.
    """
    residual = np.inf
    best_x, best_v = x, v
    for _ in range(steps):
        status, x1, v1 = derivative(cells, x, v, period, m, series)
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
    status, _x, _v = derivative(cells, best_x, best_v, period, m, series)
    converged = status == OK and residual <= 1e3 * NEWTON_ROUNDING * max(1.0, abs(best_x))
    return converged, best_x, best_v, residual


@kernel
def minimal_period(cells: Cells, xs: float, vs: float, period: int, series: Array) -> int:
    """The shortest period of the cycle through (xs, vs), which returns after `period`."""
    x, v = xs, vs
    for shorter in range(1, period):
        _status, x, v = walk(cells, x, v, 1, series)
        if period % shorter == 0 and distance(x, v, xs, vs) <= SAME_POINT:
            return shorter
    return period


@allocating_kernel
def newton_starts(
    first: int, last: int, cells: Cells, starts: Array, period: int, ends: Array, periods: Integers, residuals: Array
) -> None:
    """Newton's method from rows `first` to `last` of `starts` (n, 2): the same of `ends`, `periods` and `residuals`.

    The period is the orbit's own, 0 where none was found.
    """
    m, series = np.empty((2, 2)), np.empty(TERMS)
    for i in range(first, last):
        found, x, v, residuals[i] = newton(cells, starts[i, 0], starts[i, 1], period, m, series, NEWTON_STEPS, np.inf)
        ends[i, 0], ends[i, 1] = x, v
        periods[i] = minimal_period(cells, x, v, period, series) if found else 0
