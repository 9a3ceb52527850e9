"""The course of a speed and of a torque over time, and the mesh periods that a drive then goes through."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_array, check_number
from gearpair.drive import GearDrive

Course = float | Sequence[tuple[float, float]]  # a number, or (seconds, number) in between which it runs straight
Array = NDArray[np.float64]
MOST_CYCLES = 10**6


class Cycles(NamedTuple):
    """The mesh periods of a schedule; all of shape (n,) but `time` (n + 1,)."""

    time: Array  # s, the start of each and the end of the last
    speed: Array  # rpm of the pinion, the mean over each
    torque: Array  # N m, at the middle of each
    acceleration: Array  # rad/s^2 of the pinion, the mean over each


def mesh_cycles(drive: GearDrive, seconds: float, speed_rpm: Course, torque_nm: Course) -> Cycles:
    """The mesh periods of a schedule, from 0 s to the first that ends at `seconds` or after.

    Between its points the speed runs straight, so the phase is a parabola and the time of a phase its root.
    """
    seconds = check_number("seconds", seconds, above=0.0)
    times, speeds = course_of("speed_rpm", speed_rpm)
    for i, speed in enumerate(speeds.tolist()):
        check_number("speed_rpm" if len(speeds) == 1 else f"speed_rpm[{i}]", speed, above=0.0)
    rate = drive.pinion_teeth / 60.0  # mesh periods a second at 1 rpm
    begun = np.concatenate([[0.0], np.cumsum(np.diff(times) * 0.5 * (speeds[1:] + speeds[:-1]) * rate)])
    slopes = np.append(np.diff(speeds) / np.diff(times), 0.0) * rate  # after the last point the speed stays
    at = np.searchsorted(times, seconds, side="right") - 1
    after = seconds - times[at]
    whole = begun[at] + after * (speeds[at] * rate + 0.5 * slopes[at] * after)
    n = np.ceil(round(float(whole), 9))
    if not n <= MOST_CYCLES:
        raise ValueError(f"seconds must leave at most {MOST_CYCLES} mesh periods, got {seconds}, which are {n:.6g}")
    phase = np.arange(n + 1.0)
    piece = np.searchsorted(begun, phase, side="right") - 1
    first, slope = speeds[piece] * rate, slopes[piece]
    to_go = phase - begun[piece]
    time = times[piece] + 2.0 * to_go / (first + np.sqrt(first**2 + 2.0 * slope * to_go))
    now = np.interp(time, times, speeds)
    return Cycles(
        time,
        1.0 / (rate * np.diff(time)),
        np.interp(0.5 * (time[1:] + time[:-1]), *course_of("torque_nm", torque_nm)),
        np.diff(now) / np.diff(time) * 2.0 * np.pi / 60.0,
    )


def course_of(name: str, given: Course) -> tuple[Array, Array]:
    """Times and values of a course, or a ValueError that says what is wrong with it."""
    array = check_array(name, given)
    if array.ndim == 0:
        return np.array([0.0]), np.array([check_number(name, given)])
    if array.ndim != 2 or array.shape[1] != 2 or not len(array) or not np.all(np.isfinite(array)):
        raise ValueError(f"{name} must be a number or pairs of seconds and a number, got {given!r}")
    times = array[:, 0]
    if times[0] != 0.0:
        raise ValueError(f"{name} must begin at 0 s, got {times[0]}")
    if not np.all(np.diff(times) > 0.0):
        raise ValueError(f"{name} must have times that rise, each above the one before, got {times.tolist()}")
    return times, array[:, 1]
