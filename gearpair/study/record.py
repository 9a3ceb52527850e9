"""How a chapter was made, written at its end; and an executed notebook without what names the machine."""

import os
import platform
import re
import subprocess
from collections.abc import Mapping
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import nbformat
from nbformat.v4 import new_markdown_cell

from gearpair.parameters import BASELINE
from gearpair.study.chapters import Chapter

TOLD = ("gearpair", "numpy", "scipy", "numba", "matplotlib", "xarray", "papermill")
OWN = "As it is with the chapter's own parameters: "
RECORD = "how-it-was-made"  # the tag and the id of the last cell
KERNEL = {  # what a notebook tells of its kernel: nothing of this machine's
    "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


def circumstances(notebook: Path, seconds: float) -> dict[str, Any]:
    """What is told of a run: its time, the versions, the revision of the checkout and the processor."""
    return {
        "seconds": round(seconds, 1),
        "versions": {"Python": platform.python_version()} | versions(TOLD),
        "revision": revision(notebook.parent),
        "processor": f"{processor()}, {os.cpu_count()} cores",
    }


def versions(packages: tuple[str, ...]) -> dict[str, str]:
    """The versions of those `packages` that are installed."""
    found = {}
    for package in packages:
        with suppress(PackageNotFoundError):
            found[package] = version(package)
    return found


def revision(directory: Path) -> str:
    """The git revision that `directory` is at, and whether something was changed since; none outside a checkout."""
    command = ["git", "-C", str(directory), "describe", "--always", "--abbrev=12", "--dirty= with changes"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError:
        return "none"
    return done.stdout.strip() or "none"


def processor() -> str:
    """The processor's name as the system gives it."""
    with suppress(OSError):
        if name := re.search("^model name.*: (.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE):
            return name[1].strip()
    return platform.processor() or platform.machine()


def recorded(
    notebook: nbformat.NotebookNode, chapter: Chapter, values: Mapping[str, Any], made: Mapping[str, Any]
) -> nbformat.NotebookNode:
    """The executed `notebook` with how it was made at its end.

    Times of the cells, directories and whatever was written to stderr are taken out: readers can download it, and
    what is left is the same at every run but for the record, which stays in the cell and in ``metadata.gearpair``;
    there ``warned`` counts, from 0, the code cells that wrote to stderr.
    """
    ran = [cell for cell in notebook.cells if cell.cell_type == "code" and not _injected(cell)]
    warned = [number for number, cell in enumerate(ran) if any(out.get("name") == "stderr" for out in cell.outputs)]
    notebook.metadata = nbformat.from_dict(
        {
            **KERNEL,
            "gearpair": {**made, "chapter": chapter.name, "parameters": dict(values), "warned": warned},
        }
    )
    for cell in notebook.cells:
        for key in ("papermill", "execution"):
            cell.metadata.pop(key, None)
        if _injected(cell):
            cell.id = "injected-parameters"
        if cell.cell_type == "code":
            cell.outputs = [output for output in cell.outputs if output.get("name") != "stderr"]
    cell = new_markdown_cell(_record(chapter, values, made), id=RECORD, metadata={"tags": [RECORD]})
    notebook.cells = [each for each in notebook.cells if RECORD not in each.metadata.get("tags", [])] + [cell]
    return notebook


def changed(chapter: Chapter, values: Mapping[str, Any]) -> dict[str, Any]:
    """Those of the `values` that are not the chapter's own."""
    return {name: value for name, value in values.items() if value != chapter.defaults.get(name)}


def without_baseline(
    notebook: nbformat.NotebookNode, chapter: Chapter, values: Mapping[str, Any]
) -> nbformat.NotebookNode:
    """The `notebook` without what speaks of the chapter's own parameters, where a value is another.

    Text cells with the tag go; a figure's description for those who do not see it says of what it is.
    """
    if changed(chapter, values):
        notebook.cells = [cell for cell in notebook.cells if not speaks_of_the_baseline(cell)]
        for cell in notebook.cells:
            image = cell.metadata.get("mystnb", {}).get("image", {})
            if "alt" in image:
                image["alt"] = f"{OWN}{image['alt']}"
    return notebook


def speaks_of_the_baseline(cell: nbformat.NotebookNode) -> bool:
    """Whether a cell is text that holds for the chapter's own parameters and need not for others."""
    return cell.cell_type == "markdown" and BASELINE in cell.metadata.get("tags", [])


def _injected(cell: nbformat.NotebookNode) -> bool:
    """Whether papermill put the cell in, to set parameters."""
    return "injected-parameters" in cell.metadata.get("tags", [])


def _record(chapter: Chapter, values: Mapping[str, Any], made: Mapping[str, Any]) -> str:
    others = ", ".join(f"`{name} = {value!r}`" for name, value in changed(chapter, values).items())
    rows = {
        "parameters": f"{others}; the others as at the head" if others else "as at the head",
        "versions": ", ".join(f"{name} {number}" for name, number in made["versions"].items()),
        "revision": made["revision"],
        "run time": f"{made['seconds']:.0f} s",
        "processor": made["processor"],
        "run it yourself": "`pip install` a checkout of gearpair (`pip install .` in it), then run this notebook",
    }
    table = "\n".join(f"| {name} | {text} |" for name, text in rows.items())
    return f":::{{admonition}} How this page was made\n:class: dropdown\n\n| | |\n|---|---|\n{table}\n:::"
