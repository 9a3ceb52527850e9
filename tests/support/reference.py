"""Independent references for the exact flow: nothing here is shared with `gearpair._flow`.

`dop853_period` integrates each linear piece by DOP853 and restarts at every event. `mpmath_period`
solves each linear piece with seventy digits and finds events by brute force: dense
sampling of X'' parts the piece where X' is monotone, its roots part it where X is, and bisection does the rest.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product

import numpy as np
from mpmath import mp, mpc, mpf
from scipy.integrate import solve_ivp

import gearpair as gp
from gearpair._flow.cells import Coefficients

mp.dps = 70
# Added to every stiffness: it parts coinciding roots and resonances, and shifts the answer by as little.
NUDGE = mpf(10) ** -30
NOISE = mpf(10) ** -36  # what a position can be off by, mostly from dividing by the nudge


def plain_coefficients(osc: gp.Oscillator) -> Coefficients:
    """What the kernels take, built by hand."""
    damping = osc.damping_ratio, osc.damping_in_flight
    scalars = (osc.mean_force, osc.error_amplitude, osc.error_phase, *damping, osc.mesh_frequency)
    harmonics = np.array(osc.harmonics, dtype=float).reshape(-1, 3)
    return Coefficients(*scalars, np.array([*osc.stiffness.edges, 1.0]), np.array(osc.stiffness.levels), harmonics, 1)


def every_harmonic(osc: gp.Oscillator) -> list[tuple[float, float, float]]:
    """(frequency over the mesh frequency, amplitude, phase) of the whole transmission error."""
    shafts = [(order / teeth, amplitude, phase) for teeth, amplitude, phase, order in osc.shaft_orders]
    return [(1, osc.error_amplitude, osc.error_phase), *osc.harmonics, *shafts]


def right_hand_side(osc: gp.Oscillator):
    """(tau, (X, X')) -> (X', X''), the article's equation."""

    def slope(tau, y):
        x, v = y
        gap = x - 1.0 if x > 1.0 else x + 1.0 if x < -1.0 else 0.0
        force = osc.mean_force
        for n, amplitude, phase in every_harmonic(osc):
            force += amplitude * (n * osc.mesh_frequency) ** 2 * np.sin(n * osc.mesh_frequency * tau + phase)
        zeta = osc.damping_ratio if gap else osc.damping_in_flight
        return v, force - 2.0 * zeta * v - float(osc.stiffness(tau / osc.mesh_period)) * gap

    return slope


def dop853_period(osc: gp.Oscillator, x: float, v: float) -> tuple[float, float]:
    """The state after one base period from the start of one."""
    omega = osc.mesh_frequency
    edges = [*osc.stiffness.edges, 1.0]
    region = 0
    for turn, (i, level) in product(range(osc.mesh_periods), enumerate(osc.stiffness.levels)):
        tau, end = (turn + edges[i]) * osc.mesh_period, (turn + edges[i + 1]) * osc.mesh_period
        while tau < end:
            force = osc.force(tau)
            jerk = sum(a * n**3 * omega**3 * np.cos(n * omega * tau + phase) for n, a, phase in every_harmonic(osc))
            rates = (v, force, jerk)  # at rest no damping acts
            way = next((rate for rate in rates if rate != 0.0), 0.0)
            region = 1 if x > 1.0 or (x == 1.0 and way > 0.0) else -1 if x < -1.0 or (x == -1.0 and way < 0.0) else 0
            stiffness, zeta = level * abs(region), osc.damping_ratio if region else osc.damping_in_flight

            def slope(t, y, stiffness=stiffness, region=region, zeta=zeta):
                return y[1], osc.force(t) - 2.0 * zeta * y[1] - stiffness * (y[0] - region)

            leave = []
            for boundary, direction in ((1.0, 1.0), (-1.0, -1.0)):
                if region == 0 or region == boundary:
                    leave.append(lambda t, y, boundary=boundary: y[0] - boundary)
                    leave[-1].terminal = True
                    leave[-1].direction = direction if region == 0 else -direction
            if abs(x) == 1.0:  # leave the boundary first, or its event is found again
                away = min(osc.mesh_period / 100, 0.25 * abs(v) / max(abs(rates[1]), v * v, 1e-300))
                leave = leave if v == 0.0 else []
            run = solve_ivp(
                slope,
                (tau, min(end, tau + away) if not leave else end),
                (x, v),
                "DOP853",
                events=leave,
                rtol=1e-13,
                atol=1e-14,
                max_step=osc.mesh_period / 20 / max(n for n, _, _ in every_harmonic(osc)),
            )
            tau, (x, v) = run.t[-1], run.y[:, -1]
            if run.status == 1:
                x = 1.0 if x > 0.0 else -1.0
    return x, v


class Piece:
    """One linear piece in closed form: a constant, forced and two free terms, all complex exponentials."""

    def __init__(self, osc, level, region, theta, x, v):
        zeta, omega = mpf(osc.damping_ratio), mpf(osc.mesh_frequency)
        force, angle = mpf(osc.mean_force), theta - mpf(osc.error_phase)
        kappa = (mpf(level) if region else mpf(0)) + NUDGE
        root = mp.sqrt(mpc(zeta * zeta - kappa))
        forced = [
            mpf(size)
            * (n * omega) ** 2
            * mp.expj(n * angle + mpf(phase))
            / mpc(kappa - (n * omega) ** 2, 2 * zeta * n * omega)
            for n, size, phase in every_harmonic(osc)
        ]
        self.rates = (root - zeta, -root - zeta, *(mpc(0, n * omega) for n, _, _ in every_harmonic(osc)))
        self.rest = region + force / kappa
        # Free terms from the start: a + b = y, r a + q b = u.
        moving = sum(rate * each for rate, each in zip(self.rates[2:], forced, strict=True))
        y, u = x - self.rest - sum(forced).imag, v - moving.imag
        r, q = self.rates[:2]
        free = ((u - q * y) / (r - q), (r * y - u) / (r - q))
        # X is the rest plus the real part of these coefficients times the exponentials; so are its derivatives.
        self.coefficients = [
            [c * rate**n for c, rate in zip((*free, *(-1j * each for each in forced)), self.rates, strict=True)]
            for n in range(3)
        ]
        self.x = x

    def derivative(self, n, h):
        """The n-th derivative of X at time h after the piece's start."""
        waves = sum(c * mp.exp(rate * h) for c, rate in zip(self.coefficients[n], self.rates, strict=True)).real
        return waves + self.rest if n == 0 else waves

    def matrix(self, h):
        """The variational matrix over h."""
        r, q = self.rates[:2]
        e, f = mp.exp(r * h), mp.exp(q * h)
        rows = [[r * f - q * e, e - f], [r * q * (f - e), r * e - q * f]]
        return mp.matrix([[(entry / (r - q)).real for entry in row] for row in rows])

    def roots(self, n, points):
        """Roots of the n-th derivative, which is monotone between neighbours in `points`."""
        values = [self.derivative(n, h) for h in points]
        return [
            bisect(lambda h: self.derivative(n, h), a, b, p)
            for a, b, p, q in zip(points, points[1:], values, values[1:], strict=False)
            if p * q < 0
        ]

    def first_exit(self, floor, ceiling, end, samples):
        """(h, boundary) of the first crossing in (0, end], or None."""
        points = [end * i / samples for i in range(samples + 1)]
        points = sorted([mpf(0), *self.roots(2, points), end])
        points = sorted([mpf(0), *self.roots(1, points), end])
        before = self.x
        for a, b in zip(points, points[1:], strict=False):
            after = self.derivative(0, b)
            for boundary, left in ((ceiling, after > ceiling + NOISE), (floor, after < floor - NOISE)):
                if left:
                    return bisect(
                        lambda h, boundary=boundary: self.derivative(0, h) - boundary, a, b, before - boundary
                    ), boundary
            before = after
        return None


def bisect(f, a, b, fa):
    """A root of f between a and b to fifty digits: bisection, then the secant in its bracket."""
    for _ in range(4):
        middle = (a + b) / 2
        fm = f(middle)
        if fm * fa > 0:
            a, fa = middle, fm
        else:
            b = middle
    fb = f(b)
    if fb == 0 or fa == 0:
        return b if fb == 0 else a
    # Illinois: a secant that always keeps the bracket.
    for _ in range(60):
        c = (a * fb - b * fa) / (fb - fa)
        fc = f(c)
        if abs(b - a) < mpf(10) ** -50 or abs(fc) < mpf(10) ** -60:
            return c
        if fc * fb < 0:
            a, fa = b, fb
        else:
            fa /= 2
        b, fb = c, fc
    return b


@dataclass
class Reference:
    """A period in 70 digits: its end, its crossings (mesh periods, boundary, velocity, contact), its monodromy."""

    x: mpf
    v: mpf
    crossings: list = field(default_factory=list)
    pieces: list = field(default_factory=list)
    segments: list = field(default_factory=list)  # (Piece, region, stiffness, duration)

    @property
    def monodromy(self):
        """The product of the pieces' variational matrices."""
        return self._tail(0)

    @property
    def amplification(self) -> float:
        """The most that an error made at any piece's start grows until the end, at least 1."""
        return max(1.0, *(float(mp.norm(self._tail(i), mp.inf)) for i in range(len(self.pieces))))

    def _tail(self, first):
        product = mp.eye(2)
        for piece in self.pieces[first:]:
            product = piece * product
        return product

    def error(self, x: float, v: float) -> float:
        """How far (x, v) is from the end, relative to max(1, |state|)."""
        return float(max(abs(x - self.x), abs(v - self.v)) / max(1, abs(self.x), abs(self.v)))


def mpmath_period(osc: gp.Oscillator, x: float, v: float) -> Reference:
    """One mesh period from the start of one."""
    omega, zeta = mpf(osc.mesh_frequency), mpf(osc.damping_ratio)
    period = 2 * mp.pi / omega
    edges = [mpf(e) for e in (*osc.stiffness.edges, 1)]
    out = Reference(mpf(x), mpf(v))
    region = None
    for i, level in enumerate(osc.stiffness.levels):
        tau, end = edges[i] * period, edges[i + 1] * period
        while tau < end:
            theta = omega * tau + mpf(osc.error_phase)
            if region is None:
                region = entered(osc, out.x, out.v, theta)
            floor = {-1: -mp.inf, 0: mpf(-1), 1: mpf(1)}[region]
            ceiling = {-1: mpf(-1), 0: mpf(1), 1: mp.inf}[region]
            piece = Piece(osc, level, region, theta, out.x, out.v)
            rate = max(
                omega * max(n for n, _, _ in every_harmonic(osc)),
                mp.sqrt(mpf(level)),
                2 * zeta if zeta**2 > level else 0,
            )
            found = piece.first_exit(floor, ceiling, end - tau, 6 + int(12 * rate * (end - tau)))
            h = end - tau if found is None else found[0]
            out.x, out.v = piece.derivative(0, h), piece.derivative(1, h)
            out.pieces.append(piece.matrix(h))
            out.segments.append((piece, region, mpf(level), h))
            tau += h
            if found is None:
                break
            out.x = found[1]
            out.crossings.append((float(tau / period), int(out.x), float(out.v), region == 0))
            region = int(out.x) if region == 0 else 0
    return out


def entered(osc, x, v, theta):
    """The region that the motion enters: on a boundary its first non-zero derivative decides."""
    if abs(x) != 1:
        return int(x > 1) - int(x < -1)
    angle = theta - mpf(osc.error_phase)
    waves = [(n, mpf(a) * (n * mpf(osc.mesh_frequency)) ** 2, n * angle + mpf(p)) for n, a, p in every_harmonic(osc)]
    rates = (
        v,
        mpf(osc.mean_force) + sum(a * mp.sin(at) for _, a, at in waves) - 2 * mpf(osc.damping_ratio) * v,
        sum(n * a * mp.cos(at) for n, a, at in waves),
    )
    way = next((rate for rate in rates if rate != 0), mpf(0))
    return int(x) if way * x > 0 else 0
