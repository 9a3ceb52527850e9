"""A computer's first hour with gearpair: every kernel compiled once, with a bar that moves."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import Manager, get_context
from queue import Empty
from typing import Any

from tqdm import tqdm

import gearpair as gp

KERNELS = 126  # that the calls below compile; more or fewer only end the bar early or late


def _settling() -> None:
    gp.steady_state(gp.Oscillator())
    gp.basins(gp.Oscillator(damping_ratio=0.1), [0.1 * number for number in range(8)], [0.0])


def _walking() -> None:
    osc = gp.Oscillator()
    gp.trajectory(osc, 1.0, 0.0, 1)
    gp.stroboscopic_map(osc, [0.0, 1.0], 0.0)
    gp.lyapunov_exponents(osc, 1.0, 0.0, 20)


def _orbits() -> None:
    orbit = next(orbit for orbit in gp.find_orbits(gp.Oscillator(), 2, n_starts=50) if orbit.period == 2)
    gp.continue_orbit(orbit, "mesh_frequency", 0.69, 0.71)


def _integrating() -> None:
    for integrator in (gp.methods.Integrator(steps=20), gp.methods.Integrator(rtol=1e-3)):
        integrator.sections([gp.Oscillator()], 1.0, 0.0, 1, 1)


# What several need before one has finished it is compiled by each of them, so the calls are put together by what they
# share; the longest first.
CALLS: tuple[Callable[[], None], ...] = (_settling, _orbits, _walking, _integrating)


def get_ready(*, progress: bool = True) -> str:
    """Call each public entry to the kernels on a small case, on all cores.

    What a process has compiled stays in numba's cache on the disk, where the others find it.

    Parameters
    ----------
    progress : bool
        Show on stderr how many kernels are ready.

    Returns
    -------
    str
        How long it took, in a sentence.
    """
    began = time.perf_counter()
    with (
        Manager() as manager,
        ProcessPoolExecutor(min(len(CALLS), os.cpu_count() or 1), mp_context=get_context("spawn")) as pool,
        tqdm(total=KERNELS, desc="getting ready", unit=" kernels", disable=not progress) as bar,
    ):
        ready = manager.Queue()
        running = [pool.submit(_counted, call, ready) for call in CALLS]
        while not all(each.done() for each in running):
            try:
                ready.get(timeout=0.2)
                bar.update(bar.n < KERNELS)
            except Empty:
                bar.refresh()
        for each in running:
            each.result()
        bar.update(KERNELS - bar.n)
    return f"gearpair is ready: everything is compiled, in {time.perf_counter() - began:.0f} s"


def _counted(call: Callable[[], None], ready: Any) -> None:
    """Make a call, and tell of every kernel that it compiles, or finds compiled."""
    from numba.core import event

    class Told(event.Listener):  # type: ignore[misc]
        def on_start(self, event: Any) -> None:
            pass

        def on_end(self, event: Any) -> None:
            ready.put(1)

    with event.install_listener("numba:compile", Told()):
        call()
