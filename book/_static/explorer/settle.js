// The settled motion from one start: periodic, aperiodic (a resolved positive exponent), unsettled, floating or escaped.
//
// It is judged as in gearpair/_flow/settle.py, by the same tests and tolerances, and watched as there: a motion that is
// chaotic when its transient ought to be over may end all the same. Two things differ. A motion is captured there as soon
// as it enters a neighbourhood that none leaves; here when it has returned to RETURNED of a stable orbit, which is the
// same orbit some time later. And one that approaches an orbit slowly must do so as fast as its multipliers say.
gearpair.define("settle", ["library", "flow", "tangent", "observe"], function (library, flow, tangent, observe) {
  const { OK, ESCAPED, EVENT_UNDECIDED, startAt, walk } = flow;
  const { walkTangent, meanDamping, newton, exponents, spectralRadius } = tangent;
  const { extremes } = observe;

  const { RETURNED, CAPTURED, STABLE, NEAR, MOST_TRACE, SAME_POINT, RESOLVED, ROUNDING, EXPONENT_BLOCKS } = library.tolerances;
  const DEFAULTS = library.settling;
  const PIECE = 200; // mesh periods between two yields
  const [CYCLES, SURE, MOST_CYCLES] = [20, 10, 2000]; // of an approach: at least, over 1 - |multiplier|, at most

  // Mesh periods that a transient needs to fall to 9 digits at best, flying half of the time.
  function transientPeriods(cells) {
    const rate = 0.5 * (cells.dampingRatio + cells.flightDamping) * cells.period;
    return rate > 0 ? Math.min(Math.max(Math.ceil(20 / rate), 500), 20000) : 500;
  }

  // How far two states lie apart, relative to max(1, |X|, |X'|).
  function distance(p, q) {
    return Math.max(Math.abs(p.x - q.x), Math.abs(p.v - q.v)) / Math.max(1, Math.abs(q.x), Math.abs(q.v));
  }

  // A course is { motion, lasted }: where a motion is, and the mesh periods that it has been followed for. What looks for
  // its end returns { status, orbit, floats }, which is open where the motion goes on.
  const open = ({ status, orbit, floats }) => status === OK && !orbit && !floats;

  function walkOn(cells, course, periods) {
    course.lasted += periods;
    return walk(cells, course.motion, periods);
  }

  // Walk until the motion returns to a stable orbit's neighbourhood, `maxPeriod` periods at most.
  function findReturn(cells, course, maxPeriod, closeness, capture, mostTrace) {
    const { motion } = course;
    const first = { x: motion.x, v: motion.v };
    for (let period = 1; period <= maxPeriod; period++) {
      const status = walkOn(cells, course, 1);
      if (status !== OK) return { status, orbit: null };
      if (distance(motion, first) <= closeness) {
        const orbit = newton(cells, motion.x, motion.v, period, mostTrace);
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

  // Follow a motion for `periods` mesh periods, or until it has returned or floats.
  function* follow(cells, course, periods, maxPeriod) {
    let found = { status: OK, orbit: null };
    for (let done = 0; done < periods && open(found); done += maxPeriod) {
      found = findReturn(cells, course, maxPeriod, RETURNED, CAPTURED, Infinity);
      if (cells.force === 0 && open(found)) found.floats = floats(cells, course.motion);
      yield;
    }
    return found;
  }

  // `findReturn` for slow motions: the stable orbit must come nearer, over many of its cycles.
  function* approached(cells, course, maxPeriod) {
    const found = findReturn(cells, course, maxPeriod, NEAR, NEAR, MOST_TRACE);
    if (open(found) || found.status !== OK) return found;
    const { period, monodromy } = found.orbit;
    const radius = spectralRadius(monodromy);
    const cycles = Math.min(Math.max(CYCLES, Math.ceil(SURE / (1 - radius))), MOST_CYCLES);
    const allowed = Math.max(distance(course.motion, found.orbit) * radius ** (cycles / 2), RETURNED);
    for (let done = 0; done < cycles && found.orbit && found.status === OK; done += CYCLES) {
      found.status = walkOn(cells, course, CYCLES * period);
      if (!(distance(course.motion, found.orbit) <= 2 * NEAR)) found.orbit = null;
      yield;
    }
    if (found.orbit && !(distance(course.motion, found.orbit) <= allowed)) found.orbit = null;
    return found;
  }

  // Whether a motion repeats within the play, as only without a mean force: one of a family, shifted at will.
  function floats(cells, motion) {
    if (cells.dampingRatio === 0 && cells.flightDamping === 0) return false;
    const after = { ...motion };
    const { status, low, high } = extremes(cells, after, 1);
    return status === OK && distance(after, motion) <= RETURNED && low > -1 && high < 1;
  }

  const resolved = ({ largest, error }) => largest > Math.max(RESOLVED * error, ROUNDING);

  function* measure(cells, course, periods) {
    const { motion } = course;
    course.first = { ...motion }; // what is said of a motion that does not repeat is said of the span from here on
    course.lasted += Math.max(1, Math.floor(periods / EXPONENT_BLOCKS)) * (EXPONENT_BLOCKS + 1);
    return yield* exponents(cells, motion, periods, EXPONENT_BLOCKS);
  }

  // Follow the motion from (x, v) until it has settled. A generator that yields between pieces of work, so that others
  // can have their turn; it moves `motion`, which may be looked at between, and returns
  // { status, period, points, monodromy, low, high, force, exponents, error, lasted }, `lasted` the mesh periods followed.
  // While it watches a motion that goes on, for `watch` mesh periods, it yields the same of that, with `watching` true.
  function* settling(cells, motion, options = {}) {
    const { maxPeriod, exponentPeriods, samples, watch } = { ...DEFAULTS, ...options };
    const course = { motion, lasted: 0 };
    let found = yield* follow(cells, course, options.transient ?? transientPeriods(cells), maxPeriod);
    if (open(found)) found = yield* approached(cells, course, maxPeriod);
    if (!open(found)) return conclude(cells, found, course);
    let measured = yield* measure(cells, course, exponentPeriods);
    let said = null;
    let again = false;
    const least = cells.dampingRatio > 0 || cells.flightDamping > 0 ? watch : 0; // without damping nothing settles
    for (let watched = 0; watched < least && measured.status === OK; watched += exponentPeriods) {
      found = yield* follow(cells, course, Math.min(exponentPeriods, least - watched), maxPeriod);
      if (open(found)) found = yield* approached(cells, course, maxPeriod);
      if (!open(found)) return conclude(cells, found, course);
      if (!again && !resolved(measured) && watched + exponentPeriods >= Math.min(DEFAULTS.watch, least)) {
        again = true;
        measured = yield* measure(cells, course, least < DEFAULTS.watch ? exponentPeriods : DEFAULTS.watch);
        said = null;
        continue;
      }
      said ??= yield* passing(cells, course.first, measured, exponentPeriods, samples);
      yield { ...said, lasted: course.lasted, watching: true };
    }
    if (measured.status !== OK) return conclude(cells, { status: measured.status }, course);
    said ??= yield* passing(cells, course.first, measured, exponentPeriods, samples);
    return { ...said, lasted: course.lasted };
  }

  function conclude(cells, { status, orbit, floats: floating }, { motion, lasted }) {
    if (orbit) return { ...periodic(cells, orbit), lasted };
    if (floating) {
      const points = [{ x: motion.x, v: motion.v }];
      const range = extremes(cells, { ...motion }, 1);
      const rates = [0, -2 * cells.flightDamping];
      return { ...range, status: "floating", period: null, points, monodromy: null, exponents: rates, error: 0, lasted };
    }
    const name = status === ESCAPED ? "escaped" : status === EVENT_UNDECIDED ? "undecided" : "capped";
    return { status: name, period: null, points: [], force: NaN, lasted };
  }

  // What a motion that does not repeat is, from `first` on.
  function* passing(cells, first, measured, periods, samples) {
    const status = resolved(measured) ? "aperiodic" : "unsettled";
    const points = sectionPoints(cells, { ...first }, samples);
    const again = { ...first };
    let range;
    for (let done = 0; done < periods; done += PIECE) {
      yield;
      range = extremes(cells, again, Math.min(PIECE, periods - done), range);
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
