"""The gear pair in SI units, and its way to the dimensionless oscillator and back."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Self

import numpy as np

from gearpair._checks import check_class, check_count, check_fields, check_number, checked, shown
from gearpair.drive_file import read_drive_file, write_drive_file
from gearpair.harmonics import (
    Error,
    Harmonic,
    ShaftOrder,
    check_harmonics,
    check_shaft_orders,
    error_fields,
    scaled,
    summed_harmonics,
)
from gearpair.oscillator import Oscillator
from gearpair.scales import Scales
from gearpair.stiffness import StiffnessWave
from gearpair.teeth import GearBlank, LoadedMesh, MeshStiffness, SpurPair, TipRelief, loaded_mesh
from gearpair.teeth.drawing import DRAWING, PAIR, drawn_fields, loaded_fields, redrawn_fields
from gearpair.teeth.meshing import Coupling

LIMITS: dict[str, dict[str, float]] = {
    **dict.fromkeys(("pinion_inertia_kg_m2", "gear_inertia_kg_m2"), {"above": 0.0}),
    **dict.fromkeys(("pinion_base_radius_mm", "gear_base_radius_mm", "pinion_speed_rpm"), {"above": 0.0}),
    **dict.fromkeys(("backlash_um", "mean_stiffness_n_per_um"), {"above": 0.0}),
    **dict.fromkeys(("transmission_error_um", "damping_n_s_per_m"), {"at_least": 0.0}),
    **dict.fromkeys(("pinion_torque_nm", "error_phase_rad"), {}),
}
SOLID = GearBlank()


@dataclass(frozen=True, kw_only=True)
class GearDrive(Scales):
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
    pinion_speed_rpm : float, optional
        Revolutions per minute of the pinion; a drive without has all but an oscillator, see `at_speed`.
    backlash_um : float
        The whole backlash along the line of action, 2 b_h.
    transmission_error_um : float
        e_a, the amplitude of the static transmission error ``e(t) = e_a sin(omega_h t + psi)``.
    error_phase_rad : float, optional
        psi, which no drawing tells: unknown when not given, and then `gearpair.design.speed_chart` takes the worst.
    mean_stiffness_n_per_um : float
        k_m, the mesh stiffness that `stiffness` is relative to.
    damping_n_s_per_m : float
        c_h.
    stiffness : StiffnessWave
        k_h(t) / k_m over the mesh period.
    error_harmonics : sequence of (order, amplitude, phase)
        What the transmission error has besides its first harmonic: orders from 2, amplitudes in micrometres, phases
        in radians, as `Harmonic`. Where `error_phase_rad` is unknown, they hold for a first phase of 0.
    shaft_orders : sequence of (teeth, amplitude, phase, order)
        Run-out and other errors that repeat with a wheel's revolution: its number of teeth, amplitude in micrometres,
        phase in radians and waves a revolution (one, if left out), as `ShaftOrder`.
    profile_harmonics : sequence of (order, amplitude, phase)
        What the shape of the drive flanks adds to it, orders from 1; set by `from_pair` for a relief.
    relief, mesh, pinion_blank, gear_blank : TipRelief, MeshStiffness, GearBlank and GearBlank, optional
        What stiffness, `profile_harmonics` and inertias come from; set by `from_pair`.

    Notes
    -----
    The article, items M1 to M5.

    Material that is missing on a tooth lets the drive flank come late and the coast flank early: the part of the error
    in `profile_harmonics` changes its sign with the torque, the rest (pitch, run-out) does not. Its course over the
    mesh period stays, as of equal gears. A motion has one error: of the flank that carries, at zero the drive flank.

    Examples
    --------
    >>> drive = GearDrive(pinion_teeth=34, pinion_inertia_kg_m2=2e-3, gear_inertia_kg_m2=2e-3,
    ...     pinion_base_radius_mm=47.9, gear_base_radius_mm=47.9, pinion_torque_nm=120.0, backlash_um=100.0,
    ...     transmission_error_um=10.0, mean_stiffness_n_per_um=350.0, damping_n_s_per_m=500.0)
    >>> round(drive.equivalent_mass_kg, 4)
    0.4358
    >>> osc = drive.at_speed(2500.0).oscillator()
    >>> round(osc.mean_force, 4), round(osc.error_amplitude, 4), round(osc.mesh_frequency, 4)
    (0.1432, 0.2, 0.3141)
    """

    transmission_error_um: float
    error_phase_rad: float | None = None
    stiffness: StiffnessWave = field(default_factory=StiffnessWave.rectangular)
    error_harmonics: tuple[Harmonic, ...] = ()
    shaft_orders: tuple[ShaftOrder, ...] = ()
    profile_harmonics: tuple[Harmonic, ...] = ()
    relief: TipRelief | None = field(default=None, repr=False, compare=False)
    mesh: MeshStiffness | None = field(default=None, repr=False, compare=False)
    pinion_blank: GearBlank | None = field(default=None, repr=False, compare=False)
    gear_blank: GearBlank | None = field(default=None, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "pinion_teeth", check_count("pinion_teeth", self.pinion_teeth))
        check_fields(self, **LIMITS)
        if not isinstance(self.stiffness, StiffnessWave):
            raise ValueError(f"stiffness must be a StiffnessWave, got {shown(self.stiffness)}")
        for name, kind in PARTS.items():
            if getattr(self, name) is not None:
                check_class(name, getattr(self, name), kind)
        for name, lowest in (("error_harmonics", 2), ("profile_harmonics", 1)):
            object.__setattr__(self, name, check_harmonics(name, getattr(self, name), lowest))
        object.__setattr__(self, "shaft_orders", check_shaft_orders("shaft_orders", self.shaft_orders))

    @classmethod
    @checked
    def from_pair(
        cls,
        pair: SpurPair,
        *,
        pinion_torque_nm: float,
        backlash_um: float,
        transmission_error_um: Error,
        damping_ratio: float,
        pinion_speed_rpm: float | None = None,
        pinion_blank: GearBlank = SOLID,
        gear_blank: GearBlank = SOLID,
        coupling: Coupling = "ring",
        n_levels: int = 16,
        shaft_orders: Sequence[ShaftOrder | tuple[float, ...]] = (),
        relief: TipRelief | None = None,
    ) -> Self:
        """The drive of a pair that is drawn: inertias, base radii and mesh stiffness follow from its geometry.

        Parameters
        ----------
        pair : SpurPair
        pinion_torque_nm, backlash_um, pinion_speed_rpm, shaft_orders
            As in `GearDrive`; `SpurPair.normal_backlash_um` makes one of other statements of the backlash.
        transmission_error_um : float or sequence of (order, amplitude, phase)
            The amplitude e_a of a sinusoid whose phase is unknown, or all harmonics from order 1 with their phases, as
            `gearpair.teeth.error_harmonics` gives them; micrometres and radians.
        damping_ratio : float
            zeta, from which ``c_h = 2 zeta sqrt(k_m m_e)``.
        pinion_blank, gear_blank : GearBlank
            Rim, web and hub, and what turns with the gear; solid discs of the pair's materials unless given.
        coupling : {"ring", "summed", "clamped"}
            As in `mesh_stiffness`.
        n_levels : int
            Levels of the staircase that stands for the mesh stiffness.
        relief : TipRelief, optional
            What is taken off the tips. Stiffness and `profile_harmonics`, twelve of them, are then those of
            `gearpair.teeth.loaded_mesh` under the drive's own torque, also after `replace`.

        Returns
        -------
        GearDrive
            With `mesh` and the blanks set, so that `replace` can draw it anew.

        Examples
        --------
        >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
        ...     transmission_error_um=5.0, damping_ratio=0.05)
        >>> osc = drive.at_speed(3000.0).oscillator()
        >>> round(osc.damping_ratio, 12), round(osc.error_amplitude, 12), round(osc.stiffness.mean, 12)
        (0.05, 0.125, 1.0)
        """
        drawn = drawn_fields(pair, coupling, {"pinion": pinion_blank or SOLID, "gear": gear_blank or SOLID})
        drive = cls(
            **drawn,
            **loaded_fields(drawn["mesh"], relief, pinion_torque_nm, n_levels),
            pinion_torque_nm=pinion_torque_nm,
            pinion_speed_rpm=pinion_speed_rpm,
            backlash_um=backlash_um,
            transmission_error_um=0.0,
            damping_n_s_per_m=0.0,
            shaft_orders=check_shaft_orders("shaft_orders", shaft_orders),
        )
        return drive.replace(transmission_error_um=transmission_error_um, damping_ratio=damping_ratio)

    @classmethod
    @checked
    def from_file(cls, path: str | Path) -> Self:
        """The drive of a YAML file that holds what stands on a drawing; ``gearpair drive --example`` shows one.

        Of several torques it is the first, of tolerances of the backlash their middle. A ValueError tells in a
        sentence that begins with the file's name what is wrong in it.
        """
        return read_drive_file(path).made(cls)

    @checked
    def to_file(self, path: str | Path) -> None:
        """Write a file that `from_file` makes the same drive of; for drives of `from_pair`."""
        write_drive_file(path, self)

    def replace(self, **changes: Any) -> Self:
        """A copy with some numbers changed, and with them what follows from them.

        Parameters
        ----------
        **changes
            Any field of the class, and `damping_ratio`. `transmission_error_um` as in `from_pair`: a number takes the
            harmonics with it and leaves the phases, a sequence replaces both. Of a drive that comes from `from_pair`
            also ``pair`` or any field of its `SpurPair`, ``coupling``, ``n_levels`` and ``relief``: with these or a
            blank, radii, inertias and mesh stiffness are made anew, and the damping ratio stays. So it does where the
            tips are relieved and the torque changes, for stiffness and error follow it.

        Returns
        -------
        GearDrive
            Without `mesh` where the stiffness is given, without a blank where its inertia is, without `relief` where
            `profile_harmonics` are.

        Examples
        --------
        >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
        ...     transmission_error_um=5.0, damping_ratio=0.05)
        >>> other = drive.replace(addendum=1.05, pinion_torque_nm=50.0)
        >>> round(other.mesh.contact_ratio, 3), round(other.damping_ratio, 12), other.mean_force_n < drive.mean_force_n
        (1.754, 0.05, True)
        """
        for name in changes:
            if name not in (*FIELDS, "damping_ratio", *DRAWN):
                known = ", ".join((*FIELDS, "damping_ratio", "pair", "coupling", "n_levels"))
                raise ValueError(f"unknown name {name!r}; what can be changed is {known}, and sizes of the pair")
            if name in DRAWN and self.mesh is None:
                raise ValueError(f"{name} can be changed only where the drive comes from GearDrive.from_pair")
        if changes.get("mesh") is not None:
            raise ValueError("mesh follows from the pair: change the pair, or a size of it")
        ratio = changes.pop("damping_ratio", None)
        forgotten = {f"{who}_blank": None for who in ("pinion", "gear") if f"{who}_inertia_kg_m2" in changes}
        if changes.get("stiffness", self.stiffness) != self.stiffness:
            changes.setdefault("mesh", None)
        relieved = self.relief is not None and "mesh" not in changes
        if "mesh" in changes:
            forgotten["relief"] = None
        elif relieved and "profile_harmonics" in changes:
            changes.setdefault("relief", None)
        redrawn = {*DRAWING, *PAIR} | ({"pinion_torque_nm"} if relieved else set())
        if self.mesh is not None and redrawn & changes.keys():
            changes = redrawn_fields(self, changes)
            ratio = self.damping_ratio if ratio is None else ratio
        if "transmission_error_um" in changes:
            given, present = changes.pop("transmission_error_um"), (self.transmission_error_um, self.error_harmonics)
            changes = error_fields(given, *present) | changes
        changed = dataclasses.replace(self, **(changes | forgotten))
        if ratio is None:
            return changed
        damping = check_number("damping_ratio", ratio, at_least=0.0) * changed.critical_damping_n_s_per_m
        return dataclasses.replace(changed, damping_n_s_per_m=damping)

    def at_speed(self, pinion_speed_rpm: float) -> Self:
        """The drive at another speed of the pinion."""
        return dataclasses.replace(self, pinion_speed_rpm=pinion_speed_rpm)

    def at_phase(self, error_phase_rad: float) -> Self:
        """The drive whose whole transmission error is moved along the mesh period until its first harmonic has a phase.

        Examples
        --------
        >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
        ...     transmission_error_um=[(1, 5.0, 0.0), (2, 1.0, 0.5)], damping_ratio=0.05)
        >>> drive.at_phase(0.25).error_phase_rad, drive.at_phase(0.25).error_harmonics[0].phase
        (0.25, 1.0)
        """
        phase = check_number("error_phase_rad", error_phase_rad)
        moved = phase - (self.error_phase_rad or 0.0)
        others = tuple(Harmonic(n, size, at + n * moved) for n, size, at in self.error_harmonics)
        return dataclasses.replace(self, error_phase_rad=phase, error_harmonics=others)

    @property
    def phase_is_unknown(self) -> bool:
        """Whether there is a transmission error of which nothing says how it stands to the stiffness."""
        return self.error_phase_rad is None and bool(self.transmission_error_um or self.error_harmonics)

    @property
    def all_harmonics(self) -> tuple[Harmonic, ...]:
        """All harmonics of the transmission error of the flank that carries the torque, in micrometres."""
        alike = (Harmonic(1, self.transmission_error_um, self.error_phase_rad or 0.0), *self.error_harmonics)
        turned = np.pi if self.pinion_torque_nm < 0.0 else 0.0
        profile = [Harmonic(order, size, phase + turned) for order, size, phase in self.profile_harmonics]
        return summed_harmonics(*alike, *profile) if profile else alike

    @cached_property
    def loaded_mesh(self) -> LoadedMesh | None:
        """The static balance of the mesh under the mean force; None where no tips are relieved."""
        if self.mesh is None or self.relief is None:
            return None
        return loaded_mesh(self.mesh, self.relief.deviation_um(self.mesh), abs(self.mean_force_n))

    def oscillator(self) -> Oscillator:
        """The dimensionless oscillator of this drive at its speed (the article, item M5).

        A phase that is unknown is taken as 0, which is often near the best there is: `at_phase` takes another.
        """
        first, *others = self.all_harmonics
        return Oscillator(
            mean_force=self.mean_force_n / self.unit_force_n,
            error_amplitude=first.amplitude * 1e-6 / self.half_backlash_m,
            error_phase=first.phase,
            damping_ratio=self.damping_ratio,
            mesh_frequency=self.mesh_frequency_rad_s / self.natural_frequency_rad_s,
            stiffness=self.stiffness,
            harmonics=scaled(others, 1e-6 / self.half_backlash_m),
            shaft_orders=scaled(self.shaft_orders, 1e-6 / self.half_backlash_m),
        )

    @checked
    def with_oscillator(self, osc: Oscillator) -> Self:
        """The drive of the same teeth, inertias, radii, k_m and b_h whose oscillator is `osc`.

        Torque, speed, transmission error, errors of shafts, damping, phase and stiffness follow from `osc`, nothing
        from a relief. A drive has one damper, so one with another `flight_damping` raises a ValueError.
        """
        if osc.damping_in_flight != osc.damping_ratio:
            raise ValueError(f"osc must be damped alike in contact and in flight, got {osc!r}")
        unit_um = self.half_backlash_m * 1e6
        return dataclasses.replace(self, relief=None, profile_harmonics=()).replace(
            pinion_torque_nm=osc.mean_force * self.unit_force_n * self.pinion_base_radius_mm * 1e-3,
            pinion_speed_rpm=osc.mesh_frequency * self.resonance_rpm,
            transmission_error_um=[(order, size * unit_um, phase) for order, size, phase in osc.all_harmonics],
            damping_ratio=osc.damping_ratio,
            stiffness=osc.stiffness,
            shaft_orders=scaled(osc.shaft_orders, unit_um),
        )


PARTS = {"relief": TipRelief, "mesh": MeshStiffness, "pinion_blank": GearBlank, "gear_blank": GearBlank}
FIELDS = tuple(each.name for each in dataclasses.fields(GearDrive))
DRAWN = {*PAIR} - {*FIELDS} | {*DRAWING}  # only where there is a drawing
