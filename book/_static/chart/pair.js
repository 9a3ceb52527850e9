// A pair of spur gears as it is drawn, and whether it can be cut and can run: gearpair/teeth/spurpair.py and
// spurgear.py with their sentences, for what this page asks of a pair (both gears of one steel, one rack, one width).
gearpair.define("chart/pair", ["chart/numbers", "chart/tooth"], function ({ general }, { ToothProfile, tipClears, inv, undercutEnd }) {
  const ROUNDING = 1e-12;

  function inverseInvolute(value) {
    let angle = value < 1 ? Math.min(Math.cbrt(3 * value), Math.PI / 2 - 1e-3) : Math.atan(value + Math.PI / 2);
    for (let i = 0; i < 60; i++) {
      const step = (inv(angle) - value) / Math.tan(angle) ** 2;
      angle -= step;
      if (Math.abs(step) < 1e-16) break;
    }
    return angle;
  }

  const tipTangent = (gear) => Math.sqrt(gear.tip ** 2 - gear.base ** 2);

  // `sizes`: pinion_teeth, gear_teeth, module_mm, face_width_mm, pressure_angle_deg, addendum, clearance, pinion_shift,
  // gear_shift, bore_ratio, youngs_modulus_gpa, poisson_ratio, in their ranges. Throws a sentence.
  class SpurPair {
    constructor(sizes) {
      Object.assign(this, sizes);
      const alpha = (this.pressure_angle_deg * Math.PI) / 180;
      this.alpha = alpha;
      const depth = this.addendum + this.clearance;
      this.fullRound = ((Math.PI / 4 - depth * Math.tan(alpha)) * Math.cos(alpha)) / (1 - Math.sin(alpha));
      this.tipRadius = Math.min(this.clearance / (1 - Math.sin(alpha)), this.fullRound);
      if (this.fullRound < 0) {
        const deepest = Math.PI / 4 / Math.tan(alpha);
        throw new Error(
          `addendum + clearance = ${general(depth)} makes the rack's tooth pointed: it must be below ${general(deepest)}`,
        );
      }
      this.straightDepth = depth - this.tipRadius * (1 - Math.sin(alpha));
      const arc = depth - this.tipRadius;
      this.tipOffset = Math.max(Math.PI / 4 - arc * Math.tan(alpha) - this.tipRadius / Math.cos(alpha), 0);
      this.basePitch = Math.PI * this.module_mm * Math.cos(alpha);
      this.pinion = this.checkedGear("pinion");
      this.gear = this.checkedGear("gear");
      this.checkMesh();
    }

    get shifts() {
      return this.pinion_shift + this.gear_shift;
    }

    workingAngle() {
      const teeth = this.pinion_teeth + this.gear_teeth;
      if (this.shifts === 0) return this.alpha;
      const involute = inv(this.alpha) + (2 * this.shifts * Math.tan(this.alpha)) / teeth;
      if (involute <= 0) {
        const least = (-inv(this.alpha) * teeth) / (2 * Math.tan(this.alpha));
        throw new Error(
          `pinion_shift + gear_shift must be above ${general(least)} for the pair to mesh at all, got ${general(this.shifts)}`,
        );
      }
      return inverseInvolute(involute);
    }

    // The whole backlash along the line of action from any of three statements of it, in micrometres.
    normalBacklash(backlash, stated) {
      const angle = { circumferential: this.working, thickness: this.alpha }[stated] ?? 0;
      return backlash * Math.cos(angle);
    }

    checkedGear(who) {
      const { alpha, module_mm: m } = this;
      const teeth = this[`${who}_teeth`];
      const shift = this[`${who}_shift`];
      const pitch = (m * teeth) / 2;
      const formTangent = pitch * Math.sin(alpha) - (m * (this.straightDepth - shift)) / Math.sin(alpha);
      const base = pitch * Math.cos(alpha);
      const depth = this.addendum + this.clearance;
      const gear = {
        teeth, alpha, shift, pitch, base, module: m,
        tip: pitch + m * (this.addendum + shift),
        root: pitch - m * (depth - shift),
        bore: this.bore_ratio * pitch,
        form: Math.hypot(base, Math.max(formTangent, 0)),
        filletEnd: alpha,
        arc: m * this.tipRadius,
        depth: m * (depth - this.tipRadius - shift),
        offset: m * this.tipOffset,
        baseHalf: Math.PI / (2 * teeth) + (2 * shift * Math.tan(alpha)) / teeth + inv(alpha),
      };
      gear.rootHalf = Math.PI / teeth - gear.offset / pitch;
      gear.undercut = formTangent < -ROUNDING * pitch;
      if (gear.undercut) [gear.filletEnd, gear.form] = undercutEnd(gear);
      gear.undercut = gear.filletEnd > alpha;
      gear.formTangent = Math.sqrt(Math.max(gear.form ** 2 - base ** 2, 0));
      this.checkGear(who, gear);
      return gear;
    }

    checkGear(who, gear) {
      if (gear.root <= 0 || (gear.undercut && new ToothProfile(gear).leastHalfThickness() <= 0)) {
        throw new Error(
          `${who}_teeth = ${gear.teeth} with ${who}_shift = ${general(gear.shift)} is undercut so far that the teeth are ` +
            "cut off at their roots: take more teeth or more shift",
        );
      }
      if (gear.bore >= gear.root) {
        throw new Error(
          `bore_ratio = ${general(gear.bore / gear.pitch)} puts the ${who}'s bore at or beyond its root circle: ` +
            `it must be below ${general(gear.root / gear.pitch)}`,
        );
      }
      if (gear.tip <= gear.form) {
        throw new Error(
          `the ${who}'s tip circle, radius ${general(gear.tip)} mm, leaves no involute: it must be above ${general(gear.form)} mm`,
        );
      }
      const thickness = 2 * gear.tip * (gear.baseHalf - inv(Math.acos(gear.base / gear.tip)));
      if (thickness <= 0) {
        throw new Error(
          `the ${who}'s teeth are pointed: thickness at the tip is ${general(thickness)} mm and must be above 0; ` +
            "take less addendum or shift",
        );
      }
    }

    checkMesh() {
      this.working = this.workingAngle();
      const reference = (this.module_mm * (this.pinion_teeth + this.gear_teeth)) / 2;
      this.distance = (reference * Math.cos(this.alpha)) / Math.cos(this.working);
      this.line = this.distance * Math.sin(this.working);
      const { pinion, gear, line } = this;
      for (const [who, own, other, mate] of [["pinion", pinion, "gear", gear], ["gear", gear, "pinion", pinion]]) {
        const most = this.distance - mate.root;
        if (own.tip > most * (1 + ROUNDING)) {
          throw new Error(
            `the ${who}'s tip circle reaches the ${other}'s root circle: its radius is ${general(own.tip)} mm and ` +
              `must be at most ${general(most)} mm`,
          );
        }
        const lowest = line - tipTangent(own);
        const form = mate.formTangent;
        if (mate.undercut && lowest < form && !tipClears(mate, own, this.distance)) {
          throw new Error(
            `interference: the ${who}'s tip runs into the undercut root of the ${other}; take less addendum or a smaller ${who}`,
          );
        }
        if (!mate.undercut && lowest < form - ROUNDING * line) {
          throw new Error(
            `interference: the ${who}'s tip meets the ${other} ${general(lowest)} mm along the line of action from ` +
              `the ${other}'s base circle, and the ${other}'s involute begins at ${general(form)} mm`,
          );
        }
      }
      this.contactStart = Math.max(line - tipTangent(gear), pinion.formTangent);
      const end = Math.min(tipTangent(pinion), line - gear.formTangent);
      this.contactRatio = (end - this.contactStart) / this.basePitch;
      if (this.contactRatio < 1) {
        throw new Error(
          `contact ratio is ${general(this.contactRatio)} and must be at least 1: contact would be lost`,
        );
      }
    }
  }

  return { SpurPair };
});
