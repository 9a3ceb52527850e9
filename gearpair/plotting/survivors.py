"""How long chaos lives: the survivors over the mesh periods."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter
from matplotlib.typing import ColorType

from gearpair._checks import check_count, check_number, checked
from gearpair.ensembles.lifetimes import estimate_of
from gearpair.plotting.paper import legible, look_of
from gearpair.plotting.style import BOUNDARY, INK, new_axes
from gearpair.quantities import axis_label

BELOW = 0.5  # where a curve goes that has no survivors left: under the axis
# Of several curves the longer lived has the darker colour, between these two of the map.
LIVES, SHORTEST, LONGEST = colormaps["plasma"], 0.72, 0.02
SHARES = {1.0: "all", 0.5: "half", 0.1: "1 in 10", 0.01: "1 in 100", 0.001: "1 in 1000"}


@checked
def survival_curve(result: xr.Dataset, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """The starts still on their way over the mesh periods, on a logarithmic scale, with the fitted escape rate.

    Steps for the survivors; dashed, from the end of what is discarded (dotted), the line of the fitted rate in the
    strip of its interval. Without an escape there is no line, and the strip is how fast survivors may fall at most.
    The legend says what mean life the strip stands for. The scale begins where the survivors or their strip end.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = survival_curve(gp.survival(gp.Oscillator(mesh_frequency=1.09), [-1.0, 0.0, 1.0, 2.0], -1.0))
    >>> ax.get_yscale(), ax.lines[0].get_ydata().tolist()[0]
    ('log', 4.0)
    """
    ax = new_axes(ax)
    waited, survivors, n_periods = result.waited.values, result.survivors.values, result.attrs["n_periods"]
    end = n_periods if survivors[-1] else min(n_periods, max(1.4 * waited[-2], 2.0 * result.attrs["discard"], 1.0))
    steps = look_of(Line2D, look, color=legible(ax, INK))
    colour = steps["color"]
    ax.step(waited, np.maximum(survivors, BELOW), where="post", **steps)
    dots: dict[str, Any] = {"color": BOUNDARY, "linewidth": 0.9, "linestyle": (0, (1, 1.6)), "zorder": -1}
    ax.axvline(result.attrs["discard"], label="counted from here on", **dots)
    lowest = float(survivors[-1])
    estimate = estimate_of(result)
    if np.isfinite(estimate.escape_rate_high):
        since = np.linspace(0.0, n_periods - result.attrs["discard"], 400)
        rates = estimate.escape_rate_high, estimate.escape_rate, estimate.escape_rate_low
        steepest, fitted, flattest = (estimate.n_watched * np.exp(-rate * since) for rate in rates)
        tau = result.attrs["discard"] + since
        ax.fill_between(tau, steepest, flattest, color=colour, alpha=0.2, linewidth=0, label=estimate.told)
        if estimate.escapes:
            ax.plot(tau, fitted, color=colour, linewidth=0.9, linestyle="--")
        if legend:
            ax.legend(loc="best")
        lowest = min(lowest, float(steepest[-1]))
    ax.set_yscale("log")
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.set(xlabel=axis_label("waited"), ylabel=axis_label("survivors"), xlim=(0.0, end))
    ax.set_ylim(max(0.7 * lowest, 1.4 * BELOW), 1.4 * max(survivors[0], 1))
    return ax


@checked
def survival_curves(
    results: Mapping[str, xr.Dataset],
    ax: Axes | None = None,
    *,
    until: int | None = None,
    lowest: float = 0.005,
    **look: Any,
) -> Axes:
    """The survivors of several watches in one picture, each as a share of those that `discard` left.

    Time begins at the end of what is discarded, so all begin at one; a constant rate is a straight line through that
    point. Steps for the survivors; dashed, the line of the fitted rate in the strip of its interval. The longer a mean
    life, the darker the curve. Its name stands where it leaves the picture. One that had nothing left to watch is not
    drawn.

    Parameters
    ----------
    results : mapping of str to xarray.Dataset
        Of `gearpair.survival`, by the name that a curve gets.
    until : int, optional
        Mesh periods that are shown; as long as all were watched when not given.
    lowest : float
        The smallest share that is shown.

    Examples
    --------
    >>> import gearpair as gp
    >>> two = {f"at {speed}": gp.Oscillator(mesh_frequency=speed) for speed in (1.09, 1.219)}
    >>> ax = survival_curves({name: gp.survival(osc, [-1.0, 0.0, 1.0], -1.0) for name, osc in two.items()})
    >>> sorted(text.get_text() for text in ax.texts)
    ['at 1.09', 'at 1.219']
    """
    lowest = check_number("lowest", lowest, above=0.0, below=1.0)
    if until is not None:
        until = check_count("until", until)
    ax = new_axes(ax, 4.0)
    estimates = {name: estimate_of(result) for name, result in results.items()}
    ranked = sorted((name for name in results if estimates[name].n_watched), key=lambda name: estimates[name].mean_life)
    watches = [result.attrs["n_periods"] - result.attrs["discard"] for result in results.values()]
    end = float(min(watches, default=1) if until is None else until)
    for i, name in enumerate(ranked):
        estimate, result = estimates[name], results[name]
        shade = legible(ax, LIVES(SHORTEST + (LONGEST - SHORTEST) * i / max(len(ranked) - 1, 1)))
        steps = look_of(Line2D, look, color=shade, linewidth=1.6, label=name)
        colour = steps["color"]
        since = result.waited.values - result.attrs["discard"]
        shares = np.maximum(result.survivors.values / estimate.n_watched, 0.1 * lowest)
        ax.step(since[since >= 0], shares[since >= 0], where="post", **steps)
        tau = np.linspace(0.0, end, 400)
        rates = estimate.escape_rate_high, estimate.escape_rate, estimate.escape_rate_low
        steepest, fitted, flattest = (np.exp(-rate * tau) for rate in rates)
        ax.fill_between(tau, steepest, flattest, color=colour, alpha=0.16, linewidth=0)
        if estimate.escapes:
            ax.plot(tau, fitted, color=colour, linewidth=0.8, linestyle="--")
        _name_curve(ax, name, float(estimate.escape_rate), end, lowest, colour)
    ax.set_yscale("log")
    ax.set_yticks([*SHARES], [*SHARES.values()])
    ax.set_yticks([], minor=True)
    ax.set(xlabel=axis_label("waited"), ylabel=axis_label("survivors"), xlim=(0.0, end), ylim=(lowest, 1.25))
    ax.grid(axis="y", color=BOUNDARY, alpha=0.25, linewidth=0.6)
    return ax


def _name_curve(ax: Axes, name: str, rate: float, end: float, lowest: float, colour: ColorType) -> None:
    """A curve's name beside the frame where it leaves on the right, and beside the curve where it leaves below."""
    low = 1.6 * lowest
    if np.exp(-rate * end) > low:
        at, height, centre = end, float(np.exp(-rate * end)), "center"
    else:
        at, height, centre = -np.log(low) / rate, low, "baseline"
    ax.annotate(
        name, (at, height), (6.0, 0.0), textcoords="offset points", va=centre, color=colour,
        annotation_clip=False, fontsize=9.0,
    )  # fmt: skip
