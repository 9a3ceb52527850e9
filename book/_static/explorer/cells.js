// The mesh period of one oscillator cut into cells, with everything that does not depend on the state.
//
// On a cell spent in one region (coast-side contact -1, free flight 0, drive-side contact 1) the state at its end is
// an affine function of the state at its start. The cells of gearpair/_flow/cells.py for an error of one harmonic.
gearpair.define("cells", ["library", "closed_form"], function ({ tolerances }, closedForm) {
  const { DEGREE, TERMS, REACH, fastestRate, fillBasis, fourthDerivativeBound, sineCosine } = closedForm;

  // Columns of `maps`: x1 = XX x + XV v + X0, v1 = VX x + VV v + V0, and the spread
  // SX |x - s| + SV |v| + S0 >= max |w^4 X''''| / 384 over the cell.
  const [XX, XV, X0, VX, VV, V0, SX, SV, S0] = [0, 1, 2, 3, 4, 5, 6, 7, 8];
  const COLUMNS = 9;
  const { ESCAPE_RADIUS } = tolerances;

  // The article's rectangle: 1 + a on the first part of the mesh period, 1 - b on the rest.
  function rectangle({ contact_ratio, a, b, reading }) {
    const stiff = reading === "swapped" ? 2 - contact_ratio : contact_ratio - 1;
    return { edges: [0, stiff, 1], levels: [1 + a, 1 - b] };
  }

  // `oscillator`: mean_force, error_amplitude, error_phase, damping_ratio, mesh_frequency and either `edges` (from 0
  // to 1) with `levels`, or contact_ratio, a, b and reading; flight_damping where free flight has a damping of its own.
  function buildCells(oscillator) {
    const { mean_force, error_amplitude, error_phase, damping_ratio, mesh_frequency } = oscillator;
    const flightDamping = oscillator.flight_damping ?? damping_ratio;
    const { edges, levels } = oscillator.levels ? oscillator : rectangle(oscillator);
    const period = (2 * Math.PI) / mesh_frequency;
    const counts = levels.map((kappa, i) => {
      const rate = Math.max(fastestRate(kappa, damping_ratio, mesh_frequency), 2 * flightDamping);
      return Math.max(1, Math.ceil(((edges[i + 1] - edges[i]) * period * rate) / REACH));
    });
    const size = counts.reduce((sum, count) => sum + count, 0);
    const growth = contactGrowth(edges, levels, damping_ratio, period);
    const cells = {
      size,
      period,
      dampingRatio: damping_ratio,
      flightDamping,
      force: mean_force,
      stiffness: levels,
      width: new Float64Array(size),
      start: new Float64Array(size), // in mesh periods
      sine: new Float64Array(size), // the forcing there
      cosine: new Float64Array(size),
      level: new Int32Array(size),
      maps: new Float64Array(size * 3 * COLUMNS),
      bases: [], // for level i free flight at 2 i, contact at 2 i + 1; 5 rows of TERMS each
      fourths: [], // bounds of their fourth derivatives
      growth, // of a disturbance in a mesh period, while the teeth stay in contact
      escapeRadius: growth > 1 ? ESCAPE_RADIUS : Infinity,
    };
    const amplitude = error_amplitude * mesh_frequency * mesh_frequency;
    let j = 0;
    for (let i = 0; i < levels.length; i++) {
      const span = (edges[i + 1] - edges[i]) / counts[i];
      const width = span * period;
      for (const [kappa, zeta] of [[0, flightDamping], [levels[i], damping_ratio]]) {
        const basis = new Float64Array(5 * TERMS);
        fillBasis(kappa, zeta, mesh_frequency, width, basis);
        cells.bases.push(basis);
        cells.fourths.push(Float64Array.from({ length: 5 }, (_, k) => fourthDerivativeBound(basis, 1, k * TERMS)));
      }
      for (let m = 0; m < counts[i]; m++, j++) {
        const theta = 2 * Math.PI * (edges[i] + m * span) + error_phase;
        cells.width[j] = width;
        cells.start[j] = edges[i] + m * span;
        const [sine, cosine] = sineCosine(theta);
        cells.sine[j] = amplitude * sine;
        cells.cosine[j] = amplitude * cosine;
        cells.level[j] = i;
        for (let region = -1; region <= 1; region++) fillMap(cells, j, region);
      }
    }
    return cells;
  }

  // The larger multiplier's modulus of the always-in-contact motion over a mesh period (Floquet).
  function contactGrowth(edges, levels, zeta, period) {
    let [xx, xv, vx, vv] = [1, 0, 0, 1];
    for (let i = 0; i < levels.length; i++) {
      const span = (edges[i + 1] - edges[i]) * period;
      const square = levels[i] - zeta * zeta;
      const rate = Math.sqrt(Math.abs(square));
      let [c, s] = [1, span];
      if (square > 0) [c, s] = [Math.cos(rate * span), Math.sin(rate * span) / rate];
      else if (square < 0) [c, s] = [Math.cosh(rate * span), Math.sinh(rate * span) / rate];
      const [p, q, r, t] = [c + zeta * s, s, (-square - zeta * zeta) * s, c - zeta * s];
      [xx, xv, vx, vv] = [p * xx + q * vx, p * xv + q * vv, r * xx + t * vx, r * xv + t * vv];
    }
    const half = 0.5 * Math.abs(xx + vv);
    return (half + Math.sqrt(Math.max(half * half - 1, 0))) * Math.exp(-zeta * period);
  }

  function fillMap(cells, j, region) {
    const at = 2 * cells.level[j] + Math.abs(region);
    const basis = cells.bases[at];
    const fourths = cells.fourths[at];
    const [width, sine, cosine] = [cells.width[j], cells.sine[j], cells.cosine[j]];
    const x = new Float64Array(5);
    const v = new Float64Array(5);
    for (let k = 0; k < 5; k++) {
      for (let n = DEGREE; n >= 0; n--) {
        x[k] += basis[k * TERMS + n];
        v[k] += (n * basis[k * TERMS + n]) / width;
      }
    }
    const row = (3 * j + region + 1) * COLUMNS;
    const maps = cells.maps;
    maps[row + XX] = x[0];
    maps[row + XV] = x[1];
    maps[row + VX] = v[0];
    maps[row + VV] = v[1];
    maps[row + X0] = x[2] * cells.force + x[3] * sine + x[4] * cosine + region * (1 - x[0]);
    maps[row + V0] = v[2] * cells.force + v[3] * sine + v[4] * cosine - region * v[0];
    maps[row + SX] = fourths[0] / 384;
    maps[row + SV] = fourths[1] / 384;
    const forced = fourths[2] * Math.abs(cells.force) + fourths[3] * Math.abs(sine) + fourths[4] * Math.abs(cosine);
    maps[row + S0] = forced / 384;
  }

  return { XX, XV, X0, VX, VV, V0, SX, SV, S0, COLUMNS, buildCells, rectangle };
});
