"""A chapter's stored outputs against those that the book shows: executed once for both, and compared by nbval.

With `--nbval` on the command line nbval executes the notebooks itself.
"""

from __future__ import annotations

import tempfile
from functools import cached_property
from pathlib import Path

import nbformat
import pytest
from nbval.plugin import IPyNbCell, IPyNbFile, coalesce_streams

from gearpair.study.book import Book
from gearpair.study.cache import Cache
from gearpair.study.chapters import read_chapter
from gearpair.study.errors import StudyError
from gearpair.study.side_by_side import execute_all

collect_ignore = ["assignments"]  # `make teach` has them


def pytest_collect_file(file_path, parent):
    if file_path.suffix == ".ipynb" and not parent.config.option.nbval:
        return ChapterFile.from_parent(parent, path=file_path)


class ChapterFile(IPyNbFile):
    """A chapter, executed for `make book` or now, as `make book` would."""

    def setup(self):
        self.setup_sanitize_files()

    def collect(self):
        for cell in super().collect():
            own = ChapterCell.from_parent(
                self, name=cell.name, cell_num=cell.cell_num, cell=cell.cell, options=cell.options
            )
            own.add_marker("slow")
            yield own

    @cached_property
    def executed(self) -> nbformat.NotebookNode | StudyError:
        """The executed chapter, or why there is none."""
        book = Book.find(self.path.parents[1])
        kept, lock = Cache(book.target / "cache"), book.root / "requirements.lock"
        try:
            with tempfile.TemporaryDirectory() as scratch:
                ((_, notebook),) = execute_all([read_chapter(self.path)], kept, lock, Path(scratch)).values()
        except StudyError as error:
            return error
        return notebook


class ChapterCell(IPyNbCell):
    """One code cell; what it put out when the chapter was executed."""

    def runtest(self):
        executed = self.parent.executed
        if isinstance(executed, StudyError):
            pytest.fail(str(executed), pytrace=False)
        cell = [cell for cell in executed.cells if cell.cell_type == "code"][self.cell_num]
        if self.cell_num in executed.metadata.gearpair.get("warned", []):
            self.raise_cell_error("Cell wrote to stderr: a warning, or a progress bar")
        if self.options["check"] and not self.compare_outputs(
            coalesce_streams(cell.outputs), coalesce_streams(self.cell.outputs)
        ):
            self.raise_cell_error("Cell outputs differ", "\n".join(self.comparison_traceback))
