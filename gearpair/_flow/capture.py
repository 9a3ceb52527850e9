"""Neighbourhoods of a stable cycle that no motion leaves: what enters one has settled, however far it still is.

Let X* be the cycle, S(tau) its variational flow from the start of a mesh period and X = X* + d. The force is
piecewise linear, so d obeys the variational equation but for a force of modulus at most

    k (|d| - D)_+,    D(tau) = the distance of X* from the nearer of X = +-1,

since X and X* feel different slopes only when a boundary lies between them. This holds at a grazing too. In
w = S^-1 d, measured by a norm |w|_Q^2 = w' Q w, the mesh period's bound W >= |w|_Q therefore grows by

    W' <= beta k (alpha W - D)_+,    alpha = |first row of S|_(Q^-1),  beta = |S^-1 (0, 1)'|_Q,

and the section points of the cycle have norms Q_0, Q_1, ... in which S contracts from each to the next (from Lyapunov's
equation). A radius r whose bound comes back smaller over the whole cycle does so for every smaller radius, as
the right side grows faster than W: all that starts within r converges to the cycle. For the same reason a motion that
starts within s r, s <= 1, is for ever within s times the most that ``|d| <= alpha W`` allows from r on: the spread.

With another damping ratio in free flight it is X' + 2 zeta X that has no jump (`tangent`), and d its difference in
that. Damping adds a term to the rate of d as the force does: (2 (zeta - zeta_f), k - 4 zeta* (zeta - zeta_f))', zeta*
being the cycle's at the time, takes the place of (0, k)' in k beta. On the section d is what the motions differ by in
X' but for 2 (zeta - zeta_f) (|d| - D)_+ at most, which `shear` adds.
"""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, Integers, allocating_kernel, kernel
from .cells import Cells
from .closed_form import TERMS
from .growth import Growth, gains
from .newton import derivative
from .tangent import apply, set_identity
from .walk import OK, Details, walk

# Columns of a neighbourhood: its centre, its form (QXX dx^2 + 2 QXV dx dv + QVV dv^2 <= 1), whose it is, and how far X
# may ever be from the cycle's where the motion enters at the edge.
X, V, QXX, QXV, QVV, OWNER, SPREAD = range(7)
COLUMNS = 7

# Contraction asked of the norms, as a power of the cycle's own: the nearer to 1, the more they are stretched.
SHARPNESS = 0.95
LARGEST, RATIO, RADII = 2.0, 0.8, 60  # radii tried, from the largest down
# Parts of a segment, smaller towards its ends, where the boundary is near; a cycle that nearly grazes needs more.
PARTS = (8, 32)
LEAST = 1e-6  # a smaller neighbourhood says no more than a return does


@kernel
def inside(neighbourhoods: Array, n: int, x: float, v: float) -> int:
    """The first of `n` neighbourhoods that holds (x, v), or -1."""
    for i in range(n):
        if square(neighbourhoods[i], x, v) <= 1.0:
            return i
    return -1


@kernel
def square(row: Array, x: float, v: float) -> float:
    """The form of a neighbourhood at (x, v): the square of its distance from the centre, 1 at the edge."""
    dx, dv = x - row[X], v - row[V]
    return row[QXX] * dx * dx + 2.0 * row[QXV] * dx * dv + row[QVV] * dv * dv


