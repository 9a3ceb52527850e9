"""An executed notebook to be read as it is: the roles and directives of MyST, which Jupyter shows raw, become text."""

import ast
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nbformat
from nbformat.v4 import new_markdown_cell

from gearpair.study.book import EXECUTED, Book
from gearpair.study.variants import DEFINED

ROLE = re.compile(r"\{([\w:]+)\}`([^`]+)`")  # {name}`text` or {name}`text <target>`
LINK = re.compile(r"\[([^\]]*)\]\((?!https?:|mailto:)([^)\s]+)\)")  # not to the web
ANCHOR = re.compile(r"<a [^>]*href=\"(?!https?:)[^>]*>(.*?)</a>", re.DOTALL)
EQUATION = re.compile(r"^\$\$ \(([\w-]+)\)$", re.MULTILINE)
TARGET = re.compile(r"^\(([\w-]+)\)=\n+", re.MULTILINE)
HEADED = re.compile(r"^\(([\w-]+)\)=\n+#+ (.*)$", re.MULTILINE)
FENCE = re.compile(r"^(`{3,}|:{3,})\{([\w-]+)\} ?([^\n]*)\n((?::[\w-]+:[^\n]*\n)*)(.*?)^\1$", re.MULTILINE | re.DOTALL)
ENTRY = re.compile(r"^@\w+\{([\w-]+),\s*$(.*?)^\}", re.MULTILINE | re.DOTALL)
RECORDS = "application/papermill.record/text/plain"  # of what a chapter has glued


@dataclass(frozen=True)
class Names:
    """What references are replaced by; the ones that are not found stay.

    `own` are the page's labels and `others` those of the book's other pages, as their titles and the labels that are
    there; `titles` are the pages', by the names of their files, and a chapter's has its suffix; `glued` are texts,
    `cited` authors and years. `terms` are words, unless there is a glossary to lead to.
    """

    others: Mapping[str, str]
    titles: Mapping[str, str]
    own: Mapping[str, str]
    glued: Mapping[str, str]
    cited: Mapping[str, tuple[str, str]]
    terms: bool = True

    def in_place(self, text: str) -> str:
        """The text with its roles and links as words."""
        text = ROLE.sub(self._role, text)
        return LINK.sub(self._link, text)

    def _role(self, found: re.Match[str]) -> str:
        role, text = found[1], found[2]
        shown, _, target = text.rstrip(">").rpartition(" <") if text.endswith(">") else ("", "", text)
        if role == "glue:text":
            return self.glued.get(text, found[0])
        if role == "term" and self.terms:
            return shown or text
        if role.startswith("cite"):
            return self._cited(text, inside=role != "cite:t") or found[0]
        if role in ("numref", "eq", "ref"):
            return self.own.get(target, self.others.get(target, found[0]))
        return found[0]

    def _cited(self, keys: str, *, inside: bool) -> str:
        entries = [self.cited.get(key.strip()) for key in keys.split(",")]
        whole = [entry for entry in entries if entry is not None]
        if len(whole) < len(entries):
            return ""
        if inside:
            return f"({'; '.join(f'{author}, {year}' for author, year in whole)})"
        return " and ".join(f"{author} ({year})" for author, year in whole)

    def _link(self, found: re.Match[str]) -> str:
        shown, target = found[1], found[2]
        page = Path(target.partition("#")[0])
        if page.suffix in (".ipynb", ".md", ".rst"):
            title = self.titles.get(page.name if page.suffix == ".ipynb" else page.stem)
            return shown or (f"“{title}”" if title else page.stem)
        label = target.removeprefix("#")
        known = self.own.get(label, self.others.get(label))
        return found[0] if known is None else shown or known


def readable(notebook: nbformat.NotebookNode, book: Book) -> nbformat.NotebookNode:
    """The executed `notebook` as one to be read in Jupyter, away from its book.

    Glued numbers stand in the text, references have numbers or name the page that they lead to, blocks are headed
    text, figures have their captions, and the code that a page folds is folded.
    """
    notebook = nbformat.from_dict(notebook)
    names = _names(notebook, book)
    cells = []
    for cell in notebook.cells:
        if "remove-cell" in cell.metadata.get("tags", []):  # for other pages of the book
            continue
        cells.append(cell)
        if cell.cell_type == "markdown":
            cell.source = _as_text(cell.source, names)
            if not cell.source.strip():
                cells.pop()
            continue
        if "hide-input" in cell.metadata.get("tags", []):
            cell.metadata["jupyter"] = {"source_hidden": True}
        figure = cell.metadata.get("mystnb", {}).get("figure", {})
        if "caption" in figure:
            head = names.own.get(figure.get("name", ""), "Figure")
            cells.append(new_markdown_cell(f"*{head}.* {names.in_place(figure['caption'])}", id=f"{cell.id}-caption"))
    notebook.cells = cells
    return notebook


def without_ways_out(notebook: nbformat.NotebookNode, book: Book, beside: Collection[str]) -> nbformat.NotebookNode:
    """The executed `notebook` as one to be rendered with no other pages of its `book` than those `beside` it.

    References to the others are words, in captions too; the rest is left to what renders it.
    """
    notebook = nbformat.from_dict(notebook)
    names = _names(notebook, book, beside)
    names = Names(names.others, names.titles, {}, {}, {}, terms=False)
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            cell.source = names.in_place(cell.source)
        figure = cell.metadata.get("mystnb", {}).get("figure", {})
        if "caption" in figure:
            figure["caption"] = names.in_place(figure["caption"])
    return notebook


