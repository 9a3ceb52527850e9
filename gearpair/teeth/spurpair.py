"""A pair of external spur gears: what is drawn, and whether it can be cut and can run."""

import dataclasses
import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, Self, get_args

from gearpair._checks import check_choice, check_class, check_count, check_fields, check_number
from gearpair.teeth.spurgear import Material, SpurGear, inv, undercut_end
from gearpair.teeth.tooth_profile import ToothProfile, tip_clears

Backlash = Literal["normal", "circumferential", "thickness"]
BACKLASHES = get_args(Backlash)
_ROUNDING = 1e-12
LIMITS: dict[str, dict[str, float]] = {
    **dict.fromkeys(("module_mm", "face_width_mm", "addendum", "clearance"), {"above": 0.0}),
    **dict.fromkeys(("pinion_face_width_mm", "gear_face_width_mm"), {"above": 0.0}),
    **dict.fromkeys(("bore_ratio", "pinion_bore_ratio", "gear_bore_ratio"), {"at_least": 0.0}),
    **dict.fromkeys(("youngs_modulus_gpa", "density_kg_m3"), {"above": 0.0}),
    "pressure_angle_deg": {"above": 0.0, "below": 90.0},
    "poisson_ratio": {"above": 0.0, "below": 0.5},
    **dict.fromkeys(("tip_shortening", "tip_radius"), {"at_least": 0.0}),
    **dict.fromkeys(("pinion_tip_shortening", "gear_tip_shortening"), {"at_least": 0.0}),
    **dict.fromkeys(("pinion_shift", "gear_shift"), {}),
}


def _inverse_involute(value: float) -> float:
    """Angle whose involute is `value` > 0: Newton on a convex function, from above."""
    angle = min((3.0 * value) ** (1.0 / 3.0), math.pi / 2 - 1e-3) if value < 1.0 else math.atan(value + math.pi / 2)
    for _ in range(60):
        step = (inv(angle) - value) / math.tan(angle) ** 2
        angle -= step
        if abs(step) < 1e-16:
            break
    return angle


