"""Every assignment from its release to its marks: the reference, nothing at all, and typical mistakes."""

import ast
import builtins
import re

import pytest

from tests.teach.answers import FULL, HONEST, NAMES, WRITTEN, WRONG
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
        mistake, (_, _, edits) = next(iter(WRONG[name].items()))
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
    mistake, (marks, _, _) = next(iter(WRONG[name].items()))
    assert graded.marks(name) == {"ada": FULL, "untouched": 0.0, mistake: marks}


def test_every_question_is_answered_with_nothing_but_the_released_notebook(course, name):
    """A reference answer reads what its own cell sets, and names that the release defines, and no other."""
    source = {cell.id: cell.source for cell in course.source(name).cells}
    known = set(dir(builtins))
    for cell in course.released(name).cells:
        if cell.cell_type != "code":
            continue
        released = stored(cell.source)
        if cell.metadata.get("nbgrader", {}).get("solution"):
            lacking = loaded(source[cell.id]) - stored(source[cell.id]) - known - released
            assert not lacking, f"{cell.id} of {name} uses {sorted(lacking)}, which the release does not define"
        known |= released


def test_no_question_speaks_of_a_name_that_only_the_solution_has(course, name):
    hidden = {each for cell in course.source(name).cells if answered(cell) for each in stored(cell.source)}
    known = {each for cell in course.released(name).cells if cell.cell_type == "code" for each in stored(cell.source)}
    text = "\n".join(cell.source for cell in course.released(name).cells if cell.cell_type == "markdown")
    spoken = set(re.findall(r"`([a-z_][a-z_0-9]*)`", text))
    assert not spoken & hidden - known


@pytest.mark.parametrize("student", ["ada", "grace", "emmy"])
def test_every_honest_way_earns_full_marks(course, name, student):
    assert len(HONEST[name]) >= 9
    ways = HONEST[name] if student == "ada" else list(HONEST[name])[:: 1 if name == "impacts" else 4]
    for way in ways:
        marks, said = course.graded_here(name, student, course.solution(name, student, *HONEST[name][way]))
        assert marks == FULL, f"{way}: {marks}\n{said}"


def test_typical_mistakes_have_the_stated_marks_and_a_hint(course, name):
    """All of them, without a kernel for each; the first has gone through nbgrader as well."""
    assert len(WRONG[name]) >= 10
    for mistake, (stated, hint, edits) in WRONG[name].items():
        marks, said = course.graded_here(name, "ada", course.solution(name, "ada", *edits))
        assert (marks, hint in said) == (stated, True), f"{mistake}: {marks}\n{said}"


def test_written_answers_come_with_a_rubric(course, name):
    for cell in filter(manual, course.source(name).cells):
        for word in ("**Full", "**Half", "**None:**"):
            assert word in cell.source, f"{cell.id} of {name}"


def test_the_id_alone_is_worth_nothing(course, name):
    assert course.marks_here(name, "ada", identified(course.released(name), "ada")) == 0.0


def test_the_numbers_of_another_student_are_worth_little(course, name):
    """What does not depend on the id, and near misses."""
    assert course.marks_here(name, "copycat", course.solution(name, "ada")) <= FULL / 2


def answered(cell):
    return cell.cell_type == "code" and cell.metadata.get("nbgrader", {}).get("solution")


def names_of(source, *contexts):
    return {
        node.id for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Name) and isinstance(node.ctx, contexts)
    }


def loaded(source):
    return names_of(source, ast.Load)


def stored(source):
    nodes = list(ast.walk(ast.parse(source)))
    imported = {
        (each.asname or each.name).split(".")[0]
        for node in nodes
        for each in getattr(node, "names", ())
        if isinstance(each, ast.alias)
    }
    return names_of(source, ast.Store) | imported


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
