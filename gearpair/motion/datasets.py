"""What sweeps, maps and planes of starts have in common: names, units, and the variables of a settled motion."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_number
from gearpair._flow.settle import Settled
from gearpair.motion.impacts import impact_state
from gearpair.motion.settling import STATUSES, Status
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


def dataset(
    osc: Oscillator, variables: Mapping[str, Any], axes: Mapping[str, NDArray[np.float64]], **settings: Any
) -> xr.Dataset:
    """Variables over axes that are parameters, with what they belong to; `settings` become attributes."""
    import xarray as xr  # here, so that importing gearpair stays quick

    coordinates = {name: (name, values, attributes(name)) for name, values in axes.items()}
    return xr.Dataset(variables, coordinates, {**settings, "oscillator": repr(osc)})


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


def symbol(parameter: str) -> str:
    """The article's symbol of a parameter, in plain letters.

    Examples
    --------
    >>> symbol("mesh_frequency"), symbol("a")
    ('Omega_h', 'a')
    """
    return attributes(parameter)["long_name"].rsplit(" ", 1)[-1]
