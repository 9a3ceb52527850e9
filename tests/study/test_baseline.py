"""What a chapter says of its own parameters alone is not said of others."""

import nbformat
import papermill
import pytest
from nbformat.v4 import new_markdown_cell

from gearpair.study.chapters import read_chapter
from gearpair.study.execution import execute
from gearpair.study.record import without_baseline
from tests.support.notebooks import write_notebook

CHECKED = "from gearpair.parameters import check_parameters\ncheck_parameters(globals())"
SPEAKS = "The mean is about one."


@pytest.fixture
def chapter(tmp_path):
    """One that has two texts, of which the second is of its own parameters."""
    path = write_notebook(tmp_path / "small.ipynb", CHECKED)
    notebook = nbformat.read(path, as_version=4)
    notebook.cells[2].metadata["mystnb"] = {"image": {"alt": "A line."}}
    notebook.cells += [new_markdown_cell("Always."), new_markdown_cell(SPEAKS, metadata={"tags": ["baseline"]})]
    nbformat.write(notebook, path)
    return read_chapter(path)


def texts(notebook):
    return [cell.source for cell in notebook.cells if cell.cell_type == "markdown"]


@pytest.mark.parametrize(("values", "stays"), [({}, True), ({"a": 0.116}, True), ({"a": 0.2}, False)])
def test_text_of_the_chapters_own_parameters_stays_where_they_are_those(chapter, values, stays):
    notebook = without_baseline(nbformat.read(chapter.path, as_version=4), chapter, values)
    assert (SPEAKS in texts(notebook)) == stays
    assert "Always." in texts(notebook)
    described = notebook.cells[2].metadata.mystnb.image.alt
    assert described == ("A line." if stays else "As it is with the chapter's own parameters: A line.")


@pytest.mark.slow
def test_a_run_leaves_it_out_and_says_nothing(chapter, tmp_path):
    notebook = execute(chapter, tmp_path / "out.ipynb", {"a": 0.2}, progress=False)
    for run in (notebook, nbformat.read(tmp_path / "out.ipynb", as_version=4)):
        assert SPEAKS not in texts(run) and "Always." in texts(run)
        assert not [cell.outputs for cell in run.cells if cell.get("outputs")]


@pytest.mark.parametrize(("values", "told"), [({}, False), ({"a": 0.116}, False), ({"a": 0.2}, True)])
@pytest.mark.slow
def test_papermill_keeps_it_and_says_once_what_was_changed(chapter, values, told):
    run = papermill.execute_notebook(chapter.path, None, values, progress_bar=False)
    assert SPEAKS in texts(run)
    said = (
        "Changed: a = 0.2 (the chapter's own is 0.116). "
        "Text cells tagged 'baseline' speak of the chapter's own parameters.\n"
    )
    assert [output.text for cell in run.cells for output in cell.get("outputs", [])] == [said] * told
