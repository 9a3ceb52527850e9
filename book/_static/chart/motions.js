// The motions of a drive over its speeds at one phase of its error: runs up and down, other starts, and what the teeth
// bear in each. gearpair/design/charts.py, loads.py and found.py.
gearpair.define(
  "chart/motions",
  ["cells", "flow", "settle", "observe", "verdict", "chart/data", "chart/drive"],
  function (tables, flow, settling, observe, { impactState }, data, { SAMPLES, oscillatorAt }) {
    const CHAOTIC_PERIODS = 200; // over which a motion without a period is measured
    const WATCH = 20000; // mesh periods that it is watched for where time allows
    const SAME_ORBIT = 1e-6;
    const GOLDEN = [0.7548776662466927, 0.5698402909980532];
    const [FLOAT, RARE, HISTORY, ALWAYS, BOTH, UNBOUNDED] = data.losses.slice(1);

    // The motion that a start settles on: { status, period, points, impact, periods, end, ... }.
    function settled(cells, start, watch) {
      const motion = flow.startAt(cells, start.x, start.v);
      const options = { ...data.settle, watch: watch ? WATCH : 0 };
      const found = run(settling.settling(cells, motion, options));
      const periods = found.lasted ?? settling.transientPeriods(cells) + options.exponentPeriods;
      const { status, period, points } = found;
      const bounded = points.length > 0;
      const impact = bounded ? impactState(found.low, found.high) : "";
      return { status, period, points, impact, periods, force: found.force, end: bounded ? { x: motion.x, v: motion.v } : null };
    }

    function run(work) {
      for (;;) {
        const { done, value } = work.next();
        if (done) return value;
      }
    }

    function same(one, other) {
      if (one.status !== other.status || one.period !== other.period) return false;
      const [p] = one.points;
      return one.period === null || other.points.some((q) => Math.max(Math.abs(p.x - q.x), Math.abs(p.v - q.v)) < SAME_ORBIT);
    }

    // What the teeth bear, in SI units; NaN of a motion that did not stay bounded.
    function loadsOf(drive, oscillator, cells, { points, period, force }) {
      if (!points.length) return { meshForce: NaN, toothForce: NaN, factor: NaN, apart: NaN, rate: NaN, velocity: NaN, rms: NaN };
      const [{ x, v }] = points;
      const periods = period ?? CHAOTIC_PERIODS;
      const begin = flow.startAt(cells, x, v);
      let [flying, since] = [0, begin.region === 0 ? 0 : null];
      const { x: xs, crossings } = observe.record(cells, begin, periods, periods * SAMPLES);
      let [impacts, fastest] = [0, 0];
      for (const { time, velocity, contact } of crossings) {
        if (!contact) since = time;
        else {
          flying += time - since;
          since = null;
          impacts += 1;
          fastest = Math.max(fastest, Math.abs(velocity));
        }
      }
      if (since !== null) flying += periods - since;
      const most = period === null ? observe.extremes(cells, flow.startAt(cells, x, v), periods).force : force;
      let [sum, square, tooth] = [0, 0, 0];
      for (let i = 0; i < xs.length; i++) {
        const turn = (2 * Math.PI * (i % SAMPLES)) / SAMPLES + oscillator.error_phase;
        const moved = xs[i] + oscillator.error_amplitude * Math.sin(turn);
        sum += moved;
        square += moved * moved;
        tooth = Math.max(tooth, Math.max(Math.abs(xs[i]) - 1, 0) * drive.most[i % SAMPLES]);
      }
      const [mean, perSecond] = [sum / xs.length, (oscillator.mesh_frequency * drive.natural) / (2 * Math.PI)];
      return {
        meshForce: most * drive.unitForce,
        toothForce: tooth * drive.unitForce,
        factor: most / oscillator.mean_force,
        apart: Math.min(Math.max(flying / periods, 0), 1),
        rate: (impacts / periods) * perSecond,
        velocity: fastest * drive.half * drive.natural * 1e3, // mm/s
        rms: Math.sqrt(Math.max(square / xs.length - mean * mean, 0)) * drive.half * 1e6, // um
      };
    }

    // How contact is lost among motions of which the first is the run up's and number `down` the run down's.
    function lossOf(states, down) {
      const struck = states.map(({ impact }) => impact === "single_drive" || impact === "single_coast");
      const has = (name) => states.some(({ impact }) => impact === name);
      if (has("")) return UNBOUNDED;
      if (has("double")) return BOTH;
      if (struck[0] && struck[down]) return ALWAYS;
      if (struck[0] || struck[down]) return HISTORY;
      if (struck.includes(true)) return RARE;
      return has("never_in_contact") ? FLOAT : "";
    }

    // All motions of one speed: each once, the run up's first.
    function gathered(drive, oscillator, cells, up, down, started) {
      const states = [up];
      const place = (state) => {
        const known = states.findIndex((other) => same(other, state));
        return known >= 0 ? known : states.push(state) - 1;
      };
      const reached = place(down);
      started.forEach(place);
      const motions = states.map((state) => {
        const { status, period, impact, periods } = state;
        return { status, period, impact, periods, start: state.points[0] ?? null, ...loadsOf(drive, oscillator, cells, state) };
      });
      const forces = motions.map(({ toothForce }) => (Number.isNaN(toothForce) ? Infinity : toothForce));
      return { motions, down: reached, worst: forces.indexOf(Math.max(...forces)), loss: lossOf(states, reached) };
    }

    // Starts spread evenly over a rectangle about the backlash and the static deflection.
    function spreadStarts({ mean_force }, count) {
      const size = Math.max(1, mean_force);
      const [low, high] = [[-1 - size, -1.5 * size], [1 + 3 * size, 1.5 * size]];
      return Array.from({ length: count }, (_, i) => {
        const [x, v] = GOLDEN.map((step, k) => low[k] + ((0.5 + (i + 1) * step) % 1) * (high[k] - low[k]));
        return { x, v };
      });
    }

    // The rows { i, ...gathered } of a phase, one by one as they are known; with `nStarts`, what has no period is watched
    // for longer, as the library does. Nothing stands for "still at work".
    function* rows({ drive, speeds, phase, nStarts }) {
      const at = speeds.map((rpm) => oscillatorAt(drive, rpm, phase));
      const first = { x: 1 + at[0].mean_force, v: 0 };
      const runs = [[], []];
      for (const [k, way] of [at.keys(), [...at.keys()].reverse()].entries()) {
        let start = first;
        for (const i of way) {
          runs[k][i] = settled(tables.buildCells(at[i]), start, nStarts > 0);
          start = runs[k][i].end ?? first;
          yield null;
        }
      }
      for (const [i, oscillator] of at.entries()) {
        const cells = tables.buildCells(oscillator);
        const started = [];
        for (const start of spreadStarts(oscillator, nStarts)) {
          started.push(settled(cells, start, true));
          yield null;
        }
        yield { i, ...gathered(drive, oscillator, cells, runs[0][i], runs[1][i], started) };
      }
    }

    return { rows };
  },
);
