"""A passage: the motion while speed, load or error change from one mesh period to the next."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_class, check_count, checked
from gearpair._cores import aside
from gearpair._flow import measures as at
from gearpair._flow.passage import Schedule, pass_through
from gearpair._flow.walk import OK
from gearpair.motion.impacts import IMPACT_STATES, impact_codes
from gearpair.motion.measures import measure_columns
from gearpair.motion.trajectories import WATCHED, check_start, raise_unless_ok
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr

MEASURED = ("drive_force", "coast_force", "drive_impacts", "coast_impacts", "drive_velocity", "coast_velocity")


@checked
def passage(oscillators: Sequence[Oscillator], x: float, v: float, *, samples_per_period: int = 0) -> xr.Dataset:
    """The motion through a list of oscillators, a mesh period of each, exact but for rounding.

    Parameters
    ----------
    oscillators : sequence of Oscillator
        One for each mesh period, in the order in time; all in the same units of X and tau, none with `shaft_orders`.
    x, v : float
        X and X' at the start of the first mesh period.
    samples_per_period : int
        Samples of X and X' to keep of each mesh period.

    Returns
    -------
    xarray.Dataset
        Over ``cycle``, the mesh periods: ``tau``, ``x`` and ``v`` at the start of each, ``mesh_frequency``, ``x_min``,
        ``x_max``, ``largest_force`` (the largest modulus of k f), ``drive_force``, ``coast_force``, ``drive_impacts``,
        ``coast_impacts``, ``drive_velocity``, ``coast_velocity`` as in `ImpactMeasures`, and ``impact_state``. Scalars
        ``end_tau``, ``end_x`` and ``end_v`` tell where it ends. With samples ``sample_tau``, ``sample_x``
        and ``sample_v`` over ``(cycle, sample)``.

    Raises
    ------
    RuntimeError
        Where the motion escapes to infinity or the walk is capped.

    Notes
    -----
    From one mesh period to the next the rotors go on as they are: the dynamic transmission error X + e and its rate
    are continuous. So X changes by minus the change of e, and X' by minus the change of e', which is not zero where
    only the speed changes. A flank that this step alone makes touch is no impact.

    Examples
    --------
    >>> from gearpair.motion import steady_state
    >>> osc = Oscillator(mesh_frequency=0.5, error_amplitude=0.05)
    >>> x, v = steady_state(osc).points[0]
    >>> run = passage([osc.replace(mesh_frequency=each) for each in np.linspace(0.5, 1.1, 200)], x, v)
    >>> dict(run.sizes), round(float(run.drive_impacts.sum()))
    ({'cycle': 200}, 94)
    """
    import xarray as xr  # here, so that importing gearpair stays quick

    x, v = check_start(x, v)
    oscillators = list(oscillators)
    per_period = check_count("samples_per_period", samples_per_period, at_least=0)
    schedule = scheduled_oscillators(oscillators)
    n = len(schedule.which)
    states, rows, values = np.empty((n + 1, 2)), np.empty((n, at.N_MEASURES)), np.empty((n, per_period, 2))
    status, done = aside(pass_through, schedule, x, v, states, rows, values, periods=n * WATCHED)
    if status != OK:
        raise_unless_ok(status, done + 1)
    periods = np.array([each.period for each in oscillators])
    tau = np.concatenate([[0.0], np.cumsum(periods)])
    measured = measure_columns(rows, np.array([each.mean_force for each in oscillators]))
    columns = {
        "tau": tau[:-1],
        "x": states[:-1, 0],
        "v": states[:-1, 1],
        "mesh_frequency": np.array([each.mesh_frequency for each in oscillators]),
        "x_min": rows[:, at.LOWEST],
        "x_max": rows[:, at.HIGHEST],
        "largest_force": np.maximum(measured["drive_force"], measured["coast_force"]),
        **{name: measured[name] for name in MEASURED},
        "impact_state": np.array(IMPACT_STATES)[impact_codes(rows[:, at.LOWEST], rows[:, at.HIGHEST])],
    }
    variables: dict[str, Any] = {name: ("cycle", column, attributes(name)) for name, column in columns.items()}
    ends = {"tau": tau[-1], "x": states[-1, 0], "v": states[-1, 1]}
    variables |= {f"end_{name}": ((), end, attributes(name)) for name, end in ends.items()}
    if per_period:
        sampled = {"x": values[:, :, 0], "v": values[:, :, 1]}
        sampled["tau"] = tau[:-1, np.newaxis] + periods[:, np.newaxis] * np.arange(per_period) / per_period
        variables |= {f"sample_{name}": (("cycle", "sample"), each, attributes(name)) for name, each in sampled.items()}
    ends_of = {"first_oscillator": repr(oscillators[0]), "last_oscillator": repr(oscillators[-1])}
    return xr.Dataset(variables, {"cycle": ("cycle", np.arange(n))}, ends_of)


def scheduled_oscillators(oscillators: Sequence[Oscillator]) -> Schedule:
    """Oscillators as the kernel takes them; an equal one that follows is not built again."""
    if len(oscillators) == 0:
        raise ValueError("oscillators must hold one oscillator at least, got none")
    distinct: list[Oscillator] = []
    which = np.empty(len(oscillators), np.int64)
    for i, each in enumerate(oscillators):
        check_class(f"oscillators[{i}]", each, Oscillator)
        if each.mesh_periods > 1:
            raise ValueError(f"oscillators[{i}] must repeat with the mesh period, got shaft_orders {each.shaft_orders}")
        if not distinct or (each is not distinct[-1] and each != distinct[-1]):
            distinct.append(each)
        which[i] = len(distinct) - 1
    parts = [each.coefficients for each in distinct]
    errors = np.array([error_and_rate(each) for each in distinct])[which]
    return Schedule(
        np.array([part[:6] for part in parts]),
        np.concatenate([part.edges for part in parts]),
        np.concatenate([part.levels for part in parts]),
        np.concatenate([part.harmonics for part in parts]),
        _firsts([len(part.levels) for part in parts]),
        _firsts([len(part.harmonics) for part in parts]),
        which,
        -np.diff(errors, axis=0, prepend=errors[:1]),
    )


def error_and_rate(osc: Oscillator) -> tuple[float, float]:
    """The transmission error e and its rate e' at the start of a mesh period."""
    lines = osc.all_harmonics
    error = math.fsum(size * math.sin(phase) for _, size, phase in lines)
    return error, osc.mesh_frequency * math.fsum(n * size * math.cos(phase) for n, size, phase in lines)


def _firsts(lengths: list[int]) -> NDArray[np.int64]:
    """Where each of several parts begins in the whole, and where the last one ends."""
    return np.concatenate([[0], np.cumsum(lengths)]).astype(np.int64)
