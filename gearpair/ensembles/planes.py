"""Which motion each start of a plane leads to: basins of attraction, and what the attractors are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import checked
from gearpair._flow.states import Known
from gearpair.ensembles.capture import (
    Found,
    Numbered,
    Numbers,
    found_in,
    known_attractors,
    leading,
    number_attractors,
    numbered,
    scouts,
    seen_before,
    with_sets,
)
from gearpair.ensembles.chaos import chaotic_sets, observed_in
from gearpair.ensembles.datasets import (
    OF_PLANES,
    check_origin,
    dataset,
    settled_columns,
    variables_of,
    way_columns,
    with_numbers,
)
from gearpair.ensembles.escape_rates import EscapeRate, Persistence
from gearpair.ensembles.labelling import Attractors, known_of, numbers_of
from gearpair.ensembles.stores import add_column, add_table, by_store, column_of, fingerprint, read_blocks, stored
from gearpair.motion.impacts import ImpactState
from gearpair.motion.names import Motion, motions_from
from gearpair.motion.settling import MANY, BatchOptions, SettleSettings, settle_batch
from gearpair.motion.steady import SteadyState, steady_state
from gearpair.motion.trajectories import check_starts
from gearpair.oscillator import Oscillator

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client
    from zarr import Group

ATTRACTOR_COLUMNS = ("status", "period", "impact_state", "x_min", "x_max", "exponent", "smallest_exponent")
RATES = (
    "n_watched", "watched_periods", "escapes", "escape_rate", "escape_rate_low", "escape_rate_high", "mean_life",
    "mean_life_low", "mean_life_high",
)  # fmt: skip


@checked
def basins(
    osc: Oscillator,
    x: ArrayLike,
    v: ArrayLike,
    *,
    attractors: Attractors | None = None,
    store: str | Path | None = None,
    client: Client | None = None,
    progress: bool = False,
    **settling: Unpack[BatchOptions],
) -> xr.Dataset:
    """The attractor that each start of a grid reaches, and what happens on the way.

    Parameters
    ----------
    osc : Oscillator
    x, v : array_like of float, shapes (n_x,) and (n_v,)
        Initial X and X'.
    attractors : Attractors, optional
        Motions of `osc` found before, by `gearpair.attractors` with the same `settling`: they are not looked for again
        and keep their numbers, reached or not. Others that starts lead to have the next ones. What was then seen of
        chaotic sets counts, too: a set that motions have left is a transient.
    store : path, optional
        Write the result to a Zarr store, block by block, and return it from there: memory then holds one block. The
        same call goes on with a store not yet finished; one of another call is refused. Codes stand for words, which
        `gearpair.ensembles.decoded` puts back.
    client : distributed.Client, optional
        Compute the blocks on its workers, which must see the path of the store.
    progress : bool
        Show a progress bar on stderr, with the most mesh periods that all may take.
    **settling
        See `gearpair.motion.BatchOptions`.

    Returns
    -------
    xarray.Dataset
        Over ``(v, x)``: ``attractor`` (its number; -1 where the motion did not stay bounded, is a transient still, or
        was not judged), ``status``, ``period``, ``impact_state``, ``x_min``, ``x_max``, ``exponent``,
        ``smallest_exponent``, ``exponent_error``, ``lasted`` (mesh periods that it was followed for; of a periodic
        motion, until it had settled); of the way ``worst_impact_state`` and ``largest_displacement`` (the attractor
        included), ``settling_time`` and ``impacts_before`` (nan unless periodic); ``chaotic_set`` (the number of the
        one that it was on, or -1), with ``chaos_x_min``, ``chaos_x_max`` and ``chaos_exponent``, which it then showed.

        Over ``attractor_number``: ``attractor_status``, ``attractor_period``, ``attractor_impact_state``,
        ``attractor_x_min``, ``attractor_x_max``, ``attractor_exponent``, ``attractor_smallest_exponent``,
        ``attractor_x``, ``attractor_v`` (its section point of smallest X; nan unless periodic),
        ``attractor_chaotic_set`` and ``attractor_share`` of the starts.
        Periodic attractors come first, by period and X; then chaotic sets that no motion has left; then all unsettled
        motions as one.

        Over ``set_number``, by smallest X, all chaotic sets that were seen: ``set_persistence``, ``set_x_min``,
        ``set_x_max``, ``set_exponent`` (the mean), ``set_still`` (motions that are still there), what an `EscapeRate`
        holds (``set_escapes``, ``set_watched_periods``, ``set_mean_life`` with its ends, ...), and
        ``set_leads_to`` over ``(set_number, attractor_number)``, the shares of where the others went.

    Raises
    ------
    ImportError
        For a store without zarr, which the extra ``cluster`` brings.
    ValueError
        For a store of another call.
    RuntimeError
        For a store that another process is writing.
    FileNotFoundError
        For a store that has lost a block: it says which.

    Notes
    -----
    Attractors are looked for from some of the starts first. Around each stable cycle a neighbourhood is certified that
    no motion leaves, and every start is followed until one of them captures it: that is its settling time, rounded
    up to a mesh period. What is not captured settles as in `steady_state`, and is watched for `n_watch` mesh periods.

    The motions of a chaotic set are one experiment: one that leaves shows that the set is a transient. Those still on
    it have the status ``"transient"`` and no attractor. Where the motions looked at first have stayed for a million
    mesh periods together, the others are not watched, and believed to stay: at 95 % the set's mean life is then more
    than 333 000.

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
    plane = Plane.of(osc, xs, vs, MANY.having(settling, BatchOptions), attractors)
    if by_store(store, client):
        return stored(plane, store, partial(_number, plane), client=client, progress=progress)
    columns = plane.columns(0, len(vs), progress=progress)
    result = numbered(columns, plane.settings.before_watch(osc), plane.known.lasting, plane.before)
    variables = variables_of(result.columns, ("v", "x"), (len(vs), len(xs))) | numbered_variables(
        result, len(columns["status"])
    )
    return with_numbers(dataset(osc, variables, plane.axes))


