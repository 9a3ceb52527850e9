"""All attractors along a parameter with the shares of their basins, and where one of them ends."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_count, check_number, checked
from gearpair._flow.states import TRANSIENT
from gearpair.ensembles.capture import known_attractors, numbered, scouts
from gearpair.ensembles.datasets import dataset, oscillators_along, settled_columns, variables_of
from gearpair.ensembles.planes import ATTRACTOR_COLUMNS
from gearpair.ensembles.shares import random_starts
from gearpair.motion.settling import MANY, SettleOptions, SettleSettings, settle_batch
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr

SMALL_STEPS = 32  # in which a motion that changes much from one value to the next is carried there
ARRIVED = 1e-3  # how near, in sizes, to the motion found there
ESCAPES, LINGERS = -2, -3  # what an attractor that has ended tips to where that is no attractor


@checked
def continue_attractors(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    *,
    n: int = 500,
    x_reach: tuple[float, float] = (-4.0, 4.0),
    v_reach: tuple[float, float] = (-3.0, 3.0),
    seed: int = 0,
    nearest: float = 0.3,
    **settling: Unpack[SettleOptions],
) -> xr.Dataset:
    """The attractors at each value of a parameter, matched from value to value, with their shares of random starts.

    Parameters
    ----------
    osc, parameter, values, **settling
        As in `gearpair.sweep`.
    n, x_reach, v_reach, seed
        As in `basin_stability`; the starts are the same at every value.
    nearest : float
        Attractors of neighbouring values are one if their smallest and largest X differ by no more than this share of
        their size, which is the distance of these two, and half the backlash (1) at least.

    Returns
    -------
    xarray.Dataset
        Over ``(parameter, attractor)``: ``share`` (nan where the attractor was not found), ``attractor_status``,
        ``attractor_period``, ``attractor_impact_state``, ``attractor_x_min``, ``attractor_x_max``,
        ``attractor_exponent``, ``attractor_smallest_exponent``, and ``tips_to``: at the first value without the
        attractor, the number of the one that its motion goes over to; -2 where it escapes; -3 where it is chaotic
        still, on a set that others have left; -1 elsewhere. Attractors are numbered as they turn up. Over
        ``parameter``: ``transient_share`` of the starts that are transients still, and belong to no attractor.

    Notes
    -----
    The field's "global continuation" (Datseris, Luiz Rossi and Wagemakers, 2023): the attractors of one value are the
    first starts of the next. An attractor goes on as the one that its own motion settles on, if that is near, or if a
    periodic motion carried there in small steps is near at each of them. Where it is not, the attractor has ended, and
    its motion has tipped. One that turns up again takes its old number, if it is near where it was last seen.

    A chaotic attractor may end without a new one near: from a crisis on its set is a transient, which some starts have
    left and others have not yet.

    Examples
    --------
    >>> shares = continue_attractors(Oscillator(), "damping_ratio", [0.15, 0.16, 0.17], n=50)
    >>> shares.share.values.tolist(), int(shares.tips_to.max())
    ([[1.0], [1.0], [1.0]], -1)
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    nearest = check_number("nearest", nearest, above=0.0)
    starts = random_starts(check_count("n", n), x_reach, v_reach, seed)
    settings = MANY.having(settling)
    entries: list[tuple[int, int, dict[str, float]]] = []  # row, number, what there is to tell
    places: dict[int, NDArray[np.float64]] = {}  # number -> the extremes it was last seen with
    points: dict[int, NDArray[np.float64]] = {}  # number at the value before -> a point of it
    lingering = np.zeros(len(checked))
    for i, each in enumerate(oscillators):
        before = list(points)
        here = np.concatenate([starts, *(points[number][np.newaxis] for number in before)])
        first = np.concatenate([scouts(n), np.arange(n, len(here))])
        known = known_attractors(each, here[first], settings)
        out = settle_batch([each], here, settings, known=known)
        result = numbered(settled_columns(out), settings.before_watch(each), known.lasting)
        labels, table = result.columns["attractor"], result.table
        extremes = np.column_stack([table["x_min"], table["x_max"]])
        still = result.columns["status"] == TRANSIENT
        lingering[i] = still[:n].mean()
        leads_to = dict(zip(before, np.where(still, LINGERS, labels)[n:].tolist(), strict=True))
        followed = {
            number
            for number, k in leads_to.items()
            if k >= 0 and table["period"][k] and _apart(extremes[k], places[number]) > nearest
            and _goes_on(osc, parameter, checked[i - 1 : i + 1], points[number], extremes[k], nearest, settings)
        }  # fmt: skip
        given, tipped = _matched(leads_to, places, extremes, nearest, followed)
        counts = np.bincount(labels[:n][labels[:n] >= 0], minlength=len(extremes))
        told = {"share": counts / n, **{name: table[name] for name in ATTRACTOR_COLUMNS}}
        entries += [(i, number, {name: column[k] for name, column in told.items()}) for k, number in enumerate(given)]
        entries += [(i, number, {"tips_to": to}) for number, to in tipped.items()]
        points = {number: out.points[table["first"][k], 0] for k, number in enumerate(given)}
        places |= {number: extremes[k] for k, number in enumerate(given)}
    shape = len(checked), len(places)
    columns = {name: np.full(shape, np.nan) for name in ("share", "x_min", "x_max", "exponent", "smallest_exponent")}
    columns |= {name: np.full(shape, -1) for name in ("status", "impact_state", "tips_to")}
    columns["period"] = np.zeros(shape, np.int64)
    for i, number, row in entries:
        for name, value in row.items():
            columns[name][i, number] = value
    named = {name if name in ("share", "tips_to") else f"attractor_{name}": column for name, column in columns.items()}
    variables = variables_of(named, (parameter, "attractor"), shape)
    variables["transient_share"] = (parameter, lingering, attributes("transient_share"))
    return dataset(osc, variables, {parameter: checked}).assign_coords(attractor=np.arange(shape[1]))


