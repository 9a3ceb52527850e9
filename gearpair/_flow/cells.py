"""The mesh period of one oscillator cut into cells, with everything that does not depend on the state.

On a cell that stays in one region (coast-side contact, free flight, drive-side contact) the state at
its end is an affine function of the state at its start. These maps, with the constants that certify
that no crossing happens inside, are computed once per oscillator; the march then needs a few
multiply-adds a cell.
"""

from typing import NamedTuple

import numpy as np

from ._kernel import kernel
from .closed_form import DEGREE, REACH, TERMS, fastest_rate, fill_basis, fourth_derivative_bound

# Columns of `Cells.maps`: x1 = XX x + XV v + X0, v1 = VX x + VV v + V0, and the spread
# SX |x - s| + SV |v| + S0 >= max |w^4 X''''| / 384 over the cell.
XX, XV, X0, VX, VV, V0, SX, SV, S0 = range(9)
COLUMNS = 9
# Columns of `Cells.clock`: width of the cell, its start in mesh periods, sine and cosine of the forcing there.
WIDTH, START, SINE, COSINE = range(4)


# Beyond this the backlash is below a millionth of the motion, which the always-in-contact equation then
# governs: where that is parametrically unstable, the motion never comes back.
ESCAPE_RADIUS = 1e6


class Parameters(NamedTuple):
    """The oscillator as plain floats and arrays (numba rejects dataclasses)."""

    mean_force: float
    error_amplitude: float
    error_phase: float
    damping_ratio: float
    mesh_frequency: float
    edges: np.ndarray  # (n_levels + 1,), from 0 to 1
    levels: np.ndarray  # (n_levels,)


class Cells(NamedTuple):
    """One oscillator, ready to march; see the module's text. Regions are indexed 0, 1, 2 for -1, 0, 1."""

    force: float
    amplitude: float  # A = F_ah Omega^2
    turn: float  # 2 pi, the forcing's phase over a mesh period
    clock: np.ndarray  # (n_cells, 4)
    level: np.ndarray  # (n_cells,) index of the stiffness level
    maps: np.ndarray  # (n_cells, 3, COLUMNS)
    bases: np.ndarray  # (n_levels, 2, 5, TERMS), free flight and contact
    fourths: np.ndarray  # (n_levels, 2, 5) bounds of their fourth derivatives
    period: float
    damping_ratio: float
    escape_radius: float  # |X| + |X'| from which no motion comes back


@kernel
def count_cells(p, level):
    """How many cells one stiffness level needs."""
    rate = fastest_rate(p.levels[level], p.damping_ratio, p.mesh_frequency)
    rate = max(rate, 2.0 * p.damping_ratio)
    span = (p.edges[level + 1] - p.edges[level]) * 2.0 * np.pi / p.mesh_frequency
    return max(1, int(np.ceil(span * rate / REACH)))


@kernel
def build_cells(p):
    """Cut the mesh period of oscillator `p` into cells."""
    n_levels = p.levels.size
    n_cells = 0
    for i in range(n_levels):
        n_cells += count_cells(p, i)
    cells = Cells(
        p.mean_force,
        p.error_amplitude * p.mesh_frequency**2,
        2.0 * np.pi,
        np.empty((n_cells, 4)),
        np.empty(n_cells, np.int64),
        np.empty((n_cells, 3, COLUMNS)),
        np.empty((n_levels, 2, 5, TERMS)),
        np.empty((n_levels, 2, 5)),
        2.0 * np.pi / p.mesh_frequency,
        p.damping_ratio,
        ESCAPE_RADIUS if contact_growth(p) > 1.0 else np.inf,
    )
    j = 0
    for i in range(n_levels):
        n = count_cells(p, i)
        span = (p.edges[i + 1] - p.edges[i]) / n
        width = span * cells.period
        fill_basis(0.0, p.damping_ratio, p.mesh_frequency, width, cells.bases[i, 0])
        fill_basis(p.levels[i], p.damping_ratio, p.mesh_frequency, width, cells.bases[i, 1])
        for contact in range(2):
            for k in range(5):
                cells.fourths[i, contact, k] = fourth_derivative_bound(cells.bases[i, contact, k], 1.0)
        for m in range(n):
            start = p.edges[i] + m * span
            theta = cells.turn * start + p.error_phase
            cells.clock[j, WIDTH] = width
            cells.clock[j, START] = start
            cells.clock[j, SINE] = cells.amplitude * np.sin(theta)
            cells.clock[j, COSINE] = cells.amplitude * np.cos(theta)
            cells.level[j] = i
            for region in range(3):
                fill_map(cells, j, region)
            j += 1
    return cells


@kernel
def contact_growth(p):
    """The larger multiplier's modulus of the always-in-contact motion over a mesh period (Floquet).

    Its determinant is exp(-2 zeta T), so the trace decides.
    """
    xx, xv, vx, vv = 1.0, 0.0, 0.0, 1.0
    zeta = p.damping_ratio
    period = 2.0 * np.pi / p.mesh_frequency
    for i in range(p.levels.size):
        span = (p.edges[i + 1] - p.edges[i]) * period
        # Without the common factor exp(-zeta span), which is put back at the end.
        square = p.levels[i] - zeta * zeta
        rate = np.sqrt(abs(square))
        if square > 0.0:
            c, s, ds = np.cos(rate * span), np.sin(rate * span) / rate, -square
        elif square < 0.0:
            c, s, ds = np.cosh(rate * span), np.sinh(rate * span) / rate, -square
        else:
            c, s, ds = 1.0, span, 0.0
        a, b, e, d = c + zeta * s, s, (ds - zeta * zeta) * s, c - zeta * s
        xx, xv, vx, vv = a * xx + b * vx, a * xv + b * vv, e * xx + d * vx, e * xv + d * vv
    half = 0.5 * abs(xx + vv)
    return (half + np.sqrt(max(half * half - 1.0, 0.0))) * np.exp(-zeta * period)


@kernel
def fill_map(cells, j, region):
    """The affine map of cell `j` in one region, and its spread."""
    basis = cells.bases[cells.level[j], abs(region - 1)]
    shift = region - 1.0
    width, sine, cosine = cells.clock[j, WIDTH], cells.clock[j, SINE], cells.clock[j, COSINE]
    row = cells.maps[j, region]
    ends = np.zeros((2, 5))
    for k in range(5):
        for n in range(DEGREE, -1, -1):
            ends[0, k] += basis[k, n]
            ends[1, k] += n * basis[k, n] / width
    row[XX], row[XV] = ends[0, 0], ends[0, 1]
    row[VX], row[VV] = ends[1, 0], ends[1, 1]
    row[X0] = ends[0, 2] * cells.force + ends[0, 3] * sine + ends[0, 4] * cosine + shift * (1.0 - ends[0, 0])
    row[V0] = ends[1, 2] * cells.force + ends[1, 3] * sine + ends[1, 4] * cosine - shift * ends[1, 0]
    fourths = cells.fourths[cells.level[j], abs(region - 1)]
    row[SX], row[SV] = fourths[0] / 384.0, fourths[1] / 384.0
    row[S0] = (fourths[2] * abs(cells.force) + fourths[3] * abs(sine) + fourths[4] * abs(cosine)) / 384.0
