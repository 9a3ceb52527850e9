"""Neighbourhoods of a stable cycle that no motion leaves: what enters one has settled, however far it still is.

Let X* be the cycle, S(tau) its variational flow from the start of a mesh period and X = X* + d. The force is
piecewise linear, so d obeys the variational equation but for a force of modulus at most

    k (|d| - D)_+,    D(tau) = the distance of X* from the nearer of X = +-1,

since X and X* feel different slopes only when a boundary lies between them. This holds at a grazing too. In
w = S^-1 d, measured by a norm |w|_Q^2 = w' Q w, the mesh period's bound W >= |w|_Q therefore grows by

    W' <= beta k (alpha W - D)_+,    alpha = |first row of S|_(Q^-1),  beta = |S^-1 (0, 1)'|_Q,

and the section points of the cycle have norms Q_0, Q_1, ... in which S contracts from each to the next (from Lyapunov's
equation). A radius r whose bound comes back smaller over the whole cycle does so for every smaller radius, as
the right side grows faster than W: all that starts within r converges to the cycle.
"""

import numpy as np

from ._kernel import allocating_kernel, kernel
from .cells import WIDTH
from .closed_form import TERMS, evaluate
from .event_search import INSIDE
from .march import OK, first_region, next_segment, region_after
from .tangent import apply, march_tangent

# Columns of a neighbourhood: its centre, its form (QXX dx^2 + 2 QXV dx dv + QVV dv^2 <= 1) and whose it is.
X, V, QXX, QXV, QVV, OWNER = range(6)
COLUMNS = 6

# Contraction asked of the norms, as a power of the cycle's own: the nearer to 1, the more they are stretched.
SHARPNESS = 0.95
LARGEST, RATIO, RADII = 2.0, 0.8, 60  # radii tried, from the largest down
# Parts of a segment, smaller towards its ends, where the boundary is near; a cycle that nearly grazes needs more.
PARTS = (8, 32)
LEAST = 1e-6  # a smaller neighbourhood says no more than a return does


@kernel
def inside(neighbourhoods, n, x, v):
    """The first of `n` neighbourhoods that holds (x, v), or -1."""
    for i in range(n):
        row = neighbourhoods[i]
        dx, dv = x - row[X], v - row[V]
        if row[QXX] * dx * dx + 2.0 * row[QXV] * dx * dv + row[QVV] * dv * dv <= 1.0:
            return i
    return -1


@allocating_kernel
def surround(cells, x, v, period, owner, rows, series):
    """Certify a neighbourhood of each section point of the stable cycle through (x, v): whether there are any."""
    steps = np.empty((period, 2, 2))
    for i in range(period):
        rows[i, X], rows[i, V], rows[i, OWNER] = x, v, owner
        step = steps[i]
        step[0, 0], step[0, 1], step[1, 0], step[1, 1] = 1.0, 0.0, 0.0, 1.0
        status, x, v = march_tangent(cells, x, v, 1, step, series)
        if status != OK:
            return False
    forms = np.empty((period + 1, 3))
    factors = np.empty(period)
    if not contracting_norms(steps, forms, factors):
        return False
    radii = np.empty(RADII)
    radii[0] = LARGEST
    for k in range(1, RADII):
        radii[k] = RATIO * radii[k - 1]
    bounds = np.empty((period + 1, RADII))
    for parts in PARTS:
        bounds[0] = radii
        limits = radii / np.prod(factors)
        for i in range(period):
            bounds[i + 1] = bounds[i]
            grow(cells, rows[i, X], rows[i, V], forms[i], parts, limits, bounds[i + 1], series)
            bounds[i + 1] *= factors[i]
            limits *= factors[i]
        for k in range(RADII):
            if radii[k] > LEAST and bounds[period, k] < (1.0 - 1e-6) * radii[k]:
                for i in range(period):
                    scale = 1.0 / bounds[i, k] ** 2
                    rows[i, QXX], rows[i, QXV], rows[i, QVV] = (
                        forms[i, 0] * scale,
                        forms[i, 1] * scale,
                        forms[i, 2] * scale,
                    )
                return True
    return False


