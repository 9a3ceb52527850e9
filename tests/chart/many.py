"""The page's chart against the library's on as many random drives as are asked for, which tests have no time for.

``python -m tests.chart.many 300`` needs Node.js, and takes some five seconds a drive. It prints each drive on which the
two differ, with the places and what they say, and at the end how much was the same.
"""

import sys

import numpy as np

from gearpair import design
from tests.chart.test_chart import DEFAULTS, DRAW, NAMES, State, drive_of
from tests.chart.test_wave import drawing
from tests.support.engines import run_in_chart

COUNT = 40
RUNS = ("up", "down", "worst")


def random_state(rng: np.random.Generator) -> State:
    """The fields of the page, as somebody might fill them in; now and then for a pair that cannot be."""
    sizes = {name: value for name, value in drawing(rng).items() if name in DEFAULTS}
    module = sizes["module_mm"]
    return {
        **DEFAULTS,
        **sizes,
        "pinion_torque_nm": float(sizes["face_width_mm"] * module**2 * rng.uniform(0.2, 2.0)),
        "backlash_um": float(module * rng.uniform(10.0, 80.0)),
        "backlash": str(rng.choice(["normal", "circumferential", "thickness"])),
        "transmission_error_um": float(rng.choice([0.0, rng.uniform(0.2, 8.0)])),
        "damping_ratio": float(rng.choice([0.02, 0.05, rng.uniform(0.01, 0.2)])),
    }


def differences(state: State, drive: object) -> tuple[list[str], bool]:
    """Where the page's motions are not the library's, and whether the verdicts are word for word the same."""
    answer = run_in_chart(DRAW, {"state": state, "count": COUNT, "nStarts": 3})
    speeds = np.array(answer["chart"]["speeds"])
    chart = design.speed_chart(drive, speeds, n_starts=3, locate_jumps=False)
    iso = design.iso_dynamic_factor(drive, speeds, **{name: state[name] for name in ("base_pitch_um", "profile_um")})
    found = []
    for run in RUNS:
        there = chart.sel(run=run)
        for i, each in enumerate(answer["chart"][run]):
            here = (each["impact"], each["period"] or 0)
            theirs = (there.impact_state.values[i], there.period.values[i])
            if here != theirs:
                found.append(f"{run} at {speeds[i]:.5g} rpm: {here}, library {theirs}")
            elif each["period"]:
                for name, key in NAMES.items():
                    a, b = (np.nan if each[name] is None else each[name]), float(there[key].values[i])
                    if not np.isclose(a, b, rtol=1e-7, atol=1e-7, equal_nan=True):
                        found.append(f"{run} at {speeds[i]:.5g} rpm: {key} {a!r}, library {b!r}")
                        break
    return found, answer["told"]["sentences"] == list(design.verdict(chart, iso).sentences)


def main(n: int, seed: int = 300) -> None:
    rng = np.random.default_rng(seed)
    compared = motions = verdicts = refused = 0
    while compared < n:
        state = random_state(rng)
        try:
            drive = drive_of(state)
        except ValueError:
            refused += 1
            continue
        found, same = differences(state, drive)
        compared, verdicts = compared + 1, verdicts + same
        motions += len(RUNS) * COUNT - len(found)
        if found or not same:
            print(f"{compared}: {state}", *found, "" if same else "the verdicts differ", sep="\n  ", flush=True)
    print(f"{compared} drives ({refused} more that cannot be): {motions} of {len(RUNS) * COUNT * n} motions the same,")
    print(f"{verdicts} verdicts word for word")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
