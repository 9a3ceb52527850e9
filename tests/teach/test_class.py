"""A class of forty in one run of autograde, each with a gear pair of its own."""

import csv
import time

import nbformat
import pytest

from gearpair import teaching

NAME = "stiffness"
CLASS = [f"student{number:02}" for number in range(40)]
QUESTIONS = ("your-id", "setup", "contact-ratio", "test-contact-ratio", "why-stiffest")
MARKS, WRITTEN = 3.0, 2.0


@pytest.fixture
def course(courses):
    """A course whose assignment is one question to compute and one to write about: forty notebooks take their time."""

    def shortened(course):
        source = course.source(NAME)
        source.cells = [cell for cell in source.cells if cell.id in QUESTIONS]
        nbformat.write(source, course.root / "source" / NAME / f"{NAME}.ipynb")

    return courses("class", NAME, shortened)


def test_a_class_of_forty_is_graded_in_one_run_and_its_marks_go_to_a_spreadsheet(course, record_property):
    assert len({repr(teaching.personal_drive(student)) for student in CLASS}) == len(CLASS)
    for student in CLASS:
        course.submit(NAME, student, course.solution(NAME, student))
    started = time.perf_counter()
    course.nbgrader("autograde", NAME)
    record_property("a class of forty, one question", f"{time.perf_counter() - started:.0f} s")
    assert course.marks(NAME) == dict.fromkeys(CLASS, MARKS)
    course.nbgrader("export")
    with open(course.root / "grades.csv", newline="", encoding="utf-8") as file:
        rows = {row["student_id"]: (float(row["score"]), float(row["max_score"])) for row in csv.DictReader(file)}
    assert rows == dict.fromkeys(CLASS, (MARKS, MARKS + WRITTEN))


def test_students_can_validate_before_they_submit(course):
    """`nbgrader validate` exits 0 whatever it finds, so its text is read."""
    said = course.nbgrader("validate", f"release/{NAME}/{NAME}.ipynb")
    assert "VALIDATION FAILED ON 2 CELL(S)" in said and "You did not provide a response." in said
    course.submit(NAME, "ada", course.solution(NAME, "ada"))
    said = course.nbgrader("validate", f"submitted/ada/{NAME}/{NAME}.ipynb")
    assert "Success! Your notebook passes all the tests." in said
