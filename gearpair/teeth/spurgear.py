"""One gear of a pair: its material, its circles, and where the rack that cuts it leaves an involute."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearpair._checks import check_fields


def inv(angle: float) -> float:
    """``inv(alpha) = tan(alpha) - alpha``, in radians."""
    return math.tan(angle) - angle


@dataclass(frozen=True, kw_only=True)
class Material:
    """What a gear is made of.

    Parameters
    ----------
    youngs_modulus_gpa, poisson_ratio : float
        E in GPa and nu (dimensionless).
    density_kg_m3 : float, optional
        Needed where the gear is weighed, unless E is that of a steel.

    Examples
    --------
    >>> Material(youngs_modulus_gpa=3.1, poisson_ratio=0.35, density_kg_m3=1410.0).density_kg_m3
    1410.0
    """

    youngs_modulus_gpa: float
    poisson_ratio: float
    density_kg_m3: float | None = None

    def __post_init__(self) -> None:
        check_fields(
            self,
            youngs_modulus_gpa={"above": 0.0},
            poisson_ratio={"above": 0.0, "below": 0.5},
            density_kg_m3={"above": 0.0},
        )


@dataclass(frozen=True)
class SpurGear:
    """One gear of a `SpurPair`; every length in millimetres, every angle in radians.

    Parameters
    ----------
    teeth : int
        Number of teeth z.
    module_mm, pressure_angle, shift : float
        Module m, the rack's pressure angle alpha and the profile shift x (in modules).
    pitch_radius_mm, base_radius_mm : float
        ``r = m z / 2`` and ``r_b = r cos(alpha)``.
    tip_circle_mm, root_circle_mm, bore_mm : float
        *Radii* of the tip circle, of the root circle and of the bore; a solid gear's bore is 0.
    form_circle_mm : float
        Radius at which the involute begins: where the rack's straight flank ends, or where an undercut flank is cut.
    fillet_end : float
        Angle between the pitch line and the normal of the rack's tip arc at the point that cuts the end of the
        fillet: alpha, or more where the flank is undercut.
    rack_tip_radius_mm, rack_tip_depth_mm, rack_tip_offset_mm : float
        The rack's tip arc: its radius, the distance of its centre below the pitch line of
        generation and its distance from the centre line of the rack's tooth.
    face_width_mm : float
        Its own width.
    material : Material
        What it is made of.

    Notes
    -----
    Made by `SpurPair`, which checks it. The rack that cuts the gear is the basic rack of ISO 53:
    straight flanks down to the tip arc, flat at the tip.
    """

    teeth: int
    module_mm: float
    pressure_angle: float
    shift: float
    pitch_radius_mm: float
    base_radius_mm: float
    tip_circle_mm: float
    root_circle_mm: float
    bore_mm: float
    form_circle_mm: float
    fillet_end: float
    rack_tip_radius_mm: float
    rack_tip_depth_mm: float
    rack_tip_offset_mm: float
    face_width_mm: float
    material: Material

    @property
    def base_half_angle(self) -> float:
        """Half the tooth's angle on the base circle: ``pi / 2z + 2 x tan(alpha) / z + inv(alpha)``."""
        alpha = self.pressure_angle
        return math.pi / (2 * self.teeth) + 2 * self.shift * math.tan(alpha) / self.teeth + inv(alpha)

    @property
    def root_half_angle(self) -> float:
        """Half the angle between the two points where the rack-cut fillets reach the root circle (theta_f)."""
        return math.pi / self.teeth - self.rack_tip_offset_mm / self.pitch_radius_mm

    @property
    def tip_thickness_mm(self) -> float:
        """Thickness of the tooth along the tip circle."""
        tip_angle = math.acos(self.base_radius_mm / self.tip_circle_mm)
        return 2 * self.tip_circle_mm * (self.base_half_angle - inv(tip_angle))

    @property
    def undercut(self) -> bool:
        """Whether the rack's tip cuts away a part of the involute, outside the base circle."""
        return self.fillet_end > self.pressure_angle

    @property
    def form_tangent_mm(self) -> float:
        """Where the involute begins, along the line of action from the base circle."""
        return math.sqrt(max(self.form_circle_mm**2 - self.base_radius_mm**2, 0.0))


def fillet_point(gear: SpurGear, gamma: float) -> tuple[float, float]:
    """Radius in millimetres, and angle from the tooth's centre line, of the fillet's point whose normal is at `gamma`.

    Notes
    -----
    See `ToothProfile.fillet`: the law of gearing for the rack's tip arc.

    Examples
    --------
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> gear = SpurPair().pinion
    >>> radius, angle = fillet_point(gear, math.pi / 2)
    >>> round(radius - gear.root_circle_mm, 9), round(angle - gear.root_half_angle, 9)
    (0.0, 0.0)
    """
    depth, arc = gear.rack_tip_depth_mm, gear.rack_tip_radius_mm
    along = depth / math.tan(gamma) + arc * math.cos(gamma)
    below = gear.pitch_radius_mm - depth - arc * math.sin(gamma)
    turn = (depth / math.tan(gamma) - gear.rack_tip_offset_mm) / gear.pitch_radius_mm + math.pi / gear.teeth
    return math.hypot(along, below), turn - math.atan2(along, below)


def undercut_end(gear: SpurGear) -> tuple[float, float]:
    """Where the fillet of an undercut gear meets its involute.

    Parameters
    ----------
    gear : SpurGear
        Whose rack's straight flank reaches below the point where the line of action touches the base circle.

    Returns
    -------
    gamma, radius : float
        Angle of the normal of the rack's tip arc to the pitch line in radians, and radius in millimetres.

    Notes
    -----
    Towards the end that the arc's joint with the straight flank cuts the fillet is thicker than the involute, where
    it crosses the base circle it is thinner: one root between, by bisection.
    """
    base = gear.base_radius_mm

    def thicker(gamma: float) -> bool:
        radius, angle = fillet_point(gear, gamma)
        if radius <= base:
            return False
        return angle > gear.base_half_angle - inv(math.acos(base / radius))

    low, high = gear.pressure_angle, math.pi / 2
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if thicker(middle) else (low, middle)
    return low, fillet_point(gear, low)[0]
