"""A figure of the book opens on a phone at a size at which its words can be read."""

import base64
import io

import pytest
from PIL import Image

from tests.support import ROOT

STATIC = ROOT / "book" / "_static"


@pytest.fixture
def page(tmp_path):
    """A page with one figure as the page builder writes it."""
    drawn = io.BytesIO()
    Image.new("RGB", (1440, 720), "white").save(drawn, "png")
    source = f"data:image/png;base64,{base64.b64encode(drawn.getvalue()).decode()}"
    path = tmp_path / "page.html"
    path.write_text(
        f'<!DOCTYPE html><html lang="en"><head><meta name="viewport" content="width=device-width"><title>One</title>'
        f'<link rel="stylesheet" href="{(STATIC / "book.css").as_uri()}">'
        f'<script src="{(STATIC / "pictures.js").as_uri()}"></script></head><body><figure>'
        f'<a class="reference internal image-reference" href="#whole"><img alt="A wave" src="{source}" '
        f'style="width: 100%;"></a></figure></body></html>',
        encoding="utf-8",
    )
    return path.as_uri()


@pytest.mark.parametrize(("width", "opens"), [(390, True), (1300, False)])
@pytest.mark.slow
def test_a_tap_opens_a_figure_on_a_phone_and_its_page_elsewhere(browser, page, width, opens):
    shown = browser.new_page(viewport={"width": width, "height": 800})
    shown.goto(page)
    shown.locator("figure img").click()
    assert shown.locator("dialog.picture").count() == opens
    assert shown.url.endswith("#whole") != opens
    if opens:
        letters = shown.locator("dialog img").bounding_box()["width"] / 1440 * 22.5  # pixels of nine points
        assert letters > 12.0
        shown.locator("dialog button").click()
        shown.wait_for_function("!document.querySelector('dialog.picture')")
    shown.close()
