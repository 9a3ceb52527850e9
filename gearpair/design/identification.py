"""What the speeds at which a test rig jumps say of its damping and its transmission error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike, NDArray
from tqdm import tqdm

from gearpair._checks import check_array, check_number, check_reach, checked
from gearpair._equality import equal_by_value
from gearpair.design.lateness import lateness
from gearpair.design.rigs import Rig, Seen, Trial, alike
from gearpair.drive import GearDrive
from gearpair.motion.outcome import Outcome

Array = NDArray[np.float64]
HALF_WIDTH = 1.959963984540054  # of an interval of 95 %, in standard uncertainties
WIDEST = 4.0  # range of two motions, as a ratio of speeds
VAGUE = np.log(2.0)  # of the half-width of a logarithm


class IdentificationStatus(Outcome):
    """How an identification ended: a word, with a `remedy` that says what a user may do."""

    FOUND = "found", "the folds lie where the jumps were seen, and the speeds determine what was asked for"
    UNDETERMINED = (
        "undetermined",
        "the folds lie where the jumps were seen, but so they do along a whole line: to within their uncertainty the "
        "speeds leave a factor of two or more; measure at other torques, or measure the speeds more exactly",
    )
    AMBIGUOUS = (
        "ambiguous",
        "several answers fit alike, of which this is the one nearest to the drive as it was given: `others` has the "
        "rest; jumps at another torque decide",
    )
    NO_FIT = (
        "no_fit",
        "there are folds, but none were found at these speeds: check resonance_rpm of the drive against the rig, check "
        "the phase of the error (free_phase looks for it, from three jumps), or widen damping_ratios and errors_um",
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
        ``"found"``, ``"ambiguous"``, ``"undetermined"``, ``"no_fit"`` or ``"no_fold"``; ``status.remedy`` says what to
        do.
    damping_ratio, transmission_error_um, error_phase_rad : float
        Nan where none were found.
    damping_interval, error_interval, phase_interval : tuple of float
        Of 95 %; the phase's is the phase alone where it was fixed.
    runs : tuple of str, length n
        Of each jump that was seen, ``"up"`` or ``"down"``.
    torques_nm, measured_rpm, fold_rpm : ndarray of float, shape (n,)
        Of each jump: the torque, the speed at which it was seen, and at which the fold lies.
    condition : float
        Of the derivative of the speeds by what is sought, in logarithms and radians: the larger, the less the speeds
        tell both apart.
    late_rpm : ndarray of float, shape (n,)
        How far a run at the rig's ramp goes on beyond each fold before it jumps, negative where it jumps before;
        infinite where it has not jumped a fifth of the speed beyond, so that a rig would not see the jump. Nan where no
        ramp was given, or where the model has no motion beside the fold that could be told from the one before.
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
            seen = " and ".join(f"{each:.5g}" for each in self.measured_rpm)
            told = f"the jumps were seen at {seen} rpm, the drive's resonance_rpm is {self.drive.resonance_rpm:.5g}"
            return f"Identification {self.status}: {told}; {self.status.remedy}"
        (a, b), (c, d) = self.damping_interval, self.error_interval
        return (
            f"Identification {self.status}: damping ratio {self.damping_ratio:.5g} ({a:.4g} to {b:.4g}), "
            f"transmission error {self.transmission_error_um:.5g} um ({c:.4g} to {d:.4g}), "
            f"phase {self.error_phase_rad:.4g} rad; {len(self.runs)} jumps, misfit {self.misfit_rpm:.2g} rpm"
        )


@checked
def identify(
    drive: GearDrive,
    jump_up_rpm: ArrayLike,
    jump_down_rpm: ArrayLike,
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
        The rig. Its damping and the size of its error only choose between answers that fit alike; harmonics of the
        error keep their shares, a relief stays.
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
        How fast the rig's speed rose and fell. Given, runs of that ramp tell how late, or early, it jumped
        (`late_rpm`), and a warning if that is more than `speed_error_rpm`.
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
    fold, see `gearpair.bifurcations.fold_shift`. An answer counts if a run meets its folds. Of the pairs six are taken
    as starts; where none of them leads to an answer, the six next best, until one does.

    The intervals are linear in the logarithms, ``exp(+-1.96 s)``, from ``(J' J)^-1`` and `speed_error_rpm`, or the
    misfit of least squares where that is larger. What else the model leaves out is not in them. Jumps at which a motion
    doubles its period or ends otherwise are no folds.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.3)], damping_ratio=0.03)
    >>> found = identify(drive, 8598.25, 7345.0)
    >>> str(found.status), round(found.damping_ratio, 4), round(found.transmission_error_um, 3)
    ('ambiguous', 0.05, 2.0)
    """
    seen = _check_jumps(drive, jump_up_rpm, jump_down_rpm, torques_nm)
    speed_error = check_number("speed_error_rpm", speed_error_rpm, above=0.0)
    if ramp_rpm_per_s is not None:
        ramp_rpm_per_s = check_number("ramp_rpm_per_s", ramp_rpm_per_s, above=0.0)
    if drive.error_phase_rad is None and not free_phase:
        raise ValueError("drive must have an error_phase_rad, as drive.at_phase gives it, or free_phase must be True")
    damping = _check_range("damping_ratios", damping_ratios)
    error = _default_errors(drive, seen) if errors_um is None else _check_range("errors_um", errors_um)
    rig = Rig(drive if drive.error_phase_rad is not None else drive.at_phase(0.0), tuple(seen), free_phase)
    nearest, more = rig.starts(damping, error, progress=progress)
    found, jumped = _solved_from(rig, nearest, speed_error, progress=progress)
    if not found:
        found, also = _solved_from(rig, more, speed_error, enough=1, progress=progress)
        jumped = jumped or also
    if not found:
        return _nothing(rig, IdentificationStatus.NO_FIT if jumped else IdentificationStatus.NO_FOLD)
    best = min(map(rig.misfit, found))
    found = sorted((each for each in found if rig.misfit(each) <= best + speed_error), key=rig.from_drive)
    return _described(rig, found, speed_error, ramp_rpm_per_s)


