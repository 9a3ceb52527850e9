"""The verdict on a range of speeds: which to avoid, and why."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import checked
from gearpair.table import Table

if TYPE_CHECKING:
    import xarray as xr

NARROWEST = 0.05  # of a speed: between speeds at which the teeth part, what is narrower is no range to run in


@dataclass(frozen=True)
class SpeedRange:
    """A range of speeds to avoid.

    Attributes
    ----------
    lower, upper : float
        The pinion's, in rpm: at a located jump where one bounds the range, midway between two speeds of the chart
        elsewhere, or an end of the chart.
    why : str
        How contact is lost, in words; each way that is met, by rising speed.
    motions : tuple of str
        The worst motions met.
    dynamic_factor, time_apart, impact_velocity : float
        The largest of the range, of all motions and phases; the velocity in mm/s.
    worst_phase_rad : float, optional
        The phase of the error with the largest forces of the range, where the phase is unknown.
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
    """The ranges of a speed chart in which the teeth part, at any phase of an error whose phase is unknown.

    Parameters
    ----------
    chart : xarray.Dataset
        Of `speed_chart`.

    Returns
    -------
    tuple of SpeedRange
        By rising speed: where speeds at which the teeth part lie less than five per cent apart, what is between them
        counts as well, so that a resonance is one row. So do motions that no run meets, if one of the starts found
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
    speeds, first = chart.speed.values, 0
    stretches: list[list[int]] = []  # first speed, and the one after the last
    for lost, run in groupby(chart.loss.values.tolist(), key=bool):
        last = first + len(list(run))
        if lost and stretches and speeds[first] - speeds[stretches[-1][1] - 1] < NARROWEST * speeds[first]:
            stretches[-1][1] = last
        elif lost:
            stretches.append([first, last])
        first = last
    return tuple(_range(chart, first, last) for first, last in stretches)


def _range(chart: xr.Dataset, first: int, last: int) -> SpeedRange:
    there = chart.isel(speed=slice(first, last))
    top = int(np.nan_to_num(there.factor_high.values, nan=np.inf).argmax())
    told = chart.attrs["error_phase"] == "unknown" and there.factor_high.notnull().any()
    ways = dict.fromkeys(loss for loss in there.loss.values.tolist() if loss)
    return SpeedRange(
        _edge(chart, first, min),
        _edge(chart, last, max),
        f"the teeth {'; at other speeds they '.join(ways)}",
        tuple(dict.fromkeys(there.motion.sel(run="worst").values.tolist())),
        dynamic_factor=float(there.factor_high.max()),
        time_apart=float(there.time_apart_high.max()),
        impact_velocity=float(there.impact_velocity_high.max()),
        worst_phase_rad=float(there.worst_phase[top]) if told else None,
    )


def _edge(chart: xr.Dataset, i: int, outermost: Callable[[NDArray[np.float64]], float]) -> float:
    """Where a range that begins at speed `i`, or ends before it, is bounded."""
    speeds, jumps = chart.speed.values, chart.jump_speed.values
    if i == 0 or i == len(speeds):
        return float(speeds[0 if i == 0 else -1])
    near = jumps[(jumps >= speeds[i - 1]) & (jumps <= speeds[i])]
    return float(outermost(near)) if len(near) else float(0.5 * (speeds[i - 1] + speeds[i]))


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
    ranges = list(ranges)
    rows = [
        [
            f"{run.lower:.0f}–{run.upper:.0f}",
            run.why,
            ", ".join(run.motions) if len(run.motions) < 4 else f"{len(run.motions)} kinds",
            *(_or_dash(text, value) for text, value in ((".1f", run.dynamic_factor), (".0%", run.time_apart))),
            "–" if np.isnan(run.impact_velocity) else three_digits(run.impact_velocity),
        ]
        for run in ranges
    ]
    columns = ["rpm", "why", "motions", "dynamic factor", "time apart", "impacts at (mm/s)"]
    if any(run.worst_phase_rad is not None for run in ranges):
        columns.append("worst phase")
        for row, run in zip(rows, ranges, strict=True):
            row.append("–" if run.worst_phase_rad is None else f"{np.degrees(run.worst_phase_rad):.0f}°")
    return Table(columns, rows or [["none", "the teeth stay in contact", *["–"] * 4]])


def _or_dash(form: str, value: float) -> str:
    return "–" if np.isnan(value) else format(value, form)


def three_digits(value: float) -> str:
    """A number of three digits, or of all before the point, without an exponent."""
    return f"{value:.0f}" if abs(value) >= 99.95 else f"{value:.3g}"
