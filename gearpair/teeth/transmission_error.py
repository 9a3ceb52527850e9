"""The static transmission error of a pair: from a relief drawn over the path of contact, or measured, to harmonics."""

from __future__ import annotations

from dataclasses import dataclass
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_count, check_fields, check_number, checked
from gearpair.harmonics import LARGEST_ORDER, Harmonic, ShaftOrder
from gearpair.teeth.meshing import MeshStiffness

Array = NDArray[np.float64]


@checked
def tip_relief(mesh: MeshStiffness, pinion_um: float, gear_um: float, length: float) -> Array:
    """What linear reliefs of both tips take off a pair of teeth along its path of contact.

    Parameters
    ----------
    mesh : MeshStiffness
    pinion_um, gear_um : float
        Taken off normal to the flank at the tip, in micrometres, at least 0. The gear's tip is in contact at the
        start of the path, the pinion's at its end.
    length : float
        From the tip to where the relief begins, along the line of action in base pitches; at most the contact
        ratio.

    Returns
    -------
    ndarray, shape of ``mesh.path``
        Micrometres, at least 0.

    Examples
    --------
    >>> from gearpair.teeth.meshing import mesh_stiffness
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> relief = tip_relief(mesh_stiffness(SpurPair()), 20.0, 10.0, 0.4)
    >>> round(float(relief[0]), 6), round(float(relief[-1]), 6), float(relief.min())
    (10.0, 20.0, 0.0)
    """
    pinion_um = check_number("pinion_um", pinion_um, at_least=0.0)
    gear_um = check_number("gear_um", gear_um, at_least=0.0)
    length = check_number("length", length, above=0.0, at_most=mesh.contact_ratio)
    start = np.clip(1.0 - mesh.path / length, 0.0, None)
    end = np.clip(1.0 - (mesh.contact_ratio - mesh.path) / length, 0.0, None)
    return np.asarray(gear_um * start + pinion_um * end)


@dataclass(frozen=True)
class TipRelief:
    """Linear reliefs of both tips, as they stand on a drawing.

    Parameters
    ----------
    pinion_um, gear_um, length : float
        As in `tip_relief`.

    Examples
    --------
    >>> from gearpair.teeth.meshing import mesh_stiffness
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> float(TipRelief(20.0, 10.0, 0.4).deviation_um(mesh_stiffness(SpurPair())).max())
    20.0
    """

    pinion_um: float
    gear_um: float
    length: float

    def __post_init__(self) -> None:
        check_fields(self, pinion_um={"at_least": 0.0}, gear_um={"at_least": 0.0}, length={"above": 0.0})

    def deviation_um(self, mesh: MeshStiffness) -> Array:
        """What it takes off a pair of teeth along ``mesh.path``, by `tip_relief`."""
        return tip_relief(mesh, self.pinion_um, self.gear_um, self.length)


@checked
def pair_deviations(mesh: MeshStiffness, deviation_um: ArrayLike) -> Array:
    """The deviation of each pair of teeth over a mesh period, all pairs deviating alike.

    Parameters
    ----------
    mesh : MeshStiffness
    deviation_um : array_like, shape of ``mesh.path``
        Material missing along the path of contact of one pair, both flanks together, in micrometres.

    Returns
    -------
    ndarray, shape of ``mesh.load_share``
        Micrometres; infinite where the pair is off its path.

    Examples
    --------
    >>> from gearpair.teeth.meshing import mesh_stiffness
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> mesh = mesh_stiffness(SpurPair(), n_phases=4)
    >>> pair_deviations(mesh, 2.0 * mesh.path)
    array([[0. , 0.5, 1. , 1.5],
           [2. , 2.5, 3. , inf]])
    """
    deviation = check_array("deviation_um", deviation_um)
    if deviation.shape != mesh.path.shape:
        raise ValueError(
            f"deviation_um must be finite numbers over the path of contact, shape {mesh.path.shape}, "
            f"got shape {deviation.shape}"
        )
    positions = mesh.phase + np.arange(len(mesh.load_share))[:, None]
    return np.where(mesh.load_share > 0.0, np.interp(positions, mesh.path, deviation), np.inf)


