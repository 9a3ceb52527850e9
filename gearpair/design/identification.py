"""What the speeds at which a test rig jumps say of its damping and its transmission error."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike, NDArray
from tqdm import tqdm

from gearpair._checks import check_array, check_number, check_reach, checked
from gearpair._equality import equal_by_value
from gearpair.bifurcations import Bifurcation, fold_shift, move_bifurcation
from gearpair.design.charts import carried_runs, drive_side, oscillators_at
from gearpair.design.jumps import find_jumps
from gearpair.design.lateness import lateness
from gearpair.drive import GearDrive
from gearpair.ensembles.datasets import settled_columns
from gearpair.motion.outcome import Outcome
from gearpair.motion.same_orbit import same_motions
from gearpair.motion.settling import CHART, settle_both_ways
from gearpair.oscillator import Oscillator

Array = NDArray[np.float64]
N_DAMPING, N_ERROR, N_PHASES = 10, 12, 8  # trials that look for a start
MARGIN = 0.1  # of the speeds, that a search looks beyond the jumps
FINEST, COARSEST = 0.002, 0.015  # between speeds of a search, as a share of them
N_STARTS = 6  # of Newton's method, at most
STEPS, LARGEST, HALVINGS = 40, 0.3, 8  # of Newton's method, in logarithms and radians
CLOSE = 1e-11
FITS = 1e-9  # relative to the speeds: a remainder that is rounding
HALF_WIDTH = 1.959963984540054  # of an interval of 95 %, in standard uncertainties
VAGUE = np.log(2.0)  # of the half-width of a logarithm
SLOPE = 1e-5  # half the relative change over which a map is differenced
CURVE_STEP, CURVE_STEPS = 0.06, 24


class IdentificationStatus(Outcome):
    """How an identification ended: a word, with a `remedy` that says what a user may do."""

    FOUND = "found", "the folds lie where the jumps were seen, and the speeds determine what was asked for"
    UNDETERMINED = (
        "undetermined",
        "the folds lie where the jumps were seen, but so they do along a whole line: to within their uncertainty the "
        "speeds leave a factor of two or more; measure at other torques, or measure the speeds more exactly",
    )
    NO_FIT = (
        "no_fit",
        "there are folds, but none at these speeds: check resonance_rpm of the drive against the rig, or widen "
        "damping_ratios and errors_um",
    )
    NO_FOLD = (
        "no_fold",
        "no damping ratio and error tried lets the drive jump near these speeds: check resonance_rpm of the drive "
        "against the rig, or widen damping_ratios and errors_um",
    )


@equal_by_value
@dataclass(frozen=True, kw_only=True, repr=False)
class Identification:
    """What the jumps of a test rig say.

    Attributes
    ----------
    drive : GearDrive
        With the damping and the error found; as it was given where none were.
    status : IdentificationStatus
        ``"found"``, ``"undetermined"``, ``"no_fit"`` or ``"no_fold"``; ``status.remedy`` says what to do.
    damping_ratio, transmission_error_um, error_phase_rad : float
        Nan where none were found.
    damping_interval, error_interval, phase_interval : tuple of float
        Of 95 %; the phase's is the phase alone where it was fixed.
    runs : tuple of str, length n
        Of each jump that was seen, ``"up"`` or ``"down"``.
    torques_nm, measured_rpm, fold_rpm : ndarray of float, shape (n,)
        Of each jump: the torque, the speed at which it was seen, and at which the fold lies.
    condition : float
        Of the derivative of the relative speeds by what is sought, in logarithms and radians: the larger, the less the
        speeds tell both apart.
    late_rpm : ndarray of float, shape (n,)
        How far a run at the rig's ramp goes on beyond each fold before it jumps; nan where no ramp was given.
    others : tuple of (float, float, float)
        Damping ratio, error and phase of other answers that fit as well.
    curves : tuple of ndarray of float, shape (m, 2)
        Of each jump the damping ratios and errors (um) with a fold at its speed, the phase being that of the answer.
    """

    drive: GearDrive
    status: IdentificationStatus
    damping_ratio: float
    transmission_error_um: float
    error_phase_rad: float
    damping_interval: tuple[float, float]
    error_interval: tuple[float, float]
    phase_interval: tuple[float, float]
    runs: tuple[str, ...]
    torques_nm: Array
    measured_rpm: Array
    fold_rpm: Array
    condition: float
    late_rpm: Array
    others: tuple[tuple[float, float, float], ...]
    curves: tuple[Array, ...]

    @property
    def misfit_rpm(self) -> float:
        """Root mean square of what the folds are off the jumps."""
        return float(np.sqrt(np.mean((self.fold_rpm - self.measured_rpm) ** 2)))

    def __repr__(self) -> str:
        """One line: the answer with its intervals, or why there is none."""
        if self.status in (IdentificationStatus.NO_FIT, IdentificationStatus.NO_FOLD):
            return f"Identification {self.status}: {self.status.remedy}"
        (a, b), (c, d) = self.damping_interval, self.error_interval
        return (
            f"Identification {self.status}: damping ratio {self.damping_ratio:.5g} ({a:.4g} to {b:.4g}), "
            f"transmission error {self.transmission_error_um:.5g} um ({c:.4g} to {d:.4g}), "
            f"phase {self.error_phase_rad:.4g} rad; {len(self.runs)} jumps, misfit {self.misfit_rpm:.2g} rpm"
        )


class Seen(NamedTuple):
    """A jump that the rig showed."""

    run: str
    torque_nm: float
    speed_rpm: float


class Trial(NamedTuple):
    """A point of the search: what is sought, and the folds there."""

    unknowns: Array  # logarithms of damping ratio and error (um), and the phase if it is free
    folds: list[Bifurcation]
    speeds: Array  # rpm


@checked
def identify(
    drive: GearDrive,
    jump_up_rpm: float | Sequence[float],
    jump_down_rpm: float | Sequence[float],
    *,
    torques_nm: Sequence[float] | None = None,
    free_phase: bool = False,
    speed_error_rpm: float = 1.0,
    ramp_rpm_per_s: float | None = None,
    damping_ratios: tuple[float, float] = (0.005, 0.2),
    errors_um: tuple[float, float] | None = None,
    progress: bool = False,
) -> Identification:
    """The damping ratio and the error for which a drive's folds lie where a test rig was seen to jump.

    Parameters
    ----------
    drive : GearDrive
        The rig. Its damping and the size of its error are not used; harmonics of the error keep their shares, a
        relief stays.
    jump_up_rpm, jump_down_rpm : float or sequence of float
        Speeds of the pinion at which it left its motion when run up and when run down; nan where it was not seen. One
        of each for each torque.
    torques_nm : sequence of float, optional
        Torques of the pinion; that of `drive` when not given. With more speeds than unknowns least squares decide.
    free_phase : bool
        Whether to find the phase of the error as well, which takes three jumps; otherwise it is that of `drive`.
    speed_error_rpm : float
        Standard uncertainty of every speed; of a run in steps, the step over the root of 12. The intervals follow.
    ramp_rpm_per_s : float, optional
        How fast the rig's speed rose and fell. Given, runs of that ramp tell how late it jumped (`late_rpm`), and a
        warning if that is more than `speed_error_rpm`.
    damping_ratios, errors_um : tuple of float
        What is looked through for a start, above 0; the answer may lie beyond. Errors when not given: from a
        thirtieth to three times the static deflection under the largest torque.
    progress : bool
        Show a progress bar on stderr.

    Returns
    -------
    Identification
        Look at its `status` first.

    Notes
    -----
    A run up and one down at each of 120 pairs of damping and error show where the drive has two motions; where these
    ranges come nearest to the measured speeds, the folds are located by continuation, and then moved on to the speeds:
    Newton's method on the logarithms, by Gauss and Newton's where there are more speeds, with the exact shift of a
    fold, see `gearpair.bifurcations.fold_shift`. An answer counts if a run meets its folds.

    The intervals are linear in the logarithms, ``exp(+-1.96 s)``, from ``(J' J)^-1`` and `speed_error_rpm`. What the
    model leaves out is not in them. Jumps at which a motion doubles its period or ends otherwise are no folds.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.3)], damping_ratio=0.03)
    >>> found = identify(drive, 8598.25, 7345.0)
    >>> str(found.status), round(found.damping_ratio, 4), round(found.transmission_error_um, 3)
    ('found', 0.05, 2.0)
    """
    seen = _check_jumps(drive, jump_up_rpm, jump_down_rpm, torques_nm)
    speed_error = check_number("speed_error_rpm", speed_error_rpm, above=0.0)
    if ramp_rpm_per_s is not None:
        ramp_rpm_per_s = check_number("ramp_rpm_per_s", ramp_rpm_per_s, above=0.0)
    if drive.error_phase_rad is None and not free_phase:
        raise ValueError("drive must have an error_phase_rad, as drive.at_phase gives it, or free_phase must be True")
    grid = [_check_range("damping_ratios", damping_ratios)]
    grid += [_default_errors(drive, seen) if errors_um is None else _check_range("errors_um", errors_um)]
    rig = Rig(drive if drive.error_phase_rad is not None else drive.at_phase(0.0), tuple(seen), free_phase)
    found: list[Trial] = []
    jumped = False
    for start in tqdm(list(rig.starts(*grid, progress=progress)), "starts", unit="start", disable=not progress):
        folds = rig.folds_near(start)
        if folds is None:
            continue
        jumped = True
        trial = rig.solved(Trial(start, folds, rig.rpm(folds)))
        if trial is not None and rig.met(trial) and not any(_alike(trial, each) for each in found):
            found.append(trial)
    found = [each for each in found if rig.fits(each, speed_error)]
    found.sort(key=lambda each: round(rig.misfit(each), 9))
    if not found:
        return _nothing(rig, IdentificationStatus.NO_FIT if jumped else IdentificationStatus.NO_FOLD)
    return _described(rig, found, speed_error, ramp_rpm_per_s)


def _check_range(name: str, reach: tuple[float, float]) -> Array:
    """The ends of a range above 0."""
    low, high = check_reach(name, reach)
    check_number(f"{name}[0]", low, above=0.0)
    return np.array([low, high])


def _default_errors(drive: GearDrive, seen: list[Seen]) -> Array:
    most = max(abs(each.torque_nm) for each in seen)
    deflection = most / (drive.pinion_base_radius_mm * 1e-3) / drive.mean_stiffness_n_per_um
    return np.array([deflection / 30.0, 3.0 * deflection])


def _check_jumps(
    drive: GearDrive, up: ArrayLike, down: ArrayLike, torques_nm: Sequence[float] | None
) -> list[Seen]:
    """The jumps that were seen, or a ValueError."""
    torques = np.atleast_1d(check_array("torques_nm", [drive.pinion_torque_nm] if torques_nm is None else torques_nm))
    jumps = []
    for run, given in (("up", up), ("down", down)):
        speeds = np.atleast_1d(check_array(f"jump_{run}_rpm", given, finite=False))
        if speeds.shape != torques.shape or torques.ndim != 1:
            raise ValueError(f"jump_{run}_rpm must have one speed for each of {len(torques)} torques, got {given!r}")
        for torque, speed in zip(torques.tolist(), speeds.tolist(), strict=True):
            if not np.isnan(speed):
                jumps.append(Seen(run, torque, check_number(f"jump_{run}_rpm", speed, above=0.0)))
    if not jumps:
        raise ValueError("jump_up_rpm and jump_down_rpm must have a speed that was seen, got nan alone")
    if 0.0 in torques:
        raise ValueError("torques_nm must not be 0: without a mean force nothing holds the teeth together")
    return jumps


@dataclass(frozen=True)
class Rig:
    """A drive whose damping, error and perhaps phase are sought, and the jumps that it showed."""

    drive: GearDrive
    seen: tuple[Seen, ...]
    free_phase: bool

    def at(self, unknowns: Array, torque_nm: float | None = None) -> GearDrive:
        """The drive at a point of the search."""
        changes = {} if torque_nm is None else {"pinion_torque_nm": torque_nm}
        damping, error = np.exp(unknowns[:2]).tolist()
        changed = self.drive.replace(**changes, damping_ratio=damping, transmission_error_um=error)
        return changed.at_phase(float(unknowns[2]) if self.free_phase else self.drive.error_phase_rad)

    def oscillator(self, unknowns: Array, jump: Seen) -> Oscillator:
        """The oscillator at a point of the search, under the torque and at the speed of a jump."""
        return self.at(unknowns, jump.torque_nm).at_speed(jump.speed_rpm).oscillator()

    def rpm(self, folds: Sequence[Bifurcation]) -> Array:
        """Where folds lie; a relieved pair's stiffness, and with it the unit of speed, follows the torque."""
        unit = {torque: self.drive.replace(pinion_torque_nm=torque).resonance_rpm for torque in self.torques}
        return np.array([fold.value * unit[each.torque_nm] for fold, each in zip(folds, self.seen, strict=True)])

    @property
    def torques(self) -> list[float]:
        """Each once."""
        return list(dict.fromkeys(each.torque_nm for each in self.seen))

    @property
    def measured(self) -> Array:
        """The speeds of the jumps (rpm)."""
        return np.array([each.speed_rpm for each in self.seen])

    def speeds(self, torque_nm: float) -> Array:
        """What is run up and down at one torque: finer where both jumps lie close."""
        own = [each.speed_rpm for each in self.seen if each.torque_nm == torque_nm]
        low, high = min(own), max(own)
        step = np.clip((high - low) / low / 6.0, FINEST, COARSEST) if high > low else COARSEST
        return np.geomspace(low * (1.0 - MARGIN), high * (1.0 + MARGIN), int(np.log(high / low + 0.25) / step) + 24)

    def starts(self, damping: Array, error: Array, *, progress: bool) -> Iterator[Array]:
        """Where the ranges with two motions come nearest to the jumps, the nearest first."""
        from scipy.ndimage import minimum_filter  # here, so that importing gearpair stays quick

        axes = [np.linspace(*np.log(damping), N_DAMPING), np.linspace(*np.log(error), N_ERROR)]
        if self.free_phase:
            axes.append(2.0 * np.pi * np.arange(N_PHASES) / N_PHASES)
        points = [np.array(each) for each in product(*axes)]
        apart = np.zeros(len(points))
        for torque in self.torques:
            apart += self._apart(points, torque, progress=progress)
        shape = tuple(map(len, axes))
        around = minimum_filter(apart.reshape(shape), 3, mode=("nearest", "nearest", "wrap")[: len(shape)])
        lowest = np.flatnonzero((apart == around.ravel()) & np.isfinite(apart))
        for i in lowest[np.argsort(apart[lowest], kind="stable")][:N_STARTS].tolist():
            yield points[i]

    def _apart(self, points: list[Array], torque_nm: float, *, progress: bool) -> Array:
        """How far, relative to the speeds, the ends of the ranges with two motions are from the jumps at one torque."""
        speeds = self.speeds(torque_nm)
        oscillators = [osc for each in points for osc in oscillators_at(self.at(each, torque_nm), speeds)]
        starts = np.array([(drive_side(osc) + osc.mean_force / osc.stiffness.mean, 0.0) for osc in oscillators])
        settings = CHART.having({"n_watch": 0, "n_exponent": 20}, n_samples=1)
        both = settle_both_ways(oscillators, starts, settings, chain=len(speeds), progress=progress)
        two = ~same_motions(*map(settled_columns, both)).reshape(len(points), -1)
        ends = np.diff(two.astype(int), axis=1, prepend=0, append=0)
        apart = np.zeros(len(points))
        middles = np.concatenate([speeds[:1], np.sqrt(speeds[1:] * speeds[:-1]), speeds[-1:]])
        for jump in (each for each in self.seen if each.torque_nm == torque_nm):
            off = np.abs(np.log(middles / jump.speed_rpm))
            apart += np.where(ends == (-1 if jump.run == "up" else 1), off, np.inf).min(axis=1)
        return apart

    def folds_near(self, unknowns: Array) -> list[Bifurcation] | None:
        """The folds that runs meet, for each jump the nearest; None where one has none."""
        folds: dict[Seen, Bifurcation] = {}
        for torque in self.torques:
            trial = self.at(unknowns, torque)
            [runs] = carried_runs([oscillators_at(trial, self.speeds(torque))], None)
            jumps = [each for each in find_jumps(*runs) if each.bifurcation and each.kind == "fold"]
            for seen in (each for each in self.seen if each.torque_nm == torque):
                at = seen.speed_rpm / trial.resonance_rpm
                own = [each for each in jumps if each.run == seen.run]
                nearest = min(own, key=lambda jump: abs(jump.mesh_frequency - at), default=None)
                if nearest is None or nearest.bifurcation is None:
                    return None
                folds[seen] = nearest.bifurcation
        return [folds[seen] for seen in self.seen]

    def met(self, trial: Trial) -> bool:
        """Whether runs meet the folds that were found."""
        folds = self.folds_near(trial.unknowns)
        return folds is not None and bool(np.all(np.abs(self.rpm(folds) / trial.speeds - 1.0) < FITS))

    def moved(self, trial: Trial, unknowns: Array) -> Trial | None:
        """The folds at another point of the search."""
        if not np.all(np.abs(unknowns) < 100.0):
            return None
        folds = []
        for seen, fold in zip(self.seen, trial.folds, strict=True):
            there = move_bifurcation(fold, self.oscillator(unknowns, seen))
            if there is None:
                return None
            folds.append(there)
        return Trial(unknowns, folds, self.rpm(folds))

    def slopes(self, trial: Trial) -> Array:
        """The derivative of the speeds' logarithms by what is sought, shape (jumps, unknowns)."""
        rows = []
        for seen, fold in zip(self.seen, trial.folds, strict=True):
            shifts = [
                fold_shift(fold, *(self.oscillator(trial.unknowns + side * SLOPE * each, seen) for side in (-1.0, 1.0)))
                for each in np.eye(len(trial.unknowns))
            ]
            rows.append(np.array(shifts) / (2.0 * SLOPE * fold.value))
        return np.array(rows)

    def solved(self, trial: Trial) -> Trial | None:
        """Where the folds come nearest to the jumps, by Gauss and Newton's method from a point of the search."""
        for _ in range(STEPS):
            change = -np.linalg.lstsq(self.slopes(trial), np.log(trial.speeds / self.measured), rcond=1e-9)[0]
            change *= min(1.0, LARGEST / max(float(np.abs(change).max()), 1e-300))
            for _ in range(HALVINGS):
                there = self.moved(trial, trial.unknowns + change)
                if there is not None:
                    break
                change = 0.5 * change
            else:
                return None
            trial = there
            if np.abs(change).max() < CLOSE:
                return trial
        return trial if np.abs(change).max() < FITS else None

    def misfit(self, trial: Trial) -> float:
        """Root mean square of what the folds are off (rpm)."""
        return float(np.sqrt(np.mean((trial.speeds - self.measured) ** 2)))

    def fits(self, trial: Trial, speed_error: float) -> bool:
        """Whether the folds lie at the jumps: exactly where there are no more of these than unknowns."""
        return len(self.seen) > len(trial.unknowns) or bool(
            np.all(np.abs(trial.speeds - self.measured) < max(speed_error, FITS * self.measured.max()))
        )

    def curve(self, trial: Trial, i: int) -> Array:
        """Damping ratios and errors with the fold of jump `i` at its speed, both ways from a point of the search."""
        one = Rig(self.drive.at_phase(self.phase_of(trial.unknowns)), self.seen[i : i + 1], False)
        begun = one.solved(Trial(trial.unknowns[:2], trial.folds[i : i + 1], trial.speeds[i : i + 1]))
        if begun is None:
            return np.empty((0, 2))
        halves = []
        for sense in (1.0, -1.0):
            here, along, half = begun, np.array([sense, 0.0]), [np.exp(begun.unknowns)]
            for _ in range(CURVE_STEPS):
                normal = one.slopes(here)[0]
                turned = np.array([-normal[1], normal[0]]) / np.hypot(*normal)
                along = turned if turned @ along >= 0.0 else -turned
                ahead = one.moved(here, here.unknowns + CURVE_STEP * along)
                there = None if ahead is None else one.solved(ahead)
                if there is None or np.abs(there.unknowns - here.unknowns).max() > 3.0 * CURVE_STEP:
                    break
                here = there
                half.append(np.exp(here.unknowns))
            halves.append(np.array(half))
        return np.concatenate([halves[1][:0:-1], halves[0]])

    def phase_of(self, unknowns: Array) -> float:
        """The phase at a point of the search, in [0, 2 pi)."""
        return float(unknowns[2] if self.free_phase else self.drive.error_phase_rad) % (2.0 * np.pi)


