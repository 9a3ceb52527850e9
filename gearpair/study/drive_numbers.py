"""The numbers of a drive's answer, tidy: one row a torque, run and speed, in a text, a workbook or a netCDF file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearpair.quantities import attributes
from gearpair.study.drive_answer import Answer

if TYPE_CHECKING:
    import xarray as xr

UNITS = {"1": "", "1/s": "_per_s", "mm/s": "_mm_per_s"}


def numbers(answer: Answer) -> xr.Dataset:
    """Over torque, run and speed what the charts hold; of a drive that only idles over the speed how it rattles."""
    import xarray as xr

    if answer.loaded:
        torques = xr.DataArray(
            [each.drive.pinion_torque_nm for each in answer.loaded], dims="torque", attrs=attributes("torque")
        )
        charts = [each.chart.drop_attrs(deep=False) for each in answer.loaded]
        return xr.concat(charts, torques.rename("torque"), join="exact").assign_attrs(drive=repr(answer.drive))
    idle = answer.idle
    assert idle is not None  # a file has a torque or an idle gear
    rows = {"impact_rate": idle.impact_rate, "impact_velocity": idle.impact_velocity, "time_apart": idle.time_apart}
    variables: dict[str, Any] = {name: ("speed", values, attributes(name)) for name, values in rows.items()}
    variables["rattle_ratio"] = ("speed", idle.rattle_ratio, {"long_name": "inertia torque over drag", "units": "1"})
    variables["impact_power"] = ("speed", idle.impact_power, {"long_name": "power of the impacts", "units": "W"})
    coordinates = {"speed": ("speed", idle.speed_rpm, attributes("speed"))}
    return xr.Dataset(variables, coordinates, {"drive": repr(answer.drive)})


def tidy(answer: Answer) -> Any:
    """The numbers as rows of a `pandas.DataFrame`, each column's unit in its name."""
    held = numbers(answer)
    frame = held.to_dataframe().reset_index()
    return frame.rename(columns={str(name): f"{name}{_unit(held[name].attrs)}" for name in held.variables})


def _unit(attrs: dict[str, Any]) -> str:
    unit = attrs.get("units", "1")
    return UNITS.get(unit, f"_{unit.lower().replace(' ', '_')}")


def _write_csv(answer: Answer, path: Path) -> None:
    tidy(answer).to_csv(path, index=False)


def _write_xlsx(answer: Answer, path: Path) -> None:
    tidy(answer).to_excel(path, index=False, sheet_name="chart", engine="openpyxl")


def _write_netcdf(answer: Answer, path: Path) -> None:
    numbers(answer).to_netcdf(path)


# By the name of the option of the command line: how a name has to end, and what writes it.
WRITERS: dict[str, tuple[str, Callable[[Answer, Path], None]]] = {
    "csv": (".csv", _write_csv),
    "xlsx": (".xlsx", _write_xlsx),
    "netcdf": (".nc", _write_netcdf),
}
