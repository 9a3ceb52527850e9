"""Executed chapters kept under what they were made from: the same content is not computed twice, and never stale."""

import json
import platform
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

import nbformat

import gearpair
from gearpair.study.chapters import Chapter
from gearpair.study.record import versions

LIBRARY = Path(gearpair.__file__).parent
COMPUTES = ("numpy", "scipy", "numba", "matplotlib", "xarray", "pandas", "ipykernel", "myst-nb")
MAKES = ("study/record.py",)  # of the study: what an executed notebook depends on
KEPT = 40  # entries beside those of the last build


@dataclass(frozen=True)
class Cache:
    """Executed notebooks in a directory, named by their content keys; it may be deleted at any time."""

    directory: Path

    def path(self, chapter: Chapter, values: Mapping[str, Any], lock: Path) -> Path:
        """Where the chapter, executed with `values`, is kept."""
        return self.directory / f"{chapter.name}-{content_key(chapter, values, lock)}.ipynb"

    def read(self, path: Path) -> nbformat.NotebookNode | None:
        """The notebook kept at `path`; None where there is none, or none that can be read."""
        try:
            notebook = nbformat.read(path, as_version=4)
            return notebook if "gearpair" in notebook.metadata else None
        except Exception:  # nbformat has many ways to say that a file is broken
            return None

    def seconds(self, name: str) -> float | None:
        """How long the chapter `name` took with its own parameters when it was last executed for the book."""
        for path in reversed(_oldest_first(self.directory.glob(f"{name}-*.ipynb"))):
            notebook = self.read(path)
            if notebook is not None and not notebook.metadata.gearpair.parameters:
                return float(notebook.metadata.gearpair.seconds)
        return None

    def prune(self, used: Iterable[Path]) -> None:
        """Remove all but those `used` and the newest others."""
        for path in _oldest_first(set(self.directory.glob("*.ipynb")) - {*used})[:-KEPT]:
            path.unlink(missing_ok=True)


def _oldest_first(paths: Iterable[Path]) -> list[Path]:
    return sorted((path for path in paths if path.exists()), key=lambda path: path.stat().st_mtime)


def content_key(chapter: Chapter, values: Mapping[str, Any], lock: Path) -> str:
    """A digest of everything that an executed chapter depends on.

    These are the cells of its notebook (without stored outputs), the parameters, the library's sources and data, the
    lock file, and the versions of Python and of the packages that compute and draw.
    """
    notebook = nbformat.read(chapter.path, as_version=4)
    cells = [[cell.cell_type, cell.source, cell.metadata, cell.get("id")] for cell in notebook.cells]
    locked = lock.read_text(encoding="utf-8") if lock.is_file() else ""
    parts = [cells, dict(values), library_digest(), locked, platform.python_version(), versions(COMPUTES)]
    return sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:24]


def library_digest(library: Path = LIBRARY) -> str:
    """A digest of the library's sources and data, and of what in the study executes chapters.

    Without an argument, of the library that is imported here.
    """
    return tree_digest(
        library,
        lambda name: name.endswith((".py", ".json")) and (not name.startswith("study/") or name in MAKES),
    )


def tree_digest(directory: Path, counts: Callable[[str], bool] = lambda name: True) -> str:
    """A digest of every file below `directory` whose name (from there) `counts`, names included."""
    digest = sha256()
    for path in sorted(path for path in directory.rglob("*") if path.is_file()):
        if counts(name := path.relative_to(directory).as_posix()):
            digest.update(name.encode() + b"\0" + sha256(path.read_bytes()).digest())
    return digest.hexdigest()
