"""The page's chart against the library's on as many random drives as are asked for, which tests have no time for.

    python -m tests.chart.many [drives] [seed]

Needs Node.js, and some three seconds a drive. Where chaos comes on the way, rounding decides on which motion a run
lands, and over which stretch of it a force was measured. So a cycle of the page that is not the library's there is
followed by the library from its own start; those that the library does not confirm are printed.
"""

import sys
from collections import Counter
from typing import Any

import numpy as np

import gearpair as gp
from tests.chart.test_chart import DEFAULTS, DRAW, NAMES, State, drive_of
from tests.chart.test_wave import drawing
from tests.support.engines import run_in_chart

COUNT, MOST = 40, 1e-7
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


def is_the_library_s(found: dict[str, Any], there: Any) -> bool:
    """Whether a motion of the page equals one of the library's chart in all that both say of it."""
    if (found["impact"], found["period"] or 0) != (there.impact_state.item(), there.period.item()):
        return False
    here = [np.nan if found[name] is None else found[name] for name in NAMES]
    return np.allclose(here, [there[name].item() for name in NAMES.values()], rtol=MOST, atol=MOST, equal_nan=True)


def is_confirmed(found: dict[str, Any], drive: gp.GearDrive, rpm: float, phase: float) -> bool:
    """Whether the library, started on a cycle of the page, stays on it and finds its force."""
    osc = drive.at_speed(rpm).at_phase(phase).oscillator()
    state = gp.steady_state(osc, found["start"]["x"], found["start"]["v"])
    factor = gp.motion.impact_measures(state).load_factor
    return state.period == found["period"] and bool(np.isclose(factor, found["factor"], rtol=MOST))


def compared(state: State, drive: gp.GearDrive) -> Counter[str]:
    """How the page's motions at the speeds of a chart compare with the library's, and its verdict."""
    answer = run_in_chart(DRAW, {"state": state, "count": COUNT, "nStarts": 3})
    page, speeds = answer["chart"], np.array(answer["chart"]["speeds"])
    chart = gp.design.speed_chart(drive, speeds, n_starts=3, locate_jumps=False)
    iso = gp.design.iso_dynamic_factor(drive, speeds, **{name: state[name] for name in ("base_pitch_um", "profile_um")})
    told = gp.design.verdict(chart, iso).sentences
    counts = Counter(["verdict the same" if answer["told"]["sentences"] == list(told) else "verdict in other words"])
    for run in RUNS:
        for i, rpm in enumerate(speeds):
            found, there = page[run][i], chart.sel(run=run).isel(speed=i)
            phase = page["worstPhase"][i] if run == "worst" else page["phases"][page["chosen"]]
            if is_the_library_s(found, there):
                kind = "the same"
            elif not found["period"]:
                kind = "without a period"
            elif is_confirmed(found, drive, rpm, phase):
                kind = "another cycle, which the library confirms"
            else:
                kind = "not confirmed"
                print(f"run {run}, {rpm!r} rpm, phase {phase}: {found}, the library's {there.to_pandas()}", flush=True)
            counts[kind] += 1
    return counts


def main(drives: int = 300, seed: int = 300) -> None:
    rng = np.random.default_rng(seed)
    total: Counter[str] = Counter()
    while sum(count for kind, count in total.items() if kind.startswith("verdict")) < drives:
        state = random_state(rng)
        try:
            drive = drive_of(state)
        except ValueError:
            total["a pair that cannot be"] += 1
            continue
        counts = compared(state, drive)
        if counts["not confirmed"]:
            print(state, flush=True)
        total += counts
    for kind, count in total.most_common():
        print(f"{count:6} {kind}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
