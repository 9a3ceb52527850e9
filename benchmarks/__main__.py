"""``python -m benchmarks``: prints every table; exits with 1 where accuracy, never where time, falls short."""

from __future__ import annotations

import argparse
import os
import platform
import sys
from collections.abc import Sequence

import numba

from benchmarks import workload
from benchmarks.accuracy import measure, reference_periods, shortfall
from benchmarks.methods import CHAOTIC, all_methods, has_heyoka
from benchmarks.race import comparison, race


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print, and return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description="Accuracy and time on this machine.")
    parser.add_argument("--quick", action="store_true", help="accuracy and the comparison alone, on fewer periods")
    quick = parser.parse_args(arguments).quick

    print(
        f"{platform.machine()}, {os.cpu_count()} cores with {os.getloadavg()[0]:.1f} processes wanting them, ", end=""
    )
    print(f"Python {platform.python_version()}, numba {numba.__version__}\n")
    methods = all_methods()
    counts = {m.oscillator.mesh_frequency: 2 if quick else 5 for m in methods} | {CHAOTIC: 3 if quick else 20}
    periods = {m.oscillator.mesh_frequency: m.oscillator for m in methods}
    known = {omega: reference_periods(osc, counts[omega]) for omega, osc in periods.items()}
    accuracies = [measure(m, known[m.oscillator.mesh_frequency]) for m in methods]
    times = race(methods, known[CHAOTIC], 3 if quick else 15)
    print("One mesh period: time in turns, medians; largest error of max(1, |state|), against seventy digits")
    print(comparison(methods, accuracies, times), flush=True)
    if not has_heyoka():
        print("heyoka: not installed")
    sentence = shortfall(methods, accuracies)
    if not quick:
        print_workload()
    if sentence:
        print(sentence, file=sys.stderr)
        return 1
    print("\nThe exact flow is as accurate as promised.")
    return 0


def print_workload() -> None:
    """Start-up, which also leaves compiled kernels for the rest; cost, memory and growth of diagrams and grids."""
    print("\nStart-up")
    print(workload.start_up(), flush=True)
    print("\nGrowth with size, all cores (a carried diagram is one chain and runs on one); processor time per motion")
    print(workload.growth(), flush=True)
    print("\nMore of a transmission error, processor time of a mesh period against one harmonic's")
    print(workload.harmonics(), flush=True)
    print("\nGrowth with cores (other work on the machine takes its share of the gain)")
    print(workload.cores(), flush=True)


if __name__ == "__main__":
    sys.exit(main())
