"""The motion from one start: the stroboscopic map and the trajectory."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_count, checked, plain
from gearpair._cores import SHORT, aside, on_all_cores
from gearpair._equality import equal_by_value
from gearpair._flow.cells import Cells
from gearpair._flow.closed_form import TERMS
from gearpair._flow.observe import record
from gearpair._flow.records import SEGMENT_COLUMNS, Segments
from gearpair._flow.walk import (
    ESCAPED,
    EVENT_UNDECIDED,
    MAX_EVENTS_PER_PERIOD,
    OK,
    TOO_MANY_EVENTS,
    Details,
    walk,
    walk_starts,
)
from gearpair.oscillator import Oscillator

WATCHED = 10  # times as long a mesh period takes where each of its segments is looked at
PERIODS_AT_ONCE = 10_000  # of the walk, between two chances to stop: some ten milliseconds
CAPPED = {
    TOO_MANY_EVENTS: f"more than {MAX_EVENTS_PER_PERIOD} contacts and separations in one mesh period: "
    "raise mesh_frequency, or lower error_amplitude, until the motion is one that a gear can make",
    EVENT_UNDECIDED: "an impact could not be told from a near miss: change the start by a rounding error "
    "and report the oscillator and start as a bug",
}


@equal_by_value
@dataclass(frozen=True)
class Impacts:
    """Every crossing of X = +-1, in order; all arrays have shape (n,).

    Attributes
    ----------
    tau : ndarray of float
        Dimensionless time.
    side : ndarray of int
        +1 for the drive side, -1 for the coast side.
    velocity : ndarray of float
        X' there (dimensionless).
    contact : ndarray of bool
        True where contact begins, False where it ends (separation).
    """

    tau: NDArray[np.float64]
    side: NDArray[np.int64]
    velocity: NDArray[np.float64]
    contact: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.tau)


@equal_by_value
@dataclass(frozen=True)
class Trajectory:
    """A sampled motion; `tau`, `x` and `v` have shape (n + 1,), for `samples_per_period` samples a mesh period.

    Attributes
    ----------
    oscillator : Oscillator
    tau, x, v : ndarray of float
        Dimensionless time from 0 (after the transient), X and X'; the end point is included.
    impacts : Impacts
    samples_per_period : int
        Samples per mesh period.
    method : str
        ``"exact"`` or the name of the integrator.
    """

    oscillator: Oscillator
    tau: NDArray[np.float64]
    x: NDArray[np.float64]
    v: NDArray[np.float64]
    impacts: Impacts
    samples_per_period: int
    method: str

    @property
    def section(self) -> NDArray[np.float64]:
        """The Poincaré section: X and X' at the start and after each base period, shape (n_periods + 1, 2)."""
        step = self.samples_per_period * self.oscillator.mesh_periods
        return np.column_stack([self.x[::step], self.v[::step]])


