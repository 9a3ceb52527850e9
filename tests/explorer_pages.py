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


# What the first page embeds: two pairs at one speed and damping (the baseline's), one rattling and one clattering.
PAIRS = """<link rel="stylesheet" href="../_static/explorer/explorer.css">
<div class="gp-pairs" role="group" aria-label="Two gear pairs at the same speed, moving">
<figure data-motion="mesh_frequency=0.7&amp;x=1&amp;v=0"><canvas role="img" aria-label="A tooth that leaves the drive flank and strikes it again, and never reaches the other"></canvas>
<figcaption>It rattles: one flank is struck</figcaption></figure>
<figure data-motion="mesh_frequency=0.7&amp;x=-2.3&amp;v=1.5"><canvas role="img" aria-label="A tooth that strikes the drive flank and the coast flank in turn"></canvas>
<figcaption>It clatters: both flanks are struck</figcaption></figure>
<button type="button" hidden>Pause</button>
</div>
<script src="../_static/explorer/load.js" data-part="pair" defer></script>
"""


def write_pairs_page(folder: Path) -> Path:
    """A page with the two small pairs alone."""
    page = folder / "pairs.html"
    body = PAIRS.replace("../_static", STATIC.as_uri())
    page.write_text(f'<!DOCTYPE html><html lang="en"><title>Pairs</title><body>{body}</body></html>', encoding="utf-8")
    return page
