"""The article's method, for comparison: the Dormand-Prince 5(4) pair with adaptive steps; and the classical method.

The pair does step for step what ``scipy.integrate.solve_ivp(method="RK45")`` does (tableau, first step, error norm,
step factors, quartic interpolant), so that it draws what RK45 would draw, some hundred times sooner. Like it, it steps
over the discontinuities as it finds them. The classical method of order four has fixed steps.

Sources: J. R. Dormand and P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19; the interpolant is L. F. Shampine's,
Math. Comp. 46 (1986) 135.
"""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, Integers, allocating_kernel, kernel
from .cells import Coefficients
from .closed_form import AMPLITUDE, ORDER, PHASE
from .states import Lanes, coefficients_of

NODES = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
STAGES = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
        [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],  # the fifth-order step itself
    ]
)
ERROR = np.array([-71 / 57600, 0.0, 71 / 16695, -71 / 1920, 17253 / 339200, -22 / 525, 1 / 40])
INTERPOLANT = np.array(
    [
        [1.0, -8048581381 / 2820520608, 8663915743 / 2820520608, -12715105075 / 11282082432],
        [0.0, 0.0, 0.0, 0.0],
        [0.0, 131558114200 / 32700410799, -68118460800 / 10900136933, 87487479700 / 32700410799],
        [0.0, -1754552775 / 470086768, 14199869525 / 1410260304, -10690763975 / 1880347072],
        [0.0, 127303824393 / 49829197408, -318862633887 / 49829197408, 701980252875 / 199316789632],
        [0.0, -282668133 / 205662961, 2019193451 / 616988883, -1453857185 / 822651844],
        [0.0, 40617522 / 29380423, -110615467 / 29380423, 69997945 / 29380423],
    ]
)
SAFETY, LEAST_FACTOR, LARGEST_FACTOR = 0.9, 0.2, 10.0
EXPONENT = -1 / 5

# Status of an integration.
COMPLETE, STEP_TOO_SMALL, TOO_MANY_STEPS, ESCAPED = 0, 1, 2, 3
ESCAPE = 1e6  # |X| + |X'| beyond which the classical method gives up


@kernel
def deflection(x: float) -> float:
    """How far X is beyond the backlash, with its sign: f(X)."""
    return x - 1.0 if x > 1.0 else x + 1.0 if x < -1.0 else 0.0


@kernel
def damping_at(p: Coefficients, x: float) -> float:
    """The damping ratio of oscillator `p` at X."""
    return p.flight_damping if -1.0 <= x <= 1.0 else p.damping_ratio


@kernel
def acceleration(p: Coefficients, tau: float, x: float, v: float) -> float:
    """X'' of oscillator `p` at (tau, x, v)."""
    force = p.mean_force + p.error_amplitude * p.mesh_frequency**2 * np.sin(p.mesh_frequency * tau + p.error_phase)
    for h in p.harmonics:
        rate = h[ORDER] * p.mesh_frequency
        force += h[AMPLITUDE] * rate * rate * np.sin(rate * tau + h[PHASE])
    force -= 2.0 * damping_at(p, x) * v
    gap = deflection(x)
    if gap == 0.0:
        return force
    mesh = tau * p.mesh_frequency / (2.0 * np.pi)
    fraction = mesh - np.floor(mesh)
    level = p.levels.size - 1
    while fraction < p.edges[level]:
        level -= 1
    return force - p.levels[level] * gap


@kernel
def norm(x: float, v: float, x_scale: float, v_scale: float) -> float:
    """Root mean square of the two components, each in its own scale."""
    return np.sqrt(0.5 * ((x / x_scale) ** 2 + (v / v_scale) ** 2))


