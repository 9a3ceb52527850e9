"""How much work a chapter is with other parameters, told before it starts."""

from collections.abc import Mapping
from math import prod
from typing import Any

import numpy as np

from gearpair.motion.settling import transient_periods
from gearpair.parameters import PARTS, STANDS_FOR, oscillator_of
from gearpair.study.chapters import Chapter

WORTH_TELLING = 3.0
SAMPLES = 9  # oscillators along an axis whose cost stands for all


def work_ratio(chapter: Chapter, values: Mapping[str, Any]) -> float:
    """How many times the work of the chapter as it stands these values ask for, roughly.

    Counted are motions, the mesh periods that each takes to settle (many where damping is small), and the length of a
    period (long where the mesh frequency is small).

    Examples
    --------
    >>> from pathlib import Path
    >>> from gearpair.study.chapters import Parameter
    >>> chapter = Chapter(Path("c.ipynb"), "", (Parameter("n_values", "int", 100, ""),
    ...                                         Parameter("damping_ratio", "float", 0.02, "")), {})
    >>> work_ratio(chapter, {"n_values": 200})
    2.0
    >>> round(work_ratio(chapter, {"damping_ratio": 1e-4}))
    40
    """
    before, after = chapter.defaults, {**chapter.defaults, **values}
    ratios = {name: after[name] / value for name, value in before.items() if name.startswith("n_") and value}
    motions = max(
        (prod(ratios[name] for name in part if name in ratios) for part in PARTS if {*part} & {*ratios}), default=1.0
    )
    steps = before.get("phase_step", 1) / after.get("phase_step", 1)
    stands_for = chapter.stands_for or {}
    return motions * steps * _cost(after, stands_for) / _cost(before, stands_for)


def _cost(values: Mapping[str, Any], stands_for: Mapping[str, str]) -> float:
    """Mesh periods of one motion times their length, on average along the chapter's axis."""
    osc = oscillator_of(values)
    oscillators = [osc]
    if "highest" in values:
        axis = {**STANDS_FOR, **stands_for}["highest"]
        ends = values.get("lowest", values["highest"] / SAMPLES), values["highest"]
        oscillators = [osc.replace(**{axis: float(value)}) for value in np.linspace(*ends, SAMPLES)]
    longest = values.get("n_transient", np.inf)
    return float(np.mean([min(transient_periods(each), longest) * each.mesh_period for each in oscillators]))


def warning(chapter: Chapter, values: Mapping[str, Any], seconds: float | None) -> str | None:
    """What to say before a long run: how much more it is, and how long where the chapter's own time is known."""
    try:
        ratio = work_ratio(chapter, values)
    except ValueError:  # a value out of range, which the chapter itself is about to refuse
        return None
    if ratio < WORTH_TELLING:
        return None
    told = f"{chapter.name}: with these parameters about {ratio:.2g} times the work of the chapter as it stands"
    if seconds is None:
        return told
    return f"{told}, which took {seconds:.0f} s here: up to {duration(ratio * seconds)}"


def duration(seconds: float) -> str:
    """A time in words.

    Examples
    --------
    >>> duration(40), duration(400), duration(40_000)
    ('40 s', '7 minutes', '11 hours')
    """
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} minutes" if seconds < 6000 else f"{seconds / 3600:.0f} hours"
