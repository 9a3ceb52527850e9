// A run-up: the mesh frequency rises, or falls, slowly under the motion that is shown, which is carried along by the exact
// flow, a step of the frequency each mesh period. What the pair does at a jump is then seen, and written down.
gearpair.define("run_up", ["library", "cells", "flow", "player", "readout"], function (library, tables, flow, player, readout) {
  const STEP = 0.0002; // of the mesh frequency in a mesh period
  const PERIODS = 5; // between two pictures; odd, so that both points of a period 2 are met
  const STILL = { seconds: 0.5, pictures: 20 }; // for those who prefer less motion: a larger step, and seldom
  const JUMP = 1.25; // a load factor that changes by more from one picture to the next jumps
  const [MOST_LINES, MOST_POINTS] = [6, 1500];
  const entry = (wanted) => library.numbers.find(({ name }) => name === wanted);
  const { min: LOWEST, max: HIGHEST } = entry("mesh_frequency");
  const FARTHEST = entry("x").highest;
  const GROWS = "the motion grows without bound";

  class RunUp {
    // `buttons` { up, down } start and stop; `log` is a list, `note` a line; `onStart()` and `onStep(changes)` are told.
    constructor({ buttons, log, note, onStart, onStep }) {
      Object.assign(this, { buttons, log, note, onStart, onStep });
      this.way = 0;
      this.trace = []; // section points passed: { value, x }
      for (const [name, way] of [["up", 1], ["down", -1]]) {
        buttons[name].addEventListener("click", () => (this.way === way ? this.stop("stopped") : this.start(way)));
      }
    }

    // The motion shown is this now.
    show(shown) {
      this.shown = shown;
      if (this.way && shown.status !== "settling") this.write(shown);
    }

    start(way) {
      const { shown } = this;
      if (!shown) return;
      this.stop("stopped");
      const { state, points } = shown;
      if (!points.length) return this.say("There is no motion to carry: this one does not stay bounded.");
      this.motion = { x: points[0].x, v: points[0].v };
      this.state = state;
      this.frequency = state.mesh_frequency;
      if (this.atEnd(way)) return this.say(`The mesh frequency is at its ${way > 0 ? "highest" : "lowest"}.`);
      this.way = way;
      this.waited = 0;
      this.trace = [];
      this.last = null;
      this.log.replaceChildren();
      this.label();
      this.onStart();
      this.write(shown);
      this.say(`${way > 0 ? "Rising" : "Falling"} by ${STEP} a mesh period, ${player.prefersStill() ? "shown in large steps" : "the motion carried along"} …`);
    }

    stop(why) {
      if (!this.way) return;
      this.way = 0;
      this.label();
      this.say(`At mesh frequency ${this.frequency.toFixed(3)}: ${why}.`);
    }

    atEnd(way) {
      return way > 0 ? this.frequency >= HIGHEST : this.frequency <= LOWEST;
    }

    label() {
      this.buttons.up.textContent = this.way > 0 ? "Stop" : "Run up";
      this.buttons.down.textContent = this.way < 0 ? "Stop" : "Run down";
    }

    // A frame has passed, of so many seconds.
    frame(elapsed) {
      if (!this.way) return;
      this.waited += elapsed;
      const still = player.prefersStill();
      if (still && this.waited < STILL.seconds) return;
      this.waited = 0;
      for (let i = 0; i < (still ? STILL.pictures : 1) && this.way; i++) this.carry();
      const { x, v } = this.motion; // where it is now, as a start
      const [value, ...start] = [this.frequency, x, v].map((number) => Number(number.toPrecision(12)));
      this.stepping = true; // a change that is the run's own
      this.onStep({ mesh_frequency: value, x: start[0], v: start[1] });
      this.stepping = false;
    }

    // On by PERIODS mesh periods, each at a mesh frequency of its own.
    carry() {
      for (let i = 0; i < PERIODS && this.way; i++) {
        const next = Math.min(Math.max(this.frequency + this.way * STEP, LOWEST), HIGHEST);
        const cells = tables.buildCells({ ...this.state, mesh_frequency: next });
        const motion = flow.startAt(cells, this.motion.x, this.motion.v);
        const status = flow.walk(cells, motion, 1);
        if (status !== flow.OK || !(Math.max(Math.abs(motion.x), Math.abs(motion.v)) < FARTHEST)) return this.stop(GROWS);
        this.frequency = Number(next.toFixed(4));
        this.motion = motion;
        if (this.atEnd(this.way)) this.stop("the end of the slider");
      }
      this.trace.push({ value: this.frequency, x: this.motion.x });
      if (this.trace.length > MOST_POINTS) this.trace.shift();
    }

    // A line where the motion is another than in the picture before, by its name or by its load.
    write(shown) {
      const { motion, manner, load } = readout.values(shown);
      const name = `${motion}${manner ? `, ${manner}` : ""}`;
      const { last } = this;
      const present = { name, load: shown.loadFactor };
      this.last = present;
      const ratio = last && shown.period ? present.load / last.load : 1;
      if (last && last.name === name && ratio < JUMP && ratio > 1 / JUMP) return;
      const item = document.createElement("li");
      item.textContent = `${shown.state.mesh_frequency.toFixed(3)}: ${name}, load factor ${load}`;
      this.log.append(item);
      if (this.log.children.length > MOST_LINES) this.log.firstChild.remove();
      if (!shown.points.length) this.stop(GROWS);
    }

    say(text) {
      this.note.textContent = text;
    }
  }

  return { RunUp, STEP };
});
