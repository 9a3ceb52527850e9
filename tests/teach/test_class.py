"""A class of forty in one run of autograde, each with a gear pair of its own."""

import csv
import time

from gearpair import teaching
from tests.teach.conftest import MARKS, MOST
from tests.teach.conftest import SHORT as NAME

CLASS = [f"student{number:02}" for number in range(40)]


def test_a_class_of_forty_is_graded_in_one_run_and_its_marks_go_to_a_spreadsheet(short_course, record_property):
    course = short_course
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
    assert rows == dict.fromkeys(CLASS, (MARKS, MOST))


def test_students_can_validate_before_they_submit(short_course):
    """`nbgrader validate` exits 0 whatever it finds, so its text is read."""
    course = short_course
    said = course.nbgrader("validate", f"release/{NAME}/{NAME}.ipynb")
    assert "VALIDATION FAILED ON 2 CELL(S)" in said and "You did not provide a response." in said
    course.submit(NAME, "ada", course.solution(NAME, "ada"))
    said = course.nbgrader("validate", f"submitted/ada/{NAME}/{NAME}.ipynb")
    assert "Success! Your notebook passes all the tests." in said
