"""The two pictures that the README opens with, from its example: the drawing of a pair, and its speed chart.

Run ``python -m tools.door`` after a change of the example, of the chart or of the model.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from gearpair import GearDrive, plotting
from gearpair.teeth import SpurGear

ROOT = Path(__file__).parents[1]
PICTURES = ROOT / "book" / "_static"
FILL, EDGE = ("#E3E9F2", "#F1EDE4"), "#1F3A5F"


def example() -> dict[str, Any]:
    """The names that the README's example leaves."""
    (code,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    names: dict[str, Any] = {}
    exec(compile(code, "README.md", "exec"), names)
    return names


def outline(gear: SpurGear, centre: float, first: float) -> np.ndarray:
    """All teeth of a gear in mm, shape (2, n), about a centre on the x axis, the first tooth at an angle."""
    tooth = plotting.tooth_outlines(gear, plt.figure().subplots(), roots=["trochoid"]).lines[-1]
    plt.close()
    across, along = np.asarray(tooth.get_xdata(), float), np.asarray(tooth.get_ydata(), float)
    turns = first + 2.0 * np.pi * np.arange(gear.teeth) / gear.teeth
    points = (along + 1j * across) * gear.module_mm * np.exp(1j * turns)[:, None] + centre
    return np.array([points.real.ravel(), points.imag.ravel()])


def draw_pair(drive: GearDrive, ax: Axes) -> None:
    """Both gears in mesh, with what stands on their drawing."""
    assert drive.mesh is not None
    pair = drive.mesh.pair
    distance = pair.centre_distance_mm
    places = (pair.pinion, 0.0, 0.0), (pair.gear, distance, np.pi + np.pi / pair.gear_teeth)
    for (gear, centre, first), fill, name in zip(places, FILL, ("pinion", "gear"), strict=True):
        ax.fill(*outline(gear, centre, first), facecolor=fill, edgecolor=EDGE, linewidth=0.7)
        ax.plot(centre, 0.0, "+", color=EDGE, markersize=9)
        ax.text(centre, -0.05 * distance, f"{name}\n{gear.teeth} teeth", ha="center", va="top", fontsize=8)
    words = f"module {pair.module_mm:g} mm, width {pair.contact_width_mm:g} mm, {drive.pinion_torque_nm:g} N m"
    told = f"backlash {drive.backlash_um:g} µm, transmission error ±{drive.transmission_error_um:g} µm"
    ax.set_title(f"{words}\n{told}", loc="center", fontsize=9, weight="normal")
    ax.set_aspect("equal")
    ax.axis("off")


def main() -> None:
    """Draw both."""
    names = example()
    with plt.style.context(plotting.STYLE):
        figure, ax = plt.subplots(figsize=(4.2, 3.2))
        draw_pair(names["drive"], ax)
        figure.savefig(PICTURES / "pair_drawing.png", dpi=150)
        figure, ax = plt.subplots(figsize=(8.0, 4.6))
        plotting.dynamic_factors(names["chart"], ax=ax)
        figure.savefig(PICTURES / "speed_chart.png", dpi=150)


if __name__ == "__main__":
    main()
