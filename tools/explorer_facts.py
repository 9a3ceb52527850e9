"""What the explorer's page takes from the library, in files that only this writes: `library.js` and `colours.css`.

    python -m tools.explorer_facts

Parameters with their symbols and initial values, tolerances, names and colours are the library's; the ranges of the
sliders, their short labels and the colours on dark paper are the page's own choice and stand here.
"""

from __future__ import annotations

import json
from pathlib import Path
from textwrap import indent
from typing import Any, NamedTuple

import gearpair as gp
from gearpair._flow import cells, closed_form, event_search, newton, settle, stable_orbits, walk
from gearpair.motion.names import IMPACT_NAMES, WORDS
from gearpair.motion.settling import MANY, ONE
from gearpair.plotting.style import BACKLASH, BOUNDARY, INK, MOTION_COLOURS
from gearpair.quantities import LETTERS, QUANTITIES
from gearpair.stiffness import READINGS

FOLDER = Path(__file__).resolve().parents[1] / "book" / "_static" / "explorer"


class Slider(NamedTuple):
    """A slider goes from `low` to `high`; an address may give any value from `lowest` to `highest`."""

    name: str
    label: str
    low: float
    high: float
    step: float
    lowest: float | None = None
    highest: float | None = None


SLIDERS = (
    Slider("mesh_frequency", "Mesh frequency", 0.2, 3.0, 0.001),
    Slider("damping_ratio", "Damping ratio", 0.0, 0.2, 0.0005),
    Slider("mean_force", "Mean force", 0.0, 0.5, 0.005),
    Slider("error_amplitude", "Error amplitude", 0.0, 1.0, 0.005),
    Slider("error_phase", "Error phase (rad)", -3.14, 3.14, 0.01, -6.3, 6.3),
    Slider("contact_ratio", "Contact ratio", 1.05, 1.95, 0.005, 1.01, 1.99),
    Slider("a", "Added in double contact", 0.0, 1.0, 0.002),
    Slider("b", "Missing in single contact", 0.0, 0.9, 0.002),
    Slider("start_x", "Displacement", -6.0, 6.0, 0.01, -1000.0, 1000.0),
    Slider("start_v", "Velocity", -6.0, 6.0, 0.01, -1000.0, 1000.0),
    Slider("flight_damping", "Damping ratio in free flight", 0.0, 0.2, 0.0005),
)
START = {"start_x": ("x", 1.0), "start_v": ("v", 0.0)}  # where the page's motions begin, as `gp.steady_state`'s do
SWEPT = ("mesh_frequency", "damping_ratio", "mean_force", "error_amplitude")

ROOTS = ".gp"  # what has these colours
DARK = {  # each hue stays the same; what is missing here has the colour of light paper
    "period 1": "#3D9BD9",
    "period 3": "#1FBF92",
    "period 4": "#F0803C",
    "other periods": "#B8955A",
    "chaos": "#E4E2DC",
    "chaotic transient": "#B3A4D4",
    "unsettled": "#8B8B8B",
    "floating": "#5F7357",
    "escaped": "#4A4A4A",
    "ink": "#A9C7EC",
    "backlash": "#25282D",
    "drive": "#F0803C",
    "coast": "#3D9BD9",
}


def facts() -> dict[str, Any]:
    """All that `library.js` holds, by the names that the scripts use."""
    return {
        "numbers": [_number(slider) for slider in SLIDERS],
        "choices": [
            {"name": "reading", "value": READINGS[0], "choices": list(READINGS)},
            {"name": "diagram", "value": SWEPT[0], "choices": list(SWEPT)},
        ],
        "motions": list(MOTION_COLOURS),
        "impacts": {str(state): name for state, name in IMPACT_NAMES.items() if state},
        "words": {str(status): word for status, word in WORDS.items()},
        "settling": {
            "maxPeriod": ONE.max_period,
            "exponentPeriods": ONE.n_exponent,
            "manyExponentPeriods": MANY.n_exponent,
            "watch": ONE.n_watch,
            "samples": ONE.n_samples,
        },
        "tolerances": {
            "DEGREE": closed_form.DEGREE,
            "REACH": closed_form.REACH,
            "ESCAPE_RADIUS": cells.ESCAPE_RADIUS,
            "MAX_EVENTS_PER_PERIOD": walk.MAX_EVENTS_PER_PERIOD,
            "MAX_STEPS": event_search.MAX_STEPS,
            "NEWTON_STEPS": newton.NEWTON_STEPS,
            "NEWTON_ROUNDING": newton.NEWTON_ROUNDING,
            "SAME_POINT": newton.SAME_POINT,
            "RETURNED": stable_orbits.RETURNED,
            "CAPTURED": settle.CAPTURED,
            "STABLE": stable_orbits.STABLE,
            "MOST_TRACE": stable_orbits.MOST_TRACE,
            "NEAR": stable_orbits.NEAR,
            "RESOLVED": settle.RESOLVED,
            "ROUNDING": settle.ROUNDING,
            "EXPONENT_BLOCKS": settle.EXPONENT_BLOCKS,
        },
    }


def _number(slider: Slider) -> dict[str, Any]:
    osc = gp.Oscillator()
    own: dict[str, tuple[str, float | None]] = {**START, "flight_damping": ("flight_damping", osc.flight_damping)}
    name, value = own.get(slider.name) or (slider.name, osc.parameter(slider.name))
    low, high = slider.low, slider.high
    return {
        "name": name,
        "symbol": _as_html(QUANTITIES[slider.name].symbol),
        "label": slider.label,
        "value": value,
        "min": low,
        "max": high,
        "step": slider.step,
        "lowest": low if slider.lowest is None else slider.lowest,
        "highest": high if slider.highest is None else slider.highest,
    }


def _as_html(symbol: str) -> str:
    """A symbol in plain letters, such as ``Omega_h`` or ``F_m'``, as HTML sets it."""
    body, prime = symbol.removesuffix("'"), symbol[len(symbol.removesuffix("'")) :].replace("'", "′")
    letter, _, index = body.partition("_")
    return LETTERS.get(letter, letter) + (f"<sub>{LETTERS.get(index, index)}</sub>" if index else "") + prime


def colours() -> dict[str, dict[str, str]]:
    """The custom properties of `colours.css`, on light paper and on dark."""
    light = dict(MOTION_COLOURS) | {
        "ink": INK,
        "backlash": BACKLASH,
        "boundary": BOUNDARY,
        "drive": MOTION_COLOURS["period 4"],
        "coast": MOTION_COLOURS["period 1"],
    }
    return {"light": light, "dark": DARK}


def library_js() -> str:
    """The text of `library.js`."""
    return (
        "// What the page takes from the library. Written by tools/explorer_facts.py: change nothing here.\n"
        f'gearpair.define("library", [], () => ({json.dumps(facts(), indent=2, ensure_ascii=False)}));\n'
    )


def colours_css() -> str:
    """The text of `colours.css`."""
    light, dark = (
        "".join(f"  --gp-{name.replace(' ', '-')}: {colour.lower()};\n" for name, colour in shades.items())
        for shades in colours().values()
    )
    return (
        "/* The book's colours. Written by tools/explorer_facts.py: change nothing here. */\n"
        f"{ROOTS} {{\n{light}}}\n"
        f'@media not print {{\n  html[data-theme="dark"] {ROOTS} {{\n{indent(dark, "  ")}  }}\n}}\n'
    )


WRITTEN = {"library.js": library_js, "colours.css": colours_css}


def main() -> None:
    """Write the files."""
    for name, text in WRITTEN.items():
        (FOLDER / name).write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    main()
