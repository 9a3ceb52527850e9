"""From a drive's file to what `GearDrive.from_pair` takes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from gearpair._equality import equal_by_value
from gearpair.drive_file.entries import ENTRIES
from gearpair.drive_file.measured import measured_error
from gearpair.teeth import GearBlank, Material, SpurPair, TipRelief, flank_tolerances
from gearpair.teeth.spurgear import inv

GEARS = ("pinion", "gear")
NEEDED = ("pinion_teeth", "gear_teeth", "module_mm", "face_width_mm")
IDLE = ("idle_order", "idle_swing_deg", "idle_drag_nm")
OF_PAIR = (
    *NEEDED,
    *("pressure_angle_deg", "addendum", "clearance", "tip_radius", "tip_shortening", "bore_ratio"),
    *("youngs_modulus_gpa", "poisson_ratio", "density_kg_m3"),
    *(f"{who}_{name}" for who in GEARS for name in ("shift", "face_width_mm", "bore_ratio", "tip_shortening")),
)
AFTERWARDS = ("error_phase_rad", "error_harmonics", "pinion_inertia_kg_m2", "gear_inertia_kg_m2")  # by `replace`
# What a default says nothing of, once this is given.
INSTEAD = {
    **dict.fromkeys(("pinion_shift", "gear_shift"), "centre_distance_mm"),
    **{f"{who}_added_inertia_kg_m2": f"{who}_inertia_kg_m2" for who in GEARS},
    "backlash": "pinion_thickness_allowance_um",
}
# What says the same in two ways.
EITHER = (
    *((f"{who}_tip_diameter_mm", f"{who}_tip_shortening") for who in GEARS),
    *((f"{who}_bore_diameter_mm", f"{who}_bore_ratio") for who in GEARS),
    *((f"{who}_inertia_kg_m2", f"{who}_{name}") for who in GEARS for name in ("added_inertia_kg_m2", "rim_mm")),
    *(("backlash_um", f"{who}_thickness_allowance_um") for who in GEARS),
    ("transmission_error_um", "transmission_error_csv"),
)


@equal_by_value
@dataclass(frozen=True)
class DriveFile:
    """What a file says of a drive.

    Attributes
    ----------
    path : Path
    given : mapping of str to object
        The entries, checked.
    pair : SpurPair
    keywords : mapping of str to object
        What `GearDrive.from_pair` takes beside the pair; of several torques the first.
    changes : mapping of str to object
        What `GearDrive.replace` takes then.
    torques_nm : tuple of float
        Empty where the gear only idles.
    backlash_range_um : tuple of float, optional
        The least and the largest backlash that the allowances leave, along the line of action.
    notes : tuple of str
        What was taken where the file leaves a choice, in sentences.
    """

    path: Path
    given: Mapping[str, Any]
    pair: SpurPair
    keywords: Mapping[str, Any]
    changes: Mapping[str, Any]
    torques_nm: tuple[float, ...]
    backlash_range_um: tuple[float, float] | None
    notes: tuple[str, ...]

    def value(self, name: str) -> Any:
        """What is given, or the default of an entry."""
        return self.given.get(name, ENTRIES[name].default)

    def made(self, kind: Any) -> Any:
        """The drive, of the class that is handed over: `gearpair.GearDrive`, which imports this module."""
        with told_of(self.path):
            return kind.from_pair(self.pair, **self.keywords).replace(**self.changes)

    @property
    def defaults(self) -> dict[str, Any]:
        """The entries that are not given, whose default is taken."""
        known = {*self.given, *(name for name, other in INSTEAD.items() if other in self.given)}
        if "transmission_error_csv" not in self.given:
            known.add("transmission_error_covers")
        return {name: e.default for name, e in ENTRIES.items() if name not in known and e.default is not None}

    @property
    def idle(self) -> dict[str, float] | None:
        """What `gearpair.design.idle_rattle` takes, where the gear idles."""
        if "idle_order" not in self.given:
            return None
        names = ("order", "pinion_swing_deg", "drag_torque_nm")
        return {name: self.given[entry] for name, entry in zip(names, IDLE, strict=True)}

    @property
    def iso_deviations(self) -> dict[str, float] | None:
        """Base pitch and profile form deviation, given or of the grade, the larger of both gears; None without."""
        grade = self.given.get("iso_grade")
        of_grade = (
            [] if grade is None else [flank_tolerances(each, grade) for each in (self.pair.pinion, self.pair.gear)]
        )
        found: dict[str, Any] = {
            "base_pitch_um": self.given.get("base_pitch_um", max((e.base_pitch_um for e in of_grade), default=None)),
            "profile_um": self.given.get("profile_um", max((e.profile_form_um for e in of_grade), default=None)),
        }
        return None if None in found.values() else found


@contextmanager
def told_of(path: Path) -> Iterator[None]:
    """Let what is wrong be told with the file's name."""
    try:
        yield
    except (ValueError, TypeError) as error:
        raise ValueError(f"{path}: {error}") from None


