"""The article's integrator, for comparison: sections and diagrams as adaptive Runge-Kutta draws them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_choice, check_count, check_number
from gearpair._cores import on_all_cores
from gearpair._flow.runge_kutta import COMPLETE, Steps, integrate_lanes
from gearpair.ensembles.datasets import oscillators_along
from gearpair.motion.settling import SettleSettings, lanes_of
from gearpair.motion.trajectories import check_start
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr

MAX_STEPS_PER_PERIOD = 100_000


def runge_kutta_section(
    osc: Oscillator,
    x: float,
    v: float,
    n_periods: int,
    *,
    n_kept: int | None = None,
    rtol: float = 1e-3,
    atol: float = 1e-6,
) -> NDArray[np.float64]:
    """The Poincaré section as ``scipy.integrate.solve_ivp(method="RK45")`` draws it, compiled.

    Parameters
    ----------
    osc : Oscillator
    x, v : float
        X and X' at the start of a mesh period (dimensionless).
    n_periods : int
        Mesh periods of one uninterrupted integration.
    n_kept : int, optional
        The last points to keep, at most ``n_periods + 1``; all when not given.
    rtol, atol : float
        The integrator's tolerances; scipy's defaults.

    Returns
    -------
    ndarray of float, shape (n_kept, 2)
        X and X' at the mesh periods' starts, by the integrator's own quartic interpolant.

    Raises
    ------
    ValueError
        For an argument out of range.
    RuntimeError
        Where the integrator gives up.

    Notes
    -----
    Step for step scipy's RK45: same tableau, first step, error norm, step factors and interpolant.

    Examples
    --------
    >>> runge_kutta_section(Oscillator(), 1.0, 0.0, 2, rtol=1e-9, atol=1e-9).round(4)[-1]
    array([-0.0973, -0.3923])
    """
    n_periods = check_count("n_periods", n_periods)
    n_kept = n_periods + 1 if n_kept is None else check_count("n_kept", n_kept)
    if n_kept > n_periods + 1:
        raise ValueError(f"n_kept must be at most n_periods + 1 = {n_periods + 1}, got {n_kept}")
    points, status, _calls = _sections([osc], x, v, n_periods, n_kept, _adaptive(rtol, atol, n_periods), chain=1)
    if status[0] != COMPLETE:
        raise RuntimeError("RK45 gave up: the motion escapes to infinity, or rtol and atol are too small to reach")
    return points[0]


def runge_kutta_sweep(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    *,
    x: float = 1.0,
    v: float = 0.0,
    seeding: Literal["carry", "restart"] = "carry",
    n_transient: int = 500,
    n_samples: int = 128,
    rtol: float = 1e-3,
    atol: float = 1e-6,
    closeness: float = 0.01,
) -> xr.Dataset:
    """`sweep` as RK45 draws it: a bifurcation diagram with the integrator's errors in it.

    Parameters
    ----------
    osc, parameter, values, x, v, seeding
        As in `sweep`.
    n_transient : int
        Mesh periods discarded at each value.
    n_samples : int
        Section points kept per value.
    rtol, atol : float
        The integrator's tolerances; scipy's defaults.
    closeness : float
        Section points this close count as one when the period is read off the diagram.

    Returns
    -------
    xarray.Dataset
        Dimensions ``(parameter, sample)``: ``x``, ``v`` (nan where the integrator gave up); per value ``period``, the
        smallest that all kept points repeat with (0 when none up to half of them), and ``calls`` of the
        right-hand side.

    Raises
    ------
    ValueError
        For an argument out of range.

    Examples
    --------
    >>> runge_kutta_sweep(Oscillator(), "mesh_frequency", [1.65, 1.7], rtol=1e-9, atol=1e-9).period.values.tolist()
    [2, 2]
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    check_choice("seeding", seeding, ("carry", "restart"))
    n_transient = check_count("n_transient", n_transient, at_least=0)
    n_samples = check_count("n_samples", n_samples, at_least=2)
    check_number("closeness", closeness, above=0.0)
    n_periods = n_transient + n_samples - 1
    points, status, calls = _sections(
        oscillators, x, v, n_periods, n_samples, _adaptive(rtol, atol, n_periods),
        chain=len(oscillators) if seeding == "carry" else 1,
    )  # fmt: skip
    points[status != COMPLETE] = np.nan
    import xarray as xr  # here, so that importing gearpair stays quick

    return xr.Dataset(
        {
            "x": ((parameter, "sample"), points[:, :, 0], attributes("x")),
            "v": ((parameter, "sample"), points[:, :, 1], attributes("v")),
            "period": (parameter, [section_period(section, closeness) for section in points], attributes("period")),
            "calls": (parameter, calls, attributes("calls")),
        },
        {parameter: (parameter, checked, attributes(parameter))},
        {"seeding": seeding, "oscillator": repr(osc), "rtol": rtol, "atol": atol},
    )


