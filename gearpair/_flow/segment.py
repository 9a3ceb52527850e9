"""One segment of the motion: a cell's map where the motion certainly stays in its region, else a power series up to its
first exit.
"""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, inlined_kernel, kernel
from .cells import COSINE, S0, SINE, SV, SX, V0, VV, VX, WIDTH, X0, XV, XX, Cells
from .closed_form import add_shifted, evaluate, expand
from .event_search import INSIDE, first_exit, region_at


class Segment(NamedTuple):
    """A piece of the motion inside one cell and one region; times in widths of the cell."""

    period: int  # mesh period since the start of the walk
    cell: int
    start: float
    duration: float
    region: int
    left: bool  # whether it ends with a crossing
    x: float  # state at its end
    v: float
    fourth: float  # bound of the fourth derivative
    series: Array  # power series in the time since `start`


@kernel
def first_region(cells: Cells, x: float, v: float) -> int:
    """The region that the motion enters from (x, v) at the start of a mesh period."""
    return region_at(x, v, cells.start_force, cells.start_rate)


@kernel
def region_after(region: int, x: float) -> int:
    """The region beyond boundary `x`, left from `region`."""
    if region == 0:
        return 1 if x > 0.0 else -1
    return 0


@kernel
def damping_in(cells: Cells, region: int) -> float:
    """The damping ratio in a region."""
    return cells.flight_damping if region == 0 else cells.damping_ratio


@inlined_kernel
def start_segment(cells: Cells, j: int, t: float, x: float, v: float, region: int, series: Array) -> float:
    """Fill `series` with the power series in the time since t of the motion in cell `j`; bounds its fourth derivative.

    Times are in widths of the cell.
    """
    level, width = cells.level[j], cells.clock[j, WIDTH]
    contact = abs(region)
    sine, cosine = cells.clock[j, SINE], cells.clock[j, COSINE]
    if t > 0.0:
        turn = t * width * cells.phase_per_period / cells.period
        c, s = np.cos(turn), np.sin(turn)
        sine, cosine = sine * c + cosine * s, cosine * c - sine * s
    forced_fourth, p, dp = 0.0, 0.0, 0.0
    if cells.forced.shape[0] > 0:
        if t > 0.0:
            # The response to the higher harmonics runs on from the cell's start; what is left is a state without them.
            p, dp, _ = evaluate(cells.forced[j, contact], t)
            x, v = x - p, v - dp / width
        forced_fourth = cells.forced_fourths[j, contact]
    expand(cells.bases[level, contact], region, x, v, cells.force, sine, cosine, series)
    if cells.forced.shape[0] > 0:
        series[0], series[1] = series[0] + p, series[1] + dp
        add_shifted(cells.forced[j, contact], t, series)
    fourths = cells.fourths[level, contact]
    fourth = fourths[0] * abs(x - region) + fourths[1] * abs(v)
    fourth += fourths[2] * abs(cells.force) + fourths[3] * abs(sine) + fourths[4] * abs(cosine)
    return fourth + forced_fourth


@inlined_kernel
def next_segment(
    cells: Cells, j: int, t: float, x: float, v: float, region: int, series: Array
) -> tuple[int, float, float, float, float]:
    """Follow the motion in cell `j` from t to the first exit from `region` or the cell's end.

    Times are in widths of the cell. Fills `series` with the segment's power series in the time since t. Returns
    (outcome, duration, x, v, bound of the fourth derivative), x exactly on the boundary after an exit.
    """
    width = cells.clock[j, WIDTH]
    fourth = start_segment(cells, j, t, x, v, region, series)
    end = 1.0 - t
    if t == 0.0:
        x1, v1 = apply_row(cells.maps[j, region + 1], x, v)
        slope1 = v1 * width
    else:
        x1, slope1, _ = evaluate(series, end)
        v1 = slope1 / width
    outcome, duration, boundary, slope = first_exit(series, region, end, x1, slope1, fourth)
    if outcome == INSIDE:
        return outcome, end, x1, v1, fourth
    return outcome, duration, boundary, slope / width, fourth


@kernel
def apply_row(row: Array, x: float, v: float) -> tuple[float, float]:
    """The state at the end of a cell or block by the affine map in `row`."""
    return row[XX] * x + (row[XV] * v + row[X0]), row[VX] * x + (row[VV] * v + row[V0])


@kernel
def follow_row(row: Array, width: float, x: float, v: float, region: int) -> tuple[bool, float, float, float, float]:
    """The state after a time `width` by the map in `row` if the motion stays in `region`: (certain, x, v, low, high).

    ``low`` and ``high`` bound X on the way, from the map's spread; the certificate is the first of `event_search`.
    """
    x1, v1 = apply_row(row, x, v)
    third = width / 3.0
    b1, b2 = x + third * v, x1 - third * v1
    spread = row[SX] * abs(x - region) + (row[SV] * abs(v) + row[S0])
    low = min(min(x, b1), min(b2, x1)) - spread
    high = max(max(x, b1), max(b2, x1)) + spread
    certain = (region < 0 or low >= 2.0 * region - 1.0) and (region > 0 or high <= 2.0 * region + 1.0)
    return certain, x1, v1, low, high
