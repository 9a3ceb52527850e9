"""Pictures of drives in service: a series of gearboxes, and what a test rig tells."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import PercentFormatter

from gearpair._checks import checked
from gearpair.design import Identification, helps_most
from gearpair.plotting.paper import faint, legible, look_of
from gearpair.plotting.speed_chart import BAND, CHANGES
from gearpair.plotting.style import INK, add_legend, new_axes, note, over_parameter

HELP = "#0072B2"
RUNS = {"up": ("#D55E00", "-"), "down": ("#0072B2", (0, (4, 1.5)))}


@checked
def rattling_share(found: xr.Dataset, ax: Axes | None = None, **look: Any) -> Axes:
    """The share of gearboxes whose teeth part over the speed, with its interval, and what helps most.

    One line on the band of its interval, and a broken one of those gearboxes that have the better half of the quantity
    whose better half has the smallest share over all speeds: what a narrower tolerance brings. A phase, which nobody
    tells a workshop, is not looked at unless it is all that differs.

    Parameters
    ----------
    found : xarray.Dataset
        As `gearpair.design.population` gives it.

    Examples
    --------
    >>> import gearpair as gp
    >>> drive = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=5.0, damping_ratio=0.05)
    >>> spread = {"transmission_error_um": (0.5, 8.0), "backlash_um": (60.0, 100.0)}
    >>> ax = rattling_share(gp.design.population(drive, spread, [3000.0, 5000.0, 8000.0], n=32))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['all gearboxes, with 95 % interval', 'lower half of transmission error']
    """
    ax = new_axes(ax, 3.0)
    speed, share = found.speed.values, found.parting_share.values
    low, high = (found[f"parting_share_{end}"].values for end in ("low", "high"))
    ax.fill_between(speed, low, high, color=faint(ax, BAND), linewidth=0, zorder=0)
    told = f"all gearboxes, with {100 * found.attrs['confidence']:g} % interval"
    ax.plot(speed, share, **look_of(Line2D, look, color=legible(ax, INK), linewidth=1.8, label=told))
    quantity, half = helps_most(found)
    better = found.half_share.sel(quantity=quantity, half=half).values
    named = f"{half} half of {CHANGES.get(quantity, quantity)}"
    usual: dict[str, Any] = {"color": legible(ax, HELP), "linestyle": (0, (4, 1.5)), "linewidth": 1.4}
    ax.plot(speed, better, **{**look_of(Line2D, look, **usual), "label": named})
    over_parameter(ax, "speed", speed, "share of gearboxes whose teeth part", ylim=(-0.02, 1.02))
    ax.yaxis.set_major_formatter(PercentFormatter(1.0))
    add_legend(ax, columns=2, loc="lower left", bbox_to_anchor=(0.0, 1.02), borderaxespad=0.0)
    return ax


@checked
def fold_curves(found: Identification, ax: Axes | None = None, **look: Any) -> Axes:
    """Damping ratios and errors with a fold where a rig jumped: a line for each jump, which meet at the answer.

    Solid for the run up, broken for the run down; the dot is the answer, a cross through it its interval, which may be
    smaller than the dot.

    Examples
    --------
    >>> import gearpair as gp
    >>> drive = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.3)], damping_ratio=0.03)
    >>> ax = fold_curves(gp.design.identify(drive, 8598.25, 7345.0))
    >>> [line.get_label() for line in ax.lines[:2]]
    ['run up, 8598 rpm', 'run down, 7345 rpm']
    """
    ax = new_axes(ax, 3.4)
    several = len(set(found.torques_nm.tolist())) > 1
    rows = zip(found.runs, found.torques_nm.tolist(), found.measured_rpm.tolist(), found.curves, strict=False)
    for run, torque, speed, curve in rows:
        colour, style = RUNS[run]
        named = f"run {run}, {speed:.0f} rpm" + f" at {torque:g} N m" * several
        usual: dict[str, Any] = {"color": legible(ax, colour), "linestyle": style, "linewidth": 1.4, "label": named}
        ax.plot(*curve.T, **look_of(Line2D, look, **usual))
    ax.set(xlabel="damping ratio $\\zeta$", ylabel="transmission error (µm)")
    if found.curves:
        ink, at = legible(ax, INK), (found.damping_ratio, found.transmission_error_um)
        ends = [np.clip(each, 1e-6, 1e6) for each in (found.damping_interval, found.error_interval)]
        limits = ax.get_xlim(), ax.get_ylim()
        ax.plot(ends[0], [at[1]] * 2, color=ink, linewidth=1.0)
        ax.plot([at[0]] * 2, ends[1], color=ink, linewidth=1.0)
        ax.plot(*at, "o", color=ink, markersize=4.5, zorder=5)
        ax.set(xlim=limits[0], ylim=limits[1])
        note(ax, f"{at[0]:.3g}, {at[1]:.3g} µm", at, (7, -11), fontsize=8, color=ink)
        add_legend(ax, columns=2, loc="lower left", bbox_to_anchor=(0.0, 1.02), borderaxespad=0.0)
    else:
        looks: dict[str, Any] = {"xycoords": "axes fraction", "ha": "center", "color": legible(ax, INK)}
        note(ax, f"no answer: {found.status}", (0.5, 0.5), (0, 0), **looks)
    return ax
