"""The flank tolerances of ISO 1328-1:2013: what an accuracy grade on a drawing allows a gear's teeth."""

import math
from dataclasses import dataclass

from gearpair._checks import check_count, check_number, checked
from gearpair.teeth.spurgear import SpurGear

GRADES = (1, 11)
# What the standard covers, and forbids to go beyond.
COVERED = {"teeth": (5, 1000), "reference diameter": (5, 15_000), "module": (0.5, 70), "face width": (4, 1200)}


@dataclass(frozen=True)
class FlankTolerances:
    """Of one gear, in micrometres.

    Attributes
    ----------
    single_pitch_um : float
        f_pT.
    base_pitch_um : float
        ``f_pT cos(alpha)``, what `gearpair.design.iso_dynamic_factor` takes.
    profile_form_um : float
        f_f alpha T, the width of the band that a profile lies in once its slope is taken out.
    """

    single_pitch_um: float
    base_pitch_um: float
    profile_form_um: float


@checked
def flank_tolerances(gear: SpurGear, grade: int) -> FlankTolerances:
    """The tolerances of pitch and profile form of a gear of an accuracy grade.

    Parameters
    ----------
    gear : SpurGear
    grade : int
        The flank tolerance class A, from 1 to 11. Grades of the edition of 1995 are others.

    Raises
    ------
    ValueError
        Also for a gear that the standard does not cover: 5 to 1000 teeth, diameters of 5 to 15 000 mm, modules of 0.5
        to 70 mm, widths of 4 to 1200 mm.

    Notes
    -----
    ISO 1328-1:2013, formulas (5) and (8), d and m in millimetres, rounded as its clause 5.2.3 asks::

        f_pT = (0.001 d + 0.4 m + 5) sqrt(2)^(A - 5),   f_falphaT = (0.55 m + 5) sqrt(2)^(A - 5)

    The standard's text was not at hand: the formulas, limits and rounding are as a public implementation gives them
    (``Iso1328Tolerance.cs`` of github.com/hakangunes258/mekanika, commit 5527e2f).

    Examples
    --------
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> flank_tolerances(SpurPair().gear, 6).profile_form_um
    9.5
    """
    grade = check_count("grade", grade)
    check_number("grade", grade, at_most=GRADES[1])
    diameter, module = 2.0 * gear.pitch_radius_mm, gear.module_mm
    sizes = (gear.teeth, diameter, module, gear.face_width_mm)
    for (name, (least, most)), size in zip(COVERED.items(), sizes, strict=True):
        if not least * (1.0 - 1e-9) <= size <= most * (1.0 + 1e-9):
            unit = "" if name == "teeth" else " mm"
            raise ValueError(f"ISO 1328-1 covers gears with a {name} of {least} to {most}{unit}, got {size:g}{unit}")
    step = math.sqrt(2.0) ** (grade - 5)
    pitch = _rounded((0.001 * diameter + 0.4 * module + 5.0) * step)
    return FlankTolerances(pitch, pitch * math.cos(gear.pressure_angle), _rounded((0.55 * module + 5.0) * step))


def _rounded(value: float) -> float:
    """To whole micrometres above 10, to halves from 5, to tenths below; halves go up."""
    parts = 1 if value > 10.0 else 2 if value >= 5.0 else 10
    return math.floor(value * parts + 0.5) / parts
