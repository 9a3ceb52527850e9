// The settled motion from one start: periodic, aperiodic (a resolved positive exponent), unsettled or escaped.
//
// It is judged as in gearpair/_flow/settle.py, by the same tests and tolerances. Until then a motion is captured there as
// soon as it enters a neighbourhood that none leaves; here when it has returned to RETURNED of a stable orbit, which is
// the same orbit some time later.
gearpair.define("settle", ["flow", "tangent", "observe"], function (flow, tangent, observe) {
  const { OK, ESCAPED, startAt, walk } = flow;
  const { walkTangent, meanDamping, newton, exponents, spectralRadius } = tangent;
  const { extremes } = observe;

  const [RETURNED, CAPTURED] = [1e-8, 1e-6];
  const STABLE = 1 - 1e-9;
  const NEAR = 1e-2;
  const SAME_POINT = 1e-9;
  const RESOLVED = 4;
  const EXPONENT_BLOCKS = 20;
  const PIECE = 200; // mesh periods between two chances to draw
  const DEFAULTS = { maxPeriod: 64, exponentPeriods: 2000, samples: 256 };

  // Mesh periods that a transient needs to fall to 9 digits at best, flying half of the time.
  function transientPeriods(cells) {
    const rate = 0.5 * (cells.dampingRatio + cells.flightDamping) * cells.period;
    return rate > 0 ? Math.min(Math.max(Math.ceil(20 / rate), 500), 20000) : 500;
  }

  // How far two states lie apart, relative to max(1, |X|, |X'|).
  function distance(p, q) {
    return Math.max(Math.abs(p.x - q.x), Math.abs(p.v - q.v)) / Math.max(1, Math.abs(q.x), Math.abs(q.v));
  }

  // Walk until the motion returns to a stable orbit's neighbourhood: { status, orbit }, the orbit null where it did
  // not within `maxPeriod` periods.
  function findReturn(cells, motion, maxPeriod, closeness, capture) {
    const first = { x: motion.x, v: motion.v };
    for (let period = 1; period <= maxPeriod; period++) {
      const status = walk(cells, motion, 1);
      if (status !== OK) return { status, orbit: null };
      if (distance(motion, first) <= closeness) {
        const orbit = newton(cells, motion.x, motion.v, period);
        if (orbit.converged && spectralRadius(orbit.monodromy) < STABLE && distance(motion, orbit) <= capture) {
          return { status: OK, orbit: shortest(cells, orbit, period) };
        }
      }
    }
    return { status: OK, orbit: null };
  }

  // The orbit with its minimal period and the monodromy matrix of that.
  function shortest(cells, orbit, period) {
    const motion = startAt(cells, orbit.x, orbit.v);
    for (let shorter = 1; shorter < period; shorter++) {
      walk(cells, motion, 1);
      if (period % shorter === 0 && distance(motion, orbit) <= SAME_POINT) {
        const monodromy = new Float64Array([1, 0, 0, 1]);
        walkTangent(cells, startAt(cells, orbit.x, orbit.v), shorter, monodromy);
        return { ...orbit, period: shorter, monodromy };
      }
    }
    return { ...orbit, period };
  }

  // `findReturn` for slow motions: the stable orbit must come nearer over twenty of its cycles.
  function approached(cells, motion, maxPeriod) {
    const found = findReturn(cells, motion, maxPeriod, NEAR, NEAR);
    if (found.orbit) {
      const before = distance(motion, found.orbit);
      found.status = walk(cells, motion, 20 * found.orbit.period);
      if (found.status !== OK || distance(motion, found.orbit) > Math.max(before, RETURNED)) found.orbit = null;
    }
    return found;
  }

  // Follow the motion from (x, v) until it has settled. A generator that yields between pieces of work, so that a page
  // can go on drawing; it moves `motion`, which may be looked at between, and returns
  // { status, period, points, monodromy, low, high, force, exponents, error }.
  function* settling(cells, motion, options = {}) {
    const { maxPeriod, exponentPeriods, samples } = { ...DEFAULTS, ...options };
    const transient = options.transient ?? transientPeriods(cells);
    let found = { status: OK, orbit: null };
    let measured = null;
    for (let done = 0; done < transient && !found.orbit && found.status === OK; done += maxPeriod) {
      found = findReturn(cells, motion, maxPeriod, RETURNED, CAPTURED);
      yield;
    }
    if (!found.orbit && found.status === OK) found = approached(cells, motion, maxPeriod);
    if (!found.orbit && found.status === OK) {
      measured = yield* exponents(cells, motion, exponentPeriods, EXPONENT_BLOCKS);
      found.status = measured.status;
      if (measured.status === OK && !(measured.largest > RESOLVED * measured.error)) {
        found = approached(cells, motion, maxPeriod);
      }
    }
    if (found.status !== OK) {
      return { status: found.status === ESCAPED ? "escaped" : "capped", period: null, points: [], force: NaN };
    }
    if (found.orbit) return periodic(cells, found.orbit);
    const status = measured.largest > RESOLVED * measured.error ? "aperiodic" : "unsettled";
    const again = { ...motion };
    const points = sectionPoints(cells, motion, samples);
    let range;
    for (let done = 0; done < exponentPeriods; done += PIECE) {
      yield;
      range = extremes(cells, again, Math.min(PIECE, exponentPeriods - done), range);
    }
    const { largest, smallest, error } = measured;
    return { ...range, status, period: null, points, monodromy: null, exponents: [largest, smallest], error };
  }

  // The cycle, from its smallest X on the section.
  function periodic(cells, orbit) {
    const points = sectionPoints(cells, startAt(cells, orbit.x, orbit.v), orbit.period);
    const first = points.reduce((best, point, i) => (point.x < points[best].x ? i : best), 0);
    points.push(...points.splice(0, first));
    const { period, monodromy } = orbit;
    const range = extremes(cells, startAt(cells, points[0].x, points[0].v), period);
    const largest = Math.log(spectralRadius(monodromy)) / (period * cells.period);
    const damping = meanDamping(cells, orbit.x, orbit.v, period);
    const exponents = [largest, -2 * damping - largest];
    return { ...range, status: "periodic", period, points, monodromy, exponents, error: 0 };
  }

  function sectionPoints(cells, motion, count) {
    const points = [];
    for (let i = 0; i < count; i++) {
      points.push({ x: motion.x, v: motion.v });
      walk(cells, motion, 1);
    }
    return points;
  }

  // `settling` run to its end.
  function settle(cells, x, v, options) {
    const work = settling(cells, startAt(cells, x, v), options);
    for (;;) {
      const { done, value } = work.next();
      if (done) return value;
    }
  }

  return { settling, settle, transientPeriods };
});
