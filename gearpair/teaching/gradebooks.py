"""The marks of a class out of nbgrader's gradebook: a line for each student, and who handed in nothing."""

import csv
import json
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path

from gearpair.teaching.classes import Student

NOT_HANDED_IN = "not handed in"
NOT_GRADED = "handed in, not graded"
ANEW = "handed in anew, not graded again"
WAITING = "written answers wait"
MARKED = "marked"
HANDED_IN = "handed_in"  # where a graded notebook has the digest of what was handed in


def write_marks(course: str | Path, students: Sequence[Student], output: str | Path) -> list[str]:
    """Write the marks of a class as CSV.

    Parameters
    ----------
    course : str or Path
        The course's directory, with its ``gradebook.db``.
    students : sequence of Student
        The class; who is in the gradebook and not in the class gets a line as well.
    output : str or Path
        For each assignment three columns: the marks, which are left empty where nothing was graded, the largest
        possible, and a state: marked, written answers wait, handed in but not graded, not handed in; or handed in anew
        and not graded again, where the marks are those of the notebook before.

    Returns
    -------
    list of str
        A sentence for each assignment: how many of each state.
    """
    try:
        from nbgrader.api import Gradebook
    except ImportError:
        raise ValueError("the marks are in nbgrader's gradebook, and nbgrader is not installed here") from None
    root = Path(course)
    if not (root / "gradebook.db").exists():
        raise ValueError(f"{root} has no gradebook.db: grade first, or run this in the course's directory")
    with Gradebook(f"sqlite:///{root / 'gradebook.db'}") as gradebook:
        assignments = [(each.name, float(each.max_score)) for each in gradebook.assignments]
        graded = {
            (submission.student.id, name): (float(submission.score), bool(submission.needs_manual_grade))
            for name, _ in assignments
            for submission in gradebook.assignment_submissions(name)
            if (root / "autograded" / submission.student.id / name / f"{name}.ipynb").exists()
        }
    strangers = sorted({who for who, _ in graded} - {each.student_id for each in students})
    rows: list[list[str]] = []
    states: dict[str, list[str]] = {name: [] for name, _ in assignments}
    for student in [*students, *map(Student, strangers)]:
        row: list[str] = [student.student_id, student.name]
        for name, most in assignments:
            score, waits = graded.get((student.student_id, name), (None, False))
            there = any((root / "submitted" / student.student_id / name).glob("*.ipynb"))
            if score is None:
                state = NOT_GRADED if there else NOT_HANDED_IN
            elif _handed_in_anew(root, student.student_id, name):
                state = ANEW
            else:
                state = WAITING if waits else MARKED
            states[name].append(state)
            row += ["" if score is None else f"{score:g}", f"{most:g}", state]
        rows.append(row)
    columns = [f"{name}{end}" for name, _ in assignments for end in ("", "_max", "_state")]
    with open(output, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([["id", "name", *columns], *rows])
    kinds = (MARKED, WAITING, ANEW, NOT_GRADED, NOT_HANDED_IN)
    counts = {name: [(seen.count(kind), kind) for kind in kinds if kind in seen] for name, seen in states.items()}
    return [f"{name}: {', '.join(f'{n} {kind}' for n, kind in each)}" for name, each in counts.items()]


def digest(notebook: Path) -> str:
    """Tells a notebook from another that was handed in in its place; the grader writes it into the graded one."""
    return sha256(notebook.read_bytes()).hexdigest()


def _handed_in_anew(root: Path, student: str, name: str) -> bool:
    """Whether the notebook that lies there is another than the graded one."""
    handed_in, graded = (root / each / student / name / f"{name}.ipynb" for each in ("submitted", "autograded"))
    known = json.loads(graded.read_text(encoding="utf-8"))["metadata"].get(HANDED_IN)
    return known is not None and handed_in.exists() and digest(handed_in) != known
