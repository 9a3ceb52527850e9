"""Running a chapter with papermill, in a kernel that is this very interpreter."""

from __future__ import annotations

import logging
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import nbformat
import papermill
import zmq
from ipykernel.kernelspec import get_kernel_dict
from jupyter_client.kernelspec import KernelSpec
from jupyter_client.manager import AsyncKernelManager
from nbclient.exceptions import DeadKernelError
from papermill.exceptions import PapermillExecutionError

from gearpair.study.chapters import Chapter
from gearpair.study.errors import StudyError


class ThisInterpreter(AsyncKernelManager):
    """Starts the interpreter that runs this command, whatever kernels are installed on the machine.

    A kernel named python3 in a user's own Jupyter directory may belong to another environment, one without gearpair.
    The talk with the kernel is encrypted where that is possible, for the kernel warns when it is not.
    """

    def __init__(self, **settings: Any) -> None:
        super().__init__(transport_encryption="auto" if zmq.has("curve") else "disabled", **settings)

    @property
    def kernel_spec(self) -> KernelSpec:
        """The specification that ipykernel would install for this interpreter."""
        return KernelSpec(**get_kernel_dict())


def execute(
    chapter: Chapter, output: Path, values: Mapping[str, Any] | None = None, *, progress: bool = True
) -> nbformat.NotebookNode:
    """Run `chapter` with `values` in place of its defaults and write the executed notebook to `output`.

    Nothing is written unless every cell has run.

    Parameters
    ----------
    chapter : Chapter
    output : Path
        Where the executed notebook goes; its directory exists.
    values : mapping of str to object, optional
        Parameters to change, as `Chapter.parse` returns them.
    progress : bool
        Whether papermill's progress bar is shown.

    Returns
    -------
    NotebookNode
        The executed notebook.

    Raises
    ------
    StudyError
        Naming the chapter, the cell that failed and the last line of its error.
    """
    logging.getLogger("papermill").setLevel(logging.ERROR)
    with tempfile.TemporaryDirectory(dir=output.parent, prefix=".running-") as scratch:
        partial = Path(scratch) / output.name
        try:
            notebook = papermill.execute_notebook(
                chapter.path,
                partial,
                dict(values or {}),
                kernel_name="python3",
                language="python",
                kernel_manager_class=ThisInterpreter,
                progress_bar={"desc": chapter.name} if progress else False,
            )
        except PapermillExecutionError as error:
            executed = nbformat.read(partial, as_version=4)
            raise StudyError(failures(chapter.name, executed)[0]) from error
        except DeadKernelError as error:
            raise StudyError(f"chapter {chapter.name} failed: its kernel died (out of memory?)") from error
        if problems := failures(chapter.name, notebook):
            raise StudyError(problems[0])
        os.replace(partial, output)
    return notebook


def failures(name: str, notebook: nbformat.NotebookNode) -> list[str]:
    """One sentence for every cell of `notebook` that holds an error output.

    Cells are counted as Jupyter counts them, over code cells, and as an editor does, over all cells; what papermill
    adds to mark a failure or to inject parameters is not counted.
    """
    found, code, position = [], 0, 0
    for cell in notebook.cells:
        tags = cell.metadata.get("tags", [])
        if "papermill-error-cell-tag" in tags:
            continue
        injected = "injected-parameters" in tags
        position += not injected
        code += cell.cell_type == "code" and not injected
        for output in cell.get("outputs", []):
            if output.output_type == "error":
                last = (output.evalue.strip() or "no message").splitlines()[-1]
                place = "the injected parameters" if injected else f"code cell {code} (cell {position} of the notebook)"
                found.append(f"chapter {name} failed in {place}: {output.ename}: {last}")
    return found
