"""The verdict on a drive over its speeds, in words: one place for them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_reach, checked
from gearpair.design.dynamic_factor import IsoDynamicFactor
from gearpair.design.speed_ranges import SpeedRange, speeds_to_avoid, three_digits

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Verdict:
    """What is to be said of a speed chart; its text is all of the sentences.

    Attributes
    ----------
    avoid : tuple of SpeedRange
        The speeds to avoid.
    together : tuple of (float, float)
        The ranges of speeds, in rpm, in which the teeth stay together.
    rule : str
        What to do to keep them together, ``"run between 900 and 2100 rpm"``.
    service : str
        A sentence on the speeds of service; empty where none were told.
    phase, quiet, worst, reach : str
        Sentences on the phase of the error, on the factor where the teeth stay together, on the worst of the chart, and
        on where it ends.
    """

    avoid: tuple[SpeedRange, ...]
    together: tuple[tuple[float, float], ...]
    rule: str
    service: str
    phase: str
    quiet: str
    worst: str
    reach: str

    @property
    def sentences(self) -> tuple[str, ...]:
        """All that there is to say, the point first."""
        rest = (self.service, self.phase, self.quiet, self.worst, self.reach)
        return (f"To keep the teeth together: {self.rule}.", *(sentence for sentence in rest if sentence))

    def __str__(self) -> str:
        return "\n".join(self.sentences)


@checked
def verdict(
    chart: xr.Dataset, iso: IsoDynamicFactor | None = None, service_rpm: Sequence[float] | None = None
) -> Verdict:
    """What a speed chart says, in words.

    Parameters
    ----------
    chart : xarray.Dataset
        Of `speed_chart`.
    iso : IsoDynamicFactor, optional
        At the chart's speeds, to compare with.
    service_rpm : sequence of float, optional
        The lowest and the highest speed that the drive runs at.

    Examples
    --------
    >>> from gearpair import GearDrive, SpurPair
    >>> from gearpair.design import speed_chart
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=1000.0, backlash_um=80.0,
    ...     transmission_error_um=1.0, damping_ratio=0.08)
    >>> found = verdict(speed_chart(drive, [1000.0, 1500.0], n_starts=2), service_rpm=(1100.0, 1400.0))
    >>> found.rule, found.service
    ('run between 1000 and 1500 rpm', 'In service, from 1100 to 1400 rpm, they stay together.')
    """
    speeds, avoid = chart.speed.values, speeds_to_avoid(chart)
    if iso is not None and len(iso.speed_rpm) != len(speeds):
        raise ValueError(f"iso must be at the {len(speeds)} speeds of the chart, got {len(iso.speed_rpm)}")
    edges = [float(speeds[0]), *(end for each in avoid for end in (each.lower, each.upper)), float(speeds[-1])]
    together = tuple((low, high) for low, high in zip(edges[::2], edges[1::2], strict=True) if low < high)
    spans = " or between ".join(f"{low:.0f} and {high:.0f}" for low, high in together)
    return Verdict(
        avoid=avoid,
        together=together,
        rule=f"run between {spans} rpm" if together else "no speed of the range will do",
        service="" if service_rpm is None else _service(check_reach("service_rpm", service_rpm), edges, avoid),
        phase=_phase(chart),
        quiet=_quiet(chart, iso, together),
        worst=_worst(chart, iso),
        reach=f"The chart has {len(speeds)} speeds from {speeds[0]:.0f} to {speeds[-1]:.0f} rpm; "
        "between them it may miss a narrow range, and beyond them nothing was computed.",
    )


def _service(service: tuple[float, float], edges: list[float], avoid: tuple[SpeedRange, ...]) -> str:
    low, high = service
    told = f"In service, from {low:.0f} to {high:.0f} rpm, "
    if low < edges[0] or high > edges[-1]:
        return f"{told}speeds are met that the chart does not reach."
    met = [each for each in avoid if each.lower < high and each.upper > low]
    if not met:
        return f"{told}they stay together."
    return f"{told}avoid {', '.join(f'{max(e.lower, low):.0f} to {min(e.upper, high):.0f}' for e in met)} rpm."


def _phase(chart: xr.Dataset) -> str:
    if chart.attrs["mean_force_n"] == 0.0:  # nor is there a worst phase
        return ""
    if chart.attrs["error_phase"] == "unknown":
        worst, n = f"{np.degrees(chart.attrs['run_phase_rad']):.0f}°", chart.attrs["n_phases"]
        many = f"of the {n} that were tried {worst} is the worst; the verdict holds for all {n}, not for every other"
        one = f"{worst} alone was tried; the verdict holds for no other"
        return f"No drawing gives the phase of the error against the stiffness wave; {many if n > 1 else one}."
    if chart.attrs["error_phase"] == "none":
        return "No phase had to be chosen: there is no transmission error."
    return "No phase had to be chosen: that of the error is known."


def _quiet(chart: xr.Dataset, iso: IsoDynamicFactor | None, together: tuple[tuple[float, float], ...]) -> str:
    speeds, largest = chart.speed.values, chart.factor_high.values
    free = np.array([any(low <= speed <= high for low, high in together) for speed in speeds]) & np.isfinite(largest)
    if not free.any():
        return ""
    top = int(np.where(free, largest, 0.0).argmax())
    told = (
        f"Together is not quiet: there the dynamic factor, the largest mesh force over the mean, reaches "
        f"{largest[top]:.2f} at {speeds[top]:.0f} rpm"
    )
    if iso is None:
        return f"{told}."
    loud = int(np.where(free, largest / np.nan_to_num(iso.k_v, nan=1.0), 0.0).argmax())
    if not np.isfinite(iso.k_v[loud]):
        return f"{told}; ISO 6336-1 defines none for this pair."
    over = f"{largest[loud]:.2f} to {iso.k_v[loud]:.2f}"
    return f"{told}; over ISO 6336-1 it is most at {speeds[loud]:.0f} rpm, {over}."


def _worst(chart: xr.Dataset, iso: IsoDynamicFactor | None) -> str:
    largest = chart.factor_high.values
    if not np.isfinite(largest).any():
        return "Without a torque there is no dynamic factor." if chart.attrs["mean_force_n"] == 0.0 else ""
    top = int(np.nanargmax(largest))
    compared = "" if iso is None else f", {_by_iso(iso.k_v[top])}"
    force = largest[top] * abs(chart.attrs["mean_force_n"]) / 1000
    apart = float(chart.time_apart_high.max())
    parted = f"apart for up to {apart:.0%} of the time" if apart > 0.0 else "never apart"
    served = " Where both flanks are struck, the error of the relief is that of the flank that carries, for both."
    return (
        f"The worst of the range is a dynamic factor of {largest[top]:.1f} at {chart.speed.values[top]:.0f} rpm"
        f"{compared}; the mesh then carries up to {three_digits(force)} kN. The teeth are {parted}."
        f"{served if chart.both_flanks.any() else ''}"
    )


def _by_iso(k_v: NDArray[np.float64]) -> str:
    return f"against {k_v:.2f} by ISO 6336-1" if np.isfinite(k_v) else "where ISO 6336-1 defines none for this pair"
