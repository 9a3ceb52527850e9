// A minute's story in five steps that the reader drives: quiet, apart, which side, a nudge, and both to hear.
//
// What a step shows is settled here, and its sentences follow what is found; only speeds and nudges are chosen. Fills
// every element of class gp-story.
gearpair.define(
  "story",
  ["state", "cells", "flow", "settle", "observe", "measures", "player", "plot", "teeth", "sounds", "listen"],
  function (states, tables, flow, settle, observe, measures, player, plotting, teeth, sounds, listen) {
    const SLOW = 0.25; // mesh frequencies, in natural frequencies
    const FASTER = 0.45; // where the second step's slider ends
    const FAST = 0.7; // the baseline's
    const NUDGE = 1.5; // where the slider of nudges stands at first: of X', and it goes to MOST either way
    const MOST = 2;
    const TRANSIENT = 2; // mesh periods that are shown of what follows a nudge
    const SHOWN = 8; // mesh periods, about, of a settled motion
    const SAMPLES = 2048;
    const SAME_SPEED = 1; // natural frequencies a second: how fast time runs in the picture

    const WORDS = {
      quiet: "the teeth stay together",
      rattle: "one flank is struck: it rattles",
      clatter: "both flanks are struck: it clatters",
    };
    const number = (value, digits = 2) => plotting.sign(Number(value.toPrecision(digits)));

    // The settled motion from (x, v) at a mesh frequency, the rest as in the baseline.
    function found(mesh_frequency, x = states.DEFAULTS.x, v = states.DEFAULTS.v) {
      const state = { ...states.DEFAULTS, mesh_frequency, x, v };
      const cells = tables.buildCells(state);
      const settled = settle.settle(cells, x, v, {});
      const { low, high, force, period, points } = settled;
      const periods = period ? period * Math.max(1, Math.round(SHOWN / period)) : SHOWN;
      const recorded = observe.record(cells, flow.startAt(cells, points[0].x, points[0].v), periods, SAMPLES);
      const beginning = observe.record(cells, flow.startAt(cells, x, v), TRANSIENT, SAMPLES);
      return {
        state, settled, recorded, beginning, low, high,
        manner: low >= 1 ? "quiet" : low >= -1 ? "rattle" : "clatter", // the load holds it to the drive side
        loadFactor: measures.loadFactor(force, state.mean_force),
      }; // prettier-ignore
    }

    const withForce = (motion) => `${WORDS[motion.manner]}, with ${number(motion.loadFactor)} times the mean force`;
    const apart = ({ low }) => low < 1;
    const hitsTheOther = ({ low }) => low < -1;
    const address = ({ state }) => `explorer.html#mesh_frequency=${state.mesh_frequency}&x=${state.x}&v=${state.v}`;

    const STEPS = [
      {
        title: "Push gently",
        text: "The upper gear drives the lower one to the right, with a little play between their teeth.",
        act: (story) => story.button("Push", () => story.show(found(SLOW))),
        verdict: (story, motion) =>
          apart(motion)
            ? `Even so slowly ${WORDS[motion.manner]}.`
            : `Quiet: ${WORDS[motion.manner]}. The largest tooth force is ${number(motion.loadFactor)} times the mean.`,
        done: () => true,
      },
      {
        title: "Raise the speed",
        text: "Until the tooth leaves its flank:",
        act: (story) => {
          story.show(found(SLOW));
          const entry = { label: "Speed", min: SLOW, max: FASTER, step: 0.01, value: SLOW };
          story.slider(entry, (value) => story.show(found(value)), (value) => `${number(value)} of the resonance`);
        },
        verdict: (story, motion) =>
          apart(motion)
            ? `The teeth part, and meet again with a blow: ${number(motion.loadFactor)} times the mean force.`
            : "At this speed the teeth stay together.",
        done: (story, motion) => (story.parted ||= apart(motion)),
      },
      {
        title: "Predict",
        text: `Faster still, at ${FAST} of the resonance: will the tooth hit the other side?`,
        act: (story) => {
          story.answer = null;
          story.show(found(FASTER));
          for (const answer of ["Yes", "No"]) {
            story.button(answer, () => {
              story.answer = answer;
              story.show(story.first());
            });
          }
        },
        verdict: (story, motion) => {
          if (!story.answer) return "";
          const right = hitsTheOther(motion) === (story.answer === "Yes");
          const turns = `It turns back after ${(50 * (1 - motion.low)).toFixed(0)}% of the play`; // from X = 1 to −1
          const what = hitsTheOther(motion) ? "It does hit the other side" : turns;
          return `${right ? "Right." : "Not so."} ${what}. So ${withForce(motion)}.`;
        },
        done: (story) => story.answer !== null,
      },
      {
        title: "Nudge it",
        text: "The same speed, the same load. Push the upper tooth out of its rattle: here, or drag it sideways and let go.",
        act: (story) => {
          story.show(story.first());
          const entry = { label: "Push", min: -MOST, max: MOST, step: 0.1, value: NUDGE };
          const toSide = (value) => `${number(Math.abs(value))} ${value < 0 ? "to the left" : "to the right"}`;
          story.nudge = story.slider(entry, () => {}, toSide);
          story.button("Nudge", () => story.push(story.nudge.valueAsNumber));
        },
        verdict: (story, motion) => {
          if (!story.pushed) return "";
          if (motion.manner === story.first().manner) return "It comes back to what it did. Try another push.";
          return `One push, and now ${withForce(motion)}. By itself it does not go back.`;
        },
        done: (story) => Boolean(story.other),
      },
      {
        title: "Listen to both",
        text: "Tooth force as sound, not your gearbox.",
        act: (story) => {
          const both = story.both();
          const heard = both.map(({ state, settled }) =>
            sounds.sound(state, settled, listen.NATURAL.value * state.mesh_frequency),
          );
          story.listener.compare(...heard);
          both.forEach((motion, i) => {
            story.button(`Hear the ${motion.manner}`, () => {
              story.listener.wake();
              story.listener.hear(heard[i]);
              story.show(motion);
            });
          });
          story.button("Silence", () => story.listener.stop());
          const louder = story.listener.level(heard[1]) - story.listener.level(heard[0]);
          story.louder = `The ${both[1].manner} is ${louder < 0 ? "softer" : "louder"} by ${Math.abs(louder).toFixed(0)} dB.`;
          story.show(both[1]);
        },
        verdict: (story) =>
          `${story.louder} See them in the explorer: ` +
          `${story.both().map((motion) => `<a href="${address(motion)}">the ${motion.manner}</a>`).join(", ")}.`,
        done: () => false,
      },
    ];

    const FRAME = `<div class="gp-both">
<div class="gp-stage"><canvas role="img" aria-label="A tooth of the driving gear, above, in the space between two teeth of the driven gear, below"></canvas>
<span class="gp-above">driving gear</span><span class="gp-below">driven gear</span>
<span class="gp-side gp-left">coast side</span><span class="gp-side gp-right">drive side</span></div>
<div class="gp-tell"><p class="gp-count"></p><p class="gp-title" tabindex="-1"></p><p class="gp-text"></p><div class="gp-act"></div>
<p class="gp-verdict" role="status"></p>
<div class="gp-ways"><button type="button" data-way="-1">Back</button><button type="button" data-way="1">Next</button>
<button type="button" data-way="still">Pause</button></div></div></div>`;

    class Story {
      constructor(root) {
        this.root = root;
        const fold = root.closest("details");
        if (fold && location.hash.length > 1) fold.open = false; // who follows a link to a motion comes for that
        root.classList.add("gp");
        root.innerHTML = FRAME;
        this.find = (selector) => root.querySelector(selector);
        this.canvas = this.find("canvas");
        this.listener = new listen.Listener(() => this.motion && this.tell());
        this.known = new Map();
        this.playing = !player.prefersStill();
        this.time = 0;
        for (const button of root.querySelectorAll("[data-way]")) {
          const way = button.dataset.way;
          button.addEventListener("click", () => {
            if (way === "still") return this.play(!this.playing);
            this.go(this.step + Number(way));
            this.find(".gp-title").focus({ preventScroll: true }); // from there Tab leads through the step
          });
        }
        this.canvas.addEventListener("pointerdown", (event) => this.grip(event));
        const refresh = () => this.refresh();
        new ResizeObserver(refresh).observe(root);
        new MutationObserver(refresh).observe(document.documentElement, { attributeFilter: ["data-theme"] });
        new IntersectionObserver(([{ isIntersecting }]) => (this.visible = isIntersecting)).observe(root);
        this.play(this.playing);
        this.go(0);
        requestAnimationFrame((now) => this.frame(now));
      }

      // The motion at full speed from the start of the baseline, and with it the one that the nudge led to.
      first() {
        if (!this.known.has(FAST)) this.known.set(FAST, found(FAST));
        return this.known.get(FAST);
      }

      both() {
        return [this.first(), this.other ?? this.first()];
      }

      go(step) {
        this.listener.stop();
        this.step = step;
        this.motion = null;
        this.pushed = false;
        const { title, text, act } = STEPS[step];
        this.find(".gp-count").textContent = `${step + 1} of ${STEPS.length}`;
        this.find(".gp-title").textContent = title;
        this.find(".gp-text").textContent = text;
        this.find(".gp-act").replaceChildren();
        this.find(".gp-verdict").textContent = "";
        this.find("[data-way='-1']").disabled = step === 0;
        this.find("[data-way='1']").disabled = true;
        this.find("[data-way='1']").hidden = step === STEPS.length - 1;
        act(this);
        this.refresh();
      }

      button(label, action) {
        const button = document.createElement("button");
        button.type = "button";
        button.textContent = label;
        button.addEventListener("click", action);
        this.find(".gp-act").append(button);
      }

      slider({ label, min, max, step, value }, action, told) {
        const row = document.createElement("label");
        row.innerHTML = `${label} <output></output><input type="range" min="${min}" max="${max}" step="${step}" value="${value}">`;
        const [output, range] = row.children;
        const show = () => {
          output.textContent = told(range.valueAsNumber);
          range.setAttribute("aria-valuetext", output.textContent);
        };
        range.addEventListener("input", () => {
          show();
          action(range.valueAsNumber);
        });
        show();
        this.find(".gp-act").append(row);
        return range;
      }

      // Show a motion from now on; after a nudge, the way to it first.
      show(motion, transient = false) {
        const speed = this.motion?.state.mesh_frequency;
        this.motion = motion;
        this.arriving = transient && this.playing;
        if (speed !== motion.state.mesh_frequency || transient) this.time = 0;
        this.time %= this.record().periods;
        if (this.arriving) this.find(".gp-verdict").textContent = "…";
        else this.tell();
        this.draw();
      }

      record() {
        return this.arriving ? this.motion.beginning : this.motion.recorded;
      }

      tell() {
        const { verdict, done } = STEPS[this.step];
        const text = verdict(this, this.motion).trim();
        this.find(".gp-verdict").innerHTML = text.charAt(0).toUpperCase() + text.slice(1);
        this.find("[data-way='1']").disabled = !done(this, this.motion);
      }

      // A push by hand: the velocity of the tooth changes at once, where it passes the start of a mesh period.
      push(velocity) {
        const { x, v } = this.first().settled.points[0];
        const motion = found(FAST, Number(x.toFixed(4)), Number((v + velocity).toFixed(4)));
        this.pushed = true;
        if (motion.manner !== this.first().manner) this.other = motion;
        this.show(motion, true);
      }

      // The tooth taken by the pointer: how far it is drawn is how hard it is pushed.
      grip({ clientX, pointerId }) {
        if (!this.nudge?.isConnected) return;
        this.canvas.setPointerCapture(pointerId);
        const begin = clientX;
        const reach = 0.25 * this.canvas.clientWidth;
        const draw = (event) => {
          this.nudge.value = (MOST * (event.clientX - begin)) / reach;
          this.nudge.dispatchEvent(new Event("input"));
        };
        const loose = () => {
          this.canvas.removeEventListener("pointermove", draw);
          if (this.nudge?.isConnected && this.nudge.valueAsNumber !== 0) this.push(this.nudge.valueAsNumber);
        };
        this.canvas.addEventListener("pointermove", draw);
        this.canvas.addEventListener("pointerup", loose, { once: true });
      }

      play(playing) {
        this.playing = playing;
        this.find("[data-way=still]").textContent = playing ? "Pause" : "Play";
        if (!playing && this.arriving) this.show(this.motion);
      }

      refresh() {
        plotting.forgetSizes();
        this.theme = plotting.readTheme(this.root);
        this.draw();
      }

      draw() {
        if (!this.theme) return;
        const rate = SAME_SPEED * (this.motion?.state.mesh_frequency ?? SLOW);
        const now = this.motion ? player.at(this.record(), this.time, rate) : { x: 1, force: 1, impact: null };
        const mean = states.DEFAULTS.mean_force;
        teeth.drawTeeth(this.canvas, this.theme, { ...now, force: this.motion ? now.force / mean : 1 }, false);
      }

      frame(now) {
        const elapsed = Math.min(now - (this.last ?? now), 100) / 1000;
        this.last = now;
        if (this.playing && this.visible && this.motion) {
          this.time += elapsed * SAME_SPEED * this.motion.state.mesh_frequency;
          if (this.time >= this.record().periods) {
            this.time = 0;
            if (this.arriving) this.show(this.motion);
          }
          this.draw();
        }
        requestAnimationFrame((next) => this.frame(next));
      }
    }

    const stories = [...document.querySelectorAll(".gp-story")].map((root) => (root.story = new Story(root)));
    return { SLOW, FASTER, FAST, NUDGE, MOST, STEPS, found, stories };
  },
);
