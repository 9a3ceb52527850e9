"""A drive as it is built many times over: what share of the gearboxes rattles, and on which tolerance it hangs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray
from tqdm import tqdm

from gearpair._checks import check_array, check_count, check_number, check_reach, checked
from gearpair.design.charts import check_speeds, drive_side
from gearpair.design.sensitivities import OF_DRIVE, OF_PAIR
from gearpair.drive import GearDrive
from gearpair.ensembles.datasets import axis_attributes, settled_columns, variables_of
from gearpair.ensembles.stores import by_store, fingerprint, stored
from gearpair.motion.impacts import IMPACT_STATES, ImpactState
from gearpair.motion.measures import measure_columns
from gearpair.motion.same_orbit import same_motions
from gearpair.motion.settling import CHART, SettleOptions, SettleSettings, settle_both_ways
from gearpair.quantities import attributes
from gearpair.teeth import TipRelief

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

Array = NDArray[np.float64]
PHASE = "error_phase_rad"
OF_RELIEF = {f"relief_{field.name}": field.name for field in fields(TipRelief)}
KNOWN = (*OF_DRIVE, PHASE, *OF_RELIEF, *OF_PAIR)
MOST_BOXES = 10**7
AT_ONCE = 256  # boxes of a batch: some tens of megabytes
# A motion of one box at one speed weighs little: chaos is watched for an eighth of what a chart watches it for.
BUILT = replace(CHART, n_samples=1, n_watch=CHART.n_watch // 8, measures=True)
KEPT = [IMPACT_STATES.index(state) for state in (ImpactState.NONE_DRIVE, ImpactState.NONE_COAST)]
SHARES = {"parts": "parting_share", "clatters": "clattering_share", "two_motions": "two_motions_share"}
QUANTILES = (0.05, 0.5, 0.95)
HALVES = ("lower", "higher")


@checked
def population(
    drive: GearDrive,
    spread: Mapping[str, Any],
    speeds_rpm: ArrayLike,
    *,
    n: int = 1000,
    seed: int = 0,
    confidence: float = 0.95,
    store: str | Path | None = None,
    client: Client | None = None,
    progress: bool = False,
    **settling: Unpack[SettleOptions],
) -> xr.Dataset:
    """What the gearboxes of a series do over a range of speeds, no two of which are alike.

    Parameters
    ----------
    drive : GearDrive
        The drawing: what `spread` does not name is the same in every box.
    spread : mapping of str to (float, float) or frozen distribution
        What differs from box to box, independently of one another: a range within which all values are equally likely,
        or a frozen distribution of `scipy.stats`. Names are ``pinion_torque_nm``, ``backlash_um``,
        ``transmission_error_um`` (its harmonics go with it), ``damping_ratio`` and ``error_phase_rad``; of a drive that
        comes from `GearDrive.from_pair` any size of the pair but the numbers of teeth, such as ``pinion_shift``; and
        where the tips are relieved ``relief_pinion_um``, ``relief_gear_um`` and ``relief_length``. An unknown phase of
        the error is taken from the whole circle.
    speeds_rpm : array_like of float, shape (m,)
        Of the pinion, rising, at least two; each box is run up and down over them.
    n : int
        Boxes, up to ten million.
    seed : int
        Of the scrambling of the Sobol points; the first boxes are the same whatever `n` is.
    confidence : float
        Of the intervals.
    store, client, progress
        As in `gearpair.basins`, and so are the errors; a store is written in blocks of boxes, and holds the
        same bits.
    **settling
        See `gearpair.motion.SettleOptions`. Chaos is watched for 2500 mesh periods in case it settles, and measured
        over 300, unless `n_watch` and `n_exponent` say otherwise: a watch of 20 000 takes three times as long in all.

    Returns
    -------
    xarray.Dataset
        Over ``(box, speed)``, of both runs: the larger ``dynamic_factor`` and ``impact_velocity`` (mm/s); whether the
        teeth part (``parts``) or strike both flanks (``clatters``) in either run, and whether the runs lead to
        ``two_motions``. A motion without bound parts, and its factor is infinite.

        Over ``speed``: ``parting_share``, ``clattering_share`` and ``two_motions_share`` of the boxes, each with the
        ends of its interval, as in ``parting_share_low`` and ``_high``; over ``(quantile, speed)`` ``factor_quantile``
        and ``velocity_quantile``, each the value of a box.

        Over ``box``: ``first_loss``, the lowest speed (rpm) at which its teeth part in either run, nan if at none; and
        its ``largest_factor``. Over ``(box, quantity)`` the ``value`` of what is spread.

        Over ``quantity``: ``rank_correlation`` (Spearman) of the largest factor with it, nan where all values are one;
        over ``(quantity, half, speed)`` ``half_share``, the parting share of the boxes with the ``"lower"`` and with
        the ``"higher"`` half of its values: what a narrower tolerance brings.

    Notes
    -----
    Every box at every speed has a lane of its own, followed exactly; the first lane of a run starts from rest at the
    static deflection, each other where the one before it ended.

    The intervals are those of Clopper and Pearson (1934) for independent draws. Sobol points fill the ranges more
    evenly than these, so that the shares are closer to those of a large series than the intervals say. A rank
    correlation tells of a rise or a fall; for a phase, which goes round, read ``half_share`` or the boxes themselves.

    A million boxes at 81 speeds take 1.5 GB, in a store and in memory.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=5.0, damping_ratio=0.05)
    >>> found = population(drive, {"transmission_error_um": (0.5, 8.0)}, [3000.0, 8000.0], n=16)
    >>> found.quantity.values.tolist(), found.parting_share.values.tolist()
    (['transmission_error_um', 'error_phase_rad'], [0.0, 0.8125])
    """
    import xarray as xr  # here, so that importing gearpair stays quick

    speeds, seed = check_speeds(speeds_rpm), check_count("seed", seed, at_least=0)
    n = check_count("n", n, at_most=MOST_BOXES)
    confidence = check_number("confidence", confidence, above=0.0, below=1.0)
    if drive.pinion_torque_nm == 0.0 and "pinion_torque_nm" not in spread:
        raise ValueError("drive must have a torque that factors are relative to, got pinion_torque_nm = 0.0")
    drawn = _spread_of(drive, spread)
    boxes = Boxes(drive, tuple(drawn), sampled(drawn, n, seed), speeds, BUILT.having(settling))
    drive_of(drive, dict(zip(drawn, boxes.values[0].tolist(), strict=True)))  # at once, not after the first batch
    if by_store(store, client):
        result = stored(boxes, store, client=client, progress=progress)
    else:
        columns = variables_of(boxes.columns(0, n, progress=progress), tuple(boxes.axes), (n, len(speeds)))
        result = xr.Dataset(columns, {name: (name, axis, axis_attributes(name)) for name, axis in boxes.axes.items()})
    facts = {"drive": repr(drive), "seed": seed, "confidence": confidence}
    coordinates = {"quantity": list(drawn), "quantile": list(QUANTILES), "half": list(HALVES)}
    summary = _summary(boxes, {str(name): result[name].values for name in result}, confidence)
    return xr.Dataset(dict(result.variables) | summary, coordinates, facts)


@checked
def helps_most(found: xr.Dataset) -> tuple[str, str]:
    """The tolerance that helps most: a quantity, and which half of its values has the fewest boxes that part.

    Parameters
    ----------
    found : xarray.Dataset
        Of `population`. A phase, which nobody tells a workshop, is not looked at unless it is all that differs.

    Returns
    -------
    quantity, half : str
        With the smallest ``half_share``, the mean over all speeds.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=5.0, damping_ratio=0.05)
    >>> helps_most(population(drive, {"transmission_error_um": (0.5, 8.0)}, [3000.0, 8000.0], n=16))
    ('transmission_error_um', 'lower')
    """
    names = [str(name) for name in found.quantity.values]
    shares = found.half_share.mean("speed").values.copy()
    if len(names) > 1:
        shares[[name == "error_phase_rad" for name in names]] = np.inf
    k, half = np.unravel_index(int(np.argmin(shares)), shares.shape)
    return names[int(k)], str(found.half.values[int(half)])


def _spread_of(drive: GearDrive, spread: Mapping[str, Any]) -> dict[str, Any]:
    """What differs, by its name, an unknown phase included; or a ValueError."""
    if not spread:
        raise ValueError("spread must name at least one quantity that differs from box to box, got none")
    for name, each in spread.items():
        if name not in KNOWN:
            raise ValueError(f"unknown name {name!r} in spread; what can differ is {', '.join(KNOWN)}")
        if name in OF_PAIR and drive.mesh is None:
            raise ValueError(f"{name} can differ only where the drive comes from GearDrive.from_pair")
        if name in OF_RELIEF and drive.relief is None:
            raise ValueError(f"{name} can differ only where the drive has a relief")
        if not _is_frozen(each):
            check_reach(f"spread of {name}", each)
    unknown = drive.error_phase_rad is None and (drive.phase_is_unknown or "transmission_error_um" in spread)
    return {**spread, **({PHASE: (0.0, 2.0 * np.pi)} if unknown and PHASE not in spread else {})}


def _is_frozen(given: Any) -> bool:
    return hasattr(given, "ppf") and hasattr(given, "dist")


def sampled(spread: Mapping[str, Any], n: int, seed: int) -> Array:
    """The values of `n` boxes, shape (n, number of quantities): scrambled Sobol points through what is spread."""
    from scipy.stats import qmc  # here, so that importing gearpair stays quick

    sobol = qmc.Sobol(len(spread), scramble=True, rng=seed)
    points = sobol.random_base2(int(np.ceil(np.log2(n))))[:n] + 0.5 * 2.0**-sobol.bits  # never 0
    values = np.empty_like(points)
    for k, (name, each) in enumerate(spread.items()):
        if _is_frozen(each):
            values[:, k] = check_array(f"spread of {name}", each.ppf(points[:, k]))
        else:
            low, high = check_reach(f"spread of {name}", each)
            values[:, k] = low + (high - low) * points[:, k]
    return values


def drive_of(drive: GearDrive, values: Mapping[str, float]) -> GearDrive:
    """The drive with one box's values; the phase comes last, for it moves all harmonics."""
    changes: dict[str, Any] = {name: value for name, value in values.items() if name in (*OF_DRIVE, *OF_PAIR)}
    relief = {OF_RELIEF[name]: value for name, value in values.items() if name in OF_RELIEF}
    if relief and drive.relief is not None:
        changes["relief"] = replace(drive.relief, **relief)
    try:
        box = drive.replace(**changes)
    except ValueError as error:
        told = ", ".join(f"{name} = {value:.6g}" for name, value in values.items())
        raise ValueError(f"spread reaches a box that cannot be built, {told}: {error}") from error
    return box.at_phase(values[PHASE]) if PHASE in values else box


