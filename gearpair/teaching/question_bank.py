"""The questions of an assignment with what is right for one student: what grading, sheets and question files share."""

import ast
import builtins
import contextlib
import io
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from gearpair.teaching import marks as marking
from gearpair.teaching.marks import Item

GIVEN = ("np", "gp", "teaching", "student_id")  # what a test has beside the answers


@dataclass(frozen=True, eq=False)
class Question:
    """One question of an assignment for one student.

    Attributes
    ----------
    text : str
        In Markdown, as the notebook has it.
    items : tuple of Item
        What is asked for, and what is right; empty where the answer is written.
    points : float
        The marks that it earns at most.
    rubric : str
        Of a written answer: a reference, and what earns full, half and no marks.
    """

    text: str
    items: tuple[Item, ...]
    points: float
    rubric: str = ""


def answers_wanted(tests: Iterable[str]) -> list[str]:
    """The variables that tests take from the student: those they read, are not given and no test defines.

    Examples
    --------
    >>> answers_wanted(["truth = 2 * np.pi\\nmarks.number('a', a, truth)", "marks = b"])
    ['a', 'b']
    """
    nodes = [node for test in tests for node in ast.walk(ast.parse(test))]
    names = [node for node in nodes if isinstance(node, ast.Name)]
    set_here = {node.id for node in names if not isinstance(node.ctx, ast.Load)}
    set_here |= {node.arg for node in nodes if isinstance(node, ast.arg)} | set(GIVEN)
    set_here |= {node.name for node in nodes if isinstance(node, ast.FunctionDef)}
    read = {node.id for node in names if isinstance(node.ctx, ast.Load)}
    return sorted(name for name in read - set_here if not hasattr(builtins, name))


def given_to_tests(student_id: str) -> dict[str, Any]:
    """What a test has beside the answers, by name.

    Examples
    --------
    >>> sorted(given_to_tests("ada"))
    ['gp', 'np', 'student_id', 'teaching']
    """
    import gearpair as gp
    from gearpair import teaching

    return dict(zip(GIVEN, (np, gp, teaching, student_id), strict=True))


def questions(source: str | Path | io.StringIO, student_id: str) -> list[Question]:
    """The questions of an assignment with the answers that are right for one student, by its own tests.

    Parameters
    ----------
    source : str, Path or file open for reading
        The teacher's notebook, with the hidden tests. Its tests are run, nothing else.
    student_id : str
        One that `check_student_id` takes.

    Returns
    -------
    list of Question
        In the order of the notebook.

    Examples
    --------
    >>> from nbformat import v4
    >>> test = "marks = teaching.Marks()\\nmarks.number('teeth', teeth, 27, within=0.1)"
    >>> graded = {"nbgrader": {"grade": True, "points": 1}}
    >>> cells = [v4.new_markdown_cell("## 1 Teeth"), v4.new_code_cell(test, metadata=graded)]
    >>> path = io.StringIO(v4.writes(v4.new_notebook(cells=cells)))
    >>> [(question.text, question.items[0].truth) for question in questions(path, "ada")]
    [('## 1 Teeth', 27)]
    """
    import nbformat  # takes longer to import than all of gearpair, and a student's notebook needs none of it

    cells = nbformat.read(source, as_version=4).cells
    tests = {cell.id: cell.source for cell in cells if _settings(cell).get("grade") and cell.cell_type == "code"}
    made: list[marking.Marks] = []

    def recorded() -> marking.Marks:
        made.append(marking.Marks())
        return made[-1]

    always = given_to_tests(student_id)
    always["teaching"] = SimpleNamespace(**{**vars(always["teaching"]), "Marks": recorded})
    variables: dict[str, Any] = dict.fromkeys(answers_wanted(tests.values())) | always
    found: list[Question] = []
    text: list[str] = []
    for cell in cells:
        settings = _settings(cell)
        if settings.get("grade") and cell.cell_type == "code":
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(cell.source, cell.id, "exec"), variables)
            found.append(Question("\n\n".join(text), tuple(made[-1].items), float(settings["points"])))
            text = []
        elif settings.get("grade"):
            found.append(Question("\n\n".join(text), (), float(settings["points"]), cell.source))
            text = []
        elif cell.cell_type == "markdown":
            text = [cell.source] if cell.source.startswith("## ") else [*text, cell.source]
    return found


def _settings(cell: Any) -> dict[str, Any]:
    return dict(cell.metadata.get("nbgrader", {}))
