"""The last touches to a built site: what the page builder and its theme leave wrong, and what no page needs."""

import re
from pathlib import Path

from PIL import Image
from sphinx.application import Sphinx

# MathJax comes with a package, so that a reader's browser fetches nothing; of its 24 MB a page needs these.
MATHJAX_KEPT = ("tex-chtml.js", "output/chtml/fonts", "input/tex/extensions")
# Left lying by the theme and by an extension that only a live kernel would need.
UNUSED = ("webpack-macros.html", "sbt-webpack-macros.html", "sphinx-thebe.js", "sphinx-thebe.css")

# Pattern, what takes its place, and why.
MENDS: tuple[tuple[str, str, str], ...] = (
    (r"<script>const THEBE_JS_URL[^<]*</script>\s*", "", "declared twice, and its address is on another host"),
    (r'<script async="async" src="[^"]*sphinx-thebe\.js[^"]*"></script>\s*', "", "no page has a live kernel"),
    (r"<link[^>]*sphinx-thebe\.css[^>]*/>\s*", "", "the same"),
    (r'<script type="text/x-thebe-config">.*?</script>\s*', "", "the same"),
    (r"<script>kernelName = [^<]*</script>\s*", "", "the same"),
    (r"(<script>var togglebuttonSelector[^<]*</script>)(?=.*?\1)", "", "written twice"),
    (r'<link rel="preload" as="font"[^>]*>\s*', "", "a page opened from a file may not, and says so in the console"),
    (r'<meta name="viewport"[^>]*>\s*(?=.*?<meta name="viewport")', "", "written three times"),
    (
        r'<div class="bd-sidebar-primary bd-sidebar',
        r'<div role="complementary" aria-label="The book" class="bd-sidebar-primary bd-sidebar',
        "no landmark held it",
    ),
    (r'<summary aria-label="Toggle hidden content">', "<summary>", "the label hid the words that are seen"),
    (r'(<button class="btn search-button-field[^>]*) aria-label="Search"', r"\1", "its words are seen: Search Ctrl+K"),
    (r'<summary>(?=<span class="toctree-toggle")', '<summary aria-label="Pages below this one">', "only an icon"),
    (
        r'<p class="(collapsed|expanded) admonition-title">([^<]*)</p>',
        r'<span class="\1 admonition-title">\2</span>',
        "no paragraph fits in a summary",
    ),
    (r"<th([^>]*)></th>", r"<td\1></td>", "a head without words is none"),
    (r' role="doc-biblioentry"', ' role="listitem"', "deprecated, and no child of a list"),
    (r'<section id="(exercise|solution)-content">', "<section>", "one name for every exercise of a page"),
    (r'(id="search-input".*)id="search-input"', r'\1id="search-field"', "the page of the search has the field twice"),
    (r"(Show|Hide) code cell source", r"\1 the code", "said some thirty times a chapter, it is said in plain words"),
    (r"(Show|Hide) code cell outputs?", r"\1 the result", "the same"),
    (
        r'</details>\s*</div>\s*<div class="cell[^"]*tag_hide-input[^"]*">\s*'
        r'<details class="admonition hide above-input">\s*<summary[^>]*>.*?</summary>',
        "",
        "folded cells without a result stand behind one bar, not in a row of bars",
    ),
    (
        r'(?<!class="whole">)(?<=[\s>])(?=[^\s<>]|<span class="math[^>]*>[^<]*</span>[^\s<])'
        r'([^\s<>]*<span class="math[^>]*>[^<]*</span>[^\s<]*)',
        r'<span class="whole">\1</span>',
        "a formula in a line could be parted from its comma",
    ),
    (r'<span class="pre">(?=--?[\w.=-]{1,28}</span>)', '<span class="pre option">', "broken after its hyphen"),
    (r'\s+autocorrect="off"', "", "not yet known to HTML checkers, and nothing is corrected in a search"),
)

LONGEST_TABLE = 24  # rows of a table that still fits on a screen
TABLE = re.compile(r'<div class="output text_html">(?=(\s*<table.*?</table>))', re.DOTALL)
LONG_TABLE = '<div class="output text_html long-table" tabindex="0" role="group" aria-label="A long table; it scrolls">'

FRONT_DOOR = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>{title}</title>
<meta http-equiv="refresh" content="0; url={first}">
</head>
<body><main><h1>{title}</h1><p><a href="{first}">To the first page</a></p></main></body>
</html>
"""


def finish_site(site: Path, first_page: str, title: str) -> None:
    """Mend every page, leave out what none needs, and write the front door that leads to the first page."""
    _trim_mathjax(site / "_static" / "mathjax")
    for name in UNUSED:
        (site / "_static" / name).unlink(missing_ok=True)
    (site / "index.html").write_text(FRONT_DOOR.format(first=f"{first_page}.html", title=title), encoding="utf-8")
    smaller = _shrink_pictures(site / "_images")
    for path in site.rglob("*.html"):
        html = mend(path.read_text(encoding="utf-8"))
        path.write_text(
            re.sub(r"(?<=_images/)[^\"/]+", lambda name: smaller.get(name[0], name[0]), html), encoding="utf-8"
        )


def mend(html: str) -> str:
    """A page with `MENDS` applied, in which a table longer than a screen scrolls by itself, by keyboard too.

    Examples
    --------
    >>> mend('<summary aria-label="Toggle hidden content">')
    '<summary>'
    """
    for pattern, new, _ in MENDS:
        html = re.sub(pattern, new, html, flags=re.DOTALL)
    return TABLE.sub(lambda found: LONG_TABLE if found[1].count("<tr") > LONGEST_TABLE else found[0], html)


def _shrink_pictures(folder: Path) -> dict[str, str]:
    """Store each PNG without loss as WebP, which takes less than half; return the new names by the old."""
    names = {}
    for path in sorted(folder.glob("*.png")):
        smaller = path.with_suffix(".webp")
        with Image.open(path) as picture:
            picture.save(smaller, lossless=True)
        path.unlink()
        names[path.name] = smaller.name
    return names


def _trim_mathjax(mathjax: Path) -> None:
    for path in [*mathjax.rglob("*")]:
        if path.is_file() and not path.relative_to(mathjax).as_posix().startswith(MATHJAX_KEPT):
            path.unlink()


def finish(app: Sphinx, exception: Exception | None) -> None:
    """`finish_site` when the pages are written."""
    if exception is None and app.builder.format == "html":
        finish_site(Path(app.outdir), app.config.root_doc, app.config.html_title)


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("build-finished", finish, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