def _apart(extremes: NDArray[np.float64], others: NDArray[np.float64]) -> Any:
    """How far the extremes (..., 2) of motions are from others, in sizes of the larger motion."""
    sizes = np.maximum(np.ptp(extremes, axis=-1), np.ptp(others, axis=-1))
    return np.abs(extremes - others).max(axis=-1) / np.maximum(sizes, 1.0)


def _goes_on(
    osc: Oscillator,
    parameter: str,
    ends: NDArray[np.float64],
    point: NDArray[np.float64],
    extremes: NDArray[np.float64],
    nearest: float,
    settings: SettleSettings,
) -> bool:
    """Whether a motion carried from one value to the next is near itself at each small step, and ends at `extremes`."""
    oscillators, _ = oscillators_along(osc, parameter, np.linspace(ends[0], ends[1], SMALL_STEPS + 1))
    starts = np.broadcast_to(point, (len(oscillators), 2))
    way = settle_batch(oscillators, starts, settings, chain=len(oscillators)).extremes[:, :2]
    return bool(np.all(_apart(way[1:], way[:-1]) <= nearest) and _apart(way[-1], extremes) < ARRIVED)


def _matched(
    leads_to: dict[int, int],
    places: dict[int, NDArray[np.float64]],
    extremes: NDArray[np.float64],
    nearest: float,
    followed: Collection[int] = (),
) -> tuple[list[int], dict[int, int]]:
    """Numbers for the attractors found here, and for each number that has ended the one that it tips to.

    `leads_to` has, for each number of the value before, the attractor found here that its motion settles on, -1 where
    it settles on none, or LINGERS; the numbers `followed` there are it, near or not.
    """
    given = [-1] * len(extremes)
    apart = {number: _apart(extremes, place) for number, place in places.items()}
    for number, k in sorted(leads_to.items(), key=lambda pair: apart[pair[0]][pair[1]] if pair[1] >= 0 else np.inf):
        if k >= 0 and given[k] < 0 and (apart[number][k] <= nearest or number in followed):
            given[k] = number
    ended = {number: k for number, k in leads_to.items() if number not in given}
    for k in range(len(given)):
        if given[k] < 0:  # one that was here before, the nearest first, or a new one
            back = sorted(
                (apart[number][k], number) for number in places if number not in given and number not in ended
            )
            given[k] = back[0][1] if back and back[0][0] <= nearest else max([*places, *given, -1]) + 1
    return given, {number: given[k] if k >= 0 else LINGERS if k == LINGERS else ESCAPES for number, k in ended.items()}
