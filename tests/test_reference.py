"""The reference has a place for every public module and folder of the library."""

import re

from tests.support import ROOT

NOT_FOR_READERS = {"study", "__main__"}  # the command line and the building of the book


def test_every_public_module_is_in_the_reference():
    pages = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "book" / "api").glob("*.rst"))
    documented = set(re.findall(r"^\.\. room:: gearpair\.(\w+)$", pages, re.MULTILINE))
    there = {
        path.stem for path in (ROOT / "gearpair").iterdir() if path.suffix == ".py" or (path / "__init__.py").is_file()
    }
    assert documented == {name for name in there if not name.startswith("_")} - NOT_FOR_READERS


def test_every_page_of_the_reference_is_in_the_table_of_contents():
    contents = (ROOT / "_toc.yml").read_text(encoding="utf-8")
    pages = {f"book/api/{path.stem}" for path in (ROOT / "book" / "api").glob("*.rst")}
    assert pages == set(re.findall(r"book/api/\w+", contents))
