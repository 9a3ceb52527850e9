"""The article's derivation, checked: two rotors in SI units beside the one oscillator that is made of them."""

import numpy as np
from numpy.typing import NDArray

from gearpair.drive import GearDrive
from gearpair.motion.trajectories import stroboscopic_map
from gearpair.oscillator import Oscillator

UNITS = GearDrive(
    pinion_teeth=34,
    pinion_inertia_kg_m2=2e-3,
    gear_inertia_kg_m2=5e-3,
    pinion_base_radius_mm=47.9,
    gear_base_radius_mm=62.0,
    pinion_torque_nm=120.0,
    backlash_um=100.0,
    transmission_error_um=10.0,
    mean_stiffness_n_per_um=350.0,
    damping_n_s_per_m=500.0,
)  # any drive will do: only its inertias, radii, stiffness and backlash are used


def two_rotors(drive: GearDrive, x: float, v: float, n_periods: int) -> NDArray[np.float64]:
    """X and X' of a drive's two rotors at the start and at the end of each mesh period, integrated in SI units.

    Parameters
    ----------
    x, v : float
        X and X' at the start (dimensionless).

    Returns
    -------
    ndarray of float, shape (n_periods + 1, 2)

    Notes
    -----
    I1 theta1'' = T1 - r_b1 W and I2 theta2'' = -T2 + r_b2 W with W = c_h x' + k_h f(x) and
    x = r_b1 theta1 - r_b2 theta2 - e(t): the article, items M1 to M4. Every switch of the stiffness ends an
    integration, so that each runs over a smooth piece but for the impacts.
    """
    from scipy.integrate import solve_ivp  # here, so that importing gearpair stays quick

    b, omega_n, omega_h = drive.half_backlash_m, drive.natural_frequency_rad_s, drive.mesh_frequency_rad_s
    radii = 1e-3 * np.array([drive.pinion_base_radius_mm, -drive.gear_base_radius_mm])
    inertias = np.array([drive.pinion_inertia_kg_m2, drive.gear_inertia_kg_m2])
    torques = np.array([drive.pinion_torque_nm, -drive.gear_torque_nm])
    period, wave = 2.0 * np.pi / omega_h, drive.stiffness

    def relative(t: float, y: NDArray[np.float64]) -> NDArray[np.float64]:
        """X and X' in metres and seconds."""
        angle, size = omega_h * t + (drive.error_phase_rad or 0.0), drive.transmission_error_um * 1e-6
        return np.array([y[:2] @ radii - size * np.sin(angle), y[2:] @ radii - size * omega_h * np.cos(angle)])

    def slopes(t: float, y: NDArray[np.float64], level: float) -> NDArray[np.float64]:
        distance, rate = relative(t, y)
        contact = distance - np.clip(distance, -b, b)
        force = drive.damping_n_s_per_m * rate + 1e6 * drive.mean_stiffness_n_per_um * level * contact
        return np.concatenate([y[2:], (torques - radii * force) / inertias])

    # Only x and x' matter: the pinion turns for both.
    scale = np.array([b, b * omega_n])
    turned, speed = (scale * (x, v) - relative(0.0, np.zeros(4))) / radii[0]
    y = np.array([turned, 0.0, speed, 0.0])
    found = [relative(0.0, y) / scale]
    for cycle in range(n_periods):
        for start, length, level in zip(wave.edges, wave.durations, wave.levels, strict=True):
            span = np.array([cycle + start, cycle + start + length]) * period
            steps = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-15, "max_step": period / 400.0}
            y = solve_ivp(slopes, span, y, args=(level,), **steps).y[:, -1]
        found.append(relative((cycle + 1) * period, y) / scale)
    return np.array(found)


def two_rotor_difference(osc: Oscillator, x: float = 1.3, v: float = 0.2, n_periods: int = 2) -> float:
    """The largest difference of X between `two_rotors` and the oscillator that replaces them.

    Parameters
    ----------
    x, v : float
        X and X' at the start (dimensionless).
    n_periods : int
        Mesh periods; X is compared at the end of each.

    Returns
    -------
    float
        In units of half the backlash.

    Examples
    --------
    >>> two_rotor_difference(Oscillator()) < 1e-5
    True
    """
    rotors = two_rotors(UNITS.with_oscillator(osc), x, v, n_periods)[:, 0]
    exact = [float(stroboscopic_map(osc, x, v, n)[0]) for n in range(n_periods + 1)]
    return float(np.abs(rotors - exact).max())
