"""Ctrl-C ends every call with KeyboardInterrupt, within a second, and leaves nothing half-counted."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

import gearpair as gp
from tests.support import ROOT

CHAOS = "osc = gp.Oscillator(mesh_frequency=1.219)\n"
# What one kernel call does takes some ten seconds: it goes on behind, and must not be there for all that follow.
CALLS = {
    "attractors": "gp.attractors(osc, 300_000)",
    "basin_stability": "gp.ensembles.basin_stability(osc, 300_000)",
    "basins": "gp.basins(osc, np.linspace(-4, 4, 600), np.linspace(-3, 3, 600))",
    "motion_shares": "gp.ensembles.motion_shares(osc, 'damping_ratio', np.linspace(.01, .02, 99), X, X)",
    "continue_attractors": "gp.ensembles.continue_attractors(osc, 'damping_ratio', np.linspace(.01, .02, 99), n=9999)",
    "parameter_map, carried": "gp.parameter_map(osc, MAP, carried='mesh_frequency')",
    "parameter_map, starts": "gp.parameter_map(osc, MAP, starts=[(k, 0) for k in range(50)])",
    "sweep": "gp.sweep(osc, 'mesh_frequency', np.linspace(1.2, 1.3, 20_000))",
    "sweep, restarted": "gp.sweep(osc, 'mesh_frequency', np.linspace(1.2, 1.3, 20_000), seeding='restart')",
    "steady_state": "gp.steady_state(osc, n_watch=4 * 10**7)",
    "survival": "gp.survival(osc, X, 0.0, n_periods=10**8)",
    "range_of": "gp.ensembles.range_of(gp.steady_state(osc), 'mesh_frequency', np.linspace(1.2, 1.3, 20_000))",
    "runge_kutta_sweep": "gp.methods.runge_kutta_sweep(osc, 'mesh_frequency', np.linspace(1.2, 1.3, 9999))",
    "runge_kutta_section": "gp.methods.runge_kutta_section(osc, 1.0, 0.0, 4 * 10**6, n_kept=1)",
    "lyapunov_exponents": "gp.lyapunov_exponents(osc, 1.0, 0.0, 10**10)",
    "trajectory, transient": "gp.trajectory(osc, 1.0, 0.0, 1, n_transient=10**10)",
    "trajectory": "gp.trajectory(osc, 1.0, 0.0, 10**7, samples_per_period=1)",
    "impact_measures": "gp.motion.impact_measures(gp.steady_state(osc), n_periods=4 * 10**6)",
    "stroboscopic_map": "gp.stroboscopic_map(osc, 1.0, 0.0, 4 * 10**7)",
    "carried_sweeps": "gp.ensembles.carried_sweeps(gp.steady_state(osc), 'mesh_frequency', np.arange(1.2, 1.3, 1e-5))",
    "survival_along": "gp.ensembles.survival_along(osc, 'damping_ratio', X[:9] / 500 + .02, X, 0.0, n_periods=10**7)",
    "periodic_orbit": "gp.periodic_orbit(osc, 1.0, 0.0, 10**7)",
    "manifolds": "gp.manifolds(gp.periodic_orbit(osc, 1.00827, -0.33902, 1), length=1e7, max_points=10**8)",
    "find_branches": "gp.find_branches(osc, 'mesh_frequency', 0.5, 1.6, max_period=9)",
    "find_orbits": "gp.find_orbits(osc, 12, n_starts=10**6)",
    "speed_chart": "gp.design.speed_chart(DRIVE, np.linspace(1500.0, 9000.0, 3000), n_starts=12)",
}
SETTING = (
    "import sys, time\nimport numpy as np\nimport gearpair as gp\n" + CHAOS + "X = np.linspace(-4, 4, 200)\n"
    "MAP = {'damping_ratio': np.linspace(.01, .02, 150), 'mesh_frequency': np.linspace(1.2, 1.3, 60)}\n"
    "DRIVE = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,"
    " transmission_error_um=5.0, damping_ratio=0.02)\n"
)
# Python drops an interrupt that falls into a callback of its garbage collector, and tells this hook: press once more.
CHILD = (
    SETTING
    + """
import os, signal, threading
def pressed_again(dropped):
    if dropped.exc_type is KeyboardInterrupt:
        threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT)).start()
    else:
        sys.__unraisablehook__(dropped)
sys.unraisablehook = pressed_again
for line in sys.stdin:
    print("begun", flush=True)
    try:
        result = eval(compile(line, 'call', 'eval'))  # of a text alone, Python would remember the interrupt
    except KeyboardInterrupt:
        print("KeyboardInterrupt", flush=True)
    else:
        print("returned", type(result).__name__, flush=True)
