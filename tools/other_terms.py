"""Whether the stored outputs survive what should not change them: another processor, one thread, other rounding."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click
import nbformat

from gearpair.study.book import Book
from gearpair.study.chapters import Chapter
from gearpair.study.cli import main
from gearpair.study.errors import StudyError
from gearpair.study.execution import execute
from tools.accept import stable_outputs

NUDGE = 1.0 + 1e-12
NUDGED = "parameters changed by 1e-12"
# What the environment of the kernel is changed to.
CONDITIONS: dict[str, dict[str, str]] = {
    "a generic processor": {"NUMBA_CPU_NAME": "generic"},
    "one thread": {"NUMBA_NUM_THREADS": "1"},
    "no fused multiply-add": {"GEARPAIR_FMA": "0"},
    NUDGED: {},
}
NOT_COMPARED = "nbval-ignore-output"


def nudged(chapter: Chapter) -> dict[str, Any]:
    """The float parameters of a chapter, each changed by 1e-12 of itself; 0 stays 0."""
    values: dict[str, Any] = {}
    for parameter in chapter.parameters:
        if isinstance(parameter.default, float):
            values[parameter.name] = parameter.default * NUDGE
        elif parameter.annotation == "list[float]":
            values[parameter.name] = [value * NUDGE for value in parameter.default]
    return values


@contextmanager
def environment(changes: Mapping[str, str]) -> Iterator[None]:
    """The process's environment, which kernels inherit, changed for a while."""
    before = {name: os.environ.get(name) for name in changes}
    os.environ.update(changes)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def changed_cells(chapter: Chapter, condition: str) -> list[int]:
    """The code cells (counted from 1) of a chapter whose stored outputs differ when it is run under a condition.

    Cells that nbval does not compare are not compared here either.
    """
    values = nudged(chapter) if condition == NUDGED else {}
    with tempfile.TemporaryDirectory() as scratch, environment(CONDITIONS[condition]):
        executed = execute(chapter, Path(scratch) / chapter.path.name, values, progress=False)
    stored, now = (code_cells(each) for each in (nbformat.read(chapter.path, as_version=4), executed))
    return [
        number
        for number, (a, b) in enumerate(zip(stored, now, strict=True), start=1)
        if NOT_COMPARED not in a.metadata.get("tags", []) and compared(a.outputs) != compared(stable_outputs(b))
    ]


def code_cells(notebook: nbformat.NotebookNode) -> list[nbformat.NotebookNode]:
    """The code of a chapter's own; a run with other parameters has a cell with those, and leaves texts out."""
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    return [cell for cell in code if "injected-parameters" not in cell.metadata.get("tags", [])]


def compared(outputs: Iterable[nbformat.NotebookNode]) -> list[tuple[str, Any]]:
    """Outputs less the numbers that count executions; what was printed in one piece, however it arrived."""
    outputs = list(outputs)
    printed = "".join(output.text for output in outputs if output.output_type == "stream")
    shown = [(output.output_type, output.get("data")) for output in outputs if output.output_type != "stream"]
    return [("stream", printed), *shown]


def check_stability(book: Book, names: tuple[str, ...] = ()) -> Iterator[tuple[str, str, list[int]]]:
    """Run chapters, all when none is named, under every condition.

    Yields
    ------
    (str, str, list of int)
        Chapter, condition, and the code cells whose compared outputs changed.
    """
    for chapter in [book.chapter(name) for name in names] or book.chapters():
        for condition in CONDITIONS:
            if condition != NUDGED or nudged(chapter):
                yield chapter.name, condition, changed_cells(chapter, condition)


@click.command()
@click.option("--root", type=click.Path(path_type=Path), metavar="DIR", help="The checkout; found from here upwards.")
@click.argument("chapters", nargs=-1)
def stability(root: Path | None, chapters: tuple[str, ...]) -> None:
    """Run chapters on other terms and compare with the stored outputs.

    As on a processor without fused multiply-add, with one thread, and with parameters changed by 1e-12. CHAPTERS are
    names; all when none is given.
    """
    unstable = 0
    for name, condition, cells in check_stability(Book.find(root), chapters):
        unstable += bool(cells)
        told = f"code cells {', '.join(map(str, cells))} differ" if cells else "the same"
        print(f"{name}, {condition}: {told}", flush=True)
    if unstable:
        raise StudyError(f"{unstable} of the runs put out something else than is stored")


if __name__ == "__main__":
    sys.exit(main(run=stability, name="tools.other_terms"))
