"""Which motion each start leads to: basins of attraction, and their shares along a parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._flow.settle import APERIODIC, PERIODIC, UNSETTLED, Settled
from gearpair.motion.datasets import attributes, dataset, oscillators_along, settled_variables
from gearpair.motion.impacts import ImpactState
from gearpair.motion.names import Motion, motions_from, motions_of
from gearpair.motion.same_orbit import lies_on
from gearpair.motion.settling import SettleSettings, settle_lanes
from gearpair.motion.steady import SteadyState, steady_state
from gearpair.motion.trajectories import check_starts
from gearpair.oscillator import Oscillator

if TYPE_CHECKING:
    import xarray as xr


def basins(
    osc: Oscillator,
    x: ArrayLike,
    v: ArrayLike,
    *,
    n_transient: int | None = None,
    max_period: int = 64,
    n_exponent: int = 500,
    progress: bool = False,
) -> xr.Dataset:
    """The attractor that each start of a grid reaches.

    Parameters
    ----------
    osc : Oscillator
    x : array_like of float, shape (n_x,)
        Initial X.
    v : array_like of float, shape (n_v,)
        Initial X'.
    n_transient, max_period, n_exponent
        As in `steady_state`.
    progress : bool
        Show a progress bar on stderr.

    Returns
    -------
    xarray.Dataset
        Over ``(v, x)``: ``attractor`` (its number, -1 where the motion did not stay bounded), ``status``, ``period``,
        ``impact_state``, ``x_min``, ``x_max``, ``exponent``, ``exponent_error``. Over ``attractor_number``:
        ``attractor_status``, ``attractor_period``, ``attractor_impact_state``, ``attractor_x``,
        ``attractor_v`` (its section point of smallest X; nan unless periodic) and ``attractor_share`` of the starts.
        Periodic attractors come first, by period and X; then all aperiodic motions as one, all unsettled ones as one.

    Raises
    ------
    ValueError
        For starts that are not finite or not one-dimensional.

    Examples
    --------
    >>> result = basins(Oscillator(mesh_frequency=0.7, damping_ratio=0.1), [0.0, 1.0, 2.0], [0.0])
    >>> result.attractor_period.values.tolist()
    [1]
    """
    xs, _ = check_starts(x, 0.0)
    _, vs = check_starts(0.0, v)
    for name, values in (("x", xs), ("v", vs)):
        if values.ndim != 1 or values.size == 0:
            raise ValueError(f"{name} must be a non-empty sequence of numbers, got shape {values.shape}")
    v_grid, x_grid = np.meshgrid(vs, xs, indexing="ij")
    starts = np.stack([x_grid.ravel(), v_grid.ravel()], axis=1)
    settings = SettleSettings(n_transient=n_transient, max_period=max_period, n_exponent=n_exponent, n_samples=1)
    out = settle_lanes([osc] * len(starts), starts, settings, progress=progress)
    labels, first = _attractors(out)
    shape = (len(vs), len(xs))
    variables = settled_variables(out, ("v", "x"), shape)
    table = {
        f"attractor_{name}": ("attractor_number", variables[name][1].ravel()[first], variables[name][2])
        for name in ("status", "period", "impact_state", "x_min", "x_max", "exponent")
    }
    periodic = out.status[first] == PERIODIC
    for i, name in enumerate(("x", "v")):
        points = np.where(periodic, out.points[first, 0, i], np.nan)
        table[f"attractor_{name}"] = ("attractor_number", points, attributes(name))
    counts = np.bincount(labels[labels >= 0], minlength=len(first))
    table["attractor_share"] = (
        "attractor_number",
        counts / len(labels),
        {"long_name": "share of the starts", "units": "1"},
    )
    import xarray as xr  # here, so that importing gearpair stays quick

    return xr.Dataset(
        variables
        | table
        | {"attractor": (("v", "x"), labels.reshape(shape), {"long_name": "number of the attractor", "units": "1"})},
        {
            "v": ("v", vs, {"long_name": "initial X'", "units": "1"}),
            "x": ("x", xs, {"long_name": "initial X", "units": "1"}),
            "attractor_number": np.arange(len(first)),
        },
        {"oscillator": repr(osc)},
    )


def _attractors(out: Settled) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """A label per lane and, per label, a lane that shows the attractor."""
    keys: list[tuple[float, ...]] = []
    lanes: list[int] = []
    found = np.full(len(out.status), -1)
    for i, status in enumerate(out.status):
        if status not in (PERIODIC, APERIODIC, UNSETTLED):
            continue
        orbit = status == PERIODIC
        key = (float(status), float(out.period[i]), *(out.points[i, 0].tolist() if orbit else (0.0, 0.0)))
        alike = [k for k, other in enumerate(keys) if key[:2] == other[:2]]
        near = [k for k in alike if not orbit or lies_on(key[2:], out.points[lanes[k], : out.period[i]])]
        if not near:
            keys.append(key)
            lanes.append(i)
        found[i] = near[0] if near else len(keys) - 1
    order = np.array(sorted(range(len(keys)), key=lambda k: keys[k]), dtype=int)
    rank = np.empty(len(keys), dtype=int)
    rank[order] = np.arange(len(keys))
    labels = np.where(found >= 0, rank[found] if len(keys) else -1, -1)
    return labels, np.array(lanes, dtype=int)[order]


def attractor_motions(result: xr.Dataset, least_share: float = 0.0) -> list[Motion]:
    """What each attractor of `gearpair.basins` is: its motion and, where periodic, its impact state.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.basins`.
    least_share : float
        Attractors that fewer of the starts reach are left out.

    Returns
    -------
    list of Motion

    Examples
    --------
    >>> print(*attractor_motions(basins(Oscillator(), [0.0, 1.0], [0.0])))
    period 2, single-sided
    """
    kinds = motions_from(result.attractor_status.values, result.attractor_period.values)
    columns = zip(kinds, result.attractor_impact_state.values, result.attractor_share.values, strict=True)
    return [
        Motion(kind.status, kind.period, ImpactState(str(state)) if kind.period else None)
        for kind, state, share in columns
        if share >= least_share
    ]


def attractor_states(osc: Oscillator, result: xr.Dataset, least_share: float = 0.0) -> list[SteadyState]:
    """The periodic attractors of `gearpair.basins`, each described in full.

    Parameters
    ----------
    osc : Oscillator
        Whose basins they are.
    result : xarray.Dataset
        Of `gearpair.basins`.
    least_share : float
        Attractors that fewer of the starts reach are left out.

    Returns
    -------
    list of SteadyState

    Examples
    --------
    >>> [state.period for state in attractor_states(Oscillator(), basins(Oscillator(), [-2.0, 1.0], [0.0]))]
    [1, 2]
    """
    columns = (result[f"attractor_{name}"].values.tolist() for name in ("x", "v", "share"))
    rows = zip(*columns, strict=True)
    return [steady_state(osc, x, v) for x, v, share in rows if np.isfinite(x) and share >= least_share]


def motion_shares(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    x: ArrayLike,
    v: ArrayLike,
    **settings: Any,
) -> xr.Dataset:
    """Along one parameter, the share of a grid of starts that reaches each kind of motion.

    Parameters
    ----------
    osc : Oscillator
    parameter : str
        One of ``osc.parameters``.
    values : array_like of float, shape (n,)
    x, v : array_like of float
        The grid of starts, as for `gearpair.basins`.
    **settings
        As for `gearpair.basins`.

    Returns
    -------
    xarray.Dataset
        ``share`` over ``(parameter, motion)``; each motion by its name, with its ``status`` and ``period``: periodic
        ones first, by period.

    Examples
    --------
    >>> shares = motion_shares(Oscillator(), "damping_ratio", [0.1, 0.2], [0.0, 1.0], [0.0])
    >>> shares.share.values.tolist()
    [[1.0], [1.0]]
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    planes = [motions_of(basins(each, x, v, **settings)) for each in oscillators]
    motions = sorted({motion for plane in planes for motion in plane.ravel()})
    share = [[float(np.mean(plane == motion)) for motion in motions] for plane in planes]
    columns = {
        "share": ((parameter, "motion"), share, {"long_name": "share of the starts", "units": "1"}),
        "status": ("motion", [str(motion.status) for motion in motions], attributes("status")),
        "period": ("motion", [motion.period or 0 for motion in motions], attributes("period")),
    }
    result = dataset(osc, columns, {parameter: checked})
    return result.assign_coords(motion=[str(motion) for motion in motions])
