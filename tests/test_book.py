"""Building the book: what is shown is what ran, and a failure leaves the last good book in place."""

import nbformat
import pytest

from gearpair.study.cli import main
from tests.conftest import MEAN, write_notebook

LAST_GOOD = "the last good book"


@pytest.fixture
def built_before(small_book):
    """The small book with a site from an earlier build."""
    html = small_book / "_build" / "html"
    html.mkdir(parents=True)
    (html / "index.html").write_text(LAST_GOOD)
    return small_book


def site(root):
    return (root / "_build" / "html" / "index.html").read_text()


def test_a_good_build_takes_the_place_of_the_last(built_before):
    assert main(["--root", str(built_before), "book"]) == 0
    assert LAST_GOOD not in site(built_before)
    page = (built_before / "_build" / "html" / "book" / "chapters" / "small.html").read_text()
    assert "0.9464" in page
    assert sorted(path.name for path in (built_before / "_build").iterdir()) == ["html"]


def test_a_failed_chapter_is_named_and_the_last_book_stays(built_before, capsys):
    write_notebook(built_before / "notebooks" / "small.ipynb", MEAN, "gp.StiffnessWave((0.0, 0.0), (1.0, 1.0))")
    assert main(["--root", str(built_before), "book"]) == 1
    assert capsys.readouterr().err.splitlines()[-1] == (
        "gearpair: chapter small failed in code cell 3 (cell 4 of the notebook): ValueError: "
        "edges must increase strictly and stay below 1; got edges[0] = 0.0 followed by 0.0"
    )
    assert site(built_before) == LAST_GOOD


def test_an_error_that_a_chapter_expects_still_stops_the_build(built_before, capsys):
    path = built_before / "notebooks" / "small.ipynb"
    write_notebook(path, "raise RuntimeError('hidden')")
    notebook = nbformat.read(path, as_version=4)
    notebook.cells[-1].metadata["tags"] = ["raises-exception"]
    nbformat.write(notebook, path)
    assert main(["--root", str(built_before), "book"]) == 1
    assert "RuntimeError: hidden" in capsys.readouterr().err
    assert site(built_before) == LAST_GOOD


def test_a_warning_of_the_page_builder_is_an_error(built_before, capfd):
    (built_before / "book" / "introduction.md").write_text("# A small book\n\nSee {ref}`no-such-place`.\n")
    assert main(["--root", str(built_before), "book"]) == 1
    error = capfd.readouterr().err
    assert "no-such-place" in error
    assert "the last book stays" in error
    assert site(built_before) == LAST_GOOD
