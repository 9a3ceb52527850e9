"""Compile every kernel once, on all cores, so that no chapter and no test has to wait for it.

What a process has compiled stays in numba's disk cache, where the others find it. What several need before one has
finished it is compiled by each of them, so the calls below are put together by what they share.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import gearpair as gp


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


CALLS: tuple[Callable[[], None], ...] = (_settling, _orbits, _walking, _integrating)  # the longest first


def main() -> None:
    """Call each public entry to the kernels on a small case."""
    with ProcessPoolExecutor(min(len(CALLS), os.cpu_count() or 1), mp_context=get_context("spawn")) as pool:
        for done in [pool.submit(call) for call in CALLS]:
            done.result()


if __name__ == "__main__":
    main()
