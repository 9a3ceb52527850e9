"""Submissions that would rather change the marks than the answers."""

import nbformat
import pytest
from nbformat.v4 import new_code_cell

from tests.teach.answers import FULL, WRONG

NAME = "stiffness"
HONEST, _, MISTAKE = WRONG[NAME]["circular_pitch"]
# What a grader might lean on, replaced after the student's honest first answers; the other answers stay what they are.
PATCHES = """
import builtins, gearpair.teaching
from gearpair.teaching.marks import Marks
class Same(float):
    __eq__ = __le__ = __ge__ = __lt__ = lambda *_: True
    __hash__ = float.__hash__
    __sub__ = __rsub__ = lambda *_: 0.0
Marks.number = Marks.same = Marks.curve = lambda self, *_, marks=1, **__: setattr(self, "total", self.total + 99)
Marks.__repr__ = lambda self: "99"
gearpair.teaching.personal_pair = lambda *_: pair
contact_ratio = Same(contact_ratio)
marks = 99
builtins.print = lambda *_, **__: None
student_id = "ada"
"""


@pytest.fixture(scope="module")
def tampered(courses):
    """A course in which students with one honest mistake try to hide it."""
    course = courses("tampered", NAME)

    def submit(student, change):
        notebook = course.solution(NAME, student, *MISTAKE)
        change(notebook)
        course.submit(NAME, student, notebook)

    submit("honest", lambda notebook: None)
    for change in (
        edits_a_test,
        raises_the_points,
        deletes_a_test,
        patches_the_library,
        brings_a_test,
        moves_the_tests,
    ):
        submit(change.__name__, change)
    course.submit(NAME, "copycat", course.solution(NAME, "ada"))
    course.submit(NAME, "zoé müller", course.solution(NAME, "zoé müller"))
    for student in ("cut-off", "renamed", "forgot", "nothing"):
        course.submit(NAME, student, course.released(NAME))
    path = course.root / "submitted"
    (path / "cut-off" / NAME / f"{NAME}.ipynb").write_text('{"cells": [')
    (path / "renamed" / NAME / f"{NAME}.ipynb").rename(path / "renamed" / NAME / f"{NAME} (1).ipynb")
    (path / "nothing" / NAME / f"{NAME}.ipynb").unlink()
    # nbgrader refuses a cell that it did not hand out, and says so
    course.log = course.nbgrader("autograde", NAME, fails=True)
    return course


def cell_of(notebook, cell_id):
    return next(cell for cell in notebook.cells if cell.id == cell_id)


def edits_a_test(notebook):
    cell_of(notebook, "test-contact-ratio").source = "3"


def raises_the_points(notebook):
    cell_of(notebook, "test-picture").metadata.nbgrader["points"] = 1000


def deletes_a_test(notebook):
    notebook.cells.remove(cell_of(notebook, "test-contact-ratio"))


def patches_the_library(notebook):
    notebook.cells.insert(notebook.cells.index(cell_of(notebook, "contact-ratio")) + 1, new_code_cell(PATCHES))


def brings_a_test(notebook):
    """A cell that says it is a test: run as the student's own code, and worth nothing."""
    settings = {"grade": True, "solution": False, "locked": True, "task": False, "points": 50, "schema_version": 3}
    cell = new_code_cell("open('brought', 'w').write(str('GradeApart' in dir()))\n50")
    cell.metadata = nbformat.from_dict({"nbgrader": {**settings, "grade_id": "mine", "cell_type": "code"}})
    notebook.cells.append(cell)


def moves_the_tests(notebook):
    """Before the answers, where there is nothing to be marked: worth less, and an error for nobody."""
    tests = [cell for cell in notebook.cells if cell.id.startswith("test-")]
    notebook.cells = tests + [cell for cell in notebook.cells if cell not in tests]


@pytest.mark.parametrize("student", ["edits_a_test", "raises_the_points", "deletes_a_test", "patches_the_library"])
def test_an_attack_leaves_the_marks_that_the_answers_are_worth(tampered, student):
    assert tampered.marks(NAME)["honest"] == HONEST
    assert tampered.marks(NAME)[student] == HONEST


@pytest.mark.parametrize("student", ["brings_a_test", "moves_the_tests"])
def test_an_attack_that_spoils_the_submission_is_no_gain(tampered, student):
    assert tampered.marks(NAME).get(student, 0.0) <= HONEST


def test_the_id_of_somebody_else_is_told(tampered):
    assert tampered.marks(NAME)["copycat"] <= FULL / 2
    for student in ("copycat", "patches_the_library"):
        assert tampered.log.count(f"the notebook of {student} was worked on with the id 'ada'") == 1


def test_a_folder_that_cannot_be_an_id_is_refused_in_a_sentence(tampered):
    (line,) = (line for line in tampered.log.splitlines() if "zoé müller is not graded" in line)
    assert "give the folder another name: student_id must be your own id (2 to 64 letters" in line
    assert not (tampered.root / "autograded" / "zoé müller" / NAME).exists()


def test_the_log_has_no_warning_of_an_honest_submission(tampered):
    parts = tampered.log.split("[AutogradeApp | INFO] Converting notebook ")
    honest = [part for part in parts[1:] if "/honest/" in part.splitlines()[0]]
    assert len(honest) == 2 and not [part for part in honest if "warning" in part.lower()]


@pytest.mark.parametrize(
    ("student", "sentence"),
    [
        ("cut-off", "cut-off: the file is no notebook, but broken or empty: ask for it again"),
        ("renamed", "renamed: 'stiffness (1).ipynb' is not read"),
        ("renamed", "renamed: no file has the assignment's name"),
        ("forgot", "forgot: no id stands in the first code cell"),
        ("nothing", "nothing: the folder holds no notebook"),
        ("deletes_a_test", "deletes_a_test: Missing grade cell test-contact-ratio"),
    ],
)
def test_what_a_teacher_should_see_names_the_student(tampered, student, sentence):
    assert sentence in tampered.log
    assert "Traceback" not in tampered.log
