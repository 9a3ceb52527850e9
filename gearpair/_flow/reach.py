"""How far a walk reaches: the exact range of X, and the contacts of each side.

A `reach` is an array (4,) of the columns below. Where none is asked for it is None, and these kernels do nothing.
"""

from ._kernel import Array, inlined_kernel, kernel
from .cells import WIDTH, Cells
from .closed_form import evaluate, fourth_derivative_bound
from .event_search import MONOTONE, least_step, next_turn
from .segment import Segment, region_after

LOWEST, HIGHEST, DRIVE, COAST = range(4)  # smallest and largest X; contacts made on each side


@kernel
def begin_reach(reach: Array, x: float) -> None:
    """Begin at `x`, with no contacts."""
    reach[LOWEST], reach[HIGHEST], reach[DRIVE], reach[COAST] = x, x, 0.0, 0.0


@inlined_kernel
def holds(reach: Array | None, low: float, high: float) -> bool:
    """Whether nothing within [low, high] is new."""
    if reach is None:
        return True
    return low >= reach[LOWEST] and high <= reach[HIGHEST]


@inlined_kernel
def widen(reach: Array | None, cells: Cells, segment: Segment) -> None:
    """Widen the range to that of a segment, and count the contact that it ends with."""
    if reach is None:
        return
    slope = segment.v * cells.clock[segment.cell, WIDTH]
    reach[LOWEST], reach[HIGHEST] = segment_extremes(
        segment.series, segment.duration, segment.x, slope, reach[LOWEST], reach[HIGHEST]
    )
    if segment.left:
        region = region_after(segment.region, segment.x)
        reach[DRIVE] += region == 1
        reach[COAST] += region == -1


@kernel
def segment_extremes(series: Array, end: float, x: float, slope: float, low: float, high: float) -> tuple[float, float]:
    """Widen [low, high] to the range of the power series on [0, end], where it ends at `x` with `slope`.

    The certificates are those of `event_search`: within [low, high], monotone, or with a curvature of one sign and so
    of one turn at most. Where none holds, every root of the slope is looked for.
    """
    b0, b1, b2, b3 = series[0], series[0] + series[1] * end / 3.0, x - slope * end / 3.0, x
    fourth = fourth_derivative_bound(series, end)
    spread = fourth * end**4 / 384.0
    if min(min(b0, b1), min(b2, b3)) - spread >= low and max(max(b0, b1), max(b2, b3)) + spread <= high:
        return low, high
    low, high = min(low, min(b0, b3)), max(high, max(b0, b3))
    margin = MONOTONE * spread
    rise = min(b1 - b0, min(b2 - b1, b3 - b2))
    fall = min(b0 - b1, min(b1 - b2, b2 - b3))
    if max(rise, fall) > margin:
        return low, high
    _p, _dp, bend = evaluate(series, end)
    sag = fourth * end * end / 8.0  # between its ends the curvature is off its chord by at most this
    if min(2.0 * series[2], bend) > sag or max(2.0 * series[2], bend) < -sag:
        if series[1] * slope < 0.0:
            p = only_turn(series, end, slope)
            low, high = min(low, p), max(high, p)
        return low, high
    t = next_turn(series, 0.0, end)
    while t <= end:
        p, _dp, _ddp = evaluate(series, t)
        low, high = min(low, p), max(high, p)
        t = next_turn(series, t + least_step(series, end), end)
    return low, high


@kernel
def only_turn(series: Array, end: float, slope: float) -> float:
    """The extremum inside [0, end] of a power series whose curvature keeps its sign and whose slope ends at `slope`."""
    before, after = 0.0, end
    t = end * series[1] / (series[1] - slope)
    p = series[0]
    for _ in range(60):
        p, dp, ddp = evaluate(series, t)
        step = dp / ddp
        if abs(step) <= 1e-6 * end:  # its cube is below rounding
            return p - 0.5 * step * dp
        if dp * slope > 0.0:
            after = t
        else:
            before = t
        t -= step
        if not before < t < after:
            t = 0.5 * (before + after)
    return p
