"""Diagrams and grids of starts, each in a process of its own, so that its memory is its own.

``python -m benchmarks.jobs grid 50 100`` prints one line of JSON per size: seconds and peak memory.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from time import perf_counter, process_time

import numpy as np

import gearpair as gp

ROOT = Path(__file__).parents[1]


@dataclass(frozen=True)
class Measured:
    """One job at one size.

    Parameters
    ----------
    job : str
        A name in `JOBS`.
    size : int
        Values of a diagram, starts or starts along each side of a grid, motions of a plane, mesh periods, speeds,
        boxes, seconds or repetitions.
    seconds : float
    processor_seconds : float
        Summed over the cores; what the machine does for others does not count.
    peak_mib : float
        The process's peak memory so far, sizes before this one included.
    """

    job: str
    size: int
    seconds: float
    processor_seconds: float
    peak_mib: float


def diagram(n: int) -> None:
    """A frequency diagram, carried up and down."""
    values = np.linspace(0.7, 1.7, n)
    gp.sweep(gp.Oscillator(), "mesh_frequency", values)
    gp.sweep(gp.Oscillator(), "mesh_frequency", values[::-1])


def restarted(n: int) -> None:
    """A frequency diagram, every value from the same start."""
    gp.sweep(gp.Oscillator(), "mesh_frequency", np.linspace(0.7, 1.7, n), seeding="restart")


def grid(n: int) -> None:
    """The attractors that n x n starts lead to, at the baseline."""
    gp.basins(gp.Oscillator(), np.linspace(-4.0, 4.0, n), np.linspace(-3.0, 3.0, n))


def plane(n: int) -> None:
    """The steady motions over 5 m speeds and 3 m values of damping, n in all."""
    m = max(1, round((n / 15) ** 0.5))
    axes = {"mesh_frequency": np.linspace(0.5, 1.8, 5 * m), "damping_ratio": np.linspace(0.01, 0.1, 3 * m)}
    gp.parameter_map(gp.Oscillator(), axes)


def drawn() -> gp.GearDrive:
    """The chapter's pair, its error at a known phase."""
    pair = gp.SpurPair(pinion_teeth=28, gear_teeth=57, face_width_mm=25.0)
    error = [(1, 4.0, 0.0)]
    return gp.GearDrive.from_pair(
        pair, pinion_torque_nm=120.0, backlash_um=100.0, transmission_error_um=error, damping_ratio=0.05
    )


def chart(n: int) -> None:
    """The speed chart of a drawn pair: runs up and down, twelve starts a speed, jumps located."""
    gp.design.speed_chart(drawn(), np.linspace(1500.0, 13000.0, n), n_starts=12)


def attractors(n: int) -> None:
    """The attractors that n random starts lead to, at the baseline."""
    gp.attractors(gp.Oscillator(), n)


def changing(n: int) -> None:
    """A passage over n mesh periods, each at a speed of its own."""
    osc = gp.Oscillator(error_amplitude=0.05, damping_ratio=0.05)
    gp.passage([osc.replace(mesh_frequency=each) for each in np.linspace(0.5, 1.1, n).tolist()], 1.1, 0.0)


def ramp(n: int) -> None:
    """A drawn pair run up through its resonance in n mesh periods."""
    gp.design.run_up(drawn(), 5000.0, 13000.0, n / (9000.0 / 60.0 * 28))


def tip_in(n: int) -> None:
    """A drawn pair whose torque turns from the coast flank to the drive flank, followed for n mesh periods."""
    drive = drawn().at_speed(7000.0)
    gp.design.load_change(drive, [(0.0, -20.0), (0.005, 120.0)], n / (7000.0 / 60.0 * 28))


def shocks(n: int) -> None:
    """The smallest gap in the torque that throws a drawn pair, at n speeds."""
    gp.design.shock_margin(drawn(), np.linspace(7000.0, 9500.0, n), n_starts=4)


def boxes(n: int) -> None:
    """As many gearboxes of the drawn pair, run up and down over 81 speeds."""
    spread = {"backlash_um": (70.0, 130.0), "transmission_error_um": (2.0, 6.0), "damping_ratio": (0.03, 0.07)}
    gp.design.population(drawn(), spread, np.linspace(1500.0, 13000.0, 81), n=n)


def rig(n: int) -> None:
    """Damping and error of the drawn pair from two jumps, so many times."""
    for _ in range(n):
        gp.design.identify(drawn().at_phase(0.3), 9105.26, 7332.83)


def heard(n: int) -> None:
    """n seconds of a steady motion of the drawn pair as sound."""
    drive = drawn().at_speed(7000.0)
    gp.design.sound(drive, gp.steady_state(drive.oscillator()), float(n))


JOBS = {
    "diagram": diagram,
    "restarted": restarted,
    "grid": grid,
    "plane": plane,
    "chart": chart,
    "attractors": attractors,
    "changing": changing,
    "ramp": ramp,
    "tip_in": tip_in,
    "shocks": shocks,
    "boxes": boxes,
    "rig": rig,
    "heard": heard,
}


def peak_mib() -> float:
    """The most memory that this process has held."""
    try:  # on Linux getrusage counts the parent's memory from before the program was replaced
        lines = Path("/proc/self/status").read_text().splitlines()
        return next(float(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1024
    except (OSError, StopIteration):
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        return peak / (2**20 if sys.platform == "darwin" else 2**10)


def run_here(job: str, sizes: Sequence[int]) -> list[Measured]:
    """Run a job at each size in this process, once small to compile and import."""
    JOBS[job](2)
    done = [Measured(job, 0, 0.0, 0.0, peak_mib())]
    for size in sizes:
        begin, busy = perf_counter(), process_time()
        JOBS[job](size)
        seconds, processor = perf_counter() - begin, process_time() - busy
        done.append(Measured(job, size, seconds, processor, peak_mib()))
    return done


def run_apart(job: str, sizes: Sequence[int]) -> list[Measured]:
    """`run_here` in a process of its own; size 0 is what it holds before the first."""
    out = python("-m", "benchmarks.jobs", job, *map(str, sizes))
    return [Measured(**json.loads(line)) for line in out.splitlines()]


def python(*arguments: str) -> str:
    """What another Python prints."""
    command = [sys.executable, *arguments]
    return subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


if __name__ == "__main__":
    for measured in run_here(sys.argv[1], [int(size) for size in sys.argv[2:]]):
        print(json.dumps(asdict(measured)))
