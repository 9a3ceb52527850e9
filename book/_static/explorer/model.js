// The motion that the page shows: settled in pieces of some milliseconds, described for the pictures, and watched on.
gearpair.define(
  "model",
  ["library", "cells", "flow", "settle", "observe", "measures", "verdict"],
  function (library, tables, flow, settle, observe, measures, verdict) {
    const SHOWN = 8; // mesh periods of a time history, about
    const SAMPLES = 2048; // of a recorded motion; a power of two, for its spectrum
    const LONG = { periods: 16, samples: 8192 }; // a cycle longer than this takes more of them
    const SPECTRUM_PERIODS = 64; // under the spectrum of a motion that does not repeat
    const SETTINGS = { samples: 1200, watch: 1_000_000 };
    const NOTHING = { frequency: [], amplitude: [] };
    const PASSING = { status: "settling", name: "settling", title: "settling", lines: false };
    const [NEARER, ASIDE] = [[0.5, 0.2, 0], [0, 1e-6, -1e-6]]; // of an escaped start, tried; all must stay, lest it be by chance

    class Model {
      // Take a new gear pair and start; nothing is computed yet.
      reset(state) {
        this.state = state;
        this.cells = tables.buildCells(state);
        this.motion = flow.startAt(this.cells, state.x, state.v);
        this.work = settle.settling(this.cells, this.motion, SETTINGS);
        this.settled = null; // the verdict so far
        this.done = false;
      }

      // Go on for `budget` milliseconds, or until there is a first verdict; whether there is one. Its motion may be
      // watched on by further calls, until `done`.
      advance(budget) {
        const end = performance.now() + budget;
        while (!this.done) {
          const { done, value } = this.work.next();
          const first = !this.settled;
          if (value) this.settled = value;
          this.done = done;
          if ((value && first) || performance.now() > end) break;
        }
        return this.settled !== null;
      }

      // The motion as it is now, and what the verdict says of it; what did not stay bounded has neither points nor lines.
      describe() {
        const { cells, settled } = this;
        if (!settled) return this.passing();
        const { status, period, points, lasted, watching } = settled;
        const name = verdict.motionName(status, period);
        const damped = cells.dampingRatio > 0 || cells.flightDamping > 0;
        const said = { state: this.state, status, name, title: verdict.title(settled), period, points, lasted, watching, damped };
        if (!points.length) {
          const [growth, nearer] = status === "escaped" ? [cells.growth, this.nearer()] : [];
          return { ...said, growth, nearer, recorded: this.beginning(), spectrum: NOTHING };
        }
        const repeats = status === "floating" ? 1 : period; // after so many mesh periods, or null
        const periods = repeats ? repeats * Math.max(1, Math.round(SHOWN / repeats)) : SHOWN;
        this.rewind();
        return {
          ...said,
          repeats,
          recorded: observe.record(cells, this.player, periods, periods > LONG.periods ? LONG.samples : SAMPLES),
          spectrum: this.spectrum(repeats, points[0]),
          lines: repeats !== null,
          low: settled.low,
          high: settled.high,
          impact: verdict.impactState(settled.low, settled.high),
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

      // A start nearer to the play whose motion stays bounded, or null where all that are tried escape.
      nearer() {
        for (const share of NEARER) {
          const [x, v] = [this.state.x, this.state.v].map((value) => Number((share * value).toPrecision(3)));
          const stays = (aside) => settle.settle(this.cells, x + aside, v, { watch: 0 }).status !== "escaped";
          if (ASIDE.every(stays)) return { x, v };
        }
        return null;
      }

      // A motion that has not settled yet, from where it has got to.
      passing() {
        const passing = { ...PASSING, state: this.state };
        const start = { ...this.motion };
        const recorded = observe.record(this.cells, start, SHOWN, SAMPLES);
        const points = Array.from({ length: SHOWN }, (_, i) => ({
          x: recorded.x[(i * SAMPLES) / SHOWN],
          v: recorded.v[(i * SAMPLES) / SHOWN],
        }));
        if (recorded.status !== flow.OK) return { ...passing, points: [], recorded: this.beginning(), spectrum: NOTHING };
        return { ...passing, points, recorded, spectrum: measures.spectrum(recorded.x, SHOWN, true) };
      }

      spectrum(repeats, { x, v }) {
        const periods = repeats ?? SPECTRUM_PERIODS;
        const count = periods > LONG.periods ? LONG.samples : SAMPLES;
        const { x: samples } = observe.record(this.cells, flow.startAt(this.cells, x, v), periods, count);
        return measures.spectrum(samples, periods, repeats === null);
      }

      // The stretches played of a motion that does not repeat are of the span that its verdict was measured on.
      rewind() {
        const [{ x, v }] = this.settled.points;
        this.player = flow.startAt(this.cells, x, v);
        this.played = 0;
      }

      // The next stretch of it.
      next() {
        if (this.played + 2 * SHOWN > library.settling.exponentPeriods) this.rewind();
        this.played += SHOWN;
        return observe.record(this.cells, this.player, SHOWN, SAMPLES);
      }
    }

    return { Model };
  },
);
