"""The check of stored outputs: it sees a number that depends on the last digits, and lets through one that does not."""

import os

import nbformat
import pytest

from gearpair.parameters import BASELINE
from gearpair.study.book import Book
from gearpair.study.cli import main
from tests.support.notebooks import MEAN, write_notebook
from tools.accept import accept_outputs
from tools.other_terms import CONDITIONS, NUDGED, compared, environment, stability

RAW = "print(repr(a))"  # all digits of a parameter
THREADS = "import os\nprint(os.environ.get('NUMBA_NUM_THREADS'))"


@pytest.fixture
def stored(small_book):
    """Stores the outputs of a chapter made of the given cells, with a sentence about its own parameters."""

    def store(*cells):
        path = write_notebook(small_book / "notebooks" / "small.ipynb", *cells)
        notebook = nbformat.read(path, as_version=4)
        own = nbformat.v4.new_markdown_cell("It is 0.7.", metadata={"tags": [BASELINE]})
        notebook.cells.insert(2, own)
        nbformat.write(notebook, path)
        accept_outputs(Book(small_book), progress=False)
        return small_book

    return store


@pytest.mark.slow
def test_what_is_rounded_is_the_same_on_all_terms(stored, capsys):
    assert main(["--root", str(stored(MEAN))], run=stability) == 0
    assert capsys.readouterr().out.splitlines() == [f"small, {condition}: the same" for condition in CONDITIONS]


@pytest.mark.slow
def test_what_hangs_on_the_last_digits_or_on_the_machine_is_named(stored, capsys):
    assert main(["--root", str(stored(RAW, THREADS)), "small"], run=stability) == 1
    lines = dict(line.split(": ") for line in capsys.readouterr().out.splitlines())
    assert lines[f"small, {NUDGED}"] == "code cells 2 differ"
    assert lines["small, one thread"] == "code cells 3 differ"
    assert lines["small, no fused multiply-add"] == "the same"


def test_the_environment_is_put_back(monkeypatch):
    monkeypatch.setenv("NUMBA_NUM_THREADS", "2")
    monkeypatch.delenv("GEARPAIR_FMA", raising=False)
    with environment({"NUMBA_NUM_THREADS": "1", "GEARPAIR_FMA": "0"}):
        assert (os.environ["NUMBA_NUM_THREADS"], os.environ["GEARPAIR_FMA"]) == ("1", "0")
    assert os.environ["NUMBA_NUM_THREADS"] == "2" and "GEARPAIR_FMA" not in os.environ


def test_what_is_printed_in_pieces_is_the_same_as_in_one():
    one, two = (
        [nbformat.v4.new_output("stream", text=text) for text in texts] for texts in (["a\nb\n"], ["a\n", "b\n"])
    )
    assert compared(one) == compared(two)
    two[1].text = "c\n"
    assert compared(one) != compared(two)