@kernel
def transform(form, m):
    """The form ``m' Q m`` as (xx, xv, vv)."""
    a, b, c = form
    xx = a * m[0, 0] ** 2 + 2.0 * b * m[0, 0] * m[1, 0] + c * m[1, 0] ** 2
    xv = a * m[0, 0] * m[0, 1] + b * (m[0, 0] * m[1, 1] + m[0, 1] * m[1, 0]) + c * m[1, 0] * m[1, 1]
    vv = a * m[0, 1] ** 2 + 2.0 * b * m[0, 1] * m[1, 1] + c * m[1, 1] ** 2
    return xx, xv, vv


@allocating_kernel
def contracting_norms(steps, forms, factors):
    """Forms Q_i with ``S_i' Q_(i+1) S_i <= factors_i^2 Q_i``, all factors below 1: whether there are any.

    They solve ``Q_i = 1 + S_i' Q_(i+1) S_i / g^2`` around the cycle.
    """
    period = len(steps)
    m = np.eye(2)
    for i in range(period):
        apply(steps[i, 0, 0], steps[i, 0, 1], steps[i, 1, 0], steps[i, 1, 1], m)
    half, determinant = 0.5 * (m[0, 0] + m[1, 1]), m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
    square = half * half - determinant
    radius = np.sqrt(determinant) if square < 0.0 else abs(half) + np.sqrt(square)
    if not radius < 1.0:
        return False
    g = max(radius, 1e-12) ** (SHARPNESS / period)
    # What one turn adds, then the sum over all turns by doubling.
    form = (0.0, 0.0, 0.0)
    for i in range(period - 1, -1, -1):
        xx, xv, vv = transform(form, steps[i])
        form = 1.0 + xx / g**2, xv / g**2, 1.0 + vv / g**2
    n = m / g**period
    for _ in range(60):
        xx, xv, vv = transform(form, n)
        form = form[0] + xx, form[1] + xv, form[2] + vv
        apply(n[0, 0], n[0, 1], n[1, 0], n[1, 1], n)
        if np.abs(n).max() < 1e-20:
            break
    for i in range(period - 1, -1, -1):
        forms[i + 1, 0], forms[i + 1, 1], forms[i + 1, 2] = form
        xx, xv, vv = transform(form, steps[i])
        form = 1.0 + xx / g**2, xv / g**2, 1.0 + vv / g**2
        middle = 0.5 * (form[0] + form[2])
        largest = middle + np.hypot(0.5 * (form[0] - form[2]), form[1])
        factors[i] = g * np.sqrt(1.0 - 1.0 / largest)
    forms[0, 0], forms[0, 1], forms[0, 2] = form
    return form[0] < 1e12 and form[2] < 1e12


@allocating_kernel
def grow(cells, x, v, form, parts, limits, bounds, series):
    """Let the bounds W of several radii, largest first, grow over the mesh period from (x, v) of the cycle.

    A bound beyond its limit cannot come back smaller than it began, and becomes infinite.
    """
    s = np.eye(2)
    largest = np.sum(bounds == np.inf)  # the first finite bound
    region = first_region(cells, x, v)
    for j in range(cells.level.size):
        t = 0.0
        while True:
            outcome, duration, x, v = next_segment(cells, j, t, x, v, region, series)
            start = s.copy()
            if grow_segment(cells, j, region, duration, series, start, s, form, 1, bounds[largest:]):
                grow_segment(cells, j, region, duration, series, start, s, form, parts, bounds[largest:])
                while largest < len(bounds) and bounds[largest] > limits[largest]:
                    bounds[largest] = np.inf
                    largest += 1
            if outcome == INSIDE:
                break
            t += duration
            region = region_after(region, x)


