// The motion that the page shows: settled in pieces of a few milliseconds, then recorded.
gearpair.define("model", ["cells", "flow", "settle", "observe", "measures"], function (tables, flow, settle, observe, measures) {
  const SHOWN = 8; // mesh periods of a time history, about
  const SAMPLES = 2048; // of a recorded motion; a power of two, for its spectrum
  const LONG = { periods: 16, samples: 8192 }; // a cycle longer than this takes more of them
  const SPECTRUM_PERIODS = 64; // under the spectrum of a motion that does not repeat
  const SETTINGS = { samples: 1200 };
  const NOTHING = { frequency: [], amplitude: [] };
  const PASSING = { status: "settling", name: "settling", lines: false };

  class Model {
    // Take a new gear pair and start; nothing is computed yet.
    reset(state) {
      this.state = state;
      this.cells = tables.buildCells(state);
      this.motion = flow.startAt(this.cells, state.x, state.v);
      this.work = settle.settling(this.cells, this.motion, SETTINGS);
      this.settled = null;
    }

    // Go on settling for `budget` milliseconds; whether that has come to its end.
    advance(budget) {
      const end = performance.now() + budget;
      while (!this.settled) {
        const { done, value } = this.work.next();
        if (done) this.settled = value;
        else if (performance.now() > end) return false;
      }
      return true;
    }

    // The motion as it is now: { status, name, points, recorded, spectrum, ... }; what did
    // not stay bounded has neither points nor lines.
    describe() {
      const { cells, settled } = this;
      if (!settled) return this.passing();
      const { status, period, points } = settled;
      const name = measures.motionName(status, period);
      if (!points.length) return { status, name, points, recorded: this.beginning(), spectrum: NOTHING };
      const first = flow.startAt(cells, points[0].x, points[0].v);
      const periods = period ? period * Math.max(1, Math.round(SHOWN / period)) : SHOWN;
      this.player = first;
      const recorded = observe.record(cells, first, periods, periods > LONG.periods ? LONG.samples : SAMPLES);
      return {
        status,
        name,
        period,
        points,
        recorded,
        spectrum: this.spectrum(period, points[0]),
        lines: period !== null,
        low: settled.low,
        high: settled.high,
        impact: measures.impactState(settled.low, settled.high),
        loadFactor: measures.loadFactor(settled.force, cells.force),
        multipliers: settled.monodromy && measures.multipliers(settled.monodromy),
        exponent: settled.exponents[0],
        error: settled.error,
      };
    }

    // How a motion that does not stay bounded sets out.
    beginning() {
      const { x, v } = this.state;
      const [long, brief] = [SHOWN, 1].map((n) => observe.record(this.cells, flow.startAt(this.cells, x, v), n, SAMPLES));
      return long.status === flow.OK ? long : brief;
    }

    // A motion that has not settled yet, from where it has got to.
    passing() {
      const start = { ...this.motion };
      const recorded = observe.record(this.cells, start, SHOWN, SAMPLES);
      const points = Array.from({ length: SHOWN }, (_, i) => ({
        x: recorded.x[(i * SAMPLES) / SHOWN],
        v: recorded.v[(i * SAMPLES) / SHOWN],
      }));
      if (recorded.status !== flow.OK) return { ...PASSING, points: [], recorded: this.beginning(), spectrum: NOTHING };
      return { ...PASSING, points, recorded, spectrum: measures.spectrum(recorded.x, SHOWN, true) };
    }

    spectrum(period, { x, v }) {
      const periods = period ?? SPECTRUM_PERIODS;
      const count = periods > LONG.periods ? LONG.samples : SAMPLES;
      const { x: samples } = observe.record(this.cells, flow.startAt(this.cells, x, v), periods, count);
      return measures.spectrum(samples, periods, period === null);
    }

    // The next stretch of a motion that does not repeat.
    next() {
      return observe.record(this.cells, this.player, SHOWN, SAMPLES);
    }
  }

  return { Model };
});