@kernel
def first_step(p: Coefficients, x: float, v: float, end: float, rtol: float, atol: float) -> float:
    """A first step from the sizes of the state and its first two derivatives (Hairer, Norsett, Wanner I, II.4)."""
    x_scale, v_scale = atol + abs(x) * rtol, atol + abs(v) * rtol
    a = acceleration(p, 0.0, x, v)
    d0, d1 = norm(x, v, x_scale, v_scale), norm(v, a, x_scale, v_scale)
    h0 = 1e-6 if d0 < 1e-5 or d1 < 1e-5 else 0.01 * d0 / d1
    h0 = min(h0, end)
    d2 = norm(h0 * a, acceleration(p, h0, x + h0 * v, v + h0 * a) - a, x_scale, v_scale) / h0
    if d1 <= 1e-15 and d2 <= 1e-15:
        h1 = max(1e-6, h0 * 1e-3)
    else:
        h1 = (0.01 / max(d1, d2)) ** -EXPONENT
    return min(min(100.0 * h0, h1), end)


@kernel
def fill_stages(p: Coefficients, tau: float, x: float, v: float, h: float, slopes: Array) -> tuple[float, float]:
    """Stages 1 to 6 of a step `h`, stage 0 given: the new (x, v). ``slopes`` is (2, 7): X' and X'' of each stage."""
    x1, v1 = x, v
    for i in range(1, 7):
        dx, dv = 0.0, 0.0
        for k in range(i):
            dx += STAGES[i, k] * slopes[0, k]
            dv += STAGES[i, k] * slopes[1, k]
        x1, v1 = x + h * dx, v + h * dv
        slopes[0, i], slopes[1, i] = v1, acceleration(p, tau + NODES[i] * h, x1, v1)
    return x1, v1


@kernel
def step_error(slopes: Array, h: float) -> tuple[float, float]:
    """The difference of the fifth- and the fourth-order step."""
    dx, dv = 0.0, 0.0
    for i in range(7):
        dx += ERROR[i] * slopes[0, i]
        dv += ERROR[i] * slopes[1, i]
    return h * dx, h * dv


@kernel
def interpolate(slopes: Array, component: int, start: float, h: float, s: float) -> float:
    """One component of the state at the share `s` of a step."""
    change = 0.0
    for i in range(7):
        w = 0.0
        for n in range(3, -1, -1):
            w = (w + INTERPOLANT[i, n]) * s
        change += w * slopes[component, i]
    return start + h * change


class Steps(NamedTuple):
    """How to step: by the pair, or with equal steps where there is no tolerance."""

    rtol: float  # 0 for equal steps
    atol: float
    per_period: int  # equal steps a mesh period; of the pair, the least number (0: any)
    most: int  # steps of the pair in all


@allocating_kernel
def integrate(p: Coefficients, x: float, v: float, n_periods: int, steps: Steps, points: Array) -> tuple[int, int, int]:
    """RK45 from (x, v) over `n_periods`: (status, steps taken, calls of the right side).

    Fills ``points`` (m, 2) with the last m section points ``tau = n T``, from the start (n = 0) to the end.
    """
    period = 2.0 * np.pi / p.mesh_frequency * p.mesh_periods
    end, rtol, atol = n_periods * period, steps.rtol, steps.atol
    max_step = 2.0 * np.pi / (p.mesh_frequency * steps.per_period) if steps.per_period > 0 else np.inf
    slopes = np.empty((2, 7))
    tau = 0.0
    h = first_step(p, x, v, end, rtol, atol)
    slopes[0, 0], slopes[1, 0] = v, acceleration(p, tau, x, v)
    calls = 2
    first_kept = n_periods + 1 - points.shape[0]
    section = 0
    if first_kept <= 0:
        points[0, 0], points[0, 1] = x, v
        section = 1
    section = max(section, first_kept)
    for taken in range(steps.most):
        least = 10.0 * (np.nextafter(tau, np.inf) - tau)
        h = max(min(h, max_step), least)
        rejected = False
        while True:
            if not h >= least:
                return STEP_TOO_SMALL, taken, calls
            tau1 = min(tau + h, end)
            h = tau1 - tau
            x1, v1 = fill_stages(p, tau, x, v, h, slopes)
            calls += 6
            dx, dv = step_error(slopes, h)
            error = norm(dx, dv, atol + max(abs(x), abs(x1)) * rtol, atol + max(abs(v), abs(v1)) * rtol)
            if error < 1.0:
                break
            h *= max(LEAST_FACTOR, SAFETY * error**EXPONENT)
            rejected = True
        factor = LARGEST_FACTOR if error == 0.0 else min(LARGEST_FACTOR, SAFETY * error**EXPONENT)
        while section <= n_periods and section * period <= tau1:
            s = (section * period - tau) / h
            row = section - first_kept
            points[row, 0], points[row, 1] = interpolate(slopes, 0, x, h, s), interpolate(slopes, 1, v, h, s)
            section += 1
        h *= min(1.0, factor) if rejected else factor
        tau, x, v = tau1, x1, v1
        if tau >= end:
            return COMPLETE, taken + 1, calls
        slopes[0, 0], slopes[1, 0] = slopes[0, 6], slopes[1, 6]
    return TOO_MANY_STEPS, steps.most, calls


