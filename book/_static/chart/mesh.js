// The mesh stiffness of a pair over the mesh period, and the inertias of its gears: gearpair/teeth/compliance.py,
// meshing.py with pairs that share their gear bodies (coupling "ring"), and blank.py for solid discs.
gearpair.define(
  "chart/mesh",
  ["chart/numbers", "chart/tooth", "chart/body"],
  function ({ gauss, legendre, solve }, { ToothProfile }, { ringCompliance }) {
    const SHEAR_FACTOR = 1.2;
    const ALONG = 32; // nodes on a root curve and on an involute
    const NODES = 24; // over a zone of the mesh period
    const N_PHASES = 1000; // samples of the load share that the library keeps
    const STEEL = 7850; // kg/m^3

    // Bending, shear and axial compression of a tooth loaded at a roll angle, together, times E b.
    function toothCompliance(tooth, roll, nu) {
      const slope = roll - tooth.gear.baseHalf;
      const [c, s] = [Math.cos(slope), Math.sin(slope)];
      const { nodes, weights } = gauss(ALONG);
      let [bending, thickness] = [0, 0];
      const length = roll - tooth.firstRoll;
      for (let i = 0; i < ALONG; i++) {
        const fraction = (1 + nodes[i]) / 2;
        for (const [[y, h, dy], span] of [[tooth.fillet(fraction), 1], [tooth.involute(tooth.firstRoll + length * fraction), length]]) {
          const moment = tooth.base - y * c;
          bending += ((span * weights[i]) / 2) * ((1.5 * moment ** 2) / h ** 3) * dy;
          thickness += (((span * weights[i]) / 2) * dy) / h;
        }
      }
      return bending + SHEAR_FACTOR * (1 + nu) * c * c * thickness + (s * s * thickness) / 2;
    }

    const hertzCompliance = (nu) => (4 * (1 - nu ** 2)) / Math.PI;

    // A unit force on the flank as the load on the root that the ring knows.
    function rootLoad(tooth, roll) {
      const slope = roll - tooth.gear.baseHalf;
      const middle = Math.sin(tooth.clampHalf) / tooth.clampHalf;
      const arm = tooth.base / tooth.clampRadius / Math.cos(slope) - middle;
      return [-Math.cos(slope), -Math.sin(slope), Math.cos(slope) * arm];
    }

    function pushed(load, matrix, watched) {
      let sum = 0;
      for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) sum += load[i] * matrix[i][j] * watched[j];
      return sum;
    }

    class Model {
      constructor(pair) {
        this.pair = pair;
        this.nu = pair.poisson_ratio;
        this.unit = pair.youngs_modulus_gpa * 1e9 * (pair.face_width_mm * 1e-3);
        this.reach = Math.floor(pair.contactRatio) + 1;
        this.sides = ["pinion", "gear"].map((who) => {
          const tooth = new ToothProfile(pair[who]);
          const angles = Array.from({ length: this.reach }, (_, i) => ((2 * Math.PI) / tooth.gear.teeth) * i);
          return { who, tooth, bodies: ringCompliance(tooth.radiusRatio, tooth.clampHalf, angles, this.nu) };
        });
      }

      // Roll angle of the contact on one gear, for a position in mesh periods since entry.
      roll(who, position) {
        const onPinion = this.pair.contactStart + position * this.pair.basePitch;
        return who === "pinion" ? onPinion / this.pair.pinion.base : (this.pair.line - onPinion) / this.pair.gear.base;
      }

      // Force on each of `count` pairs for unit approach, in N/m.
      shared(phase, count) {
        const matrix = Array.from({ length: count }, () => new Array(count).fill(0));
        for (const { who, tooth, bodies } of this.sides) {
          const rolls = matrix.map((_, i) => this.roll(who, phase + i));
          const loads = rolls.map((roll) => rootLoad(tooth, roll));
          for (let i = 0; i < count; i++) {
            const own = toothCompliance(tooth, rolls[i], this.nu) + hertzCompliance(this.nu) / 2;
            matrix[i][i] += (own + pushed(loads[i], bodies[0], loads[i])) / this.unit;
            for (let j = 0; j < i; j++) {
              const [early, late] = who === "pinion" ? [i, j] : [j, i];
              const push = pushed(loads[early], bodies[i - j], loads[late]) / this.unit;
              matrix[i][j] += push;
              matrix[j][i] += push;
            }
          }
        }
        return solve(matrix, matrix.map(() => [1])).map(([force]) => force);
      }
    }

    // The curve between two changes of the number of pairs as Legendre series of the forces on the pairs.
    function zoneOf(model, left, right, count) {
      const { nodes, weights } = gauss(NODES);
      const series = Array.from({ length: count }, () => new Float64Array(NODES));
      for (let i = 0; i < NODES; i++) {
        const forces = model.shared(left + ((right - left) * (1 + nodes[i])) / 2, count);
        const values = legendre(NODES, nodes[i]);
        for (let p = 0; p < count; p++) {
          for (let k = 0; k < NODES; k++) series[p][k] += (k + 0.5) * weights[i] * forces[p] * values[k];
        }
      }
      const total = series[0].map((_, k) => series.reduce((sum, each) => sum + each[k], 0));
      return { left, right, count, series, total };
    }

    // The integral of the whole curve of a zone from its left end to `at`.
    function primitive({ left, right, total }, at) {
      const x = (2 * (at - left)) / (right - left) - 1;
      const values = legendre(NODES + 1, x);
      let sum = 0;
      total.forEach((c, k) => {
        sum += k === 0 ? c * (x + 1) : (c * (values[k + 1] - values[k - 1])) / (2 * k + 1);
      });
      return (sum * (right - left)) / 2;
    }

    // Mean stiffness in N/m, the staircase of mean 1, and the largest share of the force that a pair of teeth carries at
    // `samples` equal steps of the mesh period.
    function meshStiffness(pair, nLevels, samples) {
      const model = new Model(pair);
      const ratio = pair.contactRatio;
      const whole = Math.floor(ratio + 1e-12);
      const part = ratio - whole > 1e-12 ? ratio - whole : 0;
      const spans = [[0, part, whole + 1], [part, 1, whole]].filter(([left, right]) => right > left);
      const zones = spans.map((span) => zoneOf(model, ...span));
      const mean = zones.reduce((sum, zone) => sum + primitive(zone, zone.right), 0);
      return { mean, ...staircase(zones, nLevels, mean), share: loadShare(zones, part, samples) };
    }

    function staircase(zones, nLevels, mean) {
      const width = zones[0].right - zones[0].left;
      const first = Math.min(Math.max(even(nLevels * width), 1), nLevels - zones.length + 1);
      const counts = zones.length === 1 ? [first] : [first, nLevels - first];
      const [edges, levels] = [[], []];
      zones.forEach((zone, z) => {
        const at = (i) => (i === counts[z] ? zone.right : zone.left + (i * (zone.right - zone.left)) / counts[z]);
        for (let i = 0; i < counts[z]; i++) {
          edges.push(at(i));
          levels.push((primitive(zone, at(i + 1)) - primitive(zone, at(i))) / (at(i + 1) - at(i)) / mean);
        }
      });
      return { edges: [...edges, 1], levels };
    }

    // As Python rounds: a half to the even neighbour.
    const even = (value) => (value % 1 === 0.5 ? 2 * Math.round(value / 2) : Math.round(value));

    function loadShare(zones, part, samples) {
      return Float64Array.from({ length: samples }, (_, i) => {
        const phase = Math.trunc((i / samples) * N_PHASES) / N_PHASES;
        const zone = phase < part ? zones[0] : zones.at(-1);
        const values = legendre(NODES, (2 * (phase - zone.left)) / (zone.right - zone.left) - 1);
        const forces = zone.series.map((series) => series.reduce((sum, c, k) => sum + c * values[k], 0));
        return Math.max(...forces) / forces.reduce((sum, force) => sum + force, 0);
      });
    }

    // Moment of inertia of a solid disc of steel with its teeth as they are cut, in kg m^2.
    function inertia(gear, width) {
      const tooth = new ToothProfile(gear);
      const last = Math.sqrt((gear.tip / gear.base) ** 2 - 1);
      const { nodes, weights } = gauss(ALONG);
      let teeth = 0;
      for (const [outline, start, end] of [["fillet", 0, 1], ["involute", tooth.firstRoll, last]]) {
        for (let i = 0; i < ALONG; i++) {
          const [y, h, dy, dh] = tooth[outline](start + 0.5 * (end - start) * (1 + nodes[i]));
          teeth += 0.5 * (end - start) * weights[i] * Math.atan2(h, y) * (y * y + h * h) * (y * dy + h * dh);
        }
      }
      const moment = 0.5 * Math.PI * (gear.root ** 4 - gear.bore ** 4) + 2 * gear.teeth * teeth * gear.module ** 4;
      return width * moment * STEEL * 1e-15;
    }

    return { meshStiffness, inertia };
  },
);
