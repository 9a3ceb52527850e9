"""What may stand in a drive's file: the name, unit, meaning, default and check of every entry, in one table."""

from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any, get_args

from gearpair._checks import check_choice, check_count, check_number, check_reach, is_number, shown
from gearpair.harmonics import check_harmonics, check_shaft_orders
from gearpair.teeth.iso1328 import GRADES
from gearpair.teeth.meshing import Coupling
from gearpair.teeth.spurpair import BACKLASHES

COVERS = ("mesh", "pinion", "gear")  # a mesh period, or a revolution of one of them
Check = Callable[[str, Any], Any]


@dataclass(frozen=True)
class Entry:
    """One line of a drive's file.

    Attributes
    ----------
    name : str
        As in the library.
    meaning : str
        What it is, in words.
    check : callable
        Of name and value: the value as the library takes it, or a ValueError.
    unit : str
        Empty for what has none.
    default : object
        What is taken where the file does not say; None where nothing is, or where it follows from other entries.
    example : object
        Its value in the example; None where it is shown as a comment.
    """

    name: str
    meaning: str
    check: Check
    unit: str = ""
    default: Any = None
    example: Any = None


def number(name: str, value: Any, **limits: float) -> float:
    """A number within limits; YAML reads 1e-3 as a text, so a text is tried as a number."""
    if isinstance(value, str):
        with suppress(ValueError):
            value = float(value)
    return check_number(name, value, **limits)


def choice(name: str, value: Any, choices: tuple[str, ...]) -> str:
    """One of a few words."""
    check_choice(name, value, choices)
    return str(value)


def word(name: str, value: Any) -> str:
    """A text that is not empty."""
    if not isinstance(value, str) or not value.strip():
        raise ValueError(f"{name} must be a text, got {shown(value)}")
    return value


def pair_of_numbers(name: str, value: Any, **limits: float) -> tuple[float, float]:
    """Two numbers in rising order, each within limits."""
    if isinstance(value, (list, tuple)) and len(value) == 2:
        value = [number(f"{name}[{i}]", each, **limits) for i, each in enumerate(value)]
    return check_reach(name, value)


def numbers(name: str, value: Any) -> float | tuple[float, ...]:
    """A number, or a list of them."""
    if not isinstance(value, (list, tuple)):
        return number(name, value)
    if not value:
        raise ValueError(f"{name} must be a number or a list of numbers, got none")
    return tuple(number(f"{name}[{i}]", each) for i, each in enumerate(value))


def error(name: str, value: Any) -> Any:
    """A transmission error: its amplitude, or its harmonics from order 1."""
    if isinstance(value, (list, tuple)):
        return check_harmonics(name, value, lowest=1)
    if is_number(value) or isinstance(value, str):
        return number(name, value, at_least=0.0)
    raise ValueError(f"{name} must be an amplitude or a list of [order, amplitude, phase], got {shown(value)}")


above, at_least = partial(number, above=0.0), partial(number, at_least=0.0)


def _of_each(rows: Iterable[tuple[Any, ...]]) -> list[Entry]:
    """Rows of which both gears have one: the name without the gear, and the meaning with a place for it."""
    return [
        Entry(f"{who}_{name}", meaning.format(who), *rest)
        for name, meaning, *rest in rows
        for who in ("pinion", "gear")
    ]


