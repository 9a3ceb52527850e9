"""The base period of one oscillator cut into cells, with everything that does not depend on the state.

That is the mesh period, or as many of them as an error of a shaft takes to repeat.

On a cell that stays in one region (coast-side contact, free flight, drive-side contact) the state at
its end is an affine function of the state at its start. These maps, with the constants that certify
that no crossing happens inside, are computed once per oscillator; the walk then needs a few
multiply-adds a cell.

Higher harmonics of the transmission error turn faster, so the cells are narrower. Those that would be one cell without
them form a *block* with maps and constants of its own: where a block certainly stays in one region the walk takes
it in one step, and the harmonics cost nothing there.
"""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, Integers, allocating_kernel, inlined_kernel, kernel
from .closed_form import (
    AMPLITUDE,
    DEGREE,
    ORDER,
    PHASE,
    REACH,
    TERMS,
    fastest_rate,
    fill_basis,
    fill_forced,
    fourth_derivative_bound,
)

# Columns of `Cells.maps`: x1 = XX x + XV v + X0, v1 = VX x + VV v + V0, and the spread
# SX |x - s| + SV |v| + S0 >= max |w^4 X''''| / 384 over the cell.
XX, XV, X0, VX, VV, V0, SX, SV, S0 = range(9)
COLUMNS = 9
# Columns of `Cells.clock`: width of the cell, its start in base periods, sine and cosine of the forcing there.
WIDTH, START, SINE, COSINE = range(4)


# Beyond this the backlash is below a millionth of the motion, which the always-in-contact equation then
# governs: where that is parametrically unstable, the motion never comes back.
ESCAPE_RADIUS = 1e6


class Coefficients(NamedTuple):
    """The oscillator as plain floats and arrays (numba rejects dataclasses)."""

    mean_force: float
    error_amplitude: float
    error_phase: float
    damping_ratio: float  # in contact
    flight_damping: float  # the damping ratio in free flight
    mesh_frequency: float
    edges: Array  # (n_levels + 1,), from 0 to 1
    levels: Array  # (n_levels,)
    harmonics: Array  # (n, 3): order, amplitude and phase of what the error has besides its first harmonic
    mesh_periods: int  # that the base period has; orders are multiples of its inverse


class Cells(NamedTuple):
    """One oscillator, ready to be walked through; see the module's text. Regions are indexed 0, 1, 2 for -1, 0, 1."""

    force: float
    amplitude: float  # A = F_ah Omega^2
    mesh_periods: int  # that the base period has
    phase_per_period: float  # of the forcing's first harmonic: 2 pi for each
    start_force: float  # the whole forcing at the start of a base period
    start_rate: float  # and its rate over Omega
    clock: Array  # (n_cells, 4)
    level: Integers  # (n_cells,) index of the stiffness level
    maps: Array  # (n_cells, 3, COLUMNS)
    bases: Array  # (n_levels, 2, 5, TERMS), free flight and contact
    fourths: Array  # (n_levels, 2, 5) bounds of their fourth derivatives
    forced: Array  # (n_cells, 2, TERMS) responses from rest to the higher harmonics; no rows without these
    forced_fourths: Array  # (n_cells, 2) bounds of their fourth derivatives
    blocks: Integers  # (n_blocks + 1,) first cell of each block
    block_width: Array  # (n_blocks,)
    block_maps: Array  # (n_blocks, 3, COLUMNS)
    period: float
    damping_ratio: float
    flight_damping: float
    escape_radius: float  # |X| + |X'| from which no motion comes back


@kernel
def count_blocks(p: Coefficients, level: int) -> int:
    """How many blocks one stiffness level needs: cells, if the forcing has one harmonic."""
    # Damping is negative where time runs backward.
    rate = fastest_rate(p.levels[level], abs(p.damping_ratio), p.mesh_frequency)
    rate = max(rate, 2.0 * abs(p.flight_damping))
    span = (p.edges[level + 1] - p.edges[level]) * 2.0 * np.pi / p.mesh_frequency
    return max(1, int(np.ceil(span * rate / REACH)))


@kernel
def count_cells(p: Coefficients, level: int) -> int:
    """How many cells one stiffness level needs: whole blocks of them."""
    order = 0.0
    for i in range(p.harmonics.shape[0]):
        order = max(order, p.harmonics[i, ORDER])
    n_blocks = count_blocks(p, level)
    turn = order * 2.0 * np.pi * (p.edges[level + 1] - p.edges[level]) / n_blocks
    return n_blocks * max(1, int(np.ceil(turn / REACH)))


