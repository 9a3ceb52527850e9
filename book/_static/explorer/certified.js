// Where a linear piece of the motion first leaves its region, with a proof that it did not leave before.
//
// The motion on the rest of a cell is a power series p(t), t from 0 to `end`. Three certificates, cheapest first: its
// Bezier hull lies inside; it is monotone, so it leaves where its end value says; or certified steps, each the first
// positive root of d + u h + m h^2 / 2 with m <= p''. Those of gearpair/_flow/event_search.py, where they are proved.
gearpair.define("certified", ["library", "closed_form"], function ({ tolerances }, closedForm) {
  const { TERMS, value, evaluate, evaluateJerk, fourthDerivativeBound } = closedForm;
  const MONOTONE = ((384 * Math.sqrt(3)) / 216 / 3) * 1.01;
  const ROUNDING = 2 ** -52;
  const { MAX_STEPS } = tolerances;
  const [INSIDE, LEFT, UNDECIDED] = [0, 1, 2];

  // Where `firstExit` found the motion: t, the boundary it left through, its slope there.
  const exit = new Float64Array(3);

  function left(t, boundary, slope) {
    exit[0] = t;
    exit[1] = boundary;
    exit[2] = slope;
    return LEFT;
  }

  function certifiedStep(d, u, m) {
    const square = u * u - 2 * m * d;
    if (square < 0 || (u >= 0 && m >= 0)) return Infinity;
    if (u > 0) return (u + Math.sqrt(square)) / -m;
    if (d === 0) return 0;
    return (2 * d) / (Math.sqrt(square) - u);
  }

  // The longest certified step up to `end` from distance d with derivatives u, a, j and a fourth within +-`fourth`.
  function longestStep(d, u, a, j, fourth, end) {
    let step = 0;
    while (end > step) {
      const m = a + Math.min(0, j * end) - 0.5 * fourth * end * end;
      step = Math.max(step, Math.min(end, certifiedStep(d, u, m)));
      end *= 0.5;
    }
    return step;
  }

  // The region that the motion enters from (x, v): on a boundary the first non-zero derivative decides.
  function regionAt(x, v, acceleration, forceRate) {
    if (x > 1) return 1;
    if (x < -1) return -1;
    if (x > -1 && x < 1) return 0;
    const way = v !== 0 ? v : acceleration !== 0 ? acceleration : forceRate;
    if (x === 1) return way > 0 ? 1 : 0;
    return way < 0 ? -1 : 0;
  }

  // x1, v1 are value and slope (per t) at `end`; fourth >= max |p''''|. After LEFT, `exit` tells where.
  function firstExit(series, region, end, x1, v1, fourth) {
    const spread = (fourth * end * end * end * end) / 384;
    const b0 = series[0];
    const b3 = x1;
    const b1 = b0 + (series[1] * end) / 3;
    const b2 = b3 - (v1 * end) / 3;
    const floor = region < 0 ? -Infinity : region > 0 ? 1 : -1;
    const ceiling = region > 0 ? Infinity : region < 0 ? -1 : 1;
    if (Math.min(b0, b1, b2, b3) - spread >= floor && Math.max(b0, b1, b2, b3) + spread <= ceiling) return INSIDE;
    const margin = MONOTONE * spread;
    const rising = b1 - b0 > margin && b2 - b1 > margin && b3 - b2 > margin;
    const falling = b0 - b1 > margin && b1 - b2 > margin && b2 - b3 > margin;
    if (rising || falling) {
      if ((rising && x1 <= ceiling) || (falling && x1 >= floor)) return INSIDE;
      return singleRoot(series, rising ? ceiling : floor, end, b0, b1, b2, b3);
    }
    return stepByStep(series, floor, ceiling, end, fourth);
  }

  // The root of p(t) = boundary where p is monotone and passes it: from the root of the cubic Hermite interpolant by
  // Halley's iteration, kept in a bracket.
  function singleRoot(series, boundary, end, b0, b1, b2, b3) {
    const c1 = 3 * (b1 - b0);
    const c2 = 3 * (b2 - 2 * b1 + b0);
    const c3 = b3 - b0 + 3 * (b1 - b2);
    let s = (boundary - b0) / (b3 - b0);
    for (let i = 0; i < 2; i++) {
      const cubic = b0 - boundary + s * (c1 + s * (c2 + s * c3));
      s -= cubic / (c1 + s * (2 * c2 + s * 3 * c3));
    }
    const sign = b3 > b0 ? 1 : -1;
    let low = 0;
    let high = end;
    let t = s * end;
    if (!(t > low && t < high)) t = 0.5 * end;
    for (let i = 0; i < 60; i++) {
      evaluate(series, t);
      const p = value[0] - boundary;
      if (sign * p > 0) high = t;
      else low = t;
      const newton = p / value[1];
      const step = newton / (1 - (0.5 * newton * value[2]) / value[1]);
      if (Math.abs(step) <= 1e-8 * end) {
        return left(Math.min(Math.max(t - step, 0), end), boundary, value[1] - step * value[2]); // its square is below rounding
      }
      t -= step;
      if (!(t > low && t < high)) t = 0.5 * (low + high);
    }
    return left(t, boundary, value[1]);
  }

  function stepByStep(series, floor, ceiling, end, fourth) {
    const tiny = ROUNDING * Math.max(1, Math.abs(series[0])); // below this a distance is rounding
    let t = 0;
    for (let i = 0; i < MAX_STEPS; i++) {
      evaluateJerk(series, t);
      const [p, u, a, j] = value;
      const above = p - floor;
      const below = ceiling - p;
      if (above <= tiny && u < 0) return left(t, floor, u);
      if (below <= tiny && u > 0) return left(t, ceiling, u);
      let step = end - t;
      if (above < Infinity) step = Math.min(step, longestStep(Math.max(above, 0), u, a, j, fourth, end - t));
      if (below < Infinity) step = Math.min(step, longestStep(Math.max(below, 0), -u, -a, -j, fourth, end - t));
      if (Math.min(above, below) <= tiny) {
        // At rest on a boundary, or leaving it: a step that cannot pass it by more than rounding.
        step = Math.max(step, Math.sqrt(tiny / (Math.abs(a) + Math.abs(j) + fourth + ROUNDING)));
      }
      t += step;
      if (t >= end) return INSIDE;
    }
    return UNDECIDED;
  }

  // The first root of the slope p' in [t, end], by certified steps on the slope; Infinity where there is none.
  function nextTurn(series, t, end) {
    const fourth = fourthDerivativeBound(series, end);
    const tiny = slopeRounding(series, end);
    for (let i = 0; i < MAX_STEPS; i++) {
      evaluateJerk(series, t);
      if (Math.abs(value[1]) <= tiny) return t;
      const sign = value[1] < 0 ? -1 : 1;
      t += Math.max(longestStep(sign * value[1], sign * value[2], sign * value[3], -fourth, 0, end - t), ROUNDING * end);
      if (t > end) break;
    }
    return Infinity;
  }

  function slopeRounding(series, end) {
    let scale = 0;
    for (let n = TERMS - 1; n > 0; n--) scale = scale * end + n * Math.abs(series[n]);
    return ROUNDING * Math.max(scale, 1);
  }

  // How far p' must be followed from a root for it to leave its rounding.
  function leastStep(series, end) {
    let bend = 0;
    for (let n = TERMS - 1; n > 2; n--) bend = bend * end + n * (n - 1) * (n - 2) * Math.abs(series[n]);
    return Math.sqrt((2 * slopeRounding(series, end)) / bend);
  }

  return { INSIDE, LEFT, UNDECIDED, exit, regionAt, firstExit, nextTurn, leastStep };
});
