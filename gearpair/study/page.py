"""One chapter as one web page to hand around: its figures, its style and its mathematics are inside."""

import base64
import mimetypes
import os
import re
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

import nbformat
from bs4 import BeautifulSoup, Tag

from gearpair.study.book import EXECUTED, Book, copy_sources, run_jupyter_book, write_toc
from gearpair.study.chapters import Chapter
from gearpair.study.claims import claimed
from gearpair.study.errors import StudyError
from gearpair.study.execution import execute
from gearpair.study.readable import without_ways_out

MATHJAX = ("sphinx-mathjax-offline", "static/mathjax/tex-svg.js")  # the one of its scripts that loads nothing else
STYLE = (
    "body{margin:0}main{max-width:60rem;margin:2rem auto;padding:0 1rem}img{max-width:100%}.headerlink{display:none}"
)
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
    """`execute` a chapter and write it as one page that needs neither a network nor another file.

    The prose of `book` gives the numbers of the equations that the chapter refers to. References to other pages are
    left as text. A StudyError tells that the chapter failed, or its page did not build.
    """
    with claimed(output) as scratch:
        source = scratch / "source"
        copy_sources(book.root, source)
        notebook = source / EXECUTED / f"{chapter.name}.ipynb"
        executed = execute(chapter, notebook, values, progress=progress)
        prose = [str(book.toc["root"]), *(page for page in book.pages() if not page.startswith(EXECUTED))]
        nbformat.write(without_ways_out(executed, book, prose), notebook)
        write_toc(source, _toc_of_one(book, f"{EXECUTED}{chapter.name}"))
        code, told = run_jupyter_book(source, scratch / "site")
        html = scratch / "site" / "_build" / "html"
        page = html / f"{EXECUTED}{chapter.name}.html"
        if not page.is_file():
            last = (told.strip() or str(code)).splitlines()[-1]
            raise StudyError(f"the page of {chapter.name} did not build: {last}")
        whole = scratch / output.name
        whole.write_text(_whole(page), encoding="utf-8")
        os.replace(whole, output)


def _toc_of_one(book: Book, kept: str) -> dict[str, Any]:
    """A table of contents with all prose and no chapter but `kept`."""
    files = [kept, *(page for page in book.pages() if not page.startswith(EXECUTED))]
    return {"format": "jb-book", "root": book.toc["root"], "chapters": [{"file": file} for file in files]}


def _whole(page: Path) -> str:
    """The article of a rendered page with everything it shows inside."""
    soup = BeautifulSoup(page.read_text(encoding="utf-8"), "html.parser")
    article = soup.find("article") or soup
    assert isinstance(article, Tag)
    for each in article.find_all("script"):
        each.decompose()
    for image in article.find_all("img"):
        image["src"] = _inline(_beside(page, image["src"]))
    for link in article.find_all("a"):
        if not re.match("#|https?:|mailto:", str(link.get("href", "#"))):
            link.unwrap()
    for box in article.select(".admonition.dropdown"):  # a script would fold it; so it folds by itself
        box.name = "details"
        for heading in box.select(".admonition-title")[:1]:
            heading.name = "summary"
    title = soup.find("h1")
    style = "\n".join(_styles(soup, page))
    script = files(MATHJAX[0]).joinpath(MATHJAX[1]).read_text(encoding="utf-8")
    return PAGE.format(
        title=title.get_text().rstrip("#").strip() if title else page.stem,
        style=style + STYLE,
        mathjax=script.replace("</script", "<\\/script"),
        body=article.decode_contents(),
    )


def _styles(soup: BeautifulSoup, page: Path) -> list[str]:
    """The text of the page's style sheets, without what they would fetch."""
    found = []
    for link in soup.find_all("link", rel="stylesheet"):
        path = _beside(page, link["href"])
        if path.is_file():
            text = re.sub(r"@import[^;]*;|@font-face\s*{[^}]*}", "", path.read_text(encoding="utf-8"))
            found.append(re.sub(r"url\((?!['\"]?(?:data:|#))[^)]*\)", "none", text))
    return found


def _beside(page: Path, address: object) -> Path:
    return (page.parent / str(address).partition("?")[0]).resolve()


def _inline(path: Path) -> str:
    kind = mimetypes.guess_type(path.name)[0] or "application/octet-stream"
    return f"data:{kind};base64,{base64.b64encode(path.read_bytes()).decode()}"