@checked
def full_contact_force(mesh: MeshStiffness, deviation_um: ArrayLike) -> float:
    """The least force in newtons at which every pair of teeth carries as long as it is on its path.

    Parameters
    ----------
    mesh, deviation_um
        As in `pair_deviations`.

    Notes
    -----
    With the compliance matrix C of the pairs, their stiffness k together, deviations d and load shares s, all pairs
    carry ``F = s (W + k e) - inverse(C) d`` with ``k e = sum of inverse(C) d``. The least W is the one at which the
    first of them carries nothing.

    Examples
    --------
    >>> from gearpair.teeth.meshing import mesh_stiffness
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> mesh = mesh_stiffness(SpurPair())
    >>> one, two = (full_contact_force(mesh, tip_relief(mesh, um, um, 0.4)) for um in (5.0, 10.0))
    >>> round(two / one, 9)
    2.0
    """
    each, least = pair_deviations(mesh, deviation_um) * 1e-6, 0.0
    for count in np.unique(mesh.pairs_in_contact).tolist():
        inside = mesh.pairs_in_contact == count
        joint = mesh.joint_compliance_m_per_n[inside, :count, :count]
        held = np.linalg.solve(joint, each[:count, inside].T[..., None])[..., 0].T
        least = max(least, float(np.max(held / mesh.load_share[:count, inside] - held.sum(axis=0))))
    return least


@checked
def profile_error(
    mesh: MeshStiffness, deviation_um: ArrayLike, *, loaded: bool = True, force_n: float | None = None
) -> Array:
    """The static transmission error over a mesh period of teeth that all deviate from the involute alike.

    Parameters
    ----------
    mesh, deviation_um
        As in `pair_deviations`.
    loaded : bool
        Under enough load for every pair on its path to carry; or by the first pair that touches. In between see
        `gearpair.teeth.loaded_mesh`.
    force_n : float, optional
        The load in newtons, to be checked against `full_contact_force`.

    Returns
    -------
    ndarray, shape of ``mesh.phase``
        Micrometres, positive where the pinion has to turn further.

    Raises
    ------
    ValueError
        If at `force_n` a pair would have to pull. Where no force is given a warning says from which on none has to.

    Notes
    -----
    Pairs of stiffness k_i and deviation d_i that all carry approach by D with ``sum of k_i (D - d_i) = W``, so that
    ``W = k (D - e)`` with k the sum and ``e = sum of k_i d_i / k``: the mean of the deviations, weighted by the load
    shares. Without load e is the least deviation of the pairs on their paths.

    Examples
    --------
    >>> from gearpair.teeth.meshing import mesh_stiffness
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> mesh = mesh_stiffness(SpurPair())
    >>> error = profile_error(mesh, tip_relief(mesh, 20.0, 20.0, 0.4), force_n=10e3)
    >>> round(float(error.min()), 6), round(float(error.max()), 1)
    (0.0, 8.4)
    """
    each = pair_deviations(mesh, deviation_um)
    if not loaded:
        return np.asarray(each.min(axis=0))
    least = full_contact_force(mesh, deviation_um)
    if force_n is not None and check_number("force_n", force_n, at_least=0.0) < least * (1.0 - 1e-9):
        raise ValueError(
            f"force_n must be at least {least:.6g} for every pair of teeth to carry, got {force_n}: below it a pair "
            "would have to pull, and gearpair.teeth.loaded_mesh has the error"
        )
    if force_n is None and least > 0.0:
        warn(
            f"this error holds from {least:.4g} N on; with less a pair of teeth would have to pull: give force_n, or "
            "take gearpair.teeth.loaded_mesh",
            stacklevel=3,
        )
    return np.asarray(np.sum(mesh.load_share * np.where(np.isfinite(each), each, 0.0), axis=0))


