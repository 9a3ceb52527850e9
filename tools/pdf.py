"""The whole book as one PDF: its pages in a row, printed by a browser, so that what is seen is what the site shows.

All pages become one document, in which links between them lead to places in it. It is printed twice: the first time
tells on which page each chapter begins, for the contents.
"""

from __future__ import annotations

import base64
import re
import sys
from collections.abc import Mapping
from pathlib import Path
from urllib.parse import unquote, urlsplit

import click
from bs4 import BeautifulSoup, Tag

from gearpair.study.book import Book
from gearpair.study.cli import main
from gearpair.study.errors import StudyError
from tools.browser import chromium, serve

LEFT_OUT = (
    "a.headerlink, script, style, button, nav, .gp-drive, .gp-minute, .gp-story, "
    ".toggle-hidden, .toctree-wrapper, svg.sd-octicon"
)
EXPLORER = ".gp-explorer"  # moves, so paper gets a picture of it
SHOWN = (
    "document.getElementById('explorer').explorer?.shown && !document.getElementById('explorer').explorer.diagram.busy"
)
STILL = (
    '<figure><img src="{src}" alt="The explorer at the baseline, with the motion and its bifurcation diagram">'
    "<figcaption>The explorer at the baseline. On the screen it answers to sliders and clicks.</figcaption></figure>"
)
LONGEST, BEGINNING, END = 100, 40, 10  # rows: beyond the first number paper gets the beginning and the end of a table
MARGIN = {"top": "18mm", "bottom": "18mm", "left": "18mm", "right": "18mm"}
FOOTER = '<div style="font-size: 8px; width: 100%; text-align: center"><span class="pageNumber"></span></div>'
STYLE = """
html { font-size: 13px; }
body { background: #fff; color: #000; display: block; }
article { break-before: page; padding-bottom: 0 !important; }
h1, h2, h3, h4, figcaption, summary { break-after: avoid; }
figure, tr, .sd-card, .cell_output img, mjx-container { break-inside: avoid; }
.sd-dropdown { break-inside: auto; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; }
img { max-height: 17cm; }
table { font-size: 0.85em; width: 100%; }
td, th { overflow-wrap: break-word; padding: 0.3em 0.4em; }
.long-table td { padding: 0.05em 0.4em; }
.cover { padding-top: 12vh; }
.cover .title { font-size: 2.4rem; }
.contents { list-style: none; padding: 0; }
.contents li { display: flex; gap: 0.5em; margin: 0.35em 0; }
.contents li span { margin-left: auto; }
"""


def print_book(book: Book, output: Path) -> int:
    """Print the built site to one PDF; return the number of pages.

    Raises
    ------
    StudyError
        If the site has not been built, or no browser is installed.
    """
    from pypdf import PdfReader  # an extra, like the browser

    if not (book.html / "index.html").is_file():
        raise StudyError("there is no built book to print; run make book first")
    together = book.html / "_printed.html"
    try:
        numbers: Mapping[str, int] = {}
        still = _picture(book.html)
        for _ in range(2):
            together.write_text(one_document(book, numbers, still), encoding="utf-8")
            _print(book.html, together.name, output)
            reader = PdfReader(output)
            numbers = {
                _key(str(entry.title)): reader.get_destination_page_number(entry) + 1
                for entry in reader.outline
                if not isinstance(entry, list)
            }
        return len(reader.pages)
    finally:
        together.unlink(missing_ok=True)


def _print(site: Path, name: str, output: Path) -> None:
    with serve(site) as origin, chromium() as browser:
        page = browser.new_page()
        page.set_default_timeout(600_000)
        page.goto(f"{origin}/{name}", wait_until="load")
        page.evaluate("() => window.MathJax?.startup?.promise.then(() => null)")
        page.pdf(
            path=str(output), format="A4", margin=MARGIN, outline=True, tagged=True, print_background=True,
            display_header_footer=True, header_template="<span></span>", footer_template=FOOTER,
        )  # fmt: skip


def _picture(site: Path) -> str:
    """What stands on paper for the explorer: it as it opens, its diagram complete; nothing where there is none."""
    found = next(
        (path for path in site.rglob("explorer.html") if EXPLORER[1:] in path.read_text(encoding="utf-8")), None
    )
    if found is None:
        return ""
    with serve(site) as origin, chromium() as browser:
        page = browser.new_page(
            viewport={"width": 1280, "height": 1600}, device_scale_factor=2, reduced_motion="reduce"
        )
        page.goto(f"{origin}/{found.relative_to(site).as_posix()}", wait_until="load")
        page.wait_for_function(SHOWN)
        picture = page.locator(EXPLORER).screenshot()
    return STILL.format(src=f"data:image/png;base64,{base64.b64encode(picture).decode()}")


