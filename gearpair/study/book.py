"""From source notebooks to the rendered book."""

import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from difflib import get_close_matches
from importlib.metadata import PackageNotFoundError, distribution
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Self

import nbformat
import yaml

from gearpair.study.cache import Cache, library_digest, tree_digest
from gearpair.study.chapters import Chapter, read_chapter
from gearpair.study.claims import claimed
from gearpair.study.errors import StudyError
from gearpair.study.record import versions
from gearpair.study.side_by_side import execute_all
from gearpair.study.variants import Variant, read_variants, variant_page, with_variants

EXECUTED = "book/chapters/"
NOT_SOURCE = ("_build", "tests", "tools", "benchmarks", "dist", "build", "chapters", "__pycache__", "*.egg-info", ".*")
RENDERS = ("sphinx", "jupyter-book", "myst-nb", "sphinx-book-theme", "sphinxcontrib-bibtex", "pydata-sphinx-theme")


@dataclass(frozen=True)
class Book:
    """A checkout, or what ``pip install`` put in place of one: its table of contents, its pages, its notebooks."""

    root: Path

    @classmethod
    def find(cls, root: Path | None = None) -> Self:
        """The book at `root`; without one, of the working directory or a parent of it, else of this package."""
        places = [root] if root else [Path.cwd(), *Path.cwd().parents, Path(__file__).parents[2], *_installed()]
        for place in places:
            if (place / "_toc.yml").is_file() and (place / "notebooks").is_dir():
                return cls(place.resolve())
        raise StudyError(f"no book here: {places[0]} has no _toc.yml beside a notebooks directory")

    @property
    def target(self) -> Path:
        """Where it is built: ``_build`` in the checkout; in the working directory where one may not write there."""
        writable = os.access(self.root, os.W_OK) and self.root not in _installed()
        return (self.root if writable else Path.cwd()) / "_build"

    @property
    def html(self) -> Path:
        """The rendered site."""
        return self.target / "html"

    @property
    def toc(self) -> dict[str, Any]:
        """The table of contents (the one place that lists pages and chapters)."""
        return dict(yaml.safe_load((self.root / "_toc.yml").read_text(encoding="utf-8")))

    @property
    def title(self) -> str:
        """The book's title."""
        return str(yaml.safe_load((self.root / "_config.yml").read_text(encoding="utf-8"))["title"])

    def pages(self) -> list[str]:
        """All pages after the first, in order."""
        return _files(self.toc)

    def chapter_names(self) -> list[str]:
        """Names of the chapters, in the order of the table of contents."""
        return [file.removeprefix(EXECUTED) for file in self.pages() if file.startswith(EXECUTED)]

    def chapters(self) -> list[Chapter]:
        """All chapters, in that order."""
        return [self.chapter(name) for name in self.chapter_names()]

    def chapter(self, name: str) -> Chapter:
        """The chapter called `name`, which may also be the path of a notebook."""
        path = Path(name)
        if path.suffix == ".ipynb" and path.is_file():
            return read_chapter(path)
        names = self.chapter_names()
        if name not in names:
            close = get_close_matches(name, names, 1)
            rest = f"did you mean {close[0]!r}?" if close else f"there are {', '.join(names)}"
            raise StudyError(f"there is no chapter {name!r}; {rest}")
        return read_chapter(self.root / "notebooks" / f"{name}.ipynb")

    def variants(self) -> list[Variant]:
        """The chapters with other parameters that ``book/variants.yml`` declares."""
        return read_variants(self.root / "book" / "variants.yml", self.chapter)


def _installed() -> list[Path]:
    """Where ``pip install`` put the book's sources, as the installed package's list of files tells."""
    try:
        files = distribution("gearpair").files or []
    except PackageNotFoundError:
        return []
    return [Path(str(file.locate())).resolve().parent for file in files if file.name == "_toc.yml"]


def _files(entry: Any) -> list[str]:
    """Every ``file`` of a table of contents, depth first."""
    if isinstance(entry, list):
        return [file for item in entry for file in _files(item)]
    if isinstance(entry, dict):
        return [file for key, value in entry.items() for file in ([value] if key == "file" else _files(value))]
    return []


