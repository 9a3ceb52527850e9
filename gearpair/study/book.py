"""From source notebooks to the rendered book, and to accepted outputs."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nbformat
import yaml

from gearpair.study.chapters import Chapter, read_chapter
from gearpair.study.errors import StudyError
from gearpair.study.execution import execute
from gearpair.study.finishing import finish_site

EXECUTED = "book/chapters/"


@dataclass(frozen=True)
class Book:
    """A checkout: where its table of contents, its notebooks and its rendered pages are."""

    root: Path

    @classmethod
    def find(cls, root: Path | None = None) -> Book:
        """The book at `root`; without one, of the working directory or a parent of it, else of this package."""
        places = [root] if root else [Path.cwd(), *Path.cwd().parents, Path(__file__).parents[2]]
        for place in places:
            if (place / "_toc.yml").is_file() and (place / "notebooks").is_dir():
                return cls(place.resolve())
        raise StudyError(f"no book here: {places[0]} has no _toc.yml beside a notebooks directory")

    @property
    def executed(self) -> Path:
        """Where the executed chapters go."""
        return self.root / EXECUTED

    @property
    def html(self) -> Path:
        """The rendered site."""
        return self.root / "_build" / "html"

    @property
    def toc(self) -> dict[str, Any]:
        """The table of contents."""
        return dict(yaml.safe_load((self.root / "_toc.yml").read_text(encoding="utf-8")))

    @property
    def title(self) -> str:
        """The book's title."""
        return str(yaml.safe_load((self.root / "_config.yml").read_text(encoding="utf-8"))["title"])

    def pages(self) -> list[str]:
        """All pages after the first, in order."""
        return _files({key: value for key, value in self.toc.items() if key != "root"})

    def chapter_names(self) -> list[str]:
        """Names of the chapters, in the order of the table of contents (the one place that lists them)."""
        return [file.removeprefix(EXECUTED) for file in _files(self.toc) if file.startswith(EXECUTED)]

    def chapters(self) -> list[Chapter]:
        """All chapters, read."""
        return [self.chapter(name) for name in self.chapter_names()]

    def chapter(self, name: str) -> Chapter:
        """The chapter called `name`, which may also be the path of a notebook."""
        path = Path(name)
        if path.suffix == ".ipynb" and path.is_file():
            return read_chapter(path)
        names = self.chapter_names()
        if name not in names:
            raise StudyError(f"there is no chapter {name!r}; there are {', '.join(names)}")
        return read_chapter(self.root / "notebooks" / f"{name}.ipynb")


def _files(entry: Any) -> list[str]:
    """Every ``file`` of a table of contents, depth first."""
    if isinstance(entry, list):
        return [file for item in entry for file in _files(item)]
    if isinstance(entry, dict):
        here = [entry["file"]] if "file" in entry else []
        return here + [file for value in entry.values() if isinstance(value, list) for file in _files(value)]
    return []


def build_book(book: Book, *, progress: bool = True) -> Path:
    """Execute every chapter, render the site, and put it in place of the last one.

    Everything is made beside the last good book, which a failure leaves untouched.

    Returns
    -------
    Path
        The site's first page.

    Raises
    ------
    StudyError
        If a chapter fails (naming it, the cell and the error) or the site does not build without warnings.
    """
    chapters = book.chapters()
    staging = book.root / "_build" / "staging"
    shutil.rmtree(staging, ignore_errors=True)
    (staging / "chapters").mkdir(parents=True)
    for chapter in chapters:
        output = staging / "chapters" / chapter.path.name
        notebook = execute(chapter, output, progress=progress)
        notebook.metadata.pop("papermill", None)  # it names the directories of this machine; readers can download it
        nbformat.write(notebook, output)
    _put_in_place(staging / "chapters", book.executed)
    site = render(book, staging)
    _put_in_place(site, book.html)
    shutil.rmtree(staging)
    return book.html / "index.html"


def render(book: Book, staging: Path) -> Path:
    """Build the site from the executed chapters that are there, warnings as errors; return where it is.

    Raises
    ------
    StudyError
        If there was a warning.
    """
    code = "import sys; from jupyter_book.cli.main import main; sys.exit(main())"
    command = [sys.executable, "-c", code, "build", str(book.root), "--path-output", str(staging)]
    options = ["--all", "--warningiserror", "--keep-going", "--quiet"]
    result = subprocess.run([*command, *options], check=False, stdout=subprocess.PIPE, text=True)
    if result.returncode:
        print(result.stdout)
        raise StudyError("the pages did not build without warnings (they are named above); the last book stays")
    site = staging / "_build" / "html"
    finish_site(site, first_page=book.toc["root"], title=book.title)
    return site


def _put_in_place(new: Path, old: Path) -> None:
    """Let the directory `new` take the place of `old`."""
    aside = old.with_name(old.name + ".old")
    shutil.rmtree(aside, ignore_errors=True)
    if old.exists():
        os.replace(old, aside)
    os.replace(new, old)
    shutil.rmtree(aside, ignore_errors=True)


def accept_outputs(book: Book, *, progress: bool = True) -> list[str]:
    """Re-execute every source notebook with its defaults and store the new outputs.

    All chapters run before any file is written. What differs from run to run or from machine to machine is not
    stored: images, what was written to stderr, papermill's notes.

    Returns
    -------
    list of str
        The names of the chapters whose file changed.
    """
    scratch = book.root / "_build" / "accept"
    scratch.mkdir(parents=True, exist_ok=True)
    texts = {}
    for chapter in book.chapters():
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
    notebook.metadata = nbformat.from_dict(
        {
            "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        }
    )
    for cell, run in zip(notebook.cells, executed.cells, strict=True):
        if cell.cell_type == "code":
            cell.execution_count = run.execution_count
            cell.outputs = [stable for output in run.outputs if (stable := _stable_output(output)) is not None]
    return notebook


def _stable_output(output: nbformat.NotebookNode) -> nbformat.NotebookNode | None:
    if output.get("name") == "stderr":
        return None
    if "data" in output:
        output.data = {mime: data for mime, data in output.data.items() if not mime.startswith("image/")}
        output.metadata = {key: value for key, value in output.metadata.items() if key == "scrapbook"}
    return output
