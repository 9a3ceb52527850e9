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
