"""What the tests of the course share: a course directory of their own, and nbgrader as a teacher calls it."""

import contextlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import nbformat
import pytest

pytest.importorskip("nbgrader", reason="the teach extra is not installed: make teach")

from nbgrader.api import Gradebook
from nbgrader.utils import determine_grade
from xdist.scheduler import LoadScopeScheduling

import gearpair as gp
from gearpair import teaching
from tests.teach.answers import NAMES

# what takes seconds is computed once for all graded examples that ask for the same
REMEMBERED = ("identify", "run_up", "speed_chart")

# what `short_course` keeps of an assignment, and the marks by tests and in all that are left
SHORT = "stiffness"
QUESTIONS = ("your-id", "setup", "text-03", "contact-ratio", "test-contact-ratio", "why-stiffest")
MARKS, MOST = 3.0, 5.0

ASSIGNMENTS = Path(__file__).parents[2] / "notebooks" / "assignments"
sys.path.insert(0, str(ASSIGNMENTS))

from grading_apart import run_tests  # noqa: E402

MADE = ("release", "submitted", "autograded", "feedback", "gradebook.db", "*.csv", "__pycache__", ".ipynb_checkpoints")


class Course:
    """A copy of the course, and what a teacher does with it."""

    def __init__(self, root: Path) -> None:
        self.root = root
        shutil.copytree(ASSIGNMENTS, root, ignore=shutil.ignore_patterns(*MADE))

    def nbgrader(self, *arguments: str, fails: bool = False) -> str:
        """Everything that the command printed; it needs the environment's programs on PATH."""
        environment = {**os.environ, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
        environment["JUPYTER_PLATFORM_DIRS"] = "1"
        done = subprocess.run(
            ["nbgrader", *arguments],
            cwd=self.root,
            env=environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        assert (done.returncode != 0) == fails, done.stdout
        return done.stdout

    def shorten(self, name: str, cells: tuple[str, ...]) -> None:
        """Leave the cells with these names in the source, and no other."""
        source = self.source(name)
        source.cells = [cell for cell in source.cells if cell.id in cells]
        nbformat.write(source, self.root / "source" / name / f"{name}.ipynb")

    def release(self, name: str) -> None:
        self.nbgrader("generate_assignment", name)

    def source(self, name: str) -> nbformat.NotebookNode:
        return nbformat.read(self.root / "source" / name / f"{name}.ipynb", as_version=4)

    def released(self, name: str) -> nbformat.NotebookNode:
        return nbformat.read(self.root / "release" / name / f"{name}.ipynb", as_version=4)

    def solution(self, name: str, student: str, *edits: tuple[str, str, str]) -> nbformat.NotebookNode:
        """The release with the source's answers in it, some of them edited: (cell, what, by what)."""
        answers = {cell.id: cell.source for cell in self.source(name).cells}
        for cell_id, old, new in edits:
            assert old in answers[cell_id], f"{cell_id} of {name} has no {old!r}"
            answers[cell_id] = answers[cell_id].replace(old, new)
        notebook = self.released(name)
        for cell in notebook.cells:
            if cell.metadata.get("nbgrader", {}).get("solution"):
                cell.source = answers[cell.id]
        return identified(notebook, student)

    def graded_here(self, name: str, student: str, notebook: nbformat.NotebookNode) -> tuple[float, str]:
        """Marks and sentences for a notebook of ours, run in this process: what is left out is kernel and nbgrader."""
        graded = {cell.id: cell for cell in self.source(name).cells if _settings(cell, "grade", "locked")}
        tests = {cell_id: cell.source for cell_id, cell in graded.items()}
        wanted, variables, answers = teaching.answers_wanted(tests.values()), {}, {}
        for cell in notebook.cells:
            if cell.id in tests:
                answers[cell.id] = teaching.read_report(teaching.report(wanted, variables))
                answers[cell.id] = {each: answers[cell.id].get(each) for each in wanted}
            elif cell.cell_type == "code":
                with contextlib.suppress(Exception):  # as in a kernel, the next cell runs all the same
                    exec(cell.source, variables)
        plt.close("all")
        said = []
        for cell_id, outputs in run_tests(tests, answers, student):
            graded[cell_id].outputs = outputs
            said += [output.text for output in outputs if output.output_type == "stream"]
            said += [f"{cell_id}: {output.evalue}" for output in outputs if output.output_type == "error"]
        return sum(determine_grade(cell)[0] for cell in graded.values()), "".join(said)

    def marks_here(self, name: str, student: str, notebook: nbformat.NotebookNode) -> float:
        """The marks alone."""
        return self.graded_here(name, student, notebook)[0]

    def submit(self, name: str, student: str, notebook: nbformat.NotebookNode) -> None:
        path = self.root / "submitted" / student / name / f"{name}.ipynb"
        path.parent.mkdir(parents=True)
        nbformat.write(notebook, path)

    def marks(self, name: str) -> dict[str, float]:
        """The sum of each student's marks by tests."""
        with Gradebook(f"sqlite:///{self.root / 'gradebook.db'}") as gradebook:
            return {
                submission.student.id: sum(
                    grade.auto_score or 0.0 for notebook in submission.notebooks for grade in notebook.grades
                )
                for submission in gradebook.assignment_submissions(name)
            }


def _settings(cell: nbformat.NotebookNode, *names: str) -> bool:
    return all(cell.metadata.get("nbgrader", {}).get(name) for name in names)


def identified(notebook: nbformat.NotebookNode, student: str) -> nbformat.NotebookNode:
    """The notebook with an id written into its first code cell."""
    cell = next(cell for cell in notebook.cells if cell.id == "your-id")
    cell.source = cell.source.replace('student_id = ""', f'student_id = "{student}"')
    assert student in cell.source
    return notebook


def remembered(function: Callable[..., Any]) -> Callable[..., Any]:
    """The function, which computes nothing twice for arguments that read alike."""
    known: dict[str, Any] = {}

    def from_memory(*arguments: Any, **options: Any) -> Any:
        key = repr((arguments, sorted(options.items())))
        if key not in known:
            known[key] = function(*arguments, **options)
        return known[key]

    return from_memory


for _name in REMEMBERED:
    setattr(gp.design, _name, remembered(getattr(gp.design, _name)))


@pytest.fixture(scope="module")
def courses(tmp_path_factory):
    """One course directory an assignment: made, released and kept on first use; with some cells of it alone, or all."""
    made: dict[str, Course] = {}

    def course(key: str, name: str, cells: tuple[str, ...] = ()) -> Course:
        if key not in made:
            made[key] = Course(tmp_path_factory.mktemp("course") / key)
            if cells:
                made[key].shorten(name, cells)
            made[key].release(name)
        return made[key]

    return course


@pytest.fixture(scope="module")
def short_course(courses):
    """A course whose assignment is one question to compute and one to write about."""
    return courses("short", SHORT, QUESTIONS)


def pytest_collection_modifyitems(items):
    """What takes longest begins first, and beside it what mostly waits, on a third process for two cores."""
    order = ("class", "endless", "assignments", "hostile", "adopting", "kernels")
    items.sort(key=lambda item: order.index(item.path.stem.removeprefix("test_")))


class ByCourse(LoadScopeScheduling):
    """What shares a course stays on one process: a file, and of the assignments each for itself."""

    def _split_scope(self, nodeid: str) -> str:
        file, _, test = nodeid.partition("::")
        names = re.split(r"[][-]", test)
        return file + next((name for name in NAMES if file.endswith("test_assignments.py") and name in names), "")


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """The only one here: no ``--dist`` is asked for."""
    return ByCourse(config, log)


def pytest_terminal_summary(terminalreporter):
    """How long the timed runs took: told, never asserted."""
    for report in terminalreporter.getreports("passed"):
        for what, value in report.user_properties:
            terminalreporter.write_line(f"{what}: {value}")
