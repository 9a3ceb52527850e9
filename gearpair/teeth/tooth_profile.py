"""The outline of half a tooth, from its root to any point of its involute.

Coordinates of one tooth, in modules: y along its centre line from the gear's centre, h the half
thickness at right angles to it. A load on the flank is named by its roll angle t, with which
``r = r_b sqrt(1 + t^2)``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_choice, check_class
from gearpair.teeth.spurgear import SpurGear

Array = NDArray[np.float64]
Root = Literal["trochoid", "straight", "base_circle"]
ROOTS = get_args(Root)
_FRACTIONS = np.linspace(0.0, 1.0, 401)  # along a fillet
_TOUCH = 1e-4  # modules by which a tip may seem to run into a fillet, which is given by points


@dataclass(frozen=True)
class ToothProfile:
    """Half a tooth outline: a root curve, then the involute.

    Parameters
    ----------
    gear : SpurGear
        The gear that the tooth belongs to.
    root : {"trochoid", "straight", "base_circle"}
        ``"trochoid"``: the fillet that the rack cuts, from the root circle to the form circle.
        ``"straight"``: lines parallel to the tooth's centre line from the base circle down to the root
        circle (Liang, Zuo and Patel 2014). ``"base_circle"``: nothing below the base circle, where the
        tooth is clamped (the early papers, Yang and Lin 1987).

    Notes
    -----
    Where the root circle lies outside the base circle (more than 41 teeth at 20 degrees), the last two
    both become the bare involute from the root circle.

    Examples
    --------
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> tooth = ToothProfile(SpurPair().pinion, "trochoid")
    >>> round(tooth.clamp_radius, 3), round(tooth.clamp_half_angle, 4)
    (15.75, 0.0886)
    """

    gear: SpurGear
    root: Root = "trochoid"

    def __post_init__(self) -> None:
        check_class("gear", self.gear, SpurGear)
        check_choice("root", self.root, ROOTS)

    @property
    def base_radius(self) -> float:
        """Base radius r_b, in modules."""
        return self.gear.base_radius_mm / self.gear.module_mm

    @property
    def root_radius(self) -> float:
        """Root circle radius r_f, in modules."""
        return self.gear.root_circle_mm / self.gear.module_mm

    @property
    def clamp_radius(self) -> float:
        """Radius of the circle where the tooth ends and the body begins, in modules."""
        if self.root == "base_circle":
            return max(self.base_radius, self.root_radius)
        return self.root_radius

    @property
    def radius_ratio(self) -> float:
        """h: that circle over the bore; infinite for a solid gear."""
        return self.clamp_radius * self.gear.module_mm / self.gear.bore_mm if self.gear.bore_mm else math.inf

    @property
    def clamp_half_angle(self) -> float:
        """theta_f: half the angle the tooth takes on that circle, in radians."""
        if self.root == "trochoid":
            return self.gear.root_half_angle
        if self.clamp_radius >= self.base_radius:
            tangent = math.sqrt(max((self.clamp_radius / self.base_radius) ** 2 - 1.0, 0.0))
            return self.gear.base_half_angle - (tangent - math.atan(tangent))
        return math.asin(self.base_radius * math.sin(self.gear.base_half_angle) / self.root_radius)

    @property
    def first_roll(self) -> float:
        """Roll angle t at which the involute begins, in radians."""
        if self.root == "trochoid":
            radius = self.gear.form_circle_mm / self.gear.module_mm
        else:
            radius = max(self.base_radius, self.root_radius)
        return math.sqrt(max((radius / self.base_radius) ** 2 - 1.0, 0.0))

    @property
    def least_half_thickness(self) -> float:
        """Half the thickness of the root at its waist, in modules; below 0 where both fillets cut the tooth off."""
        return float(np.min(self.fillet(_FRACTIONS)[1]))

    def involute(self, roll: ArrayLike) -> tuple[Array, Array, Array, Array]:
        """The involute at roll angles t.

        Parameters
        ----------
        roll : array_like
            Roll angles in radians, any shape.

        Returns
        -------
        y, h, dy, dh : ndarray
            Coordinates in modules, and their derivatives by the roll angle.

        Examples
        --------
        >>> from gearpair.teeth.spurpair import SpurPair
        >>> y, h, _, _ = ToothProfile(SpurPair().pinion).involute(0.364)
        >>> round(float(y), 3), round(float(h), 3)
        (16.982, 0.785)
        """
        t = check_array("roll", roll)
        angle = self.gear.base_half_angle - t  # the string's direction: the force makes -angle with the cross-section
        sine, cosine = np.sin(angle), np.cos(angle)
        r = self.base_radius
        return r * (cosine - t * sine), r * (sine + t * cosine), r * t * cosine, r * t * sine

    def fillet(self, fraction: ArrayLike) -> tuple[Array, Array, Array, Array]:
        """The root curve, from the clamp (fraction 0) to the involute (fraction 1).

        Returns what `involute` does, with derivatives by the fraction.

        Notes
        -----
        Trochoid: the common normal of the rack's tip arc and the gear passes through the pitch point
        (law of gearing) at an angle gamma to the pitch line, which runs from pi/2 on the root circle
        to alpha at the involute, or ends before where that has been cut away.

        Examples
        --------
        >>> from gearpair.teeth.spurpair import SpurPair
        >>> tooth = ToothProfile(SpurPair().pinion)
        >>> y, h, _, _ = tooth.fillet(0.0)
        >>> round(float(np.hypot(y, h)), 3)
        15.75
        """
        s = check_array("fraction", fraction)
        if self.root != "trochoid":
            return self._line(s)
        gear, m = self.gear, self.gear.module_mm
        pitch, rho = gear.pitch_radius_mm / m, gear.rack_tip_radius_mm / m
        depth, offset = gear.rack_tip_depth_mm / m, gear.rack_tip_offset_mm / m
        rate = gear.fillet_end - math.pi / 2
        gamma = math.pi / 2 + rate * s
        sine, cosine = np.sin(gamma), np.cos(gamma)
        along, below = depth * cosine / sine + rho * cosine, pitch - depth - rho * sine
        d_along, d_below = -depth / sine**2 - rho * sine, -rho * cosine
        # turn by the rack's travel, then by half a pitch: from the space's centre line to the tooth's
        turn = (depth * cosine / sine - offset) / pitch + math.pi / gear.teeth
        d_turn = -depth / sine**2 / pitch
        sin_turn, cos_turn = np.sin(turn), np.cos(turn)
        y = along * sin_turn + below * cos_turn
        h = below * sin_turn - along * cos_turn
        dy = d_along * sin_turn + d_below * cos_turn - h * d_turn
        dh = d_below * sin_turn - d_along * cos_turn + y * d_turn
        return y, h, rate * dy, rate * dh

    def _line(self, s: Array) -> tuple[Array, Array, Array, Array]:
        top, half, _, _ = self.involute(self.first_roll)
        bottom = self.clamp_radius * math.cos(self.clamp_half_angle)
        length = float(top) - bottom if self.clamp_radius < self.base_radius else 0.0
        zero = np.zeros_like(s)
        return bottom + length * s, float(half) + zero, length + zero, zero


def tip_clears(gear: SpurGear, mate: SpurGear, centre_distance_mm: float) -> bool:
    """Whether the corner at the mate's tip stays outside the gear's fillet on its whole way through the space.

    Parameters
    ----------
    gear, mate : SpurGear
    centre_distance_mm : float

    Notes
    -----
    In the gear's frame the mate rolls round it, and its corner, which lies on the gear's involute prolonged when it
    crosses the line of action, describes a trochoid.

    Examples
    --------
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> pair = SpurPair(pinion_teeth=12, gear_teeth=44)
    >>> tip_clears(pair.pinion, pair.gear, pair.centre_distance_mm)
    True
    """
    tooth, m = ToothProfile(gear), gear.module_mm
    working = math.acos((gear.base_radius_mm + mate.base_radius_mm) / centre_distance_mm)
    lowest = centre_distance_mm * math.sin(working) - math.sqrt(mate.tip_circle_mm**2 - mate.base_radius_mm**2)
    roll = lowest / gear.base_radius_mm
    centre = centre_distance_mm / m * np.exp(1j * (gear.base_half_angle - roll + working))
    y, h, _, _ = tooth.involute(roll)
    turn = np.linspace(-1.0, 1.0, 4001) * math.pi / gear.teeth
    path = np.exp(1j * turn) * centre + np.exp(1j * turn * (1 + gear.teeth / mate.teeth)) * (y + 1j * h - centre)
    y, h, _, _ = tooth.fillet(_FRACTIONS)
    radius, reached = np.hypot(y, h), np.abs(path)
    near = (radius[0] < reached) & (reached < radius[-1])
    gap = np.angle(path[near]) - np.interp(reached[near], radius, np.arctan2(h, y))
    return bool(np.all(reached[near] * gap > -_TOUCH))