def need_book_extra() -> None:
    """Refuse to make pages where what renders them is not installed."""
    if find_spec("jupyter_book") is None or find_spec("bs4") is None:
        raise StudyError("pages need the extra 'book': pip install '.[book]' in a checkout of gearpair")


def build_book(book: Book, target: Path | None = None) -> Path:
    """Execute what has changed, render the site in `target` (`Book.target` if not given); return its first page.

    Everything is made beside the last good book, which a failure leaves untouched; what was executed until then is
    kept for the next time. Nothing is rendered where nothing has changed.

    Raises
    ------
    StudyError
        If a chapter fails (naming it, the cell and the error) or the site does not build without warnings.
    """
    need_book_extra()
    target = (target or book.target).resolve()
    html, chapters, stamp = target / "html", target / "chapters", target / "site.json"
    pages: list[Chapter | Variant] = [*book.chapters(), *book.variants()]
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StudyError(f"cannot write to {target}: {error.strerror}; choose another place with -o") from None
    with claimed(html) as staging:
        executed = execute_all(pages, Cache(target / "cache"), book.root / "requirements.lock", staging)
        source = _assemble(book, executed, staging / "source")
        made_from = [tree_digest(source), library_digest(), versions(RENDERS)]
        if html.is_dir() and _read_stamp(stamp) == [made_from, tree_digest(html)]:
            return html / "index.html"
        site = render(source, staging / "site", book)
        _put_in_place(source / EXECUTED, chapters)
        _put_in_place(site, html)
        stamp.write_text(json.dumps([made_from, tree_digest(html)]), encoding="utf-8")
    return html / "index.html"


def _read_stamp(path: Path) -> Any:
    """What the last build was made from and came to; None where that is not told whole."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def _assemble(book: Book, executed: dict[str, tuple[Chapter | Variant, nbformat.NotebookNode]], source: Path) -> Path:
    """A copy of the book's sources with the executed chapters in it, and variants in the table of contents."""
    copy_sources(book.root, source)
    under: dict[str, list[str]] = {}
    for name, (page, notebook) in executed.items():
        if isinstance(page, Variant):
            notebook = variant_page(page, notebook)
            under.setdefault(EXECUTED + page.chapter.name, []).append(EXECUTED + name)
        nbformat.write(notebook, source / EXECUTED / f"{name}.ipynb")
    write_toc(source, with_variants(book.toc, under))
    return source


def copy_sources(root: Path, source: Path) -> None:
    """Copy what the pages are made from to `source`, with room for the executed chapters."""
    own = source.parents[1].resolve()  # where the book is built, which may be below the root
    not_source = shutil.ignore_patterns(*NOT_SOURCE)

    def ignored(directory: str, names: list[str]) -> set[str]:
        return not_source(directory, names) | {name for name in names if Path(directory, name).resolve() == own}

    shutil.copytree(root, source, ignore=ignored)
    (source / EXECUTED).mkdir(parents=True, exist_ok=True)


def write_toc(source: Path, toc: Any) -> None:
    """Write the table of contents of the copied sources."""
    (source / "_toc.yml").write_text(yaml.safe_dump(toc, sort_keys=False), encoding="utf-8")


def render(source: Path, output: Path, book: Book) -> Path:
    """Build the site below `output` from `source`, a copy of the book with its executed chapters; return where it is.

    A warning is an error.
    """
    code, told = run_jupyter_book(source, output, "--warningiserror", "--keep-going")
    if code:
        print(told.replace(str(source), str(book.root)), end="", file=sys.stderr)  # the sources that a user can mend
        raise StudyError("the pages did not build without warnings (they are named above); the last book stays")
    return output / "_build" / "html"


def run_jupyter_book(source: Path, output: Path, *options: str) -> tuple[int, str]:
    """Render the sources; return the exit code and what was said."""
    code = "import sys; from jupyter_book.cli.main import main; sys.exit(main())"
    command = [sys.executable, "-c", code, "build", str(source), "--path-output", str(output), "--all", "--quiet"]
    done = subprocess.run([*command, *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


def _put_in_place(new: Path, old: Path) -> None:
    aside = old.with_name(old.name + ".old")
    shutil.rmtree(aside, ignore_errors=True)
    if old.exists():
        os.replace(old, aside)
    os.replace(new, old)
    shutil.rmtree(aside, ignore_errors=True)
