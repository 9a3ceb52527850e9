"""A gear pair, an oscillator and a drive for every student or group, from nothing but the id."""

import hashlib
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import shown
from gearpair.bifurcations import continue_orbit, periodic_orbit
from gearpair.drive import GearDrive
from gearpair.motion import steady_state
from gearpair.oscillator import Oscillator
from gearpair.stiffness import StiffnessWave
from gearpair.teeth import SpurGear, SpurPair, mesh_stiffness

ALLOWED = re.compile(r"[a-z0-9][a-z0-9._@-]{1,63}")
STEEL_KG_M3 = 7850.0

# With any of these the pair can be cut, and its motion has the structure that the assignments ask about.
CHOICES: dict[str, Sequence[float]] = {
    "pinion_teeth": range(27, 41),
    "gear_teeth": range(42, 64),
    "module_mm": (2.0, 2.5, 3.0, 4.0),
    "face_width_mm": (16.0, 20.0, 24.0, 28.0, 32.0),
    "mean_force": (0.108, 0.110, 0.112, 0.114, 0.116, 0.118, 0.120),
    "error_amplitude": (0.155, 0.160, 0.165, 0.170, 0.175),
    "damping_ratio": (0.064, 0.066, 0.068, 0.07, 0.072, 0.074),
    "backlash_um": (60.0, 80.0, 100.0, 120.0),
}
MESH_FREQUENCY = 0.6
N_STARTS = 40
PLASTIC = 1.324717957244746  # the root of x^3 = x + 1
SHEET_DAMPING, SHEET_ERROR = 0.05, 0.05  # what the data sheet of a rig guesses: a ratio, a share of the backlash


@dataclass(frozen=True)
class RigReport:
    """What is known of a drive on a test rig.

    Attributes
    ----------
    drive : GearDrive
        As its data sheet has it: its damping and its transmission error are guesses.
    jump_up_rpm, jump_down_rpm : float
        Speeds of the pinion, to 1 rpm, at which the slow run-up and the slow coast-down jumped.
    """

    drive: GearDrive
    jump_up_rpm: float
    jump_down_rpm: float


def check_student_id(student_id: object) -> str:
    """The id as everything else uses it: small letters, no blanks around it.

    Parameters
    ----------
    student_id : str
        Letters, digits and ``. _ @ -``, 2 to 64 of them, the first a letter or a digit.

    Examples
    --------
    >>> check_student_id(" Ada.Lovelace ")
    'ada.lovelace'
    >>> check_student_id("")
    Traceback (most recent call last):
        ...
    ValueError: student_id must be your own id (2 to 64 letters, digits, '.', '_', '@' or '-'), got ''
    """
    given = student_id.strip().lower() if isinstance(student_id, str) else ""
    if not ALLOWED.fullmatch(given):
        raise ValueError(
            f"student_id must be your own id (2 to 64 letters, digits, '.', '_', '@' or '-'), got {shown(student_id)}"
        )
    return given


def personal_pair(student_id: str) -> SpurPair:
    """The gears of one student or group: full-depth teeth at 20 degrees; teeth, module and face width by the id.

    The id is one that `check_student_id` takes; capitals do not matter.

    Examples
    --------
    >>> pair = personal_pair("ada")
    >>> pair == personal_pair("Ada"), pair == personal_pair("grace")
    (True, False)
    """
    return SpurPair(**_chosen(student_id, "pinion_teeth", "gear_teeth", "module_mm", "face_width_mm"))


def personal_oscillator(student_id: str) -> Oscillator:
    """The dimensionless oscillator of one student or group: the two-level wave of `personal_pair`; the rest by the id.

    It runs at the mesh frequency 0.6, where every student's pair has a motion that keeps contact.

    Examples
    --------
    >>> osc = personal_oscillator("ada")
    >>> round(osc.stiffness.mean, 12), osc.mesh_frequency
    (1.0, 0.6)
    """
    rectangle = mesh_stiffness(personal_pair(student_id)).rectangular()
    return Oscillator(
        **_chosen(student_id, "mean_force", "error_amplitude", "damping_ratio"),
        mesh_frequency=MESH_FREQUENCY,
        stiffness=StiffnessWave.rectangular(rectangle.contact_ratio, rectangle.a, rectangle.b),
    )