"""
)


def a_second_here():
    """A second; on a machine that is busy with something else, as much longer as work takes there."""
    begun, worked = time.perf_counter(), time.thread_time()
    while time.thread_time() - worked < 0.1:
        pass
    return (time.perf_counter() - begun) / 0.1


@pytest.fixture(scope="module")
def child():
    """A process that makes the calls that it is told."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONWARNINGS": "error"}
    with subprocess.Popen(
        [sys.executable, "-c", CHILD], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment
    ) as process:
        yield process
        process.stdin.close()
        assert process.wait(timeout=20) == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", CALLS)
def test_a_signal_ends_the_call_within_a_second(child, name):
    print(CALLS[name], file=child.stdin, flush=True)
    assert child.stdout.readline() == "begun\n"
    time.sleep(0.6)
    before, begun = a_second_here(), time.perf_counter()
    child.send_signal(signal.SIGINT)
    assert child.stdout.readline() == "KeyboardInterrupt\n"
    waited = time.perf_counter() - begun
    assert waited < max(before, a_second_here())


@pytest.mark.slow
def test_a_process_that_is_interrupted_ends(tmp_path):
    """Nothing under way keeps it: the one long kernel would run for an hour."""
    program = SETTING + "print('begun', flush=True)\ngp.steady_state(osc, n_watch=10**10)"
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=ROOT
    ) as process:
        process.stdout.readline()
        time.sleep(0.6)
        process.send_signal(signal.SIGINT)
        _out, err = process.communicate(timeout=10)
    assert err.rstrip().endswith("KeyboardInterrupt") and process.returncode != 0


@pytest.mark.slow
def test_an_interrupt_while_a_first_call_loads_its_kernels_breaks_none_after_it():
    """Numba hands out what it knows by generators: one that an interrupt ends would fail in every later call."""
    program = """
import os, signal
from numba.core import utils
hand_out, pressed = utils.stream_list, []

def hand_out_pressed(known):
    for part in hand_out(known):
        if not pressed:
            pressed.append(True)
            os.kill(os.getpid(), signal.SIGINT)
            for _ in range(10**5):  # an interrupt is raised between two steps of the program
                pass
        yield part

import gearpair as gp
utils.stream_list = hand_out_pressed
try:
    gp.steady_state(gp.Oscillator())
except KeyboardInterrupt:
    print("KeyboardInterrupt", gp.steady_state(gp.Oscillator()).period)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=ROOT)
    assert done.stdout == "KeyboardInterrupt 2\n", done.stderr


@pytest.mark.slow
def test_a_notebook_s_kernel_is_interrupted_and_goes_on():
    """Jupyter's stop button is a SIGINT to the kernel; its next cell runs."""
    manager_of = pytest.importorskip("jupyter_client.manager")
    manager, client = manager_of.start_new_kernel(cwd=str(ROOT))
    try:
        client.execute_interactive(SETTING, timeout=120)
        stopped, heard = [], []

        def stop():
            stopped.append(time.time())
            manager.interrupt_kernel()

        def hear(message):
            heard.append(message["content"].get("text", ""))

        threading.Timer(1.0, stop).start()
        cell = f"try:\n    {CALLS['basin_stability']}\nexcept KeyboardInterrupt:\n    print(time.time())"
        client.execute_interactive(cell, timeout=60, output_hook=hear)
        assert float("".join(heard)) - stopped[0] < a_second_here()
        assert client.execute_interactive("gp.steady_state(gp.Oscillator())", timeout=60)["content"]["status"] == "ok"
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)


@pytest.mark.slow
def test_a_stored_map_resumes(tmp_path, monkeypatch):
    pytest.importorskip("zarr")
    stores = gp.ensembles.stores
    monkeypatch.setattr(stores, "BLOCK_POINTS", 4)
    osc, x, v = gp.Oscillator(), [0.0, 1.0, 2.0, 3.0], [0.0, 0.5, 1.0]
    calls, original = [], stores.store_block

    def counted(grid, path, i, **how):
        calls.append(i)
        if len(calls) == 2:
            raise KeyboardInterrupt
        original(grid, path, i, **how)

    monkeypatch.setattr(stores, "store_block", counted)
    with pytest.raises(KeyboardInterrupt):
        gp.basins(osc, x, v, store=tmp_path / "plane")
    resumed = gp.ensembles.decoded(gp.basins(osc, x, v, store=tmp_path / "plane"))
    assert calls == [0, 1, 1, 2]
    assert resumed.drop_attrs().equals(gp.basins(osc, x, v).drop_attrs())
