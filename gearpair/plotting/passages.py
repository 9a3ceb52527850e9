"""Pictures of a drive in service: its passages through speed and load, and the shocks that it bears."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import ListedColormap, to_rgb
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d
from scipy.signal import ShortTimeFFT
from scipy.signal.windows import hann

from gearpair._checks import check_count, checked
from gearpair.ensembles.planes import attractor_motions
from gearpair.motion.settling import Status
from gearpair.plotting.bifurcations import add_key
from gearpair.plotting.maps import ENDS, name_colours
from gearpair.plotting.maps import basins as basins_map
from gearpair.plotting.paper import legible, look_of, paper
from gearpair.plotting.style import INK, add_legend, new_axes, note, over_parameter
from gearpair.quantities import axis_label

FALLING = "#D55E00"
STEADY = "#9A9A9A"
PATH = "#111111"
PALE = ("#A9CCE3", "#F5CBA7", "#A9DFBF", "#D7BDE2")  # of the basins behind a path
TOGETHER = 4  # mesh periods of which a passage shows the largest factor
WINDOWS = 40  # of a short-time spectrum, as many as fit side by side
LEAST_PERIODS = 6  # of the mesh in a window
DEEPEST = -60.0  # dB that an order map shows
WAYS_BACK = {
    "dip_back": ("a dip that brings it back", (0, (4, 1.5))),
    "surge_back": ("a rise that does", (0, (1, 1.2))),
}


@checked
def passage_factor(run: xr.Dataset, chart: xr.Dataset | None = None, ax: Axes | None = None, **look: Any) -> Axes:
    """The dynamic factor over the speed while the speed changes, one line; over time where the speed stays.

    Each point is the largest of four mesh periods, so that motions of periods up to 4 are a line and no band.

    Parameters
    ----------
    run : Dataset
        Of `gearpair.design.run_up` or `schedule`; more of them on the same axes, with a ``label`` each.
    chart : Dataset, optional
        The steady motions, drawn in grey behind it.

    Examples
    --------
    >>> import gearpair as gp
    >>> drive = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.0)], damping_ratio=0.08)
    >>> ax = passage_factor(gp.design.run_up(drive, 3000.0, 4000.0, 0.1))
    >>> [line.get_label() for line in ax.lines], ax.get_xlabel()
    (['run up'], 'speed of the pinion (rpm)')
    """
    ax = new_axes(ax)
    over = _abscissa(run)
    if chart is not None:
        for way, dash in (("up", "-"), ("down", (0, (2.5, 1.2)))):
            steady: dict[str, Any] = {"color": legible(ax, STEADY), "linewidth": 2.2, "linestyle": dash, "zorder": 1}
            ax.plot(chart.speed, chart.dynamic_factor.sel(run=way), **steady, label=f"steady, run {way}")
    rises = run.speed.values[-1] >= run.speed.values[0]
    usual: dict[str, Any] = {"color": legible(ax, INK if rises else FALLING), "linewidth": 1.1, "zorder": 2}
    name = "passage" if over == "time" else "run up" if rises else "coast-down"
    highest = maximum_filter1d(run.dynamic_factor.values, TOGETHER)
    ax.plot(run[over].values, highest, **look_of(Line2D, look, label=name, **usual))
    drawn = np.concatenate([np.asarray(line.get_xdata()) for line in ax.lines])
    over_parameter(ax, over, drawn, axis_label("dynamic_factor"), ylim=(0.0, None))
    add_legend(ax, columns=5, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2, handlelength=2.2)
    return ax


@checked
def order_map(run: xr.Dataset, ax: Axes | None = None, *, n_orders: int = 4, **look: Any) -> Axes:
    """Which frequencies the mesh force has while the speed changes, by short-time spectra, and the mesh orders.

    One image over the speed, or over time where the speed does not change steadily, in dB relative to its largest line;
    and as many thin lines as orders, multiples of the mesh frequency.

    Parameters
    ----------
    run : Dataset
        Of `gearpair.design.run_up`, `load_change` or `schedule`, with samples.
    n_orders : int
        Orders of the mesh that the frequencies reach to.

    Examples
    --------
    >>> import gearpair as gp
    >>> drive = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.0)], damping_ratio=0.08)
    >>> ax = order_map(gp.design.run_up(drive, 3000.0, 4000.0, 0.1, samples_per_period=32))
    >>> [text.get_text() for text in ax.texts]
    ['1', '2', '3', '4']
    """
    n_orders = check_count("n_orders", n_orders)
    ax = new_axes(ax, 3.8)
    over = _abscissa(run)
    mesh = _mesh_hz(run)
    time, frequency, level = short_time_levels(run, n_orders)
    place = np.interp(time, run.time.values, run[over].values)
    image = look_of(QuadMesh, look, ENDS, rasterized=True, cmap="Greys", vmin=DEEPEST, vmax=0.0)
    drawn = ax.pcolormesh(place, frequency / 1000.0, level, shading="nearest", **image)
    line: dict[str, Any] = {"color": legible(ax, FALLING), "linewidth": 0.6, "alpha": 0.8}
    last = int(np.argmax(run[over].values))
    for order in range(1, n_orders + 1):
        ax.plot(run[over].values, order * mesh / 1000.0, **line)
        at = float(run[over].values[last]), order * float(mesh[last]) / 1000.0
        note(ax, f"{order}", at, (3, 0), fontsize=8, va="center", color=legible(ax, FALLING))
    over_parameter(ax, over, run[over].values, "frequency (kHz)", ylim=(0.0, frequency[-1] / 1000.0))
    ax.figure.colorbar(drawn, ax=ax, label="dB, relative to the largest", pad=0.05)
    return ax


@checked
def passage_path(run: xr.Dataset, basins: xr.Dataset | None = None, ax: Axes | None = None, **look: Any) -> Axes:
    """The path of a passage through the plane of starts, a dot a mesh period, from a circle to a square.

    One line of the path, and a mark at each end.

    Parameters
    ----------
    run : Dataset
        Of `gearpair.passage`, `gearpair.design.run_up`, `load_change` or `schedule`.
    basins : Dataset, optional
        The plane of the oscillator that the passage ends with, drawn behind it.

    Examples
    --------
    >>> import gearpair as gp
    >>> osc = gp.Oscillator()
    >>> ax = passage_path(gp.passage([osc] * 20, 1.0, 0.0), gp.basins(osc, [-2.0, 1.0], [0.0, 0.5]))
    >>> [line.get_label() for line in ax.lines[-3:]]
    ['path', 'first', 'last']
    """
    ax = new_axes(ax, 5.0)
    if basins is None:
        ax.set(xlabel=axis_label("start_x"), ylabel=axis_label("start_v"))
    else:
        _basins_apart(basins, ax)
    over = ax.has_data()
    limits = {"xlim": ax.get_xlim(), "ylim": ax.get_ylim()} if over else {}
    ink, halo = legible(ax, PATH), [withStroke(linewidth=2.2, foreground=paper(ax))]
    usual: dict[str, Any] = {
        "color": ink,
        "linewidth": 0.7,
        "marker": ".",
        "markersize": 3.5,
        "path_effects": halo,
        "zorder": 3,
    }
    (path,) = ax.plot(run.x.values, run.v.values, **look_of(Line2D, look, label="path", **usual))
    marks = [
        ax.plot(
            run.x.values[at], run.v.values[at], sign, markersize=6.5, color=ink, markerfacecolor=paper(ax), label=name,
            zorder=4,
        )[0]
        for at, sign, name in ((0, "o", "first"), (-1, "s", "last"))
    ]  # fmt: skip
    ax.set(**limits)
    add_key(ax, [path, *marks])
    return ax


@checked
def shock_margins(margin: xr.Dataset, ax: Axes | None = None, **look: Any) -> Axes:
    """The smallest dip of the torque that ends the quieter motion over the speed, and what brings the louder one back.

    A line each; triangles along the top where no dip that was tried ends the quieter motion.

    Parameters
    ----------
    margin : Dataset
        Of `gearpair.design.shock_margin`.

    Examples
    --------
    >>> import gearpair as gp
    >>> drive = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.0)], damping_ratio=0.08)
    >>> ax = shock_margins(gp.design.shock_margin(drive, [2000.0, 3000.0], n_phases=1, n_starts=2))
    >>> [text.get_text() for text in ax.texts]
    ['one motion at each of these speeds']
    """
    ax = new_axes(ax)
    speed, several = margin.speed.values, margin.n_motions.values > 1
    usual: dict[str, Any] = {"color": legible(ax, INK), "marker": ".", "markersize": 5.0, "linewidth": 1.8}
    ends = look_of(Line2D, look, label="a dip that ends the quieter motion", **usual)
    ax.plot(speed, margin.shock_margin.values, **ends)
    for name, (label, dash) in WAYS_BACK.items():
        back: dict[str, Any] = {"color": legible(ax, FALLING), "linestyle": dash, "marker": ".", "markersize": 4.0}
        ax.plot(speed, margin[name].values, **back, label=label)
    top = max(float(margin.attrs["largest_dip"]), float(margin[[*WAYS_BACK]].to_array().max(skipna=True)), 0.0)
    safe = several & np.isnan(margin.shock_margin.values)
    if safe.any():
        height = np.full(safe.sum(), top)
        ax.plot(speed[safe], height, "^", color=legible(ax, INK), markersize=4.5, label="no dip that was tried does")
    over_parameter(ax, "speed", speed, "change of the torque / torque", ylim=(0.0, 1.06 * top))
    if not several.any():
        looks: dict[str, Any] = {"xycoords": "axes fraction", "ha": "center", "va": "center"}
        note(ax, "one motion at each of these speeds", (0.5, 0.5), (0, 0), **looks)
    add_legend(ax, columns=4, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2, handlelength=2.4)
    return ax


def _basins_apart(basins: xr.Dataset, ax: Axes) -> None:
    """The map of the basins, in pale colours that tell motions of one period apart where there are few of them."""
    motions = attractor_motions(basins)
    if len(motions) > len(PALE) or (basins.status.values == Status.TRANSIENT).any():
        basins_map(basins, ax)
        return
    basins_map(basins, ax, legend=False, cmap=ListedColormap(["white", *PALE[: len(motions)]]))
    names = [str(motion) for motion in motions]
    numbered = [
        f"{name}, {names[: i + 1].count(name)}" if names.count(name) > 1 else name for i, name in enumerate(names)
    ]
    name_colours(ax, dict(zip(numbered, map(to_rgb, PALE), strict=False)), columns=2)


def short_time_levels(
    run: xr.Dataset, n_orders: int
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Times (s), frequencies (Hz) and levels (dB re the largest) of short-time spectra of a passage's mesh force."""
    if "sample_force" not in run:
        raise ValueError("run must be a passage that was made with samples_per_period")
    mesh, per_period = _mesh_hz(run), run.sizes["sample"]
    if per_period < 2 * n_orders + 2:
        raise ValueError(f"run must have at least {2 * n_orders + 2} samples_per_period, got {per_period}")
    sampled, force = run.sample_time.values.ravel(), run.sample_force.values.ravel()
    rate, whole = per_period * mesh.max(), float(sampled[-1])
    even = np.arange(int(whole * rate) + 1) / rate
    seconds = min(max(whole / WINDOWS, LEAST_PERIODS / mesh.min()), whole)
    window = hann(max(int(seconds * rate), 8), sym=False)
    transform = ShortTimeFFT(window, max(len(window) // 8, 1), rate, scale_to="magnitude")
    found = np.abs(transform.stft_detrend(np.interp(even, sampled, force), "constant", padding="even"))
    times = transform.t(len(even))
    edge = 0.5 * seconds if whole > 2.0 * seconds else 0.0  # a window beyond an end of the run sees a jolt there
    inside, shown = (times >= edge) & (times <= whole - edge), transform.f <= (n_orders + 0.5) * mesh.max()
    found = found[shown][:, inside]
    level = 20.0 * np.log10(np.maximum(found, 1e-12 * found.max()) / (found.max() or 1.0))
    return times[inside], transform.f[shown], level


def _mesh_hz(run: xr.Dataset) -> NDArray[np.float64]:
    """The mesh frequency of each cycle in Hz; that of the last is taken from the speeds."""
    between = 1.0 / np.diff(run.time.values)
    speed = run.speed.values
    return np.append(between, between[-1] * speed[-1] / speed[-2])


def _abscissa(run: xr.Dataset) -> str:
    """The speed where it rises or falls all the way, else time."""
    steps = np.diff(run.speed.values)
    return "speed" if len(steps) and (np.all(steps > 0.0) or np.all(steps < 0.0)) else "time"
