"""What the teeth of a drive bear in one motion, in SI units."""

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import checked
from gearpair.drive import GearDrive
from gearpair.motion.measures import impact_measures
from gearpair.motion.same_orbit import lies_on
from gearpair.motion.settling import Status
from gearpair.motion.steady import SteadyState
from gearpair.motion.trajectories import trajectory

MEASURES = (
    *("dte_rms", "dte_peak_to_peak", "mesh_force", "tooth_force"),
    *("dynamic_factor", "time_apart", "impact_rate", "impact_velocity"),
)
SAMPLES_PER_PERIOD = 256
CHAOTIC_PERIODS = 200  # mesh periods over which a motion that is not periodic is measured


@checked
def measure_motion(drive: GearDrive, state: SteadyState) -> dict[str, float]:
    """The measures of a settled motion of `drive` by their names in `MEASURES`; nan for one that did not stay bounded.

    Parameters
    ----------
    drive : GearDrive
        Whose inertias, stiffness and backlash `state` is scaled with.
    state : SteadyState
        Of the drive's oscillator, at any speed.

    Notes
    -----
    Forces on the mesh, times apart, impacts and velocities are exact; the dynamic transmission error and the force on
    one pair of teeth are of 256 samples a mesh period. Of relieved teeth that is the pair's share at rest, under the
    mean force. A motion that is not periodic is measured over 200 mesh periods: a longer time may hold a harder blow.

    Examples
    --------
    >>> from gearpair.motion import steady_state
    >>> drive = GearDrive(pinion_teeth=34, pinion_inertia_kg_m2=2e-3, gear_inertia_kg_m2=2e-3,
    ...     pinion_base_radius_mm=47.9, gear_base_radius_mm=47.9, pinion_torque_nm=120.0, backlash_um=100.0,
    ...     transmission_error_um=10.0, mean_stiffness_n_per_um=350.0, damping_n_s_per_m=500.0)
    >>> loads = measure_motion(drive, steady_state(drive.at_speed(8000.0).oscillator()))
    >>> round(loads["mesh_force"]), round(loads["dynamic_factor"], 2), round(loads["impact_rate"])
    (9655, 3.85, 4533)
    """
    if state.status in (Status.ESCAPED, Status.CAPPED):
        return dict.fromkeys(MEASURES, np.nan)
    osc, unit_um = state.oscillator, drive.half_backlash_m * 1e6
    n_periods = state.period or osc.base_periods(CHAOTIC_PERIODS)
    found = impact_measures(state, n_periods=CHAOTIC_PERIODS)
    x, v = state.points[0].tolist()
    motion = trajectory(osc, x, v, n_periods, samples_per_period=SAMPLES_PER_PERIOD)
    error = (motion.x + osc.error(motion.tau))[:-1] * unit_um
    per_second = osc.mesh_frequency * drive.natural_frequency_rad_s / (2.0 * np.pi)
    return {
        "dte_rms": float(error.std()),
        "dte_peak_to_peak": float(np.ptp(error)),
        "mesh_force": max(found.drive_force, found.coast_force) * drive.unit_force_n,
        "tooth_force": _largest_tooth_force(drive, state, motion.x[:-1]),
        "dynamic_factor": found.load_factor,
        "time_apart": found.flight_share,
        "impact_rate": (found.drive_impacts + found.coast_impacts) * per_second,
        "impact_velocity": max(found.drive_velocity, found.coast_velocity)
        * drive.half_backlash_m
        * drive.natural_frequency_rad_s
        * 1e3,
    }


def _largest_tooth_force(drive: GearDrive, state: SteadyState, x: np.ndarray) -> float:
    """The largest share of the mesh force that a pair of teeth carries, at samples over whole mesh periods."""
    if drive.mesh is None:
        return np.nan
    fraction = np.arange(SAMPLES_PER_PERIOD) / SAMPLES_PER_PERIOD
    share = (drive.loaded_mesh or drive.mesh).load_share.max(axis=0)
    most = share[(fraction * len(share)).astype(int)] * state.oscillator.stiffness(fraction)
    return float(np.abs(sampled_force_n(drive, x.reshape(-1, SAMPLES_PER_PERIOD), most)).max())


def sampled_force_n(drive: GearDrive, x: NDArray[np.float64], stiffness: NDArray[np.float64]) -> NDArray[np.float64]:
    """The mesh force (N, positive on the drive flank) at X, of any shape, and k there."""
    return np.asarray(np.sign(x) * np.clip(np.abs(x) - 1.0, 0.0, None) * stiffness * drive.unit_force_n)


def one_error_for_both(drive: GearDrive, state: SteadyState) -> bool:
    """Whether a motion with an error of the profile, which has its sign on one flank alone, touches the other one."""
    other = state.x_min < -1.0 if drive.pinion_torque_nm >= 0.0 else state.x_max > 1.0
    return bool(drive.profile_harmonics) and bool(other)


def same_motion(a: SteadyState, b: SteadyState) -> bool:
    """Whether two settled motions of one oscillator are one; those that are not periodic are, if of one status."""
    if a.status != b.status or a.period != b.period:
        return False
    return a.period is None or lies_on(a.points[0], b.points)
