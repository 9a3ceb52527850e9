"""The article's integrator, for comparison: sections and diagrams as adaptive Runge-Kutta draws them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_choice, check_count, check_number, check_options, checked
from gearpair._cores import on_all_cores
from gearpair._flow.runge_kutta import COMPLETE, Steps, integrate_lanes
from gearpair.ensembles.datasets import dataset, oscillators_along, section_variables
from gearpair.motion.settling import ONE, lanes_of
from gearpair.motion.trajectories import check_start
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr

MAX_STEPS_PER_PERIOD = 100_000
PERIODS_OF_EXACT_FLOW = 100  # that take as long as a mesh period by Runge and Kutta, or so


@checked
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
    osc, x, v
        As in `gearpair.trajectory`.
    n_periods : int
        Base periods of one uninterrupted integration.
    n_kept : int, optional
        The last points to keep, at most ``n_periods + 1``; all when not given.
    rtol, atol : float
        The integrator's tolerances; scipy's defaults.

    Returns
    -------
    ndarray of float, shape (n_kept, 2)
        X and X' at the base periods' starts, by the integrator's own quartic interpolant.

    Raises
    ------
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
    method = Integrator(rtol=rtol, atol=atol)
    points, status, _calls = method.integrate([osc], x, v, n_periods - n_kept + 1, n_kept)
    if status[0] != COMPLETE:
        raise RuntimeError("RK45 gave up: the motion escapes to infinity, or rtol and atol are too small to reach")
    return points[0]


class DiagramOptions(TypedDict, total=False):
    """How a diagram is drawn with a fixed transient, and read: keyword arguments of the functions that draw one.

    Parameters
    ----------
    n_transient : int
        Base periods discarded at each value, 500 when not given.
    n_samples : int
        Section points kept per value, 128 when not given.
    closeness : float
        Section points this close count as one when the period is read off the diagram, 0.01 when not given.
    """

    n_transient: int
    n_samples: int
    closeness: float


def diagram_rules(options: DiagramOptions) -> tuple[int, int, float]:
    """`DiagramOptions` with what was not given, in their order, checked."""
    check_options(options, DiagramOptions.__annotations__)
    return (
        check_count("n_transient", options.get("n_transient", 500), at_least=0),
        check_count("n_samples", options.get("n_samples", 128), at_least=2),
        check_number("closeness", options.get("closeness", 0.01), above=0.0),
    )


def section_diagram(
    osc: Oscillator,
    along: Mapping[str, NDArray[np.float64]],
    points: NDArray[np.float64],
    closeness: float,
    **facts: Any,
) -> xr.Dataset:
    """Section points (n, n_samples, 2) along a parameter, and the periods that a reader sees in them."""
    (parameter,) = along
    period = [section_period(section, closeness) for section in points]
    variables = section_variables(parameter, points) | {"period": (parameter, period, attributes("period"))}
    return dataset(osc, variables, along, **facts)


@checked
def runge_kutta_sweep(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    *,
    x: float = 1.0,
    v: float = 0.0,
    seeding: Literal["carry", "restart"] = "carry",
    rtol: float = 1e-3,
    atol: float = 1e-6,
    **options: Unpack[DiagramOptions],
) -> xr.Dataset:
    """`sweep` as RK45 draws it: a bifurcation diagram with the integrator's errors in it.

    Parameters
    ----------
    osc, parameter, values, x, v, seeding
        As in `sweep`.
    rtol, atol : float
        The integrator's tolerances; scipy's defaults.
    **options
        See `DiagramOptions`.

    Returns
    -------
    xarray.Dataset
        Dimensions ``(parameter, sample)``: ``x``, ``v`` (nan where the integrator gave up); per value ``period``, the
        smallest that all kept points repeat with (0 when none up to half of them), and ``calls`` of the
        right-hand side.

    Examples
    --------
    >>> runge_kutta_sweep(Oscillator(), "mesh_frequency", [1.65, 1.7], rtol=1e-9, atol=1e-9).period.values.tolist()
    [2, 2]
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    check_choice("seeding", seeding, ("carry", "restart"))
    n_transient, n_samples, closeness = diagram_rules(options)
    chain = len(oscillators) if seeding == "carry" else 1
    method = Integrator(rtol=rtol, atol=atol)
    points, status, calls = method.integrate(oscillators, x, v, n_transient, n_samples, chain)
    points[status != COMPLETE] = np.nan
    drawn = section_diagram(osc, {parameter: checked}, points, closeness, seeding=seeding, rtol=rtol, atol=atol)
    return drawn.assign(calls=(parameter, calls, attributes("calls")))


