"""The explorer, opened at an address."""

import pytest

from tests.support.explorer_pages import SETTLED, opened, write_page


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
