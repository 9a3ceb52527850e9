"""Zarr stores: the same bits as without, resumed after a kill, on a cluster, refused where they are another's."""

import errno
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from xarray.testing import assert_identical

import gearpair as gp
from gearpair.ensembles import decoded, stores
from tests.support import ROOT

zarr = pytest.importorskip("zarr", reason="the extra 'cluster' is not installed")

KILLS = int(
    os.environ.get("GEARPAIR_KILLS", "3")
)  # a few seconds each: more than a few outside of continuous integration
OSC = gp.Oscillator(mesh_frequency=0.9)
X, V = np.linspace(-3.0, 3.0, 12), np.linspace(-2.0, 2.0, 10)
AXES = {"mesh_frequency": [0.7, 0.8, 0.9, 1.2], "damping_ratio": [0.05, 0.1, 0.2]}
MAP = {"measures": True, "starts": [[0.0, 0.0], [-2.0, 1.0]], "carried": "damping_ratio", "n_exponent": 50}


@pytest.fixture(autouse=True)
def small_blocks(monkeypatch):
    monkeypatch.setattr(stores, "BLOCK_POINTS", 25)


def test_a_stored_plane_is_the_plane(tmp_path):
    plain = gp.basins(OSC, X, V, n_exponent=50)
    stored = gp.basins(OSC, X, V, n_exponent=50, store=tmp_path / "plane")
    assert stored.status.dtype.kind == "i"
    assert zarr.open_group(tmp_path / "plane")["x_min"].chunks == (2, 12)
    assert_identical(decoded(stored), plain)
    assert_identical(decoded(gp.basins(OSC, X, V, n_exponent=50, store=tmp_path / "plane")), plain)


def test_a_stored_map_is_the_map(tmp_path):
    plain = gp.parameter_map(OSC, AXES, **MAP)
    assert_identical(decoded(gp.parameter_map(OSC, AXES, **MAP, store=tmp_path / "map")), plain)


def test_finished_blocks_are_not_computed_again(tmp_path, monkeypatch):
    gp.parameter_map(OSC, AXES, **MAP, store=tmp_path / "map")
    group = zarr.open_group(tmp_path / "map", mode="r+")
    assert group["done"][:].tolist() == [True]
    monkeypatch.setattr(stores, "store_block", lambda *arguments, **options: pytest.fail("computed again"))
    gp.parameter_map(OSC, AXES, **MAP, store=tmp_path / "map")
    group["done"][0] = False
    with pytest.raises(pytest.fail.Exception, match="computed again"):
        gp.parameter_map(OSC, AXES, **MAP, store=tmp_path / "map")


def test_another_ones_store_is_refused_by_name(tmp_path, monkeypatch):
    path = tmp_path / "plane"
    gp.basins(OSC, X, V, n_exponent=50, store=path)
    cases = (
        ("oscillator", lambda: gp.basins(OSC.replace(damping_ratio=0.03), X, V, n_exponent=50, store=path)),
        ("settings", lambda: gp.basins(OSC, X, V, n_exponent=60, store=path)),
        ("x", lambda: gp.basins(OSC, X + 1e-9, V, n_exponent=50, store=path)),
        ("kind", lambda: gp.parameter_map(OSC, AXES, store=path)),
    )
    for name, call in cases:
        with pytest.raises(ValueError, match=f"was made with another {name} "):
            call()
    monkeypatch.setattr(stores, "engine", lambda: "another")
    with pytest.raises(ValueError, match="was made with another engine .*now another"):
        gp.basins(OSC, X, V, n_exponent=50, store=path)
    (tmp_path / "letters").mkdir()
    (tmp_path / "letters" / "a").write_text("dear")
    with pytest.raises(ValueError, match="holds something else"):
        gp.basins(OSC, X, V, store=tmp_path / "letters")
    assert [p.name for p in (tmp_path / "letters").iterdir()] == ["a"]


def test_what_a_store_needs_is_said(tmp_path, monkeypatch):
    with pytest.raises(ValueError, match="a client needs a store"):
        gp.basins(OSC, X, V, client=object())
    with pytest.raises(ValueError, match="a client needs a store"):
        gp.parameter_map(OSC, AXES, client=object())
    with pytest.raises(ValueError, match="must not be the first axis"):
        gp.parameter_map(OSC, AXES, carried="mesh_frequency", store=tmp_path / "map")
    monkeypatch.setattr(stores, "find_spec", lambda name: None)
    with pytest.raises(ImportError, match=r"gearpair\[cluster\]"):
        gp.basins(OSC, X, V, store=tmp_path / "plane")


