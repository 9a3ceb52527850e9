"""How long chaos lives: the survivors over the mesh periods."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from gearpair.ensembles.lifetimes import estimate_of
from gearpair.plotting.style import BOUNDARY, INK, new_axes
from gearpair.quantities import axis_label

BELOW = 0.5  # where a curve goes that has no survivors left: under the axis


def survival_curve(result: xr.Dataset, ax: Axes | None = None, *, colour: str = INK, legend: bool = True) -> Axes:
    """The starts still on their way over the mesh periods, on a logarithmic scale, with the fitted escape rate.

    Steps for the survivors; dashed, from the end of what is discarded (dotted), the line of the fitted rate in the
    strip of its interval. Without an escape there is no line, and the strip is how fast survivors may fall at most.
    The legend says what mean life the strip stands for.

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
    ax.step(waited, np.maximum(survivors, BELOW), where="post", color=colour)
    ax.axvline(result.attrs["discard"], color=BOUNDARY, linewidth=0.9, linestyle=(0, (1, 1.6)), zorder=-1)
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
            ax.legend(loc="upper right")
    ax.set_yscale("log")
    ax.set(xlabel=axis_label("waited"), ylabel=axis_label("survivors"), xlim=(0.0, end))
    ax.set_ylim(1.4 * BELOW, 1.4 * max(survivors[0], 1))
    return ax
