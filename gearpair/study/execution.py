"""Running a chapter with papermill, in a kernel that is this very interpreter."""

import logging
import os
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import nbformat
import papermill
import zmq
from ipykernel.kernelspec import get_kernel_dict
from jupyter_client.kernelspec import KernelSpec
from jupyter_client.manager import AsyncKernelManager
from nbclient.exceptions import DeadKernelError
from papermill.engines import NBClientEngine, papermill_engines
from papermill.exceptions import PapermillExecutionError
from traitlets.config import Config

from gearpair.parameters import LEAVES_OUT
from gearpair.study.chapters import Chapter
from gearpair.study.claims import claimed
from gearpair.study.errors import StudyError
from gearpair.study.record import circumstances, recorded, without_baseline

REFRESH = 10.0  # seconds between two signs of life
PATIENCE = 120  # seconds for what a finished cell printed to arrive; the 4 of nbclient fail on a busy machine


class ThisInterpreter(AsyncKernelManager):
    """Starts the interpreter that runs this command, whatever kernels are installed on the machine.

    A kernel named python3 in a user's own Jupyter directory may belong to another environment, one without gearpair.
    """

    @property
    def kernel_spec(self) -> KernelSpec:
        """The specification that ipykernel would install for this interpreter."""
        return KernelSpec(**get_kernel_dict(), env={LEAVES_OUT: "1"})


class LivelyEngine(NBClientEngine):  # type: ignore[misc]
    """papermill's engine, whose bar shows the time also while one cell runs long."""

    @classmethod
    def execute_managed_notebook(cls, nb_man: Any, kernel_name: str, **settings: Any) -> Any:
        """Run the notebook."""
        bar, over = getattr(nb_man, "pbar", None), threading.Event()

        def refresh() -> None:
            while bar is not None and not over.wait(REFRESH):
                bar.refresh()

        thread = threading.Thread(target=refresh, daemon=True)
        thread.start()
        try:
            return super().execute_managed_notebook(nb_man, kernel_name, **settings)
        finally:
            over.set()
            thread.join()


papermill_engines.register("lively", LivelyEngine)


def execute(
    chapter: Chapter,
    output: Path,
    values: Mapping[str, Any] | None = None,
    *,
    progress: bool = True,
    last: Callable[[nbformat.NotebookNode], nbformat.NotebookNode] = lambda notebook: notebook,
) -> nbformat.NotebookNode:
    """Run `chapter` with `values` in place of its defaults and write the executed notebook to `output`.

    Nothing is written unless every cell has run, and nothing else stays: not when the run is stopped, and after a
    kill not beyond the next run of the same output.

    `values` are the parameters to change, as `Chapter.parse` returns them; the directory of `output` exists. The
    notebook that is returned, too, ends with how it was made, and where a parameter is not the chapter's own it has
    lost the text cells that speak of those. `progress` shows papermill's bar; `last` has the last word on the notebook.

    Raises
    ------
    StudyError
        Naming the chapter, the cell that failed and the last line of its error; also if another run is at `output`.
    """
    values = dict(values or {})
    logging.getLogger("papermill").setLevel(logging.ERROR)
    with claimed(output) as scratch:
        partial = scratch / output.name
        # The file with the kernel's addresses is cleared with the rest. The talk with the kernel is encrypted where
        # that is possible, for the kernel warns when it is not.
        kernel = {
            "connection_file": str(scratch.resolve() / "kernel.json"),
            "transport_encryption": "auto" if zmq.has("curve") else "disabled",
        }
        began = time.perf_counter()
        try:
            notebook = papermill.execute_notebook(
                chapter.path,
                partial,
                values,
                engine_name="lively",
                kernel_name="python3",
                language="python",
                iopub_timeout=PATIENCE,
                kernel_manager_class=ThisInterpreter,
                config=Config(ThisInterpreter=kernel),
                shutdown_kernel="immediate",  # a stop does not wait for a cell
                progress_bar={"desc": chapter.name} if progress else False,
            )
        except PapermillExecutionError as error:
            executed = nbformat.read(partial, as_version=4)
            raise StudyError(failures(chapter.name, executed)[0]) from error
        except DeadKernelError as error:
            raise StudyError(f"chapter {chapter.name} failed: its kernel died (out of memory?)") from error
        if problems := failures(chapter.name, notebook):
            raise StudyError(problems[0])
        notebook = recorded(notebook, chapter, values, circumstances(chapter.path, time.perf_counter() - began))
        notebook = last(without_baseline(notebook, chapter, values))
        nbformat.write(notebook, partial)
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