@dataclass(frozen=True)
class Boxes:
    """Gearboxes to be run up and down in any parts (a `gearpair.ensembles.stores.MotionGrid`)."""

    drive: GearDrive
    names: tuple[str, ...]
    values: Array
    speeds: Array
    settings: SettleSettings

    @property
    def axes(self) -> dict[str, NDArray[Any]]:
        """Boxes, by their numbers, and speeds."""
        return {"box": np.arange(len(self.values)), "speed": self.speeds}

    @cached_property
    def identity(self) -> dict[str, str]:
        """What the numbers depend on besides the axes; two of the boxes show how the drawing is read."""
        mesh, blanks = self.drive.mesh, (self.drive.pinion_blank, self.drive.gear_blank)
        first, last = (repr(self.box(i).at_speed(float(self.speeds[0])).oscillator()) for i in (0, -1))
        return {
            "kind": "population",
            "drive": repr(self.drive),
            "drawing": repr((mesh and mesh.pair, mesh and mesh.coupling, self.drive.relief, blanks)),
            "spread": f"{', '.join(self.names)}: {fingerprint(self.values)}",
            "settings": repr(self.settings),
            "oscillator": first,
            "last oscillator": last,
        }

    def box(self, i: int) -> GearDrive:
        """The drive of a box."""
        return drive_of(self.drive, dict(zip(self.names, self.values[i].tolist(), strict=True)))

    def columns(self, first: int, last: int, *, cores: bool = True, progress: bool = False) -> dict[str, NDArray[Any]]:
        """The results of boxes `first` to `last`, box by box."""
        parts = [self._batch(first, first, cores)]
        with tqdm(desc="boxes", total=last - first, unit="box", disable=not progress) as bar:
            for i in range(first, last, AT_ONCE):
                end = min(i + AT_ONCE, last)
                parts.append(self._batch(i, end, cores))
                bar.update(end - i)
        return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}

    def _batch(self, first: int, last: int, cores: bool) -> dict[str, NDArray[Any]]:
        """What is kept of the runs of some boxes."""
        drives = [self.box(i) for i in range(first, last)]
        bases = [each.at_speed(float(self.speeds[0])).oscillator() for each in drives]
        oscillators = [
            base.replace(mesh_frequency=frequency)
            for base, each in zip(bases, drives, strict=True)
            for frequency in (self.speeds / each.resonance_rpm).tolist()
        ]
        m = len(self.speeds)
        rest = np.array([drive_side(base) + base.mean_force / base.stiffness.mean for base in bases])
        starts = np.column_stack([np.repeat(rest, m), np.zeros(m * len(bases))])
        both = settle_both_ways(oscillators, starts, self.settings, chain=m, cores=cores)
        forces = np.repeat([base.mean_force for base in bases], m)
        mm_s = np.repeat([each.half_backlash_m * each.natural_frequency_rad_s * 1e3 for each in drives], m)
        runs, measures = [settled_columns(out) for out in both], [measure_columns(out.measures, forces) for out in both]
        states = np.array([run["impact_state"] for run in runs])
        periodic = np.array([run["period"] > 0 for run in runs])
        return {
            "dynamic_factor": _worst(*(row["load_factor"] for row in measures)),
            "impact_velocity": _worst(*(row[f"{side}_velocity"] for row in measures for side in ("drive", "coast")))
            * mm_s,
            "parts": ~np.isin(states, KEPT).all(axis=0),
            "clatters": (states == IMPACT_STATES.index(ImpactState.DOUBLE)).any(axis=0),
            "two_motions": ~same_motions(*runs) & periodic.any(axis=0),  # all chaos of a speed counts as one
        }


