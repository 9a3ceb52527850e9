"""Kernels that are copies of one process: each is as good as a new one, and knows nothing of the others."""

import sys

import pytest
from nbclient import NotebookClient
from nbformat.v4 import new_code_cell, new_notebook

from tests.teach import conftest  # noqa: F401  (puts the course's modules on the path)

from kernel_nursery import NurseryKernelManager, nursery  # noqa: E402  isort: skip

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere every kernel is a new process")
LOOK = """
import os, random, signal, sys
import numpy as np
import gearpair, helper
print(os.getppid(), os.getcwd(), gearpair.changed if hasattr(gearpair, "changed") else "unchanged", helper.here)
print(np.random.rand(), random.random())
print("kernel_nursery" in sys.modules, any(path.endswith("assignments") for path in sys.path))
gearpair.changed = "changed"
os.environ["CHANGED"] = "yes"
"""


@pytest.fixture
def run(tmp_path):
    """What the cells of a notebook print in a kernel of their own; the rest of their outputs by type."""
    (tmp_path / "helper.py").write_text("here = 'beside the notebook'")

    def run(*cells):
        notebook = new_notebook(cells=[new_code_cell(cell) for cell in cells])
        resources = {"metadata": {"path": str(tmp_path)}}
        NotebookClient(notebook, resources=resources, kernel_manager_class=NurseryKernelManager).execute()
        outputs = [output for cell in notebook.cells for output in cell.outputs]
        printed = "".join(output.text for output in outputs if output.output_type == "stream")
        return printed.splitlines(), [output.output_type for output in outputs]

    return run


def test_a_kernel_is_a_copy_that_no_other_kernel_has_touched(run, tmp_path):
    (first, drawn, apart), _ = run(LOOK)
    (second, drawn_then, _), _ = run(LOOK)
    assert first == second == f"{nursery().pid} {tmp_path} unchanged beside the notebook"
    assert not set(drawn.split()) & set(drawn_then.split())
    assert apart == "False False"


def test_a_figure_is_shown_as_in_a_new_kernel(run):
    assert run("import matplotlib.pyplot as plt\nplt.plot([1, 2]);")[1] == ["display_data"]


def test_without_the_nursery_a_kernel_is_a_new_process(run):
    gone = nursery()
    gone.kill()
    gone.wait()
    assert run("import os; print(os.getppid())")[0] != [str(gone.pid)]
    nursery.cache_clear()
