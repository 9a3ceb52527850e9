"""A run leaves its output and nothing else, however it ends."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import nbformat
import pytest

from gearpair import _locks
from gearpair.study.claims import claimed
from gearpair.study.cli import main
from gearpair.study.errors import StudyError
from tests.support import ROOT
from tests.support.notebooks import write_notebook

WAIT = "import os, pathlib, time\npathlib.Path(started).write_text(str(os.getpid()))\ntime.sleep(seconds)"
PATIENCE = 300.0  # what hangs is stopped; nothing is measured


@pytest.fixture
def waiting(small_book, tmp_path):
    """Start a run whose kernel writes its process id to `started` and then sleeps for as long as is asked."""
    started, processes = tmp_path / "started", []

    def start(seconds, command=None):
        parameters = f"started: str = {str(started)!r}  # a file\nseconds: float = {seconds}  # of sleep"
        write_notebook(small_book / "notebooks" / "small.ipynb", WAIT, parameters=parameters)
        words = [command] if command else ["run", "small", "-o", "out.ipynb"]
        command = [sys.executable, "-m", "gearpair", "--root", str(small_book), *words]
        process = subprocess.Popen(
            command,
            cwd=tmp_path,
            env={
                **os.environ,
                "PYTHONPATH": str(ROOT),
                "JUPYTER_RUNTIME_DIR": str(tmp_path / "jupyter"),
            },
            stderr=subprocess.PIPE,
            text=True,
        )
        processes.append(process)
        return process

    def kernel():
        until(lambda: started.exists() and started.read_text())
        return int(started.read_text())

    yield start, kernel
    for process in processes:
        process.kill()
        process.communicate()


def until(condition):
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.05)


def alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def left(directory):
    """What is there beside the checkout and the file of the kernel; Jupyter's own directory is not to be used."""
    return sorted(path.name for path in directory.iterdir() if path.name not in ("checkout", "started"))


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
@pytest.mark.slow
def test_a_stopped_run_stops_its_kernel_and_leaves_nothing(waiting, tmp_path, number):
    start, kernel = waiting
    run = start(3600)
    pid = kernel()
    assert left(tmp_path) == [".out.ipynb.running"]
    run.send_signal(number)
    stderr = run.communicate(timeout=PATIENCE)[1]
    assert run.returncode == 130
    assert stderr.splitlines()[-1] == "gearpair: stopped"
    assert left(tmp_path) == []
    until(lambda: not alive(pid))


@pytest.mark.slow
def test_a_stopped_build_stops_its_kernels_and_leaves_nothing(waiting, small_book):
    start, kernel = waiting
    run = start(3600, "book")
    pid = kernel()
    run.terminate()
    assert run.communicate(timeout=PATIENCE)[1].splitlines()[-1] == "gearpair: stopped"
    assert run.returncode == 130
    assert [path.name for path in (small_book / "_build").rglob("*")] == ["cache"]
    until(lambda: not alive(pid))


@pytest.mark.slow
def test_what_a_killed_run_left_is_cleared_by_the_next_of_the_same_output(waiting, tmp_path):
    start, kernel = waiting
    run = start(3600)
    pid = kernel()
    run.kill()
    run.wait()
    assert left(tmp_path) == [".out.ipynb.running"]
    until(lambda: not alive(pid))  # the kernel notices by itself
    again = start(0)
    again.communicate(timeout=PATIENCE)
    assert again.returncode == 0
    assert left(tmp_path) == ["out.ipynb"]


@pytest.mark.slow
def test_two_runs_to_one_output_do_not_mix(waiting, tmp_path):
    start, kernel = waiting
    first = start(3600)
    kernel()
    second = start(0)
    stderr = second.communicate(timeout=PATIENCE)[1]
    assert second.returncode == 1
    sentence = "gearpair: another run is writing out.ipynb; wait for it, or choose another output"
    assert stderr.splitlines()[-1] == sentence
    assert first.poll() is None
    assert left(tmp_path) == [".out.ipynb.running"]


def test_a_claim_is_one_at_a_time_and_cleared_of_what_was_left(tmp_path):
    output = tmp_path / "out"
    (tmp_path / ".out.running" / "old").mkdir(parents=True)
    with claimed(output) as scratch:
        assert [path.name for path in scratch.iterdir()] == ["lock"]
        with pytest.raises(StudyError, match="another run is writing"), claimed(output):
            pass
        with claimed(tmp_path / "other"):
            pass
        assert scratch.is_dir()
    assert left(tmp_path) == []
    with claimed(output):
        pass


def test_a_claim_that_was_cleared_before_it_was_locked_is_made_again(tmp_path, monkeypatch):
    """Another run may end between the opening of the lock and the locking."""
    lock, cleared = _locks._lock, []

    def slow_lock(descriptor):
        if not cleared:
            cleared.append(shutil.rmtree(tmp_path / ".out.running"))
        lock(descriptor)

    monkeypatch.setattr(_locks, "_lock", slow_lock)
    with claimed(tmp_path / "out") as scratch:
        assert cleared and (scratch / "lock").exists()


def test_a_place_that_cannot_be_written_to_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with (
        pytest.raises(StudyError, match="cannot write beside .*/out: .*; choose another output"),
        claimed(tmp_path / "file" / "out"),
    ):
        pass


@pytest.mark.slow
def test_a_run_writes_nothing_into_the_checkout(small_book, tmp_path, monkeypatch):
    """So that a checkout that is read-only will do."""
    before = {path: path.stat().st_mtime_ns for path in sorted(small_book.rglob("*"))}
    monkeypatch.chdir(tmp_path)
    assert main(["--root", str(small_book), "run", "small", "--quiet"]) == 0
    assert {path: path.stat().st_mtime_ns for path in sorted(small_book.rglob("*"))} == before
    assert left(tmp_path) == ["small-run.ipynb"]


def test_an_executed_chapter_ends_with_how_it_was_made_and_names_no_directory(small_book, tmp_path):
    write_notebook(small_book / "notebooks" / "small.ipynb", "import warnings\nwarnings.warn('noise')\nprint(a)")
    output = tmp_path / "out.ipynb"
    assert main(["--root", str(small_book), "run", "small", "-p", "a", "0.5", "-o", str(output), "--quiet"]) == 0
    text = output.read_text()
    assert str(tmp_path) not in text
    assert "ipykernel_" not in text
    last = nbformat.reads(text, as_version=4).cells[-1].source
    for told in ("`a = 0.5`; the others as at the head", "numba ", "| revision | ", "| run time | ", "| processor | "):
        assert told in last
