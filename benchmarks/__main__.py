"""Print what the engine costs on this machine; exit with an error where its accuracy, never its time, falls short."""

from __future__ import annotations

import os
import platform
import resource
import sys
import time
from collections.abc import Callable

import numpy as np
from numba import config

import gearpair as gp
from benchmarks.methods import all_methods
from tests.oscillators import degenerate_cases
from tests.reference import mpmath_period

FREQUENCIES = (0.7, 0.95, 1.219, 1.6)
ROUNDS = 9
POINTS = 40
ORDINARY, DEGENERATE = 1e-13, 1e-11  # the promised one-period errors; the first times the map's amplification


def seconds(work: Callable[[], object]) -> float:
    """Wall time of one call."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def section(osc: gp.Oscillator, n: int) -> np.ndarray:
    """Section points (n, 2) of the motion after its transient."""
    motion = gp.trajectory(osc, 1.0, 0.0, n - 1, n_transient=1000, samples_per_period=1)
    return np.stack([motion.x, motion.v], axis=1)


def compare_methods() -> None:
    """Cost and largest one-period error of every method at Omega = 1.219 (chaos), timed in interleaved rounds."""
    osc = gp.Oscillator(mesh_frequency=1.219)
    points = section(osc, POINTS)
    ends = np.stack(gp.stroboscopic_map(osc, points[:, 0], points[:, 1]), axis=1)
    methods = all_methods()
    marches = [method.prepare(osc) for method in methods]
    for march in marches:
        march(1.3, 0.2, 2)
    times = np.full((ROUNDS, len(methods)), np.nan)
    for row in times:
        for i, (method, march) in enumerate(zip(methods, marches, strict=True)):
            row[i] = seconds(lambda march=march, method=method: march(*points[0], method.periods)) / method.periods
    best = times.min(axis=0)
    print(f"One mesh period at Omega = 1.219 (chaotic), {ROUNDS} interleaved rounds, largest error of {POINTS} starts")
    print(f"  {'method':32} {'us / period':>12} {'ratio':>9} {'error':>9}")
    for method, march, cost in zip(methods, marches, best, strict=True):
        scale = np.maximum(1.0, np.abs(ends).max(axis=1))
        found = np.array([march(*point, 1) for point in points])
        error = (np.abs(found - ends).max(axis=1) / scale).max()
        shown = f"{error:9.0e}" if march is not marches[0] else "see below"
        print(f"  {method.name:32} {cost * 1e6:12.3g} {cost / best[0]:9.3g} {shown}")


def check_accuracy() -> bool:
    """Our one-period errors against seventy digits; whether they keep the promise."""
    print("\nOne-period error of the exact flow against 70 digits, relative to max(1, |state|)")
    good = True
    for omega in FREQUENCIES:
        osc = gp.Oscillator(mesh_frequency=omega)
        worst = amplified = 0.0
        for x, v in section(osc, 10):
            reference = mpmath_period(osc, x, v)
            error = reference.error(*map(float, gp.stroboscopic_map(osc, x, v)))
            worst, amplified = max(worst, error), max(amplified, error / reference.amplification)
        good &= amplified <= ORDINARY
        print(f"  Omega = {omega:<6} {worst:8.1e}   over the amplification {amplified:8.1e}   promised {ORDINARY:.0e}")
    worst, name = 0.0, ""
    for case, (osc, x, v) in degenerate_cases().items():
        error = mpmath_period(osc, x, v).error(*map(float, gp.stroboscopic_map(osc, x, v)))
        worst, name = max((worst, name), (error, case))
    good &= worst <= DEGENERATE
    print(f"  degenerate     {worst:8.1e}   ({name})   promised {DEGENERATE:.0e}")
    return good


def ordinary_speed() -> None:
    """The march alone at the baseline's frequencies."""
    print("\nCost of a mesh period on one core, periods in the settled motion")
    for omega in FREQUENCIES:
        osc = gp.Oscillator(mesh_frequency=omega)
        x, v = section(osc, 2)[0]
        best = min(seconds(lambda osc=osc, x=x, v=v: gp.stroboscopic_map(osc, x, v, 20_000)) for _ in range(ROUNDS))
        impacts = len(gp.trajectory(osc, x, v, 1000, samples_per_period=1).impacts) / 1000
        print(f"  Omega = {omega:<6} {best / 20_000 * 1e6:6.2f} us, {impacts:.2f} contacts and separations")


def batches() -> None:
    """Diagrams and grids of starts, and how they grow with size and with cores."""
    osc = gp.Oscillator()

    def diagram(n: int, seeding: str = "restart") -> None:
        for values in (np.linspace(0.7, 1.7, n), np.linspace(1.7, 0.7, n)):
            gp.sweep(osc, "mesh_frequency", values, seeding=seeding, n_exponent=500)

    def grid(n: int) -> None:
        gp.basins(osc, np.linspace(-3.0, 3.0, n), np.linspace(-2.0, 2.0, n))

    diagram(2)
    grid(2)
    print("\nBatches, seconds")
    print(f"  1000 mesh frequencies up and down, carried (one core): {seconds(lambda: diagram(1000, 'carry')):.2f}")
    for name, run, sizes in (
        ("frequencies up and down", diagram, (250, 500, 1000)),
        ("x n starts", grid, (50, 100, 200)),
    ):
        times = [seconds(lambda run=run, n=n: run(n)) for n in sizes]
        shown = ", ".join(f"{n}: {t:.2f}" for n, t in zip(sizes, times, strict=True))
        print(f"  n {name}, all cores: {shown}; last over first {times[-1] / times[0]:.1f}")
    cores = config.NUMBA_NUM_THREADS
    times = []
    for n in sorted({1, max(1, cores // 2), cores}):
        config.NUMBA_NUM_THREADS = n
        times.append((n, seconds(lambda: diagram(500))))
    config.NUMBA_NUM_THREADS = cores
    shown = ", ".join(f"{n}: {t:.2f} s ({times[0][1] / t:.1f} times)" for n, t in times)
    print(f"  500 frequencies up and down by cores: {shown}")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)
    print(f"  largest memory of this process: {peak:.0f} MiB")


def main() -> int:
    """Everything, in order; 1 where accuracy falls short."""
    print(f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}\n")
    compare_methods()
    ordinary_speed()
    batches()
    if check_accuracy():
        return 0
    print("\nAccuracy falls short of what is promised", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
