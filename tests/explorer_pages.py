"""The explorer's page without the book's theme, for tests in a browser and by hand."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
STATIC = ROOT / "book" / "_static"


def write_page(folder: Path) -> Path:
    """The raw HTML of book/explorer.md as a page of its own, beside the scripts where they are."""
    text = (ROOT / "book" / "explorer.md").read_text(encoding="utf-8")
    (fragment,) = re.findall(r"```\{raw\} html\n(.*?)```", text, flags=re.DOTALL)
    fragment = fragment.replace("../_static", STATIC.as_uri())
    page = folder / "explorer.html"
    page.write_text(
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Explorer</title>'
        f'<meta name="viewport" content="width=device-width"></head><body>{fragment}</body></html>',
        encoding="utf-8",
    )
    return page


def write_pairs_page(folder: Path) -> Path:
    """A page with the two small pairs of book/moving_pairs.html alone."""
    page = folder / "pairs.html"
    body = (ROOT / "book" / "moving_pairs.html").read_text(encoding="utf-8").replace("../_static", STATIC.as_uri())
    page.write_text(f'<!DOCTYPE html><html lang="en"><title>Pairs</title><body>{body}</body></html>', encoding="utf-8")
    return page
