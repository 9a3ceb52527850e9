// The closed form of one linear piece of the motion, as a power series in t = h / width.
//
// Between two events the equation is linear with constant coefficients,
//     X'' + 2 zeta X' + kappa (X - s) = F_m + A sin(theta + Omega h),    A = F_ah Omega^2,
// and its solution is linear in (X - s, X', F_m, A sin theta, A cos theta) at h = 0. No rate turns by more than
// REACH over a cell, so the series has converged to below rounding at DEGREE: one formula for resonance, critical
// damping and no damping alike. As in gearpair/_flow/closed_form.py, less what higher harmonics add there.
gearpair.define("closed_form", [], function () {
  const DEGREE = 15;
  const TERMS = DEGREE + 1;
  const REACH = 0.6;
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

  return { DEGREE, TERMS, REACH, value, fastestRate, fillBasis, expand, evaluate, evaluateJerk, fourthDerivativeBound };
});
