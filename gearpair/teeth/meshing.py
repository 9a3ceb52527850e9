"""Mesh stiffness of a spur pair over the mesh period, from its geometry."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, get_args

import numpy as np
from numpy.polynomial import Legendre
from numpy.polynomial.legendre import leggauss, legvander
from numpy.typing import NDArray

from gearpair._checks import check_choice, check_count, checked
from gearpair._equality import equal_by_value
from gearpair.stiffness import Rectangle, StiffnessWave
from gearpair.teeth.compliance import (
    foundation_compliance,
    hertz_compliance,
    in_foundation_range,
    ring_foundation,
    root_load,
    tooth_compliance,
)
from gearpair.teeth.gear_body import ring_compliance
from gearpair.teeth.spurpair import SpurPair
from gearpair.teeth.tooth_profile import ROOTS, Root, ToothProfile

Array = NDArray[np.float64]
Coupling = Literal["summed", "ring", "clamped"]
COUPLINGS = get_args(Coupling)
_NODES, _WEIGHTS = leggauss(24)


@equal_by_value
@dataclass(frozen=True)
class MeshStiffness:
    """The mesh stiffness of one pair over one mesh period; made by `mesh_stiffness`.

    Phase 0 is the moment at which a new pair of teeth enters contact, so the zone with more pairs in
    contact comes first: the phase of the article's rectangle.

    Parameters
    ----------
    pair : SpurPair
        The gears.
    root, foundation, coupling : str, bool, str
        What `mesh_stiffness` was asked for.
    phase : ndarray, shape (n,)
        Fractions of the mesh period, 0 <= phase < 1.
    stiffness_n_per_m : ndarray, shape (n,)
        Mesh stiffness along the line of action, in N/m.
    pairs_in_contact : ndarray of int, shape (n,)
        How many pairs share the load.
    load_share : ndarray, shape (p, n)
        Fraction of the force on the pair that entered contact 0, 1, ... p - 1 mesh periods before the
        start of this one; dimensionless, 0 where that pair is out of contact.
    path : ndarray, shape (m,)
        Position of one pair on its path of contact, in mesh periods since it entered: 0 to the contact ratio.
    pair_stiffness_n_per_m : ndarray, shape (m,)
        Stiffness of that pair alone, in N/m.
    compliance_m_per_n : mapping of str to ndarray, shape (m,)
        What that stiffness is made of, in m/N: ``pinion_bending``, ``pinion_shear``, ``pinion_axial``,
        ``pinion_foundation``, the same four of the gear, and ``hertz``. They add up to the pair's compliance.
    zones : tuple of Legendre
        The mesh curve in N/m between two changes of the number of pairs, as polynomials of the phase.
    joint_compliance_m_per_n : ndarray, shape (n, p, p)
        How far a unit force on one pair moves the pairs of `load_share` together, in m/N; 0 for one out of contact.
    outside_fit : tuple of str
        One sentence for each gear of summed pairs that lies outside the range of the foundation formula.
    """

    pair: SpurPair
    root: Root
    foundation: bool
    coupling: Coupling
    phase: Array
    stiffness_n_per_m: Array
    pairs_in_contact: NDArray[np.int64]
    load_share: Array
    path: Array
    pair_stiffness_n_per_m: Array
    compliance_m_per_n: Mapping[str, Array]
    zones: tuple[Legendre, ...] = field(repr=False)
    joint_compliance_m_per_n: Array = field(repr=False)
    outside_fit: tuple[str, ...] = ()

    @property
    def contact_ratio(self) -> float:
        """epsilon of the pair."""
        return self.pair.contact_ratio

    @property
    def mean(self) -> float:
        """Mean over the mesh period in N/m: k_m of the article. Exact for the curve, not a mean of samples."""
        return float(sum(_integral(zone, *zone.domain) for zone in self.zones))

    @property
    def zone_means(self) -> Array:
        """Mean stiffness in N/m of each zone of the mesh period, in order."""
        return np.array([_integral(zone, *zone.domain) / (zone.domain[1] - zone.domain[0]) for zone in self.zones])

    def rectangular(self) -> Rectangle:
        """The article's description of this curve: contact ratio, a and b.

        Returns
        -------
        Rectangle
            ``1 + a`` and ``1 - b`` are the means of the zones with two pairs and with one, over the mean of
            the period; hence ``a (contact_ratio - 1) == b (2 - contact_ratio)``, and the rectangle's mean is 1.

        Raises
        ------
        ValueError
            When the contact ratio is not between 1 and 2: the article's form knows one and two pairs.

        Examples
        --------
        >>> rectangle = mesh_stiffness(SpurPair()).rectangular()
        >>> round(rectangle.contact_ratio, 4), round(rectangle.a, 3), round(rectangle.b, 3)
        (1.6806, 0.161, 0.344)
        """
        ratio = self.contact_ratio
        if len(self.zones) != 2 or not 1.0 < ratio < 2.0:
            raise ValueError(
                f"no two-level wave of the article's form exists: contact_ratio is {ratio:g} and must be "
                "above 1 and below 2; use wave(n_levels)"
            )
        double, single = self.zone_means / self.mean
        return Rectangle(ratio, float(double - 1.0), float(1.0 - single), "printed")

    def wave(self, n_levels: int) -> StiffnessWave:
        """The curve as a staircase of mean 1, for `Oscillator(stiffness=...)`.

        Parameters
        ----------
        n_levels : int
            Number of levels, at least the number of zones (two, unless the contact ratio is whole). Each zone
            gets its share of them, equally wide, so the jumps of the curve stay where they are.

        Returns
        -------
        StiffnessWave
            Each level is the curve's mean over its interval, over the mean of the period (dimensionless).

        Examples
        --------
        >>> wave = mesh_stiffness(SpurPair()).wave(40)
        >>> len(wave.levels), round(wave.mean, 12)
        (40, 1.0)
        """
        n_levels = check_count("n_levels", n_levels, at_least=len(self.zones))
        widths = [zone.domain[1] - zone.domain[0] for zone in self.zones]
        first = min(max(round(n_levels * widths[0]), 1), n_levels - len(self.zones) + 1)
        counts = [first] if len(self.zones) == 1 else [first, n_levels - first]
        edges: list[float] = []
        levels: list[float] = []
        for zone, count in zip(self.zones, counts, strict=True):
            ends = np.linspace(float(zone.domain[0]), float(zone.domain[1]), count + 1)
            primitive = zone.integ()
            edges.extend(ends[:-1].tolist())
            levels.extend((np.diff(primitive(ends)) / np.diff(ends) / self.mean).tolist())
        return StiffnessWave(tuple(edges), tuple(levels))


@checked
def mesh_stiffness(
    pair: SpurPair,
    *,
    root: Root = "trochoid",
    foundation: bool = True,
    coupling: Coupling = "summed",
    n_phases: int = 1000,
) -> MeshStiffness:
    """Mesh stiffness of a spur pair over a mesh period, by the potential-energy method.

    Parameters
    ----------
    pair : SpurPair
        The gears.
    root : {"trochoid", "straight", "base_circle"}
        Shape of the tooth below its involute, see `ToothProfile`.
    foundation : bool
        Whether the gear bodies yield or are rigid.
    coupling : {"summed", "ring", "clamped"}
        ``"summed"``: the pairs in contact are springs side by side, as in most of the literature. Each has its own
        gear body, held at its bore (Sainsot, Velex and Duverger 2004; the ring's series outside the range of their
        formula; a solid body without twist). ``"ring"``: they share their bodies. A load on one tooth also moves its
        neighbours' feet, by `ring_compliance` (plane elasticity of a ring); the twist of the whole body between bore
        and rim is left out, for it belongs to the shaft. ``"clamped"``: the same with that twist, as finite elements
        have it that hold the bore. The last two need `foundation`.
    n_phases : int
        Samples over the mesh period, at least 2.

    Notes
    -----
    Teeth without error, in plane stress, all of the smaller width b in contact, contact only between the tip circles.
    The pairs in contact share the force so that all approach by the same distance: with the compliance
    matrix C of the pairs, ``k = sum of the elements of inverse(C)``. Diagonal C gives the sum of the pairs'
    stiffnesses. Components: `tooth_compliance`, `hertz_compliance` (once per pair, with
    ``2 / E = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2`` of unlike materials in the place of ``2 (1 - nu^2) / E``),
    `foundation_compliance` and `ring_foundation`. The body apart from tooth and contact, and its twist apart from the
    mesh: Kiekbusch, Sappok, Sauer and Howard (2011).

    With a gear of more and more teeth the teeth grow stiffer and the body, as deep as the gear is large, softer by a
    logarithm: finite at any number of teeth, without an end.

    Raises
    ------
    ValueError
        A solid body, which has no bore, with ``coupling="clamped"``.

    Examples
    --------
    >>> summed = mesh_stiffness(SpurPair())
    >>> ring = mesh_stiffness(SpurPair(), coupling="ring")
    >>> round(summed.mean / 1e6), round(ring.mean / 1e6)
    (385, 418)
    """
    check_choice("root", root, ROOTS)
    check_choice("coupling", coupling, COUPLINGS)
    n_phases = check_count("n_phases", n_phases, at_least=2)
    if coupling != "summed" and not foundation:
        raise ValueError(f"coupling = {coupling!r} joins the teeth by their gear bodies: it needs foundation=True")
    for who, gear in (("pinion", pair.pinion), ("gear", pair.gear)):
        if coupling == "clamped" and gear.bore_mm == 0.0:
            raise ValueError(f"coupling = 'clamped' holds each body at its bore, and the {who} is solid: take 'ring'")
    model = _Model(pair, root, foundation, coupling)
    ratio = pair.contact_ratio
    whole = math.floor(ratio + 1e-12)
    part = ratio - whole if ratio - whole > 1e-12 else 0.0
    phase = np.arange(n_phases) / n_phases
    pairs = np.where(phase < part, whole + 1, whole)
    most = int(pairs.max())
    forces, joint = np.zeros((most, n_phases)), np.zeros((n_phases, most, most))
    zones = []
    for left, right, count in ((0.0, part, whole + 1), (part, 1.0, whole)):
        if right > left:
            # smooth between two changes of the number of pairs: 24 Gauss nodes give it to rounding
            nodes = left + (right - left) * (1 + _NODES) / 2
            series = _legendre(model.shared(nodes, count))
            zones.append(Legendre(series.sum(axis=0), domain=[left, right]))
            inside = pairs == count
            places = 2 * (phase[inside] - left) / (right - left) - 1
            forces[:count, inside] = series @ legvander(places, len(_NODES) - 1).T
            joint[inside, :count, :count] = model.joint(phase[inside], count)
    stiffness = forces.sum(axis=0)
    path = np.linspace(0.0, ratio, math.ceil(ratio * n_phases) + 1)
    parts = model.components(path)
    return MeshStiffness(
        pair=pair,
        root=root,
        foundation=foundation,
        coupling=coupling,
        phase=phase,
        stiffness_n_per_m=stiffness,
        pairs_in_contact=pairs,
        load_share=forces / stiffness,
        path=path,
        pair_stiffness_n_per_m=np.asarray(1.0 / sum(parts.values())),
        compliance_m_per_n=parts,
        zones=tuple(zones),
        joint_compliance_m_per_n=joint,
        outside_fit=model.outside_fit() if foundation and coupling == "summed" else (),
    )


class _Model:
    """The compliances of a pair as functions of its position, in m/N."""

    def __init__(self, pair: SpurPair, root: Root, foundation: bool, coupling: Coupling) -> None:
        self.pair, self.foundation, self.coupling = pair, foundation, coupling
        self.teeth = {"pinion": ToothProfile(pair.pinion, root), "gear": ToothProfile(pair.gear, root)}
        width = pair.contact_width_mm * 1e-3
        self.units = {who: tooth.gear.material.youngs_modulus_gpa * 1e9 * width for who, tooth in self.teeth.items()}

    def rolls(self, who: str, position: Array) -> Array:
        """Roll angle of the contact on one gear, for positions in mesh periods since entry."""
        on_pinion = self.pair.contact_start_mm + position * self.pair.base_pitch_mm
        if who == "pinion":
            return on_pinion / self.pair.pinion.base_radius_mm
        return (self.pair.line_of_action_mm - on_pinion) / self.pair.gear.base_radius_mm

    def components(self, position: Array) -> dict[str, Array]:
        parts: dict[str, Array] = {}
        contact = 0.0
        for who, tooth in self.teeth.items():
            roll, unit, nu = self.rolls(who, position), self.units[who], tooth.gear.material.poisson_ratio
            bending, shear, axial = tooth_compliance(tooth, roll, nu)
            parts |= {f"{who}_bending": bending / unit, f"{who}_shear": shear / unit, f"{who}_axial": axial / unit}
            parts[f"{who}_foundation"] = self.body(who, roll) / unit
            contact += hertz_compliance(nu) / unit / 2
        parts["hertz"] = np.full_like(position, contact)
        return parts

    def body(self, who: str, roll: Array) -> Array:
        """Compliance of one gear's body below its loaded tooth, times E b."""
        tooth = self.teeth[who]
        if not self.foundation:
            return np.zeros_like(roll)
        if self.coupling == "summed" and in_foundation_range(tooth):
            return foundation_compliance(tooth, roll)
        return ring_foundation(tooth, roll, self.bodies[who][0])

    def shared(self, phase: Array, count: int) -> Array:
        """Force on each of `count` pairs for unit approach, shape (count, n)."""
        return np.asarray(np.linalg.solve(self.joint(phase, count), np.ones((phase.size, count, 1)))[..., 0].T)

    def joint(self, phase: Array, count: int) -> Array:
        """Compliance matrix of `count` pairs, shape (n, count, count); diagonal where they share no body."""
        positions = phase + np.arange(count)[:, None]
        matrix = np.zeros((phase.size, count, count))
        matrix[:, range(count), range(count)] = np.asarray(sum(self.components(positions).values())).T
        if self.coupling != "summed":
            for who in self.teeth:
                matrix += self.neighbours(who, self.rolls(who, positions))
        return matrix

    @cached_property
    def bodies(self) -> dict[str, Array]:
        """Ring compliance from one tooth to itself, the next, ... on the flank's side: shape (n, 3, 3) each."""
        reach = math.floor(self.pair.contact_ratio) + 1
        return {
            who: ring_compliance(
                tooth.radius_ratio,
                tooth.clamp_half_angle,
                2 * math.pi / tooth.gear.teeth * np.arange(reach),
                tooth.gear.material.poisson_ratio,
                twist=self.coupling != "ring",
            )
            for who, tooth in self.teeth.items()
        }

    def neighbours(self, who: str, rolls: Array) -> Array:
        """Compliance in m/N between the loaded teeth of one gear: shape (n, count, count), zero diagonal.

        All contacts lie on one line, so the angle between two teeth is the difference of their roll angles:
        on the pinion the pair that entered earlier is further towards the flank's side, on the gear the later.
        """
        tooth, count = self.teeth[who], len(rolls)
        load = root_load(tooth, rolls)
        joined = np.zeros((rolls.shape[1], count, count))
        for i in range(count):
            for j in range(i):
                early, late = (i, j) if who == "pinion" else (j, i)
                push = np.sum((load[early] @ self.bodies[who][i - j]) * load[late], axis=-1)
                joined[:, i, j] = joined[:, j, i] = push / self.units[who]
        return joined

    def outside_fit(self) -> tuple[str, ...]:
        return tuple(
            f"the {who}'s theta_f = {tooth.clamp_half_angle:.3f} and h = {tooth.radius_ratio:.2f} are outside the "
            "range that the foundation formula was fitted for, theta_f from 0.01 to 0.12 and h from 1.4 to 7: its body "
            "is an elastic ring instead"
            for who, tooth in self.teeth.items()
            if not in_foundation_range(tooth)
        )


def _legendre(values: Array) -> Array:
    """Legendre coefficients of functions given at the Gauss nodes, shape (..., 24) both."""
    order = np.arange(len(_NODES))
    return np.asarray((order + 0.5) * ((_WEIGHTS * values) @ legvander(_NODES, len(_NODES) - 1)))


def _integral(curve: Legendre, left: float, right: float) -> float:
    primitive = curve.integ()
    return float(primitive(right) - primitive(left))