@dataclass(frozen=True)
class Plane:
    """A plane of starts to be settled in any parts (a `gearpair.ensembles.stores.MotionGrid`)."""

    osc: Oscillator
    axes: dict[str, NDArray[np.float64]]
    settings: SettleSettings
    known: Known
    before: Numbers | None = None

    @classmethod
    def of(
        cls,
        osc: Oscillator,
        xs: NDArray[np.float64],
        vs: NDArray[np.float64],
        settings: SettleSettings,
        attractors: Attractors | None = None,
    ) -> Plane:
        """With the attractors, if given, or those that some of the starts reach: the same however the plane is cut."""
        if attractors is not None:
            known = known_of(attractors, osc, settings)
            return cls(osc, {"v": vs, "x": xs}, settings, known, numbers_of(attractors))
        n = len(xs) * len(vs)
        rows, columns = np.divmod(scouts(n), len(xs))
        scouting = np.stack([xs[columns], vs[rows]], axis=1)
        return cls(osc, {"v": vs, "x": xs}, settings, known_attractors(osc, scouting, settings))

    @property
    def identity(self) -> dict[str, str]:
        """What the numbers depend on besides the axes."""
        same = {"kind": "basins", "oscillator": repr(self.osc), "settings": repr(self.settings)}
        if self.before is None:
            return same
        parts = self.before.numbers, self.known.settled.points, self.known.lasting, *self.before.observed
        return same | {"attractors": fingerprint(np.concatenate([np.ravel(part) for part in parts]))}

    def columns(self, first: int, last: int, *, cores: bool = True, progress: bool = False) -> dict[str, NDArray[Any]]:
        """The results for rows `first` to `last` of X', as codes."""
        xs, vs = self.axes["x"], self.axes["v"]
        starts = np.stack([np.tile(xs, last - first), np.repeat(vs[first:last], len(xs))], axis=1)
        share = self.settings.share_of_work(len(xs) * len(vs))
        out = settle_batch(
            [self.osc], starts, self.settings, known=self.known, share=share, cores=cores, progress=progress
        )
        return settled_columns(out) | way_columns(out)


