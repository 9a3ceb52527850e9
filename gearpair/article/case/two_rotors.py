"""The article's derivation, checked: two rotors in SI units beside the one oscillator that is made of them."""

from __future__ import annotations

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


def two_rotor_difference(osc: Oscillator, x: float = 1.3, v: float = 0.2, n_periods: int = 2) -> float:
    """The largest difference of X between two rotors, integrated as they are, and the oscillator that replaces them.

    Parameters
    ----------
    osc : Oscillator
    x, v : float
        X and X' at the start (dimensionless).
    n_periods : int
        Mesh periods; X is compared at the end of each.

    Returns
    -------
    float
        In units of half the backlash.

    Notes
    -----
    I1 theta1'' = T1 - r_b1 W and I2 theta2'' = -T2 + r_b2 W with W = c_h x' + k_h f(x) and
    x = r_b1 theta1 - r_b2 theta2 - e(t): the article, items M1 to M4.

    Examples
    --------
    >>> two_rotor_difference(Oscillator()) < 1e-5
    True
    """
    from scipy.integrate import solve_ivp  # here, so that importing gearpair stays quick

    drive = UNITS.with_oscillator(osc)
    b, omega_n, omega_h = drive.half_backlash_m, drive.natural_frequency_rad_s, drive.mesh_frequency_rad_s
    radii = 1e-3 * np.array([drive.pinion_base_radius_mm, drive.gear_base_radius_mm])
    inertias = np.array([drive.pinion_inertia_kg_m2, drive.gear_inertia_kg_m2])
    torques = np.array([drive.pinion_torque_nm, drive.gear_torque_nm])
    signs, error, psi = np.array([1.0, -1.0]), drive.transmission_error_um * 1e-6, drive.error_phase_rad

    def slopes(t: float, y: NDArray[np.float64]) -> NDArray[np.float64]:
        distance = signs @ (radii * y[:2]) - error * np.sin(omega_h * t + psi)
        rate = signs @ (radii * y[2:]) - error * omega_h * np.cos(omega_h * t + psi)
        stiffness = 1e6 * drive.mean_stiffness_n_per_um * float(drive.stiffness(omega_h * t / (2.0 * np.pi)))
        contact = distance - np.clip(distance, -b, b)
        force = drive.damping_n_s_per_m * rate + stiffness * contact
        return np.concatenate([y[2:], signs * (torques - radii * force) / inertias])

    # Only x and x' matter: the pinion turns for both.
    turned = (b * x + error * np.sin(psi)) / radii[0]
    speed = (b * omega_n * v + error * omega_h * np.cos(psi)) / radii[0]
    ends = 2.0 * np.pi / omega_h * np.arange(n_periods + 1)
    steps = {"rtol": 1e-10, "atol": 1e-14, "max_step": ends[1] / 400.0}
    run = solve_ivp(slopes, (0.0, ends[-1]), [turned, 0.0, speed, 0.0], t_eval=ends, **steps)
    rotors = (signs @ (radii[:, None] * run.y[:2]) - error * np.sin(omega_h * ends + psi)) / b
    exact = [float(stroboscopic_map(osc, x, v, n)[0]) for n in range(n_periods + 1)]
    return float(np.abs(rotors - exact).max())
