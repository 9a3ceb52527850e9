"""The book's cache: nothing is computed twice, nothing is shown stale, and it may be lost at any time."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

from gearpair.study.cache import LIBRARY, Cache, content_key, library_digest
from gearpair.study.chapters import Chapter, read_chapter
from gearpair.study.side_by_side import Job, longest_first
from tests.support.notebooks import MEAN, write_notebook


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """A copy of the library to edit."""
    copy = tmp_path_factory.mktemp("copy") / "gearpair"
    shutil.copytree(LIBRARY, copy, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


@pytest.mark.parametrize(
    ("name", "matters"),
    [
        ("_flow/closed_form.py", True),
        ("teeth/data/finite_elements.json", True),
        ("plotting/waves.py", True),
        ("study/record.py", True),
        ("study/cli.py", False),  # it computes nothing
    ],
)
def test_an_edit_of_whatever_computes_changes_the_key(library, name, matters):
    before = library_digest(library)
    path = library / name
    text = path.read_text()
    path.write_text(text + "\n")
    assert (library_digest(library) != before) == matters
    path.write_text(text)
    assert library_digest(library) == before


def test_the_key_is_of_the_cells_the_parameters_and_the_lock_and_not_of_stored_outputs(tmp_path):
    lock = tmp_path / "lock"
    lock.write_text("numpy==2.0")
    path = write_notebook(tmp_path / "small.ipynb", MEAN)
    notebook = nbformat.read(path, as_version=4)

    def key(values=None):
        nbformat.write(notebook, path)
        return content_key(read_chapter(path), values or {}, lock)

    first = key()
    notebook.cells[-1].outputs = [nbformat.v4.new_output("stream", text="0.9464\n")]
    notebook.cells[-1].execution_count = 2
    assert key() == first
    assert len({first, key({"a": 0.1}), key({"a": 0.2})}) == 3
    lock.write_text("numpy==2.1")
    assert key() != first
    lock.write_text("numpy==2.0")
    notebook.cells[-1].source += "\n"
    assert key() != first


def test_a_broken_entry_is_as_good_as_none(tmp_path):
    kept = Cache(tmp_path)
    notebook = nbformat.v4.new_notebook(metadata={"gearpair": {"seconds": 7.0, "parameters": {}}})
    text = nbformat.writes(notebook)
    path = tmp_path / "small-0.ipynb"
    path.write_text(text)
    assert kept.read(path) == notebook
    assert kept.seconds("small") == 7.0
    path.write_text(text[: len(text) // 2])
    assert kept.read(path) is None
    assert kept.seconds("small") is None
    assert kept.read(tmp_path / "small-1.ipynb") is None


def test_the_longest_begins_first(tmp_path):
    """By what a chapter took here; where it was never run, by what its notebook tells."""
    kept = Cache(tmp_path)
    chapters = [Chapter(Path(f"{name}.ipynb"), name, (), {}, seconds) for name, seconds in (("a", 20.0), ("b", 30.0))]
    jobs = [Job(chapter, tmp_path / chapter.name) for chapter in chapters]
    assert [job.page.name for job in longest_first(jobs, kept)] == ["b", "a"]
    notebook = nbformat.v4.new_notebook(metadata={"gearpair": {"seconds": 40.0, "parameters": {}}})
    nbformat.write(notebook, tmp_path / "a-0.ipynb")
    assert [job.page.name for job in longest_first(jobs, kept)] == ["a", "b"]


@pytest.mark.slow
def test_only_what_has_changed_is_made_again(small_book, library):
    """Three builds with a library of their own: the first, one with nothing changed, one with another library."""
    stiffness = library / "stiffness.py"
    variants = "  more:\n    chapter: small\n    title: More\n    why: Because.\n    parameters: {a: 0.2}\n"
    (small_book / "book" / "variants.yml").write_text(f"variants:\n{variants}")
    write_notebook(small_book / "notebooks" / "small.ipynb", MEAN)
    notebook = nbformat.read(small_book / "notebooks" / "small.ipynb", as_version=4)
    notebook.cells.append(nbformat.v4.new_markdown_cell("(sec-end)=\n## End\n\nSee [](sec-end)."))
    nbformat.write(notebook, small_book / "notebooks" / "small.ipynb")

    def build():
        done = subprocess.run(
            [sys.executable, "-m", "gearpair", "--root", str(small_book), "book"],
            cwd=small_book,
            env={**os.environ, "PYTHONPATH": str(library.parent)},
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr
        site = small_book / "_build" / "html"
        pages = [(site / "book" / "chapters" / f"{name}.html").read_text() for name in ("small", "small_more")]
        return done.stderr, pages, {path: path.stat().st_mtime_ns for path in site.rglob("*")}

    told, (small, more), first = build()
    assert "to execute: small, small_more" in told
    assert "0.9464" in small and "1.0035" in more  # 1 + 0.2 * 0.68 - 0.414 * 0.32 = 1.00352
    assert "sec-end-more" in more and "sec-end-more" not in small
    told, _, second = build()
    assert told == "" and second == first
    text = stiffness.read_text()
    stiffness.write_text(text.replace("(1.0 + a, 1.0 - b)", "(1.0 + a, 1.001 - b)"))
    told, (small, more), _ = build()
    stiffness.write_text(text)
    assert "to execute: small, small_more" in told
    assert "0.9467" in small and "1.0038" in more
    (next((small_book / "_build" / "html").rglob("small.html"))).unlink()  # a site that is not whole is made again
    assert "to execute: small, small_more" not in (rebuilt := build())[0] and "0.9464" in rebuilt[1][0]