def _solved_from(
    rig: Rig, starts: Sequence[Array], speed_error: float, *, enough: int | None = None, progress: bool
) -> tuple[list[Trial], bool]:
    """The answers to which starts lead, each once, no more than are `enough`; and whether there were folds at all."""
    found: list[Trial] = []
    jumped = False
    for start in tqdm(starts, "starts", unit="start", disable=not progress):
        folds = rig.folds_near(start)
        if folds is None:
            continue
        jumped = True
        trial = rig.solved(Trial(start, folds, rig.rpm(folds)))
        if trial is None or not rig.fits(trial, speed_error) or any(alike(trial, each) for each in found):
            continue
        if rig.met(trial):
            found.append(trial)
        if len(found) == enough:
            break
    return found, jumped


def _check_range(name: str, reach: tuple[float, float]) -> tuple[float, float]:
    """The ends of a range above 0."""
    low, high = check_reach(name, reach)
    check_number(f"{name}[0]", low, above=0.0)
    return low, high


def _default_errors(drive: GearDrive, seen: list[Seen]) -> tuple[float, float]:
    most = max(abs(each.torque_nm) for each in seen)
    deflection = most / (drive.pinion_base_radius_mm * 1e-3) / drive.mean_stiffness_n_per_um
    return deflection / 30.0, 3.0 * deflection


def _check_jumps(drive: GearDrive, up: ArrayLike, down: ArrayLike, torques_nm: Sequence[float] | None) -> list[Seen]:
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
    for torque in torques.tolist():
        own = [each.speed_rpm for each in jumps if each.torque_nm == torque]
        if own and max(own) > WIDEST * min(own):
            raise ValueError(
                f"jump_up_rpm and jump_down_rpm of one torque must be at most a factor of {WIDEST:g} apart, got {own}"
            )
    if 0.0 in torques:
        raise ValueError("torques_nm must not be 0: without a mean force nothing holds the teeth together")
    return jumps


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
    spare = len(rig.seen) - n
    error_rpm = max(speed_error, rig.misfit(best) * float(np.sqrt(len(rig.seen) / spare)) if spare > 0 else 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        spread = np.sqrt(np.nansum((turned.T / sizes) ** 2, axis=1)) * error_rpm * HALF_WIDTH
        condition = float(sizes[0] / sizes[-1])
    damping, error = np.exp(best.unknowns[:2]).tolist()
    intervals = [tuple(np.exp(best.unknowns[k] + spread[k] * np.array([-1.0, 1.0])).tolist()) for k in range(2)]
    phase, around = rig.phase_of(best.unknowns), float(spread[2]) if rig.free_phase else 0.0
    status = IdentificationStatus.FOUND if len(found) == 1 else IdentificationStatus.AMBIGUOUS
    if np.any(spread > VAGUE):
        status = IdentificationStatus.UNDETERMINED
    answer = rig.at(best.unknowns)
    late = np.full(len(rig.seen), np.nan)
    if ramp is not None:
        late = np.array([
            lateness(rig.at(best.unknowns, seen.torque_nm), fold, seen.run, ramp)
            for seen, fold in zip(rig.seen, best.folds, strict=True)
        ])  # fmt: skip
        most = np.nanmax(np.abs(late), initial=0.0)
        if most > speed_error:
            told = f"up to {most:.3g} rpm off" if np.isfinite(most) else "not even a fifth of the speed beyond a fold"
            remedy = "take late_rpm off the speeds, or ramp slower" if np.isfinite(most) else "ramp slower"
            warn(
                f"a ramp of {ramp:g} rpm/s is too fast for steady folds: it jumps {told}, "
                f"more than speed_error_rpm = {speed_error:g}; {remedy}",
                stacklevel=4,
            )
    return replace(
        _nothing(rig, status),
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
        others=tuple((*np.exp(each.unknowns[:2]).tolist(), rig.phase_of(each.unknowns)) for each in found[1:]),
        curves=tuple(rig.curve(best, i) for i in range(len(rig.seen))),
    )
