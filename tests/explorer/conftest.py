"""One browser for the pages of a module."""

import pytest

from gearpair.study.errors import StudyError
from tests.support.explorer_pages import SETTLED, opened, write_page
from tools.browser import chromium


@pytest.fixture(scope="module")  # while it lives, nothing else in the process can use asyncio
def browser():
    """A browser for the pages of one module; without one its tests are skipped."""
    try:
        with chromium() as started:
            yield started
    except StudyError as error:
        pytest.skip(str(error))


@pytest.fixture
def explorer(browser, tmp_path):
    """Opens the explorer at a hash, its motion settled or chaotic so far."""
    path = write_page(tmp_path)
    with opened(browser) as go:

        def open_at(hash: str = "", **media: str):
            page = go(path.as_uri() + hash, **media)
            page.wait_for_function(SETTLED)
            return page

        yield open_at
