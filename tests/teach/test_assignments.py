"""Every assignment from its release to its marks: the reference, nothing at all, and typical mistakes."""

import pytest

from tests.teach.answers import FULL, NAMES, WRITTEN, WRONG
from tests.teach.conftest import identified

pytestmark = pytest.mark.parametrize("name", NAMES)


@pytest.fixture
def course(courses, name):
    return courses(name, name)


@pytest.fixture
def graded(course, name):
    """The course after one run of autograde: the reference, the release as it is, and one mistake."""
    if not (course.root / "submitted").exists():
        course.submit(name, "ada", course.solution(name, "ada"))
        course.submit(name, "untouched", course.released(name))
        mistake, (_, edits) = next(iter(WRONG[name].items()))
        course.submit(name, mistake, course.solution(name, mistake, *edits))
        course.nbgrader("autograde", name)
    return course


def test_a_release_holds_no_solution_and_no_hidden_test(course, name):
    text = (course.root / "release" / name / f"{name}.ipynb").read_text(encoding="utf-8")
    assert "SOLUTION" not in text and "HIDDEN" not in text
    answers = hidden_lines(course.source(name), "SOLUTION") | hidden_lines(course.source(name), "HIDDEN TESTS")
    assert len(answers) > 20
    released = {line.strip() for cell in course.released(name).cells for line in cell.source.splitlines()}
    assert not answers & released
    written = {cell.source for cell in course.source(name).cells if manual(cell)}
    assert len(written) == 2 and not written & {cell.source for cell in course.released(name).cells}
    assert not any(cell.get("outputs") for cell in course.released(name).cells)


def test_marks_add_up_to_twenty(course, name):
    cells = [cell for cell in course.source(name).cells if cell.metadata.get("nbgrader", {}).get("grade")]
    assert sum(cell.metadata.nbgrader.points for cell in cells if not manual(cell)) == FULL
    assert sum(cell.metadata.nbgrader.points for cell in cells if manual(cell)) == WRITTEN


def test_nbgrader_gives_the_reference_full_marks_the_release_none_and_a_mistake_its_marks(graded, name):
    mistake, (marks, _) = next(iter(WRONG[name].items()))
    assert graded.marks(name) == {"ada": FULL, "untouched": 0.0, mistake: marks}


def test_typical_mistakes_have_the_stated_marks(course, name):
    """All of them, without a kernel for each; the first has gone through nbgrader as well."""
    assert len(WRONG[name]) >= 3
    found = {
        mistake: course.marks_here(name, mistake, course.solution(name, mistake, *edits))
        for mistake, (_, edits) in WRONG[name].items()
    }
    assert found == {mistake: marks for mistake, (marks, _) in WRONG[name].items()}


def test_the_id_alone_is_worth_nothing(course, name):
    assert course.marks_here(name, "ada", identified(course.released(name), "ada")) == 0.0


def test_the_numbers_of_another_student_are_worth_little(course, name):
    """What does not depend on the id, and near misses."""
    assert course.marks_here(name, "copycat", course.solution(name, "ada")) <= FULL / 2


def manual(cell):
    settings = cell.metadata.get("nbgrader", {})
    return bool(settings.get("grade") and settings.get("solution"))


def hidden_lines(notebook, kind):
    """The lines between the marks, but for those that say nothing by themselves."""
    found, inside = set(), False
    for cell in notebook.cells:
        for line in cell.source.splitlines():
            if line.startswith("###"):
                inside = line == f"### BEGIN {kind}"
            elif inside and len(line.strip()) > 8:
                found.add(line.strip())
    return found
