"""The gear body as an elastic ring: what a load on one tooth does to its neighbours.

A ring in plane stress, fixed at its bore, carries the force and the moment of a tooth on an arc of its
rim. Its displacement is known in closed form, harmonic by harmonic, so the influence of one tooth's load
on any other tooth is a sum that converges like 1 / n^3. This is the model behind Sainsot's foundation formula,
without the fit and for every tooth rather than the loaded one alone.

The part of order 0 along the rim is the twist of the whole body between bore and rim. All teeth take part in it alike.
Where the rotors of a model are rigid and most of their inertia is in the rim it belongs to the shaft, not to the mesh.
"""

import math

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
_HARMONICS = 400  # of an ordinary gear, at least
_WAVES = 36.0  # n theta_f where the series ends


def ring_compliance(
    radius_ratio: float,
    half_angle: float,
    angles: ArrayLike,
    poisson_ratio: float,
    *,
    twist: bool = True,
    n_harmonics: int | None = None,
) -> Array:
    """Influence of a tooth's load on the displacement of the same and of other teeth.

    Parameters
    ----------
    radius_ratio : float
        Root circle over bore, h = r_f / r_bore > 1; infinite for a solid disc, which nothing holds: uniform forces
        over its area balance the load, and displacements are relative to its mean one.
    half_angle : float
        theta_f, half the angle of a tooth on the root circle, in radians.
    angles : array_like
        Angles from the tooth that is loaded to the tooth that is watched, in radians, any shape;
        positive towards the flank's side.
    poisson_ratio : float
        nu, dimensionless.
    twist : bool
        Whether the twist of the whole body counts; a solid disc has none.
    n_harmonics : int, optional
        Order at which the series ends; not given, one that is high enough for the arc of this tooth.

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
    Elasticity, art. 42), with the logarithm at n = 1 and the twist ``r_f^2 / (4 pi G b) (1 / r_bore^2 - 1 / r_f^2)`` at
    n = 0, of a unit force along the rim. The terms of the largest gears stand for groups of orders, so that a gear of a
    million teeth, nearly a rack, takes no longer. Its compliance grows with the logarithm of the number of teeth, by
    ``2 / pi`` for each factor e, as a half-plane's does with the depth at which it is held.

    Examples
    --------
    >>> own, next_tooth = ring_compliance(3.0, 0.08, [0.0, 0.185], 0.3)
    >>> round(float(own[0, 0]), 3), round(float(next_tooth[0, 0]), 3)
    (4.102, 3.132)
    """
    order, count = _orders(half_angle, n_harmonics)
    nodes, weights = leggauss(max(32, int(order[-1] * half_angle)))
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
    waves = np.exp(-1j * order[:, None] * theta) * weights
    # components of the load at every order, as (p_r, i p_theta): real compliance matrices join them to (u_r, i u_theta)
    parts = np.stack([waves @ radial.T, 1j * (waves @ tangential.T)], axis=1) / (2 * math.pi)
    moved = _ring_harmonics(radius_ratio, poisson_ratio, order, twist=twist) @ parts
    terms = 2 * math.pi * parts.conj().transpose(0, 2, 1) @ moved
    terms[1:] *= 2.0 * count[1:, None, None]
    turns = np.exp(-1j * np.asarray(angles, dtype=float)[..., None] * order)
    return np.asarray(np.tensordot(turns, terms, axes=1).real)


def _orders(half_angle: float, highest: int | None) -> tuple[Array, Array]:
    """Orders from 0 on, and how many orders each stands for: all of an ordinary gear, groups where they are many."""
    last = max(_HARMONICS, math.ceil(_WAVES / half_angle)) if highest is None else highest
    groups, n = [], min(last, 2 * _HARMONICS)
    single = np.arange(n + 1)
    while n < last:
        # a group is narrow beside its order, which the ring's terms go by, and beside 1 / angle, which the loads go by
        size = max(1, min(n // 50, int(0.02 / half_angle), last - n))
        groups.append((n + (size + 1) / 2, size))
        n += size
    order, count = np.array(groups).reshape(-1, 2).T
    return np.concatenate([single, order]), np.concatenate([np.ones(single.size), count])


def _ring_harmonics(radius_ratio: float, poisson_ratio: float, order: Array, *, twist: bool) -> Array:
    """Compliance of the rim at each order: (u_r, i u_theta) from (p_r, i p_theta), shape of order + (2, 2).

    Times E b, rim radius 1. With ``u_r = f cos(n theta)``, ``u_theta = g sin(n theta)``; the first order is 0.
    """
    nu, inner = poisson_ratio, 1 / radius_ratio
    shear = 1 / (2 * (1 + nu))
    plane = 1 / (1 - nu**2)
    n = order[1:]
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
    f_out, g_out, normal, sliding = mode(1.0)
    rim, load = np.stack([f_out, g_out], axis=1), np.stack([normal, sliding], axis=1)
    result = np.empty((len(order), 2, 2))
    if inner > 0.0:
        f_in, g_in, _, _ = mode(inner)
        unit = np.zeros((len(n), 4, 2))
        unit[:, 2, 0] = unit[:, 3, 1] = 1.0
        result[1:] = rim @ np.linalg.solve(np.concatenate([np.stack([f_in, g_in], axis=1), load], axis=1), unit)
    else:
        # n = 1: r^2 and, balancing the load, uniform forces, which move by c r^2 along the radius
        rim[0, :, 1], load[0, :, 1] = (1.0, 0.0), (plane * (2 + nu), -shear)
        result[1:] = rim[..., :2] @ np.linalg.inv(load[..., :2])
        result[1] += np.array([[-1.0], [1.0]]) * (result[1, 0] - result[1, 1]) / 4  # relative to the mean displacement
    # n = 0: u_r and u_theta are A r + B / r, zero at the bore
    stretch, hoop = 1 + inner**2, 1 - inner**2
    turn = hoop / (2 * inner**2 * shear) if twist and inner > 0.0 else 0.0
    result[0] = [[hoop / (plane * (stretch + nu * hoop)), 0.0], [0.0, turn]]
    return result