def _number(plane: Plane, group: Group) -> None:
    """One numbering for the attractors and chaotic sets of all blocks of a store, and what they are."""
    names = [*ATTRACTOR_COLUMNS, *OF_PLANES, "lasted"]
    discard, n_x, n = plane.settings.before_watch(plane.osc), len(plane.axes["x"]), len(plane.axes["v"])
    observed = [observed_in(columns, discard) for _first, _last, columns in read_blocks(plane, group, names)]
    sets = chaotic_sets([*observed, seen_before(plane.known.lasting, plane.before)])
    status = column_of(group, "status")
    found: list[Found] = []
    for first, last, columns in read_blocks(plane, group, names):
        columns = with_sets(sets, columns, discard)
        status[first:last] = columns["status"].reshape(last - first, n_x)
        found.append(found_in(columns, first * n_x)[0])
    numbers, table = number_attractors(found, sets, plane.before, n * n_x)
    leads_to = np.zeros((len(sets.observed.motions), len(table["counts"])), np.int64)
    arrays = {name: add_column(plane, group, name, np.int64) for name in ("chaotic_set", "attractor")}
    for part, (first, last, columns) in zip(numbers, read_blocks(plane, group, names), strict=True):
        columns = with_sets(sets, columns, discard)
        columns["attractor"] = part[found_in(columns, first * n_x)[1]]
        leads_to += leading(columns, sets, table["number"])
        for name, array in arrays.items():
            array[first:last] = columns[name].reshape(last - first, n_x)
    add_table(group, numbered_variables(Numbered({}, table, sets, leads_to), n * n_x, coded=True))


def numbered_variables(result: Numbered, n: int, *, coded: bool = False) -> dict[str, Any]:
    """What the attractors and the chaotic sets of `n` starts are."""
    observed, rates = result.sets.observed, result.sets.rates
    columns: dict[str, NDArray[Any]] = {
        "x_min": observed.x_min,
        "x_max": observed.x_max,
        "exponent": result.sets.exponents,
    }
    columns |= {"still": observed.motions - observed.escapes}
    columns |= {name: np.array([getattr(rate, name) for rate in rates], float) for name in RATES}
    columns |= {"persistence": np.array([_persistence(rate) for rate in rates], "U9")}
    variables = attractor_variables(result.table, n, coded=coded)
    variables |= variables_of(
        {f"set_{name}": column for name, column in columns.items()}, ("set_number",), (len(rates),)
    )
    shares = result.leads_to / np.maximum(result.leads_to.sum(axis=1, keepdims=True), 1)
    return variables | variables_of({"set_leads_to": shares}, ("set_number", "attractor_number"), shares.shape)


def _persistence(rate: EscapeRate) -> str:
    """Whether a chaotic set lasts, in a word."""
    return str(rate.persistence if rate.n_watched else Persistence.UNWATCHED)


def attractor_variables(
    table: Mapping[str, NDArray[Any]], n: int, *, errors: bool = False, coded: bool = False
) -> dict[str, Any]:
    """What each attractor is and its share of `n` starts, with the standard errors that random starts leave."""
    share = table["counts"] / n
    columns = {f"attractor_{name}": table[name] for name in (*ATTRACTOR_COLUMNS, "chaotic_set")}
    columns |= {"attractor_x": table["section_x"], "attractor_v": table["section_v"], "attractor_share": share}
    if errors:
        columns["attractor_share_error"] = np.sqrt(share * (1.0 - share) / n)
    numbers: dict[str, Any] = {"attractor_number": (("attractor_number",), table["number"], {})}
    return numbers | variables_of(columns, ("attractor_number",), share.shape, coded=coded)


@checked
def attractor_motions(result: xr.Dataset, least_share: float = 0.0) -> list[Motion]:
    """What each attractor of a `gearpair.basins` is: its motion and, where periodic, its impact state.

    Attractors that less than `least_share` of the starts reach are left out.

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


@checked
def attractor_states(osc: Oscillator, result: xr.Dataset, least_share: float = 0.0) -> list[SteadyState]:
    """The periodic attractors of the `gearpair.basins` of `osc`, each described in full.

    Attractors that less than `least_share` of the starts reach are left out.

    Examples
    --------
    >>> [state.period for state in attractor_states(Oscillator(), basins(Oscillator(), [-2.0, 1.0], [0.0]))]
    [1, 2]
    """
    check_origin(osc, result)
    columns = (result[f"attractor_{name}"].values.tolist() for name in ("x", "v", "share"))
    rows = zip(*columns, strict=True)
    return [steady_state(osc, x, v) for x, v, share in rows if np.isfinite(x) and share >= least_share]
