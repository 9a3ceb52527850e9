"""The gear pair in SI units, and its way to the dimensionless oscillator and back."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from gearpair._checks import check_count, check_number
from gearpair.oscillator import Oscillator
from gearpair.stiffness import StiffnessWave

POSITIVE = (
    "pinion_inertia_kg_m2",
    "gear_inertia_kg_m2",
    "pinion_base_radius_mm",
    "gear_base_radius_mm",
    "pinion_speed_rpm",
    "backlash_um",
    "mean_stiffness_n_per_um",
)
NOT_NEGATIVE = ("transmission_error_um", "damping_n_s_per_m")
ANY = ("pinion_torque_nm", "error_phase_rad")


@dataclass(frozen=True, kw_only=True)
class GearDrive:
    """Two rotors coupled by one mesh, in SI units (named in each parameter).

    With ``x = r_b1 theta1 - r_b2 theta2 - e(t)`` and the mesh force ``W = c_h x' + k_h(t) f(x)``,

        I1 theta1'' = T1 - r_b1 W,    I2 theta2'' = -T2 + r_b2 W,

    the load torque T2 balancing the driving torque T1 on average.

    Parameters
    ----------
    pinion_teeth : int
        z1; the mesh frequency is ``z1 * 2 pi * pinion_speed_rpm / 60``.
    pinion_inertia_kg_m2, gear_inertia_kg_m2 : float
        I1 and I2.
    pinion_base_radius_mm, gear_base_radius_mm : float
        r_b1 and r_b2.
    pinion_torque_nm : float
        T1, any sign.
    pinion_speed_rpm : float
        Revolutions per minute of the pinion.
    backlash_um : float
        The whole backlash along the line of action, 2 b_h.
    transmission_error_um : float
        e_a, the amplitude of the static transmission error ``e(t) = e_a sin(omega_h t + psi)``.
    error_phase_rad : float
        psi.
    mean_stiffness_n_per_um : float
        k_m, the mesh stiffness that `stiffness` is relative to.
    damping_n_s_per_m : float
        c_h.
    stiffness : StiffnessWave
        k_h(t) / k_m over the mesh period.

    Raises
    ------
    ValueError
        Naming the parameter, its value and the allowed range.

    Notes
    -----
    The article, items M1 to M5.

    Examples
    --------
    >>> drive = GearDrive(pinion_teeth=34, pinion_inertia_kg_m2=2e-3, gear_inertia_kg_m2=2e-3,
    ...     pinion_base_radius_mm=47.9, gear_base_radius_mm=47.9, pinion_torque_nm=120.0,
    ...     pinion_speed_rpm=2500.0, backlash_um=100.0, transmission_error_um=10.0,
    ...     mean_stiffness_n_per_um=350.0, damping_n_s_per_m=500.0)
    >>> round(drive.equivalent_mass_kg, 4)
    0.4358
    >>> osc = drive.oscillator()
    >>> round(osc.mean_force, 4), round(osc.error_amplitude, 4), round(osc.mesh_frequency, 4)
    (0.1432, 0.2, 0.3141)
    """

    pinion_teeth: int
    pinion_inertia_kg_m2: float
    gear_inertia_kg_m2: float
    pinion_base_radius_mm: float
    gear_base_radius_mm: float
    pinion_torque_nm: float
    pinion_speed_rpm: float
    backlash_um: float
    transmission_error_um: float
    mean_stiffness_n_per_um: float
    damping_n_s_per_m: float
    error_phase_rad: float = 0.0
    stiffness: StiffnessWave = field(default_factory=StiffnessWave.rectangular)

    def __post_init__(self) -> None:
        checked: dict[str, float] = {"pinion_teeth": check_count("pinion_teeth", self.pinion_teeth)}
        checked |= {name: check_number(name, getattr(self, name), above=0.0) for name in POSITIVE}
        checked |= {name: check_number(name, getattr(self, name), at_least=0.0) for name in NOT_NEGATIVE}
        checked |= {name: check_number(name, getattr(self, name)) for name in ANY}
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        if not isinstance(self.stiffness, StiffnessWave):
            raise ValueError(f"stiffness must be a StiffnessWave, got {self.stiffness!r}")

    @property
    def equivalent_mass_kg(self) -> float:
        """m_e = 1 / (r_b1^2 / I1 + r_b2^2 / I2)."""
        pinion = (self.pinion_base_radius_mm * 1e-3) ** 2 / self.pinion_inertia_kg_m2
        gear = (self.gear_base_radius_mm * 1e-3) ** 2 / self.gear_inertia_kg_m2
        return 1.0 / (pinion + gear)

    @property
    def natural_frequency_rad_s(self) -> float:
        """omega_n = sqrt(k_m / m_e): one unit of dimensionless time is ``1 / omega_n`` seconds."""
        return float(np.sqrt(self.mean_stiffness_n_per_um * 1e6 / self.equivalent_mass_kg))

    @property
    def half_backlash_m(self) -> float:
        """b_h: one unit of X in metres."""
        return self.backlash_um * 0.5e-6

    @property
    def mesh_frequency_rad_s(self) -> float:
        """omega_h = z1 times the pinion's angular speed."""
        return self.pinion_teeth * self.pinion_speed_rpm * 2.0 * np.pi / 60.0

    @property
    def gear_torque_nm(self) -> float:
        """T2 = T1 r_b2 / r_b1, the load that balances the driving torque."""
        return self.pinion_torque_nm * self.gear_base_radius_mm / self.pinion_base_radius_mm

    @property
    def mean_force_n(self) -> float:
        """F_m = m_e (r_b1 T1 / I1 + r_b2 T2 / I2), along the line of action; T1 / r_b1 with balanced torques."""
        return self.pinion_torque_nm / (self.pinion_base_radius_mm * 1e-3)

    def oscillator(self) -> Oscillator:
        """The dimensionless oscillator of this drive (the article, item M5)."""
        unit_force = self.half_backlash_m * self.mean_stiffness_n_per_um * 1e6
        critical = 2.0 * self.equivalent_mass_kg * self.natural_frequency_rad_s
        return Oscillator(
            mean_force=self.mean_force_n / unit_force,
            error_amplitude=self.transmission_error_um * 1e-6 / self.half_backlash_m,
            error_phase=self.error_phase_rad,
            damping_ratio=self.damping_n_s_per_m / critical,
            mesh_frequency=self.mesh_frequency_rad_s / self.natural_frequency_rad_s,
            stiffness=self.stiffness,
        )

    def with_oscillator(self, osc: Oscillator) -> GearDrive:
        """The drive of the same teeth, inertias, radii, k_m and b_h whose oscillator is `osc`.

        Torque, speed, transmission error, damping, phase and stiffness wave follow from `osc`.

        Raises
        ------
        ValueError
            Where `osc` asks for what no drive has.
        """
        unit_force = self.half_backlash_m * self.mean_stiffness_n_per_um * 1e6
        critical = 2.0 * self.equivalent_mass_kg * self.natural_frequency_rad_s
        speed = osc.mesh_frequency * self.natural_frequency_rad_s / self.pinion_teeth
        return replace(
            self,
            pinion_torque_nm=osc.mean_force * unit_force * self.pinion_base_radius_mm * 1e-3,
            pinion_speed_rpm=speed * 60.0 / (2.0 * np.pi),
            transmission_error_um=osc.error_amplitude * self.half_backlash_m * 1e6,
            error_phase_rad=osc.error_phase,
            damping_n_s_per_m=osc.damping_ratio * critical,
            stiffness=osc.stiffness,
        )
