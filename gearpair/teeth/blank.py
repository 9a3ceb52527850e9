"""The gear as a body that turns: its inertia from the drawing."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss

from gearpair._checks import check_number, checked
from gearpair.teeth.spurgear import Material, SpurGear
from gearpair.teeth.tooth_profile import ToothProfile

STEEL_KG_M3 = 7850.0
STEEL_GPA = (185.0, 220.0)  # moduli that steels have
_NODES, _WEIGHTS = leggauss(32)


@dataclass(frozen=True, kw_only=True)
class GearBlank:
    """What the drawing says of the body between bore and teeth; a solid disc unless it has a rim and a web.

    Parameters
    ----------
    rim_mm : float, optional
        Radial thickness of the rim, below the root circle; not given: no web, a solid disc.
    web_mm : float, optional
        Axial thickness of the web, at most the face width; needed with a rim.
    hub_mm : float
        Radial thickness of the hub, outside the bore.
    density_kg_m3 : float, optional
        That of the gear's material unless given.
    added_inertia_kg_m2 : float
        Of what turns rigidly with the gear: shaft, coupling, motor.

    Examples
    --------
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> pair = SpurPair()
    >>> solid, webbed = GearBlank(), GearBlank(rim_mm=8.0, web_mm=6.0, hub_mm=5.0)
    >>> [round(1e3 * blank.inertia_kg_m2(pair.gear), 3) for blank in (solid, webbed)]
    [1.647, 1.267]
    """

    rim_mm: float | None = None
    web_mm: float | None = None
    hub_mm: float = 0.0
    density_kg_m3: float | None = None
    added_inertia_kg_m2: float = 0.0

    def __post_init__(self) -> None:
        if self.density_kg_m3 is not None:
            check_number("density_kg_m3", self.density_kg_m3, above=0.0)
        check_number("hub_mm", self.hub_mm, at_least=0.0)
        check_number("added_inertia_kg_m2", self.added_inertia_kg_m2, at_least=0.0)
        if (self.rim_mm is None) != (self.web_mm is None):
            raise ValueError(f"rim_mm and web_mm go together, got {self.rim_mm!r} and {self.web_mm!r}")
        if self.rim_mm is not None:
            check_number("rim_mm", self.rim_mm, above=0.0)
            check_number("web_mm", self.web_mm, above=0.0)

    @checked
    def inertia_kg_m2(self, gear: SpurGear, face_width_mm: float | None = None) -> float:
        """The moment of inertia about the gear's axis: body, rim, web, the teeth as they are cut, and what is added.

        Parameters
        ----------
        gear : SpurGear
        face_width_mm : float, optional
            The gear's own width unless given.

        Raises
        ------
        ValueError
            Where rim and hub leave no room for a web, the web is wider than the face, or the density is not known.
        """
        bore, root = gear.bore_mm, gear.root_circle_mm
        width = gear.face_width_mm if face_width_mm is None else check_number("face_width_mm", face_width_mm, above=0.0)
        moment = width * (0.5 * math.pi * (root**4 - bore**4) + teeth_moment_mm4(gear))
        if self.rim_mm is not None and self.web_mm is not None:
            inner, outer = bore + self.hub_mm, root - self.rim_mm
            if inner >= outer:
                raise ValueError(
                    f"rim_mm = {self.rim_mm:g} and hub_mm = {self.hub_mm:g} leave no web between the bore, radius "
                    f"{bore:g} mm, and the root circle, radius {root:g} mm"
                )
            check_number("web_mm", self.web_mm, above=0.0, at_most=width)
            moment -= (width - self.web_mm) * 0.5 * math.pi * (outer**4 - inner**4)
        density = density_of(gear.material) if self.density_kg_m3 is None else self.density_kg_m3
        return moment * density * 1e-15 + self.added_inertia_kg_m2  # mm^5 kg/m^3


def density_of(material: Material) -> float:
    """Density in kg/m^3 as given, or steel's of what is as stiff as steel.

    Raises
    ------
    ValueError
        Where it is not given and the material is no steel.

    Examples
    --------
    >>> density_of(Material(youngs_modulus_gpa=206.0, poisson_ratio=0.3))
    7850.0
    """
    if material.density_kg_m3 is not None:
        return material.density_kg_m3
    if STEEL_GPA[0] <= material.youngs_modulus_gpa <= STEEL_GPA[1]:
        return STEEL_KG_M3
    raise ValueError(
        f"density_kg_m3 must be given where youngs_modulus_gpa is no steel's, {STEEL_GPA[0]:g} to {STEEL_GPA[1]:g}: "
        f"it is {material.youngs_modulus_gpa:g}"
    )


def teeth_moment_mm4(gear: SpurGear) -> float:
    """The polar moment of area of all teeth above the root circle, about the gear's axis, in mm^4.

    Notes
    -----
    The integral of ``2 z phi(r) r^3`` from root to tip, phi half the tooth's angle at radius r, along the outline that
    the rack cuts.

    Examples
    --------
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> gear = SpurPair().gear
    >>> ring = 0.5 * math.pi * (gear.tip_circle_mm**4 - gear.root_circle_mm**4)
    >>> round(teeth_moment_mm4(gear) / ring, 2)  # half of the ring is teeth
    0.5
    """
    tooth = ToothProfile(gear)
    first, last = tooth.first_roll, math.sqrt((gear.tip_circle_mm / gear.base_radius_mm) ** 2 - 1.0)
    total = 0.0
    for outline, start, end in ((tooth.fillet, 0.0, 1.0), (tooth.involute, first, last)):
        y, h, dy, dh = outline(start + 0.5 * (end - start) * (1.0 + _NODES))
        # phi r^3 dr = phi r^2 (y dy + h dh)
        rates = np.arctan2(h, y) * (y * y + h * h) * (y * dy + h * dh)
        total += 0.5 * (end - start) * float(_WEIGHTS @ rates)
    return 2.0 * gear.teeth * total * gear.module_mm**4
