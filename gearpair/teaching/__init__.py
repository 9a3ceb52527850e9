"""What the course's assignments use: a gear pair for every student, and marks for what they answer.

Students import what is personal: `personal_pair`, `personal_oscillator`, `personal_drive`, `personal_rig` and
`personal_starts`. The tests of an assignment count with `Marks`; `questions` has the same tests say what is right. The
grader takes the answers out of a student's notebook by `report` and `read_report`: plain data, nothing that runs.
"""

from gearpair.teaching.answers import Unreadable, read_report, report
from gearpair.teaching.drawings import Curve, Drawing, drawing
from gearpair.teaching.marks import Item, Marks, as_number
from gearpair.teaching.personal import (
    RigReport,
    check_student_id,
    personal_drive,
    personal_oscillator,
    personal_pair,
    personal_rig,
    personal_starts,
    true_rig,
)
from gearpair.teaching.question_bank import Question, answers_wanted, given_to_tests, questions

__all__ = [
    "Curve",
    "Drawing",
    "Item",
    "Marks",
    "Question",
    "RigReport",
    "Unreadable",
    "answers_wanted",
    "as_number",
    "check_student_id",
    "drawing",
    "given_to_tests",
    "personal_drive",
    "personal_oscillator",
    "personal_pair",
    "personal_rig",
    "personal_starts",
    "questions",
    "read_report",
    "report",
    "true_rig",
]
