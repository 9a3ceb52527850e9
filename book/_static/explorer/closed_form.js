// The closed form of one linear piece of the motion, as a power series in t = h / width.
//
// Between two events the equation is linear with constant coefficients,
//     X'' + 2 zeta X' + kappa (X - s) = F_m + A sin(theta + Omega h),    A = F_ah Omega^2,
// and its solution is linear in (X - s, X', F_m, A sin theta, A cos theta) at h = 0. No rate turns by more than
// REACH over a cell, so the series has converged to below rounding at DEGREE: one formula for resonance, critical
// damping and no damping alike. As in gearpair/_flow/closed_form.py, less what higher harmonics add there.
gearpair.define("closed_form", ["library"], function ({ tolerances }) {
  const { DEGREE, REACH } = tolerances;
  const TERMS = DEGREE + 1;
  const SINE_SIGNS = [1, 0, -1, 0];
  const COSINE_SIGNS = [0, 1, 0, -1];

  // What `evaluate` and `evaluateJerk` return: p, p', p'', p'''. One array, so that a walk allocates nothing.
  const value = new Float64Array(4);

  function fastestRate(kappa, zeta, omega) {
    const root = zeta * zeta > kappa ? zeta + Math.sqrt(zeta * zeta - kappa) : Math.sqrt(kappa);
    return Math.max(omega, root);
  }

  // Row i of `basis` (5 rows of TERMS) is the response to the i-th of the five numbers. The equation gives each
  // coefficient from the two before it: (n+1)(n+2) c[n+2] = -2 zeta w (n+1) c[n+1] - kappa w^2 c[n] + w^2 f[n].
  function fillBasis(kappa, zeta, omega, width, basis) {
    basis.fill(0);
    basis[0] = 1;
    basis[TERMS + 1] = width;
    const square = width * width;
    let power = square; // w^2 (Omega w)^n / n!
    for (let n = 0; n < DEGREE - 1; n++) {
      for (let i = 0; i < 5; i++) {
        let force = 0;
        if (i === 2 && n === 0) force = square;
        else if (i === 3) force = power * SINE_SIGNS[n % 4];
        else if (i === 4) force = power * COSINE_SIGNS[n % 4];
        const at = i * TERMS + n;
        const rest = 2 * zeta * width * (n + 1) * basis[at + 1] + kappa * square * basis[at];
        basis[at + 2] = (force - rest) / ((n + 1) * (n + 2));
      }
      power *= (omega * width) / (n + 1);
    }
  }

  function expand(basis, shift, x, v, force, sine, cosine, series) {
    const y = x - shift;
    for (let n = 0; n < TERMS; n++) {
      series[n] =
        basis[n] * y +
        basis[TERMS + n] * v +
        (basis[2 * TERMS + n] * force + basis[3 * TERMS + n] * sine + basis[4 * TERMS + n] * cosine);
    }
    series[0] += shift;
  }

  // Value and first two derivatives at t of the power series that starts at `from` (Horner).
  function evaluate(series, t, from = 0) {
    let p = series[from + DEGREE];
    let dp = 0;
    let halfDdp = 0;
    for (let n = DEGREE - 1; n >= 0; n--) {
      halfDdp = halfDdp * t + dp;
      dp = dp * t + p;
      p = p * t + series[from + n];
    }
    value[0] = p;
    value[1] = dp;
    value[2] = 2 * halfDdp;
  }

  function evaluateJerk(series, t) {
    evaluate(series, t);
    let dddp = 0;
    for (let n = DEGREE; n > 2; n--) dddp = dddp * t + n * (n - 1) * (n - 2) * series[n];
    value[3] = dddp;
  }

  // max |p''''| on [0, end], from above: the sum of its terms' moduli.
  function fourthDerivativeBound(series, end, from = 0) {
    let bound = 0;
    for (let n = DEGREE; n > 3; n--) bound = bound * end + n * (n - 1) * (n - 2) * (n - 3) * Math.abs(series[from + n]);
    return bound;
  }

  // Sine and cosine by the kernels of Sun's fdlibm, for arguments of moderate size: { sine, cosine }. The engines' own
  // differ in the last digit, and so, in the end, would a chaotic motion that a link is to bring back.
  const [HALF_PI, HALF_PI_REST] = [1.57079632673412561417, 6.07710050650619224932e-11];
  const S = [-1.66666666666666324348e-1, 8.33333333332248946124e-3, -1.98412698298579493134e-4, 2.75573137070700676789e-6, -2.50507602534068634195e-8, 1.58969099521155010221e-10];
  const C = [4.16666666666666019037e-2, -1.38888888888741095749e-3, 2.48015872894767294178e-5, -2.75573143513906633035e-7, 2.08757232129817482790e-9, -1.13596475577881948265e-11];

  function sineCosine(angle) {
    const n = Math.round(angle / (HALF_PI + HALF_PI_REST));
    const r = angle - n * HALF_PI;
    const w = n * HALF_PI_REST;
    const x = r - w;
    const y = r - x - w;
    const z = x * x;
    const tail = S[1] + z * (S[2] + z * (S[3] + z * (S[4] + z * S[5])));
    const sine = x - (z * (0.5 * y - z * x * tail) - y - z * x * S[0]);
    const cap = z * (C[0] + z * (C[1] + z * (C[2] + z * (C[3] + z * (C[4] + z * C[5])))));
    const most = 1 - 0.5 * z;
    const cosine = most + (1 - most - 0.5 * z + (z * cap - x * y));
    return [[sine, cosine], [cosine, -sine], [-sine, -cosine], [-cosine, sine]][((n % 4) + 4) % 4];
  }

  return { DEGREE, TERMS, REACH, value, fastestRate, fillBasis, expand, evaluate, evaluateJerk, fourthDerivativeBound, sineCosine };
});
