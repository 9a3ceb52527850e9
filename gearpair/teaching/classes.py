"""The students of a class, from the CSV file that a learning platform exports."""

import csv
import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from gearpair.teaching.personal import check_student_id

# headers that stand for a column, in small letters; the first that a file has counts. Canvas's "ID" is a number of its
# own, and what students know as theirs is the login beside it.
HEADERS = {
    "id": ("sis login id", "id", "student_id", "id number", "username", "login id"),
    "first": ("first_name", "first name", "firstname"),
    "last": ("last_name", "last name", "surname", "lastname"),
    "name": ("name", "full name", "student"),
    "email": ("email", "email address"),
}
CANVAS_TEST_STUDENT = "Student, Test"  # a line that Canvas adds to its export


@dataclass(frozen=True)
class Student:
    """One line of a class: the id, as `check_student_id` gives it, the name and the address, empty if not known."""

    student_id: str
    name: str = ""
    email: str = ""

    @property
    def keys(self) -> frozenset[str]:
        """How platforms may spell the name: letters and digits alone, either name first."""
        words = self.name.split()
        return frozenset({letters("".join(words)), letters("".join(words[-1:] + words[:-1]))}) - {""}


def letters(text: str) -> str:
    """A name as small letters and digits, without accents and all else.

    Examples
    --------
    >>> letters("Müller, Zoé-Ann")
    'mullerzoeann'
    """
    return re.sub(r"[\W_]", "", unicodedata.normalize("NFKD", text).casefold())


def read_class(path: str | Path) -> list[Student]:
    """The students of a class.

    Parameters
    ----------
    path : str or Path
        A CSV file with a line of headers: one of ``SIS Login ID``, ``id``, ``ID number``, ``Username``; a name in one
        column (``Name``, ``Student``) or in two (``First name``, ``Last name``); an ``Email``. Only the id must be
        there. Commas or semicolons; lines without an id are left out, and so is Canvas's test student.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "class.csv"
    ...     _ = file.write_text("First name,Surname,ID number\\nAda,Lovelace,AL15\\n")
    ...     read_class(file)
    [Student(student_id='al15', name='Ada Lovelace', email='')]
    """
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except OSError as error:
        raise ValueError(f"{path} cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise ValueError(f"{path} must be saved as UTF-8") from None
    first = text.partition("\n")[0]
    rows = list(csv.DictReader(text.splitlines(), delimiter=";" if first.count(";") > first.count(",") else ","))
    lower = [{str(key).strip().lower(): (value or "").strip() for key, value in row.items() if key} for row in rows]
    if not lower or not any(header in lower[0] for header in HEADERS["id"]):
        raise ValueError(f"{path} must have a line of headers with an id, one of {', '.join(HEADERS['id'])}")
    students = [_student(row) for row in lower if _column(row, "id") and row.get("student") != CANVAS_TEST_STUDENT]
    doubled = sorted(name for name in {s.student_id for s in students} if _count(students, name) > 1)
    if doubled:
        raise ValueError(f"{path} has an id twice: {', '.join(doubled)}")
    return students


def _student(row: dict[str, str]) -> Student:
    name = " ".join(filter(None, (_column(row, "first"), _column(row, "last")))) or _column(row, "name")
    if name.count(",") == 1:  # Lovelace, Ada
        last, first = name.split(",")
        name = f"{first.strip()} {last.strip()}"
    return Student(check_student_id(_column(row, "id")), name, _column(row, "email"))


def _column(row: dict[str, str], what: str) -> str:
    return next((row[header] for header in HEADERS[what] if row.get(header)), "")


def _count(students: Iterable[Student], student_id: str) -> int:
    return sum(each.student_id == student_id for each in students)
