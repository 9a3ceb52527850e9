"""What sweeps, maps and planes of starts have in common: their oscillators, and the variables of a settled motion."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array
from gearpair._flow.states import PERIODIC, Settled
from gearpair.motion.impacts import IMPACT_STATES, impact_codes
from gearpair.motion.settling import STATUSES, Status
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr

# What the codes of a variable stand for; the first is code -1.
WORDS: dict[str, tuple[str, ...]] = {
    "status": ("", *map(str, STATUSES)),
    "impact_state": ("", *map(str, IMPACT_STATES)),
    "worst_impact_state": ("", *map(str, IMPACT_STATES)),
}
# What is told of each start of a plane alone.
OF_PLANES = ("section_x", "section_v", "chaos_x_min", "chaos_x_max", "chaos_exponent")


def oscillators_along(
    osc: Oscillator, parameter: str, values: ArrayLike
) -> tuple[list[Oscillator], NDArray[np.float64]]:
    """One oscillator per value, or a ValueError that names what is wrong."""
    array = check_array(f"values of {parameter}", values, ndim=1)
    osc.parameter(parameter)
    return [osc.replace(**{parameter: value}) for value in array.tolist()], array


def check_origin(osc: Oscillator, result: xr.Dataset) -> None:
    """Raise a ValueError unless a result is of `osc`, whatever the values of the parameters that it is over."""
    own = Oscillator.from_attrs(result)
    over = {name: osc.parameter(name) for name in osc.parameters if name in result.dims and name in own.parameters}
    if own.replace(**over) != osc:
        raise ValueError(f"result must be one of this oscillator, {osc!r}, got one of another, {own!r}")


def axis_attributes(name: str) -> dict[str, str]:
    """Units and long name of an axis: a parameter, or X or X' of a plane of starts."""
    return attributes({"x": "start_x", "v": "start_v"}.get(name, name))


def dataset(
    osc: Oscillator, variables: Mapping[str, Any], axes: Mapping[str, NDArray[np.float64]], **settings: Any
) -> xr.Dataset:
    """Variables over axes, with what they belong to; `settings` become attributes."""
    import xarray as xr  # here, so that importing gearpair stays quick

    coordinates = {name: (name, values, axis_attributes(name)) for name, values in axes.items()}
    return xr.Dataset(variables, coordinates, {**settings, "oscillator": repr(osc)})


def settled_columns(out: Settled) -> dict[str, NDArray[Any]]:
    """The per-motion results as numbers; status and impact state as codes."""
    return {
        "status": out.status.astype(np.int8),
        "period": out.period,
        "impact_state": impact_codes(out.extremes[:, 0], out.extremes[:, 1]),
        "x_min": out.extremes[:, 0],
        "x_max": out.extremes[:, 1],
        "exponent": out.exponents[:, 0],
        "smallest_exponent": out.exponents[:, 1],
        "exponent_error": out.exponents[:, 2],
        "section_x": np.where(out.status == PERIODIC, out.points[:, 0, 0], np.nan),
        "section_v": np.where(out.status == PERIODIC, out.points[:, 0, 1], np.nan),
        "lasted": out.lasted,
        "chaos_x_min": out.chaos[:, 0],
        "chaos_x_max": out.chaos[:, 1],
        "chaos_exponent": out.chaos[:, 2],
    }


def way_columns(out: Settled) -> dict[str, NDArray[Any]]:
    """What happened before the motions settled, as numbers."""
    # An impact on the way, or one of the motion itself, whichever is worse; nan where the motion was not followed.
    low, high = np.fmin(out.way[:, 2], out.extremes[:, 0]), np.fmax(out.way[:, 3], out.extremes[:, 1])
    settled = out.status == PERIODIC
    return {
        "settling_time": np.where(settled, out.way[:, 0], np.nan),
        "impacts_before": np.where(settled, out.way[:, 1], np.nan),
        "worst_impact_state": impact_codes(low, high),
        "largest_displacement": np.fmax(np.abs(low), np.abs(high)),
    }


def variables_of(
    columns: Mapping[str, NDArray[Any]], dims: tuple[str, ...], shape: tuple[int, ...], *, coded: bool = False
) -> dict[str, Any]:
    """Columns as xarray variables over `dims`; codes become words unless they are to stay `coded`."""
    variables = {}
    for name, column in columns.items():
        facts: dict[str, Any] = attributes(name)
        words = WORDS.get(name.removeprefix("attractor_"))
        if words is not None and coded:
            facts |= {
                "flag_values": list(range(-1, len(words) - 1)),
                "flag_meanings": " ".join(w or "-" for w in words),
            }
        elif words is not None:
            column = np.array(words)[column + 1]
        if name == "status":
            facts["remedies"] = "; ".join(f"{status}: {status.remedy}" for status in Status)
        variables[name] = (dims, column.reshape(shape), facts)
    return variables


def with_numbers(result: xr.Dataset) -> xr.Dataset:
    """A dataset with the numbers of its attractors and chaotic sets as coordinates."""
    names = [name for name in ("attractor_number", "set_number") if name in result.sizes]
    return result.assign_coords({name: np.arange(result.sizes[name]) for name in names})


def section_variables(parameter: str, points: NDArray[np.float64]) -> dict[str, Any]:
    """Section points (n, n_samples, 2) along a parameter as xarray variables ``x`` and ``v``."""
    return {name: ((parameter, "sample"), points[:, :, i], attributes(name)) for i, name in enumerate(("x", "v"))}


def settled_variables(out: Settled, dims: tuple[str, ...], shape: tuple[int, ...]) -> dict[str, Any]:
    """The per-motion results as xarray variables over `dims`."""
    columns = settled_columns(out)
    return variables_of({name: columns[name] for name in columns if name not in OF_PLANES}, dims, shape)
