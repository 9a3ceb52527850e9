"""The closed form of one linear piece of the motion.

Between two events the equation is linear with constant coefficients,

    X'' + 2 zeta X' + kappa (X - s) = F_m + A sin(theta + Omega h),    A = F_ah Omega^2,

with (kappa, s) = (k, 1) in drive-side contact, (k, -1) in coast-side contact and (0, 0) in free
flight, where zeta may be another. Its solution is an entire function of the elapsed time h, linear in the five numbers
(X - s, X', F_m, A sin theta, A cos theta) at h = 0; what higher harmonics of the forcing add does not depend on
the state and is one more power series a cell. On a *cell*, a piece of the mesh period of width w
over which no rate of the system turns by more than `REACH`, its power series in t = h / w has converged
to below rounding at `DEGREE`. So one formula serves every case: the textbook's sines and
exponentials divide by zero at resonance, at critical damping and at zeta = 0; their series does not.
"""

import math

import numpy as np

from ._kernel import Array, kernel

DEGREE = 15
TERMS = DEGREE + 1
REACH = 0.6  # REACH**TERMS / TERMS! = 1e-17: the first neglected term

BINOMIALS = np.array([[math.comb(n, k) for k in range(TERMS)] for n in range(TERMS)], dtype=float)

# Columns of `Coefficients.harmonics`: order, amplitude (over b_h) and phase of a harmonic of the transmission error.
ORDER, AMPLITUDE, PHASE = range(3)


@kernel
def fastest_rate(kappa: float, zeta: float, omega: float) -> float:
    """The largest rate of a linear piece: forcing frequency or modulus of a characteristic root."""
    root = zeta + np.sqrt(zeta * zeta - kappa) if zeta * zeta > kappa else np.sqrt(kappa)
    return max(omega, root)


@kernel
def fill_basis(kappa: float, zeta: float, omega: float, width: float, basis: Array) -> None:
    """Power series in t = h / width of the responses to unit (X - s, X', F_m, A sin theta, A cos theta).

    The equation itself gives each coefficient from the two before it,
    (n+1)(n+2) c[n+2] = -2 zeta w (n+1) c[n+1] - kappa w^2 c[n] + w^2 f[n], f the forcing's series.
    """
    basis[:, :] = 0.0
    basis[0, 0] = 1.0
    basis[1, 1] = width
    turn = omega * width
    power = width * width  # w^2 (Omega w)^n / n!
    for n in range(DEGREE - 1):
        quarter = n % 4
        sine = power * (1.0 - quarter if quarter % 2 == 0 else 0.0)  # 1, 0, -1, 0
        cosine = power * (2.0 - quarter if quarter % 2 == 1 else 0.0)  # 0, 1, 0, -1
        for i in range(5):
            force = 0.0
            if i == 2 and n == 0:
                force = width * width
            elif i == 3:
                force = sine
            elif i == 4:
                force = cosine
            basis[i, n + 2] = (
                force - 2.0 * zeta * width * (n + 1) * basis[i, n + 1] - kappa * width * width * basis[i, n]
            ) / ((n + 1) * (n + 2))
        power *= turn / (n + 1)


@kernel
def fill_forced(
    kappa: float, zeta: float, omega: float, width: float, start: float, harmonics: Array, forced: Array
) -> None:
    """Power series in t = h / width of the response from rest to the higher harmonics of the forcing.

    `start` is the cell's in mesh periods, `harmonics` (n, 3) as in `Coefficients`. The equation gives each coefficient
    from the two before it, as in `fill_basis`.
    """
    forced[:] = 0.0
    for i in range(harmonics.shape[0]):
        rate = harmonics[i, ORDER] * omega
        size = harmonics[i, AMPLITUDE] * rate * rate * width * width
        theta = harmonics[i, ORDER] * 2.0 * np.pi * start + harmonics[i, PHASE]
        now, then = size * np.sin(theta), size * np.cos(theta)
        for n in range(DEGREE - 1):  # the forcing's own series first, each term where the response needs it
            forced[n + 2] += now
            now, then = then * rate * width / (n + 1), -now * rate * width / (n + 1)
    for n in range(DEGREE - 1):
        forced[n + 2] -= 2.0 * zeta * width * (n + 1) * forced[n + 1] + kappa * width * width * forced[n]
        forced[n + 2] /= (n + 1) * (n + 2)


@kernel
def add_shifted(forced: Array, t: float, series: Array) -> None:
    """Add to `series` the power series `forced`, expanded about `t`, without its value and slope there."""
    if t == 0.0:
        for k in range(2, TERMS):
            series[k] += forced[k]
        return
    for k in range(2, TERMS):
        shifted = 0.0
        for n in range(DEGREE, k - 1, -1):
            shifted = shifted * t + BINOMIALS[n, k] * forced[n]
        series[k] += shifted


@kernel
def expand(
    basis: Array, shift: float, x: float, v: float, force: float, sine: float, cosine: float, series: Array
) -> None:
    """The motion's power series in t from its state and forcing at t = 0."""
    y = x - shift
    for n in range(basis.shape[1]):  # TERMS; a length that the compiler does not know is done several terms at once
        series[n] = (
            basis[0, n] * y + basis[1, n] * v + (basis[2, n] * force + basis[3, n] * sine + basis[4, n] * cosine)
        )
    series[0] += shift


@kernel
def evaluate(series: Array, t: float) -> tuple[float, float, float]:
    """Value and first two derivatives of a power series at t (Horner)."""
    p = series[DEGREE]
    dp = 0.0
    half_ddp = 0.0
    for n in range(DEGREE - 1, -1, -1):
        half_ddp = half_ddp * t + dp
        dp = dp * t + p
        p = p * t + series[n]
    return p, dp, 2.0 * half_ddp


@kernel
def evaluate_jerk(series: Array, t: float) -> tuple[float, float, float, float]:
    """Value and first three derivatives of a power series at t."""
    p, dp, ddp = evaluate(series, t)
    dddp = 0.0
    for n in range(DEGREE, 2, -1):
        dddp = dddp * t + n * (n - 1) * (n - 2) * series[n]
    return p, dp, ddp, dddp


@kernel
def fourth_derivative_bound(series: Array, end: float) -> float:
    """``max |p''''|`` of a power series p on [0, end], from above: the sum of its terms' moduli."""
    bound = 0.0
    for n in range(DEGREE, 3, -1):
        bound = bound * end + n * (n - 1) * (n - 2) * (n - 3) * abs(series[n])
    return bound
