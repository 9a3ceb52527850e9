"""The gear pair in SI units, and its way to the dimensionless oscillator and back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from gearpair._checks import check_choice, check_count, check_number
from gearpair.oscillator import Harmonic, Oscillator, check_harmonics
from gearpair.stiffness import StiffnessWave
from gearpair.teeth import GearBlank, MeshStiffness, SpurPair, mesh_stiffness
from gearpair.teeth.meshing import Coupling

Backlash = Literal["normal", "circumferential", "thickness"]
BACKLASHES = ("normal", "circumferential", "thickness")

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
    error_harmonics : sequence of (order, amplitude, phase)
        What the transmission error has besides its first harmonic: orders from 2, amplitudes in micrometres, phases
        in radians, as `Harmonic`.
    mesh : MeshStiffness, optional
        Where the stiffness comes from; set by `from_pair`.

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
    error_harmonics: tuple[Harmonic, ...] = ()
    mesh: MeshStiffness | None = field(default=None, repr=False, compare=False)

    def __post_init__(self) -> None:
        checked: dict[str, float] = {"pinion_teeth": check_count("pinion_teeth", self.pinion_teeth)}
        checked |= {name: check_number(name, getattr(self, name), above=0.0) for name in POSITIVE}
        checked |= {name: check_number(name, getattr(self, name), at_least=0.0) for name in NOT_NEGATIVE}
        checked |= {name: check_number(name, getattr(self, name)) for name in ANY}
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        if not isinstance(self.stiffness, StiffnessWave):
            raise ValueError(f"stiffness must be a StiffnessWave, got {self.stiffness!r}")
        object.__setattr__(self, "error_harmonics", check_harmonics("error_harmonics", self.error_harmonics))

    @classmethod
    def from_pair(
        cls,
        pair: SpurPair,
        *,
        pinion_torque_nm: float,
        pinion_speed_rpm: float,
        backlash_um: float,
        transmission_error_um: float | Sequence[Harmonic | tuple[int, float, float]],
        damping_ratio: float,
        backlash: Backlash = "normal",
        pinion_blank: GearBlank | None = None,
        gear_blank: GearBlank | None = None,
        pinion_added_inertia_kg_m2: float = 0.0,
        gear_added_inertia_kg_m2: float = 0.0,
        coupling: Coupling = "ring",
        n_levels: int = 16,
    ) -> GearDrive:
        """The drive of a pair that is drawn: inertias, base radii and mesh stiffness follow from its geometry.

        Parameters
        ----------
        pair : SpurPair
        pinion_torque_nm, pinion_speed_rpm : float
            T1 and the pinion's speed.
        backlash_um : float
            The whole backlash, in micrometres, as `backlash` says.
        transmission_error_um : float or sequence of (order, amplitude, phase)
            The amplitude e_a of a sinusoid, or all harmonics from order 1, as `gearpair.teeth.error_harmonics`
            gives them; micrometres and radians.
        damping_ratio : float
            zeta, from which ``c_h = 2 zeta sqrt(k_m m_e)``.
        backlash : {"normal", "circumferential", "thickness"}
            ``"normal"``: j_bn, along the line of action. ``"circumferential"``: j_wt, on the working pitch circles,
            ``j_bn = j_wt cos(alpha_w)``. ``"thickness"``: what both gears' teeth are thinner than without backlash, on
            the reference circles, together, ``j_bn = (A_s1 + A_s2) cos(alpha)``.
        pinion_blank, gear_blank : GearBlank, optional
            Rim, web, hub and density; solid steel discs with the pair's bore unless given.
        pinion_added_inertia_kg_m2, gear_added_inertia_kg_m2 : float
            Of what turns rigidly with each gear: shaft, coupling, motor.
        coupling : {"ring", "summed"}
            As in `mesh_stiffness`.
        n_levels : int
            Levels of the staircase that stands for the mesh stiffness.

        Returns
        -------
        GearDrive
            With `mesh` set.

        Raises
        ------
        ValueError
            Naming the parameter, its value and the allowed range.

        Notes
        -----
        Backlash: ISO 21771:2007, its relations between normal, circumferential and thickness allowances for spur gears.

        Examples
        --------
        >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, pinion_speed_rpm=3000.0, backlash_um=80.0,
        ...     transmission_error_um=5.0, damping_ratio=0.05)
        >>> osc = drive.oscillator()
        >>> round(osc.damping_ratio, 12), round(osc.error_amplitude, 12), round(osc.stiffness.mean, 12)
        (0.05, 0.125, 1.0)
        """
        backlash_um = check_number("backlash_um", backlash_um, above=0.0)
        check_choice("backlash", backlash, BACKLASHES)
        damping_ratio = check_number("damping_ratio", damping_ratio, at_least=0.0)
        cosine = {
            "normal": 1.0,
            "circumferential": np.cos(pair.working_pressure_angle),
            "thickness": np.cos(pair.pressure_angle),
        }[backlash]
        given = transmission_error_um
        harmonics = [(1, given, 0.0)] if isinstance(given, (int, float)) else list(given)
        error = check_harmonics("transmission_error_um", harmonics, lowest=1)
        first = next((each for each in error if each.order == 1), Harmonic(1, 0.0))
        inertias = {}
        for who, gear, blank, added in (
            ("pinion", pair.pinion, pinion_blank, pinion_added_inertia_kg_m2),
            ("gear", pair.gear, gear_blank, gear_added_inertia_kg_m2),
        ):
            name = f"{who}_added_inertia_kg_m2"
            own = (blank or GearBlank()).inertia_kg_m2(gear, pair.face_width_mm)
            inertias[f"{who}_inertia_kg_m2"] = own + check_number(name, added, at_least=0.0)
        mesh = mesh_stiffness(pair, coupling=coupling)
        drive = cls(
            pinion_teeth=pair.pinion_teeth,
            **inertias,
            pinion_base_radius_mm=pair.pinion.base_radius_mm,
            gear_base_radius_mm=pair.gear.base_radius_mm,
            pinion_torque_nm=pinion_torque_nm,
            pinion_speed_rpm=pinion_speed_rpm,
            backlash_um=backlash_um * cosine,
            transmission_error_um=first.amplitude,
            error_phase_rad=first.phase,
            error_harmonics=tuple(each for each in error if each.order > 1),
            mean_stiffness_n_per_um=mesh.mean * 1e-6,
            damping_n_s_per_m=0.0,
            stiffness=mesh.wave(n_levels),
            mesh=mesh,
        )
        return replace(drive, damping_n_s_per_m=damping_ratio * drive.critical_damping_n_s_per_m)

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
        return Oscillator(
            mean_force=self.mean_force_n / self.unit_force_n,
            error_amplitude=self.transmission_error_um * 1e-6 / self.half_backlash_m,
            error_phase=self.error_phase_rad,
            damping_ratio=self.damping_n_s_per_m / self.critical_damping_n_s_per_m,
            mesh_frequency=self.mesh_frequency_rad_s / self.natural_frequency_rad_s,
            stiffness=self.stiffness,
            harmonics=tuple(
                Harmonic(order, amplitude * 1e-6 / self.half_backlash_m, phase)
                for order, amplitude, phase in self.error_harmonics
            ),
        )

    def with_oscillator(self, osc: Oscillator) -> GearDrive:
        """The drive of the same teeth, inertias, radii, k_m and b_h whose oscillator is `osc`.

        Torque, speed, transmission error, damping, phase and stiffness wave follow from `osc`.

        Raises
        ------
        ValueError
            Where `osc` asks for what no drive has.
        """
        speed = osc.mesh_frequency * self.natural_frequency_rad_s / self.pinion_teeth
        return replace(
            self,
            pinion_torque_nm=osc.mean_force * self.unit_force_n * self.pinion_base_radius_mm * 1e-3,
            pinion_speed_rpm=speed * 60.0 / (2.0 * np.pi),
            transmission_error_um=osc.error_amplitude * self.half_backlash_m * 1e6,
            error_phase_rad=osc.error_phase,
            damping_n_s_per_m=osc.damping_ratio * self.critical_damping_n_s_per_m,
            stiffness=osc.stiffness,
            error_harmonics=tuple(
                Harmonic(order, amplitude * self.half_backlash_m * 1e6, phase)
                for order, amplitude, phase in osc.harmonics
            ),
            mesh=self.mesh if osc.stiffness == self.stiffness else None,
        )
