"""What a continuation asks of oscillators: period maps with their derivatives, and a cycle with its extrema."""

import numpy as np

from ._kernel import Array, allocating_kernel
from .cells import Coefficients, build_cells
from .closed_form import TERMS
from .newton import derivative
from .records import Extrema
from .walk import Details, walk


@allocating_kernel
def map_at(p: Coefficients, x: float, v: float, period: int, m: Array) -> tuple[int, float, float]:
    """The `period`-fold map of oscillator `p` and its derivative `m` (2, 2): (status, x, v)."""
    return derivative(build_cells(p), x, v, period, m, np.empty(TERMS))


@allocating_kernel
def equations_at(
    p: Coefficients,
    beside: tuple[Coefficients, ...],
    x: float,
    v: float,
    period: int,
    steps: Array,
    residual: Array,
    jacobian: Array,
) -> int:
    """The equations map(x, v) = (x, v) of an orbit: the worst status of the walks.

    Fills `residual` (2,) and `jacobian` (2, 2 + n): the exact derivative by X and X', and the central difference by
    each of n parameters, of which `beside` has the oscillators a step of `steps` (n,) above and below.
    """
    series, m = np.empty(TERMS), np.empty((2, 2))
    worst, x1, v1 = derivative(build_cells(p), x, v, period, m, series)
    residual[0], residual[1] = x1 - x, v1 - v
    jacobian[0, 0], jacobian[0, 1], jacobian[1, 0], jacobian[1, 1] = m[0, 0] - 1.0, m[0, 1], m[1, 0], m[1, 1] - 1.0
    for k in range(len(steps)):
        above, x1, v1 = walk(build_cells(beside[2 * k]), x, v, period, series)
        below, x0, v0 = walk(build_cells(beside[2 * k + 1]), x, v, period, series)
        jacobian[0, 2 + k], jacobian[1, 2 + k] = (x1 - x0) / (2.0 * steps[k]), (v1 - v0) / (2.0 * steps[k])
        worst = max(worst, max(above, below))
    return worst


@allocating_kernel
def cycle_at(p: Coefficients, x: float, v: float, points: Array, m: Array, extrema: Extrema) -> tuple[int, float]:
    """The cycle of oscillator `p` through (x, v): (status, residual).

    Fills `points` (period, 2) with X and X' on the section, `m` (2, 2) with the monodromy, and `extrema`.
    """
    cells, series, period = build_cells(p), np.empty(TERMS), points.shape[0]
    points[0, 0], points[0, 1] = x, v
    for i in range(1, period):
        _status, points[i, 0], points[i, 1] = walk(cells, points[i - 1, 0], points[i - 1, 1], 1, series)
    status, x1, v1 = derivative(cells, x, v, period, m, series)
    searched, _x, _v = walk(cells, x, v, period, series, None, None, Details(None, None, extrema, None, None))
    return max(status, searched), max(abs(x1 - x), abs(v1 - v))
