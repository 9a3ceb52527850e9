"""A mesh under its load: pairs of teeth that push and never pull, each with the gap that its deviation leaves."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_count, check_number, checked
from gearpair._equality import equal_by_value
from gearpair.stiffness import StiffnessWave
from gearpair.teeth.meshing import MeshStiffness
from gearpair.teeth.transmission_error import pair_deviations

Array = NDArray[np.float64]


@equal_by_value
@dataclass(frozen=True)
class LoadedMesh:
    """The static balance of a mesh at one force, over the mesh period; made by `loaded_mesh`.

    Parameters
    ----------
    mesh : MeshStiffness
        Of the same teeth without deviation.
    deviation_um : ndarray, shape of ``mesh.path``
        Material missing along the path of contact of one pair, in micrometres.
    force_n : float
        The force along the line of action, in N.
    approach_um : ndarray, shape of ``mesh.phase``
        How far the pinion has to turn, along the line of action in micrometres: the loaded static transmission error.
    stiffness_n_per_m : ndarray, shape of ``mesh.phase``
        Of the pairs that carry, in N/m: the rate of the force with the approach.
    load_share : ndarray, shape of ``mesh.load_share``
        Fraction of the force on each pair (dimensionless), 0 where it carries nothing.
    """

    mesh: MeshStiffness
    deviation_um: Array
    force_n: float
    approach_um: Array
    stiffness_n_per_m: Array
    load_share: Array

    @property
    def error_um(self) -> Array:
        """The error about the stiffness, ``force = stiffness (approach - error)``, in micrometres: a drive's e(t)."""
        return np.asarray(self.approach_um - self.force_n / self.stiffness_n_per_m * 1e6)

    @property
    def mean(self) -> float:
        """Mean stiffness over the mesh period in N/m, of the samples: k_m of the article."""
        return float(self._sums()[-1])

    def wave(self, n_levels: int) -> StiffnessWave:
        """The stiffness as a staircase of mean 1, for `Oscillator(stiffness=...)`.

        Parameters
        ----------
        n_levels : int
            Number of levels, at least one for each stretch of the period over which the same pairs carry. The rest of
            them goes to the stretches by their length; the curve's jumps stay where they are, to half a sample.

        Returns
        -------
        StiffnessWave
            Each level is the curve's mean over its interval, over the mean of the period (dimensionless).

        Examples
        --------
        >>> from gearpair.teeth.meshing import mesh_stiffness
        >>> from gearpair.teeth.spurpair import SpurPair
        >>> mesh = mesh_stiffness(SpurPair())
        >>> wave = loaded_mesh(mesh, np.zeros_like(mesh.path), 1000.0).wave(16)
        >>> len(wave.levels), round(wave.mean, 12)
        (16, 1.0)
        """
        carries = self.load_share > 0.0
        changes = np.flatnonzero(np.any(carries[:, 1:] != carries[:, :-1], axis=0)) + 1
        ends = np.concatenate([[0.0], self._ends()[changes], [1.0]])
        n_levels = check_count("n_levels", n_levels, at_least=len(ends) - 1)
        counts = np.diff(np.round(ends * (n_levels - len(ends) + 1)).astype(int)) + 1
        pieces = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(ends, ends[1:], counts, strict=False)]
        edges = np.concatenate([*pieces, [1.0]])
        levels = np.diff(np.interp(edges, self._ends(), self._sums())) / np.diff(edges) / self.mean
        return StiffnessWave(tuple(edges[:-1].tolist()), tuple(levels.tolist()))

    def _ends(self) -> Array:
        """Where the stretch of each sample begins, midway to the one before, and 1: shape (n + 1,)."""
        middles = (self.mesh.phase[1:] + self.mesh.phase[:-1]) / 2.0
        return np.concatenate([[0.0], middles, [1.0]])

    def _sums(self) -> Array:
        """Integral of the stiffness up to each of `_ends`, in N/m."""
        return np.concatenate([[0.0], np.cumsum(self.stiffness_n_per_m * np.diff(self._ends()))])


