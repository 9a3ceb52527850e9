"""The look of every figure, in one place."""

from collections.abc import Iterable, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np
from cycler import cycler
from matplotlib import pyplot as plt
from matplotlib import rcParams
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.typing import ColorType

from gearpair._checks import checked
from gearpair.article.published import CHAOTIC, COMPLEX
from gearpair.motion.names import CHAOS, Motion
from gearpair.plotting.paper import contrast, faint, legible, text_colour
from gearpair.quantities import axis_label

# For plt.style.use: a figure that fills the book's column, with text of the size of the book's captions.
STYLE: dict[str, Any] = {
    "figure.figsize": (8.0, 3.4),
    "figure.dpi": 180,
    "figure.constrained_layout.use": True,
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.labelsize": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#555555",
    "axes.linewidth": 0.7,
    "axes.axisbelow": True,
    "xtick.color": "#555555",
    "ytick.color": "#555555",
    "xtick.labelcolor": "#222222",
    "ytick.labelcolor": "#222222",
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "lines.linewidth": 1.2,
    "axes.prop_cycle": cycler(color=["#1F3A5F", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"]),
    "hatch.linewidth": 0.5,
}

# Okabe and Ito (2008), "Color universal design": hues that colour-blind readers tell apart.
MOTION_COLOURS = MappingProxyType(
    {
        "period 1": "#0072B2",
        "period 2": "#E69F00",
        "period 3": "#009E73",
        "period 4": "#D55E00",
        "period 6": "#CC79A7",
        "period 8": "#56B4E9",
        "other periods": "#8A6D3B",
        "chaos": "#3A3A3A",
        "chaotic transient": "#8573A8",
        "unsettled": "#A9A9A9",
        "floating": "#C5D5BE",
        "escaped": "#E5E5E5",
    }
)

BACKLASH = "#F1EDE4"  # the strip where the teeth are out of contact
BOUNDARY = "#8C8577"
INK = "#1F3A5F"  # curves that have no period to tell
# What of the style is meant for light paper; where the figures are dark, the dark style has its own.
OF_PAPER = ("axes.edgecolor", "xtick.color", "ytick.color", "xtick.labelcolor", "ytick.labelcolor", "axes.prop_cycle")
TALLEST = 0.6  # share of a figure that lays itself out which a legend may take


@checked
def motion_colour(motion: Motion) -> str:
    """The colour of a motion, whatever its impact state.

    Examples
    --------
    >>> from gearpair.motion import periodic
    >>> motion_colour(periodic(1)), motion_colour(periodic(17)) == MOTION_COLOURS["other periods"]
    ('#0072B2', True)
    """
    return MOTION_COLOURS.get(legend_name(motion), MOTION_COLOURS["unsettled"])


def legend_name(motion: Motion) -> str:
    """The entry of the legend that a motion comes under: its own, or that of its colour."""
    kind = CHAOS if motion in (COMPLEX, CHAOTIC) else motion.kind
    name = str(kind)
    return "other periods" if kind.period and name not in MOTION_COLOURS else name


def colour_on(ax: Axes, motion: Motion) -> ColorType:
    """The colour of a motion, legible on these axes."""
    return legible(ax, motion_colour(motion))


@checked
def add_motion_legend(ax: Axes, motions: Iterable[Motion], **look: Any) -> None:
    """A row of coloured dots above the axes, in the order of `MOTION_COLOURS`; rows where one is too long.

    `look` is matplotlib's of a legend.

    Examples
    --------
    >>> from gearpair.motion import periodic
    >>> ax = plt.figure().add_subplot()
    >>> add_motion_legend(ax, [CHAOS, periodic(2)])
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['period 2', 'chaos']
    """
    present = {legend_name(motion): colour_on(ax, motion) for motion in motions}
    names = [name for name in MOTION_COLOURS if name in present] + sorted(present.keys() - MOTION_COLOURS.keys())
    dots = [Line2D([], [], linestyle="", marker="o", markersize=5, color=present[name], label=name) for name in names]
    size = 8.5 if len(dots) < 8 else 7.5  # so that a long row does not push the axes aside
    usual: dict[str, Any] = {"handletextpad": 0.1, "columnspacing": 0.8, "borderaxespad": 0.2, "fontsize": size}
    usual |= {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0)}
    add_legend(ax, dots, **{"columns": len(dots), **usual, **look})


def add_legend(ax: Axes, handles: Sequence[Artist] | None = None, columns: int = 1, **look: Any) -> Legend:
    """A legend that stays in the figure: of so many columns, else of fewer or more, else inside the axes.

    Of what has a label, where no handles are given.
    """
    handles = ax.get_legend_handles_labels()[0] if handles is None else handles
    others = sorted(range(1, len(handles) + 1), key=lambda n: abs(n - columns))
    for n in (columns, *others):
        legend = ax.legend(handles=handles, ncols=n, **look)
        if fits(legend, ax):
            return legend
    place = {name: look[name] for name in look if name not in ("loc", "bbox_to_anchor", "borderaxespad")}
    return ax.legend(handles=handles, **{**place, "loc": "best", "frameon": True})


def fits(legend: Legend, ax: Axes) -> bool:
    """Whether a legend is within its figure; within a figure that lays itself out, whether it can be."""
    whole = ax.get_figure(root=True)
    if whole is None:
        return True
    box, page = legend.get_window_extent(), whole.bbox
    if whole.get_layout_engine() is not None:
        return bool(box.width <= page.width and box.height <= TALLEST * page.height)
    return bool(box.x0 >= page.x0 and box.x1 <= page.x1 and box.y0 >= page.y0 and box.y1 <= page.y1)


def shade_backlash(ax: Axes, *, horizontal: bool) -> None:
    """The strip |X| < 1, where no teeth touch, and its two boundaries."""
    span, line = (ax.axhspan, ax.axhline) if horizontal else (ax.axvspan, ax.axvline)
    span(-1.0, 1.0, color=faint(ax, BACKLASH), zorder=-2, linewidth=0)
    for side in (-1.0, 1.0):
        line(side, color=BOUNDARY, linewidth=0.7, linestyle=(0, (5, 3)), zorder=-1)


def note(ax: Axes, text: str, at: tuple[float, float], shift: tuple[float, float], **look: Any) -> None:
    """A text that stands `shift` points from `at`."""
    ax.annotate(text, at, shift, textcoords="offset points", **{"color": text_colour(ax), **look})


def over_parameter(ax: Axes, parameter: str, values: np.ndarray, ylabel: str, **limits: Any) -> None:
    """Name the axes of a diagram over a parameter, which reaches from its least value to its greatest."""
    ax.set(xlabel=axis_label(parameter), ylabel=ylabel, xlim=(values.min(), values.max()), **limits)


def name_rows(ax: Axes, names: Iterable[object], parameter: str) -> None:
    """Name rows of bars along a parameter, the first on top."""
    texts = list(map(str, names))
    ax.set_yticks(range(len(texts)), texts)
    ax.set(xlabel=axis_label(parameter), ylim=(len(texts) - 0.5, -0.5))


@checked
def bare(ax: Axes) -> Axes:
    """The Axes without ticks, words and legends, for a picture that is seen at the size of a stamp.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = bare(gp.plotting.stiffness_wave(gp.Oscillator().stiffness))
    >>> ax.get_xlabel(), len(ax.get_xticks())
    ('', 0)
    """
    ax.set(xticks=[], yticks=[], xlabel="", ylabel="", title="")
    for legend in [ax.get_legend(), *ax.figure.legends]:
        if legend is not None:
            legend.remove()
    return ax


def these_axes(axes: Sequence[Axes], n: int) -> list[Axes]:
    """`axes`, which must be as many as a picture has parts."""
    found = list(axes)
    if len(found) != n:
        raise ValueError(f"axes must be {n} Axes, got {len(found)}")
    return found


def new_axes(ax: Axes | None, height: float | None = None) -> Axes:
    """`ax`, or the only axes of a new figure in the book's style."""
    if ax is not None:
        return ax
    with plt.style.context(book_style()):
        width, usual = STYLE["figure.figsize"]
        return plt.figure(figsize=(width, height or usual)).add_subplot()


def book_style(**changes: Any) -> dict[str, Any]:
    """The book's style with some `changes`; where figures are dark already, they stay so."""
    dark = contrast(rcParams["axes.facecolor"], "white") > contrast(rcParams["axes.facecolor"], "black")
    return {name: value for name, value in STYLE.items() if not (dark and name in OF_PAPER)} | changes
