"""Notebooks out of the archive of a learning platform, each into the folder that the grader looks in."""

import json
import re
import zipfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from gearpair.teaching.classes import Student, letters

LARGEST = 50_000_000  # bytes of one notebook
# The path of a notebook in an archive, by platform. `who` is the student's name, or the id; `file` what was handed in.
PATTERNS = {
    # Ada Lovelace_1234567_assignsubmission_file_stiffness.ipynb, or a folder of that name with the file in it
    "moodle": r"(?:.*/)?(?P<who>[^/_]+)_\d+_assignsubmission_file_?/?(?P<file>[^/]+\.ipynb)",
    # lovelaceada_12345_67890_stiffness-1.ipynb, lovelaceada_LATE_12345_67890_stiffness.ipynb
    "canvas": r"(?:.*/)?(?P<who>[^/_]+)_(?:LATE_)?\d+_\d+_(?P<file>[^/]+\.ipynb)",
    # al15/stiffness/stiffness.ipynb, al15/stiffness.ipynb, al15_stiffness.ipynb
    "ids": r"(?:.*/)?(?P<who>(?!ASSIGNMENT/)[^/]+)(?:/ASSIGNMENT/|/|_)(?P<file>ASSIGNMENT[^/]*\.ipynb)",
}


@dataclass(frozen=True)
class Collected:
    """What an archive held: the ids whose notebook was in it, who has none there or from before, oddities in words."""

    written: tuple[str, ...]
    missing: tuple[str, ...]
    sentences: tuple[str, ...]


def collect(archive: str | Path, assignment: str, students: Sequence[Student], course: str | Path) -> Collected:
    """Write the notebooks of an archive to ``submitted/ID/ASSIGNMENT/ASSIGNMENT.ipynb`` of a course.

    One that is there already stays as it is, and another in its place is told of: the grader passes over what it has
    graded, unless it is told to grade it again.

    Parameters
    ----------
    archive : str or Path
        A ZIP file of Moodle, Canvas, or of folders named by id.
    assignment : str
        Its name, such as ``stiffness``.
    students : sequence of Student
        The class, as of `read_class`. A file belongs to the student whose name or id it carries; where two have one
        name, to the one whose id stands in the notebook.
    course : str or Path
        The course's directory.

    Returns
    -------
    Collected
    """
    try:
        with zipfile.ZipFile(archive) as opened:
            members = [each for each in opened.infolist() if not each.is_dir() and "__MACOSX" not in each.filename]
            found = {each.filename: opened.read(each) for each in members if each.file_size <= LARGEST}
    except (OSError, zipfile.BadZipFile) as error:
        raise ValueError(f"{archive} cannot be read as a ZIP file: {error}") from None
    sentences = [f"{each.filename} is too large to be a notebook" for each in members if each.file_size > LARGEST]
    written: dict[str, str] = {}
    for name in sorted(found):
        student, sentence = _owner(name, found[name], assignment, students)
        if student is None:
            sentences.append(sentence)
            continue
        if student in written:
            sentences.append(f"{student}: handed in twice, and {name} is taken instead of {written[student]}")
        written[student] = name
    for student, name in written.items():
        path = _place(course, student, assignment)
        if path.exists() and path.read_bytes() == found[name]:
            continue
        if path.exists():
            again = f"nbgrader autograde {assignment} --student={student} --force"
            sentences.append(f"{student}: handed in anew; if the earlier one was graded: {again}")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(found[name])
    missing = tuple(each.student_id for each in students if not _place(course, each.student_id, assignment).exists())
    return Collected(tuple(sorted(written)), missing, tuple(sentences))


def _place(course: str | Path, student: str, assignment: str) -> Path:
    return Path(course) / "submitted" / student / assignment / f"{assignment}.ipynb"


def matched(name: str, assignment: str) -> tuple[str, str, str] | None:
    """Platform, student and file of a path in an archive; None where no pattern knows it.

    Examples
    --------
    >>> matched("Ada Lovelace_1234567_assignsubmission_file_/stiffness (1).ipynb", "stiffness")
    ('moodle', 'Ada Lovelace', 'stiffness (1).ipynb')
    >>> matched("lovelaceada_LATE_12345_67890_stiffness-1.ipynb", "stiffness")
    ('canvas', 'lovelaceada', 'stiffness-1.ipynb')
    """
    for platform, pattern in PATTERNS.items():
        match = re.fullmatch(pattern.replace("ASSIGNMENT", re.escape(assignment)), str(PurePosixPath(name)))
        if match:
            return platform, match["who"], match["file"]
    return None


def _owner(name: str, content: bytes, assignment: str, students: Iterable[Student]) -> tuple[str | None, str]:
    """Whose notebook it is, or why it is nobody's."""
    if not name.endswith(".ipynb"):
        return None, f"{name} is no notebook"
    known = matched(name, assignment)
    if known is None:
        return None, f"{name} has a name of none of {', '.join(PATTERNS)}"
    who = known[1]
    owners = [each for each in students if letters(who) in each.keys | {letters(each.student_id)}]
    if len(owners) > 1:
        typed = typed_id(content)
        owners = [each for each in owners if each.student_id == typed]
        if not owners:
            return None, f"{name} may belong to two students called {who}, and no id in it tells them apart"
    return (owners[0].student_id, "") if owners else (None, f"{name}: there is no {who!r} in the class")


def typed_id(content: bytes) -> str:
    """The id that stands in a notebook; empty if none does.

    Examples
    --------
    >>> typed_id(b'{"cells": [{"source": ["student_id = \\\\"Ada\\\\"  # yours"]}]}')
    'ada'
    """
    try:
        cells = json.loads(content)["cells"]
        text = "\n".join("".join(cell["source"]) for cell in cells)
    except (ValueError, KeyError, TypeError):
        return ""
    match = re.search(r"""^student_id = (["'])(.*?)\1""", text, re.MULTILINE)
    return match[2].strip().lower() if match else ""
