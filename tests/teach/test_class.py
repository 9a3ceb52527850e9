"""A class of forty in one run of autograde, each with a gear pair of its own."""

import time

from gearpair import teaching
from tests.teach.answers import FULL

NAME = "stiffness"
CLASS = [f"student{number:02}" for number in range(40)]


def test_a_class_of_forty_is_graded_in_one_run(courses, record_property):
    assert len({repr(teaching.personal_drive(student)) for student in CLASS}) == len(CLASS)
    course = courses("class", NAME)
    for student in CLASS:
        course.submit(NAME, student, course.solution(NAME, student))
    started = time.perf_counter()
    course.nbgrader("autograde", NAME)
    record_property("a class of forty, one assignment", f"{time.perf_counter() - started:.0f} s")
    assert course.marks(NAME) == dict.fromkeys(CLASS, FULL)


def test_students_can_validate_before_they_submit(courses):
    """`nbgrader validate` exits 0 whatever it finds, so its text is read."""
    course = courses("validate", NAME)
    release = f"release/{NAME}/{NAME}.ipynb"
    assert "VALIDATION FAILED ON 5 CELL(S)" in course.nbgrader("validate", release)
    course.submit(NAME, "ada", course.solution(NAME, "ada"))
    said = course.nbgrader("validate", f"submitted/ada/{NAME}/{NAME}.ipynb")
    assert "Success! Your notebook passes all the tests." in said
