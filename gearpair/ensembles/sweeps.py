"""The settled motion along one parameter, or over a grid of several: the numbers of diagrams and maps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_choice, checked
from gearpair._flow.states import APERIODIC, GONE, PERIODIC, UNSETTLED, Settled
from gearpair.ensembles.capture import numbered
from gearpair.ensembles.datasets import (
    OF_PLANES,
    dataset,
    oscillators_along,
    section_variables,
    settled_columns,
    settled_variables,
    variables_of,
)
from gearpair.ensembles.stores import by_store, stored
from gearpair.motion.measures import measure_columns
from gearpair.motion.same_orbit import same_motions
from gearpair.motion.settling import (
    MANY,
    ONE,
    BatchOptions,
    SettleOptions,
    SettleSettings,
    settle_batch,
    settle_both_ways,
)
from gearpair.motion.trajectories import check_start
from gearpair.oscillator import Oscillator

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client


@checked
def sweep(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    *,
    x: float = 1.0,
    v: float = 0.0,
    seeding: Literal["carry", "restart"] = "carry",
    n_samples: int = 128,
    progress: bool = False,
    **settling: Unpack[SettleOptions],
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
    n_samples : int
        Section points kept per value; at least `max_period` are.
    progress : bool
        Show a progress bar on stderr, with the most mesh periods that all may take.
    **settling
        See `gearpair.motion.SettleOptions`.

    Returns
    -------
    xarray.Dataset
        Dimensions ``(parameter, sample)``: ``x, v`` on the section, and per value ``status``, ``period``,
        ``impact_state``, ``x_min``, ``x_max``, ``exponent`` (the largest), ``smallest_exponent``, ``exponent_error``
        and ``lasted``.

    Examples
    --------
    >>> diagram = sweep(Oscillator(), "mesh_frequency", [1.65, 1.7], seeding="restart")
    >>> dict(diagram.sizes)
    {'mesh_frequency': 2, 'sample': 128}
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    check_choice("seeding", seeding, ("carry", "restart"))
    settings = ONE.having(settling, n_samples=n_samples).whole_cycles()
    starts = np.broadcast_to(check_start(x, v), (len(oscillators), 2))
    out = settle_batch(
        oscillators, starts, settings, chain=len(oscillators) if seeding == "carry" else 1, progress=progress
    )
    variables = settled_variables(out, (parameter,), (len(checked),)) | section_variables(parameter, out.points)
    return dataset(osc, variables, {parameter: checked}, seeding=seeding)


@checked
def parameter_map(
    osc: Oscillator,
    axes: Mapping[str, ArrayLike],
    *,
    x: float = 1.0,
    v: float = 0.0,
    measures: bool = False,
    starts: ArrayLike | None = None,
    carried: str | None = None,
    store: str | Path | None = None,
    client: Client | None = None,
    progress: bool = False,
    **settling: Unpack[BatchOptions],
) -> xr.Dataset:
    """The settled motion from one start at every point of a grid of parameters, in parallel over the cores.

    Parameters
    ----------
    osc : Oscillator
    axes : mapping of str to array_like of float
        Parameter names (of ``osc.parameters``) and their values, one or more.
    x, v : float
        The start, the same everywhere.
    measures : bool
        Add the impact measures (`gearpair.motion.ImpactMeasures`) of each motion.
    starts : array_like of float, shape (n, 2), optional
        Add ``n_attractors``: how many different attractors these starts (X, X') lead to at each point.
    carried : str, optional
        One of the axes: add ``hysteresis``, whether the motion carried up along it, from (x, v) at its first value,
        differs from that carried down. With a `store` it must not be the first axis, along which blocks are cut.
    store, client, progress, **settling
        As in `gearpair.basins`, and so are the errors.

    Returns
    -------
    xarray.Dataset
        The axes are its dimensions, in their order; variables ``status``, ``period``, ``impact_state``,
        ``x_min``, ``x_max``, ``exponent`` (the largest), ``smallest_exponent``, ``exponent_error``, ``lasted``, and
        what was asked for.

    Notes
    -----
    Every point is a system of its own, so no other motion vouches for it. ``"aperiodic"`` says that its motion had not
    settled after ``lasted`` mesh periods.

    To watch all chaos of a large map for `n_watch` would take six times as long as the map. So where it has more than
    5000 points, and two axes or more, a point is watched for an eighth of `n_watch` first, and for all of it where a
    neighbour, of two on either side along each axis but the first, has left its chaos while it was watched. Where
    neighbours are alike, a chaotic transient of the mean life T thus passes for chaos with a probability of about
    ``exp(-12 500 / T)``: 1 in 500 where T is 2000, 1 in 12 where it is 5000. A window narrower than the map's steps may
    be missed: of 4611 aperiodic points of a map of speed and damping 32 settled when all were watched in full. Such a
    map, a third of it chaotic, takes not quite three times as long as without a watch.

    Examples
    --------
    >>> grid = parameter_map(Oscillator(), {"mesh_frequency": [0.6, 0.7], "damping_ratio": [0.1]}, measures=True)
    >>> grid.period.values.tolist(), grid.drive_impacts.values.tolist()
    ([[1], [1]], [[0.0], [1.0]])
    """
    if not axes:
        raise ValueError("axes must name at least one parameter and its values, got none")
    checked = {name: oscillators_along(osc, name, values)[1] for name, values in axes.items()}
    if carried is not None:
        check_choice("carried", carried, tuple(checked))
    settings = MANY.having(settling, BatchOptions, measures=measures)
    others = np.empty((0, 2)) if starts is None else check_array("starts", starts)
    if others.ndim != 2 or others.shape[1] != 2:
        raise ValueError(f"starts must be pairs of finite numbers, got shape {others.shape}")
    grid = Grid(osc, checked, check_start(x, v), settings, others, carried)
    if not by_store(store, client):
        shape = tuple(len(values) for values in checked.values())
        columns = grid.columns(0, shape[0], progress=progress)
        return dataset(osc, variables_of(columns, tuple(checked), shape), checked)
    first_axis = next(iter(checked))
    if carried == first_axis:
        raise ValueError(f"carried must not be the first axis of a stored map, {first_axis!r}: name the axes otherwise")
    return stored(grid, store, client=client, progress=progress)


# A point of a map of more points than that is watched for one part in so many of the watch at first; so many neighbours
# on either side count.
IN_FULL, FIRST_LOOK, NEIGHBOURS = 5000, 8, 2


@dataclass(frozen=True)
class Grid:
    """A grid of parameters to be settled in any parts (a `gearpair.ensembles.stores.MotionGrid`)."""

    osc: Oscillator
    axes: dict[str, NDArray[np.float64]]
    start: tuple[float, float]
    settings: SettleSettings
    others: NDArray[np.float64]
    carried: str | None

    @property
    def identity(self) -> dict[str, str]:
        """What the numbers depend on besides the axes."""
        return {
            "kind": "parameter_map",
            "oscillator": repr(self.osc),
            "start": repr(self.start),
            "settings": repr(self.settings),
            "starts": repr(self.others.tolist()),
            "carried": repr(self.carried),
        }

    def columns(self, first: int, last: int, *, cores: bool = True, progress: bool = False) -> dict[str, NDArray[Any]]:
        """The results for rows `first` to `last` of the first axis, as codes."""
        (name, values), *rest = self.axes.items()
        part = {name: values[first:last], **dict(rest)}
        points = list(product(*part.values()))
        oscillators = [self.osc.replace(**dict(zip(part, point, strict=True))) for point in points]
        starts, share = np.broadcast_to(self.start, (len(points), 2)), self._share
        settled = partial(settle_batch, share=share, cores=cores, progress=progress)
        out = self._settled(oscillators, starts, tuple(map(len, part.values())), settled)
        columns = {name: column for name, column in settled_columns(out).items() if name not in OF_PLANES}
        if self.settings.measures:
            columns |= measure_columns(out.measures, np.array([o.mean_force for o in oscillators]))
        if len(self.others):
            columns["n_attractors"] = self._attractors(oscillators, cores)
        if self.carried is not None:
            columns["hysteresis"] = self._hysteresis(oscillators, tuple(map(len, part.values())), cores)
        return columns

    def _settled(
        self,
        oscillators: list[Oscillator],
        starts: NDArray[np.float64],
        shape: tuple[int, ...],
        settled: Callable[..., Settled],
    ) -> Settled:
        """What the motions of rows of the map become: watched briefly, and in full beside one that left its chaos.

        Rows of the first axis do not look at one another, so that the map may be cut along it.
        """
        from scipy.ndimage import binary_dilation  # here, so that importing gearpair stays quick

        if self._n_points <= IN_FULL or len(shape) == 1 or 0 in shape:
            return settled(oscillators, starts, self.settings)
        out = settled(oscillators, starts, replace(self.settings, n_watch=self.settings.n_watch // FIRST_LOOK))
        neighbours = np.ones((1, *[2 * NEIGHBOURS + 1] * (len(shape) - 1)))
        watched = np.zeros(len(out.status), bool)
        while True:
            left = np.isin(out.status, (PERIODIC, GONE)) & (out.chaos[:, 2] > 0.0)
            beside = binary_dilation(left.reshape(shape), neighbours).ravel()
            rows = np.flatnonzero(beside & ~watched & np.isin(out.status, (APERIODIC, UNSETTLED)))
            if not rows.size:
                return out
            again = settled([oscillators[i] for i in rows], starts[rows], self.settings)
            for column, values in zip(out, again, strict=True):
                column[rows] = values
            watched[rows] = True

    @property
    def _share(self) -> int:
        return self.settings.share_of_work(self._n_points)

    @property
    def _n_points(self) -> int:
        return int(np.prod([len(values) for values in self.axes.values()]))

    def _attractors(self, oscillators: list[Oscillator], cores: bool) -> NDArray[np.int64]:
        """How many attractors the other starts reach, for each oscillator."""
        n = len(self.others)
        out = settle_batch(oscillators, np.tile(self.others, (len(oscillators), 1)), self.settings, cores=cores)
        columns, nothing = settled_columns(out), np.empty((0, 4))
        counts = np.zeros(len(oscillators), np.int64)
        for i, osc in enumerate(oscillators):
            own = {name: column[i * n : (i + 1) * n] for name, column in columns.items()}
            counts[i] = len(numbered(own, self.settings.before_watch(osc), nothing).table["first"])
        return counts

    def _hysteresis(self, oscillators: list[Oscillator], shape: tuple[int, ...], cores: bool) -> NDArray[np.bool_]:
        """Whether the motions carried up and down along the axis differ."""
        axis = list(self.axes).index(str(self.carried))
        order = np.moveaxis(np.arange(len(oscillators)).reshape(shape), axis, -1).ravel()
        lanes, starts = [oscillators[i] for i in order], np.broadcast_to(self.start, (len(order), 2))
        both = settle_both_ways(lanes, starts, self.settings, chain=shape[axis], share=self._share, cores=cores)
        return ~same_motions(*map(settled_columns, both))[np.argsort(order)]
