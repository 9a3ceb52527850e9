"""What the page takes from the library is what the library says today."""

import pytest

from gearpair.plotting.style import MOTION_COLOURS
from tests.support.engines import MODULES, run_in_node
from tools.explorer_facts import WRITTEN, facts


@pytest.mark.parametrize("name", sorted(WRITTEN))
def test_the_stored_file_is_what_the_library_writes(name):
    stored = (MODULES / name).read_text(encoding="utf-8")
    assert stored == WRITTEN[name](), f"{name} is old: run python -m tools.explorer_facts"


def test_the_scripts_read_the_same():
    assert run_in_node("() => gearpair.use('library')", None) == facts()


def test_each_colour_stands_in_one_file():
    """A motion's colour that is written in a second file will differ some day."""
    for path in MODULES.rglob("*.*"):
        if path.name != "colours.css":
            text = path.read_text(encoding="utf-8").lower()
            assert [name for name, colour in MOTION_COLOURS.items() if colour.lower() in text] == [], path
