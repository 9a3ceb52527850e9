"""The data behind a figure: what is graded, whatever it looks like."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Curve:
    """One line or cloud of points of a figure; `x` and `y` have shape (n,).

    Attributes
    ----------
    label : str
        Its entry in the legend, empty where it has none.
    x, y : ndarray of float
        In the units of the axes.
    """

    label: str
    x: NDArray[np.float64]
    y: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Drawing:
    """What a figure shows: its curves, in the order drawn, and the labels of its axes."""

    curves: tuple[Curve, ...]
    x_label: str
    y_label: str


def drawing(axes: Any) -> Drawing | None:
    """The data behind an Axes of matplotlib; a `Drawing` comes back as it is, None for what is neither.

    Examples
    --------
    >>> drawing("a picture") is None
    True
    """
    if isinstance(axes, Drawing):
        return axes
    if not all(hasattr(axes, name) for name in ("get_lines", "collections", "get_xlabel", "get_ylabel")):
        return None
    curves = [_curve(line.get_label(), *line.get_data()) for line in axes.get_lines()]
    for cloud in axes.collections:
        if hasattr(cloud, "get_offsets"):
            offsets: Any = np.ma.asarray(cloud.get_offsets(), dtype=float)
            x, y = offsets.filled(np.nan).T
            curves.append(_curve(cloud.get_label(), x, y))
    return Drawing(tuple(curves), str(axes.get_xlabel()), str(axes.get_ylabel()))


def _curve(label: Any, x: Any, y: Any) -> Curve:
    shown = "" if str(label).startswith("_") else str(label)
    return Curve(shown, np.asarray(x, dtype=float).ravel(), np.asarray(y, dtype=float).ravel())
