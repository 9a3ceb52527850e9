"""The watch: motions followed for long, without range or exponents, until a neighbourhood holds them."""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, Integers, allocating_kernel, kernel
from .capture import OWNER, inside
from .cells import Cells
from .closed_form import TERMS
from .walk import OK, inlined_walk


class Watched(NamedTuple):
    """Where motions have been followed to."""

    status: Integers  # (n,) of the walk
    owner: Integers  # (n,) whose neighbourhood holds the motion, or -1
    periods: Integers  # (n,) watched so far
    points: Array  # (n, 2) the last section point


@kernel
def watch(
    cells: Cells, x: float, v: float, n_periods: int, neighbourhoods: Array, series: Array
) -> tuple[int, int, int, float, float]:
    """Follow a motion until one of `neighbourhoods` holds it, `n_periods` at most: (status, owner, periods, x, v).

    The owner is -1 where none does; the period in which a walk ends early counts.
    """
    n, status, done = len(neighbourhoods), OK, 0
    held = inside(neighbourhoods, n, x, v)
    while held < 0 and done < n_periods:
        status, x, v = inlined_walk(cells, x, v, 1, series)
        done += 1
        if status != OK:
            break
        held = inside(neighbourhoods, n, x, v)
    owner = int(neighbourhoods[held, OWNER]) if held >= 0 else -1
    return status, owner, done, x, v


@allocating_kernel
def watch_starts(first: int, last: int, cells: Cells, neighbourhoods: Array, n_periods: int, watched: Watched) -> None:
    """`watch` for rows `first` to `last` of `watched`, each on from where it stands; those that have ended stay."""
    series = np.empty(TERMS)
    for i in range(first, last):
        if watched.status[i] != OK or watched.owner[i] >= 0:
            continue
        x, v = watched.points[i, 0], watched.points[i, 1]
        status, owner, periods, x, v = watch(cells, x, v, n_periods, neighbourhoods, series)
        watched.status[i], watched.owner[i], watched.points[i, 0], watched.points[i, 1] = status, owner, x, v
        watched.periods[i] += periods