@checked
def section_period(points: ArrayLike, closeness: float = 0.01) -> int:
    """The period that a reader sees in successive section points (n, 2): the smallest that all of them repeat with.

    Points as close as `closeness` in X and in X' count as one. 0 when none up to half the number of points.

    Examples
    --------
    >>> section_period([[1.0, 0.0], [2.0, 0.0], [1.001, 0.0], [2.0, 0.0]])
    2
    """
    section, closeness = check_array("points", points, finite=False), check_number("closeness", closeness, above=0.0)
    if section.ndim != 2:
        raise ValueError(f"points must be section points of shape (n, 2), got shape {section.shape}")
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
        The relative tolerance of RK45.
    atol : float, optional
        Its absolute tolerance; a thousandth of `rtol` when not given.

    Examples
    --------
    >>> print(Integrator(steps=50), Integrator(rtol=1e-3), Integrator(rtol=1e-3, steps=50), sep="; ")
    RK4, 50 steps; RK45, rtol 0.001; RK45, rtol 0.001, at least 50 steps
    """

    steps: int | None = None
    rtol: float | None = None
    atol: float | None = None

    def __post_init__(self) -> None:
        if self.steps is None and self.rtol is None:
            raise ValueError("an integrator needs steps or rtol, got neither")
        if self.steps is not None:
            check_count("steps", self.steps)
        for name, tolerance in (("rtol", self.rtol), ("atol", self.atol)):
            if tolerance is not None:
                check_number(name, tolerance, above=0.0)

    def __str__(self) -> str:
        if self.rtol is None:
            return f"RK4, {self.steps} steps"
        atol = "" if self.atol is None else f", atol {self.atol:g}"
        return f"RK45, rtol {self.rtol:g}{atol}" + (f", at least {self.steps} steps" if self.steps else "")

    @checked
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
            Base periods left out first, and section points kept after them.
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
        points, status, _calls = self.integrate(oscillators, x, v, n_discarded, n_kept, chain)
        points[status != COMPLETE] = np.nan
        return points

    @checked
    def integrate(
        self, oscillators: Sequence[Oscillator], x: float, v: float, n_discarded: int, n_kept: int, chain: int = 1
    ) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
        """As `sections`: points (n, n_kept, 2), how each integration ended (n,), calls of the right-hand side (n,)."""
        n_discarded = check_count("n_discarded", n_discarded, at_least=0)
        n_kept, chain = check_count("n_kept", n_kept), check_count("chain", chain)
        n, n_periods = len(oscillators), n_discarded + n_kept - 1
        if n == 0 or n % chain:
            raise ValueError(f"oscillators must be one chain of {chain} at least, or several, got {n} oscillators")
        lanes = lanes_of(oscillators, np.broadcast_to(check_start(x, v), (n, 2)), ONE)
        mesh_periods = n_periods * lanes.mesh_periods
        steps = Steps(0.0, 0.0, self.steps or 0, 0)
        if self.rtol is not None:
            atol = 1e-3 * self.rtol if self.atol is None else self.atol
            steps = Steps(float(self.rtol), float(atol), self.steps or 0, MAX_STEPS_PER_PERIOD * mesh_periods)
        points, counts = np.empty((n, n_kept, 2)), np.zeros((n, 2), np.int64)
        # One chain alone is carried along value by value, so that Ctrl-C may come in between.
        block, longest = 1 if chain == n else chain, mesh_periods * PERIODS_OF_EXACT_FLOW
        arguments = (lanes, chain, n_periods, steps, points, counts)
        on_all_cores(integrate_lanes, arguments, n, block, cores=chain < n, longest=longest)
        return points, counts[:, 0], counts[:, 1]
