"""How long chaos lives: starts watched until they are captured, and the survivors over the mesh periods."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from tqdm import tqdm

from gearpair._checks import check_count, check_number, checked
from gearpair._cores import on_all_cores
from gearpair._flow.capture import COLUMNS, OWNER
from gearpair._flow.settle import CAPTURED
from gearpair._flow.states import GONE, PERIODIC, Known, Settled
from gearpair._flow.walk import ESCAPED, OK
from gearpair._flow.watch import Watched, watch_starts
from gearpair.ensembles.capture import joined, numbered, scouts
from gearpair.ensembles.datasets import dataset, oscillators_along, settled_columns, variables_of, with_numbers
from gearpair.ensembles.escape_rates import EscapeRate, Persistence, escape_rate
from gearpair.ensembles.labelling import Attractors, known_of, numbers_of
from gearpair.ensembles.planes import RATES, attractor_variables
from gearpair.motion.settling import MANY, nothing_known, settle_batch, transient_periods
from gearpair.motion.trajectories import check_pairs, raise_if_capped
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr

# Mesh periods of a motion, or of a few, between two chances to stop: some thirty milliseconds.
AT_ONCE = 100_000
# Mesh periods after which new attractors are first looked for, and how many times as many the next time.
FIRST_LOOK, NEXT_LOOK = 2_000, 4
ON_ITS_WAY, UNBOUNDED = -1, -2  # what stands for an attractor's number


@checked
def survival(
    osc: Oscillator,
    x: ArrayLike,
    v: ArrayLike,
    *,
    n_periods: int = 20_000,
    discard: int | None = None,
    confidence: float = 0.95,
    attractors: Attractors | None = None,
    progress: bool = False,
) -> xr.Dataset:
    """How long each start takes to settle, watched for long: the survivors, and the mean life of chaos.

    Parameters
    ----------
    osc : Oscillator
    x, v : array_like of float
        X and X' at the start of a mesh period; broadcast against each other.
    n_periods : int
        Mesh periods that each start is watched for, unless it is captured before; rounded up to whole base periods, as
        is `discard`.
    discard : int, optional
        Mesh periods that do not count: what is captured so soon went straight there and belongs to no transient.
        `gearpair.motion.transient_periods` when not given.
    confidence : float
        Of the intervals.
    attractors : Attractors, optional
        Found before, as for `gearpair.basins`: here the periodic ones count.
    progress : bool
        Show progress bars on stderr, each with the most mesh periods until attractors are looked for again.

    Returns
    -------
    xarray.Dataset
        Over ``start``, in the order given: ``start_x``, ``start_v``, ``escape_time`` (mesh periods until it was
        captured, or beyond all bounds; nan if still on its way after `n_periods`), ``attractor`` (the number of where
        it went; -1 on its way, -2 beyond all bounds) and ``status`` (of one on its way, what it is from there on). Over
        ``waited``, mesh periods: ``survivors``, the starts still on their way. Over ``attractor_number``: what each
        attractor is, as of `basins`, with ``attractor_share`` of the starts and ``escape_share`` of the escapes after
        `discard`. And of these what `EscapeRate` holds: ``n_watched``, ``watched_periods``, ``escapes``,
        ``escape_rate`` and ``mean_life`` with their ``_low`` and ``_high`` ends, ``persistence``.

    Raises
    ------
    RuntimeError
        Where the walk is capped; the message says what to do.

    Notes
    -----
    A start is captured where a certified neighbourhood holds it, which no motion leaves: it has settled for ever. (Of a
    cycle that none can be certified for, so near is it to losing stability, a circle of 1e-6 stands in.) The
    attractors are looked for from some of the starts, as in `basins`. While all are watched, some of those left over
    settle anew from where they have come to, and at the end all of them; as long as that shows a new attractor, they
    are watched again from their start.

    The rate (see `escape_rate`) is that of one set which all starts have reached by the end of `discard`. A curve of
    survivors that is no straight line in a logarithmic scale says that there are more: some of them may last. What
    counts as an escape is a cycle that captures a start; one chaotic set that leads into another is one set here.

    Examples
    --------
    >>> result = survival(Oscillator(mesh_frequency=1.09), [-1.0, 0.0, 1.0, 2.0], -1.0)
    >>> result.attractor_period.values.tolist(), int(result.survivors[-1])
    ([2], 0)
    >>> bool(result.mean_life_low < 2000.0 < result.mean_life_high), str(result.persistence.values)
    (True, 'transient')
    """
    starts = check_pairs(x, v)
    n_periods = check_count("n_periods", n_periods)
    discard = transient_periods(osc) if discard is None else check_count("discard", discard, at_least=0)
    confidence = check_number("confidence", confidence, above=0.0, below=1.0)
    if discard >= n_periods:
        raise ValueError(f"n_periods must be more than the {discard} that are discarded, got {n_periods}")
    n_periods, discard = (osc.base_periods(each) * osc.mesh_periods for each in (n_periods, discard))
    known, watched, later = watched_starts(osc, starts, n_periods, attractors, progress=progress)
    raise_if_capped(watched.status, starts)
    gone = (watched.owner >= 0) | (watched.status == ESCAPED)
    columns = {"start_x": starts[:, 0], "start_v": starts[:, 1]}
    columns["escape_time"] = np.where(gone, watched.periods, np.nan)
    before = None if attractors is None else numbers_of(attractors, periodic=True)
    result = numbered(settled_columns(known.settled), 0, known.lasting, before)
    numbers, table = result.columns["attractor"], result.table
    columns["attractor"] = np.where(watched.owner >= 0, np.append(numbers, ON_ITS_WAY)[watched.owner], ON_ITS_WAY)
    columns["attractor"][watched.status == ESCAPED] = UNBOUNDED
    columns["status"] = np.where(watched.owner >= 0, PERIODIC, GONE)
    columns["status"][~gone] = later.status
    estimate = escape_rate(columns["escape_time"], n_periods, discard=discard, confidence=confidence)
    variables = variables_of(columns, ("start",), (len(starts),))
    variables |= _survivor_variables(columns["escape_time"], discard, n_periods)
    variables |= _attractor_variables(table, columns, discard)
    variables |= estimate_variables(estimate, leaves_later=bool(np.isin(later.status, (PERIODIC, GONE)).any()))
    return with_numbers(dataset(osc, variables, {}, n_periods=n_periods, discard=discard, confidence=confidence))


@checked
def survival_along(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    x: ArrayLike,
    v: ArrayLike,
    *,
    n_periods: int = 20_000,
    discard: int | None = None,
    confidence: float = 0.95,
    progress: bool = False,
) -> xr.Dataset:
    """The mean life of chaos along one parameter, with its interval: at a crisis it grows beyond all bounds.

    Parameters
    ----------
    osc, parameter, values
        As in `gearpair.sweep`.
    x, v, n_periods, discard, confidence, progress
        As in `survival`.

    Returns
    -------
    xarray.Dataset
        Over the parameter: ``survivors`` after `n_periods`, how many are ``discarded``, and what `survival` estimates.

    Examples
    --------
    >>> result = survival_along(Oscillator(), "mesh_frequency", [1.09, 1.219], [0.0, 1.0], -1.0, n_periods=5000)
    >>> result.persistence.values.tolist(), result.survivors.values.tolist()
    (['transient', 'lasting'], [0, 2])
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    how: dict[str, Any] = {"n_periods": n_periods, "discard": discard, "confidence": confidence, "progress": progress}
    each = [survival(one, x, v, **how) for one in oscillators]
    columns = {name: np.array([one[name].item() for one in each]) for name in (*RATES, "persistence")}
    columns["survivors"] = np.array([one.survivors.values[-1] for one in each])
    columns["discarded"] = np.array([one.discard for one in each])
    variables = variables_of(columns, (parameter,), checked.shape)
    return dataset(osc, variables, {parameter: checked}, n_periods=n_periods, confidence=confidence)


