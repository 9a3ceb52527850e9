"""The order of the tests, a browser, and a small book to break."""

import os
import shutil
from collections import Counter

import pytest

from gearpair.study.errors import StudyError
from tests.support import ROOT
from tests.support.notebooks import MEAN, write_notebook
from tools.browser import chromium

# By hand, with packages that the other tests do without: `make check-site` names the site that it checks.
collect_ignore = ["teeth/finite_elements"] if "GEARPAIR_SITE" in os.environ else ["teeth/finite_elements", "site"]
FIRST = ("test_layers.py", "test_style.py")


@pytest.hookimpl(tryfirst=True)  # before tests are chosen by their marks
def pytest_collection_modifyitems(items):
    """The layers are checked before anything else, then the style; then what has most of the slow tests.

    A long file that began last would keep one process at work while the others wait. What needs a browser is slow.
    """
    for item in items:
        if "browser" in getattr(item, "fixturenames", ()):  # a cell of a notebook has none
            item.add_marker(pytest.mark.slow)
    slow = Counter(item.path for item in items if item.get_closest_marker("slow"))
    first = {name: place for place, name in enumerate(FIRST)}
    items.sort(key=lambda item: (first.get(item.path.name, len(first)), -slow[item.path]))


@pytest.fixture(scope="module")  # while it lives, nothing else in the process can use asyncio
def browser():
    """A browser for the pages of one module; without one its tests are skipped."""
    try:
        with chromium() as started:
            yield started
    except StudyError as error:
        pytest.skip(str(error))


@pytest.fixture
def small_book(tmp_path):
    """A book of one chapter, `small`, that prints the mean of the baseline's stiffness wave."""
    root = tmp_path / "checkout"
    (root / "notebooks").mkdir(parents=True)
    (root / "book" / "_ext").mkdir(parents=True)
    shutil.copy(ROOT / "book" / "_ext" / "finishing.py", root / "book" / "_ext")
    (root / "book" / "introduction.md").write_text("# A small book\n\nSome words.\n")
    (root / "_toc.yml").write_text(
        "format: jb-book\nroot: book/introduction\nchapters:\n  - file: book/chapters/small\n"
    )
    (root / "_config.yml").write_text(
        'title: Small\nauthor: nobody\nonly_build_toc_files: true\nexecute:\n  execute_notebooks: "off"\n'
        "sphinx:\n  local_extensions:\n    finishing: book/_ext\n"
    )
    write_notebook(root / "notebooks" / "small.ipynb", MEAN)
    return root
