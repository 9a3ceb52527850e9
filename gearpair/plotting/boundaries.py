"""What lies between attractors: the manifolds of a saddle on a boundary, and the chaotic saddle behind a transient."""

from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from gearpair._checks import checked
from gearpair.boundaries.growing import Manifolds
from gearpair.plotting.bifurcations import add_key
from gearpair.plotting.paper import legible, look_of, paper
from gearpair.plotting.style import MOTION_COLOURS, new_axes
from gearpair.quantities import axis_label

STABLE, UNSTABLE = "#111111", "#B2182B"  # told apart from all motions', and from each other without colours by the dash


@checked
def manifolds(found: Manifolds, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """The curves on which motions approach a saddle (solid) and leave it (dashed), with its section points (diamonds).

    Parameters
    ----------
    found : Manifolds
        Of `gearpair.manifolds`.
    ax : Axes, optional
        For example that of a `basins`, to draw over it: its limits and its legend stay.
    legend : bool
        Whether the curves are named: inside the axes, or below a map.

    Examples
    --------
    >>> import gearpair as gp
    >>> saddle = gp.periodic_orbit(gp.Oscillator(), -1.5688, -1.0135, 1)
    >>> ax = manifolds(gp.manifolds(saddle, length=3.0))
    >>> sorted({line.get_label() for line in ax.lines})
    ['saddle', 'stable manifold', 'unstable manifold']
    """
    over = ax is not None and ax.has_data()
    ax = new_axes(ax, 5.0)
    limits = ax.get_xlim(), ax.get_ylim()
    looks: dict[str, dict[str, Any]] = {
        "stable": {"color": legible(ax, STABLE), "linewidth": 1.1},
        "unstable": {"color": legible(ax, UNSTABLE), "linewidth": 0.9, "linestyle": (0, (5, 1.2))},
    }
    handles: list[Line2D] = []
    halo = [withStroke(linewidth=2.4, foreground=paper(ax))]
    for name, own in looks.items():
        for curve in getattr(found, name):
            usual = {"label": f"{name} manifold", "path_effects": halo, "zorder": 3, **own}
            (line,) = ax.plot(*curve.T, **look_of(Line2D, look, **usual))
        handles.append(line)
    (dots,) = ax.plot(
        *found.orbit.points.T, "D", markersize=5.0, color=legible(ax, STABLE), markeredgecolor=paper(ax),
        label="saddle", zorder=4,
    )  # fmt: skip
    if over:
        ax.set(xlim=limits[0], ylim=limits[1])
    else:
        ax.set(xlabel=axis_label("x"), ylabel=axis_label("v"))
    if legend:
        add_key(ax, [*handles, dots])
    return ax


@checked
def chaotic_saddle(result: xr.Dataset, ax: Axes | None = None, **look: Any) -> Axes:
    """The section points near a chaotic saddle, of `gearpair.ensembles.chaotic_saddle`: one line of dots.

    Examples
    --------
    >>> import gearpair as gp
    >>> found = gp.ensembles.chaotic_saddle(gp.Oscillator(mesh_frequency=1.09), [-1.0, 0.0, 1.0, 2.0], -1.0)
    >>> len(chaotic_saddle(found).lines[0].get_xdata()) == found.sizes["point"]
    True
    """
    ax = new_axes(ax, 5.0)
    usual: dict[str, Any] = {"linestyle": "", "marker": ".", "markersize": 1.2, "markeredgewidth": 0.0}
    usual |= {"color": legible(ax, MOTION_COLOURS["chaotic transient"]), "rasterized": True}
    ax.plot(result.x.values, result.v.values, **look_of(Line2D, look, **usual))
    ax.set(xlabel=axis_label("x"), ylabel=axis_label("v"))
    return ax