def watched_starts(
    osc: Oscillator,
    starts: NDArray[np.float64],
    n_periods: int,
    attractors: Attractors | None = None,
    *,
    progress: bool = False,
) -> tuple[Known, Watched, Settled]:
    """Watch starts (n, 2) until they are captured: the attractors, where each has come to, what the others become.

    All periods are mesh periods, rounded up to whole base periods.
    The last has one row for each start that was not captured, settled from where it has come to.
    """
    settings = replace(MANY, n_watch=0).whole_cycles()  # the watch is this function's own
    known = nothing_known(settings) if attractors is None else known_of(attractors, osc, settings)
    known = joined(osc, known, settle_batch([osc], starts[scouts(len(starts))], settings, known=known))
    n, n_periods, first_look = len(starts), osc.base_periods(n_periods), osc.base_periods(FIRST_LOOK)
    watched = Watched(np.full(n, OK), np.full(n, -1), np.zeros(n, np.int64), starts.copy())
    done, until = 0, min(first_look, n_periods)
    while True:
        _watch(osc, watched, until - done, _neighbourhoods(known), progress)
        left = np.flatnonzero((watched.owner < 0) & (watched.status == OK))
        looked = left if until == n_periods else left[scouts(len(left))]
        later = settle_batch([osc], watched.points[looked], settings, known=known)
        more = joined(osc, known, later)
        if len(more.settled.status) > len(known.settled.status):
            known, done = more, 0
            watched.points[left], watched.periods[left] = starts[left], 0
        elif until == n_periods:
            return known, watched._replace(periods=watched.periods * osc.mesh_periods), later
        else:
            done, until = until, min(NEXT_LOOK * until, n_periods)


