"""Where a linear piece of the motion first leaves its region, with a proof that it did not leave before.

Regions are -1 (coast-side contact, X <= -1), 0 (free flight, -1 <= X <= 1) and +1 (drive-side
contact, X >= 1). The motion on the rest of a cell is a power series p(t), t from 0 to `end` <= 1. Three
certificates, cheapest first:

1. *Inside.* The cubic Hermite interpolant of p lies in the hull of its Bezier points, and p within
   `spread` >= end^4 max |p''''| / 384 of it: with the hull inside the region by more than that, p is inside.
2. *Monotone.* The interpolant's slope is off by at most (sqrt(3) / 216) end^3 max |p''''|, which is
   `MONOTONE` times the spread in the scale of differences of Bezier points: with these
   all of one sign by more than that, p is monotone, and leaves exactly where its end value says.
3. *Step by step.* From distance d >= 0 with rate u and m <= p'' over the step (towards the boundary is negative),
   no crossing can happen before the first positive root of d + u h + m h^2 / 2. Stepping by that root never
   passes a crossing; it converges quadratically on a transversal one, and where m > 0 bends the motion away a
   near miss is passed in one step. Over a step up to H, m = p''(t) + min(0, H p'''(t)) - H^2/2 max |p''''| will do; H
   is halved until the step no longer grows.
"""

import numpy as np

from ._kernel import Array, kernel
from .closed_form import TERMS, evaluate, evaluate_jerk, fourth_derivative_bound

MONOTONE = 384.0 * np.sqrt(3.0) / 216.0 / 3.0 * 1.01
ROUNDING = 2.0**-52
MAX_STEPS = 400
INSIDE, LEFT, UNDECIDED = 0, 1, 2


@kernel
def certified_step(d: float, u: float, m: float) -> float:
    """The first positive root h of ``d + u h + m h^2 / 2``, for d >= 0; inf where there is none."""
    square = u * u - 2.0 * m * d
    if square < 0.0 or (u >= 0.0 and m >= 0.0):
        return np.inf
    if u > 0.0:
        return (u + np.sqrt(square)) / -m
    if d == 0.0:
        return 0.0
    return 2.0 * d / (np.sqrt(square) - u)


@kernel
def longest_step(d: float, u: float, a: float, j: float, fourth: float, end: float) -> float:
    """The longest certified step up to `end` from distance d, derivatives u, a, j, a fourth within +-`fourth`."""
    step = 0.0
    while end > step:
        m = a + min(0.0, j * end) - 0.5 * fourth * end * end
        step = max(step, min(end, certified_step(d, u, m)))
        end *= 0.5
    return step


@kernel
def region_at(x: float, v: float, force: float, force_rate: float) -> int:
    """The region that the motion enters from (x, v): on a boundary the first non-zero derivative decides.

    At rest there no damping and no spring acts: X'' is the force, and where that is zero X''' its rate.
    """
    if x > 1.0:
        return 1
    if x < -1.0:
        return -1
    if -1.0 < x < 1.0:
        return 0
    way = v
    if way == 0.0:
        way = force
    if way == 0.0:
        way = force_rate
    if x == 1.0:
        return 1 if way > 0.0 else 0
    return -1 if way < 0.0 else 0


@kernel
def first_exit(
    series: Array, region: int, end: float, x1: float, v1: float, fourth: float
) -> tuple[int, float, float, float]:
    """When the motion first leaves `region` in (0, end].

    Returns (outcome, t, boundary, slope there): LEFT at t through X = boundary, INSIDE with t = end, or
    UNDECIDED when `MAX_STEPS` certified steps did not reach the end.

    ``x1, v1`` are value and slope (per t) at `end`; ``fourth >= max |p''''|``.
    """
    spread = fourth * end**4 / 384.0
    b0, b3 = series[0], x1
    b1 = b0 + series[1] * end / 3.0
    b2 = b3 - v1 * end / 3.0
    lowest, highest = min(min(b0, b1), min(b2, b3)), max(max(b0, b1), max(b2, b3))
    floor = -np.inf if region < 0 else 1.0 if region > 0 else -1.0
    ceiling = np.inf if region > 0 else -1.0 if region < 0 else 1.0
    if lowest - spread >= floor and highest + spread <= ceiling:
        return INSIDE, end, 0.0, v1
    margin = MONOTONE * spread
    rising = b1 - b0 > margin and b2 - b1 > margin and b3 - b2 > margin
    falling = b0 - b1 > margin and b1 - b2 > margin and b2 - b3 > margin
    if rising or falling:
        boundary = ceiling if rising else floor
        if (rising and x1 <= ceiling) or (falling and x1 >= floor):
            return INSIDE, end, 0.0, v1
        t, slope = single_root(series, boundary, end, b0, b1, b2, b3)
        return LEFT, t, boundary, slope
    return step_by_step(series, floor, ceiling, end, fourth)


