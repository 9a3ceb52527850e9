// Numbers as the library has them: Gauss and Legendre's rule, small linear systems, and Python's ways to write a number.
gearpair.define("chart/numbers", [], function () {
  const rules = new Map();

  // { nodes, weights } of Gauss and Legendre's rule with n nodes on [-1, 1], rising: Newton's method on P_n.
  function gauss(n) {
    if (rules.has(n)) return rules.get(n);
    const nodes = new Float64Array(n);
    const weights = new Float64Array(n);
    for (let i = 0; i < n; i++) {
      let x = -Math.cos((Math.PI * (i + 0.75)) / (n + 0.5));
      let slope = 1;
      for (let step = 0; step < 100; step++) {
        let [before, value] = [1, x];
        for (let k = 2; k <= n; k++) [before, value] = [value, ((2 * k - 1) * x * value - (k - 1) * before) / k];
        slope = (n * (x * value - before)) / (x * x - 1);
        const move = value / slope;
        x -= move;
        if (Math.abs(move) < 1e-16) break;
      }
      nodes[i] = x;
      weights[i] = 2 / ((1 - x * x) * slope * slope);
    }
    rules.set(n, { nodes, weights });
    return rules.get(n);
  }

  // The Legendre polynomials P_0 to P_(n-1) at x.
  function legendre(n, x) {
    const values = new Float64Array(n);
    for (let k = 0; k < n; k++) {
      values[k] = k === 0 ? 1 : k === 1 ? x : ((2 * k - 1) * x * values[k - 1] - (k - 1) * values[k - 2]) / k;
    }
    return values;
  }

  // Solve `rows` x = `rights`, both arrays of rows, in place; the solution stands in `rights` (Gauss, largest pivot).
  function solve(rows, rights) {
    const n = rows.length;
    for (let k = 0; k < n; k++) {
      let best = k;
      for (let i = k + 1; i < n; i++) if (Math.abs(rows[i][k]) > Math.abs(rows[best][k])) best = i;
      [rows[k], rows[best]] = [rows[best], rows[k]];
      [rights[k], rights[best]] = [rights[best], rights[k]];
      for (let i = 0; i < n; i++) {
        if (i === k || rows[i][k] === 0) continue;
        const share = rows[i][k] / rows[k][k];
        for (let j = k; j < n; j++) rows[i][j] -= share * rows[k][j];
        for (let j = 0; j < rights[i].length; j++) rights[i][j] -= share * rights[k][j];
      }
    }
    for (let k = 0; k < n; k++) for (let j = 0; j < rights[k].length; j++) rights[k][j] /= rows[k][k];
    return rights;
  }

  const even = (value) => 2 * Math.round(value / 2);

  // As Python's f"{value:.{digits}f}": a half goes to the even neighbour.
  function fixed(value, digits) {
    const scaled = value * 10 ** digits;
    const half = Number.isInteger(value * 2 ** 20) && Number.isInteger(2 * scaled) && !Number.isInteger(scaled);
    return (half ? even(scaled) / 10 ** digits : value).toFixed(digits);
  }

  // As Python's f"{value:.{digits}g}".
  function general(value, digits = 6) {
    if (!Number.isFinite(value)) return Number.isNaN(value) ? "nan" : value > 0 ? "inf" : "-inf";
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    const power = Number(exponent);
    const bare = (text) => (text.includes(".") ? text.replace(/\.?0+$/, "") : text);
    if (power < -4 || power >= digits) return `${bare(mantissa)}e${powerOf(power)}`;
    return bare(value.toFixed(Math.max(0, digits - 1 - power)));
  }

  // As Python's repr of a float.
  function repr(value) {
    if (!Number.isFinite(value)) return general(value);
    const [mantissa, exponent] = value.toExponential().split("e");
    const power = Number(exponent);
    if (power < -4 || power >= 16) return `${mantissa}e${powerOf(power)}`;
    const text = String(value);
    return text.includes(".") ? text : `${text}.0`;
  }

  const powerOf = (power) => `${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;

  // `count` values from `first` to `last` at equal steps.
  function linspace(first, last, count) {
    const step = (last - first) / (count - 1);
    return Array.from({ length: count }, (_, i) => (i === count - 1 ? last : first + i * step));
  }

  return { gauss, legendre, solve, fixed, general, repr, linspace };
});
