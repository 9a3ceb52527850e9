"""The course's questions for other systems: Moodle's question file, and a CSV of what is right."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree as Xml

from gearpair import teaching
from gearpair.study.course_pages import markdown, own_numbers, questions_of, setup_of, tolerance


def moodle_xml(sources: Sequence[Path], students: Sequence[str]) -> str:
    """A question file of Moodle: a category for each assignment and student, a question for each answer.

    Numbers are numerical questions with their tolerance, and half of the grade for what is nearly right; words and
    truth values short answers; written answers and figures essays.
    """
    quiz = Xml.Element("quiz")
    for source in sources:
        for student in students:
            category = Xml.SubElement(quiz, "question", type="category")
            _text(category, "category", f"$course$/top/gearpair/{source.stem}/{student}")
            for number, question in enumerate(questions_of(source, student), start=1):
                own = own_numbers(setup_of(source), student)
                given = "".join(f"<li>{name}: {value:.6g}</li>" for name, value in own.items())
                body = f"<ul>{given}</ul>{markdown(question.text)}"
                if question.rubric:
                    _essay(quiz, f"{number:02} written", body, question.points, question.rubric)
                for item in question.items:
                    _question(quiz, f"{number:02} {item.name}", f"{body}<p>Give <code>{item.name}</code>.</p>", item)
    Xml.indent(quiz)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + Xml.tostring(quiz, encoding="unicode") + "\n"


def answers_csv(sources: Sequence[Path], students: Sequence[str]) -> str:
    """What is right, a line for each answer: assignment, id, question, answer, right, tolerance, marks."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["assignment", "id", "question", "answer", "right", "tolerance", "marks"])
    for source in sources:
        for student in students:
            for number, question in enumerate(questions_of(source, student), start=1):
                for item in question.items:
                    truth = "figure" if item.truth is None or callable(item.truth) else item.truth
                    is_number = bool(item.within) and truth != "figure"
                    shown = f"{float(item.truth):.9g}" if is_number else str(truth)
                    off = f"{tolerance(item):.3g}" if is_number else ""
                    writer.writerow([source.stem, student, number, item.name, shown, off, f"{item.marks:g}"])
    return out.getvalue()


def _question(quiz: Xml.Element, name: str, body: str, item: teaching.Item) -> None:
    if item.truth is None or callable(item.truth):
        _essay(quiz, name, body, item.marks, "Compare with the marking sheet.")
        return
    numerical = bool(item.within) or (isinstance(item.truth, int) and not isinstance(item.truth, bool))
    question = _headed(quiz, "numerical" if numerical else "shortanswer", name, body, item.marks)
    _answer(question, item.truth, 100, tolerance(item) if numerical else None)
    if numerical and item.nearly > item.within:
        _answer(question, item.truth, 50, tolerance(item, item.nearly))


def _headed(quiz: Xml.Element, kind: str, name: str, body: str, marks: float) -> Xml.Element:
    question = Xml.SubElement(quiz, "question", type=kind)
    _text(question, "name", name)
    _text(question, "questiontext", body, format="html")
    Xml.SubElement(question, "defaultgrade").text = f"{marks:g}"
    return question


def _answer(question: Xml.Element, truth: object, fraction: int, off: float | None) -> None:
    shown = repr(float(truth)) if off is not None and isinstance(truth, int | float) else str(truth)
    answer = Xml.SubElement(question, "answer", fraction=str(fraction), format="plain_text")
    Xml.SubElement(answer, "text").text = shown
    if off is not None:
        Xml.SubElement(answer, "tolerance").text = f"{off:.6g}"


def _essay(quiz: Xml.Element, name: str, body: str, marks: float, rubric: str) -> None:
    question = _headed(quiz, "essay", name, body, marks)
    _text(question, "graderinfo", markdown(rubric), format="html")


def _text(parent: Xml.Element, tag: str, text: str, **attributes: str) -> None:
    Xml.SubElement(Xml.SubElement(parent, tag, attributes), "text").text = text
