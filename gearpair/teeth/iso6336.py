"""Tooth stiffness by ISO 6336-1, method B: the number that gear engineers would compare with."""

import math
from dataclasses import dataclass

from gearpair._checks import check_number, checked
from gearpair.teeth.spurpair import SpurPair

_STEEL_MPA = 206_000.0
_C = (0.04723, 0.15551, 0.25791, -0.00635, -0.11654, -0.00193, -0.24188, 0.00529, 0.00182)


@dataclass(frozen=True)
class IsoStiffness:
    """c' and c_gamma of ISO 6336-1, in N per mm of face width and micrometre.

    Parameters
    ----------
    theoretical, single, mesh : float
        ``c'_th = 1 / q'``, the single stiffness c' (the most of one pair) and the mesh stiffness
        c_gamma,alpha (mean over the mesh period), N/(mm um).
    face_width_mm : float
        The width in contact.
    """

    theoretical: float
    single: float
    mesh: float
    face_width_mm: float

    @property
    def single_n_per_m(self) -> float:
        """c' times the face width, in N/m."""
        return self.single * self.face_width_mm * 1e6

    @property
    def mesh_n_per_m(self) -> float:
        """c_gamma times the face width, in N/m: beside `MeshStiffness.mean`."""
        return self.mesh * self.face_width_mm * 1e6


def tooth_flexibility(z1: float, z2: float, x1: float = 0.0, x2: float = 0.0) -> float:
    """q' of ISO 6336-1, the theoretical flexibility of one pair of teeth, in mm um/N.

    Parameters
    ----------
    z1, z2 : float
        Numbers of teeth, of the smaller gear and the larger one; virtual ones of helical gears.
    x1, x2 : float
        Their profile shifts in modules.

    Examples
    --------
    >>> round(1 / tooth_flexibility(17, 43), 3)
    16.032
    """
    terms = (1.0, 1 / z1, 1 / z2, x1, x1 / z1, x2, x2 / z2, x1**2, x2**2)
    return math.fsum(c * term for c, term in zip(_C, terms, strict=True))


@checked
def iso_stiffness(pair: SpurPair, *, specific_load_n_per_mm: float | None = None) -> IsoStiffness:
    """Single and mesh stiffness of a spur pair by ISO 6336-1, method B.

    Parameters
    ----------
    pair : SpurPair
        Solid discs: the standard's gear blank factor C_R is 1 and the bore has no influence.
    specific_load_n_per_mm : float, optional
        F_t K_A / b; not given, at least 100.

    Raises
    ------
    ValueError
        When the shifts are outside the range of the standard's formula, ``x1 >= x2`` and
        ``-0.5 <= x1 + x2 <= 2``.

    Notes
    -----
    ISO 6336-1:2006 and 2019, tooth stiffness parameters, method B::

        q' = 0.04723 + 0.15551/z1 + 0.25791/z2 - 0.00635 x1 - 0.11654 x1/z1 - 0.00193 x2 - 0.24188 x2/z2
             + 0.00529 x1^2 + 0.00182 x2^2                                                    [mm um/N]
        c' = (1/q') C_M C_R C_B E/E_steel,       C_M = 0.8, C_R = 1, E_steel = 206 000 N/mm^2
        C_B = [1 + 0.5 (1.2 - h_fP/m)] [1 - 0.02 (20 deg - alpha)],   h_fP = h_a + c
        c_gamma = c' (0.75 epsilon + 0.25)

    z1 and x1 are those of the smaller gear, whichever drives. Below F_t K_A / b = 100 N/mm c' is multiplied by
    ``(F_t K_A / b / 100)^0.25``. Unlike materials have ``E = 2 E_1 E_2 / (E_1 + E_2)``. C_M is the standard's allowance
    for measured teeth being softer than computed ones. The formula for c_gamma is for contact ratios of at least 1.2.

    Examples
    --------
    >>> iso = iso_stiffness(SpurPair())
    >>> round(iso.theoretical, 2), round(iso.single, 2), round(iso.mesh, 2)
    (16.84, 13.18, 19.91)
    """
    # of two gears of one size the first is the one with more shift
    small, large = sorted((pair.pinion, pair.gear), key=lambda gear: (gear.teeth, -gear.shift))
    x1, x2 = small.shift, large.shift
    if x1 < x2:
        raise ValueError(
            f"ISO 6336-1's formula needs the smaller gear's shift to be at least the larger one's, {x2:g}, got {x1:g}"
        )
    if not -0.5 <= x1 + x2 <= 2.0:
        raise ValueError(f"ISO 6336-1's formula needs pinion_shift + gear_shift from -0.5 to 2, got {x1 + x2:g}")
    load = 100.0 if specific_load_n_per_mm is None else specific_load_n_per_mm
    light = min(check_number("specific_load_n_per_mm", load, above=0.0) / 100.0, 1.0) ** 0.25
    theoretical = 1 / tooth_flexibility(small.teeth, large.teeth, x1, x2)
    rack = (1 + 0.5 * (1.2 - pair.addendum - pair.clearance)) * (1 - 0.02 * (20.0 - pair.pressure_angle_deg))
    moduli = [gear.material.youngs_modulus_gpa * 1e3 for gear in (small, large)]
    single = 0.8 * theoretical * rack * light * 2 / (1 / moduli[0] + 1 / moduli[1]) / _STEEL_MPA
    return IsoStiffness(theoretical, single, single * (0.75 * pair.contact_ratio + 0.25), pair.contact_width_mm)
