"""What the dimensionless quantities of a drive stand for: its masses, frequencies and units."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Scales:
    """The part of `gearpair.GearDrive`, which documents its numbers, that its units follow from."""

    pinion_teeth: int
    pinion_inertia_kg_m2: float
    gear_inertia_kg_m2: float
    pinion_base_radius_mm: float
    gear_base_radius_mm: float
    pinion_torque_nm: float
    pinion_speed_rpm: float | None = None
    backlash_um: float
    mean_stiffness_n_per_um: float
    damping_n_s_per_m: float

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
    def critical_damping_n_s_per_m(self) -> float:
        """2 m_e omega_n: the c_h of a damping ratio of one."""
        return 2.0 * self.equivalent_mass_kg * self.natural_frequency_rad_s

    @property
    def unit_force_n(self) -> float:
        """b_h k_m: one unit of dimensionless force in newtons."""
        return self.half_backlash_m * self.mean_stiffness_n_per_um * 1e6

    @property
    def half_backlash_m(self) -> float:
        """b_h: one unit of X in metres."""
        return self.backlash_um * 0.5e-6

    @property
    def damping_ratio(self) -> float:
        """zeta = c_h / (2 m_e omega_n)."""
        return self.damping_n_s_per_m / self.critical_damping_n_s_per_m

    @property
    def mesh_frequency_rad_s(self) -> float:
        """omega_h = z1 times the pinion's angular speed."""
        if self.pinion_speed_rpm is None:
            raise ValueError("this drive has no speed: give pinion_speed_rpm, or take drive.at_speed(rpm)")
        return self.pinion_teeth * self.pinion_speed_rpm * 2.0 * np.pi / 60.0

    @property
    def resonance_rpm(self) -> float:
        """The pinion's speed at which the mesh frequency is the natural frequency, Omega = 1."""
        return 60.0 * self.natural_frequency_rad_s / (2.0 * np.pi * self.pinion_teeth)

    @property
    def gear_torque_nm(self) -> float:
        """T2 = T1 r_b2 / r_b1, the load that balances the driving torque."""
        return self.pinion_torque_nm * self.gear_base_radius_mm / self.pinion_base_radius_mm

    @property
    def mean_force_n(self) -> float:
        """F_m = m_e (r_b1 T1 / I1 + r_b2 T2 / I2), along the line of action; T1 / r_b1 with balanced torques."""
        return self.pinion_torque_nm / (self.pinion_base_radius_mm * 1e-3)
