"""What the tests share: their order, and small books to break."""

import os
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from gearpair.study.errors import StudyError
from tools.browser import chromium

# By hand, with packages that the other tests do without: `make check-site` names the site that it checks.
collect_ignore = ["finite_elements"] if "GEARPAIR_SITE" in os.environ else ["finite_elements", "site"]
FIRST = ("test_layers.py", "test_style.py")


def pytest_collection_modifyitems(items):
    """The layers are checked before anything else, then the style."""
    items.sort(key=lambda item: FIRST.index(item.path.name) if item.path.name in FIRST else len(FIRST))


@pytest.fixture(scope="module")  # while it lives, nothing else in the process can use asyncio
def browser():
    """A browser for the pages of one module; without one its tests are skipped."""
    try:
        with chromium() as started:
            yield started
    except StudyError as error:
        pytest.skip(str(error))


PARAMETERS = "a: float = 0.116  # stiffness added in double contact"
MEAN = "import gearpair as gp\nprint(f'{gp.StiffnessWave.rectangular(a=a).mean:.4f}')"


def write_notebook(path: Path, *code: str, parameters: str = PARAMETERS, tags: tuple[str, ...] = ("parameters",)):
    """A chapter with a title, a parameters cell and the given code cells."""
    cells = [new_markdown_cell("# A small chapter"), new_code_cell(parameters, metadata={"tags": list(tags)})]
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3"}, "language_info": {"name": "python"}}
    notebook = new_notebook(metadata=kernel, cells=[*cells, *map(new_code_cell, code)])
    nbformat.write(notebook, path)
    return path


@pytest.fixture
def small_book(tmp_path):
    """A book of one chapter, `small`, that prints the mean of the baseline's stiffness wave."""
    root = tmp_path / "checkout"
    (root / "notebooks").mkdir(parents=True)
    (root / "book").mkdir()
    (root / "book" / "introduction.md").write_text("# A small book\n\nSome words.\n")
    (root / "_toc.yml").write_text(
        "format: jb-book\nroot: book/introduction\nchapters:\n  - file: book/chapters/small\n"
    )
    (root / "_config.yml").write_text(
        'title: Small\nauthor: nobody\nonly_build_toc_files: true\nexecute:\n  execute_notebooks: "off"\n'
    )
    write_notebook(root / "notebooks" / "small.ipynb", MEAN)
    return root
