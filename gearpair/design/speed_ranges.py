"""The verdict on a range of speeds: which to avoid, and why."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import checked
from gearpair.motion.impacts import ImpactState
from gearpair.table import Table

if TYPE_CHECKING:
    import xarray as xr

SEPARATED = (ImpactState.SINGLE_DRIVE, ImpactState.SINGLE_COAST, ImpactState.NEVER_IN_CONTACT, ImpactState.DOUBLE)
BOTH, ALWAYS, HISTORY, RARE = (
    "the teeth strike on both flanks",
    "the teeth part and strike, however the speed is reached",
    "the teeth part after one way of running there and not after another",
    "the teeth part after a shock alone, not when run up or down",
)


@dataclass(frozen=True)
class SpeedRange:
    """A range of speeds to avoid.

    Attributes
    ----------
    lower, upper : float
        The pinion's, in rpm: at a located jump where one bounds the range, midway between two speeds of the chart
        elsewhere, or an end of the chart.
    why : str
        The reason in words.
    motions : tuple of str
        The worst motions met.
    dynamic_factor, time_apart, impact_velocity : float
        The largest of the range, of the worst motion; the velocity in mm/s.
    """

    lower: float
    upper: float
    why: str
    motions: tuple[str, ...]
    dynamic_factor: float
    time_apart: float
    impact_velocity: float


@checked
def speeds_to_avoid(chart: xr.Dataset) -> tuple[SpeedRange, ...]:
    """The ranges of a speed chart in which the teeth part.

    Parameters
    ----------
    chart : xarray.Dataset
        Of `speed_chart`.

    Returns
    -------
    tuple of SpeedRange
        By rising speed; neighbours differ in their reason. Motions that no run meets count, if one of the starts found
        them.

    Examples
    --------
    >>> from gearpair import GearDrive, SpurPair
    >>> from gearpair.design import speed_chart
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=1000.0, backlash_um=80.0,
    ...     transmission_error_um=1.0, damping_ratio=0.08)
    >>> speeds_to_avoid(speed_chart(drive, [1000.0, 1500.0], n_starts=2))
    ()
    """
    speeds = chart.speed.values
    reasons = [_reason(*states) for states in chart.impact_state.transpose("speed", "run").values.tolist()]
    worst = chart.sel(run="worst")
    found, first = [], 0
    for reason, run in groupby(reasons):
        last = first + len(list(run))
        if reason:
            here = slice(first, last)
            found.append(
                SpeedRange(
                    _edge(chart, speeds, first),
                    _edge(chart, speeds, last),
                    reason,
                    tuple(dict.fromkeys(worst.motion.values[here].tolist())),
                    *(
                        float(np.nanmax(worst[name].values[here]))
                        for name in ("dynamic_factor", "time_apart", "impact_velocity")
                    ),
                )
            )
        first = last
    return tuple(found)


def _reason(up: str, down: str, worst: str) -> str:
    """Why a speed is to be avoided, from the impact states of both runs and of the worst motion; empty if it is not."""
    if ImpactState.DOUBLE in (up, down, worst):
        return BOTH
    parted = [state in SEPARATED for state in (up, down, worst)]
    if all(parted):
        return ALWAYS
    if any(parted[:2]):
        return HISTORY
    return RARE if parted[2] else ""


def _edge(chart: xr.Dataset, speeds: NDArray[np.float64], i: int) -> float:
    """Where a range that begins at speed `i`, or ends before it, is bounded."""
    if i == 0 or i == len(speeds):
        return float(speeds[0 if i == 0 else -1])
    jumps = chart.jump_speed.values
    near = jumps[(jumps >= speeds[i - 1]) & (jumps <= speeds[i])]
    return float(near[0]) if len(near) else float(0.5 * (speeds[i - 1] + speeds[i]))


@checked
def speed_range_table(ranges: Iterable[SpeedRange]) -> Table:
    """The speeds to avoid, one row a range: why, and the worst of it.

    Parameters
    ----------
    ranges : iterable of SpeedRange
        Of `gearpair.design.speeds_to_avoid`.

    Examples
    --------
    >>> from gearpair.design import SpeedRange
    >>> speed_range_table([SpeedRange(6836.7, 8139.1, "the teeth part", ("period 1",), 3.779, 0.571, 568.0)])
    rpm        why             motions   dynamic factor  time apart  impacts at (mm/s)
    ----------------------------------------------------------------------------------
    6837–8139  the teeth part  period 1             3.8         57%                568
    """
    rows = [
        [
            f"{run.lower:.0f}–{run.upper:.0f}",
            run.why,
            ", ".join(run.motions) if len(run.motions) < 4 else f"{len(run.motions)} kinds",
            f"{run.dynamic_factor:.1f}",
            f"{run.time_apart:.0%}",
            f"{run.impact_velocity:.3g}",
        ]
        for run in ranges
    ]
    columns = ["rpm", "why", "motions", "dynamic factor", "time apart", "impacts at (mm/s)"]
    return Table(columns, rows or [["none", "the teeth stay in contact", *["–"] * 4]])
