"""The search for the stable orbit of a motion: where it returns near itself, and where it is near already."""

import numpy as np

from ._kernel import Array, kernel
from .capture import V, X, inside, surround
from .cells import Cells
from .newton import NEWTON_STEPS, SAME_POINT, distance, minimal_period, newton
from .states import Course, Orbit, Scratch
from .walk import OK, walk

# A return as close as PROMISING, relative to max(1, |X|, |X'|), is worth a Newton search for a stable orbit whose
# neighbourhood may capture the motion: a short one, for most are in vain.
PROMISING, FEW_STEPS = 1e-2, 7
# The trace of a stable orbit is below 2 in modulus; a search is given up where it exceeds this.
MOST_TRACE = 10.0
# A return as close as this is as good as one in full.
RETURNED = 1e-8
# Multipliers nearer to the unit circle than this attract nothing in any time; without damping they lie on it.
STABLE = 1.0 - 1e-9
# After the whole transient slower motions count too: a stable orbit within NEAR that the motion approaches.
NEAR = 1e-2


@kernel
def spectral_radius(m: Array) -> float:
    """The larger modulus of the eigenvalues of a 2 x 2 matrix."""
    half = 0.5 * (m[0, 0] + m[1, 1])
    determinant = m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
    square = half * half - determinant
    if square < 0.0:
        return np.sqrt(determinant)
    return abs(half) + np.sqrt(square)


@kernel
def smallest_point(cells: Cells, x: float, v: float, period: int, series: Array) -> tuple[float, float]:
    """The point of a cycle with the smallest X on the section; of points with the same X that with the smaller X'."""
    xs, vs = x, v
    for _ in range(period - 1):
        _status, x, v = walk(cells, x, v, 1, series)
        if x < xs - SAME_POINT or (x <= xs + SAME_POINT and v < vs):
            xs, vs = x, v
    return xs, vs


@kernel
def stable_orbit(cells: Cells, x: float, v: float, period: int, steps: int, most_trace: float, work: Scratch) -> Orbit:
    """The stable orbit that Newton's method finds from (x, v)."""
    converged, xs, vs, _residual = newton(cells, x, v, period, work.m, work.series, steps, most_trace)
    if converged and spectral_radius(work.m) < STABLE:
        return Orbit(minimal_period(cells, xs, vs, period, work.series), xs, vs, 0)
    return Orbit(0, xs, vs, 0)


@kernel
def beside(neighbourhoods: Array, n: int, x: float, v: float) -> bool:
    """Whether (x, v) is near the centre of one of the first `n` neighbourhoods: that it returns there is no news."""
    nearest = np.inf
    for i in range(n):
        nearest = min(nearest, distance(x, v, neighbourhoods[i, X], neighbourhoods[i, V]))
    return nearest <= PROMISING


@kernel
def attempt(
    cells: Cells, x: float, v: float, within: int, gap: float, orbit: Orbit, work: Scratch
) -> tuple[bool, Orbit]:
    """A search for the orbit of a motion that returned to within `gap` after `within` periods: (found, orbit).

    Not found, or one of a known attractor: the `orbit` of the last search stays. One that is new is surrounded.
    """
    rows, n_known = work.neighbourhoods, len(work.known.neighbourhoods)
    steps, most_trace = (NEWTON_STEPS, np.inf) if gap <= RETURNED else (FEW_STEPS, MOST_TRACE)
    found = stable_orbit(cells, x, v, within, steps, most_trace, work)
    if found.period == 0 or inside(rows, n_known, found.x, found.v) >= 0:
        return False, orbit
    n = orbit.n_neighbourhoods
    same = orbit.period > 0 and distance(found.x, found.v, orbit.x, orbit.v) <= SAME_POINT
    if not same and inside(rows, n_known + n, found.x, found.v) < 0:
        # From the same point of the cycle, whoever finds it.
        xs, vs = smallest_point(cells, found.x, found.v, found.period, work.series)
        certain = surround(cells, xs, vs, found.period, -1.0, rows[n_known:], work.series)
        n = found.period if certain else 0
    return True, Orbit(found.period, found.x, found.v, n)


@kernel
def approached(cells: Cells, x: float, v: float, max_period: int, work: Scratch) -> Course:
    """Walk until the motion returns to a stable orbit that it slowly approaches, `max_period` periods at most.

    The orbit lies within `NEAR`, and comes nearer over twenty of its cycles.
    """
    x0, v0 = x, v
    for within in range(1, max_period + 1):
        status, x, v = walk(cells, x, v, 1, work.series)
        if status != OK:
            return Course(status, x, v, -1, Orbit(0, x, v, 0))
        if distance(x, v, x0, v0) > NEAR:
            continue
        orbit = stable_orbit(cells, x, v, within, NEWTON_STEPS, MOST_TRACE, work)
        before = distance(x, v, orbit.x, orbit.v)
        if orbit.period > 0 and before <= NEAR:
            status, x, v = walk(cells, x, v, 20 * orbit.period, work.series)
            if status != OK or distance(x, v, orbit.x, orbit.v) > max(before, RETURNED):
                orbit = Orbit(0, x, v, 0)
            return Course(status, x, v, -1, orbit)
    return Course(OK, x, v, -1, Orbit(0, x, v, 0))
