"""What is observed over a span of the motion: samples, Lyapunov exponents, blows and forces."""

import numpy as np

from ._kernel import Array, Integers, allocating_kernel, kernel
from .cells import Cells
from .closed_form import TERMS
from .measures import HIGHEST, LOWEST, SHARE, Measures, finish_measures
from .reach import begin_reach
from .records import Samples
from .segment import first_region
from .tangent import set_identity
from .walk import OK, Details, Place, walk, walk_mesh_period


@kernel
def measure(cells: Cells, x: float, v: float, n_periods: int, series: Array, row: Array) -> int:
    """Blows, forces and displacements over `n_periods`: the status. Fills `row` (N_MEASURES,).

    Per mesh period: impacts and impulse of each side; shares of the time in contact; the largest and the sum of the
    approach velocities and the largest mesh force of each side, all as moduli; mean of X, root mean square of X
    about it, smallest and largest X.
    """
    row[:] = 0.0
    row[LOWEST], row[HIGHEST] = x, x
    measures = Measures(row, x)
    status, _x, _v = walk(cells, x, v, n_periods, series, None, None, Details(None, None, None, measures, None))
    if status == OK:
        finish_measures(measures, cells, n_periods)
    return status


@kernel
def mean_damping(cells: Cells, x: float, v: float, n_periods: int, series: Array, row: Array) -> float:
    """The mean damping ratio over `n_periods`: minus half the sum of the exponents (Liouville). `row` is scratch."""
    if cells.flight_damping == cells.damping_ratio:
        return cells.damping_ratio
    measure(cells, x, v, n_periods, series, row)
    contact = row[SHARE] + row[SHARE + 1]
    return contact * cells.damping_ratio + (1.0 - contact) * cells.flight_damping


@allocating_kernel
def record(
    cells: Cells, x: float, v: float, n_periods: int, per_period: int, values: Array, crossings: Array, counts: Integers
) -> tuple[int, float, float]:
    """The walk over `n_periods` with what `Samples` of these arrays take on the way: (status, x, v)."""
    samples = Samples(per_period, values, crossings, counts)
    return walk(cells, x, v, n_periods, np.empty(TERMS), None, None, Details(samples, None, None, None, None))


@kernel
def stretch(
    cells: Cells, x: float, v: float, n_periods: int, series: Array, q: Array, reach: Array
) -> tuple[int, float, float, float]:
    """`walk`, turning the first column of `q` (2, 2) with the flow: (status, x, v, log of its growth).

    It is made a unit vector again after every mesh period: over a base period of many it would leave the floats' range.
    """
    total = 0.0
    for _ in range(n_periods):
        place = Place(x, v, first_region(cells, x, v), 0)
        for turn in range(cells.mesh_periods):
            status, place = walk_mesh_period(cells, 0, turn, place, series, q, reach, None)
            x, v = place.x, place.v
            if status != OK:
                return status, x, v, total
            length = np.hypot(q[0, 0], q[1, 0])
            q[0, 0], q[1, 0] = q[0, 0] / length, q[1, 0] / length
            q[0, 1], q[1, 1] = -q[1, 0], q[0, 0]
            total += np.log(length)
    return OK, x, v, total


@allocating_kernel
def exponents(
    cells: Cells, x: float, v: float, n_turn: int, n_periods: int, blocks: int, reach: Array
) -> tuple[int, float, float, float, float]:
    """The largest Lyapunov exponent: (status, x, v, exponent per unit tau, standard error).

    The other follows from Liouville's formula, by `mean_damping`; from the matrices it would lose all digits where
    damping is strong. `n_turn` periods come first, uncounted, to turn the direction into the most unstable one. The
    error is that of the mean over `blocks` equal parts of the span. `reach` (4,) is that of the whole way.
    """
    q, series = np.empty((2, 2)), np.empty(TERMS)
    set_identity(q)
    begin_reach(reach, x)
    per_block = max(1, n_periods // blocks)
    status, x, v, _total = stretch(cells, x, v, n_turn, series, q, reach)
    mean, spread = 0.0, 0.0
    for block in range(blocks):
        if status != OK:
            return status, x, v, np.nan, np.nan
        status, x, v, total = stretch(cells, x, v, per_block, series, q, reach)
        rate = total / (per_block * cells.period)
        delta = rate - mean
        mean += delta / (block + 1)
        spread += delta * (rate - mean)
    if status != OK:
        return status, x, v, np.nan, np.nan
    return OK, x, v, mean, np.sqrt(spread / max(1, blocks - 1) / blocks)
