"""What a diagram, a grid of starts and a start of the interpreter cost, and how that grows."""

from __future__ import annotations

import resource
from statistics import median
from time import perf_counter, process_time
from typing import Any

from numba import config

import gearpair as gp
from benchmarks.jobs import JOBS, Measured, python, run_apart
from gearpair.table import Table

VALUES = (100, 400, 1000)
SIDES = (100, 200, 400)
MOTIONS = (1500, 6000)
SPEEDS = (40, 160)
PERIODS = (1000, 10_000)
SHOCKS = (10, 40)
BOXES = (100, 1000)
STARTS_TRIED = (1000, 10_000)
HEARD = (1, 10)
# Too small to change the motion, so that what they cost is what the harmonics themselves cost.
FIVE_HARMONICS = tuple((order, 1e-9, 0.3) for order in (2, 3, 4, 5))
SHAFTS = {"run-out, 34 teeth": [(34, 1e-9)], "run-out, 25 and 71 teeth": [(25, 1e-9), (71, 1e-9)]}
FREQUENCIES = (0.7, 0.95, 1.6, 2.2)
SPREAD = {
    "restarted": ("diagram from one start, 200 values", 200),
    "grid": ("200 x 200 starts", 200),
    "plane": ("speed and damping, 1500 motions", 1500),
}
STARTS = {
    "Python alone": "",
    "import gearpair": "import gearpair",
    "and the first steady state": "import gearpair as gp; gp.steady_state(gp.Oscillator())",
    "and the first diagram": "import gearpair as gp; gp.sweep(gp.Oscillator(), 'mesh_frequency', [0.7, 0.8])",
}


def growth() -> Table:
    """Time and memory against size, on all cores."""
    diagrams, grids = run_apart("diagram", VALUES), run_apart("grid", SIDES)
    planes, charts = run_apart("plane", MOTIONS), run_apart("chart", SPEEDS)
    ramps, shocks = run_apart("ramp", PERIODS), run_apart("shocks", SHOCKS)
    series, rigs = run_apart("boxes", BOXES), run_apart("rig", (1,))
    many, passed = run_apart("attractors", STARTS_TRIED), run_apart("changing", PERIODS)
    sounds, changes = run_apart("heard", HEARD), run_apart("tip_in", PERIODS)
    rows = [_cost(m, f"diagram up and down, {m.size} values", 2 * m.size, diagrams[0]) for m in diagrams[1:]]
    rows += [_cost(m, f"{m.size} x {m.size} starts", m.size**2, grids[0]) for m in grids[1:]]
    rows += [_cost(m, f"speed and damping, {m.size} motions", m.size, planes[0]) for m in planes[1:]]
    rows += [_cost(m, f"speed chart, {m.size} speeds", (2 + 12) * m.size, charts[0]) for m in charts[1:]]
    rows += [_cost(m, f"attractors of {m.size} starts", m.size, many[0]) for m in many[1:]]
    rows += [_cost(m, f"passage, {m.size} mesh periods", m.size, passed[0]) for m in passed[1:]]
    rows += [_cost(m, f"run-up, {m.size} mesh periods", m.size, ramps[0]) for m in ramps[1:]]
    rows += [_cost(m, f"tip-in, {m.size} mesh periods", m.size, changes[0]) for m in changes[1:]]
    rows += [_cost(m, f"shock margin, {m.size} speeds", m.size, shocks[0]) for m in shocks[1:]]
    rows += [_cost(m, f"{m.size} gearboxes, 81 speeds", 2 * 81 * m.size, series[0]) for m in series[1:]]
    rows += [_cost(m, "two speeds of a test rig", 1, rigs[0]) for m in rigs[1:]]
    rows += [_cost(m, f"sound of {m.size} s", m.size, sounds[0]) for m in sounds[1:]]
    return Table(("job", "seconds", "processor s", "us / motion", "peak MiB", "MiB for it"), rows)


def _cost(m: Measured, name: str, motions: int, before: Measured) -> tuple[str, ...]:
    per_motion = f"{m.processor_seconds / motions * 1e6:.0f}"
    memory = f"{m.peak_mib:.0f}", f"{m.peak_mib - before.peak_mib:.0f}"
    return name, f"{m.seconds:.2f}", f"{m.processor_seconds:.2f}", per_motion, *memory


def harmonics(rounds: int = 9, periods: int = 20_000) -> Table:
    """A mesh period with more of a transmission error against one harmonic alone, in turns, at the same motion."""
    more: dict[str, dict[str, Any]] = {
        "five harmonics": {"harmonics": FIVE_HARMONICS},
        **{name: {"shaft_orders": s} for name, s in SHAFTS.items()},
    }
    rows = []
    for omega in FREQUENCIES:
        one = gp.Oscillator(mesh_frequency=omega)
        x, v = gp.stroboscopic_map(one, 1.0, 0.0, 500)
        ratios = [_ratio(one, one.replace(**each), float(x), float(v), rounds, periods) for each in more.values()]
        rows.append((f"{omega:.2f}", *(f"{ratio:.2f}" for ratio in ratios)))
    return Table(("Omega_h", *(f"{name} / one harmonic" for name in more)), rows)


def _ratio(one: gp.Oscillator, other: gp.Oscillator, x: float, v: float, rounds: int, periods: int) -> float:
    """What a mesh period of `other` costs over one of `one`, in turns, `periods` each."""
    ratios = []
    for _ in range(rounds):
        spent = []
        for osc in (one, other):
            n = osc.base_periods(periods)
            begin = process_time()
            gp.stroboscopic_map(osc, x, v, n)
            spent.append((process_time() - begin) / (n * osc.mesh_periods))
        ratios.append(spent[1] / spent[0])
    return median(ratios)


def cores(rounds: int = 5) -> Table:
    """One core against all, in turns."""
    every = config.NUMBA_NUM_THREADS
    rows = []
    for job, (name, size) in SPREAD.items():
        JOBS[job](2)  # imported and compiled before the clock starts
        pairs = [[_on_cores(n, job, size) for n in (1, every)] for _ in range(rounds)]
        one, all_of_them = (median(side) for side in zip(*pairs, strict=True))
        gain = median(a / b for a, b in pairs)
        rows.append((name, f"{one:.2f}", every, f"{all_of_them:.2f}", f"{gain:.2f}"))
    return Table(("job", "1 core, s", "cores", "all cores, s", "gain"), rows)


def _on_cores(n: int, job: str, size: int) -> float:
    """Seconds of a job in this process, spread over `n` threads."""
    every, config.NUMBA_NUM_THREADS = config.NUMBA_NUM_THREADS, n
    try:
        begin = perf_counter()
        JOBS[job](size)
        return perf_counter() - begin
    finally:
        config.NUMBA_NUM_THREADS = every


def start_up(rounds: int = 3) -> Table:
    """A process's whole life, its kernels compiled by one before it."""
    for code in list(STARTS.values())[2:]:
        python("-c", code)
    times: dict[str, list[tuple[float, float]]] = {name: [] for name in STARTS}
    for _ in range(rounds):
        for name, code in STARTS.items():
            begin, busy = perf_counter(), _children_busy()
            python("-c", code)
            times[name].append((perf_counter() - begin, _children_busy() - busy))
    rows = []
    for name, kept in times.items():
        seconds, processor = zip(*kept, strict=True)
        rows.append((name, f"{median(seconds):.2f}", f"{min(seconds):.2f}", f"{median(processor):.2f}"))
    return Table(("a second process", "seconds", "at best", "processor s"), rows)


def _children_busy() -> float:
    """Processor time that ended child processes have used."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
