"""Rattle without load: an idle gear driven by the unsteady turning of its pinion, by the same exact flow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_number, checked
from gearpair._equality import equal_by_value
from gearpair.design.charts import carried_runs, check_speeds
from gearpair.drive import GearDrive
from gearpair.motion.measures import impact_measures
from gearpair.motion.settling import Status
from gearpair.motion.steady import SteadyState
from gearpair.motion.trajectories import trajectory
from gearpair.oscillator import Oscillator
from gearpair.stiffness import StiffnessWave


@equal_by_value
@dataclass(frozen=True)
class IdleRattle:
    """An idle gear over the speed of its pinion, run up; arrays have shape (n,).

    Attributes
    ----------
    speed_rpm : ndarray of float
        The pinion's.
    rattle_ratio : ndarray of float
        The largest inertia torque of the gear over its drag torque: above 1 the teeth part.
    impact_rate : ndarray of float
        Impacts per second, on both flanks.
    impact_velocity : ndarray of float
        The largest approach velocity in mm/s.
    impact_power : ndarray of float
        Kinetic energy of the relative motion before all impacts of a second, in watts; nan unless it is periodic.
    time_apart : ndarray of float
        Share of the time without contact.
    """

    speed_rpm: NDArray[np.float64]
    rattle_ratio: NDArray[np.float64]
    impact_rate: NDArray[np.float64]
    impact_velocity: NDArray[np.float64]
    impact_power: NDArray[np.float64]
    time_apart: NDArray[np.float64]


@checked
def idle_oscillator(
    drive: GearDrive, speed_rpm: float, *, order: float, pinion_swing_deg: float, drag_torque_nm: float
) -> Oscillator:
    """The oscillator of an idle gear whose pinion swings about its steady turning.

    Parameters
    ----------
    drive : GearDrive
        For the gear's inertia, the base radii, backlash, stiffness and damping. Its torque and transmission error do
        not count.
    speed_rpm : float
        The pinion's mean speed.
    order : float
        Swings per turn of the pinion, an engine order.
    pinion_swing_deg : float
        Amplitude of the swing, in degrees of the pinion: ``theta1 = omega t + swing sin(order omega t)``.
    drag_torque_nm : float
        What holds the gear back.

    Returns
    -------
    Oscillator
        Its "mesh period" is the period of the swing.

    Notes
    -----
    The pinion's motion is given, so the gear's inertia alone is left, ``m = I2 / r_b2^2``, and the swing stands for the
    transmission error:

        m x'' + c_h x' + k_m f(x) = T_drag / r_b2 + m r_b1 theta1''.

    The mesh stiffness is its mean: it changes z1 / order times faster than the swing, and matters only in contact.

    Examples
    --------
    >>> drive = GearDrive(pinion_teeth=34, pinion_inertia_kg_m2=2e-3, gear_inertia_kg_m2=2e-3,
    ...     pinion_base_radius_mm=47.9, gear_base_radius_mm=47.9, pinion_torque_nm=120.0, backlash_um=100.0,
    ...     transmission_error_um=10.0, mean_stiffness_n_per_um=350.0, damping_n_s_per_m=500.0)
    >>> osc = idle_oscillator(drive, 800.0, order=2.0, pinion_swing_deg=0.3, drag_torque_nm=0.2)
    >>> round(osc.error_amplitude, 2), len(osc.stiffness.levels)
    (5.02, 1)
    """
    speed_rpm = check_number("speed_rpm", speed_rpm, above=0.0)
    order = check_number("order", order, above=0.0)
    swing = np.radians(check_number("pinion_swing_deg", pinion_swing_deg, at_least=0.0))
    drag_torque_nm = check_number("drag_torque_nm", drag_torque_nm, at_least=0.0)
    mass, rate = _mass_and_rate(drive)
    return Oscillator(
        mean_force=drag_torque_nm / (drive.gear_base_radius_mm * 1e-3) / drive.unit_force_n,
        error_amplitude=swing * drive.pinion_base_radius_mm * 1e-3 / drive.half_backlash_m,
        error_phase=np.pi,  # the pinion's acceleration, minus the swing's
        damping_ratio=drive.damping_n_s_per_m / (2.0 * mass * rate),
        mesh_frequency=order * speed_rpm * 2.0 * np.pi / 60.0 / rate,
        stiffness=StiffnessWave((0.0,), (1.0,)),
    )


def _mass_and_rate(drive: GearDrive) -> tuple[float, float]:
    """I2 / r_b2^2 in kg, the gear's inertia along the line of action, and its natural frequency in rad/s."""
    mass = drive.gear_inertia_kg_m2 / (drive.gear_base_radius_mm * 1e-3) ** 2
    return mass, float(np.sqrt(drive.mean_stiffness_n_per_um * 1e6 / mass))


