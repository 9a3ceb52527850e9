"""Submissions that do not end by themselves, and one that ends its kernel."""

from tests.teach.answers import FULL

NAME = "stiffness"
# they sleep, so that what runs beside this test has the processor
LOOP = "import time\nwhile True:\n    time.sleep(0.01)"
DEAF = "import time\nwhile True:\n    try:\n        time.sleep(10)\n    except BaseException:\n        pass"
# Marks that are left, and what is written behind an answer: the first is stopped and goes on with the next cell, the
# second is stopped with its kernel before any answer was asked for, the third ends its kernel after the first question.
ENDLESS = {
    "endless": (FULL, ("mesh-stiffness", "### END SOLUTION", LOOP)),
    "deaf": (0.0, ("contact-ratio", "### END SOLUTION", DEAF)),
    "dying": (3.0, ("mesh-stiffness", "### END SOLUTION", "import os\nos._exit(0)")),
}


def test_what_does_not_end_is_stopped_and_graded(courses):
    course = courses("endless", NAME)
    for student, (_, edit) in ENDLESS.items():
        course.submit(NAME, student, course.solution(NAME, student, edit))
    log = course.nbgrader("autograde", NAME, "--GradeApart.timeout=12")
    assert course.marks(NAME) == {student: marks for student, (marks, _) in ENDLESS.items()}
    told = [line for line in log.splitlines() if "WARNING" in line or "ERROR" in line]
    assert {student for student in ENDLESS if any(f"{student}: " in line for line in told)} == set(ENDLESS)
