"""How uncertain a start's fate is: measures of basins of attraction and of the boundaries between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_count
from gearpair._equality import equal_by_value


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
    """

    entropy: float
    boundary_entropy: float
    boundary_boxes: float


def basin_entropy(labels: ArrayLike, box: int = 5) -> BasinEntropy:
    """Basin entropy and boundary basin entropy of a plane of attractor numbers.

    Parameters
    ----------
    labels : array_like of int, shape (n_v, n_x)
        Such as ``basins(...).attractor``; every number counts as a colour, -1 too.
    box : int
        Side of the boxes in starts; those that do not fit at the far edges are left out.

    Notes
    -----
    Daza, Wagemakers, Georgeot, Guéry-Odelin and Sanjuán (2016): in each box the Gibbs entropy
    ``-sum p log p`` of the shares p of its colours, averaged (their equations 2 to 5).

    Examples
    --------
    >>> basin_entropy([[0, 0, 0, 1], [0, 0, 1, 0]], box=2)
    BasinEntropy(entropy=0.34657359027997264, boundary_entropy=0.6931471805599453, boundary_boxes=0.5)
    """
    plane = _plane(labels)
    box = check_count("box", box)
    rows, columns = (side // box for side in plane.shape)
    if rows == 0 or columns == 0:
        raise ValueError(f"box must be at most the shorter side of the plane {plane.shape}, got {box}")
    cut = plane[: rows * box, : columns * box].reshape(rows, box, columns, box)
    colours = np.unique(cut)
    shares = np.stack([(cut == colour).mean(axis=(1, 3)) for colour in colours])
    logs = np.log(shares, out=np.zeros_like(shares), where=shares > 0.0)
    entropies = -(shares * logs).sum(axis=0)
    mixed = (shares > 0.0).sum(axis=0) > 1
    boundary = float(entropies[mixed].mean()) if mixed.any() else 0.0
    return BasinEntropy(float(entropies.mean()), boundary, float(mixed.mean()))


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
    """

    exponent: float
    error: float
    dimension: float
    epsilon: NDArray[np.float64]
    share: NDArray[np.float64]


def uncertainty_exponent(labels: ArrayLike, *, longest: int | None = None) -> UncertaintyExponent:
    """The uncertainty exponent of the boundaries in a plane of attractor numbers.

    Parameters
    ----------
    labels : array_like of int, shape (n_v, n_x)
        Such as ``basins(...).attractor``.
    longest : int, optional
        The largest error of X_0, in steps of the grid; a sixteenth of the row when not given.

    Notes
    -----
    Grebogi, McDonald, Ott and Yorke (1983): a start is uncertain for an error epsilon if it and one of its neighbours
    at X_0 +- epsilon lead to different attractors. The exponent is the slope of log f over log epsilon, by least
    squares over errors that double.

    Examples
    --------
    >>> smooth = [[0] * 64 + [1] * 64] * 3
    >>> round(uncertainty_exponent(smooth).exponent, 6)
    1.0
    """
    from scipy.stats import linregress  # here, so that importing gearpair stays quick

    plane = _plane(labels)
    n = plane.shape[1]
    longest = max(n // 16, 1) if longest is None else check_count("longest", longest)
    epsilon = 2 ** np.arange(int(np.log2(longest)) + 1)
    if len(epsilon) < 3 or 2 * epsilon[-1] >= n:
        raise ValueError(f"longest must be from 4 to below half of the plane's {n} columns, got {longest}")
    edge = int(epsilon[-1])
    inner = plane[:, edge : n - edge]  # the same starts for every error
    share = []
    for step in epsilon:
        left, right = plane[:, edge - step : n - edge - step], plane[:, edge + step : n - edge + step]
        differs = (inner != left) | (inner != right)
        share.append(float(differs.mean()))
    if min(share) == 0.0:
        raise ValueError("the plane must have a boundary between different labels in its interior, got none")
    fit = linregress(np.log(epsilon), np.log(share))
    exponent = float(fit.slope)
    return UncertaintyExponent(exponent, float(fit.stderr), 2.0 - exponent, epsilon.astype(float), np.array(share))


def _plane(labels: ArrayLike) -> NDArray[np.int64]:
    plane = np.asarray(labels)
    if plane.ndim != 2 or plane.size == 0:
        raise ValueError(f"labels must be a plane of attractor numbers, got shape {plane.shape}")
    return plane