@allocating_kernel
def surround(cells: Cells, x: float, v: float, period: int, owner: float, rows: Array, series: Array) -> bool:
    """Certify a neighbourhood of each section point of the stable cycle through (x, v): whether there are any."""
    steps = np.empty((period, 2, 2))
    for i in range(period):
        rows[i, X], rows[i, V], rows[i, OWNER] = x, v, owner
        status, x, v = derivative(cells, x, v, 1, steps[i], series)
        if status != OK:
            return False
    forms, factors = np.empty((period + 1, 3)), np.empty(period)
    if not contracting_norms(steps, forms, factors):
        return False
    radii = np.full(RADII, LARGEST)
    for k in range(1, RADII):
        radii[k] = RATIO * radii[k - 1]
    bounds = np.empty((period + 1, RADII))
    for parts in PARTS:
        bounds[0] = radii
        if not grow_around(cells, rows, Norms(forms, factors), parts, bounds, None, series):
            return False
        for k in range(RADII):
            if radii[k] > LEAST and bounds[period, k] < (1.0 - 1e-6) * radii[k]:
                alone, spread = bounds[:, k : k + 1].copy(), np.zeros(1)
                grow_around(cells, rows, Norms(forms, factors), parts, alone, spread, series)
                for i in range(period):
                    rows[i, QXX : QVV + 1] = forms[i] * (1.0 / bounds[i, k] ** 2)
                    rows[i, SPREAD] = spread[0]
                return True
    return False


@allocating_kernel
def surround_rows(cells: Cells, points: Array, periods: Integers, rows: Array) -> int:
    """Neighbourhoods of the cycles through `points` (n, 2), filled into `rows`: how many there are."""
    series = np.empty(TERMS)
    filled = 0
    for i in range(len(points)):
        if periods[i] > 0 and surround(cells, points[i, 0], points[i, 1], periods[i], float(i), rows[filled:], series):
            filled += periods[i]
    return filled


class Norms(NamedTuple):
    """The norms in which the neighbourhoods of a cycle are measured."""

    forms: Array  # (period + 1, 3)
    factors: Array  # (period,) by which each mesh period contracts


@allocating_kernel
def grow_around(
    cells: Cells, rows: Array, norms: Norms, parts: int, bounds: Array, spread: Array | None, series: Array
) -> bool:
    """Let the first row of `bounds` grow around the cycle, a row a mesh period: whether it could be followed.

    A bound beyond its limit cannot come back smaller than it began, and becomes infinite. `spread` (1,) is widened to
    the most that the first, largest, bound lets X be from the cycle's.
    """
    forms, factors = norms
    flow, before = np.empty((2, 2)), np.empty((2, 2))
    limits = bounds[0] / np.prod(factors)
    for i in range(len(factors)):
        set_identity(flow)
        bounds[i + 1] = bounds[i]
        shear(cells, rows[i, X], forms[i], flow, bounds[i + 1])
        growth = Growth(flow, before, forms[i], parts, limits, bounds[i + 1], spread)
        details = Details(None, None, None, None, growth)
        status, _x, _v = walk(cells, rows[i, X], rows[i, V], 1, series, None, None, details)
        if status != OK:
            return False
        bounds[i + 1] *= factors[i]
        set_identity(flow)
        shear(cells, rows[(i + 1) % len(factors), X], forms[i + 1], flow, bounds[i + 1])
        limits *= factors[i]
    return True


@kernel
def shear(cells: Cells, x: float, form: Array, identity: Array, bounds: Array) -> None:
    """Widen `bounds` at the section point `x` of a cycle by what damping in contact and in flight makes of X'."""
    step = 2.0 * abs(cells.damping_ratio - cells.flight_damping)
    if step > 0.0:
        gain = gains(identity, form)
        for k in range(len(bounds)):
            bounds[k] += step * gain.beta * max(gain.alpha * bounds[k] - abs(abs(x) - 1.0), 0.0)


@kernel
def transform(form: Array | tuple[float, float, float], m: Array) -> tuple[float, float, float]:
    """The form ``m' Q m`` as (xx, xv, vv)."""
    a, b, c = form
    xx = a * m[0, 0] ** 2 + 2.0 * b * m[0, 0] * m[1, 0] + c * m[1, 0] ** 2
    xv = a * m[0, 0] * m[0, 1] + b * (m[0, 0] * m[1, 1] + m[0, 1] * m[1, 0]) + c * m[1, 0] * m[1, 1]
    vv = a * m[0, 1] ** 2 + 2.0 * b * m[0, 1] * m[1, 1] + c * m[1, 1] ** 2
    return xx, xv, vv


@allocating_kernel
def contracting_norms(steps: Array, forms: Array, factors: Array) -> bool:
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