@checked
def error_harmonics(error_um: ArrayLike, n: int, *, n_periods: int = 1) -> tuple[Harmonic, ...]:
    """The harmonics of a transmission error, computed or measured.

    Parameters
    ----------
    error_um : array_like, shape (m,)
        Samples at equal steps over `n_periods` mesh periods, the first at a start of one, the end point left out.
    n : int
        The highest order, below ``m / (2 n_periods)``.
    n_periods : int
        Mesh periods that the samples cover; what does not repeat with the mesh period averages out.

    Returns
    -------
    tuple of Harmonic
        Orders 1 to n: amplitude in the samples' unit, phase of ``amplitude sin(order theta + phase)``. The mean is left
        out: it moves the teeth and excites nothing.

    Examples
    --------
    >>> theta = 2 * np.pi * np.arange(64) / 64
    >>> first, second = error_harmonics(3.0 + 8.0 * np.sin(theta + 0.5) + 2.0 * np.cos(2 * theta), 2)
    >>> round(first.amplitude, 9), round(first.phase, 9), round(second.amplitude, 9), round(second.phase, 4)
    (8.0, 0.5, 2.0, 1.5708)
    """
    samples = check_array("error_um", error_um)
    n, n_periods = check_count("n", n), check_count("n_periods", n_periods)
    if samples.ndim != 1 or not np.all(np.isfinite(samples)):
        raise ValueError(f"error_um must be a sequence of finite numbers, got shape {samples.shape}")
    if len(samples) <= 2 * n * n_periods:
        raise ValueError(
            f"error_um must be more than {2 * n * n_periods} samples for {n} harmonics, got {len(samples)}"
        )
    parts = 2.0 * np.fft.rfft(samples)[: n * n_periods + 1 : n_periods][1:] / len(samples)
    return tuple(
        Harmonic(order, float(np.abs(part)), float(np.angle(1j * part))) for order, part in enumerate(parts, start=1)
    )


@checked
def error_orders(
    error_um: ArrayLike, teeth: int, *, least_um: float = 0.0, most: int | None = None
) -> tuple[tuple[Harmonic, ...], tuple[ShaftOrder, ...]]:
    """All of a transmission error measured over one revolution: what repeats with the mesh, and what with the wheel.

    Parameters
    ----------
    error_um : array_like, shape (m,)
        Samples at equal steps over one revolution, the first at a start of a mesh period, the end point left out.
    teeth : int
        Of the wheel that turns once.
    least_um : float
        Smaller amplitudes are left out, as noise.
    most : int, optional
        How many lines are kept at most, the largest.

    Returns
    -------
    harmonics : tuple of Harmonic
        Of orders from 1, as `GearDrive.from_pair` takes them for `transmission_error_um`.
    shaft_orders : tuple of ShaftOrder
        As `GearDrive` takes them. Both by order; amplitudes in the samples' unit. The mean is left out.

    Notes
    -----
    The samples' Fourier series, whole: with all lines it passes through every sample. Up to half as many lines as there
    are samples are found, and none above 200 times the mesh frequency. A line that is no multiple of the mesh frequency
    makes the base period of an oscillator a revolution.

    Examples
    --------
    >>> turn = 2 * np.pi * np.arange(20 * 16) / (20 * 16)
    >>> harmonics, shaft_orders = error_orders(8.0 * np.sin(20 * turn + 0.5) + 3.0 * np.sin(turn), 20, least_um=1e-9)
    >>> [(each.order, round(each.amplitude, 9)) for each in harmonics]
    [(1, 8.0)]
    >>> [(each.teeth, each.order, round(each.amplitude, 9), abs(round(each.phase, 9))) for each in shaft_orders]
    [(20, 1, 3.0, 0.0)]
    """
    samples, teeth = check_array("error_um", error_um, ndim=1), check_count("teeth", teeth)
    least_um = check_number("least_um", least_um, at_least=0.0)
    parts = 2.0 * np.fft.rfft(samples)[: min((len(samples) + 1) // 2, LARGEST_ORDER * teeth + 1)] / len(samples)
    size = np.abs(parts)
    largest = 1 + np.argsort(-size[1:], kind="stable")[: None if most is None else check_count("most", most)]
    harmonics, orders = [], []
    for line in np.sort(largest).tolist():
        amplitude, phase = float(size[line]), float(np.angle(1j * parts[line]))
        if amplitude > 0.0 and amplitude >= least_um:
            if line % teeth:
                orders.append(ShaftOrder(teeth, amplitude, phase, line))
            else:
                harmonics.append(Harmonic(line // teeth, amplitude, phase))
    return tuple(harmonics), tuple(orders)