@allocating_kernel
def build_cells(p: Coefficients) -> Cells:
    """Cut the base period of oscillator `p` into cells."""
    cells, ends = empty_cells(p), np.empty((2, 5, 2))
    cells_per_mesh, blocks_per_mesh = cells.level.size // p.mesh_periods, cells.block_width.size // p.mesh_periods
    first_cell, first_block = 0, 0
    for i in range(p.levels.size):
        n, n_blocks = count_cells(p, i), count_blocks(p, i)
        span = (p.edges[i + 1] - p.edges[i]) / n
        width = span * (2.0 * np.pi / p.mesh_frequency)
        fill_basis(0.0, p.flight_damping, p.mesh_frequency, width, cells.bases[i, 0])
        fill_basis(p.levels[i], p.damping_ratio, p.mesh_frequency, width, cells.bases[i, 1])
        for contact in range(2):
            fill_ends(cells.bases[i, contact], width, ends[contact])
            for k in range(5):
                cells.fourths[i, contact, k] = fourth_derivative_bound(cells.bases[i, contact, k], 1.0)
        for turn in range(p.mesh_periods):
            j = turn * cells_per_mesh + first_cell
            for m in range(n):
                fill_cell(p, cells, j + m, i, turn, p.edges[i] + m * span, width, ends)
            for b in range(n_blocks):
                at = j + b * (n // n_blocks)
                fill_block(cells, turn * blocks_per_mesh + first_block + b, at, at + n // n_blocks)
        first_cell, first_block = first_cell + n, first_block + n_blocks
    return cells


@allocating_kernel
def empty_cells(p: Coefficients) -> Cells:
    """The cells of oscillator `p`, with what belongs to no cell filled in."""
    n_levels = p.levels.size
    n_cells, n_blocks = 0, 0
    for i in range(n_levels):
        n_cells += p.mesh_periods * count_cells(p, i)
        n_blocks += p.mesh_periods * count_blocks(p, i)
    amplitude = p.error_amplitude * p.mesh_frequency**2
    force, rate = p.mean_force + amplitude * np.sin(p.error_phase), amplitude * np.cos(p.error_phase)
    for h in p.harmonics:
        size = h[AMPLITUDE] * (h[ORDER] * p.mesh_frequency) ** 2
        force += size * np.sin(h[PHASE])
        rate += h[ORDER] * size * np.cos(h[PHASE])
    n_forced = n_cells if p.harmonics.shape[0] > 0 else 0
    return Cells(
        p.mean_force,
        amplitude,
        p.mesh_periods,
        2.0 * np.pi * p.mesh_periods,
        force,
        rate,
        np.empty((n_cells, 4)),
        np.empty(n_cells, np.int64),
        np.empty((n_cells, 3, COLUMNS)),
        np.empty((n_levels, 2, 5, TERMS)),
        np.empty((n_levels, 2, 5)),
        np.empty((n_forced, 2, TERMS)),
        np.empty((n_forced, 2)),
        np.empty(n_blocks + 1, np.int64),
        np.empty(n_blocks),
        np.empty((n_blocks, 3, COLUMNS)),
        2.0 * np.pi / p.mesh_frequency * p.mesh_periods,
        p.damping_ratio,
        p.flight_damping,
        ESCAPE_RADIUS if contact_growth(p) > 1.0 else np.inf,
    )


@inlined_kernel
def fill_cell(
    p: Coefficients, cells: Cells, j: int, level: int, turn: int, start: float, width: float, ends: Array
) -> None:
    """Cell `j` of a stiffness level, from `start` in mesh period `turn` on: `ends` (2, 5, 2) are its `fill_ends`."""
    theta = 2.0 * np.pi * start + p.error_phase
    cells.clock[j, WIDTH] = width
    cells.clock[j, START] = (turn + start) / p.mesh_periods
    cells.clock[j, SINE] = cells.amplitude * np.sin(theta)
    cells.clock[j, COSINE] = cells.amplitude * np.cos(theta)
    cells.level[j] = level
    if p.harmonics.shape[0] > 0:
        for contact in range(2):
            kappa, row = p.levels[level] * contact, cells.forced[j, contact]
            zeta = p.damping_ratio if contact == 1 else p.flight_damping
            fill_forced(kappa, zeta, p.mesh_frequency, width, turn + start, p.harmonics, row)
            cells.forced_fourths[j, contact] = fourth_derivative_bound(row, 1.0)
    for region in range(3):
        fill_map(cells, j, region, ends[abs(region - 1)])


@kernel
def contact_growth(p: Coefficients) -> float:
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
    half = max(0.5 * abs(xx + vv), 1.0)
    return (half + np.sqrt(half * half - 1.0)) * np.exp(-zeta * period)


@kernel
def fill_ends(basis: Array, width: float, ends: Array) -> None:
    """Value and rate of each response of `basis` at the end of a cell, into `ends` (5, 2)."""
    for k in range(5):
        value, slope = 0.0, 0.0
        for n in range(DEGREE, -1, -1):
            value += basis[k, n]
            slope += n * basis[k, n] / width
        ends[k, 0], ends[k, 1] = value, slope


@kernel
def fill_map(cells: Cells, j: int, region: int, ends: Array) -> None:
    """The affine map of cell `j` in one region, and its spread; `ends` (5, 2) as of `fill_ends` there."""
    shift = region - 1.0
    width, sine, cosine = cells.clock[j, WIDTH], cells.clock[j, SINE], cells.clock[j, COSINE]
    row = cells.maps[j, region]
    row[XX], row[VX] = ends[0, 0], ends[0, 1]
    row[XV], row[VV] = ends[1, 0], ends[1, 1]
    row[X0] = ends[2, 0] * cells.force + ends[3, 0] * sine + ends[4, 0] * cosine + shift * (1.0 - ends[0, 0])
    row[V0] = ends[2, 1] * cells.force + ends[3, 1] * sine + ends[4, 1] * cosine - shift * ends[0, 1]
    fourths = cells.fourths[cells.level[j], abs(region - 1)]
    row[SX], row[SV] = fourths[0] / 384.0, fourths[1] / 384.0
    row[S0] = (fourths[2] * abs(cells.force) + fourths[3] * abs(sine) + fourths[4] * abs(cosine)) / 384.0
    if cells.forced.shape[0] > 0:
        forced = cells.forced[j, abs(region - 1)]
        for n in range(DEGREE, -1, -1):
            row[X0] += forced[n]
            row[V0] += n * forced[n] / width
        row[S0] += cells.forced_fourths[j, abs(region - 1)] / 384.0


@allocating_kernel
def fill_block(cells: Cells, b: int, first: int, last: int) -> None:
    """Join cells `first` to `last` (of equal width and one stiffness level) to block `b`.

    Its map is the product of theirs. Its spread is the largest of theirs, each written in terms of the
    state at the block's start, in the block's width: there is no jump of X'' inside a stiffness level.
    """
    n = last - first
    cells.blocks[b], cells.blocks[b + 1] = first, last
    cells.block_width[b] = n * cells.clock[first, WIDTH]
    for region in range(3):
        row = cells.block_maps[b, region]
        row[:] = cells.maps[first, region]
        shift = region - 1.0
        for j in range(first + 1, last):
            cell = cells.maps[j, region]
            resting = row[XX] * shift + row[X0] - shift
            sx = cell[SX] * abs(row[XX]) + cell[SV] * abs(row[VX])
            sv = cell[SX] * abs(row[XV]) + cell[SV] * abs(row[VV])
            s0 = cell[SX] * abs(resting) + cell[SV] * abs(row[VX] * shift + row[V0]) + cell[S0]
            row[SX], row[SV], row[S0] = max(row[SX], sx), max(row[SV], sv), max(row[S0], s0)
            xx, xv, x0 = row[XX], row[XV], row[X0]
            row[XX], row[VX] = cell[XX] * xx + cell[XV] * row[VX], cell[VX] * xx + cell[VV] * row[VX]
            row[XV], row[VV] = cell[XX] * xv + cell[XV] * row[VV], cell[VX] * xv + cell[VV] * row[VV]
            row[X0] = cell[XX] * x0 + cell[XV] * row[V0] + cell[X0]
            row[V0] = cell[VX] * x0 + cell[VV] * row[V0] + cell[V0]
        row[SX:] *= float(n) ** 4
