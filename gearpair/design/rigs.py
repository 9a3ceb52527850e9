"""A test rig that jumped at some speeds: where a drive's folds lie for any damping and error, and how to move them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearpair.bifurcations import Bifurcation, fold_shift, move_bifurcation
from gearpair.design.charts import carried_runs, drive_side, oscillators_at
from gearpair.design.jumps import find_jumps
from gearpair.drive import GearDrive
from gearpair.ensembles.datasets import settled_columns
from gearpair.motion.same_orbit import same_motions
from gearpair.motion.settling import CHART, settle_both_ways
from gearpair.oscillator import Oscillator

Array = NDArray[np.float64]
N_DAMPING, N_ERROR, N_PHASES = 10, 12, 8  # trials that look for a start
MARGIN = 0.1  # of the speeds, that a search looks beyond the jumps
FINEST, COARSEST = 0.002, 0.015  # between speeds of a search, as a share of them
N_STARTS, N_MORE = 6, 6  # of Newton's method, at most: where ranges come nearest, and where these find nothing
STEPS, LARGEST, HALVINGS = 40, 0.3, 8  # of Newton's method, in logarithms and radians
CLOSE = 1e-11
FITS = 1e-9  # relative to the speeds: a remainder that is rounding
SLOPE = 1e-5  # half the relative change over which a map is differenced
CURVE_STEP, CURVE_STEPS = 0.12, 12


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


@dataclass(frozen=True)
class Rig:
    """A drive whose damping, error and perhaps phase are sought, and the jumps that it showed."""

    drive: GearDrive
    seen: tuple[Seen, ...]
    free_phase: bool

    def at(self, unknowns: Array, torque_nm: float | None = None) -> GearDrive:
        """The drive at a point of the search."""
        changes: dict[str, Any] = {} if torque_nm is None else {"pinion_torque_nm": torque_nm}
        damping, error = np.exp(unknowns[:2]).tolist()
        changed = self.drive.replace(**changes, damping_ratio=damping, transmission_error_um=error)
        return changed.at_phase(float(unknowns[2])) if self.free_phase else changed

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

    def starts(
        self, damping: tuple[float, float], error: tuple[float, float], *, progress: bool
    ) -> tuple[list[Array], list[Array]]:
        """Where the ranges with two motions come nearest to the jumps, and the next best points, the nearest first."""
        from scipy.ndimage import minimum_filter  # here, so that importing gearpair stays quick

        axes = [np.log(np.geomspace(*each, n)) for each, n in ((damping, N_DAMPING), (error, N_ERROR))]
        if self.free_phase:
            axes.append(2.0 * np.pi * np.arange(N_PHASES) / N_PHASES)
        points = [np.array(each) for each in product(*axes)]
        apart = np.zeros(len(points))
        for torque in self.torques:
            apart += self._apart(points, torque, progress=progress)
        shape = tuple(map(len, axes))
        around = minimum_filter(apart.reshape(shape), 3, mode=("nearest", "nearest", "wrap")[: len(shape)])
        nearest = [i for i in np.argsort(apart, kind="stable").tolist() if np.isfinite(apart[i])]
        lowest = [i for i in nearest if apart[i] == around.ravel()[i]][:N_STARTS]
        return [points[i] for i in lowest], [points[i] for i in nearest if i not in lowest][:N_MORE]

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
        """The derivative of the folds' speeds (rpm) by what is sought, shape (jumps, unknowns)."""
        rows = []
        for seen, fold, speed in zip(self.seen, trial.folds, trial.speeds, strict=True):
            shifts = [
                fold_shift(fold, *(self.oscillator(trial.unknowns + side * SLOPE * each, seen) for side in (-1.0, 1.0)))
                for each in np.eye(len(trial.unknowns))
            ]
            rows.append(np.array(shifts) * speed / (2.0 * SLOPE * fold.value))
        return np.array(rows)

    def solved(self, trial: Trial) -> Trial | None:
        """Where the folds come nearest to the jumps, by Gauss and Newton's method from a point of the search."""
        for _ in range(STEPS):
            change = -np.linalg.lstsq(self.slopes(trial), trial.speeds - self.measured, rcond=1e-9)[0]
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

    def from_drive(self, trial: Trial) -> float:
        """How far an answer is from the damping and the error that the drive was given with, in logarithms."""
        given = np.array([self.drive.damping_ratio, self.drive.transmission_error_um])
        known = given > 0.0
        return float(np.abs(trial.unknowns[:2][known] - np.log(given[known])).sum())

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
        return float(unknowns[2] if self.free_phase else self.drive.error_phase_rad or 0.0) % (2.0 * np.pi)


def alike(a: Trial, b: Trial) -> bool:
    """Whether two searches ended at one point, phases by their place on the circle."""
    apart = a.unknowns - b.unknowns
    apart[2:] = np.remainder(apart[2:] + np.pi, 2.0 * np.pi) - np.pi
    return bool(np.abs(apart).max() < 1e-6)
