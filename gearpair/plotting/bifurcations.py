"""Branches of periodic orbits and curves of their bifurcations."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.transforms import ScaledTranslation

from gearpair._checks import checked
from gearpair.bifurcations.branches import Branch
from gearpair.bifurcations.curves import BifurcationCurve
from gearpair.motion.names import periodic
from gearpair.plotting.paper import legible, look_of, paper
from gearpair.plotting.style import INK, colour_on, fits, new_axes
from gearpair.quantities import axis_label

MARKERS = {"fold": "^", "flip": "o", "grazing": "D"}
BELOW = -0.36  # inches from a map down to its key: past the ticks and the name of the axis
DASHES: dict[str, Any] = {"fold": "-", "flip": "--", "grazing": ":"}


@checked
def branches(
    found: Iterable[Branch],
    ax: Axes | None = None,
    *,
    periods: Sequence[int] | None = None,
    markers: bool = True,
    **look: Any,
) -> Axes:
    """X on the section along branches of orbits: solid where stable, dashed where unstable, bifurcations marked.

    One line for each run of stable or of unstable orbits of each section point of each branch.

    Parameters
    ----------
    found : iterable of Branch
        Along one parameter.
    ax : Axes, optional
        For example that of a `bifurcation_diagram`, to draw over its points.
    periods : sequence of int, optional
        The periods to draw; all when not given.
    markers : bool
        Mark folds (triangles), flips (circles) and grazings (diamonds).

    Examples
    --------
    >>> import gearpair as gp
    >>> orbit = gp.periodic_orbit(gp.Oscillator(), 0.34629, -0.25625, 2)
    >>> ax = branches([gp.continue_orbit(orbit, "mesh_frequency", 0.7, 0.78)])
    >>> [line.get_marker() for line in ax.lines if line.get_marker() != "None"]  # a flip
    ['o']
    """
    ax = new_axes(ax)
    kinds = set()
    for branch in found:
        if periods is not None and branch.period not in periods:
            continue
        colour = look_of(Line2D, look, color=colour_on(ax, periodic(branch.period)))["color"]
        for stable in (False, True):
            for k in range(branch.period):
                shown = np.where(_runs(branch.stable, stable), branch.points[:, k, 0], np.nan)
                style = {"linewidth": 1.8} if stable else {"linewidth": 0.9, "linestyle": (0, (3.5, 1.8))}
                ax.plot(branch.values, shown, **look_of(Line2D, look, color=colour, **style))
        for b in branch.bifurcations if markers else ():
            kinds.add(b.kind)
            rim: dict[str, Any] = {"markeredgecolor": paper(ax), "markeredgewidth": 0.5}
            ax.plot(b.value, b.x, MARKERS[b.kind], markersize=3.6, color=colour, zorder=5, **rim)
        ax.set_xlabel(axis_label(branch.parameter))
    ax.set_ylabel(axis_label("section"))
    grey = legible(ax, "#555555")
    add_key(ax, [Line2D([], [], marker=MARKERS[k], linestyle="", color=grey, label=k) for k in MARKERS if k in kinds])
    return ax


def add_key(ax: Axes, handles: list[Line2D]) -> None:
    """A key inside the axes, beside the legend of motions that may be above them; below a map if there is room."""
    if not handles:
        return
    names = [str(handle.get_label()) for handle in handles]
    places: list[dict[str, Any]] = [{"loc": "upper right"}]
    if ax.images or any(isinstance(each, QuadMesh) for each in ax.collections):  # a map leaves no room free of data
        below = ax.transAxes + ScaledTranslation(0.0, BELOW, ax.figure.dpi_scale_trans)
        places.insert(0, {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "bbox_transform": below})
    for place in places:
        for n in range(len(handles), 0, -1):
            key = Legend(ax, handles, names, ncols=n, framealpha=0.9, edgecolor="none", frameon=True, **place)
            if key.get_window_extent().width < ax.bbox.width:
                break
        if fits(key, ax):
            break
    ax.add_artist(key)
    key.set_clip_on(False)  # so that a layout leaves room for it


def _runs(stable: np.ndarray, wanted: bool) -> np.ndarray:
    """Where orbits are as wanted; those of unstable ones are widened by one, so that solid and dashed runs meet."""
    inside = stable == wanted
    widened = inside.copy()
    if not wanted:
        widened[1:] |= inside[:-1]
        widened[:-1] |= inside[1:]
    return widened


@checked
def bifurcation_curves(curves: Iterable[BifurcationCurve], ax: Axes | None = None, **look: Any) -> Axes:
    """Curves of folds (solid), flips (dashed) and grazings (dotted) in the plane of two parameters.

    Parameters
    ----------
    curves : iterable of BifurcationCurve
        In the same two parameters.
    ax : Axes, optional
        For example that of a `period_map`, to draw over it.
    **look
        Of all curves; the colour is that of the orbit's period when not given.

    Examples
    --------
    >>> import gearpair as gp
    >>> orbit = gp.periodic_orbit(gp.Oscillator(), 0.34629, -0.25625, 2)
    >>> flip = gp.continue_orbit(orbit, "mesh_frequency", 0.7, 0.78).bifurcations[0]
    >>> curve = gp.continue_bifurcation(flip, {"mesh_frequency": (0.76, 0.78), "damping_ratio": (0.019, 0.021)})
    >>> bifurcation_curves([curve]).lines[0].get_linestyle()
    '--'
    """
    ax = new_axes(ax)
    drawn, given = list(curves), look_of(Line2D, look)
    for curve in drawn:
        usual = {"color": colour_on(ax, periodic(curve.period)), "linestyle": DASHES[curve.kind], "linewidth": 1.3}
        halo = [withStroke(linewidth=3.2, foreground=paper(ax))]
        ax.plot(*curve.values.T, **{"path_effects": halo, **usual, **given})
        ax.set(xlabel=axis_label(curve.parameters[0]), ylabel=axis_label(curve.parameters[1]))
    kinds = [kind for kind in DASHES if any(kind == curve.kind for curve in drawn)]
    shade = given.get("color", legible(ax, INK))
    handles = [Line2D([], [], color=shade, linestyle=DASHES[kind], label=kind) for kind in kinds]
    if "color" not in given:
        periods = sorted({curve.period for curve in drawn})
        handles += [Line2D([], [], color=colour_on(ax, m), label=str(m)) for m in map(periodic, periods)]
    add_key(ax, handles)
    return ax
