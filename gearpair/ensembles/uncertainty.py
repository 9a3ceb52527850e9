"""How uncertain a start's fate is: measures of basins of attraction and of the boundaries between them.

A start whose fate is not known yet, such as a chaotic transient, is left out: as one more colour it would make a
boundary look fractal, or turn with the time that was waited into another. How many were left out is always told.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_count, checked
from gearpair._equality import equal_by_value
from gearpair.motion.settling import Status

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class BasinEntropy:
    """Entropies of a plane of labels, in nats.

    Attributes
    ----------
    entropy : float
        Basin entropy: the mean over all boxes.
    boundary_entropy : float
        Boundary basin entropy: the mean over boxes with more than one label; 0 where there is none. Above
        ``log 2`` the boundary is taken as fractal.
    boundary_boxes : float
        Share of the boxes with more than one label.
    left_out : float
        Share of the starts that did not count, because where they lead is not known.
    """

    entropy: float
    boundary_entropy: float
    boundary_boxes: float
    left_out: float = 0.0


@checked
def basin_entropy(plane: xr.Dataset | ArrayLike, box: int = 5) -> BasinEntropy:
    """Basin entropy and boundary basin entropy of a plane of starts.

    Parameters
    ----------
    plane : xarray.Dataset, or array_like of int, shape (n_v, n_x)
        Of `basins`, where escape is a colour beside the attractors, and starts are left out that are transients or
        unsettled or were not judged. Or the numbers of the colours; negative ones are left out.
    box : int
        Side of the boxes in starts; those that do not fit at the far edges do not count.

    Raises
    ------
    ValueError
        For what is no plane, a box larger than it, or a plane that has no start left.

    Notes
    -----
    Daza, Wagemakers, Georgeot, Guéry-Odelin and Sanjuán (2016): in each box the Gibbs entropy
    ``-sum p log p`` of the shares p of its colours, averaged (their equations 2 to 5). The shares are of the starts
    that count, the mean is over the boxes with any.

    Examples
    --------
    >>> basin_entropy([[0, 0, 0, 1], [0, 0, 1, 0]], box=2)
    BasinEntropy(entropy=0.34657359027997264, boundary_entropy=0.6931471805599453, boundary_boxes=0.5, left_out=0.0)
    """
    labels = _labels(plane)
    box = check_count("box", box)
    rows, columns = (side // box for side in labels.shape)
    if rows == 0 or columns == 0:
        raise ValueError(f"box must be at most the shorter side of the plane {labels.shape}, got {box}")
    cut = labels[: rows * box, : columns * box].reshape(rows, box, columns, box).swapaxes(1, 2)
    counts = np.stack([np.sum(cut == colour, axis=(2, 3)) for colour in np.unique(cut[cut >= 0])])
    known = counts.sum(axis=0)
    shares = counts[:, known > 0] / known[known > 0]
    logs = np.log(shares, out=np.zeros_like(shares), where=shares > 0.0)
    entropies = -(shares * logs).sum(axis=0)
    mixed = (shares > 0.0).sum(axis=0) > 1
    boundary = float(entropies[mixed].mean()) if mixed.any() else 0.0
    return BasinEntropy(float(entropies.mean()), boundary, float(mixed.mean()), float(np.mean(labels < 0)))


@equal_by_value
@dataclass(frozen=True)
class UncertaintyExponent:
    """How the share of uncertain starts falls with the error of the start.

    Attributes
    ----------
    exponent : float
        alpha in ``f ~ epsilon^alpha``: 1 for a smooth boundary, less for a fractal one.
    error : float
        Standard error of the fitted exponent.
    dimension : float
        Of the boundary, ``2 - alpha``.
    epsilon, share : ndarray of float, shape (n,)
        Errors of the start, in steps of the grid, and the share f of starts that such an error may mislead.
    left_out : float
        Share of the starts that did not count, because where they lead is not known.
    """

    exponent: float
    error: float
    dimension: float
    epsilon: NDArray[np.float64]
    share: NDArray[np.float64]
    left_out: float = 0.0


@checked
def uncertainty_exponent(plane: xr.Dataset | ArrayLike, *, longest: int | None = None) -> UncertaintyExponent:
    """The uncertainty exponent of the boundaries in a plane of starts.

    Parameters
    ----------
    plane : xarray.Dataset, or array_like of int, shape (n_v, n_x)
        As for `basin_entropy`.
    longest : int, optional
        The largest error of X_0, in steps of the grid; a sixteenth of the row when not given.

    Notes
    -----
    Grebogi, McDonald, Ott and Yorke (1983): a start is uncertain for an error epsilon if it and one of its neighbours
    at X_0 +- epsilon lead to different attractors. The exponent is the slope of log f over log epsilon, by least
    squares over errors that double. A start counts for an error if the fates of all three are known.

    Examples
    --------
    >>> smooth = [[0] * 64 + [1] * 64] * 3
    >>> round(uncertainty_exponent(smooth).exponent, 6)
    1.0
    """
    from scipy.stats import linregress  # here, so that importing gearpair stays quick

    labels = _labels(plane)
    n = labels.shape[1]
    longest = max(n // 16, 1) if longest is None else check_count("longest", longest)
    epsilon = 2 ** np.arange(int(np.log2(longest)) + 1)
    if len(epsilon) < 3 or 2 * epsilon[-1] >= n:
        raise ValueError(f"longest must be from 4 to below half of the plane's {n} columns, got {longest}")
    edge = int(epsilon[-1])
    inner = labels[:, edge : n - edge]  # the same starts for every error
    share = []
    for step in epsilon:
        left, right = labels[:, edge - step : n - edge - step], labels[:, edge + step : n - edge + step]
        known = (inner >= 0) & (left >= 0) & (right >= 0)
        differs = known & ((inner != left) | (inner != right))
        share.append(float(differs.sum() / max(known.sum(), 1)))
    if min(share) == 0.0:
        raise ValueError("the plane must have a boundary between different labels in its interior, got none")
    fit = linregress(np.log(epsilon), np.log(share))
    exponent, left_out = float(fit.slope), float(np.mean(labels < 0))
    return UncertaintyExponent(
        exponent, float(fit.stderr), 2.0 - exponent, epsilon.astype(float), np.array(share), left_out
    )


def _labels(plane: Any) -> NDArray[np.int64]:
    """The colour of each start, -1 where it does not count."""
    if hasattr(plane, "data_vars"):
        numbers, status = np.asarray(plane["attractor"]), np.asarray(plane["status"])
        labels = np.where(status == Status.ESCAPED, numbers.max(initial=-1) + 1, numbers)
        labels[status == Status.UNSETTLED] = -1
    else:
        labels = check_array("plane", plane)
        if np.any(labels != np.round(labels)):
            raise ValueError("plane must hold whole numbers, the colours of its starts")
        labels = labels.astype(np.int64)
    if labels.ndim != 2 or labels.size == 0:
        raise ValueError(f"plane must be a plane of attractor numbers, got shape {labels.shape}")
    if np.all(labels < 0):
        raise ValueError("plane must have starts whose fate is known, got none")
    return labels