RUN = """
import sys
import numpy as np
import gearpair as gp
from gearpair.ensembles import stores
from distributed import Client, LocalCluster

if __name__ == "__main__":
    stores.BLOCK_POINTS = 25
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        pids = client.run(__import__("os").getpid)
        print(*pids.values(), flush=True)
        gp.basins(gp.Oscillator(mesh_frequency=0.9), np.linspace(-3, 3, 12), np.linspace(-2, 2, 10), n_exponent=50,
                  store=sys.argv[1], client=client)
"""


@pytest.mark.parametrize("victim", ["worker", "all"])
@pytest.mark.slow
def test_a_cluster_gives_the_same_bits_though_one_is_killed(tmp_path, victim):
    """SIGKILL to a worker, or to all of them and the program; the call then goes on where it was."""
    pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    script, path = tmp_path / "run.py", tmp_path / "plane"
    script.write_text(RUN)
    kill_on_the_way(script, path, victim)
    finished = marks(path)
    stored = gp.basins(OSC, X, V, n_exponent=50, store=path)
    assert_identical(decoded(stored), gp.basins(OSC, X, V, n_exponent=50))
    if victim == "worker":
        assert all(finished)


def marks(path):
    return zarr.open_group(path, mode="r")["done"][:].tolist() if (path / "done").exists() else []


def kill_on_the_way(script, path, victim):
    """Run the script and, once a block is written, kill a worker or everything; wait for what is left of it."""
    environment = os.environ | {"PYTHONPATH": str(ROOT), "NUMBA_NUM_THREADS": "1"}
    run = subprocess.Popen(
        [sys.executable, str(script), str(path)], stdout=subprocess.PIPE, text=True, env=environment
    )  # fmt: skip
    assert run.stdout is not None
    workers = [int(pid) for pid in run.stdout.readline().split()]
    while run.poll() is None and not any(marks(path)):
        time.sleep(0.02)
    for pid in workers[:1] if victim == "worker" else [run.pid, *workers]:
        os.kill(pid, signal.SIGKILL)
    run.wait()


@pytest.mark.slow
def test_again_and_again_a_worker_is_killed_on_the_way(tmp_path, monkeypatch):
    """SIGKILL to one of three workers as soon as a block is written, `KILLS` planes in turn: no bit differs."""
    distributed = pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    monkeypatch.setattr(stores, "BLOCK_POINTS", 40)
    x, v = np.linspace(-3.0, 3.0, 40), np.linspace(-2.0, 2.0, 12)
    plain = gp.basins(OSC, x, v, n_exponent=50)
    unfinished = []

    def kill(path, pid):
        while not any(marks(path)):
            time.sleep(0.005)
        os.kill(pid, signal.SIGKILL)
        unfinished.append(not all(marks(path)))

    monkeypatch.setenv("NUMBA_NUM_THREADS", "1")
    cluster = distributed.LocalCluster(n_workers=3, threads_per_worker=1, dashboard_address=None)
    with cluster, distributed.Client(cluster) as client:
        for k in range(KILLS):
            nanny = cluster.workers[k % 3]
            victim = nanny.pid
            killer = threading.Thread(target=kill, args=(tmp_path / str(k), victim))
            killer.start()
            stored = gp.basins(OSC, x, v, n_exponent=50, store=tmp_path / str(k), client=client)
            killer.join()
            assert_identical(decoded(stored), plain)
            while nanny.pid in (None, victim) or nanny.status.name != "running":
                time.sleep(0.05)
            client.wait_for_workers(3)
    assert all(unfinished)


WRITER = """
import sys
import time
import numpy as np
import gearpair as gp
from gearpair.ensembles import stores

def slow(grid, path, i, **how):
    time.sleep(0.3)  # so that the other one comes while this one is at it
    store_block(grid, path, i, **how)

stores.BLOCK_POINTS, store_block, stores.store_block = 25, stores.store_block, slow
plane = gp.Oscillator(mesh_frequency=0.9), np.linspace(-3, 3, 12), np.linspace(-2, 2, 10)
gp.basins(*plane, n_exponent=50)
print("ready", flush=True)
sys.stdin.readline()
try:
    gp.basins(*plane, n_exponent=50, store=sys.argv[1])
    print("written")
except RuntimeError as told:
    print(told)
"""