def section_period(points: ArrayLike, closeness: float = 0.01) -> int:
    """The period that a reader sees in section points: the smallest that all of them repeat with.

    Parameters
    ----------
    points : array_like of float, shape (n, 2)
        Successive section points.
    closeness : float
        Points this close (in X and in X') count as one.

    Returns
    -------
    int
        In mesh periods; 0 when none up to half the number of points.

    Examples
    --------
    >>> section_period([[1.0, 0.0], [2.0, 0.0], [1.001, 0.0], [2.0, 0.0]])
    2
    """
    section = np.asarray(points, dtype=float)
    for period in range(1, len(section) // 2 + 1):
        if np.all(np.abs(section[period:] - section[:-period]) <= closeness):
            return period
    return 0


@dataclass(frozen=True, kw_only=True)
class Integrator:
    """A Runge-Kutta method and its steps, as somebody may have drawn a diagram with it.

    Parameters
    ----------
    steps : int, optional
        Steps a mesh period. Alone, those of the classical method of order four; beside `rtol`, the least number.
    rtol : float, optional
        The relative tolerance of RK45; the absolute one is a thousandth of it.

    Raises
    ------
    ValueError
        For neither, or a value out of range.

    Examples
    --------
    >>> print(Integrator(steps=50), Integrator(rtol=1e-3), Integrator(rtol=1e-3, steps=50), sep="; ")
    RK4, 50 steps; RK45, rtol 0.001; RK45, rtol 0.001, at least 50 steps
    """

    steps: int | None = None
    rtol: float | None = None

    def __post_init__(self) -> None:
        if self.steps is None and self.rtol is None:
            raise ValueError("an integrator needs steps or rtol, got neither")
        if self.steps is not None:
            check_count("steps", self.steps)
        if self.rtol is not None:
            check_number("rtol", self.rtol, above=0.0)

    def __str__(self) -> str:
        if self.rtol is None:
            return f"RK4, {self.steps} steps"
        return f"RK45, rtol {self.rtol:g}" + (f", at least {self.steps} steps" if self.steps else "")

    def sections(
        self, oscillators: Sequence[Oscillator], x: float, v: float, n_discarded: int, n_kept: int, *, chain: int = 1
    ) -> NDArray[np.float64]:
        """Section points of many oscillators, in parallel over the cores.

        Parameters
        ----------
        oscillators : sequence of Oscillator
            All with equally many stiffness levels.
        x, v : float
            The start of all that do not carry on.
        n_discarded, n_kept : int
            Mesh periods left out first, and section points kept after them.
        chain : int
            Oscillators in a chain, a divisor of their number: each but the first of its chain starts where the one
            before it ended.

        Returns
        -------
        ndarray of float, shape (n, n_kept, 2)
            X and X'; nan where the integrator gave up.

        Examples
        --------
        >>> Integrator(steps=400).sections([Oscillator()], 1.0, 0.0, 500, 2)[0].round(3).tolist()
        [[0.349, -0.256], [0.926, -0.281]]
        """
        n_periods = n_discarded + n_kept - 1
        if self.rtol is None:
            steps = Steps(0.0, 0.0, self.steps or 0, 0)
        else:
            steps = _adaptive(self.rtol, 1e-3 * self.rtol, n_periods, self.steps or 0)
        points, status, _calls = _sections(oscillators, x, v, n_periods, n_kept, steps, chain=chain)
        points[status != COMPLETE] = np.nan
        return points


def _sections(
    oscillators: Sequence[Oscillator],
    x: float,
    v: float,
    n_periods: int,
    n_kept: int,
    steps: Steps,
    *,
    chain: int,
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Section points (n, n_kept, 2), status (n,) and calls of the right-hand side (n,)."""
    n = len(oscillators)
    starts = np.broadcast_to(check_start(x, v), (n, 2))
    lanes = lanes_of(oscillators, starts, SettleSettings(n_transient=0))
    points, counts = np.empty((n, n_kept, 2)), np.zeros((n, 2), np.int64)
    on_all_cores(integrate_lanes, (lanes, chain, n_periods, steps, points, counts), n, chain)
    return points, counts[:, 0], counts[:, 1]


def _adaptive(rtol: float, atol: float, n_periods: int, per_period: int = 0) -> Steps:
    """The steps of RK45 over `n_periods`."""
    rtol, atol = check_number("rtol", rtol, above=0.0), check_number("atol", atol, above=0.0)
    return Steps(rtol, atol, per_period, MAX_STEPS_PER_PERIOD * n_periods)
