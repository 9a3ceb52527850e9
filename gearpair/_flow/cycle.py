"""What a continuation asks of oscillators: period maps with their derivatives, and a cycle with its extrema."""

import numpy as np

from ._kernel import Array, allocating_kernel
from .cells import Parameters, build_cells
from .closed_form import TERMS
from .newton import derivative
from .records import Extrema
from .walk import Details, walk


@allocating_kernel
def map_at(p: Parameters, x: float, v: float, period: int, m: Array) -> tuple[int, float, float]:
    """The `period`-fold map of oscillator `p` and its derivative `m` (2, 2): (status, x, v)."""
    return derivative(build_cells(p), x, v, period, m, np.empty(TERMS))


@allocating_kernel
def maps_at(
    p: Parameters, others: tuple[Parameters, ...], x: float, v: float, period: int, m: Array, ends: Array
) -> tuple[int, float, float]:
    """`map_at`, with the ends (n, 2) of the map of `others`; the status is the worst of all."""
    series = np.empty(TERMS)
    worst, x1, v1 = derivative(build_cells(p), x, v, period, m, series)
    for i in range(len(others)):
        status, ends[i, 0], ends[i, 1] = walk(build_cells(others[i]), x, v, period, series)
        worst = max(worst, status)
    return worst, x1, v1


@allocating_kernel
def cycle_at(p: Parameters, x: float, v: float, points: Array, m: Array, extrema: Extrema) -> tuple[int, float]:
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
