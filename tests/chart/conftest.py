"""One browser for the pages of a module."""

import pytest

from gearpair.study.errors import StudyError
from tools.browser import chromium


@pytest.fixture(scope="module")  # while it lives, nothing else in the process can use asyncio
def browser():
    """A browser for the pages of one module; without one its tests are skipped."""
    try:
        with chromium() as started:
            yield started
    except StudyError as error:
        pytest.skip(str(error))
