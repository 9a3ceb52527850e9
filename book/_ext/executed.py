"""What pages take from the executed chapters, so that it stays true when a chapter is run again.

``{thumbnail} impacts fig-basins`` shows a figure of a chapter in small; ``{claims} F D`` gives the article's items with
their verdicts, as the chapter `reproduction` found them, for the letters named, each with a link to its evidence. The
chapter's own table of verdicts is given the same links.
"""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

import nbformat
from bs4 import BeautifulSoup
from docutils import nodes
from PIL import Image
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective

CHAPTERS = "book/chapters"
THUMBNAILS = f"{CHAPTERS}/thumbnails"  # beside the executed chapters: generated, and not kept
WIDTH = 720  # pixels: sharp on a screen of twice the density
ROW = re.compile(r"(<tr><td[^>]*>(\w+)</td>.*<td[^>]*>)(.*)(</td></tr>)")  # a line of a table: first and last cell
VERDICTS = ("reproduction", "verdict", "decided by")  # the chapter, and two columns of its table
EVIDENCE = {  # the section, below book/, where the items are tested or used
    "model#two-rotors": "M1 M2 M3",
    "model#one-relative-coordinate": "M4",
    "model#the-dimensionless-oscillator": "M6 N3",
    "method#the-flows-derivative": "N2",
    "chapters/stiffness#its-mean": "M5",
    "chapters/tooth_bending#a-tooth-as-a-beam": "K1",
    "chapters/tooth_bending#the-path-of-contact": "K4",
    "chapters/stiffness#the-articles-table": "K3",
    "chapters/stiffness#does-the-choice-matter": "K5 C4",
    "chapters/method#chaos-that-is-not-there": "N1",
    "chapters/reproduction#which-motions-exist-at-all": "K2 F1 F3 F5 F7 F8 F10 F11 D3 D5",
    "chapters/reproduction_appendix#boundary-by-boundary": "F2 F4 F6 D4",
    "chapters/reproduction_appendix#the-damping-table-and-the-length-of-a-transient": "D1 D2",
    "chapters/frequency_sweep#what-each-motion-looks-like": "F9",
    "chapters/frequency_sweep#the-claims": "F12 F13 F14",
    "chapters/frequency_sweep#rising-and-falling": "C1",
    "chapters/damping_sweep#speed-and-damping-together": "D6",
    "chapters/damping_sweep#the-claims-one-by-one": "C2",
    "chapters/impacts#the-criteria": "I1 I2 I3",
    "chapters/impacts#the-plane-of-starts": "I4 C3",
    "chapters/impacts#start-up-history": "I5",
    "chapters/in_service#what-the-article-advises": "C5",
}


class Executed(SphinxDirective):
    """A directive that reads an executed chapter."""

    def cells(self, chapter: str) -> list[nbformat.NotebookNode]:
        path = Path(self.env.srcdir) / CHAPTERS / f"{chapter}.ipynb"
        self.env.note_dependency(str(path))
        if not path.is_file():
            raise self.error(f"chapter {chapter!r} has not been executed: there is no {path.name} in {CHAPTERS}")
        return [cell for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]


class Thumbnail(Executed):
    """A chapter's figure in small, with its alternative text."""

    required_arguments = 2

    def run(self) -> list[nodes.Node]:
        chapter, figure = self.arguments
        for cell in self.cells(chapter):
            shown = cell.metadata.get("mystnb", {})
            pictures = [o.data["image/png"] for o in cell.outputs if "image/png" in o.get("data", {})]
            if shown.get("figure", {}).get("name") == figure and pictures:
                self._shrink(figure, pictures[0])
                alt = shown.get("image", {}).get("alt", "")
                return [nodes.image(uri=f"/{THUMBNAILS}/{figure}.png", alt=alt, classes=["thumbnail"])]
        raise self.error(f"chapter {chapter!r} has no figure {figure!r}")

    def _shrink(self, figure: str, encoded: str) -> None:
        path = Path(self.env.srcdir) / THUMBNAILS / f"{figure}.png"
        path.parent.mkdir(exist_ok=True)
        with Image.open(io.BytesIO(base64.b64decode(encoded))) as picture:
            height = round(picture.height * WIDTH / picture.width)
            picture.convert("RGB").resize((WIDTH, height), Image.Resampling.LANCZOS).save(path)


def rows_of(html: str) -> list[list[str]]:
    """The cells of an HTML table as HTML, row by row."""
    return [[cell.decode_contents() for cell in row(["td", "th"])] for row in BeautifulSoup(html, "html.parser")("tr")]


class Claims(Executed):
    """The article's items whose names begin with one of the letters: what is stated, and what became of it."""

    required_arguments = 1
    optional_arguments = 20

    def run(self) -> list[nodes.Node]:
        chapter, word, by = VERDICTS
        for cell in self.cells(chapter):
            for output in cell.outputs:
                rows = rows_of(output.get("data", {}).get("text/html", ""))
                if rows and word in rows[0]:
                    columns = rows[0].index(word), rows[0].index(by)
                    return [self._table([row for row in rows[1:] if row[0][0] in self.arguments], *columns)]
        raise self.error(f"chapter {chapter!r} has no table of verdicts")

    def _table(self, rows: list[list[str]], word: int, by: int) -> nodes.Node:
        address = partial(self.env.app.builder.get_relative_uri, self.env.docname)
        marks = "".join(
            f'<tr><td>{row[0]}</td><td>{row[1]}</td><td class="verdict {row[word]}">{row[word]}</td>'
            f"<td>{evidence(row[0], row[by], address)}</td></tr>\n"
            for row in rows
        )
        head = "<tr><th>item</th><th>the article</th><th>verdict</th><th>decided by</th></tr>"
        table = f'<table class="table claims"><thead>{head}</thead>\n<tbody>\n{marks}</tbody></table>'
        return nodes.raw("", table, format="html")


def evidence(item: str, by: str, address: Callable[[str], str]) -> str:
    """A link to where an item is tested, or used where nothing decides it; `address` gives that of a page."""
    for section, items in EVIDENCE.items():
        if item in items.split():
            page, _, anchor = section.partition("#")
            text = "nothing; where it is used" if by == "–" else by
            return f'<a class="reference internal" href="{address(f"book/{page}")}#{anchor}">{text}</a>'
    raise ExtensionError(f"item {item} has no section in EVIDENCE")


def link_verdicts(app: Sphinx, doctree: nodes.document, docname: str) -> None:
    """In the chapter that finds the verdicts, too, what decided an item leads there."""
    chapter, word, by = VERDICTS
    if docname != f"{CHAPTERS}/{chapter}":
        return
    address = partial(app.builder.get_relative_uri, docname)
    for node in doctree.findall(nodes.raw):
        rows = rows_of(node.astext())
        if rows and word in rows[0] and rows[0][-1] == by:
            linked = ROW.sub(lambda row: row[1] + evidence(row[2], row[3], address) + row[4], node.astext())
            node.children = [nodes.Text(linked)]


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directives."""
    app.add_directive("thumbnail", Thumbnail)
    app.add_directive("claims", Claims)
    app.connect("doctree-resolved", link_verdicts)
    return {"parallel_read_safe": True}
