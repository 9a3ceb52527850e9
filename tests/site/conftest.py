"""One browser for all pages."""

import pytest

from gearpair.study.browser import chromium


@pytest.fixture(scope="session")
def browser():
    with chromium() as started:
        yield started
