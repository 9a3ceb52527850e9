"""What the command ``gearpair drive`` computes of a drive's file, and says of it in a terminal."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gearpair.design import (
    IdleRattle,
    IsoDynamicFactor,
    Verdict,
    chart_speeds,
    idle_rattle,
    iso_dynamic_factor,
    speed_chart,
    speed_range_table,
    verdict,
)
from gearpair.design.charts import BEYOND
from gearpair.drive import GearDrive
from gearpair.drive_file import DriveFile, read_drive_file
from gearpair.study.errors import StudyError

if TYPE_CHECKING:
    import xarray as xr

IDLE_FIRST, IDLE_LAST = 0.5, 2.5  # of the speed from which an idle gear rattles
SPEEDS = ("n_speeds", "lowest_rpm", "highest_rpm", "service_rpm")


@dataclass(frozen=True)
class Loaded:
    """The drive under one torque: its chart and what is to be said of it."""

    drive: GearDrive
    chart: xr.Dataset
    iso: IsoDynamicFactor | None
    verdict: Verdict


@dataclass(frozen=True)
class Answer:
    """What a file's drive does: under each torque, and idle."""

    file: DriveFile
    drive: GearDrive
    loaded: tuple[Loaded, ...]
    idle: IdleRattle | None

    @property
    def title(self) -> str:
        """The pair in a line."""
        pair = self.file.pair
        return f"{pair.pinion_teeth}/{pair.gear_teeth} teeth, module {pair.module_mm:g} mm"

    @property
    def idle_sentence(self) -> str:
        """From which speed an idle gear rattles."""
        if self.idle is None:
            return ""
        onset = onset_rpm(self.drive, self.idle_given)
        return f"The idle gear rattles from {onset:.0f} rpm on; below, its drag keeps the teeth together."

    @property
    def idle_given(self) -> dict[str, float]:
        """What the file says of the idle gear."""
        return self.file.idle or {}

    def __str__(self) -> str:
        parts = [self.title]
        for each in self.loaded:
            table = speed_range_table(each.verdict.avoid).text(widest=26)
            parts.append(f"{each.drive.pinion_torque_nm:g} N m\n{each.verdict}\n\n{table}")
        if self.idle_sentence:
            parts.append(self.idle_sentence)
        parts += [f"Taken, where the file leaves a choice: {note}." for note in self.file.notes]
        return "\n\n".join(parts)


def answer(path: Path, *, progress: bool) -> Answer:
    """Compute all that the file asks for; how far it is stands on stderr.

    Raises
    ------
    StudyError
        In a sentence that begins with the file's name.
    """
    try:
        file = read_drive_file(path)
        drive = file.made(GearDrive)
    except ValueError as error:
        raise StudyError(str(error)) from None
    try:
        speeds = chart_speeds(drive, **{name: file.value(name) for name in SPEEDS})
        loaded = []
        for torque in file.torques_nm:
            if progress:
                print(f"{path}: {torque:g} N m, {len(speeds)} speeds", file=sys.stderr)
            loaded.append(_loaded(file, drive.replace(pinion_torque_nm=torque), speeds, progress))
        return Answer(file, drive, tuple(loaded), _idle(file, drive))
    except ValueError as error:
        raise StudyError(f"{path}: {error}") from None


def _loaded(file: DriveFile, drive: GearDrive, speeds: NDArray[np.float64], progress: bool) -> Loaded:
    counts = {name: file.value(name) for name in ("n_starts", "n_phases")}
    chart = speed_chart(drive, speeds, **counts, progress=progress)
    deviations = file.iso_deviations
    iso = iso_dynamic_factor(drive, speeds, **deviations) if deviations else None
    return Loaded(drive, chart, iso, verdict(chart, iso, file.value("service_rpm")))


def onset_rpm(drive: GearDrive, given: dict[str, Any]) -> float:
    """The speed from which an idle gear rattles: the ratio of inertia torque to drag grows with its square."""
    speeds = [100.0, 200.0]
    ratio = idle_rattle(drive, speeds, **given).rattle_ratio[1]
    return float(speeds[1] / np.sqrt(ratio)) if ratio > 0.0 else np.inf


def _idle(file: DriveFile, drive: GearDrive) -> IdleRattle | None:
    if (given := file.idle) is None:
        return None
    onset = onset_rpm(drive, given)
    if not np.isfinite(onset):
        raise ValueError("idle_swing_deg must be above 0 for a gear that could rattle, got 0.0")
    low = file.value("lowest_rpm") or IDLE_FIRST * onset
    high = file.value("highest_rpm") or max(IDLE_LAST * onset, BEYOND * (file.value("service_rpm") or (0.0, low))[1])
    if not low < high:
        raise ValueError(f"the idle gear's speeds would begin at {low:g} and end at {high:g} rpm: give both ends")
    return idle_rattle(drive, np.linspace(low, high, file.value("n_speeds")), **given)
