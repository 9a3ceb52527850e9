"""Many starts of one oscillator: attractors found on a few of them capture the others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gearpair._cores import on_all_cores
from gearpair._flow.capture import COLUMNS
from gearpair._flow.settle import PERIODIC, Known, Settled, settle_starts, surround_rows
from gearpair.motion.settling import SettleSettings, room, stoppable, transient_periods
from gearpair.oscillator import Oscillator

SEEDS = 256  # starts that are settled first, at most an eighth of all
BLOCK = 256  # starts between two moves of the progress bar
SAME_ORBIT = 1e-6  # orbits whose first section points lie this close are one


def nothing_known(settings: SettleSettings) -> Known:
    """No attractors."""
    return Known(room(0, settings), np.empty((0, COLUMNS)))


def known_attractors(osc: Oscillator, starts: NDArray[np.float64], settings: SettleSettings) -> Known:
    """The periodic attractors that some of the starts reach, with the neighbourhoods that capture the rest.

    Depends on the starts (n, 2) and the settings alone, not on threads nor on how the starts are cut into blocks.
    """
    n = min(SEEDS, len(starts) // 8)
    if n == 0:
        return nothing_known(settings)
    # Steps of the golden section spread the seeds over a grid of any shape.
    chosen = np.unique((np.arange(1, n + 1) * 0.6180339887498949 % 1.0 * len(starts)).astype(int))
    out = settle_from(osc, starts[chosen], settings, nothing_known(settings))
    rows = np.flatnonzero(out.status == PERIODIC)
    orbits = same_orbits(out.period[rows], out.points[rows, 0])
    rows = rows[np.unique(orbits, return_index=True)[1]]
    settled = Settled(*(column[rows] for column in out))
    settled.way[:] = np.nan
    neighbourhoods = np.empty((int(settled.period.sum()), COLUMNS))
    filled = surround_rows(osc._cells, settled.points[:, 0].copy(), settled.period, neighbourhoods)
    return Known(settled, neighbourhoods[:filled].copy())


def settle_from(
    osc: Oscillator,
    starts: NDArray[np.float64],
    settings: SettleSettings,
    known: Known,
    *,
    share: int | None = None,
    progress: bool = False,
) -> Settled:
    """Follow each start (n, 2) until one of the `known` attractors captures it or it has settled by itself.

    `share` is the most mesh periods of one motion, where not all of the batch is given.
    """
    out = room(len(starts), settings)
    n_transient = transient_periods(osc) if settings.n_transient is None else settings.n_transient
    most = settings.share_of_work(len(starts)) if share is None else share
    arguments = (osc._cells, starts, n_transient, settings.max_period, settings.n_exponent, most, known, out)
    with stoppable(out, progress) as done:
        on_all_cores(settle_starts, arguments, len(starts), BLOCK, done)
    return out


def same_orbits(periods: NDArray[np.int64], points: NDArray[np.float64]) -> NDArray[np.int64]:
    """A number for each cycle (n,), given by period and first section point (n, 2): equal for the same orbit."""
    rough = np.concatenate([periods[:, np.newaxis], np.round(points / SAME_ORBIT)], axis=1)
    distinct, first, numbers = np.unique(rough, axis=0, return_index=True, return_inverse=True)
    leader = np.arange(len(distinct))  # rounding may have parted what lies close
    for i in range(len(distinct)):
        apart = np.abs(points[first[:i]] - points[first[i]]).max(axis=1, initial=0.0)
        near = np.flatnonzero((apart <= SAME_ORBIT) & (periods[first[:i]] == periods[first[i]]))
        if len(near):
            leader[i] = leader[near[0]]
    return leader[numbers.ravel()]
