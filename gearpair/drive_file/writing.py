"""A drive's file written: of a drive that is there, or as an example with a comment to each line."""

from __future__ import annotations

import os
import tempfile
from dataclasses import asdict, fields, replace
from pathlib import Path
from textwrap import wrap
from typing import Any

from gearpair.drive_file.entries import ENTRIES, GROUPS, Entry
from gearpair.drive_file.reading import GEARS, NEEDED, OF_PAIR
from gearpair.teeth import GearBlank, Material, SpurPair

HEAD = """\
# A spur gear pair as it stands on a drawing and a data sheet.
# gearpair drive pair.yml tells at which speeds its teeth part; with --html report.html it writes a report.
# What is commented out may be left out; the value shown is taken then, or what the comment says.
"""
WIDTH = 110


def write_drive_file(path: str | Path, drive: Any) -> None:
    """Write a `GearDrive` of a drawing to a file from which the same drive comes back; that or nothing.

    Raises
    ------
    ValueError
        For a drive without a drawing, or one of which a part was changed by hand that follows from the drawing.
    """
    if drive.mesh is None:
        raise ValueError("a file holds a drawing, and this drive has none: make it by GearDrive.from_pair")
    path = Path(path)
    lines = [f"{name}: {_yaml(value)}\n" for name, value in entries_of(drive).items()]
    handle, partial = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with open(handle, "w", encoding="utf-8") as file:
            file.writelines(lines)
        back = replace(type(drive).from_file(partial), damping_n_s_per_m=drive.damping_n_s_per_m)  # up to rounding
        names = [field.name for field in fields(drive) if field.compare]
        if lost := [name for name in names if getattr(back, name) != getattr(drive, name)]:
            raise ValueError(f"a file cannot hold what was changed by hand: {', '.join(lost)}")
        os.chmod(partial, 0o644)
        os.replace(partial, path)
    except BaseException:
        os.unlink(partial)
        raise


def example() -> str:
    """A drive's file with every entry and what it means.

    Examples
    --------
    >>> "pinion_teeth: 28" in example(), "# damping_ratio: 0.05" in example()
    (True, True)
    """
    parts = [HEAD]
    for heading, entries in GROUPS.items():
        parts.append(f"\n# {heading}\n" + "".join(_line(entry) for entry in entries))
    return "".join(parts)


def _line(entry: Entry) -> str:
    """An entry as a line of the example, its meaning behind it or, where that is long, before it."""
    unit = f"; {entry.unit}" if entry.unit else ""
    if entry.example is None:
        left = f"# {entry.name}:{'' if entry.default is None else ' ' + _yaml(entry.default)}"
    else:
        left = f"{entry.name}: {_yaml(entry.example)}"
    told = f"{left:<36}  # {entry.meaning}{unit}"
    if len(told) <= WIDTH:
        return told + "\n"
    above = "".join(f"#   {line}\n" for line in wrap(entry.meaning + unit, WIDTH - 4))
    return f"{above}{left}\n"


def _yaml(value: Any) -> str:
    """A value on one line."""
    import yaml  # here, so that importing gearpair stays quick

    plain = [list(each) if isinstance(each, tuple) else each for each in value] if isinstance(value, tuple) else value
    text = yaml.safe_dump(plain, default_flow_style=True, width=10**9, sort_keys=False)
    return str(text).removesuffix("...\n").strip()


def entries_of(drive: Any) -> dict[str, Any]:
    """The entries that say a `GearDrive` of a drawing; what is as everywhere is left out."""
    pair, names = drive.mesh.pair, {field.name: field.default for field in fields(SpurPair)}
    found = {name: getattr(pair, name) for name in OF_PAIR if name in NEEDED or getattr(pair, name) != names[name]}
    for who in GEARS:
        found |= _body(who, getattr(pair, f"{who}_material"), getattr(drive, f"{who}_blank"))
        if getattr(drive, f"{who}_blank") is None:
            found[f"{who}_inertia_kg_m2"] = getattr(drive, f"{who}_inertia_kg_m2")
    found |= {
        "coupling": drive.mesh.coupling,
        "n_levels": len(drive.stiffness.levels),
        "backlash_um": drive.backlash_um,
    }
    found |= {"transmission_error_um": drive.transmission_error_um, "error_phase_rad": drive.error_phase_rad}
    found |= {"error_harmonics": drive.error_harmonics or None, "shaft_orders": drive.shaft_orders or None}
    if (relief := drive.relief) is not None:
        found |= {
            "pinion_relief_um": relief.pinion_um,
            "gear_relief_um": relief.gear_um,
            "relief_length": relief.length,
        }
    found |= {"pinion_torque_nm": drive.pinion_torque_nm, "damping_ratio": float(f"{drive.damping_ratio:.15g}")}
    found["pinion_speed_rpm"] = drive.pinion_speed_rpm
    return {n: value for n, value in found.items() if value is not None and value != ENTRIES[n].default or n in NEEDED}


def _body(who: str, material: Material | None, blank: GearBlank | None) -> dict[str, Any]:
    """What one gear is made of, and its rim, web and hub."""
    found = {} if material is None else {f"{who}_{name}": value for name, value in asdict(material).items()}
    if blank is not None:
        found |= {f"{who}_{name}": value for name, value in asdict(blank).items() if value}
    return found