def one_document(book: Book, numbers: Mapping[str, int], still: str = "") -> str:
    """All pages of the table of contents in one HTML document, after a cover and the contents with page numbers.

    Where the explorer is, `still` stands.
    """
    root = book.toc["root"]
    first = BeautifulSoup((book.html / f"{root}.html").read_text(encoding="utf-8"), "html.parser")
    head = "".join(
        _moved(str(tag), root)
        for tag in first.select("head link, head script")
        if tag.get("rel") == ["stylesheet"] or "MathJax" in tag.text or "mathjax" in str(tag.get("src"))
    )
    pages = {name: _article(book.html, name, still) for name in (root, *book.pages())}
    contents = "".join(
        f'<li><a href="#{_slug(name)}">{_title(article)}</a><span>{numbers.get(_key(_title(article)), "")}</span></li>'
        for name, article in pages.items()
    )
    cover = f'<section class="cover"><p class="title">{book.title}</p><ul class="contents">{contents}</ul></section>'
    articles = "".join(str(article) for article in pages.values())
    return (
        '<!DOCTYPE html><html lang="en" data-theme="light"><head><meta charset="utf-8">'
        f"<title>{book.title}</title>{head}<style>{STYLE}</style></head><body>{cover}{articles}</body></html>"
    )


def _article(site: Path, name: str, still: str) -> Tag:
    """One page's article, its ids and links made to fit one document."""
    soup = BeautifulSoup((site / f"{name}.html").read_text(encoding="utf-8"), "html.parser")
    article = soup.find("article")
    if not isinstance(article, Tag):
        raise StudyError(f"the page {name} has no article to print")
    for tag in article.select(LEFT_OUT):
        tag.decompose()
    for explorer in article.select(EXPLORER):
        explorer.replace_with(BeautifulSoup(still, "html.parser"))
    for summary in article.select("details > summary"):
        folded = summary.find_parent("details")
        assert folded is not None
        if "the code" in summary.text:  # code that the page hides; folded output is shown
            folded.decompose()
            continue
        folded.name = "div"  # a browser would put a word of its own in place of a summary
        if "sd-summary-title" in summary.get_attribute_list("class"):
            summary.name = "h4"  # the title of what unfolds
        else:
            summary.decompose()  # no more than a button
    for table in article.select("table"):
        _shorten(table)
    for tag in article.find_all(True):
        if tag.get("id"):
            tag["id"] = f"{_slug(name)}--{tag['id']}"
        if tag.get("href"):
            tag["href"] = _link(name, str(tag["href"]))
        if tag.get("src") and not str(tag["src"]).startswith("data:"):
            tag["src"] = _from_root(name, str(tag["src"]))
    article["id"] = _slug(name)
    return article


def _shorten(table: Tag) -> None:
    """Leave out the middle of a table that would take many pages, and say so."""
    rows = table.select("tbody > tr")
    if len(rows) <= LONGEST:
        return
    middle = rows[BEGINNING:-END]
    told = f'<tr><td colspan="{len(rows[0].select("td"))}">… {len(middle)} more rows, on the site …</td></tr>'
    middle[0].insert_before(BeautifulSoup(told, "html.parser"))
    for row in middle:
        row.decompose()


def _title(article: Tag) -> str:
    heading = article.find("h1")
    return heading.text.strip() if heading else ""


def _key(title: str) -> str:
    """A title without its spaces: the browser's outline loses the one where a heading is broken into two lines."""
    return "".join(title.split())


def _slug(name: str) -> str:
    return name.replace("/", "-")


def _link(name: str, href: str) -> str:
    """A link of the page `name`, within the one document where it leads to another page."""
    parts = urlsplit(href)
    if parts.scheme or not (parts.path or parts.fragment):
        return href
    target = _from_root(name, unquote(parts.path)).removesuffix(".html") if parts.path else name
    place = "" if "=" in parts.fragment else parts.fragment  # a state of the explorer is no place on paper
    return f"#{_slug(target)}--{place}" if place else f"#{_slug(target)}"


def _from_root(name: str, path: str) -> str:
    if urlsplit(path).scheme:
        return path
    steps: list[str] = []
    for step in [*name.split("/")[:-1], *path.split("/")]:
        if step == "..":
            steps.pop()
        elif step not in {"", "."}:
            steps.append(step)
    return "/".join(steps)


def _moved(tag: str, name: str) -> str:
    return re.sub(r'((?:href|src)=")([^"]+)', lambda found: found[1] + _from_root(name, found[2]), tag)


@click.command()
def pdf() -> None:
    """Print the built book to ``_build/gearpair.pdf``."""
    book = Book.find()
    target = book.root / "_build" / "gearpair.pdf"
    print("Printing the book (a minute or two)", file=sys.stderr)
    print(f"{target}: {print_book(book, target)} pages")


if __name__ == "__main__":
    sys.exit(main(run=pdf, name="tools.pdf"))
