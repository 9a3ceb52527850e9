"""The gear body as an elastic ring: what a load on one tooth does to its neighbours.

A ring in plane stress, fixed at its bore, carries the force and the moment of a tooth on an arc of its
rim. Its displacement is known in closed form, harmonic by harmonic, so the influence of one tooth's load
on any other tooth is a sum that converges like 1 / n^3. This is the model behind Sainsot's foundation formula,
without the fit and for every tooth rather than the loaded one alone.
"""

import math

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
_HARMONICS = 400


def ring_compliance(
    radius_ratio: float, half_angle: float, angles: ArrayLike, poisson_ratio: float, *, n_harmonics: int = _HARMONICS
) -> Array:
    """Influence of a tooth's load on the displacement of the same and of other teeth.

    Parameters
    ----------
    radius_ratio : float
        Root circle over bore, h = r_f / r_bore > 1.
    half_angle : float
        theta_f, half the angle of a tooth on the root circle, in radians.
    angles : array_like
        Angles from the tooth that is loaded to the tooth that is watched, in radians, any shape;
        positive towards the flank's side.
    poisson_ratio : float
        nu, dimensionless.
    n_harmonics : int
        Terms of the series.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Times E b, lengths in root radii: rows are displacements, columns loads. Along the rim (x),
        along the tooth (y) and turning (moment about the middle of the root, in units of force times r_f).

    Notes
    -----
    The tooth's force is spread evenly over the arc ``|theta| <= theta_f``, its moment linearly; the
    displacements are averages with the same weights (work-conjugate), so that the matrix of all teeth is
    symmetric. Displacements ``r^(+-n +- 1)`` of Michell's solution (Timoshenko and Goodier, Theory of
    Elasticity, art. 42), with the logarithm at n = 1 and the twist at n = 0.

    Examples
    --------
    >>> own, next_tooth = ring_compliance(3.0, 0.08, [0.0, 0.185], 0.3)
    >>> round(float(own[0, 0]), 3), round(float(next_tooth[0, 0]), 3)
    (4.102, 3.132)
    """
    nodes, weights = leggauss(max(32, int(n_harmonics * half_angle)))
    theta, weights = half_angle * nodes, half_angle * weights
    height = math.sin(half_angle) / half_angle
    sine, cosine = np.sin(theta), np.cos(theta)
    even = np.full_like(theta, 1 / (2 * half_angle))
    linear = sine / (weights @ sine**2)
    zero = np.zeros_like(theta)
    # loads as (t_x, t_y): unit force along x (its moment about (0, height) is zero), along y, unit moment
    loads = np.array([[even, zero], [zero, even], [zero, linear]])
    loads[0, 1] = linear * (weights @ ((cosine - height) * even))
    radial = loads[:, 0] * sine + loads[:, 1] * cosine
    tangential = loads[:, 0] * cosine - loads[:, 1] * sine
    order = np.arange(n_harmonics + 1)
    waves = np.exp(-1j * order[:, None] * theta) * weights
    # components of the load at every order, as (p_r, i p_theta): real compliance matrices join them to (u_r, i u_theta)
    parts = np.stack([waves @ radial.T, 1j * (waves @ tangential.T)], axis=1) / (2 * math.pi)
    moved = _ring_harmonics(radius_ratio, poisson_ratio, n_harmonics) @ parts
    terms = 2 * math.pi * parts.conj().transpose(0, 2, 1) @ moved
    terms[1:] *= 2.0
    turns = np.exp(-1j * np.asarray(angles, dtype=float)[..., None] * order)
    return np.asarray(np.tensordot(turns, terms, axes=1).real)


def _ring_harmonics(radius_ratio: float, poisson_ratio: float, n_harmonics: int) -> Array:
    """Compliance of the rim at each order: (u_r, i u_theta) from (p_r, i p_theta), shape (n + 1, 2, 2).

    Times E b, rim radius 1. With ``u_r = f cos(n theta)``, ``u_theta = g sin(n theta)``.
    """
    nu, inner = poisson_ratio, 1 / radius_ratio
    shear = 1 / (2 * (1 + nu))
    plane = 1 / (1 - nu**2)
    n = np.arange(1, n_harmonics + 1, dtype=float)
    powers = np.stack([n + 1, n - 1, 1 - n, -1 - n], axis=-1)
    k = n[:, None]
    # g / f of a mode r^p, from the radial equilibrium
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = -(plane * (powers**2 - 1) - shear * k**2) / (k * (plane * (powers * nu - 1) + shear * (powers - 1)))
    ratio[:, 1] = -1.0  # divergence-free and irrotational: u = grad(r^n cos(n theta))
    ratio[0, 2] = -(1 + nu) / (3 - nu)  # n = 1: u_r = ln(r), u_theta = -ln(r) + this

    def mode(radius: float) -> tuple[Array, Array, Array, Array]:
        with np.errstate(over="ignore", under="ignore"):
            size = np.where(powers > 0, radius ** np.abs(powers), (inner / radius) ** np.abs(powers))
        f, g = size, ratio * size
        log = math.log(radius)
        stretch, hoop = powers * size, f + k * g
        slide = -k * f + (powers - 1) * g
        f[0, 2], g[0, 2] = log, ratio[0, 2] - log
        stretch[0, 2], hoop[0, 2], slide[0, 2] = 1.0, ratio[0, 2], -1.0 - ratio[0, 2]
        return f, g, plane * (stretch + nu * hoop) / radius, shear * slide / radius

    # growing modes are 1 at the rim, the others at the bore: the systems stay well conditioned
    f_in, g_in, _, _ = mode(inner)
    f_out, g_out, normal, sliding = mode(1.0)
    system = np.stack([f_in, g_in, normal, sliding], axis=1)
    unit = np.zeros((n_harmonics, 4, 2))
    unit[:, 2, 0] = unit[:, 3, 1] = 1.0
    amplitudes = np.linalg.solve(system, unit)
    result = np.empty((n_harmonics + 1, 2, 2))
    result[1:] = np.stack([f_out, g_out], axis=1) @ amplitudes
    # n = 0: u_r and u_theta are A r + B / r, zero at the bore
    stretch, hoop = 1 + inner**2, 1 - inner**2
    result[0] = [[hoop / (plane * (stretch + nu * hoop)), 0.0], [0.0, hoop / (2 * inner**2 * shear)]]
    return result
