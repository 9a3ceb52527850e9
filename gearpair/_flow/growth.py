"""How a neighbourhood of a cycle grows over a mesh period: the bound of `capture`, segment by segment."""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, kernel
from .cells import WIDTH, Cells
from .closed_form import TERMS, evaluate
from .measures import contact_stiffness
from .segment import Segment, damping_in
from .tangent import cross


class Growth(NamedTuple):
    """The bounds W of several radii, largest first, on their way over the mesh period."""

    flow: Array  # (2, 2) the variational flow since its start
    before: Array  # (2, 2) that at the start of the segment
    form: Array  # (3,) the norm's form at the start of the mesh period
    parts: int  # of a segment, smaller towards its ends, where the boundary is near
    limits: Array  # (n,) a bound beyond its limit cannot come back smaller than it began, and becomes infinite
    bounds: Array  # (n,)
    spread: Array | None  # (1,) the most that the first bound lets X be from the cycle's, where that is asked for


@kernel
def grow(growth: Growth | None, cells: Cells, segment: Segment) -> None:
    """Let the bounds grow over a segment."""
    if growth is None:
        return
    bounds, limits = growth.bounds, growth.limits
    first = 0
    while first < len(bounds) and bounds[first] == np.inf:
        first += 1
    for k in range(4):
        growth.before[k // 2, k % 2] = growth.flow[k // 2, k % 2]
    if grow_in_parts(growth, cells, segment, 1, first):
        grow_in_parts(growth, cells, segment, growth.parts, first)
        while first < len(bounds) and bounds[first] > limits[first]:
            bounds[first] = np.inf
            first += 1
    cross(growth.flow, cells, segment)


@kernel
def grow_in_parts(growth: Growth, cells: Cells, segment: Segment, parts: int, first: int) -> bool:
    """`grow` by `parts` of the segment for the bounds from `first` on; the flow becomes that at its end.

    Only one part is tried for whether any bound grows at all: where one might, nothing is done and True returned.
    """
    width, basis = cells.clock[segment.cell, WIDTH], cells.bases[cells.level[segment.cell], abs(segment.region)]
    stiffness = contact_stiffness(cells, segment.cell)
    zeta, own = damping_in(cells, segment.region), stiffness * abs(segment.region)
    step = 2.0 * (cells.damping_ratio - cells.flight_damping)
    gap, bend, gain = 0.0, 0.0, Gains(0.0, 0.0, 0.0, 0.0)
    before, jerk = 0.0, jerk_bound(segment.series, width)
    for part in range(parts + 1):
        at = segment.duration * np.sin(0.5 * np.pi * part / parts) ** 2
        p, _dp, ddp = evaluate(segment.series, at)
        fill_flow(basis, at, width, growth.before, growth.flow)
        gap1 = max(abs(p) - 1.0 if segment.region != 0 else 1.0 - abs(p), 0.0)
        bend1, gain1 = abs(ddp) / width**2, gains(growth.flow, growth.form)
        if part > 0:
            h = (at - before) * width
            # Between two points a curve is off its chord by at most h^2 / 8 times its second derivative, taken here
            # from the ends and, for the cycle, with the most that its jerk can add.
            slack = 1.1 * h * h / 8.0
            sag = slack * (max(bend, bend1) + h * jerk)
            alpha, beta = max(gain.alpha, gain1.alpha), max(gain.beta, gain1.beta)
            a = alpha + slack * (own * alpha + 2.0 * zeta * max(gain.alpha_v, gain1.alpha_v))
            beta_x = max(gain.beta_x, gain1.beta_x)
            b = beta + slack * (2.0 * zeta * beta_x + abs(4.0 * zeta * zeta - own) * beta)
            rate = h * b * abs(stiffness - 2.0 * zeta * step)
            if step != 0.0:  # the damping's part
                rate += h * abs(step) * (beta_x + slack * own * (beta_x + 2.0 * zeta * beta))
            for k in range(first, len(growth.bounds)):
                reach = a * growth.bounds[k]
                if reach <= min(gap, gap1) - sag:
                    break  # and none of the smaller ones
                if parts == 1:
                    return True
                excess = ramp(reach, gap - sag, gap1 - sag) - ramp(0.0, gap - sag, gap1 - sag)
                grown = growth.bounds[k] + rate * excess / (1.0 - rate * a) if rate * a < 1.0 else np.inf
                growth.bounds[k] = grown
            widen_spread(growth.spread, a * growth.bounds[0])
        before, gap, bend, gain = at, gap1, bend1, gain1
    return False


@kernel
def widen_spread(spread: Array | None, reach: float) -> None:
    """Widen `spread` to `reach`, where it is asked for."""
    if spread is None:
        return
    spread[0] = max(spread[0], reach)


class Gains(NamedTuple):
    """Norms of the variational flow's parts; see `capture`."""

    alpha: float  # of its first row, in the dual norm
    alpha_v: float  # of its second row
    beta: float  # of S^-1 (0, 1)'
    beta_x: float  # of S^-1 (1, 0)'


@kernel
def gains(s: Array, form: Array) -> Gains:
    """The `Gains` of a flow `s` (2, 2)."""
    a, b, c = form
    determinant = a * c - b * b
    alpha = np.sqrt((c * s[0, 0] ** 2 - 2.0 * b * s[0, 0] * s[0, 1] + a * s[0, 1] ** 2) / determinant)
    alpha_v = np.sqrt((c * s[1, 0] ** 2 - 2.0 * b * s[1, 0] * s[1, 1] + a * s[1, 1] ** 2) / determinant)
    inverse = 1.0 / (s[0, 0] * s[1, 1] - s[0, 1] * s[1, 0])
    beta = inverse * np.sqrt(a * s[0, 1] ** 2 - 2.0 * b * s[0, 1] * s[0, 0] + c * s[0, 0] ** 2)
    beta_x = inverse * np.sqrt(a * s[1, 1] ** 2 - 2.0 * b * s[1, 1] * s[1, 0] + c * s[1, 0] ** 2)
    return Gains(alpha, alpha_v, beta, beta_x)


@kernel
def fill_flow(basis: Array, at: float, width: float, before: Array, flow: Array) -> None:
    """Fill `flow` (2, 2) with the flow at the time `at` of a segment, `before` at its start."""
    xx, vx, _ = evaluate(basis[0], at)
    xv, vv, _ = evaluate(basis[1], at)
    vx, vv = vx / width, vv / width
    for k in range(2):
        flow[0, k] = xx * before[0, k] + xv * before[1, k]
        flow[1, k] = vx * before[0, k] + vv * before[1, k]


@kernel
def jerk_bound(series: Array, width: float) -> float:
    """A bound of |X'''| over the segment of a power series."""
    total = 0.0
    for n in range(TERMS - 1, 2, -1):
        total += n * (n - 1) * (n - 2) * abs(series[n])
    return total / width**3


@kernel
def ramp(c: float, a: float, b: float) -> float:
    """The mean of (c - l)_+ where l runs linearly from a to b."""
    low, high = min(a, b), max(a, b)
    if c <= low:
        return 0.0
    if c >= high:
        return c - 0.5 * (a + b)
    return 0.5 * (c - low) ** 2 / (high - low)
