"""What others computed or measured: their numbers as data, each with its source, and how ours stand beside them.

Nothing here is computed. The chapter "Held against others" and its tests compute ours from the parameters that the
source names. Rows O1 to O8; a number is as printed by the source, or by its public code.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from gearpair._checks import check_choice, check_number, checked
from gearpair.table import Table

SOURCES = {
    "ROSS": "ROSS, an open library for rotors: stored test values of its gear element, commit 631a249",
    "ROSS, Newmark": "the same library's nonlinear solver, run with stiff bearings and one mesh stiffness",
    "ISO/TR 6336-30": "example 1 of ISO/TR 6336-30:2017, as a public MATLAB class has it for reference",
    "gearcalc": "the public notes gearcalc on a spur pair with 17 and 43 teeth",
    "Dias et al.": "Dias, Silva and Chui (2024); accelerations by a tight integration of their equation",
    "Chen and Shao": "Chen and Shao (2011), table 3, at second hand; they give no bore",
}


@dataclass(frozen=True)
class Stated:
    """One number of somebody else.

    Parameters
    ----------
    row : str
        ``"O1"`` to ``"O8"``.
    source : str
        A key of `SOURCES`.
    quantity, unit : str
        What it is, and in what; no unit where it is dimensionless.
    value : float
    digits : int
        Significant digits that the source gives.
    """

    row: str
    source: str
    quantity: str
    unit: str
    value: float
    digits: int


STATED = (
    Stated("O1", "ROSS", "contact ratio", "", 1.78977987, 9),
    Stated("O1", "ROSS", "contact stiffness by Hertz", "MN/m", 3555.868608, 10),
    Stated("O1", "ROSS", "mesh stiffness where contact begins", "MN/m", 396.622921, 9),
    Stated("O2", "ROSS", "the same, four samples of 1000 on, with its foundation", "MN/m", 397.084208, 9),
    Stated("O3", "ROSS", "where contact begins, with its foundation", "MN/m", 396.622921, 9),
    Stated("O4", "ROSS, Newmark", "least X, Omega 0.75, zeta 0.05", "", 1.06419, 6),
    Stated("O4", "ROSS, Newmark", "largest X", "", 1.19128, 6),
    Stated("O4", "ROSS, Newmark", "least X, Omega 0.9, zeta 0.05", "", 0.81480, 5),
    Stated("O4", "ROSS, Newmark", "largest X", "", 1.37204, 6),
    Stated("O4", "ROSS, Newmark", "least X, Omega 0.9, zeta 0.02", "", 0.80491, 5),
    Stated("O4", "ROSS, Newmark", "largest X", "", 1.37612, 6),
    Stated("O5", "ISO/TR 6336-30", "theoretical stiffness c'_th", "N/(mm um)", 17.85584, 7),
    Stated("O5", "ISO/TR 6336-30", "single stiffness c'", "N/(mm um)", 12.37047, 7),
    Stated("O5", "ISO/TR 6336-30", "mesh stiffness c_gamma", "N/(mm um)", 17.46485, 7),
    Stated("O6", "gearcalc", "flexibility q' by ISO 6336-1", "mm um/N", 0.062376, 5),
    Stated("O6", "gearcalc", "theoretical stiffness c'_th", "N/(mm um)", 16.032, 5),
    Stated("O6", "gearcalc", "single stiffness c'", "N/(mm um)", 12.505, 5),
    Stated("O6", "gearcalc", "mesh stiffness c_gamma", "N/(mm um)", 18.330, 5),
    Stated("O6", "gearcalc", "finite elements: one pair at the pitch point, plane strain", "N/(mm um)", 17.06, 4),
    Stated("O7", "Dias et al.", "least mesh stiffness", "MN/m", 228.7, 4),
    Stated("O7", "Dias et al.", "force over least stiffness", "um", 43.881, 5),
    Stated("O7", "Dias et al.", "best relief", "um", 43.519, 5),
    Stated("O7", "Dias et al.", "rms acceleration without relief", "m/s^2", 9081.0, 4),
    Stated("O7", "Dias et al.", "rms acceleration, relief 40 um", "m/s^2", 730.0, 3),
    Stated("O7", "Dias et al.", "rms acceleration, relief 43.519 um", "m/s^2", 95.3, 3),
    Stated("O7", "Dias et al.", "rms acceleration, relief 45 um", "m/s^2", 338.0, 3),
    Stated("O8", "Chen and Shao", "least stiffness of a single pair", "MN/m", 152.0, 3),
)
ROWS = tuple(dict.fromkeys(each.row for each in STATED))
EQUIVALENT_MASS_KG = 0.34931  # of row O7, by the formulas of Dias's public code: teeth as trapeziums on a disc


@checked
def stated(row: str) -> tuple[Stated, ...]:
    """The numbers of one row, in order.

    Parameters
    ----------
    row : {"O1", ..., "O8"}

    Examples
    --------
    >>> [each.value for each in stated("O8")]
    [152.0]
    """
    check_choice("row", row, ROWS)
    return tuple(each for each in STATED if each.row == row)


@checked
def beside_others(found: Mapping[str, list[float]]) -> Table:
    """The numbers of others beside ours, with the difference.

    Parameters
    ----------
    found : mapping of str to list of float
        Ours by row, as many as `stated` has, in its order and units.

    Returns
    -------
    Table
        The difference is relative to theirs; "none" where it is below a unit of the last digit they give, and in
        millionths (ppm) where it is below 0.01 %.

    Examples
    --------
    >>> beside_others({"O8": [152.4]})
    row  source         quantity                          unit  theirs  ours  difference
    ------------------------------------------------------------------------------------
    O8   Chen and Shao  least stiffness of a single pair  MN/m     152   152  none
    """
    rows = []
    for row, values in found.items():
        theirs = stated(row)
        if len(values) != len(theirs):
            raise ValueError(f"found[{row!r}] must be {len(theirs)} numbers, got {len(values)}")
        for each, value in zip(theirs, values, strict=True):
            ours = check_number(f"found[{row!r}]", value)
            rows.append([each.row, each.source, each.quantity, each.unit or "–", *_told(each, ours)])
    return Table(["row", "source", "quantity", "unit", "theirs", "ours", "difference"], rows)


def _told(theirs: Stated, ours: float) -> tuple[str, str, str]:
    """Their number, ours and the difference, with the digits that theirs has, six decimals at most."""
    last = theirs.digits - 1 - math.floor(math.log10(abs(theirs.value)))
    decimals = min(max(last, 0), 6)
    part = ours / theirs.value - 1.0
    if abs(ours - theirs.value) < 10.0**-last:
        difference = "none"
    else:
        difference = f"{part:+.2%}" if abs(part) >= 1e-4 else f"{part * 1e6:+.0f} ppm"
    return f"{theirs.value:.{decimals}f}", f"{ours:.{decimals}f}", difference
