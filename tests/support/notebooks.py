"""Small chapters to run, and to break."""

from pathlib import Path
from typing import Any

import nbformat
import numpy as np
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

import gearpair as gp
from tests.support import ROOT

PARAMETERS = "a: float = 0.116  # stiffness added in double contact"
MEAN = "import gearpair as gp\nprint(f'{gp.StiffnessWave.rectangular(a=a).mean:.4f}')"


def write_notebook(path: Path, *code: str, parameters: str = PARAMETERS, tags: tuple[str, ...] = ("parameters",)):
    """A chapter with a title, a parameters cell and the given code cells."""
    cells = [new_markdown_cell("# A small chapter"), new_code_cell(parameters, metadata={"tags": list(tags)})]
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3"}, "language_info": {"name": "python"}}
    notebook = new_notebook(metadata=kernel, cells=[*cells, *map(new_code_cell, code)])
    nbformat.write(notebook, path)
    return path


def run_cell(chapter: str, cell: str, **names) -> dict[str, Any]:
    """The names after one cell of a chapter, run by itself on the results that it is given by `names`."""
    notebook = nbformat.read(ROOT / "notebooks" / f"{chapter}.ipynb", as_version=4)
    (source,) = (each.source for each in notebook.cells if each.get("id") == cell)
    known = {"np": np, "gp": gp, **names}
    exec(source, known)
    return known


def glued(chapter: str, cell: str, **names) -> dict[str, str]:
    """What one cell of a chapter glues into the text; it is run as by `run_cell`."""
    texts: dict[str, str] = {}
    run_cell(chapter, cell, glue=lambda name, text, display: texts.update({name: text}), **names)
    return texts