def read_drive_file(path: str | Path) -> DriveFile:
    """Read a drive's file.

    Raises
    ------
    ValueError
        In a sentence that begins with the file's name: unknown names, values out of their range, what contradicts or
        lacks something else, a pair that cannot be cut or cannot run.
    """
    path = Path(path)
    with told_of(path):
        given = _checked(_entries(path))
        _check_together(given)
        notes: list[str] = []
        pair = _pair(given, notes)
        low, high = _backlash(pair, given)
        if low != high:
            notes.append(f"backlash {0.5 * (low + high):.4g} um, the middle of what the allowances leave")
        torque = given.get("pinion_torque_nm", ())
        torques = torque if isinstance(torque, tuple) else (torque,)
        changes = {name: given[name] for name in AFTERWARDS if name in given}
        damping = given.get("damping_ratio", ENTRIES["damping_ratio"].default)
        keywords: dict[str, Any] = {
            "pinion_torque_nm": torques[0] if torques else 0.0,
            "backlash_um": 0.5 * (low + high),
            "damping_ratio": damping,
            **{name: given[name] for name in ("pinion_speed_rpm", "coupling", "n_levels") if name in given},
            **{f"{who}_blank": _blank(given, who) for who in GEARS},
            **_errors(path, pair, given, notes),
            "relief": _relief(given),
        }
        changes |= {"damping_ratio": damping} if changes else {}
        return DriveFile(
            path, given, pair, keywords, changes, torques, (low, high) if low != high else None, tuple(notes)
        )


