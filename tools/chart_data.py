"""What the speed chart in the page takes from the library: names, ranges, defaults, words and numbers of tables.

Run ``python -m tools.chart_data`` after a change of any of them; a test tells when it is due.
"""

import json
from pathlib import Path
from typing import Any

from gearpair.design import found
from gearpair.design.charts import BEYOND, FIRST, LAST
from gearpair.design.speed_ranges import NARROWEST
from gearpair.drive_file import ENTRIES
from gearpair.motion.names import IMPACT_NAMES
from gearpair.motion.settling import CHART
from gearpair.teeth import iso6336
from gearpair.teeth.spurpair import BACKLASHES

PATH = Path(__file__).parents[1] / "book" / "_static" / "chart" / "data.js"
# What the page asks for, in its groups; `speed_chart.ipynb` has the same names.
GROUPS = {
    "Teeth": ["pinion_teeth", "gear_teeth", "module_mm", "face_width_mm", "pinion_shift", "gear_shift"],
    "Load and errors": ["pinion_torque_nm", "backlash_um", "backlash", "transmission_error_um", "damping_ratio"],
    "Rack and bodies": [
        *("pressure_angle_deg", "addendum", "clearance", "bore_ratio"),
        *("pinion_added_inertia_kg_m2", "gear_added_inertia_kg_m2"),
    ],
    "ISO 6336-1, and the ends of the chart": ["base_pitch_um", "profile_um", "lowest_rpm", "highest_rpm"],
}
# Beside a field, where the file's words are too long.
LABELS = {
    "pinion_teeth": "teeth of the pinion",
    "face_width_mm": "face width",
    "pinion_torque_nm": "torque of the pinion",
    "backlash_um": "backlash",
    "backlash": "stated as",
    "transmission_error_um": "transmission error, amplitude",
    "damping_ratio": "damping ratio",
    "pressure_angle_deg": "pressure angle",
    "bore_ratio": "bore radius / pitch radius",
    "addendum": "addendum",
    "pinion_added_inertia_kg_m2": "added inertia, pinion",
    "gear_added_inertia_kg_m2": "added inertia, gear",
    "base_pitch_um": "base pitch deviation",
    "profile_um": "profile form deviation",
    "lowest_rpm": "first speed",
    "highest_rpm": "last speed",
}
SYMBOLS = {
    **{"pinion_teeth": "z1", "gear_teeth": "z2", "module_mm": "m", "face_width_mm": "b"},
    **{"pinion_shift": "x1", "gear_shift": "x2", "pressure_angle_deg": "alpha", "damping_ratio": "zeta"},
    **{"pinion_torque_nm": "T1", "base_pitch_um": "f_pb", "profile_um": "f_falpha"},
}
ISO_DEVIATIONS = {"base_pitch_um": 8.0, "profile_um": 8.0}  # of the chapter
COUNTS = ("pinion_teeth", "gear_teeth")
LIMITS: dict[str, dict[str, float]] = {  # as the chapter checks them
    **dict.fromkeys(COUNTS, {"at_least": 3}),
    **dict.fromkeys(("module_mm", "face_width_mm", "addendum", "clearance", "backlash_um"), {"above": 0.0}),
    **dict.fromkeys(("pinion_torque_nm", "lowest_rpm", "highest_rpm"), {"above": 0.0}),
    "pressure_angle_deg": {"above": 0.0, "below": 90.0},
    **dict.fromkeys(("transmission_error_um", "bore_ratio", "base_pitch_um", "profile_um"), {"at_least": 0.0}),
    **dict.fromkeys(("pinion_added_inertia_kg_m2", "gear_added_inertia_kg_m2"), {"at_least": 0.0}),
    "damping_ratio": {"at_least": 0.0, "at_most": 100.0},
    **dict.fromkeys(("pinion_shift", "gear_shift"), {}),
}


def field(name: str) -> dict[str, Any]:
    """One field of the page."""
    entry = ENTRIES[name]
    value = entry.example if entry.example is not None else ISO_DEVIATIONS.get(name, entry.default)
    told: dict[str, Any] = {"name": name, "label": LABELS.get(name, entry.meaning), "unit": entry.unit, "value": value}
    told |= {"symbol": SYMBOLS.get(name, ""), "meaning": entry.meaning, "default": entry.default}
    if name == "backlash":
        return {**told, "choices": list(BACKLASHES)}
    return {**told, "whole": name in COUNTS, "limits": LIMITS[name]}


def data() -> dict[str, Any]:
    """All of it."""
    return {
        "groups": [{"title": title, "fields": [field(name) for name in names]} for title, names in GROUPS.items()],
        "steel": {name: ENTRIES[name].default for name in ("youngs_modulus_gpa", "poisson_ratio")},
        **{name: ENTRIES[name].default for name in ("n_levels", "n_speeds", "n_starts", "n_phases")},
        "settle": {"maxPeriod": CHART.max_period, "exponentPeriods": CHART.n_exponent, "samples": CHART.n_samples},
        "reach": {"first": FIRST, "last": LAST, "beyond": BEYOND},
        "narrowest": NARROWEST,
        "losses": ["", *found.LOSSES],
        "impacts": {str(state): name for state, name in IMPACT_NAMES.items()},
        "flexibility": list(iso6336._C),
        "steel_mpa": iso6336._STEEL_MPA,
    }


def text() -> str:
    """The stored script."""
    body = json.dumps(data(), indent=2, ensure_ascii=False)
    return (
        "// Written by `python -m tools.chart_data` from the library; change it there.\n"
        f'gearpair.define("chart/data", [], function () {{\n  return {body};\n}});\n'
    )


if __name__ == "__main__":
    PATH.write_text(text(), encoding="utf-8")
