"""Submissions that do not end, and submissions that would rather change the marks than the answers."""

import nbformat
import pytest
from nbformat.v4 import new_code_cell

from tests.teach.answers import FULL, WRONG

NAME = "stiffness"
HONEST, MISTAKE = WRONG[NAME]["circular_pitch"]
PATCHES = """
import builtins, sys, numpy, gearpair, gearpair.teaching
from gearpair.teaching.marks import Marks
class Same(float):
    __eq__ = __le__ = __ge__ = __lt__ = lambda *_: True
    __hash__ = float.__hash__
    __sub__ = __rsub__ = lambda *_: 0.0
Marks.number = Marks.same = Marks.curve = lambda self, *_, marks=1, **__: setattr(self, "total", self.total + 99)
Marks.__repr__ = lambda self: "99"
gearpair.mesh_stiffness = gearpair.teaching.personal_pair = lambda *_: Same(1)
gearpair.SpurPair.contact_ratio = Same(1)
builtins.abs = numpy.abs = lambda *_: 0.0
base_pitch_mm = Same(1)
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
    course.nbgrader("autograde", NAME, fails=True)  # nbgrader refuses a cell that it did not hand out, and says so
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
    notebook.cells.insert(3, new_code_cell(PATCHES))


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


@pytest.mark.parametrize("student", ["edits_a_test", "raises_the_points", "deletes_a_test"])
def test_a_changed_test_is_put_back(tampered, student):
    assert tampered.marks(NAME)["honest"] == HONEST
    assert tampered.marks(NAME)[student] == HONEST


@pytest.mark.parametrize("student", ["patches_the_library", "brings_a_test", "moves_the_tests"])
def test_nothing_in_the_students_kernel_moves_the_marks(tampered, student):
    assert tampered.marks(NAME).get(student, 0.0) <= HONEST


def test_what_does_not_end_is_stopped_and_the_rest_is_graded(courses):
    course = courses("endless", NAME)
    endless = ("mesh-stiffness", "### END SOLUTION", "while True:\n    pass")
    stubborn = (
        "contact-ratio",
        "### END SOLUTION",
        "while True:\n    try:\n        while True:\n            pass\n    except BaseException:\n        pass",
    )
    course.submit(NAME, "endless", course.solution(NAME, "endless", endless))
    course.submit(NAME, "stubborn", course.solution(NAME, "stubborn", stubborn))
    course.submit(NAME, "ada", course.solution(NAME, "ada"))
    course.nbgrader("autograde", NAME, "--GradeApart.timeout=20")
    marks = course.marks(NAME)
    assert marks["endless"] == FULL  # it was stopped after its answers were there, and went on
    assert marks["stubborn"] == 0.0  # nothing stops it but the end of its kernel
    assert marks["ada"] == FULL