@kernel
def tabulate(p: Coefficients, n_steps: int, forces: Array, levels: Array) -> None:
    """Force and stiffness at every half step of a base period, 2 `n_steps` a mesh period; its end is its start."""
    half = np.pi / (p.mesh_frequency * n_steps)
    level = 0
    for j in range(2 * n_steps * p.mesh_periods):
        place = j % (2 * n_steps)
        if place == 0:
            level = 0
        while level + 1 < p.levels.size and p.edges[level + 1] <= place / (2.0 * n_steps):
            level += 1
        forces[j], levels[j] = acceleration(p, j * half, 0.0, 0.0), p.levels[level]


@allocating_kernel
def integrate_fixed(p: Coefficients, x: float, v: float, n_periods: int, n_steps: int, points: Array) -> int:
    """The classical Runge-Kutta method with `n_steps` equal steps a mesh period; `points` as in `integrate`: a status.

    The steps begin with the mesh period and take no notice of switches and of contacts.
    """
    in_all = n_steps * p.mesh_periods
    forces, levels = np.empty(2 * in_all), np.empty(2 * in_all)
    tabulate(p, n_steps, forces, levels)
    h = 2.0 * np.pi / (p.mesh_frequency * n_steps)
    first_kept = n_periods + 1 - points.shape[0]
    for n in range(n_periods + 1):
        if n >= first_kept:
            points[n - first_kept, 0], points[n - first_kept, 1] = x, v
        if n == n_periods:
            return COMPLETE
        if not abs(x) + abs(v) < ESCAPE:
            return ESCAPED
        for i in range(in_all):
            j0, j1, j2 = 2 * i, 2 * i + 1, (2 * i + 2) % (2 * in_all)
            a1 = forces[j0] - 2.0 * damping_at(p, x) * v - levels[j0] * deflection(x)
            x2, v2 = x + 0.5 * h * v, v + 0.5 * h * a1
            a2 = forces[j1] - 2.0 * damping_at(p, x2) * v2 - levels[j1] * deflection(x2)
            x3, v3 = x + 0.5 * h * v2, v + 0.5 * h * a2
            a3 = forces[j1] - 2.0 * damping_at(p, x3) * v3 - levels[j1] * deflection(x3)
            x4, v4 = x + h * v3, v + h * a3
            a4 = forces[j2] - 2.0 * damping_at(p, x4) * v4 - levels[j2] * deflection(x4)
            x += h * (v + 2.0 * v2 + 2.0 * v3 + v4) / 6.0
            v += h * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0
    return COMPLETE


@allocating_kernel
def integrate_lanes(
    first: int, last: int, lanes: Lanes, chain: int, n_periods: int, steps: Steps, points: Array, counts: Integers
) -> None:
    """Integrate lanes `first` to `last`: the same rows of `points` (n, m, 2) and `counts` (n, 2): status, calls.

    All but the first of each `chain` lanes start where the one before it ended, if that is complete. Calls are not
    counted with equal steps.
    """
    for i in range(first, last):
        x, v = lanes.starts[i, 0], lanes.starts[i, 1]
        if i % chain > 0 and counts[i - 1, 0] == COMPLETE:
            x, v = points[i - 1, -1, 0], points[i - 1, -1, 1]
        p = coefficients_of(lanes, lanes.own[i])
        if steps.rtol > 0.0:
            counts[i, 0], _taken, counts[i, 1] = integrate(p, x, v, n_periods, steps, points[i])
        else:
            counts[i, 0] = integrate_fixed(p, x, v, n_periods, steps.per_period, points[i])
