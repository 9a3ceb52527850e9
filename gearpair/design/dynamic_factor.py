"""ISO 6336-1's dynamic factor, method B: the number that a gear designer would otherwise take."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_number, checked
from gearpair._equality import equal_by_value
from gearpair.drive import GearDrive
from gearpair.teeth import iso_stiffness

MAIN_RESONANCE, SUPERCRITICAL = 1.15, 1.5  # upper end of the main resonance, lower end of the supercritical range


@equal_by_value
@dataclass(frozen=True)
class IsoDynamicFactor:
    """K_v of ISO 6336-1, method B, over the speed; arrays have shape (n,).

    Attributes
    ----------
    speed_rpm : ndarray of float
        The pinion's.
    resonance_ratio : ndarray of float
        N, the speed over `resonance_rpm`.
    k_v : ndarray of float
        The factor; nan outside the standard's range.
    resonance_rpm : float
        n_E1, where the mesh frequency meets the natural frequency.
    lower_limit : float
        N_S, where the main resonance begins.
    specific_load_n_per_mm : float
        F_t K_A / b.
    outside_range : str
        Why the pair is outside the standard's range, in a sentence; empty where it is not.
    """

    speed_rpm: NDArray[np.float64]
    resonance_ratio: NDArray[np.float64]
    k_v: NDArray[np.float64]
    resonance_rpm: float
    lower_limit: float
    specific_load_n_per_mm: float
    outside_range: str = ""


@checked
def iso_dynamic_factor(
    drive: GearDrive,
    speeds_rpm: ArrayLike,
    *,
    base_pitch_um: float,
    profile_um: float,
    relief_um: float | None = None,
    application_factor: float = 1.0,
) -> IsoDynamicFactor:
    """The dynamic factor K_v by ISO 6336-1, method B.

    Parameters
    ----------
    drive : GearDrive
        Of `GearDrive.from_pair`: the formulas need its teeth. Without a torque, or with shifts that the standard's
        formula for the stiffness does not allow, there is no factor, and `IsoDynamicFactor.outside_range` says why.
    speeds_rpm : array_like of float, shape (n,)
        Of the pinion.
    base_pitch_um, profile_um : float
        Effective base pitch and profile form deviations f_pb and f_falpha, of the gear with the larger ones, after
        running in.
    relief_um : float, optional
        Tip relief C_a where the accuracy is good enough for it to count (grade 5 and better); not given: B_k = 1, as
        the standard has it for grades 6 to 12.
    application_factor : float
        K_A.

    Notes
    -----
    The standard's text was not at hand. The formulas are those of ISO 6336-1:2006, clause 6, equations (6), (9), (11)
    to (17) and (20) to (22), as a public implementation gives them with these numbers (``Iso6336DynamicFactor.cs``
    of github.com/hakangunes258/mekanika, commit c44c3eb); nothing has been compared with the standard's own pages::

        n_E1 = 30000 / (pi z1) sqrt(c_gamma / m_red),   N = n1 / n_E1
        N_S = 0.85, below 100 N/mm: 0.5 + 0.35 sqrt((F_t K_A / b) / 100)
        B_p = c' f_pb / (F_t K_A / b),   B_f = c' f_falpha / (F_t K_A / b),   B_k = |1 - c' C_a / (F_t K_A / b)|
        K_v = N (C_v1 B_p + C_v2 B_f + C_v3 B_k) + 1          up to N_S
        K_v = C_v1 B_p + C_v2 B_f + C_v4 B_k + 1              up to 1.15
        K_v = C_v5 B_p + C_v6 B_f + C_v7                      from 1.5, linear in N from 1.15 to 1.5

    c' and c_gamma are those of `iso_stiffness` at this load. m_red is the equivalent mass of the drive over the face
    width, with what turns with the gears, where the standard's formula takes discs.

    Examples
    --------
    >>> from gearpair import GearDrive, SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=5.0, damping_ratio=0.05)
    >>> iso = iso_dynamic_factor(drive, [1000.0, 8000.0, 20000.0], base_pitch_um=8.0, profile_um=8.0)
    >>> iso.k_v.round(2)
    array([1.1 , 2.61, 1.78])
    """
    if drive.mesh is None:
        raise ValueError("drive must come from GearDrive.from_pair: K_v needs the teeth, and this one has none")
    base_pitch_um = check_number("base_pitch_um", base_pitch_um, at_least=0.0)
    profile_um = check_number("profile_um", profile_um, at_least=0.0)
    application_factor = check_number("application_factor", application_factor, above=0.0)
    pair = drive.mesh.pair
    width = pair.contact_width_mm
    load = abs(drive.pinion_torque_nm) * 1e3 / pair.pinion.pitch_radius_mm / width * application_factor
    speeds = check_array("speeds_rpm", speeds_rpm, at_least=0.0)
    relief_um = None if relief_um is None else check_number("relief_um", relief_um, at_least=0.0)
    lower = 0.85 if load >= 100.0 else 0.5 + 0.35 * math.sqrt(load / 100.0)
    try:
        if load == 0.0:
            raise ValueError("K_v is a factor of the load, and pinion_torque_nm is 0")
        stiffness = iso_stiffness(pair, specific_load_n_per_mm=load)
    except ValueError as refusal:
        nothing = np.full_like(speeds, np.nan)
        return IsoDynamicFactor(speeds, nothing, nothing.copy(), math.nan, lower, load, str(refusal))
    unit = stiffness.single / load
    relief = 1.0 if relief_um is None else abs(1.0 - unit * relief_um)
    deviations = np.array([unit * base_pitch_um, unit * profile_um])
    reduced = drive.equivalent_mass_kg / width  # kg/mm
    resonance = 30_000.0 / (math.pi * pair.pinion_teeth) * math.sqrt(stiffness.mesh / reduced)
    sub, main, above, rest = _coefficients(pair.contact_ratio)
    slow = float(sub[:2] @ deviations + sub[2] * relief)
    peak = float(main[:2] @ deviations + main[2] * relief) + 1.0
    fast = float(above @ deviations) + rest
    ratio = speeds / resonance
    between = fast + (peak - fast) / (SUPERCRITICAL - MAIN_RESONANCE) * (SUPERCRITICAL - ratio)
    factor = np.select(
        [ratio <= lower, ratio <= MAIN_RESONANCE, ratio < SUPERCRITICAL], [1.0 + ratio * slow, peak, between], fast
    )
    return IsoDynamicFactor(speeds, ratio, np.maximum(factor, 1.0), resonance, lower, load)


def _coefficients(contact_ratio: float) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], float]:
    """The coefficients C_v1 to C_v7: below, at, and above the resonance, and what is left there."""
    e = contact_ratio
    if e <= 2.0:
        second, third, fourth, sixth = 0.34, 0.23, 0.90, 0.47
    else:
        second, third = 0.57 / (e - 0.3), 0.096 / (e - 1.56)
        fourth, sixth = (0.57 - 0.05 * e) / (e - 1.44), 0.12 / (e - 1.74)
    rest = 0.75 if e <= 1.5 else 0.125 * math.sin(math.pi * (e - 2.0)) + 0.875 if e <= 2.5 else 1.0
    return np.array([0.32, second, third]), np.array([0.32, second, fourth]), np.array([0.47, sixth]), rest
