"""Compiled kernels are found again by the next process, and never run stale."""

import os
import shutil
import subprocess
import sys

import pytest

from tests.support import ROOT

pytestmark = pytest.mark.slow
FLOW = ROOT / "gearpair" / "_flow"
# `count_cells` stands in cells.py; the rate it divides by comes from closed_form.py.
COUNT = """
import numpy as np
from flow.cells import Coefficients, count_cells
p = Coefficients(0.1, 0.2, 0.0, 0.02, 0.02, 2 * np.pi, np.array([0.0, 1.0]), np.array([1.0]), np.empty((0, 3)), 1)
print(count_cells(p, 0), sum(count_cells.stats.cache_hits.values()))
"""


@pytest.fixture
def copied(tmp_path):
    """A copy of the kernels' package, without its cache, and a runner of a process that counts cells with it."""
    shutil.copytree(FLOW, tmp_path / "flow", ignore=shutil.ignore_patterns("__pycache__"))
    environment = {k: v for k, v in os.environ.items() if not k.startswith("NUMBA")}

    def run(before="", **variables):
        done = subprocess.run(
            [sys.executable, "-c", before + COUNT],
            cwd=tmp_path,
            env=environment | variables,
            capture_output=True,
            text=True,
            check=True,
        )
        count, hits = map(int, done.stdout.split())
        return (count, hits, done.stderr) if before else (count, hits)

    return tmp_path / "flow", run


def edit(path, old, new):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def without_a_place(flow):
    """Variables with which no cache can be made for the copy in `flow`."""
    (flow / "__pycache__").write_text("")
    nowhere = str(flow / "closed_form.py" / "cache")
    return {"HOME": nowhere, "XDG_CACHE_HOME": nowhere, "PYTHONDONTWRITEBYTECODE": "1"}


def test_an_edited_callee_in_another_file_is_seen_and_an_unchanged_one_is_not_compiled_again(copied):
    flow, run = copied
    assert run() == (11, 0)  # 2 pi / 0.6 widths of a cell
    assert run() == (11, 1)
    edit(flow / "closed_form.py", "return max(omega, root)", "return 9.0 * (omega + root)")
    assert run() == (110, 0)
    assert run() == (110, 1)
    edit(flow / "closed_form.py", "return 9.0 * (omega + root)", "return max(omega, root)")
    assert run() == (11, 1)


def test_without_a_place_for_a_cache_the_kernels_run_all_the_same(copied):
    """Neither the package's directory nor the user's can be made: both paths lead through a file."""
    flow, run = copied
    places = without_a_place(flow)
    assert run(**places) == (11, 0)
    assert run(**places) == (11, 0)


def test_a_package_that_cannot_be_written_to_is_cached_for_the_user(copied, tmp_path):
    flow, run = copied
    (flow / "__pycache__").write_text("")
    places = {"HOME": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path / "user"), "PYTHONDONTWRITEBYTECODE": "1"}
    assert run(**places) == (11, 0)
    assert run(**places) == (11, 1)
    edit(flow / "closed_form.py", "return max(omega, root)", "return 9.0 * (omega + root)")
    assert run(**places) == (110, 0)


OTHER_NUMBAS = {
    "no class of that name": "Cache.__init__ = lambda self, function: None; del caching.IndexDataCacheFile",
    "no cache at that name": "Dispatcher.enable_caching = lambda self: None",
    "another kind of cache file": "Cache.__init__ = lambda self, function: vars(self).update(_cache_file=self)",
    "other arguments": "File.__init__ = lambda self, *, cache_path, filename_base, source_stamp: None",
}
PRELUDE = """
import warnings
from numba.core import caching
from numba.core.caching import Cache, IndexDataCacheFile as File
from numba.core.dispatcher import Dispatcher
warnings.simplefilter("always")
"""


@pytest.mark.parametrize("change", OTHER_NUMBAS.values(), ids=OTHER_NUMBAS.keys())
def test_with_another_numba_the_kernels_run_uncached_and_say_so_once(copied, change):
    flow, run = copied
    count, hits, stderr = run(PRELUDE + change)
    assert (count, hits) == (11, 0)
    assert stderr.count("RuntimeWarning: this numba keeps compiled code in another way") == 1
    assert not list(flow.rglob("*.nbi"))


def test_a_second_process_compiles_nothing():
    work = (
        "import gearpair as gp; from gearpair._flow import settle, walk\n"
        "gp.steady_state(gp.Oscillator()); gp.stroboscopic_map(gp.Oscillator(), [0.0, 1.0], 0.0)\n"
    )
    check = "assert not walk.walk_starts.stats.cache_misses and not settle.settle_lanes.stats.cache_misses"
    subprocess.run([sys.executable, "-c", work], check=True)
    assert subprocess.run([sys.executable, "-c", work + check]).returncode == 0


@pytest.mark.parametrize("cached", [True, False])
def test_kernels_are_made_ready_in_a_thread_that_ctrl_c_does_not_end(copied, cached):
    flow, run = copied
    watched = """
import sys, threading
make_ready = Dispatcher.compile
def told(self, signature):
    print("in the main thread" if threading.current_thread() is threading.main_thread() else "aside", file=sys.stderr)
    return make_ready(self, signature)
Dispatcher.compile = told
"""
    count, _hits, stderr = run(PRELUDE + watched, **({} if cached else without_a_place(flow)))
    assert count == 11
    assert {*stderr.split("\n")} - {""} == {"aside"}
