// The gear body as an elastic ring held at its bore, or a solid disc: what a load on one tooth does to its own foot and
// to its neighbours'. gearpair/teeth/gear_body.py without the twist of the whole body, which belongs to the shaft.
gearpair.define("chart/body", ["chart/numbers"], function ({ gauss, solve }) {
  const HARMONICS = 400; // of an ordinary gear, at least
  const WAVES = 36; // n theta_f where the series ends

  // For each of `angles` from the loaded tooth to the watched one a matrix of 3 x 3, times E b, lengths in root radii:
  // along the rim, along the tooth, turning; rows are displacements, columns loads.
  function ringCompliance(radiusRatio, halfAngle, angles, nu) {
    const { order, count } = orders(halfAngle);
    const { nodes, weights } = gauss(Math.max(32, Math.trunc(order.at(-1) * halfAngle)));
    const theta = nodes.map((node) => halfAngle * node);
    const weight = weights.map((each) => halfAngle * each);
    const loads = loadsOf(theta, weight, halfAngle);
    const matrices = ringHarmonics(radiusRatio, nu, order);
    const result = angles.map(() => [0, 1, 2].map(() => [0, 0, 0]));
    const [re, im] = [new Float64Array(6), new Float64Array(6)];
    order.forEach((n, place) => {
      components(n, theta, weight, loads, re, im);
      const [[a, b], [c, d]] = matrices[place];
      const size = 2 * Math.PI * (place === 0 ? 1 : 2 * count[place]);
      for (let row = 0; row < 3; row++) {
        for (let column = 0; column < 3; column++) {
          const [r0, i0, r1, i1] = [re[column], im[column], re[3 + column], im[3 + column]];
          const [m0, n0, m1, n1] = [a * r0 + b * r1, a * i0 + b * i1, c * r0 + d * r1, c * i0 + d * i1];
          const real = re[row] * m0 + im[row] * n0 + re[3 + row] * m1 + im[3 + row] * n1;
          const imaginary = re[row] * n0 - im[row] * m0 + re[3 + row] * n1 - im[3 + row] * m1;
          angles.forEach((angle, k) => {
            const turn = n * angle;
            result[k][row][column] += size * (Math.cos(turn) * real + Math.sin(turn) * imaginary);
          });
        }
      }
    });
    return result;
  }

  // [radial, tangential] pressures of the three loads at the nodes: a unit force along the rim, one along the tooth, a
  // unit moment; the force spread evenly over the arc, the moment linearly.
  function loadsOf(theta, weight, halfAngle) {
    const height = Math.sin(halfAngle) / halfAngle;
    const even = 1 / (2 * halfAngle);
    let [square, moment] = [0, 0];
    theta.forEach((angle, i) => {
      square += weight[i] * Math.sin(angle) ** 2;
      moment += weight[i] * (Math.cos(angle) - height) * even;
    });
    const linear = theta.map((angle) => Math.sin(angle) / square);
    const xs = [() => even, () => 0, () => 0];
    const ys = [(i) => linear[i] * moment, () => even, (i) => linear[i]];
    return [0, 1, 2].map((k) => {
      const radial = theta.map((angle, i) => xs[k](i) * Math.sin(angle) + ys[k](i) * Math.cos(angle));
      const tangential = theta.map((angle, i) => xs[k](i) * Math.cos(angle) - ys[k](i) * Math.sin(angle));
      return [radial, tangential];
    });
  }

  // The three loads at order n as (p_r, i p_theta): real and imaginary parts, the first three radial.
  function components(n, theta, weight, loads, re, im) {
    re.fill(0);
    im.fill(0);
    for (let i = 0; i < theta.length; i++) {
      const c = (weight[i] * Math.cos(n * theta[i])) / (2 * Math.PI);
      const s = (weight[i] * Math.sin(n * theta[i])) / (2 * Math.PI);
      for (let k = 0; k < 3; k++) {
        re[k] += c * loads[k][0][i];
        im[k] -= s * loads[k][0][i];
        re[3 + k] += s * loads[k][1][i]; // i (c - i s) = s + i c
        im[3 + k] += c * loads[k][1][i];
      }
    }
  }

  // Orders from 0 on, and how many orders each stands for.
  function orders(halfAngle) {
    const last = Math.max(HARMONICS, Math.ceil(WAVES / halfAngle));
    const order = Array.from({ length: Math.min(last, 2 * HARMONICS) + 1 }, (_, n) => n);
    const count = order.map(() => 1);
    for (let n = order.length - 1; n < last; ) {
      const size = Math.max(1, Math.min(Math.floor(n / 50), Math.trunc(0.02 / halfAngle), last - n));
      order.push(n + (size + 1) / 2);
      count.push(size);
      n += size;
    }
    return { order, count };
  }

  // Compliance of the rim at each order, (u_r, i u_theta) from (p_r, i p_theta), rim radius 1: modes r^(+-n+-1) of
  // Michell's solution, with the logarithm at n = 1.
  function ringHarmonics(radiusRatio, nu, order) {
    const inner = 1 / radiusRatio;
    const shear = 1 / (2 * (1 + nu));
    const plane = 1 / (1 - nu ** 2);
    const [stretch, hoop] = [1 + inner ** 2, 1 - inner ** 2];
    const results = [[[hoop / (plane * (stretch + nu * hoop)), 0], [0, 0]]];
    for (const n of order.slice(1)) {
      const powers = [n + 1, n - 1, 1 - n, -1 - n];
      const ratio = powers.map((p) => -(plane * (p * p - 1) - shear * n * n) / (n * (plane * (p * nu - 1) + shear * (p - 1))));
      ratio[1] = -1;
      if (n === 1) ratio[2] = -(1 + nu) / (3 - nu);
      const rim = mode(1, n, powers, ratio, inner, nu, plane, shear);
      if (inner > 0) {
        const bore = mode(inner, n, powers, ratio, inner, nu, plane, shear);
        const system = [bore.f, bore.g, rim.normal, rim.sliding];
        const [x0, x1, x2, x3] = solve(system, [[0, 0], [0, 0], [1, 0], [0, 1]]);
        const joined = (row, k) => row[0] * x0[k] + row[1] * x1[k] + row[2] * x2[k] + row[3] * x3[k];
        results.push([[joined(rim.f, 0), joined(rim.f, 1)], [joined(rim.g, 0), joined(rim.g, 1)]]);
      } else results.push(solid(n, rim, nu, plane, shear));
    }
    return results;
  }

  // A solid disc, which nothing holds: at n = 1 uniform forces balance the load, relative to the mean displacement.
  function solid(n, { f, g, normal, sliding }, nu, plane, shear) {
    if (n === 1) {
      [f[1], g[1], normal[1], sliding[1]] = [1, 0, plane * (2 + nu), -shear];
    }
    const [x0, x1] = solve([normal.slice(0, 2), sliding.slice(0, 2)], [[1, 0], [0, 1]]);
    const moved = [f, g].map((row) => [0, 1].map((k) => row[0] * x0[k] + row[1] * x1[k]));
    if (n !== 1) return moved;
    const shift = [0, 1].map((k) => (moved[0][k] - moved[1][k]) / 4);
    return [moved[0].map((value, k) => value - shift[k]), moved[1].map((value, k) => value + shift[k])];
  }

  // Displacements f, g and stresses of the four modes at a radius. Growing modes are 1 at the rim, the others at the bore.
  function mode(radius, n, powers, ratio, inner, nu, plane, shear) {
    const size = powers.map((p) => (p > 0 ? radius : inner / radius) ** Math.abs(p));
    const f = [...size];
    const g = size.map((each, i) => ratio[i] * each);
    const stretch = powers.map((p, i) => p * size[i]);
    const hoop = f.map((each, i) => each + n * g[i]);
    const slide = powers.map((p, i) => -n * f[i] + (p - 1) * g[i]);
    if (n === 1) {
      const log = Math.log(radius);
      [f[2], g[2]] = [log, ratio[2] - log];
      [stretch[2], hoop[2], slide[2]] = [1, ratio[2], -1 - ratio[2]];
    }
    const normal = stretch.map((each, i) => (plane * (each + nu * hoop[i])) / radius);
    const sliding = slide.map((each) => (shear * each) / radius);
    return { f, g, normal, sliding };
  }

  return { ringCompliance };
});