@checked
def loaded_mesh(mesh: MeshStiffness, deviation_um: ArrayLike, force_n: float) -> LoadedMesh:
    """The static balance of a mesh whose pairs of teeth push only.

    Parameters
    ----------
    mesh : MeshStiffness
    deviation_um : array_like, shape of ``mesh.path``
        Material missing along the path of contact of one pair, both flanks together, in micrometres; as of
        `tip_relief`.
    force_n : float
        The force along the line of action, at least 0, in N.

    Returns
    -------
    LoadedMesh

    Notes
    -----
    Pairs with the forces F, the deviations d and the compliance matrix C (diagonal where the pairs share no body)
    approach by D::

        F >= 0,    d + C F - D >= 0,    one of both zero for each pair,    sum of F = W

    This linear complementarity problem has one solution, C being positive definite. It is found among all sets of pairs
    that may carry, of which two pairs make three and four make fifteen, and without iteration. Contact off the path is
    left out. At zero force the pair that touches first carries, and pairs that touch at once share as under a small
    force.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair, mesh_stiffness, tip_relief
    >>> mesh = mesh_stiffness(SpurPair())
    >>> relief = tip_relief(mesh, 20.0, 20.0, 0.4)
    >>> light, heavy = (loaded_mesh(mesh, relief, force) for force in (500.0, 20e3))
    >>> [float((each.load_share[0, :20] > 0.0).mean()) for each in (light, heavy)]  # the pair that enters
    [0.0, 1.0]
    """
    force_n = check_number("force_n", force_n, at_least=0.0)
    gaps = pair_deviations(mesh, deviation_um).T * 1e-6
    joint = mesh.joint_compliance_m_per_n
    if force_n > 0.0:
        forces, approach, stiffness = _balance(joint, gaps, force_n)
    else:
        approach = gaps.min(axis=1)
        forces, _, stiffness = _balance(joint, np.where(gaps == approach[:, None], 0.0, np.inf), 1.0)
    return LoadedMesh(
        mesh=mesh,
        deviation_um=check_array("deviation_um", deviation_um),
        force_n=force_n,
        approach_um=approach * 1e6,
        stiffness_n_per_m=stiffness,
        load_share=(forces / forces.sum(axis=1, keepdims=True)).T,
    )


def _balance(joint: Array, gaps: Array, force: float) -> tuple[Array, Array, Array]:
    """Forces (n, p), approach (n,) and stiffness (n,) of springs with gaps (n, p), infinite where there is none."""
    n, p = gaps.shape
    forces, approach, stiffness, wrong = np.zeros((n, p)), np.zeros(n), np.zeros(n), np.full(n, np.inf)
    for size in range(1, p + 1):
        for carrying in map(np.array, combinations(range(p), size)):
            at = np.flatnonzero(np.isfinite(gaps[:, carrying]).all(axis=1))
            gap = gaps[np.ix_(at, carrying)]
            sides = np.stack([np.ones_like(gap), gap], axis=-1)
            per_approach, held = np.moveaxis(np.linalg.solve(joint[np.ix_(at, carrying, carrying)], sides), -1, 0)
            k = per_approach.sum(axis=1)
            moved = (force + held.sum(axis=1)) / k
            found = np.zeros((len(at), p))
            found[:, carrying] = moved[:, None] * per_approach - held
            # what would have to pull, and what would overlap, both in newtons: neither where this set is the right one
            overlap = moved[:, None] - gaps[at] - np.einsum("nij,nj->ni", joint[at], found)
            overlap[:, carrying] = 0.0
            off = np.maximum(-found.min(axis=1), k * overlap.max(axis=1))
            better = off < wrong[at]
            rows = at[better]
            forces[rows], approach[rows], stiffness[rows] = found[better], moved[better], k[better]
            wrong[rows] = off[better]
    return np.maximum(forces, 0.0), approach, stiffness
