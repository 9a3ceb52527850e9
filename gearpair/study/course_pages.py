"""The course on paper: a sheet for every student, and what is right for the one who marks them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from html import escape
from pathlib import Path
from typing import Any

import nbformat
import numpy as np
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin

from gearpair import teaching
from gearpair.plotting.formulas import formula_svg

STYLE = """
body { font: 11pt/1.45 Georgia, serif; max-width: 44em; margin: 2em auto; padding: 0 1em; color: #111; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 1.6em; break-after: avoid; }
table { border-collapse: collapse; margin: .8em 0; width: 100%; }
th, td { border: 1px solid #888; padding: .25em .5em; text-align: left; }
td.answer { width: 45%; height: 1.6em; } .lines { height: 8em; border: 1px solid #888; margin: .6em 0; }
code { font-size: .9em; } .right { font-variant-numeric: tabular-nums; } section { break-inside: avoid; }
@media print { body { margin: 0; max-width: none; } }
"""
OF_NOTEBOOKS = "The cells after each question"  # how a sentence begins that paper has no use for
RULES = (
    "What counts as right, by id, with the marks of each answer in brackets. A right number off by a power of ten (a "
    "wrong unit) earns half. What follows from a student's own earlier answer counts as right: that is for you to see. "
    "Of a curve, x: y at five places."
)
WORDS_A_MINUTE, MINUTES_A_LINE, MINUTES_A_MARK = 100, 4, 5


def sheet(source: Path, student_id: str) -> str:
    """The page that one student gets: their own numbers, the questions, and room for the answers."""
    cells = nbformat.read(source, as_version=4).cells
    told = [part for part in cells[0].source.split("\n\n") if not part.startswith(OF_NOTEBOOKS)]
    head = [markdown("\n\n".join(told)), f"<p><b>Student:</b> {escape(student_id)}</p>"]
    own = own_numbers(setup_of(source), student_id)
    numbers = "".join(_row([escape(name), f"{value:.6g}"]) for name, value in own.items())
    parts = [*head, f"<h2>Your numbers</h2><table>{numbers}</table>"]
    for question in questions_of(source, student_id):
        rows = "".join(_row([f"<code>{escape(item.name)}</code>", ""], answer=True) for item in _asked(question))
        rest = [item for item in question.items if item not in _asked(question)]
        figure = "<p><i>Hand in the figure with this sheet.</i></p>" if rest else ""
        room = f"<table>{rows}</table>" if rows else "" if figure else '<div class="lines"></div>'
        parts.append(f"<section>{markdown(question.text)}{room}{figure}</section>")
    return page(f"{source.stem}: {student_id}", parts)


def marking_sheet(source: Path, students: Sequence[str]) -> str:
    """The page for who marks: the right numbers of every student with what counts as right, and the rubrics."""
    answers = {student: questions_of(source, student) for student in students}
    first = next(iter(answers.values()))
    parts = [f"<h1>Marking: {escape(source.stem)}</h1>", f"<p>{RULES}</p>"]
    for k, question in enumerate(first):
        heading, _, rest = question.text.partition("\n\n")
        if heading.startswith("#"):
            shown = markdown(heading.lstrip("# "), inline=True)
            parts.append(f"<h2>{shown} <small>({question.points:g} marks)</small></h2>")
        if question.rubric:
            parts += [markdown(rest if heading.startswith("#") else question.text), markdown(question.rubric)]
            continue
        head = _row([f"{escape(item.name)} ({item.marks:g})" for item in question.items], head="id")
        rows = [_row([right(item) for item in own[k].items], head=escape(student)) for student, own in answers.items()]
        parts.append(f"<table class='right'>{head}{''.join(rows)}</table>")
    return page(f"Marking: {source.stem}", parts)


def right(item: teaching.Item) -> str:
    """What is right, and how near counts: a range for a number; words for the rest."""
    if callable(item.truth):
        return values(item)
    if item.truth is None:
        return "both axes labelled"
    if not item.within:
        return escape(str(item.truth))
    off = tolerance(item)
    half = f"; half: ± {_short(tolerance(item, item.nearly))}" if item.nearly else ""
    return f"{float(item.truth):.6g} ± {_short(off)}{half}"


def _short(number: float) -> str:
    """Two digits, and no power of ten where it can be without."""
    return f"{float(f'{number:.2g}'):g}"


def values(item: teaching.Item) -> str:
    """A curve at five places of its range, to compare a drawn one with."""
    low, high = item.over or (0.0, 1.0)
    at = np.linspace(low, high, 11)[1::2]
    found = np.asarray(item.truth(at), dtype=float)
    return "<br>".join(f"{x:.4g}: {y:.4g}" for x, y in zip(at, found, strict=True))


def questions_of(source: Path, student_id: str) -> list[teaching.Question]:
    """The questions of an assignment for one student, computed once for all pages and files."""
    return _questions(source, student_id, source.stat().st_mtime_ns)


@lru_cache(maxsize=4096)
def _questions(source: Path, student_id: str, _changed: int) -> list[teaching.Question]:
    return teaching.questions(source, student_id)


def tolerance(item: teaching.Item, within: float | None = None) -> float:
    """How far from the truth a number may be."""
    return (item.within if within is None else within) * (abs(float(item.truth)) or 1.0)


def own_numbers(setup: str, student_id: str) -> Mapping[str, float]:
    """The numbers of one student that an assignment starts from, by the calls in its first cell."""
    found: dict[str, Any] = {}
    if "personal_pair" in setup:
        pair = teaching.personal_pair(student_id)
        found |= _numbers(pair, "pinion_teeth", "gear_teeth", "module_mm", "pressure_angle_deg", "face_width_mm")
        found |= {"centre_distance_mm": pair.centre_distance_mm}
        for who, wheel in (("pinion", pair.pinion), ("gear", pair.gear)):
            found |= {f"{who}.{name}": getattr(wheel, name) for name in ("tip_circle_mm", "base_radius_mm")}
    drive = teaching.personal_drive(student_id) if "personal_drive" in setup else None
    if "personal_rig" in setup:
        rig = teaching.personal_rig(student_id)
        drive = rig.drive
        found |= _numbers(rig, "jump_up_rpm", "jump_down_rpm")
    if drive is not None:
        found |= {k: v for k, v in vars(drive).items() if isinstance(v, int | float) and not isinstance(v, bool)}
    if "personal_oscillator" in setup:
        osc = teaching.personal_oscillator(student_id)
        found |= _numbers(osc, "mean_force", "error_amplitude", "damping_ratio")
        found |= {"contact_ratio": osc.stiffness.rectangle.contact_ratio} if osc.stiffness.rectangle else {}
        found |= {"a": osc.stiffness.rectangle.a, "b": osc.stiffness.rectangle.b} if osc.stiffness.rectangle else {}
    return {name: float(value) for name, value in found.items()}


def setup_of(source: Path) -> str:
    """The cell of an assignment in which the personal numbers are made."""
    return next(str(cell.source) for cell in nbformat.read(source, as_version=4).cells if cell.id == "setup")


def expected_minutes(source: Path) -> float:
    """How long an assignment takes, estimated from the steps of the reference student; nobody has measured it.

    A hundred words a minute to read, four minutes for each line of the reference's code, five for each written mark.
    """
    cells = nbformat.read(source, as_version=4).cells
    words = sum(len(cell.source.split()) for cell in cells if cell.cell_type == "markdown" and not _settings(cell))
    code = [
        line
        for cell in cells
        if cell.cell_type == "code" and _settings(cell).get("solution")
        for line in solution(cell.source)
    ]
    written = sum(_settings(cell).get("points", 0) for cell in cells if cell.cell_type == "markdown")
    return float(words / WORDS_A_MINUTE + MINUTES_A_LINE * len(code) + MINUTES_A_MARK * written)


def solution(code: str) -> list[str]:
    """The lines of a reference answer."""
    inside = code.partition("### BEGIN SOLUTION\n")[2].partition("### END SOLUTION")[0]
    return [line for line in inside.splitlines() if line.strip()]


def markdown(text: str, *, inline: bool = False) -> str:
    """Markdown with formulas as HTML that needs no script."""
    reader = MarkdownIt("commonmark").enable("table").use(dollarmath_plugin, renderer=_formula)
    return str(reader.renderInline(text) if inline else reader.render(text))


def page(title: str, parts: Sequence[str]) -> str:
    """A whole page."""
    head = f"<meta charset='utf-8'><title>{escape(title)}</title><style>{STYLE}</style>"
    return f"<!doctype html><html lang='en'><head>{head}</head><body>{''.join(parts)}</body></html>\n"


def _formula(latex: str, options: Mapping[str, Any]) -> str:
    one_line = " ".join(latex.split())
    return formula_svg(one_line) or f"<code>{escape(one_line)}</code>"


def _asked(question: teaching.Question) -> list[teaching.Item]:
    """What is answered on the sheet itself: all but what a figure shows."""
    return [item for item in question.items if item.truth is not None and not callable(item.truth)]


def _numbers(of: object, *names: str) -> dict[str, Any]:
    return {name: getattr(of, name) for name in names}


def _row(cells: Sequence[str], *, head: str = "", answer: bool = False) -> str:
    first = f"<th>{head}</th>" if head else ""
    return f"<tr>{first}{''.join(f'<td class=answer>{c}</td>' if answer else f'<td>{c}</td>' for c in cells)}</tr>"


def _settings(cell: Any) -> dict[str, Any]:
    return dict(cell.metadata.get("nbgrader", {}))
