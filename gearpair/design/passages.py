"""A drive while its speed and its load change: run-up, coast-down, load change, and schedules of both."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_count, check_number, check_truths, checked, shown
from gearpair.design.courses import Course, course_of, mesh_cycles
from gearpair.design.loads import sampled_force_n
from gearpair.drive import GearDrive
from gearpair.motion.passages import error_and_rate, passage
from gearpair.motion.steady import SteadyState, steady_state
from gearpair.motion.trajectories import check_start
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes
from gearpair.stiffness import StiffnessWave

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
WITHIN = 12  # mesh periods in which the moments of a load change lie
AFTERWARDS = 20  # mesh periods, the last of a passage


@checked
def run_up(
    drive: GearDrive,
    from_rpm: float,
    to_rpm: float,
    seconds: float,
    *,
    start: SteadyState | tuple[float, float] | None = None,
    accelerates: bool = True,
    samples_per_period: int = 0,
) -> xr.Dataset:
    """The drive while its speed rises, or falls, steadily: a run-up or a coast-down.

    Parameters
    ----------
    drive : GearDrive
    from_rpm, to_rpm : float
        Speeds of the pinion, above 0.
    seconds : float
        How long it takes.
    start, accelerates, samples_per_period
        As in `schedule`, which this is a short way to.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.0)], damping_ratio=0.08)
    >>> run = run_up(drive, 3000.0, 9000.0, 0.2)
    >>> run.sizes["cycle"], bool(run.dynamic_factor.max() > 1.5)
    (680, True)
    """
    ends = [check_number(name, rpm, above=0.0) for name, rpm in (("from_rpm", from_rpm), ("to_rpm", to_rpm))]
    seconds = check_number("seconds", seconds, above=0.0)
    return schedule(
        drive,
        seconds,
        speed_rpm=[(0.0, ends[0]), (seconds, ends[1])],
        start=start,
        accelerates=accelerates,
        samples_per_period=samples_per_period,
    )


@checked
def load_change(
    drive: GearDrive,
    torque_nm: Course,
    seconds: float,
    *,
    start: SteadyState | tuple[float, float] | None = None,
    samples_per_period: int = 0,
) -> xr.Dataset:
    """The drive at its own speed while its torque changes: tip-in, tip-out, reversal.

    Parameters
    ----------
    drive : GearDrive
        With a speed.
    torque_nm : sequence of (float, float)
        Seconds and torque of the pinion, as in `schedule`: ``[(0, -20), (0.005, 120)]`` rises from the first to the
        second in 5 ms and stays there.
    seconds : float
        How long the drive is followed.
    start, samples_per_period
        As in `schedule`, which this is a short way to.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.0)], damping_ratio=0.08, pinion_speed_rpm=2000.0)
    >>> tip_in = load_change(drive, [(0.0, -20.0), (0.005, 120.0)], 0.05)
    >>> str(tip_in.impact_state.values[0]), str(tip_in.impact_state.values[-1])
    ('single_coast', 'none_drive')
    """
    return schedule(
        drive,
        seconds,
        speed_rpm=drive.mesh_frequency_rad_s * 60.0 / (2.0 * np.pi * drive.pinion_teeth),
        torque_nm=torque_nm,
        start=start,
        samples_per_period=samples_per_period,
    )


@checked
def load_change_moments(
    drive: GearDrive, torque_nm: Sequence[tuple[float, float]], seconds: float, *, n_moments: int = 48
) -> xr.Dataset:
    """The same change of load begun at many moments of the mesh, since nobody times a pedal to a tooth.

    Parameters
    ----------
    drive, torque_nm
        As of `load_change`; the drive is in the steady motion of the first torque.
    seconds : float
        How long the drive is followed once the change has begun.
    n_moments : int
        Moments at which it begins: so many parts of a mesh period, in twelve mesh periods by turns.

    Returns
    -------
    xarray.Dataset
        Over ``begins``, the moments in mesh periods: ``dynamic_factor``, the largest on the way; ``factor_after``, that
        of the last 20 mesh periods; ``impact_velocity`` (mm/s), the largest; ``coast_struck``, whether that flank is.

    Notes
    -----
    Where the teeth fly for a while, what follows hangs on the last digit of a moment: a share of many moments is a
    result, one of them is not.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.0)], damping_ratio=0.08, pinion_speed_rpm=2000.0)
    >>> tip_ins = load_change_moments(drive, [(0.0, -20.0), (0.005, 120.0)], 0.1, n_moments=5)
    >>> tip_ins.sizes["begins"], bool(tip_ins.coast_struck.any())
    (5, True)
    """
    import xarray as xr  # here, so that importing gearpair stays quick

    n_moments = check_count("n_moments", n_moments)
    seconds = check_number("seconds", seconds, above=0.0)
    k = np.arange(n_moments)
    begins = 1.0 + k % WITHIN + (k + 0.5) / n_moments  # the first mesh period has the torque before, all through
    period = 2.0 * np.pi / drive.mesh_frequency_rad_s
    times, torques = course_of("torque_nm", torque_nm)
    rows = []
    for late in (begins * period).tolist():
        course = [(0.0, torques[0]), *zip(late + times, torques, strict=True)]
        run = load_change(drive, course, late + seconds)
        after = run.dynamic_factor[-AFTERWARDS:].max()
        rows.append((run.dynamic_factor.max(), after, run.impact_velocity.max(), run.coast_impacts.any()))
    names = ("dynamic_factor", "factor_after", "impact_velocity", "coast_struck")
    columns = dict(zip(names, map(np.array, zip(*rows, strict=True)), strict=True))
    variables = {name: ("begins", column, attributes(name)) for name, column in columns.items()}
    return xr.Dataset(variables, {"begins": ("begins", begins, attributes("begins"))}, {"drive": repr(drive)})


@checked
def how_many_moments(where: ArrayLike) -> str:
    """At how many of the moments something is so, as coarsely as some dozens of them can tell.

    ``"none"``, ``"few"`` (under a quarter), ``"some"``, ``"most"`` (over three quarters) or ``"all"``.

    Examples
    --------
    >>> [how_many_moments(where) for where in ([True], [True, False], [False])]
    ['all', 'some', 'none']
    """
    truths = check_truths("where", where)
    if truths.all() or not truths.any():
        return "all" if truths.all() else "none"
    share = float(truths.mean())
    return "few" if share < 0.25 else "most" if share > 0.75 else "some"


@checked
def schedule(
    drive: GearDrive,
    seconds: float,
    *,
    speed_rpm: Course,
    torque_nm: Course | None = None,
    start: SteadyState | tuple[float, float] | None = None,
    accelerates: bool = True,
    samples_per_period: int = 0,
) -> xr.Dataset:
    """The drive while its speed and its torque change, mesh period by mesh period.

    Parameters
    ----------
    drive : GearDrive
        With a known phase of its error (`GearDrive.at_phase`) and without `shaft_orders`.
    seconds : float
        How long it is followed; the last mesh period is a whole one.
    speed_rpm : float or sequence of (float, float)
        Speed of the pinion, above 0: a number, or pairs of seconds and speed, with straight lines in between. The first
        is at 0 s; the last value stays.
    torque_nm : float or sequence of (float, float), optional
        Torque of the pinion that its load balances, likewise; that of `drive` when not given.
    start : SteadyState or (float, float), optional
        The motion it comes from, at the first speed and torque, or X and X'; the steady motion from rest at the static
        deflection when not given.
    accelerates : bool
        Whether the mesh carries what accelerates the driven side besides its load.
    samples_per_period : int
        Samples of the dynamic transmission error and the mesh force to keep of each mesh period.

    Returns
    -------
    xarray.Dataset
        Over ``cycle``, the mesh periods: ``time`` (s), ``speed`` (rpm), ``torque`` (N m), ``mean_mesh_force`` (N),
        ``x_min`` and ``x_max`` (of X), ``mesh_force`` (N), ``dynamic_factor``, ``drive_impacts``, ``coast_impacts``,
        ``impact_velocity`` (mm/s), ``impact_state``; ``x`` and ``v`` at its start. With samples ``sample_time``,
        ``sample_dte`` (um) and ``sample_force`` (N, positive on the drive flank) over ``(cycle, sample)``.

    Raises
    ------
    RuntimeError
        Where the motion escapes to infinity or the walk is capped.

    Notes
    -----
    A mesh period has the mean speed and the mean acceleration over it; see `passage` for what goes on from one to the
    next. The mean force is ``m_e (r_b1 T1 / I1 + r_b2 T2 / I2)``, where the load T2 is that which the given torque
    balances at constant speed, and T1 brings what accelerates both rotors besides; without `accelerates` it is that of
    constant speed. The dynamic factor is over the mean force of `drive`, whatever the present torque.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.0)], damping_ratio=0.08)
    >>> ride = schedule(drive, 0.1, speed_rpm=[(0.0, 2000.0), (0.1, 3000.0)], torque_nm=[(0.0, 20.0), (0.05, 100.0)])
    >>> ride.sizes["cycle"], round(float(ride.torque[-1]))
    (142, 100)
    """
    import xarray as xr  # here, so that importing gearpair stays quick

    check_count("samples_per_period", samples_per_period, at_least=0)
    check_one_course(drive)
    torque_nm = drive.pinion_torque_nm if torque_nm is None else torque_nm
    cycles = mesh_cycles(drive, seconds, speed_rpm, torque_nm)
    unit = drive.unit_force_n
    mean_force = cycles.torque / (drive.pinion_base_radius_mm * 1e-3)
    if accelerates:
        mean_force = mean_force + inertia_force_n(drive, cycles.acceleration)
    meshing = cache(partial(under_torque, drive))
    frequencies, forces = cycles.speed / drive.resonance_rpm, mean_force / unit
    oscillators = [
        meshing(torque).replace(mesh_frequency=frequency, mean_force=force)
        for torque, frequency, force in zip(cycles.torque.tolist(), frequencies.tolist(), forces.tolist(), strict=True)
    ]
    before = float(course_of("torque_nm", torque_nm)[1][0])
    less = (before - float(cycles.torque[0])) / (drive.pinion_base_radius_mm * 1e-3) / unit
    begun = meshing(before).replace(mesh_frequency=frequencies[0], mean_force=forces[0] + less)
    x, v = _begun(start, begun, oscillators[0])
    run = passage(oscillators, x, v, samples_per_period=samples_per_period)
    mm_s = drive.half_backlash_m * drive.natural_frequency_rad_s * 1e3
    columns: dict[str, Any] = {
        "time": cycles.time[:-1],
        "speed": cycles.speed,
        "torque": cycles.torque,
        "mean_mesh_force": mean_force,
        "mesh_force": run.largest_force.values * unit,
        "dynamic_factor": run.largest_force.values * unit / (abs(drive.mean_force_n) or np.nan),
        "impact_velocity": np.maximum(run.drive_velocity, run.coast_velocity).values * mm_s,
    }
    variables = {name: ("cycle", column, attributes(name)) for name, column in columns.items()}
    kept = ("x", "v", "x_min", "x_max", "drive_impacts", "coast_impacts", "impact_state")
    result = xr.Dataset(variables, run.coords, {"drive": repr(drive)}).assign({name: run[name] for name in kept})
    return result.assign(_samples(drive, oscillators, run)) if samples_per_period else result


def _begun(
    start: SteadyState | tuple[float, float] | None, before: Oscillator, first: Oscillator
) -> tuple[float, float]:
    """X and X' that a schedule starts from, its first mesh period being `first`; or a ValueError.

    Not given, it comes from the steady motion of `before`, whose X + e and its rate go on.
    """
    if isinstance(start, SteadyState):
        x, v = start.points[0].tolist()
        return x, v
    if start is None:
        x, v = steady_state(before).points[0].tolist()
        (e, rate), (e_first, rate_first) = error_and_rate(before), error_and_rate(first)
        return x + e - e_first, v + rate - rate_first
    pair = check_array("start", start)
    if pair.shape != (2,):
        raise ValueError(f"start must be a settled motion, or X and X', got {shown(start)}")
    return check_start(*pair.tolist())


def under_torque(drive: GearDrive, torque_nm: float) -> Oscillator:
    """The oscillator of a drive under another torque, in the units of X, tau and force that `drive` has.

    Stiffness and error of relieved tips follow the torque, and an error of the profile its sign.
    """
    osc = drive.at_speed(drive.resonance_rpm).oscillator()
    if torque_nm == drive.pinion_torque_nm or not (drive.profile_harmonics or drive.relief):
        return osc
    other = drive.replace(pinion_torque_nm=torque_nm).at_speed(drive.resonance_rpm)
    meshing, stiffer = other.oscillator(), other.mean_stiffness_n_per_um / drive.mean_stiffness_n_per_um
    return osc.replace(
        stiffness=StiffnessWave(meshing.stiffness.edges, tuple(stiffer * each for each in meshing.stiffness.levels)),
        error_amplitude=meshing.error_amplitude,
        error_phase=meshing.error_phase,
        harmonics=meshing.harmonics,
    )


def _samples(drive: GearDrive, oscillators: Sequence[Oscillator], run: xr.Dataset) -> dict[str, Any]:
    """What the samples of a passage are in SI units."""
    fraction, x = np.arange(run.sizes["sample"]) / run.sizes["sample"], run.sample_x.values
    found = {
        "sample_time": run.sample_tau.values / drive.natural_frequency_rad_s,
        "sample_dte": (x + [osc.error(fraction * osc.period) for osc in oscillators]) * drive.half_backlash_m * 1e6,
        "sample_force": sampled_force_n(drive, x, np.array([osc.stiffness(fraction) for osc in oscillators])),
    }
    return {name: (("cycle", "sample"), values, attributes(name)) for name, values in found.items()}


def inertia_force_n(drive: GearDrive, acceleration: ArrayLike) -> Array:
    """The mesh force (N) that accelerates the driven side at a pinion's acceleration (rad/s^2), ``I2 a2 / r_b2``."""
    radius, driven = drive.pinion_base_radius_mm * 1e-3, drive.gear_base_radius_mm * 1e-3
    return np.asarray(drive.gear_inertia_kg_m2 * np.asarray(acceleration) * radius / driven**2)


def check_one_course(drive: GearDrive) -> None:
    """A ValueError unless the error of a drive has one known course over every mesh period."""
    if drive.phase_is_unknown:
        raise ValueError(
            "drive must have an error of a known phase, got one given as an amplitude alone: take drive.at_phase(rad), "
            'of the worst phase with chart.attrs["run_phase_rad"] of a speed_chart'
        )
    if any(each.amplitude for each in drive.shaft_orders):
        raise ValueError(f"drive must repeat with the mesh period, got shaft_orders = {drive.shaft_orders}")
