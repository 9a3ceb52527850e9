"""One oscillator after another, a mesh period of each: the motion while speed and load change."""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, Integers, allocating_kernel
from .cells import Coefficients, build_cells
from .closed_form import TERMS
from .measures import HIGHEST, LOWEST, Measures, finish_measures
from .records import Samples
from .walk import OK, Details, walk


class Schedule(NamedTuple):
    """Many oscillators in flat arrays, and which of them a mesh period has.

    Those of oscillator i are rows ``scalars[i]``, ``levels[first_level[i]:first_level[i + 1]]``, as many edges and one
    more, and ``harmonics[first_harmonic[i]:first_harmonic[i + 1]]``.
    """

    scalars: Array  # (n, 6): the first fields of `Coefficients`
    edges: Array
    levels: Array
    harmonics: Array  # (m, 3)
    first_level: Integers  # (n + 1,)
    first_harmonic: Integers  # (n + 1,)
    which: Integers  # (n_cycles,) oscillator of each mesh period
    steps: Array  # (n_cycles, 2) what X and X' change by at its start


@allocating_kernel
def scheduled(schedule: Schedule, i: int) -> Coefficients:
    """The coefficients of oscillator `i`."""
    s = schedule.scalars[i]
    first, last = schedule.first_level[i], schedule.first_level[i + 1]
    return Coefficients(
        s[0],
        s[1],
        s[2],
        s[3],
        s[4],
        s[5],
        schedule.edges[first + i : last + i + 1],
        schedule.levels[first:last],
        schedule.harmonics[schedule.first_harmonic[i] : schedule.first_harmonic[i + 1]],
        1,
    )


@allocating_kernel
def pass_through(schedule: Schedule, x: float, v: float, states: Array, rows: Array, values: Array) -> tuple[int, int]:
    """The motion from (x, v) on through all mesh periods of a schedule: (status, mesh periods done).

    Fills the states at their starts and at the end, `states` (n_cycles + 1, 2), the measures of each, `rows`
    (n_cycles, N_MEASURES), and X and X' at equal steps, `values` (n_cycles, per_period, 2), which may have none.
    """
    series, built = np.empty(TERMS), schedule.which[0]
    crossings, counts = np.empty((0, 4)), np.zeros(2, np.int64)
    cells = build_cells(scheduled(schedule, built))
    for i in range(schedule.which.size):
        if schedule.which[i] != built:
            built = schedule.which[i]
            cells = build_cells(scheduled(schedule, built))
        x, v = x + schedule.steps[i, 0], v + schedule.steps[i, 1]
        states[i, 0], states[i, 1] = x, v
        row = rows[i]
        row[:] = 0.0
        row[LOWEST], row[HIGHEST] = x, x
        measures, counts[0] = Measures(row, x), 0
        samples = Samples(values.shape[1], values[i], crossings, counts)
        status, x, v = walk(cells, x, v, 1, series, None, None, Details(samples, None, None, measures, None))
        if status != OK:
            return status, i
        finish_measures(measures, cells, 1)
    states[schedule.which.size, 0], states[schedule.which.size, 1] = x, v
    return OK, schedule.which.size
