"""A drive's answer as one web page for a colleague: inputs, verdict, chart, table, what was assumed."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from html import escape
from typing import Any

from gearpair.design import speed_range_table
from gearpair.drive_file import ENTRIES
from gearpair.study.drive_answer import Answer, Loaded
from gearpair.study.record import versions
from gearpair.table import Table

PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>{style}</style>
</head>
<body><main>
<h1>{title}</h1>
<p class="of">{of}</p>
{body}
<footer>{footer}</footer>
</main></body>
</html>
"""
STYLE = """
body{margin:0;background:#fff;color:#222;font:16px/1.5 system-ui,"Segoe UI",Roboto,Helvetica,Arial,sans-serif}
main{max-width:58rem;margin:2.5rem auto;padding:0 1.25rem}
h1{font-size:1.7rem;margin:0;color:#1f3a5f}h2{font-size:1.2rem;margin:2rem 0 .5rem;color:#1f3a5f}
.of,footer,figcaption{color:#555;font-size:.9rem}.of{margin:.2rem 0 1.5rem}
.verdict{border-left:5px solid #1f3a5f;background:#f3f6fa;padding:.8rem 1.1rem;margin:0 0 1rem}
.verdict p{margin:.35rem 0}.verdict p:first-child{font-weight:600;font-size:1.1rem}
figure{margin:1rem 0;overflow-x:auto}figure svg{width:100%;height:auto}
table{border-collapse:collapse;font-size:.9rem;margin:.5rem 0 1rem;width:100%}
th,td{padding:.25rem .6rem;border-bottom:1px solid #ddd;vertical-align:top}th{border-bottom:2px solid #888}
footer{border-top:1px solid #ddd;margin:2.5rem 0;padding-top:.6rem}
@media print{main{max-width:none;margin:0}h2{break-after:avoid}figure,.verdict,tr{break-inside:avoid}}
"""
CAPTION = (
    "The dynamic factor, the largest mesh force over the mean, run up and run down; the strips above tell whether the "
    "teeth keep contact. Grey: the linear response{iso}. The band, where there is one, is the largest factor at any "
    "phase of the error."
)
# What the model is, whatever the file says.
MODEL = (
    "Spur gears, one mesh, rigid shafts: bending of shafts, bearings and housing, other meshes and friction of the "
    "teeth are left out",
    "Elastic teeth that stay in their path: edge contact, plasticity and the oil film are left out",
    "The damping is an assumption, known to a factor of two: try half and twice of it",
    "Every motion counts that a run up, a run down or one of the starts found; shocks are not computed",
)


def page(answer: Answer) -> str:
    """The page's text; it needs no other file and no network."""
    parts = [section for each in answer.loaded for section in _loaded(answer, each)]
    if answer.idle is not None:
        parts += _idle(answer)
    parts += [_heading("The drive as given"), _html(_entries(answer.file.given))]
    parts += [_heading("What follows from it"), _html(_following(answer))]
    parts += [_heading("What was assumed"), _list([*answer.file.notes, *MODEL])]
    parts += ["<p>Where the file does not say, this was taken:</p>", _html(_entries(answer.file.defaults))]
    made = ", ".join(f"{name} {number}" for name, number in versions(("gearpair",)).items()) or "gearpair"
    return PAGE.format(
        title=escape(answer.title),
        of=f"Speeds at which the teeth part, from {escape(answer.file.path.name)}",
        style=STYLE,
        body="\n".join(parts),
        footer=f"Computed by {escape(made)}, exactly between events.",
    )


def _loaded(answer: Answer, loaded: Loaded) -> list[str]:
    torque = f"{loaded.drive.pinion_torque_nm:g} N m".replace("-", "\N{MINUS SIGN}")
    sentences = "".join(f"<p>{escape(sentence)}</p>" for sentence in loaded.verdict.sentences)
    iso = "" if loaded.iso is None else ", and ISO 6336-1's factor"
    told = f"Dynamic factor over the speed of the pinion at {torque}. {loaded.verdict.sentences[0]}"
    return [
        _heading(f"The verdict at {torque}"),
        f'<div class="verdict">{sentences}</div>',
        _figure(_chart(answer, loaded), told, CAPTION.format(iso=iso)),
        _heading("Speeds to avoid"),
        _html(speed_range_table(loaded.verdict.avoid)),
    ]


