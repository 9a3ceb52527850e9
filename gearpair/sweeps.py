"""The settled motion along one parameter: the numbers of a bifurcation diagram."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_choice, check_number
from gearpair._flow.settle import Settled
from gearpair.batches import STATUSES, SettleSettings, Status, settle_lanes
from gearpair.impacts import impact_state
from gearpair.motion import check_start
from gearpair.oscillator import Oscillator

if TYPE_CHECKING:
    import xarray as xr

LONG_NAMES = {
    "mean_force": "mean force F_m'",
    "error_amplitude": "transmission error amplitude F_ah",
    "error_phase": "transmission error phase phi_h",
    "damping_ratio": "damping ratio zeta",
    "mesh_frequency": "mesh frequency Omega_h",
    "contact_ratio": "contact ratio epsilon",
    "a": "stiffness added in double contact, a",
    "b": "stiffness missing in single contact, b",
    "x": "X on the section",
    "v": "X' on the section",
    "status": "what the motion became",
    "period": "period in mesh periods, 0 unless periodic",
    "impact_state": "impact state",
    "x_min": "smallest X",
    "x_max": "largest X",
    "exponent": "largest Lyapunov exponent per unit tau",
    "exponent_error": "standard error of the largest exponent",
}


def sweep(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    *,
    x: float = 1.0,
    v: float = 0.0,
    seeding: Literal["carry", "restart"] = "carry",
    n_transient: int | None = None,
    max_period: int = 64,
    n_exponent: int = 2000,
    n_samples: int = 128,
    progress: bool = False,
) -> xr.Dataset:
    """The settled motion at each value of one parameter.

    Parameters
    ----------
    osc : Oscillator
    parameter : str
        One of ``osc.parameters``.
    values : array_like of float, shape (n,)
        Visited in the order given, which is the direction of the sweep.
    x, v : float
        The start: of the first value when carrying, of every value when restarting.
    seeding : {"carry", "restart"}
        ``"carry"`` starts each value where the one before it ended, as an experiment does;
        ``"restart"`` starts each from (x, v), in parallel over the cores.
    n_transient, max_period, n_exponent
        As in `steady_state`.
    n_samples : int
        Section points kept per value; at least `max_period` are.
    progress : bool
        Show a progress bar on stderr.

    Returns
    -------
    xarray.Dataset
        Dimensions ``(parameter, sample)``: ``x, v`` on the section, and per value ``status``, ``period``,
        ``impact_state``, ``x_min``, ``x_max``, ``exponent`` and ``exponent_error``.

    Raises
    ------
    ValueError
        For an unknown parameter, a value out of range, or no values.

    Examples
    --------
    >>> diagram = sweep(Oscillator(), "mesh_frequency", [1.65, 1.7], seeding="restart")
    >>> dict(diagram.sizes)
    {'mesh_frequency': 2, 'sample': 128}
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    check_choice("seeding", seeding, ("carry", "restart"))
    settings = SettleSettings(
        n_transient=n_transient, max_period=max_period, n_exponent=n_exponent, n_samples=max(n_samples, max_period)
    )
    starts = np.broadcast_to(check_start(x, v), (len(oscillators), 2))
    out = settle_lanes(
        oscillators, starts, settings, chain=len(oscillators) if seeding == "carry" else 1, progress=progress
    )
    variables = settled_variables(out, (parameter,), (len(checked),))
    for i, name in enumerate(("x", "v")):
        variables[name] = ((parameter, "sample"), out.points[:, :, i], attributes(name))
    import xarray as xr  # here, so that importing gearpair stays quick

    return xr.Dataset(
        variables,
        {parameter: (parameter, checked, attributes(parameter))},
        {"seeding": seeding, "oscillator": repr(osc)},
    )


def oscillators_along(
    osc: Oscillator, parameter: str, values: ArrayLike
) -> tuple[list[Oscillator], NDArray[np.float64]]:
    """One oscillator per value, or a ValueError that names what is wrong."""
    array = np.asarray(values)
    if array.ndim != 1 or array.size == 0:
        raise ValueError(f"values of {parameter} must be a non-empty sequence of numbers, got shape {array.shape}")
    osc.parameter(parameter)
    checked = [check_number(parameter, value) for value in array.tolist()]
    return [osc.replace(**{parameter: value}) for value in checked], np.array(checked)


def attributes(name: str) -> dict[str, str]:
    """Units and long name of a variable, by its name."""
    return {"long_name": LONG_NAMES[name], "units": "rad" if name == "error_phase" else "1"}


def settled_variables(out: Settled, dims: tuple[str, ...], shape: tuple[int, ...]) -> dict[str, Any]:
    """The per-motion results as xarray variables over `dims`."""
    states = [
        str(impact_state(low, high)) if np.isfinite(low) and np.isfinite(high) else ""
        for low, high in out.extremes.tolist()
    ]
    columns = {
        "status": np.array([str(STATUSES[code]) for code in out.status]),
        "period": out.period,
        "impact_state": np.array(states),
        "x_min": out.extremes[:, 0],
        "x_max": out.extremes[:, 1],
        "exponent": out.exponents[:, 0],
        "exponent_error": out.exponents[:, 2],
    }
    variables = {name: (dims, column.reshape(shape), attributes(name)) for name, column in columns.items()}
    variables["status"][2]["remedies"] = "; ".join(f"{status}: {status.remedy}" for status in Status)
    return variables