def _entries(path: Path) -> dict[str, Any]:
    """The lines of a YAML file."""
    import yaml  # here, so that importing gearpair stays quick

    try:
        text = path.read_text(encoding="utf-8")
        read, nodes = yaml.safe_load(text), yaml.compose(text, Loader=yaml.SafeLoader)
    except OSError as error:
        raise ValueError(f"cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise ValueError("cannot be read: it is no text file") from None
    except (yaml.YAMLError, ValueError) as error:
        mark = getattr(error, "problem_mark", None)
        where = f" at line {mark.line + 1}" if mark else ""
        raise ValueError(f"cannot be read as YAML{where}: {getattr(error, 'problem', None) or error}") from None
    if not isinstance(read, dict):
        raise ValueError("must hold lines NAME: VALUE; gearpair drive --example shows one")
    names = [str(key.value) for key, _ in getattr(nodes, "value", ())]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{name} is given {names.count(name)} times")
    return {str(name): value for name, value in read.items()}


def _checked(read: Mapping[str, Any]) -> dict[str, Any]:
    """The entries that have a value, each as its check has it."""
    for name in read:
        if name not in ENTRIES:
            close = get_close_matches(name, ENTRIES, 1)
            help_ = f"did you mean {close[0]!r}?" if close else "gearpair drive --example lists what there is"
            raise ValueError(f"unknown name {name!r}; {help_}")
    return {name: ENTRIES[name].check(name, value) for name, value in read.items() if value is not None}


def _check_together(given: Mapping[str, Any]) -> None:
    """What is needed, and what excludes or needs something else."""
    for name in NEEDED:
        if name not in given:
            raise ValueError(f"{name} is needed ({ENTRIES[name].meaning})")
    for one, other in EITHER:
        if one in given and other in given:
            raise ValueError(f"give {one} or {other}, not both")
    allowances = [f"{who}_thickness_allowance_um" in given for who in GEARS]
    if "backlash_um" not in given and not all(allowances):
        raise ValueError("backlash_um is needed, or the thickness_allowance_um of both pinion and gear")
    if "centre_distance_deviation_um" in given and not all(allowances):
        raise ValueError("centre_distance_deviation_um goes with thickness allowances: backlash_um says it all already")
    sources = ("transmission_error_um", "transmission_error_csv", "iso_grade")
    if not any(name in given for name in sources):
        raise ValueError(f"one of {', '.join(sources)} is needed; transmission_error_um: 0 says that there is none")
    if "error_phase_rad" in given and not isinstance(given.get("transmission_error_um"), float):
        raise ValueError("error_phase_rad goes with a transmission_error_um that is an amplitude")
    if "transmission_error_covers" in given and "transmission_error_csv" not in given:
        raise ValueError("transmission_error_covers goes with a transmission_error_csv")
    if ("relief_length" in given) != any(given.get(f"{who}_relief_um") for who in GEARS):
        raise ValueError("relief_length goes with a pinion_relief_um or gear_relief_um above 0")
    idle = [name for name in IDLE if name in given]
    if idle and len(idle) < len(IDLE):
        raise ValueError(f"{', '.join(IDLE)} go together, got {', '.join(idle)} alone")
    if "pinion_torque_nm" not in given and not idle:
        raise ValueError("pinion_torque_nm is needed, unless the gear idles (idle_order and what goes with it)")
    low, high = given.get("lowest_rpm"), given.get("highest_rpm")
    if low is not None and high is not None and not low < high:
        raise ValueError(f"lowest_rpm must be below highest_rpm, got {low:g} and {high:g}")


def _pair(given: Mapping[str, Any], notes: list[str]) -> SpurPair:
    """The pair, with the shifts that follow from a centre distance, and ratios that follow from diameters."""
    sizes = {name: given[name] for name in OF_PAIR if name in given} | _shifts(given, notes)
    module = given["module_mm"]
    for who in GEARS:
        pitch = module * given[f"{who}_teeth"]
        if (bore := given.get(f"{who}_bore_diameter_mm")) is not None:
            sizes[f"{who}_bore_ratio"] = bore / pitch
        if (tip := given.get(f"{who}_tip_diameter_mm")) is not None:
            full = pitch + 2.0 * module * (sizes.get("addendum", 1.0) + sizes.get(f"{who}_shift", 0.0))
            if tip > full * (1.0 + 1e-9):
                raise ValueError(
                    f"{who}_tip_diameter_mm must be at most {full:g} with this addendum and shift, got {tip:g}"
                )
            sizes[f"{who}_tip_shortening"] = max(full - tip, 0.0) / (2.0 * module)
        sizes[f"{who}_material"] = _material(given, who)
    return SpurPair(**sizes)


def _shifts(given: Mapping[str, Any], notes: list[str]) -> dict[str, float]:
    """The shifts that follow from a centre distance (ISO 21771): the one not given, or half of the sum each."""
    if (distance := given.get("centre_distance_mm")) is None:
        return {}
    teeth = given["pinion_teeth"] + given["gear_teeth"]
    angle = math.radians(given.get("pressure_angle_deg", ENTRIES["pressure_angle_deg"].default))
    ratio = given["module_mm"] * teeth / 2.0 * math.cos(angle) / distance
    if ratio >= 1.0:
        raise ValueError(
            f"centre_distance_mm must be above {ratio * distance:g}, where the base circles touch, got {distance:g}"
        )
    total = (inv(math.acos(ratio)) - inv(angle)) * teeth / (2.0 * math.tan(angle))
    own = {f"{who}_shift": given[f"{who}_shift"] for who in GEARS if f"{who}_shift" in given}
    if len(own) == 2:
        if abs(sum(own.values()) - total) > 1e-3:
            raise ValueError(
                f"centre_distance_mm = {distance:g} goes with shifts of {total:.4f} together, got "
                f"{sum(own.values()):.4f}: leave one of the three out"
            )
        return own
    rest = {f"{who}_shift": total - sum(own.values()) for who in GEARS if f"{who}_shift" not in own}
    shared = {name: value / len(rest) for name, value in rest.items()}
    told = " and ".join(f"{name} = {value:.4f}" for name, value in shared.items())
    notes.append(f"{told}, from the centre distance" + (", half of the sum each" if len(shared) == 2 else ""))
    return own | shared


def _material(given: Mapping[str, Any], who: str) -> Material | None:
    """What one gear is made of, where that is not what both are; another modulus is another material's density."""
    names = ("youngs_modulus_gpa", "poisson_ratio", "density_kg_m3")
    own = {name: given[f"{who}_{name}"] for name in names if f"{who}_{name}" in given}
    if not own:
        return None
    both = {name: given.get(name, ENTRIES[name].default) for name in names}
    if "youngs_modulus_gpa" in own:
        both["density_kg_m3"] = None
    return Material(**(both | own))


def _blank(given: Mapping[str, Any], who: str) -> GearBlank:
    names = ("rim_mm", "web_mm", "hub_mm", "added_inertia_kg_m2")
    return GearBlank(**{name: given[f"{who}_{name}"] for name in names if f"{who}_{name}" in given})


def _relief(given: Mapping[str, Any]) -> TipRelief | None:
    if "relief_length" not in given:
        return None
    pinion, gear = (given.get(f"{who}_relief_um", 0.0) for who in GEARS)
    return TipRelief(pinion, gear, given["relief_length"])


def _backlash(pair: SpurPair, given: Mapping[str, Any]) -> tuple[float, float]:
    """The least and the largest backlash along the line of action, in micrometres.

    A deviation of the centre distance adds ``2 sin(alpha_w)`` times itself.
    """
    if "backlash_um" in given:
        found = pair.normal_backlash_um(given["backlash_um"], given.get("backlash", "normal"))
        return found, found
    ends = [given[f"{who}_thickness_allowance_um"] for who in GEARS]
    apart = given.get("centre_distance_deviation_um", (0.0, 0.0))
    thick, turn = math.cos(pair.pressure_angle), 2.0 * math.sin(pair.working_pressure_angle)
    low, high = (turn * far - thick * sum(each[i] for each in ends) for far, i in zip(apart, (1, 0), strict=True))
    if low < 0.0 or high <= 0.0:
        raise ValueError(f"the allowances leave a backlash from {low:.4g} to {high:.4g} um; it must be above 0")
    return low, high


def _errors(path: Path, pair: SpurPair, given: Mapping[str, Any], notes: list[str]) -> dict[str, Any]:
    """`transmission_error_um` and `shaft_orders` of `GearDrive.from_pair`."""
    orders = given.get("shaft_orders", ())
    if "transmission_error_um" in given:
        return {"transmission_error_um": given["transmission_error_um"], "shaft_orders": orders}
    if (name := given.get("transmission_error_csv")) is not None:
        covers = given.get("transmission_error_covers", "mesh")
        found = measured_error(path.parent / name, covers, pair)
        return {**found, "shaft_orders": (*orders, *found.get("shaft_orders", ()))}
    forms = [flank_tolerances(each, given["iso_grade"]).profile_form_um for each in (pair.pinion, pair.gear)]
    amplitude = 0.5 * sum(forms)
    notes.append(
        f"transmission error of amplitude {amplitude:g} um: half the profile form tolerances of both gears together, "
        "as if the worst of both met; the grade's pitch deviations, which differ from tooth to tooth, are left out"
    )
    return {"transmission_error_um": amplitude, "shaft_orders": orders}
