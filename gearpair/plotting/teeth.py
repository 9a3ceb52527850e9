"""Teeth, what yields in them, and the mesh stiffness that comes of it."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from gearpair._checks import check_count, checked
from gearpair.plotting.paper import legible, look_of, paper
from gearpair.plotting.style import BOUNDARY, INK, add_legend, new_axes, note, these_axes
from gearpair.quantities import axis_label
from gearpair.teeth.finite_elements import MEASURES, FiniteElementBody
from gearpair.teeth.loading import LoadedMesh
from gearpair.teeth.meshing import MeshStiffness
from gearpair.teeth.spurgear import SpurGear
from gearpair.teeth.tooth_profile import Root, ToothProfile

Array = NDArray[np.float64]

ROOT_NAMES: Mapping[str, str] = {
    "trochoid": "fillet cut by the rack",
    "straight": "straight lines to the root circle",
    "base_circle": "clamped at the base circle",
}
ROOT_COLOURS: Mapping[str, str] = {"trochoid": INK, "straight": "#D55E00", "base_circle": "#009E73"}
# Warm for the pinion, cold for the gear, the same order of parts in both; grey for what they share.
PART_COLOURS: Mapping[str, str] = {
    "pinion_foundation": "#B8621B",
    "pinion_shear": "#DB8F4B",
    "pinion_bending": "#EFBC8B",
    "pinion_axial": "#F8E2CB",
    "gear_foundation": "#1F5A8C",
    "gear_shear": "#5B8FBC",
    "gear_bending": "#9DBFDC",
    "gear_axial": "#D6E4F0",
    "hertz": "#8C8577",
}
MEASURE_LOOKS: Mapping[str, tuple[str, str]] = {
    "section": ("o", "mean motion of the loaded section"),
    "tip": ("^", "motion of the unloaded tooth end"),
    "centre": ("v", "down to the centre line"),
}
LABEL_STIFFNESS = "stiffness per width (N/mm/µm)"
SINCE_ENTRY = "mesh periods since the pair entered contact"


@checked
def per_width(mesh: MeshStiffness) -> float:
    """Factor from N/m to N/(mm µm): stiffness per millimetre of face width and micrometre of approach.

    Examples
    --------
    >>> import gearpair as gp
    >>> mesh = gp.mesh_stiffness(gp.SpurPair())
    >>> round(mesh.mean * per_width(mesh), 1)
    19.2
    """
    return 1e-6 / mesh.pair.contact_width_mm


@checked
def tooth_outlines(
    gear: SpurGear,
    ax: Axes | None = None,
    *,
    roots: Sequence[Root] = ("trochoid", "straight", "base_circle"),
    **look: Any,
) -> Axes:
    """One tooth with each kind of root, on its root and base circles; lengths in modules.

    One line for each root, labelled in words, and the base circle, root circle and tip circle.

    Parameters
    ----------
    roots : sequence of str
        As `ToothProfile` knows them; the first is filled.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = tooth_outlines(gp.SpurPair().pinion, roots=["trochoid"])
    >>> ax.lines[-1].get_label()
    'fillet cut by the rack'
    """
    ax = new_axes(ax, 3.6)
    pitch = math.pi / gear.teeth
    arc = np.linspace(-pitch, pitch, 61)
    circles = {"base circle": gear.base_radius_mm, "root circle": gear.root_circle_mm, "tip circle": gear.tip_circle_mm}
    for name, radius_mm in circles.items():
        radius = radius_mm / gear.module_mm
        ax.plot(radius * np.sin(arc), radius * np.cos(arc), color=BOUNDARY, linewidth=0.6, linestyle=(0, (5, 3)))
        at_end = (radius * math.sin(pitch), radius * math.cos(pitch))
        note(ax, name, at_end, (3, 0), fontsize=7.5, color=BOUNDARY, va="center")
    for k, root in enumerate(roots):
        h, y = _outline(ToothProfile(gear, root))
        usual: dict[str, Any] = {"linestyle": "--", "linewidth": 1.4} if k else {"linestyle": "-", "linewidth": 2.0}
        usual |= {"color": legible(ax, ROOT_COLOURS[root]), "label": ROOT_NAMES[root]}
        line = look_of(Line2D, look, **usual)
        if k == 0:
            ax.fill(h, y, color=line["color"], alpha=0.10, linewidth=0)
        ax.plot(h, y, **line)
    ax.set(xlabel="modules from the centre line", ylabel="modules from the gear's centre", aspect="equal")
    add_legend(ax, loc="lower left", bbox_to_anchor=(0.0, 1.0))
    return ax


def _outline(tooth: ToothProfile) -> tuple[Array, Array]:
    """Left foot over the tip to the right foot: half thickness with sign, and height; in modules."""
    gear = tooth.gear
    tip = math.sqrt((gear.tip_circle_mm / gear.base_radius_mm) ** 2 - 1.0)
    y_root, h_root, *_ = tooth.fillet(np.linspace(0.0, 1.0, 50))
    y_flank, h_flank, *_ = tooth.involute(np.linspace(tooth.first_roll, tip, 50))
    h, y = np.concatenate([h_root, h_flank]), np.concatenate([y_root, y_flank])
    return np.concatenate([-h, h[::-1]]), np.concatenate([y, y[::-1]])


@checked
def compliance_stack(mesh: MeshStiffness, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """What the compliance of one pair of teeth is made of, stacked along its path of contact.

    One filled band for each part; compliance times face width, in micrometres per N/mm. The legend beside the axes has
    the uppermost first.

    Examples
    --------
    >>> import gearpair as gp
    >>> mesh = gp.mesh_stiffness(gp.SpurPair(), n_phases=50)
    >>> [band.get_label() for band in compliance_stack(mesh).collections][:3]
    ['pinion, foundation', 'pinion, shear', 'pinion, bending']
    """
    ax = new_axes(ax, 3.8)
    parts = [name for name in PART_COLOURS if np.any(mesh.compliance_m_per_n[name])]
    bands = [mesh.compliance_m_per_n[name] / per_width(mesh) for name in parts]
    names, colours = [name.replace("_", ", ") for name in parts], [PART_COLOURS[name] for name in parts]
    area = look_of(PolyCollection, look, linewidth=0.4, edgecolor="white")
    ax.stackplot(mesh.path, bands, labels=names, colors=colours, **area)
    _along_contact(mesh, ax, "compliance (µm per N/mm)")
    if legend:
        add_legend(ax, loc="center left", bbox_to_anchor=(1.0, 0.5), reverse=True)
    return ax


def _along_contact(mesh: MeshStiffness, ax: Axes, ylabel: str) -> None:
    """The axes of what one pair does on its way, from zero, with the pitch point marked."""
    pair = mesh.pair
    on_pinion = pair.pinion.base_radius_mm * math.tan(pair.working_pressure_angle)
    where = (on_pinion - pair.contact_start_mm) / pair.base_pitch_mm
    if 0.0 <= where <= pair.contact_ratio:
        ax.axvline(where, color=legible(ax, "#444444"), linewidth=0.8, linestyle=":")
    ax.set(xlabel=SINCE_ENTRY, ylabel=ylabel, xlim=(0.0, mesh.contact_ratio), ylim=(0.0, None))


@checked
def pair_stiffness(mesh: MeshStiffness, ax: Axes | None = None, **look: Any) -> Axes:
    """Stiffness of one pair of teeth alone along its path of contact.

    Examples
    --------
    >>> import gearpair as gp
    >>> mesh = gp.mesh_stiffness(gp.SpurPair(), n_phases=50)
    >>> pair_stiffness(mesh).get_ylabel()
    'stiffness per width (N/mm/µm)'
    """
    ax = new_axes(ax, 3.0)
    ax.plot(mesh.path, mesh.pair_stiffness_n_per_m * per_width(mesh), **look_of(Line2D, look, color=legible(ax, INK)))
    _along_contact(mesh, ax, LABEL_STIFFNESS)
    return ax


@checked
def mesh_curves(
    meshes: Mapping[str, MeshStiffness],
    ax: Axes | None = None,
    *,
    n_periods: int = 2,
    two_levels: bool = False,
    colours: Sequence[str] = (INK, "#D55E00", "#009E73", "#CC79A7", "#56B4E9"),
    **look: Any,
) -> Axes:
    """Mesh stiffness over some mesh periods, one curve for each name.

    In N per millimetre of face width and micrometre, from zero.

    Parameters
    ----------
    meshes : mapping of str to MeshStiffness
    n_periods : int
    two_levels : bool
        Add the mean over each zone of the period, dashed: the rectangle, where two pairs and one alternate.
    colours : sequence of str
        Taken in turn.
    **look
        Of all the curves.

    Examples
    --------
    >>> import gearpair as gp
    >>> mesh = gp.mesh_stiffness(gp.SpurPair(), n_phases=50)
    >>> ax = mesh_curves({"34 and 34 teeth": mesh}, n_periods=3)
    >>> ax.lines[0].get_label(), float(ax.get_xlim()[1])
    ('34 and 34 teeth', 3.0)
    """
    n_periods = check_count("n_periods", n_periods)
    ax = new_axes(ax, 3.0)
    for k, (name, mesh) in enumerate(meshes.items()):
        factor = per_width(mesh)
        line = look_of(Line2D, look, color=legible(ax, colours[k % len(colours)]), label=name)
        colour = line["color"]
        time = np.concatenate([mesh.phase + period for period in range(n_periods)])
        values = np.tile(mesh.stiffness_n_per_m * factor, n_periods)
        jumps = np.flatnonzero(np.diff(np.tile(mesh.pairs_in_contact, n_periods))) + 1
        broken = np.insert(time, jumps, np.nan), np.insert(values, jumps, np.nan)
        ax.plot(*broken, **line)
        ax.vlines(time[jumps], values[jumps - 1], values[jumps], color=colour, linewidth=0.5, linestyle=":")
        if two_levels:
            wave = mesh.wave(len(mesh.zones))
            edges = np.concatenate([np.add(wave.edges, period) for period in range(n_periods)] + [[n_periods]])
            levels = np.tile(wave.levels, n_periods) * mesh.mean * factor
            ax.stairs(levels, edges, baseline=None, color=colour, linestyle="--", linewidth=1.0)
    ax.set(xlabel=axis_label("tau"), ylabel=LABEL_STIFFNESS, xlim=(0.0, n_periods), ylim=(0.0, None))
    if len(meshes) > 1:
        add_legend(ax, columns=len(meshes), loc="lower left", bbox_to_anchor=(0.0, 1.0))
    return ax


@checked
def load_shares(
    meshes: Mapping[str, MeshStiffness],
    ax: Axes | None = None,
    *,
    colours: Sequence[str] = (INK, "#D55E00"),
    **look: Any,
) -> Axes:
    """The share of the load that one pair of teeth carries while it crosses its path of contact, the colours in turn.

    Examples
    --------
    >>> import gearpair as gp
    >>> mesh = gp.mesh_stiffness(gp.SpurPair(), n_phases=50)
    >>> ax = load_shares({"34 and 34 teeth": mesh})
    >>> round(float(ax.lines[0].get_ydata().max()), 6)  # alone it carries all
    1.0
    """
    ax = new_axes(ax, 2.4)
    for k, (name, mesh) in enumerate(meshes.items()):
        time = np.concatenate([mesh.phase + period for period in range(len(mesh.load_share))])
        share = mesh.load_share.ravel()
        line = look_of(Line2D, look, color=legible(ax, colours[k % len(colours)]), label=name)
        ax.plot(time[share > 0.0], share[share > 0.0], **line)
    ax.set(xlabel=SINCE_ENTRY, ylabel="share of the load", ylim=(0.0, 1.05))
    return ax


@checked
def under_load(
    meshes: Mapping[str, LoadedMesh],
    axes: Sequence[Axes],
    *,
    colours: Sequence[str] = (INK, "#D55E00", "#009E73"),
    **look: Any,
) -> list[Axes]:
    """Meshes under their loads over one mesh period: approach, stiffness and the share of each pair of teeth.

    One line for each name on the first two axes, on the third one for each pair that carries, in the name's colour.

    Parameters
    ----------
    meshes : mapping of str to LoadedMesh
    axes : sequence of three Axes
    colours : sequence of str
        Taken in turn.

    Examples
    --------
    >>> import gearpair as gp
    >>> from matplotlib import pyplot as plt
    >>> mesh = gp.mesh_stiffness(gp.SpurPair(), n_phases=50)
    >>> loaded = gp.teeth.loaded_mesh(mesh, gp.teeth.tip_relief(mesh, 20.0, 20.0, 0.4), 2000.0)
    >>> axes = under_load({"2 kN": loaded}, plt.figure().subplots(3, 1))
    >>> axes[0].get_ylabel(), [len(ax.lines) for ax in axes]
    ('approach (µm)', [1, 1, 2])
    """
    axes = these_axes(axes, 3)
    for k, (name, loaded) in enumerate(meshes.items()):
        mesh = loaded.mesh
        line = look_of(Line2D, look, color=legible(axes[0], colours[k % len(colours)]), label=name)
        for ax, values in zip(axes, (loaded.approach_um, loaded.stiffness_n_per_m * per_width(mesh)), strict=False):
            ax.plot(mesh.phase, values, **line)
        for share in loaded.load_share:
            axes[2].plot(mesh.phase, np.where(share > 0.0, share, np.nan), **{**line, "label": None})
    for ax, ylabel in zip(axes, ("approach (µm)", LABEL_STIFFNESS, "share of the load"), strict=True):
        ax.set(ylabel=ylabel, xlim=(0.0, 1.0), ylim=(0.0, None))
    axes[-1].set(xlabel=axis_label("tau"), ylim=(0.0, 1.05))
    if len(meshes) > 1:
        add_legend(axes[0], columns=len(meshes), loc="lower left", bbox_to_anchor=(0.0, 1.0))
    return list(axes)


@checked
def finite_element_check(body: FiniteElementBody, mesh: MeshStiffness, axes: Sequence[Axes], **look: Any) -> list[Axes]:
    """Compliance of one tooth and its gear body: the fast curve, finite elements, and how far apart they are.

    The first has the curve and one line of points for each measure, the second one line for each measure.

    Parameters
    ----------
    body : FiniteElementBody
    mesh : MeshStiffness
        Of the body's pair.
    axes : sequence of two Axes
        For the compliance, times E and face width, and for the deviation of the curve in percent.

    Examples
    --------
    >>> import gearpair as gp
    >>> from matplotlib import pyplot as plt
    >>> body = gp.teeth.finite_element_bodies()["34"]
    >>> axes = finite_element_check(body, gp.mesh_stiffness(body.pair, n_phases=50), plt.figure().subplots(2, 1))
    >>> [ax.get_ylabel() for ax in axes][1], len(axes[0].lines)
    ('deviation (%)', 4)
    """
    upper, lower = these_axes(axes, 2)
    unit = body.body.material.youngs_modulus_gpa * 1e9 * mesh.pair.contact_width_mm * 1e-3
    fast = unit * sum(v for name, v in mesh.compliance_m_per_n.items() if name.startswith(body.who))
    upper.plot(mesh.path, fast, color=legible(upper, INK), label="potential energy and foundation formula")
    lower.axhline(0.0, color=BOUNDARY, linewidth=0.7)
    for name, colour in zip(MEASURES, ("#D55E00", "#009E73", "#8A6D3B"), strict=True):
        marker, words = MEASURE_LOOKS[name]
        usual: dict[str, Any] = {"marker": marker, "markersize": 4.5, "color": colour, "label": words}
        dots = look_of(Line2D, look, markerfacecolor=paper(upper), **usual)
        upper.plot(body.positions, body.compliance[name], **{**dots, "linestyle": ""})
        deviation = np.interp(body.positions, mesh.path, fast) / body.compliance[name] - 1.0
        lower.plot(body.positions, 100.0 * deviation, **{"linewidth": 0.8, **dots})
    reach = (-0.03, mesh.contact_ratio + 0.03)
    upper.set(ylabel=r"compliance $\times\, E b$", xlim=reach, ylim=(0.0, None))
    lower.set(xlabel=SINCE_ENTRY, ylabel="deviation (%)", xlim=reach)
    upper.legend(loc="upper left")
    return [upper, lower]
