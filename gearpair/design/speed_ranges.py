"""The verdict on a range of speeds: which to avoid, and why."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import checked
from gearpair.table import Table

if TYPE_CHECKING:
    import xarray as xr

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
    worst_phase_rad: float | None = None


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
    speeds, losses = chart.speed.values, chart.loss.values.tolist()
    found, first = [], 0
    for lost, run in groupby(losses, key=bool):
        last = first + len(list(run))
        if lost:
            found.append(_range(chart, _edge(chart, speeds, first), _edge(chart, speeds, last), slice(first, last)))
        first = last
    return tuple(found)


def _range(chart: xr.Dataset, lower: float, upper: float, here: slice) -> SpeedRange:
    there = chart.isel(speed=here)
    top = int(np.nan_to_num(there.factor_high.values, nan=np.inf).argmax())
    return SpeedRange(
        lower,
        upper,
        "; elsewhere ".join(dict.fromkeys(there.loss.values.tolist())),
        tuple(dict.fromkeys(there.motion.sel(run="worst").values.tolist())),
        *(float(there[name].max()) for name in ("factor_high", "time_apart_high", "impact_velocity_high")),
        worst_phase_rad=float(there.worst_phase[top]) if chart.attrs["error_phase"] == "unknown" else None,
    )


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
