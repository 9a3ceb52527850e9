"""The stiffness wave."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import StepPatch

from gearpair._checks import check_count, checked
from gearpair.plotting.paper import legible, look_of
from gearpair.plotting.style import BOUNDARY, INK, new_axes, note
from gearpair.quantities import axis_label
from gearpair.stiffness import StiffnessWave


@checked
def stiffness_wave(
    wave: StiffnessWave,
    ax: Axes | None = None,
    *,
    n_periods: int = 2,
    mean: bool = True,
    **look: Any,
) -> Axes:
    """The staircase over some mesh periods, and its mean as a dashed line.

    Examples
    --------
    >>> stiffness_wave(StiffnessWave.rectangular()).texts[0].get_text()
    'mean 0.9464'
    """
    n_periods, ax = check_count("n_periods", n_periods), new_axes(ax, 2.6)
    edges = np.concatenate([np.add(wave.edges, k) for k in range(n_periods)] + [[float(n_periods)]])
    usual = look_of(StepPatch, look, linewidth=1.8, color=legible(ax, INK))
    colour = usual.get("edgecolor", usual["color"])
    ax.stairs(np.tile(wave.levels, n_periods), edges, baseline=None, **usual)
    if mean:
        ax.axhline(wave.mean, color=colour, linestyle="--", linewidth=1.0)
        shift, va = (-3, "top") if wave.mean < 1.0 else (3, "bottom")
        told = f"mean {wave.mean:.4g}"
        note(ax, told, (n_periods, wave.mean), (-3, shift), ha="right", va=va, fontsize=8, color=colour)
    ax.axhline(1.0, color=BOUNDARY, linewidth=0.6, zorder=-1)
    top = max(1.0, *wave.levels)
    ax.set(xlabel=axis_label("tau"), ylabel=axis_label("stiffness"), xlim=(0, n_periods))
    ax.set_ylim(0, max(1.12 * top, ax.get_ylim()[1]))
    return ax


@checked
def harmonics(wave: StiffnessWave, n: int, ax: Axes | None = None, *, offset: float = 0.0, **look: Any) -> Axes:
    """Amplitudes ``2 |c_m|`` of the first `n` harmonics of the mesh frequency, as stems.

    Parameters
    ----------
    n : int
        The highest harmonic shown.
    offset : float
        Shift along the axis, to set several waves side by side.

    Examples
    --------
    >>> harmonics(StiffnessWave.rectangular(), 3).get_xticks().tolist()
    [1, 2, 3]
    """
    n, ax = check_count("n", n), new_axes(ax, 2.6)
    order = np.arange(1, n + 1)
    amplitude = 2.0 * np.abs(wave.harmonics(n)[1:])
    dots = look_of(Line2D, look, linestyle="", marker="o", markersize=4, color=legible(ax, INK))
    ax.vlines(order + offset, 0.0, amplitude, color=dots["color"], linewidth=dots.get("linewidth", 1.4))
    ax.plot(order + offset, amplitude, **dots)
    ax.set(xlabel="harmonic $m$ of the mesh frequency", ylabel=r"amplitude $2|c_m|$")
    ax.set_xticks(order)
    ax.set_ylim(bottom=0.0)
    return ax