def _alike(a: Trial, b: Trial) -> bool:
    """Whether two searches ended at one point, phases by their place on the circle."""
    apart = a.unknowns - b.unknowns
    apart[2:] = np.remainder(apart[2:] + np.pi, 2.0 * np.pi) - np.pi
    return bool(np.abs(apart).max() < 1e-6)


def _nothing(rig: Rig, status: IdentificationStatus) -> Identification:
    """The answer that there is none."""
    blank, missing = np.full(len(rig.seen), np.nan), (np.nan, np.nan)
    return Identification(
        drive=rig.drive,
        status=status,
        damping_ratio=np.nan,
        transmission_error_um=np.nan,
        error_phase_rad=np.nan,
        damping_interval=missing,
        error_interval=missing,
        phase_interval=missing,
        runs=tuple(each.run for each in rig.seen),
        torques_nm=np.array([each.torque_nm for each in rig.seen]),
        measured_rpm=rig.measured,
        fold_rpm=blank,
        condition=np.nan,
        late_rpm=blank,
        others=(),
        curves=(),
    )


def _described(rig: Rig, found: list[Trial], speed_error: float, ramp: float | None) -> Identification:
    """The answer in words and numbers, from the best of the points found."""
    best = found[0]
    slopes = rig.slopes(best)
    n, (_, sizes, turned) = len(best.unknowns), np.linalg.svd(slopes)
    sizes = np.concatenate([sizes, np.zeros(n - len(sizes))])
    relative = speed_error / float(np.mean(rig.measured))
    with np.errstate(divide="ignore", invalid="ignore"):
        spread = np.sqrt(np.nansum((turned.T / sizes) ** 2, axis=1)) * relative * HALF_WIDTH
        condition = float(sizes[0] / sizes[-1])
    damping, error = np.exp(best.unknowns[:2]).tolist()
    intervals = [tuple(np.exp(best.unknowns[k] + spread[k] * np.array([-1.0, 1.0])).tolist()) for k in range(2)]
    phase, around = rig.phase_of(best.unknowns), float(spread[2]) if rig.free_phase else 0.0
    vague = bool(np.any(spread > VAGUE))
    answer = rig.at(best.unknowns)
    late = np.full(len(rig.seen), np.nan)
    if ramp is not None:
        late = np.array([
            lateness(rig.at(best.unknowns, seen.torque_nm), fold, seen.run, ramp)
            for seen, fold in zip(rig.seen, best.folds, strict=True)
        ])  # fmt: skip
        if np.any(late > speed_error):
            warn(
                f"a ramp of {ramp:g} rpm/s is too fast for steady folds: it jumps up to {late.max():.3g} rpm late, "
                f"more than speed_error_rpm = {speed_error:g}; take late_rpm off the speeds, or ramp slower",
                stacklevel=4,
            )
    return replace(
        _nothing(rig, IdentificationStatus.UNDETERMINED if vague else IdentificationStatus.FOUND),
        drive=answer,
        damping_ratio=damping,
        transmission_error_um=error,
        error_phase_rad=phase,
        damping_interval=intervals[0],
        error_interval=intervals[1],
        phase_interval=(phase - around, phase + around),
        fold_rpm=best.speeds,
        condition=condition,
        late_rpm=late,
        others=tuple(
            (*np.exp(each.unknowns[:2]).tolist(), rig.phase_of(each.unknowns))
            for each in found[1:]
            if rig.misfit(each) <= rig.misfit(best) + speed_error
        ),
        curves=tuple(rig.curve(best, i) for i in range(len(rig.seen))),
    )
