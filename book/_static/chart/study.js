// One drive under study: 41 speeds at once, then 121, then other starts; on demand with damping halved and doubled.
// What is known so far is in `chart`, the columns of "chart/verdict".
gearpair.define(
  "chart/study",
  ["chart/data", "chart/drive", "chart/worker", "chart/verdict", "chart/standards"],
  function (data, { speedsOf, phasesOf }, { Pool }, { columnsOf, verdictOf }, { isoFactors }) {
    const COARSE = 41;
    const STAGES = [
      { count: COARSE, nStarts: 0, words: `${COARSE} speeds` },
      { count: data.n_speeds, nStarts: 0, words: `${data.n_speeds} speeds` },
      { count: data.n_speeds, nStarts: data.n_starts, words: `${data.n_starts} other starts at each` },
    ];
    const PAUSE = 400; // milliseconds between two pictures while other starts come in
    const DAMPINGS = [0.5, 2];

    class Study {
      // `onNews()` whenever there is something new to show.
      constructor(onNews) {
        this.onNews = onNews;
        this.pool = new Pool((about, answer) => this.take(about, answer));
        this.wantsBand = false;
      }

      start(drive) {
        this.pool.clear();
        this.drive = drive;
        this.phases = phasesOf(drive);
        this.done = new Set(); // of stages
        this.share = 0; // of the stage under way
        this.shown = null;
        this.linear = null;
        this.band = null;
        this.begin(0);
      }

      begin(stage) {
        this.stage = stage;
        const { count, nStarts } = STAGES[stage];
        const speeds = speedsOf(this.drive, count);
        this.seen = this.phases.map((_, k) => (nStarts ? [...this.shown.seen[k]] : []));
        this.rest = this.phases.length * count;
        this.share = 0;
        this.pool.add(this.phases.map((phase, k) => ({ drive: this.drive, speeds, phase, nStarts, about: { stage, k, speeds } })));
      }

      take(about, { batch, linear, done }) {
        if (linear) {
          this.linear = { speeds: about.speeds, factors: linear };
          this.onNews();
        } else if (about.band !== undefined) this.takeBand(about, batch);
        else this.takeRows(about, batch, done);
      }

      takeRows({ stage, k, speeds }, batch, done) {
        for (const { i, ...found } of batch) this.seen[k][i] = found;
        this.rest -= batch.length;
        this.share = 1 - this.rest / (this.phases.length * speeds.length);
        const whole = this.rest === 0;
        if (whole) this.done.add(stage);
        // Of the first look every phase that is known is shown, of a finer one all at once, of other starts each.
        const known = this.seen.filter((row) => row.length === speeds.length && !row.includes(undefined));
        const due = stage === 2 && performance.now() - this.shownAt > PAUSE;
        if (whole || (stage === 0 && done && known.length) || due) this.show(speeds, whole ? this.seen : known);
        if (whole && stage < STAGES.length - 1) this.begin(stage + 1);
        if (whole && stage === 1 && this.wantsBand) this.askBand();
        this.onNews();
      }

      show(speeds, seen) {
        this.shownAt = performance.now();
        const phases = seen === this.seen ? this.phases : this.phases.filter((_, k) => seen.includes(this.seen[k]));
        const chart = columnsOf(this.drive, speeds, phases, seen);
        const iso = isoFactors(this.drive, speeds);
        const before = this.shown?.chart;
        this.shown = { chart, iso, seen, told: verdictOf(chart, iso.factors) };
        const phase = phases[chart.chosen];
        if (before && before.speeds.length === speeds.length && before.phases[before.chosen] === phase && this.linear) return;
        this.pool.queue.unshift({ linear: true, drive: this.drive, speeds, phase, about: { speeds } });
      }

      // The largest factor with half and with twice the damping, at the speeds of the first look.
      askBand() {
        this.wantsBand = true;
        if (this.band || !this.done.has(1)) return;
        const speeds = speedsOf(this.drive, COARSE);
        this.band = { speeds, factors: DAMPINGS.map(() => new Array(COARSE).fill(1)), rest: 2 * this.phases.length * COARSE };
        const orders = DAMPINGS.flatMap((times, band) =>
          this.phases.map((phase) => {
            const drive = { ...this.drive, damping_ratio: times * this.drive.damping_ratio };
            return { drive, speeds, phase, nStarts: 0, about: { band } };
          }),
        );
        this.pool.queue.unshift(...orders);
        this.pool.next();
      }

      takeBand({ band }, batch) {
        for (const { i, motions } of batch) {
          for (const { factor } of motions) if (factor > this.band.factors[band][i]) this.band.factors[band][i] = factor;
        }
        this.band.rest -= batch.length;
        this.onNews();
      }

      // How far it is, in words.
      get progress() {
        const { band } = this;
        const share = band ? Math.floor(100 * (1 - band.rest / (2 * this.phases.length * COARSE))) : 0;
        return this.stageWords + (this.wantsBand && share < 100 ? `; damping halved and doubled: ${share} %` : "");
      }

      get stageWords() {
        if (this.done.size === STAGES.length) return `${STAGES[2].words} of ${STAGES[1].words} and ${this.phaseWords}: done`;
        return `${STAGES[this.stage].words}, ${this.phaseWords}: ${Math.floor(100 * this.share)} %`;
      }

      get phaseWords() {
        return this.phases.length > 1 ? `${this.phases.length} phases of the error` : "no error, so no phase";
      }
    }

    return { Study };
  },
);
