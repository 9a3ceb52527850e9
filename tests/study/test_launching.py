"""Buttons that run a chapter elsewhere stand on chapters alone, and only where the book knows its repository."""

from types import SimpleNamespace

import pytest
from sphinx.errors import ExtensionError

from tests.support import ROOT
from tests.support.extensions import extension

launching = extension("launching")


def heads(monkeypatch, address, pages):
    """The buttons that each page's head gets."""
    monkeypatch.setenv("GEARPAIR_REPOSITORY", address)
    contexts = {page: {"header_buttons": []} for page in pages}
    for page, context in contexts.items():
        launching.add_buttons(SimpleNamespace(srcdir=ROOT), page, "page.html", context, None)
    return [context["header_buttons"] for context in contexts.values()]


@pytest.mark.parametrize("ending", ["", ".git", "/"])
def test_a_published_chapter_opens_its_own_notebook(monkeypatch, ending):
    pages = ["book/chapters/impacts", "book/chapters/impacts_swapped", "book/model"]
    chapter, variant, prose = heads(monkeypatch, f"https://github.com/a-lab/gearpair{ending}", pages)
    assert variant == prose == []
    addresses = [button["url"] for button in chapter[0]["buttons"]]
    assert addresses == [
        "https://mybinder.org/v2/gh/a-lab/gearpair/main?urlpath=lab/tree/notebooks/impacts.ipynb",
        "https://colab.research.google.com/github/a-lab/gearpair/blob/main/notebooks/impacts.ipynb",
        "https://codespaces.new/a-lab/gearpair",
    ]
    _binder, colab, _codespaces = tooltips = [button["tooltip"] for button in chapter[0]["buttons"]]
    assert all(tooltips) and colab.endswith("%pip install git+https://github.com/a-lab/gearpair")


def test_a_local_build_has_no_buttons(monkeypatch):
    assert heads(monkeypatch, "", ["book/chapters/impacts"]) == [[]]


@pytest.mark.parametrize(
    "address", ["a-lab/gearpair", "http://github.com/a/b", "https://github.com/a", "https://x.org/a/b"]
)
def test_an_address_of_another_form_is_refused_before_the_build(monkeypatch, address):
    monkeypatch.setenv("GEARPAIR_REPOSITORY", address)
    with pytest.raises(ExtensionError, match=r"GEARPAIR_REPOSITORY must be .* got "):
        launching.setup(SimpleNamespace(connect=lambda *args, **how: None))