@kernel
def single_root(
    series: Array, boundary: float, end: float, b0: float, b1: float, b2: float, b3: float
) -> tuple[float, float]:
    """The root of ``p(t) = boundary`` on (0, end) where p is monotone and passes the boundary, and the slope there.

    Started from the root of the cubic Hermite interpolant, then Halley's iteration kept in a bracket.
    """
    c1, c2, c3 = 3.0 * (b1 - b0), 3.0 * (b2 - 2.0 * b1 + b0), b3 - b0 + 3.0 * (b1 - b2)
    s = (boundary - b0) / (b3 - b0)
    for _ in range(2):
        cubic = b0 - boundary + s * (c1 + s * (c2 + s * c3))
        slope = c1 + s * (2.0 * c2 + s * 3.0 * c3)
        s -= cubic / slope
    sign = 1.0 if b3 > b0 else -1.0
    low, high = 0.0, end
    t, dp = s * end, 0.0
    if not low < t < high:
        t = 0.5 * end
    for _ in range(60):
        p, dp, ddp = evaluate(series, t)
        p -= boundary
        if sign * p > 0.0:
            high = t
        else:
            low = t
        newton = p / dp
        step = newton / (1.0 - 0.5 * newton * ddp / dp)
        if abs(step) <= 1e-8 * end:  # its square is below rounding
            return min(max(t - step, 0.0), end), dp - step * ddp
        t -= step
        if not low < t < high:
            t = 0.5 * (low + high)
    return t, dp


@kernel
def step_by_step(
    series: Array, floor: float, ceiling: float, end: float, fourth: float
) -> tuple[int, float, float, float]:
    """`first_exit` by certified steps alone."""
    tiny = ROUNDING * max(1.0, abs(series[0]))  # below this a distance is rounding
    t, u = 0.0, 0.0
    for _ in range(MAX_STEPS):
        p, u, a, j = evaluate_jerk(series, t)
        above, below = p - floor, ceiling - p
        if above <= tiny and u < 0.0:
            return LEFT, t, floor, u
        if below <= tiny and u > 0.0:
            return LEFT, t, ceiling, u
        rest = end - t
        step = rest
        if above < np.inf:
            step = min(step, longest_step(max(above, 0.0), u, a, j, fourth, rest))
        if below < np.inf:
            step = min(step, longest_step(max(below, 0.0), -u, -a, -j, fourth, rest))
        if min(above, below) <= tiny:
            # At rest on a boundary, or leaving it: a step that cannot pass it by more than rounding.
            step = max(step, np.sqrt(tiny / (abs(a) + abs(j) + fourth + ROUNDING)))
        t += step
        if t >= end:
            return INSIDE, end, 0.0, u
    return UNDECIDED, t, 0.0, u


@kernel
def next_turn(series: Array, t: float, end: float) -> float:
    """The first root of the slope p' in [t, end], by certified steps on the slope; inf where there is none.

    A root at `t` itself counts; to go on from a root, start a `least_step` later.
    """
    fourth = fourth_derivative_bound(series, end)
    _bend, tiny = slope_bounds(series, end)
    for _ in range(MAX_STEPS):
        _p, u, a, j = evaluate_jerk(series, t)
        if abs(u) <= tiny:
            return t
        if u < 0.0:
            u, a, j = -u, -a, -j
        t += max(longest_step(u, a, j, -fourth, 0.0, end - t), ROUNDING * end)
        if t > end:
            break
    return np.inf


@kernel
def slope_bounds(series: Array, end: float) -> tuple[float, float]:
    """A bound of the third derivative on [0, end], and the slope that is rounding (of X over a cell, too)."""
    bend, scale = 0.0, 0.0
    for n in range(TERMS - 1, 2, -1):
        bend = bend * end + n * (n - 1) * (n - 2) * abs(series[n])
    for n in range(TERMS - 1, 0, -1):
        scale = scale * end + n * abs(series[n])
    return bend, ROUNDING * max(scale, 1.0)


@kernel
def least_step(series: Array, end: float) -> float:
    """How far p' must be followed from a root for it to leave its rounding."""
    bend, tiny = slope_bounds(series, end)
    return np.sqrt(2.0 * tiny / bend)