GROUPS: dict[str, list[Entry]] = {
    "The teeth": [
        Entry("pinion_teeth", "teeth of the pinion, which drives", partial(check_count, at_least=3), example=28),
        Entry("gear_teeth", "teeth of the gear", partial(check_count, at_least=3), example=57),
        Entry("module_mm", "module", above, "mm", example=3.0),
        Entry("face_width_mm", "face width of both gears", above, "mm", example=25.0),
        *_of_each([("face_width_mm", "the {}'s own face width, where it is another", above, "mm")]),
        Entry(
            "pressure_angle_deg", "pressure angle of the rack", partial(number, above=0.0, below=90.0), "degrees", 20.0
        ),
        Entry("addendum", "addendum of the rack", above, "modules", 1.0),
        Entry("clearance", "clearance", above, "modules", 0.25),
        Entry("tip_radius", "radius of the rack's tip; the widest that suits, unless given", at_least, "modules"),
        *_of_each([("shift", "profile shift of the {}", number, "modules", 0.0)]),
        Entry(
            "centre_distance_mm",
            "working centre distance, from which the shifts follow: the one not given, or half of the sum each",
            above,
            "mm",
        ),
        Entry("tip_shortening", "what both tips are turned down by", at_least, "modules", 0.0),
        *_of_each(
            [
                ("tip_shortening", "the {}'s own shortening", at_least, "modules"),
                ("tip_diameter_mm", "tip diameter of the {}, in place of its shortening", above, "mm"),
            ]
        ),
    ],
    "The bodies": [
        Entry("bore_ratio", "radius of both bores over the pitch radius; 0 is solid", at_least, "", 0.3),
        *_of_each(
            [
                ("bore_ratio", "the {}'s own", at_least),
                ("bore_diameter_mm", "bore of the {}, in place of its ratio; 0 is solid", at_least, "mm"),
            ]
        ),
        Entry("youngs_modulus_gpa", "Young's modulus of both gears", above, "GPa", 206.8),
        Entry("poisson_ratio", "Poisson's ratio of both", partial(number, above=0.0, below=0.5), "", 0.3),
        Entry("density_kg_m3", "density of both; steel's 7850 for what is as stiff as steel", above, "kg/m^3"),
        *_of_each(
            [
                ("youngs_modulus_gpa", "the {}'s own Young's modulus", above, "GPa"),
                ("poisson_ratio", "the {}'s own Poisson's ratio", partial(number, above=0.0, below=0.5)),
                ("density_kg_m3", "the {}'s own density", above, "kg/m^3"),
                ("rim_mm", "radial thickness of the {}'s rim; a solid disc without", above, "mm"),
                ("web_mm", "axial thickness of the {}'s web; goes with a rim", above, "mm"),
                ("hub_mm", "radial thickness of the {}'s hub", at_least, "mm"),
                ("added_inertia_kg_m2", "inertia of what turns rigidly with the {}", at_least, "kg m^2", 0.0),
                ("inertia_kg_m2", "whole inertia of the {}, in place of what follows from its size", above, "kg m^2"),
            ]
        ),
        Entry("coupling", "how the teeth share a body", partial(choice, choices=get_args(Coupling)), "", "ring"),
        Entry("n_levels", "levels of the staircase that stands for the stiffness", check_count, "", 16),
    ],
    "The backlash: as a whole, or as tooth thickness allowances of both gears": [
        Entry("backlash_um", "whole backlash, as the next line says", above, "um", example=100.0),
        Entry(
            "backlash",
            "along the line of action; or circumferential, or thickness: of both gears' teeth together",
            partial(choice, choices=BACKLASHES),
            "",
            "normal",
        ),
        *_of_each(
            [
                (
                    "thickness_allowance_um",
                    "tooth thickness allowances of the {}, [lower, upper], as [-90, -60]",
                    partial(pair_of_numbers, at_most=0.0),
                    "um",
                )
            ]
        ),
        Entry("centre_distance_deviation_um", "[lower, upper]; goes with the allowances", pair_of_numbers, "um"),
    ],
    "The errors: an amplitude, harmonics, a measurement or an accuracy grade": [
        Entry(
            "transmission_error_um",
            "amplitude of the static transmission error, phase unknown; or all harmonics, [[order, amplitude, phase]]",
            error,
            "um",
            example=4.0,
        ),
        Entry("error_phase_rad", "phase of the amplitude, where it was measured", number, "rad"),
        Entry("error_harmonics", "harmonics from order 2, [[order, amplitude, phase]]", check_harmonics, "um and rad"),
        Entry("transmission_error_csv", "a file of a measured transmission error in micrometres, at equal steps", word),
        Entry(
            "transmission_error_covers",
            "what the measurement covers: a mesh period, or a revolution of the pinion or of the gear",
            partial(choice, choices=COVERS),
            "",
            "mesh",
        ),
        Entry(
            "iso_grade",
            "ISO 1328-1:2013 flank tolerance class of both gears",
            partial(check_count, at_least=GRADES[0], at_most=GRADES[1]),
        ),
        Entry(
            "shaft_orders",
            "run-out and the like, [[teeth of the wheel, amplitude, phase, order]]",
            check_shaft_orders,
            "um and rad",
        ),
        *_of_each([("relief_um", "tip relief of the {}, normal to the flank", at_least, "um", 0.0)]),
        Entry("relief_length", "length of the reliefs along the line of action", above, "base pitches"),
        Entry("base_pitch_um", "base pitch deviation, for ISO's dynamic factor alone", at_least, "um"),
        Entry("profile_um", "profile form deviation, likewise", at_least, "um"),
    ],
    "The load": [
        Entry("pinion_torque_nm", "driving torque, of either sign, or a list", numbers, "N m", example=120.0),
        Entry(
            "damping_ratio", "damping ratio of the mesh: an assumption, known to a factor of two", at_least, "", 0.05
        ),
    ],
    "The speeds of the pinion": [
        Entry(
            "service_rpm",
            "speeds that the drive runs at, [lowest, highest]",
            partial(pair_of_numbers, above=0.0),
            "rpm",
        ),
        Entry("lowest_rpm", "where the chart begins; around the mesh resonance, unless given", above, "rpm"),
        Entry("highest_rpm", "where it ends", above, "rpm"),
        Entry("pinion_speed_rpm", "one speed, for the library", above, "rpm"),
        Entry("n_speeds", "speeds on the chart", partial(check_count, at_least=2), "", 121),
        Entry(
            "n_starts",
            "starts tried at each speed and phase, beside runs up and down",
            partial(check_count, at_least=0),
            "",
            12,
        ),
        Entry("n_phases", "phases tried of an error whose phase is unknown", check_count, "", 8),
    ],
    "Where the gear idles: all three, and the torque may be left out": [
        Entry("idle_order", "swings of the pinion per turn, an engine order", above),
        Entry("idle_swing_deg", "amplitude of the swing", at_least, "degrees"),
        Entry("idle_drag_nm", "torque that holds the idle gear back", above, "N m"),
    ],
}
ENTRIES = {entry.name: entry for group in GROUPS.values() for entry in group}