def check_starts(x: ArrayLike, v: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Broadcast starts against each other, those of xarray by dimension; a ValueError says what is wrong with them."""
    given: list[Any] = [x, v]
    if hasattr(x, "dims") and hasattr(v, "dims"):
        from xarray import broadcast

        given = list(broadcast(*given))
    xs, vs = check_array("x", given[0]), check_array("v", given[1])
    if xs.shape == vs.shape:
        return xs, vs
    try:
        xs, vs = np.broadcast_arrays(xs, vs)
    except ValueError:
        raise ValueError(
            f"x and v must be numbers of shapes that broadcast, got shapes {np.shape(x)} and {np.shape(v)}"
        ) from None
    return xs, vs


def check_pairs(x: ArrayLike, v: ArrayLike) -> NDArray[np.float64]:
    """Starts, one at least, as rows (n, 2), or a ValueError that says what is wrong with them."""
    xs, vs = check_starts(x, v)
    if xs.size == 0:
        raise ValueError(f"x and v must hold one start at least, got shape {xs.shape}")
    return np.stack([xs.ravel(), vs.ravel()], axis=1)


def check_start(x: ArrayLike, v: ArrayLike) -> tuple[float, float]:
    """One start as two floats, or a ValueError that says what is wrong with it."""
    xs, vs = check_starts(x, v)
    if xs.ndim:
        raise ValueError(f"x and v must be single numbers, got shape {xs.shape}")
    return float(xs), float(vs)


@checked
def stroboscopic_map(osc: Oscillator, x: ArrayLike, v: ArrayLike, n: int = 1) -> tuple[Any, Any]:
    """The state `n` periods after (x, v) on the section ``tau mod T = 0``.

    Parameters
    ----------
    osc : Oscillator
    x, v : array_like of float
        X and X' at the start of a period; broadcast against each other.
    n : int
        Base periods, at least 0: mesh periods, or revolutions with `shaft_orders`.

    Returns
    -------
    x, v : ndarray of float, or float
        The broadcast shape; of two numbers, two floats. A start that escapes to infinity comes back as +-inf.

    Raises
    ------
    RuntimeError
        Where the walk is capped; the message says what to do.

    Notes
    -----
    A start has escaped when |X| + |X'| exceeds 1e6 at the end of a mesh period and the
    always-in-contact equation, which governs such motions, is parametrically unstable (Floquet).

    Examples
    --------
    >>> osc = Oscillator()
    >>> x, v = stroboscopic_map(osc, [0.0, 1.0], 0.0, n=500)
    >>> bool(abs(x[0] - x[1]) < 1e-12)
    True
    >>> [round(value, 4) for value in stroboscopic_map(osc, 1.0, 0.0)]
    [0.3818, -0.0874]
    """
    return mapped(partial(walked, osc.cells), x, v, n)


def mapped(
    walk: Callable[[NDArray[np.float64], int], tuple[NDArray[np.float64], NDArray[np.int64]]],
    x: ArrayLike,
    v: ArrayLike,
    n: int,
) -> tuple[Any, Any]:
    """X and X' after `n` base periods of a `walk` such as `walked`, in the shape of the starts."""
    xs, vs = check_starts(x, v)
    starts = np.stack([xs.ravel(), vs.ravel()], axis=1)
    ends, status = walk(starts, check_count("n", n, at_least=0))
    raise_if_capped(status, starts)
    gone = status == ESCAPED
    ends[gone] = np.copysign(np.inf, ends[gone])
    return plain(ends[:, 0].reshape(xs.shape)), plain(ends[:, 1].reshape(xs.shape))


def walked(cells: Cells, starts: NDArray[np.float64], n: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The states `n` mesh periods from `starts` (m, 2) on, over all cores, and the status of each walk."""
    ends, status = np.empty_like(starts), np.empty(len(starts), np.int64)
    longest = n * cells.mesh_periods
    block = max(1, PERIODS_AT_ONCE // max(longest, 1))
    on_all_cores(walk_starts, (cells, starts, n, ends, status), len(starts), block, longest=longest)
    return ends, status


@checked
def trajectory(
    osc: Oscillator,
    x: float,
    v: float,
    n_periods: int,
    *,
    n_transient: int = 0,
    samples_per_period: int = 128,
) -> Trajectory:
    """The motion from (x, v) at the start of a base period, sampled, with every impact.

    Parameters
    ----------
    osc : Oscillator
    x, v : float
        X and X' at the start (dimensionless).
    n_periods : int
        Base periods to keep, at least 1: mesh periods, or revolutions with `shaft_orders`.
    n_transient : int
        Base periods to run first and discard.
    samples_per_period : int
        Samples per mesh period.

    Raises
    ------
    RuntimeError
        Where the motion escapes to infinity or the walk is capped.

    Examples
    --------
    >>> motion = trajectory(Oscillator(), 1.0, 0.0, 2, n_transient=500)
    >>> motion.x.shape
    (257,)
    >>> len(motion.impacts)
    4
    """
    x, v = check_start(x, v)
    n_periods = check_count("n_periods", n_periods)
    n_transient = check_count("n_transient", n_transient, at_least=0)
    samples_per_period = check_count("samples_per_period", samples_per_period)
    x, v = passed(osc, x, v, n_transient)
    per_base = samples_per_period * osc.mesh_periods
    samples = np.empty((n_periods * per_base + 1, 2))
    crossings = np.empty((0, 4))
    for _ in range(2):  # once to count the crossings, once to list them
        counts = np.zeros(2, np.int64)
        arguments = (osc.cells, x, v, n_periods, per_base, samples, crossings, counts)
        status, *samples[-1] = aside(record, *arguments, periods=n_periods * osc.mesh_periods * WATCHED)
        raise_unless_ok(status, n_transient * osc.mesh_periods + int(counts[0]) // samples_per_period)
        crossings = np.empty((int(counts[1]), 4)) if len(crossings) == 0 else crossings
    impacts = Impacts(
        crossings[:, 0] * osc.period, crossings[:, 1].astype(int), crossings[:, 2].copy(), crossings[:, 3] == 1.0
    )
    tau = np.linspace(0.0, n_periods * osc.period, len(samples))
    return Trajectory(osc, tau, samples[:, 0], samples[:, 1], impacts, samples_per_period, "exact")


def passed(osc: Oscillator, x: float, v: float, n_periods: int) -> tuple[float, float]:
    """Where a motion is after `n_periods`, or the RuntimeError that says why it is not; Ctrl-C may come in between."""
    series, at_once = np.empty(TERMS), max(1, SHORT // osc.mesh_periods)
    for done in range(0, n_periods, at_once):
        status, x, v = walk(osc.cells, x, v, min(at_once, n_periods - done), series)
        raise_unless_ok(status, n_periods * osc.mesh_periods)
    return x, v


def raise_if_capped(status: NDArray[np.int64], starts: NDArray[np.float64]) -> None:
    """Raise the RuntimeError that says which of the walks from `starts` (n, 2) was capped, if one was."""
    for code, remedy in CAPPED.items():
        if (status == code).any():
            i = int(np.argmax(status == code))
            raise RuntimeError(f"start x = {starts[i, 0]}, v = {starts[i, 1]}: {remedy}")


def raise_unless_ok(status: int, periods: int) -> None:
    """Raise the RuntimeError that says why a walk of `periods` mesh periods stopped, if it did."""
    if status == ESCAPED:
        raise RuntimeError(
            f"the motion escapes to infinity within {periods} mesh periods: contact is parametrically unstable at "
            "this mesh frequency; start nearer to the backlash zone, or raise damping_ratio"
        )
    if status != OK:
        raise RuntimeError(CAPPED[status])


def segment_rows(
    osc: Oscillator, x: float, v: float, n_periods: int
) -> tuple[NDArray[np.float64], tuple[float, float]]:
    """Every segment of the motion over `n_periods` base periods, a row each as `Segments` has them, and its end."""
    rows = np.empty((0, SEGMENT_COLUMNS))
    for _ in range(2):  # once to count the segments, once to list them
        counts = np.zeros(1, np.int64)
        details = Details(segments=Segments(rows, counts))
        arguments = (osc.cells, x, v, n_periods, np.empty(TERMS), None, None, details)
        status, *end = aside(walk, *arguments, periods=n_periods * osc.mesh_periods * WATCHED)
        raise_unless_ok(status, n_periods * osc.mesh_periods)
        rows = np.empty((int(counts[0]), SEGMENT_COLUMNS)) if len(rows) == 0 else rows
    return rows, (end[0], end[1])