def _idle(answer: Answer) -> list[str]:
    from gearpair import plotting

    assert answer.idle is not None
    told = "The speed at which the flanks of the idle gear meet, over the speed of the pinion, run up."
    return [
        _heading("Idle"),
        f'<div class="verdict"><p>{escape(answer.idle_sentence)}</p></div>',
        _figure(plotting.rattle(answer.idle), f"{told} {answer.idle_sentence}", told),
    ]


def _chart(answer: Answer, loaded: Loaded) -> Any:
    from gearpair import plotting  # here, for it brings matplotlib

    service = answer.file.value("service_rpm")
    teeth = answer.file.pair.pinion_teeth
    return plotting.dynamic_factors(loaded.chart, loaded.iso, service_rpm=service, pinion_teeth=teeth)


def _figure(ax: Any, told: str, caption: str) -> str:
    text = io.StringIO()
    ax.get_figure().savefig(text, format="svg", metadata={"Date": None})
    drawing = text.getvalue()
    drawing = drawing[drawing.index("<svg") :].replace("<svg", f'<svg role="img" aria-label="{escape(told)}"', 1)
    return f"<figure>{drawing}<figcaption>{escape(caption)}</figcaption></figure>"


def _entries(values: Mapping[str, Any]) -> Table:
    rows = [
        [name, _shown(value), ENTRIES[name].unit.replace("um", "µm") or "–", ENTRIES[name].meaning]
        for name, value in values.items()
    ]
    return Table(["entry", "value", "unit", "what it is"], rows)


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return ", ".join(f"({_shown(each)})" if isinstance(each, tuple) else _shown(each) for each in value)
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _following(answer: Answer) -> Table:
    drive = answer.drive
    assert drive.mesh is not None  # it comes from a drawing
    pair = drive.mesh.pair
    rows = [
        ["contact ratio", f"{pair.contact_ratio:.3f}"],
        ["centre distance (mm)", f"{pair.centre_distance_mm:.4f}"],
        ["working pressure angle (degrees)", f"{math.degrees(pair.working_pressure_angle):.3f}"],
        ["tip diameters (mm)", f"{2 * pair.pinion.tip_circle_mm:.3f} and {2 * pair.gear.tip_circle_mm:.3f}"],
        ["inertias (kg m²)", f"{drive.pinion_inertia_kg_m2:.4g} and {drive.gear_inertia_kg_m2:.4g}"],
        ["equivalent mass along the line of action (kg)", f"{drive.equivalent_mass_kg:.4g}"],
        ["mean mesh stiffness (N/µm)", f"{drive.mean_stiffness_n_per_um:.1f}"],
        ["backlash along the line of action (µm)", f"{drive.backlash_um:.4g}"],
        ["mesh resonance (rpm of the pinion)", f"{drive.resonance_rpm:.0f}"],
        ["mesh resonance (Hz)", f"{drive.natural_frequency_rad_s / (2 * math.pi):.0f}"],
    ]
    if (deviations := answer.file.iso_deviations) is not None:
        both = " and ".join(f"{value:.3g}" for value in deviations.values())
        rows.append(["base pitch and profile form deviation, for ISO's factor (µm)", both])
    return Table(["of the drive", "value"], rows)


def _heading(text: str) -> str:
    return f"<h2>{escape(text)}</h2>"


def _list(lines: list[str]) -> str:
    return "<ul>" + "".join(f"<li>{escape(line[0].upper() + line[1:])}.</li>" for line in lines) + "</ul>"


def _html(table: Table) -> str:
    return str(table._repr_html_())
