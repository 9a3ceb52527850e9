// The outline of half a tooth: the fillet that the rack cuts, then the involute. gearpair/teeth/tooth_profile.py with
// the trochoid root. y runs along the tooth's centre line from the gear's centre, h is half the thickness; in modules.
gearpair.define("chart/tooth", ["chart/numbers"], function ({ linspace }) {
  const FRACTIONS = linspace(0, 1, 401); // along a fillet
  const TOUCH = 1e-4; // modules by which a tip may seem to run into a fillet, which is given by points

  const inv = (angle) => Math.tan(angle) - angle;

  class ToothProfile {
    constructor(gear) {
      const m = gear.module;
      this.gear = gear;
      this.base = gear.base / m;
      this.clampRadius = gear.root / m;
      this.clampHalf = gear.rootHalf;
      this.radiusRatio = gear.bore ? gear.root / gear.bore : Infinity;
      this.firstRoll = Math.sqrt(Math.max((gear.form / gear.base) ** 2 - 1, 0));
    }

    // [y, h, dy, dh] at a roll angle, with derivatives by it.
    involute(t) {
      const angle = this.gear.baseHalf - t;
      const [s, c] = [Math.sin(angle), Math.cos(angle)];
      const r = this.base;
      return [r * (c - t * s), r * (s + t * c), r * t * c, r * t * s];
    }

    // The same from the root circle (fraction 0) to the involute (1): the law of gearing for the rack's tip arc.
    fillet(fraction) {
      const { gear } = this;
      const m = gear.module;
      const [pitch, rho, depth, offset] = [gear.pitch / m, gear.arc / m, gear.depth / m, gear.offset / m];
      const rate = gear.filletEnd - Math.PI / 2;
      const gamma = Math.PI / 2 + rate * fraction;
      const [s, c] = [Math.sin(gamma), Math.cos(gamma)];
      const along = (depth * c) / s + rho * c;
      const below = pitch - depth - rho * s;
      const dAlong = -depth / s ** 2 - rho * s;
      const dBelow = -rho * c;
      const turn = ((depth * c) / s - offset) / pitch + Math.PI / gear.teeth;
      const dTurn = -depth / s ** 2 / pitch;
      const [sinTurn, cosTurn] = [Math.sin(turn), Math.cos(turn)];
      const y = along * sinTurn + below * cosTurn;
      const h = below * sinTurn - along * cosTurn;
      const dy = dAlong * sinTurn + dBelow * cosTurn - h * dTurn;
      const dh = dBelow * sinTurn - dAlong * cosTurn + y * dTurn;
      return [y, h, rate * dy, rate * dh];
    }

    leastHalfThickness() {
      return Math.min(...FRACTIONS.map((fraction) => this.fillet(fraction)[1]));
    }
  }

  // Radius and angle from the tooth's centre line of the fillet's point whose normal is at `gamma`; in millimetres.
  function filletPoint(gear, gamma) {
    const along = gear.depth / Math.tan(gamma) + gear.arc * Math.cos(gamma);
    const below = gear.pitch - gear.depth - gear.arc * Math.sin(gamma);
    const turn = (gear.depth / Math.tan(gamma) - gear.offset) / gear.pitch + Math.PI / gear.teeth;
    return [Math.hypot(along, below), turn - Math.atan2(along, below)];
  }

  // Where the fillet of an undercut gear meets its involute: [gamma, radius], by bisection.
  function undercutEnd(gear) {
    const thicker = (gamma) => {
      const [radius, angle] = filletPoint(gear, gamma);
      return radius > gear.base && angle > gear.baseHalf - inv(Math.acos(gear.base / radius));
    };
    let [low, high] = [gear.alpha, Math.PI / 2];
    for (let i = 0; i < 60; i++) {
      const middle = 0.5 * (low + high);
      if (thicker(middle)) low = middle;
      else high = middle;
    }
    return [low, filletPoint(gear, low)[0]];
  }

  // Whether the corner at the mate's tip stays outside the gear's fillet on its whole way through the space.
  function tipClears(gear, mate, distance) {
    const tooth = new ToothProfile(gear);
    const working = Math.acos((gear.base + mate.base) / distance);
    const lowest = distance * Math.sin(working) - Math.sqrt(mate.tip ** 2 - mate.base ** 2);
    const roll = lowest / gear.base;
    const reach = distance / gear.module;
    const towards = gear.baseHalf - roll + working;
    const [cx, cy] = [reach * Math.cos(towards), reach * Math.sin(towards)];
    const [y, h] = tooth.involute(roll);
    const fillet = FRACTIONS.map((fraction) => tooth.fillet(fraction));
    const radii = fillet.map(([y, h]) => Math.hypot(y, h));
    const angles = fillet.map(([y, h]) => Math.atan2(h, y));
    for (const part of linspace(-1, 1, 4001)) {
      const turn = (part * Math.PI) / gear.teeth;
      const own = turn * (1 + gear.teeth / mate.teeth);
      const [a, b] = [Math.cos(turn), Math.sin(turn)];
      const [c, d] = [Math.cos(own), Math.sin(own)];
      const px = a * cx - b * cy + c * (y - cx) - d * (h - cy);
      const py = b * cx + a * cy + d * (y - cx) + c * (h - cy);
      const reached = Math.hypot(px, py);
      if (!(radii[0] < reached && reached < radii.at(-1))) continue;
      if (!(reached * (Math.atan2(py, px) - interpolated(reached, radii, angles)) > -TOUCH)) return false;
    }
    return true;
  }

  // The value at x of a broken line with rising corners.
  function interpolated(x, corners, values) {
    let [low, high] = [0, corners.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (corners[middle] <= x) low = middle;
      else high = middle;
    }
    return values[low] + ((values[high] - values[low]) * (x - corners[low])) / (corners[high] - corners[low]);
  }

  return { ToothProfile, tipClears, inv, undercutEnd };
});