def personal_drive(student_id: str) -> GearDrive:
    """The drive of one student or group in SI units: `personal_pair` with the numbers of `personal_oscillator`.

    The gears are steel rings from the bore to the pitch circle.

    Examples
    --------
    >>> drive = personal_drive("ada")
    >>> osc = personal_oscillator("ada")
    >>> round(drive.oscillator().damping_ratio, 9) == osc.damping_ratio
    True
    """
    pair = personal_pair(student_id)
    blank = GearDrive(
        pinion_teeth=pair.pinion_teeth,
        pinion_inertia_kg_m2=_ring_inertia(pair.pinion, pair.face_width_mm),
        gear_inertia_kg_m2=_ring_inertia(pair.gear, pair.face_width_mm),
        pinion_base_radius_mm=pair.pinion.base_radius_mm,
        gear_base_radius_mm=pair.gear.base_radius_mm,
        mean_stiffness_n_per_um=mesh_stiffness(pair).mean / 1e6,
        pinion_torque_nm=0.0,
        transmission_error_um=0.0,
        damping_n_s_per_m=0.0,
        **_chosen(student_id, "backlash_um"),
    )
    return blank.with_oscillator(personal_oscillator(student_id))


def personal_rig(student_id: str) -> RigReport:
    """What a test rig with the gears of one student or group reports.

    The drive on it is `personal_drive` with another damping and another error, by the id; the jumps are the folds of
    its motion that keeps contact and of the one that does not, by continuation.

    Examples
    --------
    >>> rig = personal_rig("ada")
    >>> rig.jump_down_rpm < rig.jump_up_rpm < rig.drive.resonance_rpm
    True
    """
    true = true_rig(student_id)
    osc = true.oscillator().replace(mesh_frequency=0.545)
    x, v = steady_state(osc).points[0].tolist()
    quiet = periodic_orbit(osc, x, v, 1)
    branch = continue_orbit(quiet, "mesh_frequency", 0.5, 0.8)
    folds = [each.value * true.resonance_rpm for each in branch.bifurcations if each.kind == "fold"]
    sheet = true.replace(damping_ratio=SHEET_DAMPING, transmission_error_um=SHEET_ERROR * true.backlash_um)
    return RigReport(sheet, float(round(max(folds))), float(round(min(folds))))


def true_rig(student_id: str) -> GearDrive:
    """The drive on the rig of `personal_rig`, with the damping and the error that it has.

    Examples
    --------
    >>> 0.06 < true_rig("ada").damping_ratio < 0.08
    True
    """
    other = _chosen(student_id, "damping_ratio", "error_amplitude", salt="/rig")
    drive = personal_drive(student_id)
    return drive.with_oscillator(drive.oscillator().replace(**other))


def personal_starts(student_id: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Forty starts of one student or group, X in [-2, 2] and X' in [-1.5, 1.5]; each of shape (40,).

    Examples
    --------
    >>> x, v = personal_starts("ada")
    >>> x.shape, bool(abs(x).max() <= 2.0), bool(abs(v).max() <= 1.5)
    ((40,), True, True)
    """
    digest = hashlib.sha512(f"gearpair/starts/{check_student_id(student_id)}".encode()).digest()
    shift_x, shift_v = (int.from_bytes(digest[at : at + 8], "big") / 2**64 for at in (0, 8))
    number = np.arange(N_STARTS)
    # additive recurrence of the plastic number: evenly spread, and the same on every machine
    x, v = ((shift + number / PLASTIC**power) % 1.0 for shift, power in ((shift_x, 1), (shift_v, 2)))
    return 4.0 * x - 2.0, 3.0 * v - 1.5


def _chosen(student_id: str, *names: str, salt: str = "") -> dict[str, Any]:
    """One of the choices of each name, the same on every machine and with every version of every package."""
    who = check_student_id(student_id)
    digests = {name: hashlib.sha256(f"gearpair{salt}/{name}/{who}".encode()).digest() for name in names}
    return {name: CHOICES[name][int.from_bytes(d[:8], "big") % len(CHOICES[name])] for name, d in digests.items()}


def _ring_inertia(gear: SpurGear, face_width_mm: float) -> float:
    """Mass moment of inertia of a steel ring between bore and pitch circle, kg m^2."""
    outer, inner, width = gear.pitch_radius_mm * 1e-3, gear.bore_mm * 1e-3, face_width_mm * 1e-3
    return 0.5 * math.pi * STEEL_KG_M3 * width * (outer**4 - inner**4)