@allocating_kernel
def grow_segment(cells, j, region, duration, series, start, s, form, parts, bounds):
    """`grow` over one segment of cell `j`; `s` becomes the variational flow at its end, from `start`.

    Only one part is tried for whether any bound grows at all: where one might, nothing is done and True returned.
    """
    width, level = cells.clock[j, WIDTH], cells.level[j]
    basis = cells.bases[level, abs(region)]
    stiffness = -2.0 * cells.bases[level, 1, 0, 2] / width**2
    zeta, own = cells.damping_ratio, stiffness * abs(region)
    gap, bend, alpha, alpha_v, beta, beta_x = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    before, jerk = 0.0, jerk_bound(series, width)
    for part in range(parts + 1):
        at = duration * np.sin(0.5 * np.pi * part / parts) ** 2
        p, _dp, ddp = evaluate(series, at)
        xx, vx, _ = evaluate(basis[0], at)
        xv, vv, _ = evaluate(basis[1], at)
        vx, vv = vx / width, vv / width
        for k in range(2):
            s[0, k] = xx * start[0, k] + xv * start[1, k]
            s[1, k] = vx * start[0, k] + vv * start[1, k]
        gap1 = max(abs(p) - 1.0 if region != 0 else 1.0 - abs(p), 0.0)
        bend1 = abs(ddp) / width**2
        alpha1, alpha_v1, beta1, beta_x1 = gains(s, form)
        if part > 0:
            h = (at - before) * width
            # Between two points a curve is off its chord by at most h^2 / 8 times its second derivative, taken here
            # from the ends and, for the cycle, with the most that its jerk can add.
            slack = 1.1 * h * h / 8.0
            sag = slack * (max(bend, bend1) + h * jerk)
            a = max(alpha, alpha1) + slack * (own * max(alpha, alpha1) + 2.0 * zeta * max(alpha_v, alpha_v1))
            b = max(beta, beta1) + slack * (
                2.0 * zeta * max(beta_x, beta_x1) + abs(4.0 * zeta * zeta - own) * max(beta, beta1)
            )
            for k in range(len(bounds)):
                reach = a * bounds[k]
                if reach <= min(gap, gap1) - sag:
                    break  # and none of the smaller ones
                if parts == 1:
                    return True
                excess = ramp(reach, gap - sag, gap1 - sag) - ramp(0.0, gap - sag, gap1 - sag)
                rate = h * b * stiffness
                bounds[k] = bounds[k] + rate * excess / (1.0 - rate * a) if rate * a < 1.0 else np.inf
        before, gap, bend, alpha, alpha_v, beta, beta_x = at, gap1, bend1, alpha1, alpha_v1, beta1, beta_x1
    return False


@kernel
def jerk_bound(series, width):
    """A bound of |X'''| over the segment of a power series."""
    total = 0.0
    for n in range(TERMS - 1, 2, -1):
        total += n * (n - 1) * (n - 2) * abs(series[n])
    return total / width**3


@kernel
def gains(s, form):
    """|first row of S|, |second row of S| in the dual norm; |S^-1 (0, 1)'|, |S^-1 (1, 0)'| in the norm."""
    a, b, c = form
    determinant = a * c - b * b
    alpha = np.sqrt((c * s[0, 0] ** 2 - 2.0 * b * s[0, 0] * s[0, 1] + a * s[0, 1] ** 2) / determinant)
    alpha_v = np.sqrt((c * s[1, 0] ** 2 - 2.0 * b * s[1, 0] * s[1, 1] + a * s[1, 1] ** 2) / determinant)
    inverse = 1.0 / (s[0, 0] * s[1, 1] - s[0, 1] * s[1, 0])
    beta = inverse * np.sqrt(a * s[0, 1] ** 2 - 2.0 * b * s[0, 1] * s[0, 0] + c * s[0, 0] ** 2)
    beta_x = inverse * np.sqrt(a * s[1, 1] ** 2 - 2.0 * b * s[1, 1] * s[1, 0] + c * s[1, 0] ** 2)
    return alpha, alpha_v, beta, beta_x


@kernel
def ramp(c, a, b):
    """The mean of (c - l)_+ where l runs linearly from a to b."""
    low, high = min(a, b), max(a, b)
    if c <= low:
        return 0.0
    if c >= high:
        return c - 0.5 * (a + b)
    return 0.5 * (c - low) ** 2 / (high - low)
