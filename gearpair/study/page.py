"""One chapter as one web page to hand around: its figures, its style and its mathematics are inside."""

from __future__ import annotations

import base64
import mimetypes
import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import nbformat
from bs4 import BeautifulSoup, Tag

from gearpair.study.book import EXECUTED, Book, copy_sources, run_jupyter_book, write_toc
from gearpair.study.chapters import Chapter
from gearpair.study.claims import claimed
from gearpair.study.errors import StudyError
from gearpair.study.execution import execute

MATHJAX = "mathjax/tex-svg.js"  # the one of its scripts that loads nothing else
STYLE = (
    "body{margin:0}main{max-width:60rem;margin:2rem auto;padding:0 1rem}img{max-width:100%}.headerlink{display:none}"
)
LINK = re.compile(r"\[([^\]]*)\]\((?:[./\w-]*/)?([\w-]+)\.ipynb(?:#[\w-]+)?\)")  # to another chapter
PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>{style}</style>
<script>window.MathJax = {{options: {{processHtmlClass: "tex2jax_process|mathjax_process|math|output_area"}}}};</script>
<script>{mathjax}</script>
</head>
<body><main class="bd-article">{body}</main></body>
</html>
"""


def make_page(
    book: Book, chapter: Chapter, output: Path, values: Mapping[str, Any] | None = None, *, progress: bool = True
) -> None:
    """Execute `chapter` and write it as one page that needs neither a network nor another file.

    References to other pages of the book are left as text.

    Parameters
    ----------
    book : Book
        Its prose gives the numbers of the equations that the chapter refers to.
    chapter, values, progress
        As for `execute`.
    output : Path
        The page.

    Raises
    ------
    StudyError
        If the chapter fails, or its page does not build.
    """
    with claimed(output) as scratch:
        source = scratch / "source"
        copy_sources(book.root, source)
        notebook = source / EXECUTED / f"{chapter.name}.ipynb"
        executed = execute(chapter, notebook, values, progress=progress)
        titles = {each.name: each.title for each in book.chapters()}
        for cell in executed.cells:
            if cell.cell_type == "markdown":
                cell.source = LINK.sub(lambda link: link[1] or titles.get(link[2], link[2]), cell.source)
        nbformat.write(executed, notebook)
        write_toc(source, _without_chapters(book.toc, f"{EXECUTED}{chapter.name}"))
        code, told = run_jupyter_book(source, scratch / "site")
        html = scratch / "site" / "_build" / "html"
        page = html / f"{EXECUTED}{chapter.name}.html"
        if not page.is_file():
            raise StudyError(
                f"the page of {chapter.name} did not build: {(told.strip() or str(code)).splitlines()[-1]}"
            )
        whole = scratch / output.name
        whole.write_text(_whole(page, html), encoding="utf-8")
        os.replace(whole, output)


def _without_chapters(toc: Any, kept: str) -> Any:
    """The table of contents without any chapter but `kept`, which is added where it is not in it."""
    files = {"file": kept}
    prose = [file for file in _prose(toc) if file != toc["root"]]
    return {"format": "jb-book", "root": toc["root"], "chapters": [files, *({"file": file} for file in prose)]}


def _prose(entry: Any) -> list[str]:
    if isinstance(entry, list):
        return [file for item in entry for file in _prose(item)]
    if not isinstance(entry, dict):
        return []
    own = [entry["file"]] if "file" in entry and not entry["file"].startswith(EXECUTED) else []
    return own + [file for value in entry.values() for file in _prose(value)]


def _whole(page: Path, html: Path) -> str:
    """The article of a rendered page with everything it shows inside."""
    soup = BeautifulSoup(page.read_text(encoding="utf-8"), "html.parser")
    article = soup.find("article") or soup
    assert isinstance(article, Tag)
    for each in article.find_all("script"):
        each.decompose()
    for image in article.find_all("img"):
        image["src"] = _inline((page.parent / str(image["src"]).partition("?")[0]).resolve())
    for link in article.find_all("a"):
        if not re.match("#|https?:|mailto:", str(link.get("href", "#"))):
            link.unwrap()
    for box in article.select(".admonition.dropdown"):
        _fold(box)
    title = soup.find("h1")
    style = "\n".join(_styles(soup, page))
    mathjax = html / "_static" / MATHJAX  # a book without formulas may do without it
    script = mathjax.read_text(encoding="utf-8") if mathjax.is_file() else ""
    return PAGE.format(
        title=title.get_text().rstrip("#").strip() if title else page.stem,
        style=style + STYLE,
        mathjax=script.replace("</script", "<\\/script"),
        body=article.decode_contents(),
    )


def _fold(box: Tag) -> None:
    """A box that a script would fold becomes one that folds by itself."""
    heading = box.find("p", class_="admonition-title")
    box.name = "details"
    if heading is not None:
        assert isinstance(heading, Tag)
        heading.name = "summary"


def _styles(soup: BeautifulSoup, page: Path) -> list[str]:
    """The text of the page's style sheets, without what they would fetch."""
    found = []
    for link in soup.find_all("link", rel="stylesheet"):
        path = (page.parent / str(link["href"]).partition("?")[0]).resolve()
        if path.is_file():
            text = re.sub(r"@import[^;]*;|@font-face\s*{[^}]*}", "", path.read_text(encoding="utf-8"))
            found.append(re.sub(r"url\((?!['\"]?(?:data:|#))[^)]*\)", "none", text))
    return found


def _inline(path: Path) -> str:
    kind = mimetypes.guess_type(path.name)[0] or "application/octet-stream"
    return f"data:{kind};base64,{base64.b64encode(path.read_bytes()).decode()}"
