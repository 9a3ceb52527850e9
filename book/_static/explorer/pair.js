// Small moving pairs of teeth for other pages: every element with data-motion="mesh_frequency=0.7&...&x=1&v=0".
gearpair.define(
  "pair",
  ["state", "model", "player", "plot", "teeth"],
  function (states, models, player, plotting, teeth) {
    const SPEED = 0.5; // mesh periods a second
    const BUDGET = 5000; // milliseconds at most for the motion to settle

    class Pair {
      constructor(element) {
        this.canvas = element.querySelector("canvas");
        const { state } = states.parse(element.dataset.motion);
        const model = new models.Model();
        model.reset(state);
        model.advance(BUDGET);
        this.recorded = model.describe().recorded;
        this.meanForce = Math.abs(state.mean_force) || 1;
        this.time = 0;
      }

      draw() {
        const now = player.at(this.recorded, this.time, SPEED);
        teeth.drawTeeth(this.canvas, this.theme, { ...now, force: now.force / this.meanForce }, false);
      }

      advance(elapsed) {
        this.time = (this.time + elapsed * SPEED) % this.recorded.periods;
      }
    }

    // All pairs of one group run on one clock, and one button stops them.
    class Group {
      constructor(root) {
        this.pairs = [...root.querySelectorAll("[data-motion]")].map((element) => new Pair(element));
        this.root = root;
        this.button = root.querySelector("button");
        this.button.hidden = false;
        this.button.addEventListener("click", () => this.play(!this.playing));
        const refresh = () => this.refresh();
        new ResizeObserver(refresh).observe(root);
        new MutationObserver(refresh).observe(document.documentElement, { attributeFilter: ["data-theme"] });
        new IntersectionObserver(([{ isIntersecting }]) => (this.visible = isIntersecting)).observe(root);
        this.play(!player.prefersStill());
        requestAnimationFrame((now) => this.frame(now));
      }

      play(playing) {
        this.playing = playing;
        this.button.textContent = playing ? "Pause" : "Play";
      }

      refresh() {
        plotting.forgetSizes();
        const theme = plotting.readTheme(this.root);
        for (const pair of this.pairs) {
          pair.theme = theme;
          pair.draw();
        }
      }

      frame(now) {
        const elapsed = Math.min(now - (this.last ?? now), 100) / 1000;
        this.last = now;
        if (this.playing && this.visible) {
          for (const pair of this.pairs) {
            pair.advance(elapsed);
            pair.draw();
          }
        }
        requestAnimationFrame((next) => this.frame(next));
      }
    }

    const groups = [...document.querySelectorAll(".gp-pairs")].map((root) => new Group(root));
    return { groups };
  },
);
