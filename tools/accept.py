"""The source notebooks executed anew, and their new outputs stored: ``make accept``."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

import click
import nbformat

from gearpair.study.book import Book
from gearpair.study.cli import main
from gearpair.study.execution import execute
from gearpair.study.record import KERNEL, RECORD


def accept_outputs(book: Book, names: Sequence[str] = (), *, progress: bool = True) -> list[str]:
    """Re-execute the named source notebooks, or all of them, with their defaults and store the new outputs.

    All chapters run before any file is written. What differs from run to run or from machine to machine is not
    stored: images, sounds, what was written to stderr, papermill's notes.

    Returns
    -------
    list of str
        The names of the chapters whose file changed.
    """
    scratch = book.root / "_build" / "accept"
    scratch.mkdir(parents=True, exist_ok=True)
    texts = {}
    for chapter in [book.chapter(name) for name in names] or book.chapters():
        executed = execute(chapter, scratch / chapter.path.name, progress=progress)
        texts[chapter.path] = nbformat.writes(stable_notebook(chapter.path, executed), version=4) + "\n"
    changed = [path for path, text in texts.items() if path.read_text(encoding="utf-8") != text]
    for path in changed:
        scratch_file = scratch / path.name
        scratch_file.write_text(texts[path], encoding="utf-8")
        os.replace(scratch_file, path)
    shutil.rmtree(scratch)
    return [path.stem for path in changed]


def stable_notebook(source: Path, executed: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """The notebook at `source` with the outputs of `executed`, less what is not stable."""
    notebook = nbformat.read(source, as_version=4)
    told = {key: value for key, value in notebook.metadata.items() if key == "gearpair"}  # how long it takes
    notebook.metadata = nbformat.from_dict(told | KERNEL)
    ran = [cell for cell in executed.cells if RECORD not in cell.metadata.get("tags", [])]
    for cell, run in zip(notebook.cells, ran, strict=True):
        if cell.cell_type == "code":
            cell.execution_count = run.execution_count
            cell.outputs = stable_outputs(run)
    return notebook


def stable_outputs(cell: nbformat.NotebookNode) -> list[nbformat.NotebookNode]:
    """The outputs of a cell that ran, less what is not stable."""
    return _joined(each for output in cell.outputs if (each := _stable_output(output)) is not None)


def _joined(outputs: Iterable[nbformat.NotebookNode]) -> list[nbformat.NotebookNode]:
    """What was printed in one go in one output, however many pieces it came in."""
    joined: list[nbformat.NotebookNode] = []
    for output in outputs:
        if joined and output.output_type == joined[-1].output_type == "stream" and output.name == joined[-1].name:
            joined[-1].text += output.text
        else:
            joined.append(output)
    return joined


def _stable_output(output: nbformat.NotebookNode) -> nbformat.NotebookNode | None:
    if output.get("name") == "stderr":
        return None
    if "data" in output:
        output.data = {
            mime: data
            for mime, data in output.data.items()
            if not mime.startswith("image/") and "data:audio/" not in data
        }
        output.metadata = {key: value for key, value in output.metadata.items() if key == "scrapbook"}
    return output


@click.command()
@click.option("--root", type=click.Path(path_type=Path), metavar="DIR", help="The checkout; found from here upwards.")
@click.argument("chapters", nargs=-1)
def accept(root: Path | None, chapters: tuple[str, ...]) -> None:
    """Re-execute the source notebooks of CHAPTERS, or all, and store their new outputs."""
    changed = accept_outputs(Book.find(root), chapters)
    print(f"new outputs stored: {', '.join(changed)} (look at them with git diff)" if changed else "nothing changed")


if __name__ == "__main__":
    sys.exit(main(run=accept, name="tools.accept"))
