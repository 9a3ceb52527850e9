"""Blows, forces and displacements along a walk, gathered segment by segment."""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, kernel
from .cells import WIDTH, Cells
from .closed_form import DEGREE, TERMS
from .reach import segment_extremes
from .segment import Segment, region_after

# Columns of a row of measures; what belongs to a side comes twice, drive first. All are moduli but for the last four.
IMPACTS, VELOCITY, VELOCITY_SUM, IMPULSE, SHARE, FORCE = 0, 2, 4, 6, 8, 10
MEAN, RMS, LOWEST, HIGHEST = 12, 13, 14, 15
N_MEASURES = 16

# Gauss and Legendre's rule, exact up to degree 31: the square of a segment's power series has degree 30.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(TERMS)


class Measures(NamedTuple):
    """What is measured, and where from: moments are taken about the start, near the mean."""

    row: Array  # (N_MEASURES,) sums, until `finish_measures`
    origin: float


@kernel
def measure_segment(measures: Measures | None, cells: Cells, segment: Segment) -> None:
    """Add what happens on a segment, and the contact that it ends with."""
    if measures is None:
        return
    row, width, duration = measures.row, cells.clock[segment.cell, WIDTH], segment.duration
    length, square = segment_moments(segment.series, duration, measures.origin)
    row[MEAN] += length * width
    row[RMS] += square * width
    low, high = segment_extremes(segment.series, duration, segment.x, segment.v * width, np.inf, -np.inf)
    row[LOWEST], row[HIGHEST] = min(row[LOWEST], low), max(row[HIGHEST], high)
    region = segment.region
    if region != 0:
        side = 0 if region > 0 else 1
        stiffness = contact_stiffness(cells, segment.cell)
        press = length + (measures.origin - region) * duration
        row[IMPULSE + side] += stiffness * abs(press) * width
        row[SHARE + side] += duration * width
        deepest = high - 1.0 if region > 0 else -1.0 - low
        row[FORCE + side] = max(row[FORCE + side], stiffness * deepest)
    if segment.left and region == 0:
        side = 0 if region_after(region, segment.x) > 0 else 1
        row[IMPACTS + side] += 1.0
        row[VELOCITY + side] = max(row[VELOCITY + side], abs(segment.v))
        row[VELOCITY_SUM + side] += abs(segment.v)


@kernel
def contact_stiffness(cells: Cells, j: int) -> float:
    """k on cell `j`: the basis of contact carries k w^2."""
    return -2.0 * cells.bases[cells.level[j], 1, 0, 2] / cells.clock[j, WIDTH] ** 2


@kernel
def finish_measures(measures: Measures, cells: Cells, n_periods: int) -> None:
    """Turn sums over `n_periods` into what a mesh period has, and moments into mean and root mean square."""
    row, span = measures.row, n_periods * cells.period
    n_periods *= cells.mesh_periods
    for side in range(2):
        row[SHARE + side] /= span
        row[IMPULSE + side] /= n_periods
        row[IMPACTS + side] /= n_periods
        row[VELOCITY_SUM + side] /= n_periods
    first, second = row[MEAN], row[RMS]
    row[MEAN] = measures.origin + first / span
    row[RMS] = np.sqrt(max(second / span - (first / span) ** 2, 0.0))


@kernel
def segment_moments(series: Array, end: float, origin: float) -> tuple[float, float]:
    """Integrals of p - origin and of its square over [0, end], exact but for rounding."""
    first, second = 0.0, 0.0
    for i in range(TERMS):
        t = 0.5 * end * (NODES[i] + 1.0)
        p = series[DEGREE]
        for n in range(DEGREE - 1, -1, -1):
            p = p * t + series[n]
        p -= origin
        first += WEIGHTS[i] * p
        second += WEIGHTS[i] * p * p
    return 0.5 * end * first, 0.5 * end * second