def _names(notebook: nbformat.NotebookNode, book: Book, beside: Collection[str] = ()) -> Names:
    """The names of a notebook that is read away from its `book`, with none but the pages `beside` it."""
    own = _own(notebook)
    others: dict[str, str] = {}
    titles: dict[str, str] = {}
    for file in [str(book.toc["root"]), *book.pages()]:
        text = _page(book, file)
        title = (re.findall("^# (.*)$", text, re.MULTILINE) or [Path(file).name])[0]
        titles[f"{Path(file).name}.ipynb" if file.startswith(EXECUTED) else Path(file).name] = title
        if file not in beside:
            headings = dict(HEADED.findall(text))
            for label in _labels(text):
                others[label] = f"“{headings[label]}”" if label in headings else _elsewhere(label, title)
    bibliography = book.root / "book" / "references.bib"
    cited = _cited(bibliography.read_text(encoding="utf-8")) if bibliography.is_file() else {}
    return Names({k: v for k, v in others.items() if k not in own}, titles, own, glued_texts(notebook), cited)


def _page(book: Book, file: str) -> str:
    """The text of a page; of a chapter with the names of its figures."""
    if not file.startswith(EXECUTED):
        path = book.root / f"{file}.md"
        return path.read_text(encoding="utf-8") if path.is_file() else ""
    chapter = nbformat.read(book.root / "notebooks" / f"{file.removeprefix(EXECUTED)}.ipynb", as_version=4)
    return "\n\n".join(_texts(chapter))


def _texts(notebook: nbformat.NotebookNode, *, hidden: bool = True) -> list[str]:
    """The text cells and the names of figures; unless `hidden`, without those that the page does not show."""
    texts = []
    for cell in notebook.cells:
        if not hidden and "remove-cell" in cell.metadata.get("tags", []):
            continue
        if cell.cell_type == "markdown":
            texts.append(cell.source)
        elif name := cell.metadata.get("mystnb", {}).get("figure", {}).get("name"):
            texts.append(f":name: {name}")
    return texts


def _labels(text: str) -> list[str]:
    return [label for groups in DEFINED.findall(text) for label in groups if label]


def _elsewhere(label: str, title: str) -> str:
    kind, _, name = label.partition("-")
    words = name.replace("-", " ")
    if kind == "eq":
        return f"({words}, in “{title}”)"
    return f"the figure “{words}” of “{title}”" if kind == "fig" else f"“{title}”"


def _own(notebook: nbformat.NotebookNode) -> dict[str, str]:
    """What the labels of the notebook are called in it: numbers of figures and formulas, titles of the rest."""
    text = "\n\n".join(_texts(notebook, hidden=False))
    figures = [label for label in re.findall("^:name: (.*)$", text, re.MULTILINE) if label.startswith("fig-")]
    named = {label: f"Figure {number}" for number, label in enumerate(figures, 1)}
    named |= {label: f"({number})" for number, label in enumerate(EQUATION.findall(text), 1)}
    named |= {label: f"“{heading}”" for label, heading in HEADED.findall(text)}
    for _, kind, title, options, _ in FENCE.findall(text):
        for label in re.findall("^:label: (.*)$", options, re.MULTILINE):
            named[label] = f"“{title}”" if title else kind
    return named


def glued_texts(notebook: nbformat.NotebookNode) -> dict[str, str]:
    """What the code of an executed notebook has glued, by name."""
    found = {}
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            name = output.get("metadata", {}).get("scrapbook", {}).get("name")
            text = output.get("data", {}).get(RECORDS)
            if name and text:
                found[name] = str(ast.literal_eval(text)) if text[0] in "'\"" else text
    return found


def _cited(bibliography: str) -> dict[str, tuple[str, str]]:
    """Authors and year of each entry."""
    found = {}
    for key, fields in ENTRY.findall(bibliography):
        told: dict[str, Any] = dict(re.findall(r"^\s*(\w+)\s*=\s*\{(.*)\},?$", fields, re.MULTILINE))
        people = [re.sub("[{}]", "", person).partition(",")[0] for person in told.get("author", key).split(" and ")]
        who = f"{people[0]} et al." if len(people) > 2 else " and ".join(people)
        found[key] = (who, told.get("year", "no year"))
    return found


def _as_text(source: str, names: Names) -> str:
    """A Markdown cell without what only MyST knows."""
    source = TARGET.sub("", FENCE.sub(_unfolded, source))
    source = EQUATION.sub(lambda found: f"\\tag{{{names.own[found[1]][1:-1]}}}\n$$", source)
    return ANCHOR.sub(r"\1", names.in_place(source))


def _unfolded(found: re.Match[str]) -> str:
    kind, title, body = found[2], found[3], found[5].strip()
    if kind == "solution-end":
        return ""
    if kind == "solution-start":
        return "**Solution**"
    head = f"Exercise: {title}" if kind == "exercise" else title or kind
    return f"**{head}**\n\n{body}\n"