@pytest.mark.slow
def test_of_two_that_start_one_store_together_one_is_told(tmp_path):
    """Two processes at once: one writes the store, the other says in a sentence that it is being written."""
    script, path = tmp_path / "write.py", tmp_path / "plane"
    script.write_text(WRITER)
    environment = os.environ | {"PYTHONPATH": str(ROOT), "NUMBA_NUM_THREADS": "1"}
    command = [sys.executable, str(script), str(path)]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True, "env": environment}
    runs = [subprocess.Popen(command, **pipes) for _ in range(2)]
    assert [run.stdout.readline() for run in runs] == ["ready\n"] * 2
    for run in runs:
        run.stdin.write("go\n")
        run.stdin.flush()
    told = sorted(run.communicate(timeout=60)[0] for run in runs)
    assert told == [f"another run is writing the store at {path}: wait for it, or give another path\n", "written\n"]
    assert_identical(decoded(gp.basins(OSC, X, V, n_exponent=50, store=path)), gp.basins(OSC, X, V, n_exponent=50))
    assert sorted(p.name for p in tmp_path.iterdir()) == ["plane", "write.py"]


@pytest.mark.slow
def test_again_and_again_two_start_one_store_together(tmp_path):
    """Two threads at once, in turn: each has the whole plane or is told, and the store is whole for the next."""
    plain = gp.basins(OSC, X, V, n_exponent=50)

    def write(path, together):
        together.wait()
        try:
            return gp.basins(OSC, X, V, n_exponent=50, store=path)
        except RuntimeError as told:
            assert "another run is writing" in str(told)
            return None

    for k in range(6):
        path, together = tmp_path / str(k), threading.Barrier(2)
        with ThreadPoolExecutor(2) as pool:
            both = list(pool.map(write, [path] * 2, [together] * 2))
        whole = [each for each in both if each is not None]
        assert whole
        for each in [*whole, gp.basins(OSC, X, V, n_exponent=50, store=path)]:
            assert_identical(decoded(each), plain)


def test_a_file_system_without_locks_is_told_of(tmp_path, monkeypatch):
    def fails(lock):
        raise OSError(errno.ENOSYS, "Function not implemented")

    monkeypatch.setattr(stores, "held", fails)
    with pytest.warns(UserWarning, match="has no locks: let no other run write this store"):
        gp.basins(OSC, X, V, n_exponent=50, store=tmp_path / "plane")


@pytest.mark.parametrize("name", ["period", "status", "attractor"])
def test_a_lost_block_is_named_and_computed_again(tmp_path, name):
    """Also one of zeros alone, as all statuses are here: zarr would not write it, and reads zeros for what is lost."""
    path, osc = tmp_path / "plane", gp.Oscillator(damping_ratio=0.1)
    plain = gp.basins(osc, X, V, store=path).load()
    assert np.all(plain.status == 0)
    (path / name / "c" / "1" / "0").unlink()
    with pytest.raises(FileNotFoundError, match=rf"at {path} has lost block 1 of {name}: .* or remove {path}/done/c/1"):
        gp.basins(osc, X, V, store=path)
    (path / "done" / "c" / "1").unlink()
    assert_identical(gp.basins(osc, X, V, store=path).load(), plain)


def test_a_lost_block_is_named_before_a_run_goes_on(tmp_path):
    path = tmp_path / "map"
    gp.parameter_map(OSC, AXES, **MAP, store=path)
    zarr.open_group(path, mode="r+").attrs["complete"] = False
    (path / "drive_impacts" / "c" / "0" / "0").unlink()
    with pytest.raises(FileNotFoundError, match="has lost block 0 of drive_impacts"):
        gp.parameter_map(OSC, AXES, **MAP, store=path)


@pytest.mark.parametrize("name", ["x", "attractor_period"])
def test_a_lost_axis_or_table_is_named(tmp_path, name):
    path = tmp_path / "plane"
    gp.basins(OSC, X, V, n_exponent=50, store=path)
    (path / name / "c" / "0").unlink()
    with pytest.raises(FileNotFoundError, match=rf"has lost block 0 of {name}: put .* back, or remove {path}, and"):
        gp.basins(OSC, X, V, n_exponent=50, store=path)
