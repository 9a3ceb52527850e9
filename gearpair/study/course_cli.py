"""The commands ``gearpair course``: sheets, lists, collecting and marks for who teaches; a first hour for students."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

from gearpair.study.errors import StudyError

CLASS = "A CSV file with the students: a column of ids, and their names where these are known."


@contextmanager
def _told() -> Iterator[None]:
    """What the room for teaching finds wrong, in the way of the command line."""
    try:
        yield
    except ValueError as error:
        raise StudyError(str(error)) from None


def _in_course(function: Callable[..., None]) -> Callable[..., None]:
    path: Any = click.Path(path_type=Path)
    option = click.option("--course", type=path, default=Path(), metavar="DIR", help="The course's directory; here.")
    return option(function)


@click.group()
def course() -> None:
    """Teach from the book: sheets, a platform's archive, marks; and get a computer ready for its first hour."""


@course.command("ready")
@click.option("--quiet", is_flag=True, help="No progress bar.")
def ready(quiet: bool) -> None:
    """Compile the kernels, once on each computer, and say that all is well.

    What is compiled stays on the disk; afterwards everything starts at once.
    """
    from gearpair.study.first_hour import get_ready

    print(get_ready(progress=not quiet))


@course.command("sheets")
@click.argument("file", type=click.Path(path_type=Path), metavar="IDS.csv")
@click.option("-o", "--output", type=click.Path(path_type=Path), default=Path("sheets"), metavar="DIR")
@click.option("-a", "--assignment", "wanted", multiple=True, metavar="NAME", help="Repeat for more; all if not given.")
@_in_course
def sheets(file: Path, output: Path, wanted: Sequence[str], course: Path) -> None:
    """Write the course on paper, and for other systems, without nbgrader.

    For each assignment a sheet a student to print (their own numbers in it) and one for who marks: the right numbers,
    what counts as right, the rubrics. Beside them questions for Moodle (moodle.xml) and a table (answers.csv).
    IDS.csv holds the students.
    """
    from gearpair.study.course_files import answers_csv, moodle_xml
    from gearpair.study.course_pages import marking_sheet, sheet
    from gearpair.teaching.classes import read_class

    with _told():
        students = [each.student_id for each in read_class(file)]
    sources = _sources(course, wanted)
    for source in sources:
        click.echo(f"{source.stem}: the answers of {len(students)} students", err=True)
        into = output / source.stem
        into.mkdir(parents=True, exist_ok=True)
        for student in students:
            (into / f"{student}.html").write_text(sheet(source, student), encoding="utf-8")
        (output / f"{source.stem}-marking.html").write_text(marking_sheet(source, students), encoding="utf-8")
    (output / "moodle.xml").write_text(moodle_xml(sources, students), encoding="utf-8")
    (output / "answers.csv").write_text(answers_csv(sources, students), encoding="utf-8")
    print(f"{output}: {len(sources)} assignments for {len(students)} students; only the folders are for students")


@course.command("collect")
@click.argument("archive", type=click.Path(path_type=Path), metavar="ARCHIVE.zip")
@click.argument("assignment")
@click.argument("file", type=click.Path(path_type=Path), metavar="CLASS.csv")
@_in_course
def collect(archive: Path, assignment: str, file: Path, course: Path) -> None:
    """Put the notebooks of a platform's archive where the grader looks for them.

    Moodle's and Canvas's archives are known, and such with ids for names.
    """
    from gearpair.teaching.classes import read_class
    from gearpair.teaching.collecting import collect as collected

    if not (course / "source" / assignment).is_dir():
        raise StudyError(f"{course / 'source'} has no assignment {assignment!r}: run this in the course's directory")
    with _told():
        done = collected(archive, assignment, read_class(file), course)
    for sentence in done.sentences:
        click.echo(sentence, err=True)
    print(f"{len(done.written)} collected, {len(done.missing)} not handed in{': ' if done.missing else ''}", end="")
    print(", ".join(done.missing))


@course.command("students")
@click.argument("file", type=click.Path(path_type=Path), metavar="CLASS.csv")
@click.option("-o", "--output", type=click.Path(path_type=Path), default=Path("students.csv"), metavar="OUT.csv")
def students(file: Path, output: Path) -> None:
    """Write a class as nbgrader imports it: nbgrader db student import students.csv."""
    import csv

    from gearpair.teaching.classes import read_class

    with _told():
        found = read_class(file)
    with open(output, "w", newline="", encoding="utf-8") as out:
        writer = csv.writer(out)
        writer.writerow(["id", "first_name", "last_name", "email"])
        for each in found:
            first, _, last = each.name.rpartition(" ")
            writer.writerow([each.student_id, first, last, each.email])
    print(f"{output}: {len(found)} students")


@course.command("marks")
@click.argument("file", type=click.Path(path_type=Path), metavar="CLASS.csv")
@click.option("-o", "--output", type=click.Path(path_type=Path), default=Path("marks.csv"), metavar="OUT.csv")
@_in_course
def marks(file: Path, output: Path, course: Path) -> None:
    """Write the marks of a class: a line a student, the largest possible beside each, and what was not handed in."""
    from gearpair.teaching.classes import read_class
    from gearpair.teaching.gradebooks import write_marks

    with _told():
        told = write_marks(course, read_class(file), output)
    print("\n".join([*told, f"{output}"]))


def _sources(course: Path, wanted: Sequence[str]) -> list[Path]:
    found = {path.stem: path for path in sorted((course / "source").glob("*/*.ipynb")) if path.parent.name == path.stem}
    if not found:
        raise StudyError(f"{course / 'source'} holds no assignments: the teacher's pack and a checkout have them")
    unknown = [name for name in wanted if name not in found]
    if unknown:
        raise StudyError(f"there is no assignment {unknown[0]!r}; there are {', '.join(found)}")
    return [found[name] for name in wanted or found]