@dataclass(frozen=True)
class SpurPair:
    """Two external spur gears cut by one rack and meshing without backlash.

    Parameters
    ----------
    pinion_teeth, gear_teeth : int
        Numbers of teeth z1 (driving) and z2 (driven).
    module_mm, face_width_mm : float
        Module m and face width b, in millimetres.
    pressure_angle_deg : float
        Pressure angle alpha of the rack, in degrees.
    addendum, clearance : float
        h_a and c in modules; the rack reaches ``h_a + c`` below its reference line.
    pinion_shift, gear_shift : float
        Profile shifts x1, x2 in modules, positive away from the gear's centre.
    tip_radius : float, optional
        Radius of the *rack's* tip arc in modules, which cuts the fillet. Not given:
        ``c / (1 - sin(alpha))``, the arc that ends the straight flank at depth h_a, or a fully round
        tip where that arc is too wide for the rack (25 degrees and c = 0.25, say).
    bore_ratio : float
        Radius of the bore over the pitch radius; 0 for a solid gear, one with its shaft.
    youngs_modulus_gpa, poisson_ratio : float
        E in GPa and nu.
    tip_shortening : float
        Taken off both tips, in modules; 0 unless asked for. `full_clearance_shortening` is the
        value that gives a shifted pair its clearance c again.
    density_kg_m3 : float, optional
        Needed where the gears are weighed, unless E is that of a steel.
    pinion_bore_ratio, gear_bore_ratio, pinion_face_width_mm, gear_face_width_mm, pinion_tip_shortening,
    gear_tip_shortening : float, optional
        Each gear's own, where it is not that of both above.
    pinion_material, gear_material : Material, optional
        Each gear's own, where it is not made of what is said of both above.

    Raises
    ------
    ValueError
        Sizes out of range; a pointed tooth, or one that is cut off at its root; a bore at or beyond a root
        circle; a rack without room for its tip arc; tips that reach the mating root circle or run into the mating
        fillet; a contact ratio below 1. The sentence has the number found and the limit.

    Notes
    -----
    Working pressure angle ``inv(alpha_w) = inv(alpha) + 2 (x1 + x2) tan(alpha) / (z1 + z2)``, contact
    between the two tip circles on the line of action: ISO 21771:2007. A gear of few teeth is undercut: the rack's tip
    takes away a part of the involute, and contact begins, or ends, where the involute and the trochoid meet, at
    `SpurGear.form_circle_mm`. The article gives neither module
    nor width nor bore: those defaults are choices of this library, and stiffness per width does not
    depend on the module.

    Examples
    --------
    >>> pair = SpurPair(pinion_teeth=34, gear_teeth=44)
    >>> round(pair.contact_ratio, 4)
    1.7061
    >>> undercut = SpurPair(pinion_teeth=12, gear_teeth=44)
    >>> undercut.pinion.undercut, round(undercut.contact_ratio, 4)
    (True, 1.2745)
    >>> SpurPair(pinion_teeth=12, pinion_shift=1.2)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
        ...
    ValueError: the pinion's teeth are pointed: thickness at the tip is -1.21975 mm and must be above 0...
    """

    pinion_teeth: int = 34
    gear_teeth: int = 34
    module_mm: float = 3.0
    pressure_angle_deg: float = 20.0
    face_width_mm: float = 20.0
    addendum: float = 1.0
    clearance: float = 0.25
    pinion_shift: float = 0.0
    gear_shift: float = 0.0
    tip_radius: float | None = None
    bore_ratio: float = 0.3
    youngs_modulus_gpa: float = 206.8
    poisson_ratio: float = 0.3
    tip_shortening: float = 0.0
    density_kg_m3: float | None = None
    pinion_bore_ratio: float | None = None
    gear_bore_ratio: float | None = None
    pinion_face_width_mm: float | None = None
    gear_face_width_mm: float | None = None
    pinion_material: Material | None = None
    gear_material: Material | None = None
    pinion_tip_shortening: float | None = None
    gear_tip_shortening: float | None = None

    def __post_init__(self) -> None:
        for name in ("pinion_teeth", "gear_teeth"):
            object.__setattr__(self, name, check_count(name, getattr(self, name), at_least=3))
        check_fields(self, **LIMITS)
        for name in ("pinion_material", "gear_material"):
            if getattr(self, name) is not None:
                check_class(name, getattr(self, name), Material)
        self._check_rack()
        for who, gear in (("pinion", self.pinion), ("gear", self.gear)):
            self._check_gear(who, gear)
        self._check_mesh()

    def replace(self, **changes: Any) -> Self:
        """Return a copy with some parameters changed, checked like a new pair.

        Examples
        --------
        >>> SpurPair().replace(gear_teeth=54).gear_teeth
        54
        """
        return dataclasses.replace(self, **changes)

    @property
    def pressure_angle(self) -> float:
        """The rack's pressure angle alpha, in radians."""
        return math.radians(self.pressure_angle_deg)

    @property
    def rack_tip_radius(self) -> float:
        """Radius of the rack's tip arc in modules: `tip_radius`, or its default."""
        if self.tip_radius is None:
            return min(self.clearance / (1 - math.sin(self.pressure_angle)), self._full_round)
        return self.tip_radius

    @property
    def base_pitch_mm(self) -> float:
        """Distance of neighbouring contacts on the line of action: ``p_b = pi m cos(alpha)``."""
        return math.pi * self.module_mm * math.cos(self.pressure_angle)

    @cached_property
    def working_pressure_angle(self) -> float:
        """alpha_w in radians, at which the shifted pair meshes without backlash (ISO 21771)."""
        shifts = self.pinion_shift + self.gear_shift
        if shifts == 0.0:
            return self.pressure_angle
        alpha = self.pressure_angle
        involute = inv(alpha) + 2 * shifts * math.tan(alpha) / (self.pinion_teeth + self.gear_teeth)
        if involute <= 0.0:
            least = -inv(alpha) * (self.pinion_teeth + self.gear_teeth) / (2 * math.tan(alpha))
            raise ValueError(
                f"pinion_shift + gear_shift must be above {least:g} for the pair to mesh at all, got {shifts:g}"
            )
        return _inverse_involute(involute)

    @property
    def centre_distance_mm(self) -> float:
        """Working centre distance a_w."""
        reference = self.module_mm * (self.pinion_teeth + self.gear_teeth) / 2
        return reference * math.cos(self.pressure_angle) / math.cos(self.working_pressure_angle)

    @property
    def full_clearance_shortening(self) -> float:
        """The `tip_shortening` (in modules) that gives a shifted pair its clearance c again (ISO 21771).

        Examples
        --------
        >>> round(SpurPair(pinion_shift=0.3, gear_shift=0.2).full_clearance_shortening, 4)
        0.024
        """
        reference = (self.pinion_teeth + self.gear_teeth) / 2
        return self.pinion_shift + self.gear_shift - (self.centre_distance_mm / self.module_mm - reference)

    def normal_backlash_um(self, backlash_um: float, backlash: Backlash = "normal") -> float:
        """The whole backlash along the line of action, j_bn, from any of three statements of it.

        Parameters
        ----------
        backlash_um : float
            As stated, in micrometres.
        backlash : {"normal", "circumferential", "thickness"}
            ``"normal"``: j_bn itself. ``"circumferential"``: j_wt, on the working pitch circles,
            ``j_bn = j_wt cos(alpha_w)``. ``"thickness"``: what both gears' teeth are thinner than without backlash, on
            the reference circles, together, ``j_bn = (A_s1 + A_s2) cos(alpha)``.

        Notes
        -----
        ISO 21771:2007, its relations between normal, circumferential and thickness allowances for spur gears.

        Examples
        --------
        >>> round(SpurPair().normal_backlash_um(100.0, "circumferential"), 2)
        93.97
        """
        check_choice("backlash", backlash, BACKLASHES)
        angle = {"circumferential": self.working_pressure_angle, "thickness": self.pressure_angle}.get(backlash, 0.0)
        return check_number("backlash_um", backlash_um, above=0.0) * math.cos(angle)

    @cached_property
    def pinion(self) -> SpurGear:
        """The driving gear."""
        return self._gear("pinion")

    @cached_property
    def gear(self) -> SpurGear:
        """The driven gear."""
        return self._gear("gear")

    @property
    def contact_width_mm(self) -> float:
        """Face width over which the teeth touch: the smaller of the two gears'."""
        return min(self.pinion.face_width_mm, self.gear.face_width_mm)

    @property
    def line_of_action_mm(self) -> float:
        """Distance between the two base-tangent points, ``a_w sin(alpha_w)``."""
        return self.centre_distance_mm * math.sin(self.working_pressure_angle)

    @property
    def contact_start_mm(self) -> float:
        """Start of contact, along the line of action from the pinion's tangent point.

        Where the gear's tip meets the line of action, or where the involute of an undercut pinion begins.
        """
        return max(self.line_of_action_mm - _tip_tangent(self.gear), self.pinion.form_tangent_mm)

    @property
    def contact_end_mm(self) -> float:
        """End of contact, along the line of action from the pinion's tangent point.

        Where the pinion's tip meets the line of action, or where the involute of an undercut gear begins.
        """
        return min(_tip_tangent(self.pinion), self.line_of_action_mm - self.gear.form_tangent_mm)

    @property
    def contact_ratio(self) -> float:
        """epsilon: length of the path of contact over the base pitch."""
        return (self.contact_end_mm - self.contact_start_mm) / self.base_pitch_mm

    def _own(self, who: str, name: str) -> Any:
        """What one gear has of its own, or what both have."""
        own = getattr(self, f"{who}_{name}")
        return getattr(self, name) if own is None else own

    def _gear(self, who: str) -> SpurGear:
        teeth, shift = getattr(self, f"{who}_teeth"), getattr(self, f"{who}_shift")
        m, alpha, radius = self.module_mm, self.pressure_angle, self.module_mm * teeth / 2
        form_tangent = radius * math.sin(alpha) - m * (self._straight_depth - shift) / math.sin(alpha)
        base = radius * math.cos(alpha)
        both = Material(
            youngs_modulus_gpa=self.youngs_modulus_gpa,
            poisson_ratio=self.poisson_ratio,
            density_kg_m3=self.density_kg_m3,
        )
        gear = SpurGear(
            teeth=teeth,
            module_mm=m,
            pressure_angle=alpha,
            shift=shift,
            pitch_radius_mm=radius,
            base_radius_mm=base,
            tip_circle_mm=radius + m * (self.addendum + shift - self._own(who, "tip_shortening")),
            root_circle_mm=radius - m * (self.addendum + self.clearance - shift),
            bore_mm=self._own(who, "bore_ratio") * radius,
            form_circle_mm=math.hypot(base, max(form_tangent, 0.0)),
            fillet_end=alpha,
            rack_tip_radius_mm=m * self.rack_tip_radius,
            rack_tip_depth_mm=m * (self.addendum + self.clearance - self.rack_tip_radius - shift),
            rack_tip_offset_mm=m * self._rack_tip_offset,
            face_width_mm=self._own(who, "face_width_mm"),
            material=getattr(self, f"{who}_material") or both,
        )
        if form_tangent >= -_ROUNDING * radius:
            return gear
        end, form = undercut_end(gear)
        return dataclasses.replace(gear, fillet_end=end, form_circle_mm=form)

    @property
    def _straight_depth(self) -> float:
        """Depth of the rack's straight flank below its reference line, in modules."""
        return self.addendum + self.clearance - self.rack_tip_radius * (1 - math.sin(self.pressure_angle))

    @property
    def _full_round(self) -> float:
        """Radius of the tip arc that leaves no flat, in modules; negative when the rack's tooth is pointed."""
        alpha, depth = self.pressure_angle, self.addendum + self.clearance
        return (math.pi / 4 - depth * math.tan(alpha)) * math.cos(alpha) / (1 - math.sin(alpha))

    @property
    def _rack_tip_offset(self) -> float:
        alpha, depth = self.pressure_angle, self.addendum + self.clearance - self.rack_tip_radius
        offset = math.pi / 4 - depth * math.tan(alpha) - self.rack_tip_radius / math.cos(alpha)
        return max(offset, 0.0)  # a fully round tip, rounded

    def _check_rack(self) -> None:
        most, depth = self._full_round, self.addendum + self.clearance
        if most < 0.0:
            deepest = math.pi / 4 / math.tan(self.pressure_angle)
            raise ValueError(
                f"addendum + clearance = {depth:g} makes the rack's tooth pointed: it must be below {deepest:g}"
            )
        if self.rack_tip_radius > most:
            raise ValueError(
                f"tip_radius = {self.rack_tip_radius:g} modules does not fit the rack's tip: "
                f"it must be at most {most:g}"
            )

    def _check_gear(self, who: str, gear: SpurGear) -> None:
        if gear.root_circle_mm <= 0.0 or (gear.undercut and ToothProfile(gear).least_half_thickness <= 0.0):
            raise ValueError(
                f"{who}_teeth = {gear.teeth} with {who}_shift = {gear.shift:g} is undercut so far that the teeth are "
                "cut off at their roots: take more teeth or more shift"
            )
        if gear.bore_mm >= gear.root_circle_mm:
            limit = gear.root_circle_mm / gear.pitch_radius_mm
            own = "" if getattr(self, f"{who}_bore_ratio") is None else f"{who}_"
            raise ValueError(
                f"{own}bore_ratio = {gear.bore_mm / gear.pitch_radius_mm:g} puts the {who}'s bore at or beyond its "
                f"root circle: it must be below {limit:g}"
            )
        if gear.tip_circle_mm <= gear.form_circle_mm:
            raise ValueError(
                f"the {who}'s tip circle, radius {gear.tip_circle_mm:g} mm, leaves no involute: "
                f"it must be above {gear.form_circle_mm:g} mm"
            )
        if gear.tip_thickness_mm <= 0.0:
            raise ValueError(
                f"the {who}'s teeth are pointed: thickness at the tip is {gear.tip_thickness_mm:g} mm "
                "and must be above 0; take less addendum or shift"
            )

    def _check_mesh(self) -> None:
        length = self.line_of_action_mm
        for who, gear, mate in (("pinion", self.pinion, self.gear), ("gear", self.gear, self.pinion)):
            other = "gear" if who == "pinion" else "pinion"
            most = self.centre_distance_mm - mate.root_circle_mm
            if gear.tip_circle_mm > most * (1 + _ROUNDING):
                raise ValueError(
                    f"the {who}'s tip circle reaches the {other}'s root circle: its radius is "
                    f"{gear.tip_circle_mm:g} mm and must be at most {most:g} mm"
                )
            lowest, form = length - _tip_tangent(gear), mate.form_tangent_mm
            if mate.undercut and lowest < form and not tip_clears(mate, gear, self.centre_distance_mm):
                raise ValueError(
                    f"interference: the {who}'s tip runs into the undercut root of the {other}; "
                    f"take less addendum or a smaller {who}"
                )
            if not mate.undercut and lowest < form - _ROUNDING * length:
                raise ValueError(
                    f"interference: the {who}'s tip meets the {other} {lowest:g} mm along the line of action from "
                    f"the {other}'s base circle, and the {other}'s involute begins at {form:g} mm"
                )
        if self.contact_ratio < 1.0:
            raise ValueError(f"contact ratio is {self.contact_ratio:g} and must be at least 1: contact would be lost")


def _tip_tangent(gear: SpurGear) -> float:
    """Where the tip circle meets the line of action, from the gear's own base circle, in mm."""
    return math.sqrt(gear.tip_circle_mm**2 - gear.base_radius_mm**2)
