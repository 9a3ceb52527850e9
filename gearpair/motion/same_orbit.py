"""When two periodic orbits are one: the only place where that is decided."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

SAME_ORBIT = 1e-6  # an orbit passes through a point when one of its section points lies this close


def lies_on(point: ArrayLike, orbit: ArrayLike) -> bool:
    """Whether a point is one of an orbit's section points, and the orbit through it therefore the same.

    Parameters
    ----------
    point : array_like of float, shape (2,)
        X and X' on the section.
    orbit : array_like of float, shape (n, 2)
        The section points of an orbit.

    Examples
    --------
    >>> lies_on([0.5, 0.1 + 1e-9], [[0.2, 0.3], [0.5, 0.1]]), lies_on([0.5, 0.3], [[0.2, 0.3], [0.5, 0.1]])
    (True, False)
    """
    apart = np.abs(np.asarray(orbit) - np.asarray(point)).max(axis=1)
    return bool(apart.min() < SAME_ORBIT)


def same_motions(these: Mapping[str, NDArray[Any]], those: Mapping[str, NDArray[Any]]) -> NDArray[np.bool_]:
    """For each of many pairs of settled motions whether they are one; `these` and `those` hold columns by name.

    Of motions that are not periodic the section point is nan: they are one by their status and impact state.
    """
    apart = np.maximum(*(np.abs(these[name] - those[name]) for name in ("section_x", "section_v")))
    alike = np.all([these[name] == those[name] for name in ("status", "period", "impact_state")], axis=0)
    return np.asarray(alike & ~(apart > SAME_ORBIT))
