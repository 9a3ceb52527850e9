// The variational flow along a walk, Newton's method on the period map, Lyapunov exponents.
//
// The force is continuous at X = +-1 and the stiffness switches at fixed times, so the variational flow has no jump:
// its matrix is the product of the linear pieces' own. Where free flight has a damping of its own it has one, of
// determinant 1, at each crossing. As in tangent.py, newton.py and observe.py of gearpair/_flow.
gearpair.define("tangent", ["library", "closed_form", "cells", "flow"], function (library, closedForm, tables, flow) {
  const { TERMS, value, evaluate } = closedForm;
  const { XX, XV, VX, VV, COLUMNS } = tables;
  const { OK, startAt, walk } = flow;
  const { NEWTON_STEPS, NEWTON_ROUNDING } = library.tolerances;

  // A 2 x 2 matrix is [m00, m01, m10, m11].
  function apply(xx, xv, vx, vv, m) {
    for (let k = 0; k < 2; k++) {
      const [top, bottom] = [m[k], m[2 + k]];
      m[k] = xx * top + xv * bottom;
      m[2 + k] = vx * top + vv * bottom;
    }
  }

  // `walk` that also multiplies `m` by the monodromy matrix of the span.
  function walkTangent(cells, motion, periods, m) {
    return walk(cells, motion, periods, {
      whole(j, { region }) {
        const row = (3 * j + region + 1) * COLUMNS;
        const maps = cells.maps;
        apply(maps[row + XX], maps[row + XV], maps[row + VX], maps[row + VV], m);
        return true;
      },
      segment(_period, j, _t, duration, { region }, crossed) {
        const basis = cells.bases[2 * cells.level[j] + Math.abs(region)];
        const width = cells.width[j];
        evaluate(basis, duration);
        const [xx, vx] = value;
        evaluate(basis, duration, TERMS);
        apply(xx, value[0], vx / width, value[1] / width, m);
        const loss = 2 * (cells.flightDamping - cells.dampingRatio);
        if (crossed && loss !== 0) apply(1, 0, region === 0 ? loss : -loss, 1, m);
      },
    });
  }

  // The mean damping ratio over `periods` from (x, v): minus half the sum of the exponents (Liouville).
  function meanDamping(cells, x, v, periods) {
    if (cells.flightDamping === cells.dampingRatio) return cells.dampingRatio;
    let total = 0;
    const add = (j, duration, region) => {
      total += cells.width[j] * duration * (region === 0 ? cells.flightDamping : cells.dampingRatio);
    };
    walk(cells, startAt(cells, x, v), periods, {
      whole(j, { region }) {
        add(j, 1, region);
        return true;
      },
      segment(_period, j, _t, duration, { region }) {
        add(j, duration, region);
      },
    });
    return total / (periods * cells.period);
  }

  // A fixed point of the `period`-fold map near (x, v): { converged, x, v, monodromy }. The search ends where the trace
  // of the monodromy exceeds `mostTrace`; at a stable orbit it is below 2.
  function newton(cells, x, v, period, mostTrace = Infinity) {
    let residual = Infinity;
    let best = { x, v };
    const m = new Float64Array(4);
    for (let i = 0; i < NEWTON_STEPS; i++) {
      m.set([1, 0, 0, 1]);
      const motion = startAt(cells, x, v);
      const lost = walkTangent(cells, motion, period, m) !== OK || Math.abs(m[0] + m[3]) > mostTrace;
      if (lost) return { converged: false, x, v, monodromy: m };
      const rx = motion.x - x;
      const rv = motion.v - v;
      const size = Math.max(Math.abs(rx), Math.abs(rv));
      if (size < residual) {
        residual = size;
        best = { x, v };
      } else if (residual <= NEWTON_ROUNDING * Math.max(1, Math.abs(x))) break;
      const determinant = (1 - m[0]) * (1 - m[3]) - m[1] * m[2];
      if (determinant === 0) break;
      const dx = ((1 - m[3]) * rx + m[1] * rv) / determinant;
      const dv = (m[2] * rx + (1 - m[0]) * rv) / determinant;
      if (!(Math.abs(dx) + Math.abs(dv) < 1e3)) return { converged: false, x, v, monodromy: m };
      x += dx;
      v += dv;
    }
    m.set([1, 0, 0, 1]);
    const status = walkTangent(cells, startAt(cells, best.x, best.v), period, m);
    const small = residual <= 1e3 * NEWTON_ROUNDING * Math.max(1, Math.abs(best.x));
    return { converged: status === OK && small, x: best.x, v: best.v, monodromy: m };
  }

  // Walk, turning the first column of `q` with the flow: { status, total }, the logarithm of its growth.
  function stretch(cells, motion, periods, q) {
    let total = 0;
    for (let i = 0; i < periods; i++) {
      const status = walkTangent(cells, motion, 1, q);
      if (status !== OK) return { status, total };
      const length = Math.sqrt(q[0] * q[0] + q[2] * q[2]); // Math.hypot differs between engines
      q[0] /= length;
      q[2] /= length;
      q[1] = -q[2];
      q[3] = q[0];
      total += Math.log(length);
    }
    return { status: OK, total };
  }

  // Lyapunov exponents per unit tau; a generator that yields after each of `blocks` equal parts of the span, and
  // returns { status, largest, smallest, error }. The smallest follows from Liouville's formula.
  function* exponents(cells, motion, periods, blocks) {
    const q = new Float64Array([1, 0, 0, 1]);
    const perBlock = Math.max(1, Math.floor(periods / blocks));
    // One block first, uncounted, to turn the first direction into the most unstable one.
    stretch(cells, motion, perBlock, q);
    const damping = meanDamping(cells, motion.x, motion.v, perBlock * blocks);
    let mean = 0;
    let spread = 0;
    for (let block = 0; block < blocks; block++) {
      yield;
      const { status, total } = stretch(cells, motion, perBlock, q);
      if (status !== OK) return { status, largest: NaN, smallest: NaN, error: NaN };
      const rate = total / (perBlock * cells.period);
      const delta = rate - mean;
      mean += delta / (block + 1);
      spread += delta * (rate - mean);
    }
    const error = Math.sqrt(spread / Math.max(1, blocks - 1) / blocks);
    return { status: OK, largest: mean, smallest: -2 * damping - mean, error };
  }

  function spectralRadius(m) {
    const half = 0.5 * (m[0] + m[3]);
    const determinant = m[0] * m[3] - m[1] * m[2];
    const square = half * half - determinant;
    return square < 0 ? Math.sqrt(determinant) : Math.abs(half) + Math.sqrt(square);
  }

  return { walkTangent, meanDamping, newton, exponents, spectralRadius };
});