@checked
def idle_rattle(
    drive: GearDrive, speeds_rpm: ArrayLike, *, order: float, pinion_swing_deg: float, drag_torque_nm: float
) -> IdleRattle:
    """Rattle of an idle gear over the speed of its pinion.

    Parameters
    ----------
    drive : GearDrive
    speeds_rpm : array_like of float, shape (n,)
        Of the pinion, rising; run up.
    order, pinion_swing_deg, drag_torque_nm
        As in `idle_oscillator`; the drag above 0.

    Notes
    -----
    The ratio of inertia torque to drag torque, ``I2 (r_b1 / r_b2) swing (order omega)^2 / T_drag``, is the criterion of
    Brosey, Seaman, Johnson and Hamilton (International Journal of Vehicle Design 7, 1986, p. 45), who relate rattle to
    the angular acceleration, the inertia and the drag; only the paper's abstract was at hand. That the teeth part
    above 1 follows from the equation of `idle_oscillator` for a swing that is slow beside the mesh's own vibration.

    Examples
    --------
    >>> drive = GearDrive(pinion_teeth=34, pinion_inertia_kg_m2=2e-3, gear_inertia_kg_m2=2e-3,
    ...     pinion_base_radius_mm=47.9, gear_base_radius_mm=47.9, pinion_torque_nm=120.0, backlash_um=100.0,
    ...     transmission_error_um=10.0, mean_stiffness_n_per_um=350.0, damping_n_s_per_m=500.0)
    >>> found = idle_rattle(drive, [200.0, 800.0], order=2.0, pinion_swing_deg=0.3, drag_torque_nm=0.2)
    >>> found.rattle_ratio.round(2).tolist(), (found.impact_power * 1e3).round(2).tolist()  # milliwatts
    ([0.09, 1.47], [0.0, 2.78])
    """
    speeds = check_speeds(speeds_rpm)
    drag_torque_nm = check_number("drag_torque_nm", drag_torque_nm, above=0.0)
    given = {"order": order, "pinion_swing_deg": pinion_swing_deg, "drag_torque_nm": drag_torque_nm}
    oscillators = [idle_oscillator(drive, float(speed), **given) for speed in speeds]
    mass, rate = _mass_and_rate(drive)
    columns = np.full((4, len(speeds)), np.nan)
    for i, state in enumerate(carried_runs([oscillators], None)[0][0]):
        if state.status in (Status.ESCAPED, Status.CAPPED):
            continue
        found = impact_measures(state, n_periods=200)
        per_second = state.oscillator.mesh_frequency * rate / (2.0 * np.pi)
        unit = drive.half_backlash_m * rate
        speed = max(found.drive_velocity, found.coast_velocity) * unit
        count = (found.drive_impacts + found.coast_impacts) * per_second
        power = 0.5 * mass * unit**2 * _squares(state) * per_second
        columns[:, i] = count, speed * 1e3, power, found.flight_share
    ratio = np.array([osc.error_amplitude * osc.mesh_frequency**2 / osc.mean_force for osc in oscillators])
    return IdleRattle(speeds, ratio, *columns)


def _squares(state: SteadyState) -> float:
    """The sum of the squares of the approach velocities of a periodic motion's impacts, per period; else nan."""
    if state.period is None:
        return np.nan
    x, v = state.points[0].tolist()
    impacts = trajectory(state.oscillator, x, v, state.period, samples_per_period=1).impacts
    return float(np.sum(impacts.velocity[impacts.contact] ** 2)) / state.period