def _neighbourhoods(known: Known) -> NDArray[np.float64]:
    """Those that capture: the certified ones, and circles around the points of a cycle that has none."""
    circles = [np.empty((0, COLUMNS))]
    for i in np.setdiff1d(np.arange(len(known.settled.period)), known.neighbourhoods[:, OWNER]).tolist():
        points = known.settled.points[i, : known.settled.period[i]]
        form = 1.0 / (CAPTURED * np.maximum(1.0, np.abs(points).max(axis=1))) ** 2
        circles.append(np.column_stack([points, form, 0.0 * form, form, np.full(len(points), float(i)), 0.0 * form]))
    return np.concatenate([known.neighbourhoods, *circles])


def _watch(
    osc: Oscillator, watched: Watched, n_periods: int, neighbourhoods: NDArray[np.float64], progress: bool
) -> None:
    """Let motions go on for `n_periods` more or until they are captured, in spans that Ctrl-C may come between.

    These are base periods.
    """
    n, whole, at_once = len(watched.status), osc.mesh_periods, osc.base_periods(AT_ONCE)
    spans = [min(at_once, n_periods - done) for done in range(0, n_periods, at_once)]
    text = f"at most {n * whole * float(n_periods):.1e} mesh periods"
    with tqdm(desc=text, total=n * len(spans), unit="span", disable=not progress) as bar:
        for span in spans:
            arguments = (osc.cells, neighbourhoods, span, watched)
            on_all_cores(watch_starts, arguments, n, max(1, at_once // span), bar.update, longest=span * whole)


def _survivor_variables(times: NDArray[np.float64], discard: int, n_periods: int) -> dict[str, Any]:
    """How many starts were still on their way after the mesh periods at which that changes, and at `discard`."""
    gone = np.sort(times[~np.isnan(times)])
    waited = np.unique(np.concatenate([(0, discard, n_periods), gone])).astype(np.int64)
    survivors = len(times) - np.searchsorted(gone, waited, side="right")
    return variables_of({"waited": waited, "survivors": survivors}, ("waited",), waited.shape)


def _attractor_variables(table: dict[str, Any], columns: dict[str, Any], discard: int) -> dict[str, Any]:
    """What each attractor is, with its shares of the starts and of the escapes after `discard`."""
    n, attractor, late = len(table["counts"]), columns["attractor"], columns["escape_time"] > discard
    places = np.searchsorted(table["number"], attractor)
    table = table | {"counts": np.bincount(places[attractor >= 0], minlength=n)}
    escapes = np.bincount(places[late & (attractor >= 0)], minlength=n) / max(int(late.sum()), 1)
    variables = attractor_variables(table, len(attractor))
    return variables | variables_of({"escape_share": escapes}, ("attractor_number",), (n,))


def estimate_of(result: xr.Dataset) -> EscapeRate:
    """The estimate that a `survival` holds."""
    counted: dict[str, Any] = {name: result[name].item() for name in RATES if not name.startswith("mean_life")}
    return EscapeRate(**counted, confidence=result.attrs["confidence"])


def estimate_variables(estimate: EscapeRate, *, leaves_later: bool = False) -> dict[str, Any]:
    """An escape rate as variables without a dimension; where motions leave only later, the set is a transient too."""
    persistence = Persistence.TRANSIENT if leaves_later else estimate.persistence
    variables: dict[str, Any] = {name: ((), getattr(estimate, name), attributes(name)) for name in RATES}
    facts = attributes("persistence") | {"remedy": persistence.remedy}
    return variables | {"persistence": ((), str(persistence), facts)}
