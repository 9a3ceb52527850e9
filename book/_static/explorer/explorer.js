// The explorer page: one state, everything drawn from it.
gearpair.define(
  "explorer",
  ["state", "model", "player", "controls", "readout", "plot", "teeth", "history", "phase", "spectrum_view", "diagram"],
  function (states, models, player, controls, readout, plotting, teeth, history, phase, spectra, diagrams) {
    const BUDGET = 9; // milliseconds a frame for a motion to settle
    const PASSING = 150; // between two pictures of a motion that has not settled
    const ADDRESS = 300; // without a change before the address is written

    class Explorer {
      constructor(root) {
        this.find = (name) => root.querySelector(`[data-part="${name}"]`);
        this.root = root;
        this.model = new models.Model();
        this.playing = !player.prefersStill();
        this.time = 0;
        this.showControls = controls.build(this.find("controls"), (changes) => this.change(changes), (text) => this.say(text));
        this.showReadout = readout.build(root, this.find("live"), this.find("meaning"));
        this.diagram = new diagrams.Diagram({
          dots: this.find("diagram-dots"),
          overlay: this.find("diagram"),
          legend: this.find("legend"),
          note: this.find("diagram-note"),
          onPick: ({ parameter, value, x = this.state.x, v = this.state.v }) => this.change({ [parameter]: value, x, v }),
          onHover: (cursor) => this.hover(cursor),
        });
        this.listen();
        this.readAddress();
        requestAnimationFrame((now) => this.frame(now));
      }

      listen() {
        this.find("play").addEventListener("click", () => this.play(!this.playing));
        this.find("speed").addEventListener("input", ({ target }) => this.setSpeed(target));
        this.find("reset").addEventListener("click", () => this.change(states.DEFAULTS));
        this.find("link").addEventListener("click", () => this.copyLink());
        this.find("parameter").addEventListener("change", ({ target }) => this.change({ diagram: target.value }));
        this.find("phase").addEventListener("click", ({ offsetX, offsetY }) => this.pickStart(offsetX, offsetY));
        window.addEventListener("hashchange", () => this.readAddress());
        new ResizeObserver(() => this.redraw()).observe(this.root);
        new MutationObserver(() => this.redraw()).observe(document.documentElement, { attributeFilter: ["data-theme"] });
        this.play(this.playing);
        this.setSpeed(this.find("speed"));
      }

      readAddress() {
        const own = location.hash.slice(1);
        if (own === this.written) return;
        const { state, complaints } = states.parse(own);
        this.say(complaints.join(" "));
        this.written = own;
        this.change(state, complaints.length > 0);
      }

      say(text) {
        this.find("complaint").textContent = text;
        this.find("complaint").hidden = text === "";
      }

      change(changes, keepComplaint = false) {
        this.state = { ...this.state, ...changes };
        if (!keepComplaint) this.say("");
        this.changed = true;
        clearTimeout(this.addressTimer);
        this.addressTimer = setTimeout(() => this.writeAddress(), ADDRESS);
      }

      writeAddress() {
        const text = states.format(this.state);
        if (text === this.written) return;
        this.written = text;
        window.history.replaceState(null, "", text ? `#${text}` : location.pathname + location.search);
      }

      async copyLink() {
        this.writeAddress();
        const button = this.find("link");
        try {
          await navigator.clipboard.writeText(location.href);
          button.textContent = "Copied";
        } catch {
          button.textContent = "It is in the address bar";
        }
        setTimeout(() => (button.textContent = "Copy link"), 1600);
      }

      pickStart(px, py) {
        const { x, y } = this.phasePlot.data(px, py);
        this.change({ x: Number(x.toFixed(3)), v: Number(y.toFixed(3)) });
      }

      play(playing) {
        this.playing = playing;
        const button = this.find("play");
        button.textContent = playing ? "Pause" : "Play";
        button.setAttribute("aria-pressed", String(playing));
      }

      setSpeed(slider) {
        this.speed = 10 ** slider.valueAsNumber; // mesh periods a second
        controls.fill(slider);
      }

      // The point of the diagram under the keyboard or the pointer: { column, point }, or null.
      hover(cursor) {
        const note = this.find("diagram-note");
        if (!cursor) {
          if (!this.diagram.busy) note.textContent = "";
          return;
        }
        const { column, point } = cursor;
        const text = `${Number(column.value.toPrecision(4))}, ${column.motion}, X = ${point.x.toFixed(2)}`;
        this.find("diagram").setAttribute("aria-valuenow", String(column.value));
        this.find("diagram").setAttribute("aria-valuetext", text);
        note.textContent = plotting.sign(text);
      }

      redraw() {
        plotting.forgetSizes();
        this.theme = plotting.readTheme(this.root);
        if (!this.shown) return;
        this.draw();
        this.diagram.draw(this.theme);
      }

      frame(now) {
        const elapsed = Math.min(now - (this.last ?? now), 100) / 1000;
        this.last = now;
        if (this.changed) {
          this.changed = false;
          this.pending = true;
          this.model.reset(this.state);
          this.drawnAt = -Infinity;
          this.showControls(this.state);
          this.showDiagram();
        }
        if (this.pending) this.settle(now);
        this.animate(elapsed);
        requestAnimationFrame((next) => this.frame(next));
      }

      // Go on with the motion; show it when it has settled, and now and then on its way.
      settle(now) {
        const ready = this.model.advance(BUDGET);
        this.pending = !ready;
        if (!ready && now - this.drawnAt < PASSING) return;
        this.drawnAt = now;
        this.shown = this.model.describe();
        this.theme ??= plotting.readTheme(this.root);
        this.draw();
        if (!this.diagram.plot) this.diagram.draw(this.theme);
        this.showReadout(this.shown);
        if (ready) this.root.dispatchEvent(new CustomEvent("motionshown", { detail: { ...this.shown, state: this.state } }));
        if (this.shown.status === "periodic") {
          this.diagram.follow({ value: this.state[this.state.diagram], points: this.shown.points });
        }
      }

      showDiagram() {
        const entry = states.NUMBERS.find(({ name }) => name === this.state.diagram);
        this.diagram.show(this.state, entry);
        this.find("parameter").value = entry.name;
        const overlay = this.find("diagram");
        const value = this.state[entry.name];
        for (const [name, number] of [["min", entry.min], ["max", entry.max], ["now", value]]) {
          overlay.setAttribute(`aria-value${name}`, String(number));
        }
        overlay.setAttribute("aria-valuetext", `${entry.label} ${value}`);
      }

      draw() {
        const { shown, theme, state } = this;
        const escaped = shown.name === "escaped"; // its colour is too faint for a line
        const colour = escaped ? theme.muted : theme.motion[plotting.colourName(shown.name)];
        if (colour !== this.colour) this.root.style.setProperty("--motion", (this.colour = colour));
        this.diagram.mark({ value: state[state.diagram], points: shown.points, colour, name: shown.name });
        const start = { x: state.x, v: state.v };
        this.historyPlot = history.drawHistory(this.find("history"), theme, { ...shown, colour });
        this.phasePlot = phase.drawPhase(this.find("phase"), theme, { ...shown, start, colour });
        spectra.drawSpectrum(this.find("spectrum"), theme, { ...shown, colour });
        this.still = false;
      }

      // The teeth, and the dots that run along the time history and the phase portrait.
      animate(elapsed) {
        if (!this.shown || (!this.playing && this.still)) return;
        const { recorded } = this.shown;
        this.still = !this.playing;
        if (this.playing) this.time += elapsed * this.speed;
        if (this.time >= recorded.periods) {
          this.time %= recorded.periods;
          if (this.shown.status === "aperiodic" || this.shown.status === "unsettled") {
            this.shown.recorded = this.model.next();
            this.draw();
          }
        }
        const now = player.at(this.shown.recorded, this.time, this.speed);
        const mean = Math.abs(this.state.mean_force) || 1;
        teeth.drawTeeth(this.find("teeth"), this.theme, { ...now, force: now.force / mean });
        this.moveDot("history-dot", this.historyPlot.x(this.time), this.historyPlot.y(now.x));
        this.moveDot("phase-dot", this.phasePlot.x(now.x), this.phasePlot.y(now.v));
      }

      moveDot(name, x, y) {
        this.find(name).style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      }
    }

    const root = document.getElementById("explorer");
    if (root) root.explorer = new Explorer(root);
    return { Explorer };
  },
);
