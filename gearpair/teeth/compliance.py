"""What yields under a unit load: tooth, contact and the body below the tooth.

Everything here is dimensionless: compliance times Young's modulus times face width, with lengths in
modules, so that it depends on neither. Plane stress. Loads are named by their roll angle t on the flank;
the force follows the line of action and makes the angle ``alpha_1 = t - alpha_2`` with the normal of the
tooth's centre line (alpha_2 is half the tooth's angle on the base circle). It crosses that line at
``y = r_b / cos(alpha_1)``, so its moment about the section at y is ``r_b - y cos(alpha_1)``, the same as
``cos(alpha_1) (y_C - y) - sin(alpha_1) h_C``.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from gearpair.teeth.tooth_profile import ToothProfile

Array = NDArray[np.float64]
_SHEAR_FACTOR = 1.2
_NODES, _WEIGHTS = leggauss(32)
_FRACTIONS, _WEIGHTS = (1 + _NODES) / 2, _WEIGHTS / 2
# Sainsot, Velex and Duverger (2004), table 1: rows L*, M*, P*, Q*; columns A to F
_SAINSOT = np.array(
    [
        [-5.574e-5, -1.9986e-3, -2.3015e-4, 4.7702e-3, 0.0271, 6.8045],
        [60.111e-5, 28.100e-3, -83.431e-4, -9.9256e-3, 0.1624, 0.9086],
        [-50.952e-5, 185.50e-3, 0.0538e-4, 53.300e-3, 0.2895, 0.9236],
        [-6.2042e-5, 9.0889e-3, -4.0964e-4, 7.8297e-3, -0.1472, 0.6904],
    ]
)


class ToothCompliance(NamedTuple):
    """The three ways a tooth yields; each times E b (dimensionless), shape of the roll angles."""

    bending: Array
    shear: Array
    axial: Array


def tooth_compliance(tooth: ToothProfile, roll: ArrayLike, poisson_ratio: float) -> ToothCompliance:
    """Bending, shear and axial compliance of one tooth by the potential-energy method.

    Parameters
    ----------
    tooth : ToothProfile
        The tooth as a beam clamped where the profile ends.
    roll : array_like
        Roll angles of the load in radians, any shape, on the involute.
    poisson_ratio : float
        nu, dimensionless.

    Notes
    -----
    With the force F and the section's half thickness h (area ``2 h b``, second moment ``2 h^3 b / 3``)::

        bending  integral of M^2 / (E I) dy,   M / F = cos(alpha_1) (y_C - y) - sin(alpha_1) h_C
        shear    integral of 1.2 cos(alpha_1)^2 / (G A) dy
        axial    integral of sin(alpha_1)^2 / (E A) dy

    Yang and Lin (1987) for bending and axial compression, Tian (2004) for shear. Gauss-Legendre
    quadrature along the outline, 32 nodes on the root curve and 32 on the involute.

    Examples
    --------
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> tooth = ToothProfile(SpurPair().pinion)
    >>> [round(float(part), 3) for part in tooth_compliance(tooth, 0.364, 0.3)]
    [0.456, 1.947, 0.061]
    """
    t = np.asarray(roll, dtype=float)
    slope = t - tooth.gear.base_half_angle
    cosine, sine = np.cos(slope), np.sin(slope)
    first = tooth.first_roll
    parts = (
        (tooth.fillet(_FRACTIONS), np.ones_like(t)),
        (tooth.involute(first + (t[..., None] - first) * _FRACTIONS), t - first),
    )
    bending, by_thickness = np.zeros_like(t), np.zeros_like(t)
    for (y, h, dy, _), length in parts:
        moment = tooth.base_radius - y * cosine[..., None]
        bending = bending + length * ((1.5 * moment**2 / h**3 * dy) @ _WEIGHTS)
        by_thickness = by_thickness + length * ((dy / h) @ _WEIGHTS)
    shear = _SHEAR_FACTOR * (1 + poisson_ratio) * cosine**2 * by_thickness
    return ToothCompliance(bending, shear, sine**2 * by_thickness / 2)


def hertz_compliance(poisson_ratio: float) -> float:
    """Compliance of one contact, both flanks together, times E b: ``4 (1 - nu^2) / pi``.

    Notes
    -----
    Yang and Sun (1985): the Hertzian contact of two cylinders made linear,
    ``k_h = pi E b / (4 (1 - nu^2))``, once per pair and the same at every contact position.

    Examples
    --------
    >>> round(hertz_compliance(0.3), 4)
    1.1586
    """
    return 4 * (1 - poisson_ratio**2) / math.pi


def foundation_coefficients(half_angle: float, radius_ratio: float) -> Array:
    """L*, M*, P* and Q* of Sainsot, Velex and Duverger (2004), equation and table 1.

    Parameters
    ----------
    half_angle : float
        theta_f, half the angle of the tooth on the root circle, in radians.
    radius_ratio : float
        h = r_f / r_bore, dimensionless.

    Returns
    -------
    ndarray, shape (4,)
        ``A / theta_f^2 + B h^2 + C h / theta_f + D / theta_f + E h + F``, dimensionless.

    Examples
    --------
    >>> foundation_coefficients(0.08, 3.0).round(3)
    array([6.91 , 1.306, 4.048, 0.403])
    """
    theta, h = half_angle, radius_ratio
    return np.asarray(_SAINSOT @ np.array([1 / theta**2, h**2, h / theta, 1 / theta, h, 1.0]))


def foundation_compliance(tooth: ToothProfile, roll: ArrayLike) -> Array:
    """Compliance of the gear body below one loaded tooth (fillet foundation), times E b.

    Parameters
    ----------
    tooth : ToothProfile
        Its clamp circle is the foundation's r_f, its clamp half angle theta_f.
    roll : array_like
        Roll angles of the load in radians, any shape.

    Notes
    -----
    Sainsot, Velex and Duverger (2004): an elastic ring, plane stress, fixed at its bore, with the
    stresses of the tooth's root on the arc ``S_f = 2 r_f theta_f``::

        cos(alpha_1)^2 [L* (u_f / S_f)^2 + M* (u_f / S_f) + P* (1 + Q* tan(alpha_1)^2)],
        u_f = r_b / cos(alpha_1) - r_f

    The fit is stated for ``1.4 <= h <= 7`` and ``0.01 <= theta_f <= 0.12`` (`in_foundation_range`): some 26 teeth to
    300, of a standard rack. Outside it goes astray, and `ring_foundation` takes its place in `mesh_stiffness`.

    Examples
    --------
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> round(float(foundation_compliance(ToothProfile(SpurPair().pinion), 0.364)), 3)
    5.121
    """
    slope = np.asarray(roll, dtype=float) - tooth.gear.base_half_angle
    arm = tooth.base_radius / np.cos(slope) - tooth.clamp_radius
    ratio = arm / (2 * tooth.clamp_radius * tooth.clamp_half_angle)
    linear, mixed, shear, thrust = foundation_coefficients(tooth.clamp_half_angle, tooth.radius_ratio)
    return np.asarray(
        np.cos(slope) ** 2 * (linear * ratio**2 + mixed * ratio + shear * (1 + thrust * np.tan(slope) ** 2))
    )


def in_foundation_range(tooth: ToothProfile) -> bool:
    """Whether theta_f and h are inside the range that Sainsot's fit was made for.

    Examples
    --------
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> in_foundation_range(ToothProfile(SpurPair().pinion))
    True
    """
    return 1.4 <= tooth.radius_ratio <= 7.0 and 0.01 <= tooth.clamp_half_angle <= 0.12


def root_load(tooth: ToothProfile, roll: ArrayLike) -> Array:
    """A unit force on the flank as the load on the tooth's root that `ring_compliance` knows.

    Parameters
    ----------
    tooth : ToothProfile
    roll : array_like
        Roll angles of the load in radians, any shape.

    Returns
    -------
    ndarray, shape (..., 3)
        Along the rim, along the tooth, and the moment in units of force times root radius.

    Examples
    --------
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> root_load(ToothProfile(SpurPair().pinion), 0.364).round(3)
    array([-0.954, -0.298,  0.061])
    """
    slope = np.asarray(roll, dtype=float) - tooth.gear.base_half_angle
    middle = math.sin(tooth.clamp_half_angle) / tooth.clamp_half_angle
    arm = tooth.base_radius / tooth.clamp_radius / np.cos(slope) - middle
    return np.stack([-np.cos(slope), -np.sin(slope), np.cos(slope) * arm], axis=-1)


def ring_foundation(tooth: ToothProfile, roll: ArrayLike, ring: Array) -> Array:
    """Compliance of the gear body below one loaded tooth by the elastic ring's series, times E b.

    Parameters
    ----------
    tooth : ToothProfile
    roll : array_like
        Roll angles of the load in radians, any shape.
    ring : ndarray, shape (3, 3)
        `ring_compliance` of the tooth to itself.

    Examples
    --------
    >>> from gearpair.teeth.gear_body import ring_compliance
    >>> from gearpair.teeth.spurpair import SpurPair
    >>> tooth = ToothProfile(SpurPair().pinion)
    >>> ring = ring_compliance(tooth.radius_ratio, tooth.clamp_half_angle, 0.0, 0.3)
    >>> round(float(ring_foundation(tooth, 0.364, ring)), 3), round(float(foundation_compliance(tooth, 0.364)), 3)
    (5.265, 5.121)
    """
    load = root_load(tooth, roll)
    return np.asarray(np.sum((load @ ring) * load, axis=-1))