def _worst(*columns: Array) -> Array:
    """The largest of several; infinite where one is nan, as of a motion without bound."""
    return np.asarray(np.nan_to_num(np.max(columns, axis=0), nan=np.inf, posinf=np.inf))


def binomial_interval(counts: ArrayLike, n: int, confidence: float) -> tuple[Array, Array]:
    """The ends of Clopper and Pearson's interval for shares of `n` independent draws.

    Examples
    --------
    >>> low, high = binomial_interval([0, 5], 10, 0.95)
    >>> low.round(4).tolist(), high.round(4).tolist()
    ([0.0, 0.1871], [0.3085, 0.8129])
    """
    from scipy.special import betaincinv  # here, so that importing gearpair stays quick

    k, beyond = np.asarray(counts, dtype=float), 0.5 * (1.0 - confidence)
    low = np.where(k > 0, betaincinv(np.maximum(k, 1.0), n - k + 1.0, beyond), 0.0)
    high = np.where(k < n, betaincinv(k + 1.0, np.maximum(n - k, 1.0), 1.0 - beyond), 1.0)
    return low, high


def _summary(boxes: Boxes, columns: Mapping[str, NDArray[Any]], confidence: float) -> dict[str, Any]:
    """Shares, quantiles and what they hang on; `columns` have shape (boxes, speeds)."""
    n, factor, parts = len(boxes.values), columns["dynamic_factor"], columns["parts"]
    found: dict[str, tuple[tuple[str, ...] | str, Any]] = {}
    for name, share in SHARES.items():
        counts = columns[name].sum(axis=0)
        ends = binomial_interval(counts, n, confidence)
        found |= {share: ("speed", counts / n)}
        found |= {f"{share}_{end}": ("speed", each) for end, each in zip(("low", "high"), ends, strict=True)}
    for name, column in (("factor_quantile", factor), ("velocity_quantile", columns["impact_velocity"])):
        each = np.quantile(column, QUANTILES, axis=0, method="inverted_cdf")  # a box's own: no mean with infinity
        found[name] = (("quantile", "speed"), each)
    worst = factor.max(axis=1)
    found["first_loss"] = ("box", np.where(parts.any(axis=1), boxes.speeds[parts.argmax(axis=1)], np.nan))
    found["largest_factor"] = ("box", worst)
    found["value"] = (("box", "quantity"), boxes.values)
    found["rank_correlation"] = ("quantity", np.array([_rank_correlation(each, worst) for each in boxes.values.T]))
    order = np.argsort(boxes.values, axis=0)
    halves = [[parts[half].mean(axis=0) for half in (own[: (n + 1) // 2], own[n // 2 :])] for own in order.T]
    found["half_share"] = (("quantity", "half", "speed"), np.array(halves))
    return {name: (dims, each, attributes(name)) for name, (dims, each) in found.items()}


def _rank_correlation(these: Array, those: Array) -> float:
    """Spearman's; nan where one has a single value."""
    from scipy.stats import rankdata  # here, so that importing gearpair stays quick

    ranks = np.array([rankdata(these), rankdata(those)])
    return float(np.corrcoef(ranks)[0, 1]) if np.ptp(ranks, axis=1).all() else np.nan
