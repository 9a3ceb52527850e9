// The explorer page: one state, everything drawn from it.
gearpair.define(
  "explorer",
  ["state", "follower", "player", "controls", "readout", "plot", "teeth", "history", "phase", "starts", "spectrum_view", "diagram", "compare", "run_up", "verdict"],
  function (states, follower, player, controls, readout, plotting, teeth, history, phase, { Starts }, spectra, diagrams, { Comparison }, { RunUp }, verdict) {
    const ADDRESS = 300; // milliseconds without a change before the address is written
    const SLOW = 0.03; // seconds
    const STEP = 800; // between two changes that are undone one by one
    const MOST_STEPS = 200; // that can be undone

    class Explorer {
      constructor(root) {
        this.find = (name) => root.querySelector(`[data-part="${name}"]`);
        this.root = root;
        this.order = 0;
        this.past = []; // states to go back to
        this.follower = follower.start();
        this.follower.onmessage = ({ data }) => this.receive(data);
        this.playing = !player.prefersStill();
        this.time = 0;
        this.unmoved = 0; // seconds since the teeth were moved
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
        this.starts = new Starts({
          chips: this.find("chips"),
          note: this.find("found"),
          onPick: (start) => this.change(start),
          onChange: () => this.shown && !this.hidden.has("phase") && this.drawPhase(),
        });
        this.comparison = new Comparison({
          button: this.find("keep"),
          note: this.find("kept"),
          load: this.find("kept-load"),
          onChange: () => this.shown && this.draw(),
        });
        this.runUp = new RunUp({
          buttons: { up: this.find("run-up"), down: this.find("run-down") },
          log: this.find("run-log"),
          note: this.find("run-note"),
          onStart: () => this.state.diagram !== "mesh_frequency" && this.change({ diagram: "mesh_frequency" }),
          onStep: (changes) => this.change(changes),
        });
        this.listen();
        this.readAddress();
        requestAnimationFrame((now) => this.frame(now));
      }

      listen() {
        controls.offer(this.find("parameter"));
        this.find("play").addEventListener("click", () => this.play(!this.playing));
        this.find("speed").addEventListener("input", ({ target }) => this.setSpeed(target));
        this.find("reset").addEventListener("click", () => this.change(states.DEFAULTS));
        this.find("undo").addEventListener("click", () => this.undo());
        this.find("link").addEventListener("click", () => this.copyLink());
        this.find("parameter").addEventListener("change", ({ target }) => this.change({ diagram: target.value }));
        this.find("phase").addEventListener("click", ({ offsetX, offsetY }) => this.pickStart(offsetX, offsetY));
        window.addEventListener("hashchange", () => this.readAddress());
        window.addEventListener("beforeprint", () => this.print());
        new ResizeObserver(() => this.redraw()).observe(this.root);
        new MutationObserver(() => this.redraw()).observe(document.documentElement, { attributeFilter: ["data-theme"] });
        window.matchMedia("print").addEventListener("change", () => this.print());
        this.hidden = new Set(); // pictures scrolled away: they are drawn when they come into sight
        const watcher = new IntersectionObserver((entries) => {
          for (const { target, isIntersecting } of entries) this.hidden[isIntersecting ? "delete" : "add"](target.dataset.part);
          this.visible = ["teeth", "history", "phase"].some((name) => !this.hidden.has(name));
          if (this.shown && entries.some(({ isIntersecting }) => isIntersecting)) this.draw();
        });
        for (const name of ["teeth", "history", "phase", "spectrum"]) watcher.observe(this.find(name));
        this.visible = true;
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
        if (this.state) this.remember(changes);
        if (!this.runUp.stepping && !("diagram" in changes)) this.runUp.stop("stopped by a change");
        this.state = { ...this.state, ...changes };
        if (!keepComplaint) this.say("");
        this.changed = true;
        this.pending = true;
        this.find("undo").disabled = this.past.length === 0;
        clearTimeout(this.addressTimer);
        this.addressTimer = setTimeout(() => this.writeAddress(), ADDRESS);
      }

      // Keep the state for `undo`; of a slider that is dragged only that before the drag.
      remember(changes) {
        const names = Object.keys(changes).join();
        const now = performance.now();
        const goesOn = names === this.lastNames && now - this.lastChange < STEP;
        const differs = Object.entries(changes).some(([name, value]) => this.state[name] !== value);
        if (differs && !goesOn) this.past = [...this.past, this.state].slice(-MOST_STEPS);
        [this.lastNames, this.lastChange] = [names, now];
      }

      undo() {
        const before = this.past.pop();
        if (!before) return;
        const past = this.past;
        this.change(before);
        this.past = past;
        this.lastNames = "";
        this.find("undo").disabled = past.length === 0;
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
        if (!this.phasePlot?.within(px, py)) return; // beside the axes
        const { x, y } = this.phasePlot.data(px, py);
        this.change({ x: Number(x.toFixed(3)), v: Number(y.toFixed(3)) });
      }

      play(playing) {
        this.playing = playing;
        this.find("play").textContent = playing ? "Pause" : "Play";
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
        const what = column.motion === "chaos" ? `chaotic for ${verdict.grouped(column.lasted)} mesh periods` : column.motion;
        const text = `${Number(column.value.toPrecision(4))}, ${what}, X = ${point.x.toFixed(2)}`;
        this.find("diagram").setAttribute("aria-valuenow", String(column.value));
        this.find("diagram").setAttribute("aria-valuetext", text);
        note.textContent = plotting.sign(text);
      }

      redraw(paper = false) {
        plotting.forgetSizes();
        this.theme = plotting.readTheme(this.root);
        if (!this.shown) return;
        this.draw(paper);
        this.diagram.draw(this.theme);
        this.still = false;
      }

      // On paper: the pictures in the colours of paper, the parameters and the address in words.
      print() {
        this.writeAddress();
        const value = (entry) => this.state[entry.name] ?? "as in contact";
        const numbers = states.NUMBERS.map((entry) => `${entry.label.toLowerCase()} ${entry.symbol} = ${value(entry)}`);
        const [words, address] = this.find("printed").children;
        words.innerHTML = `${numbers.join(", ")}, reading: ${this.state.reading}.`.replaceAll("= -", "= −");
        address.textContent = location.href;
        this.redraw(true);
        this.animate(0);
      }

      frame(now) {
        const elapsed = Math.min(now - (this.last ?? now), 100) / 1000;
        this.last = now;
        this.runUp.frame(elapsed);
        // Where frames are slow, every other one takes what has changed and shows a new motion; those between, which are
        // quick, move the teeth.
        const slow = elapsed > SLOW || this.passed;
        this.passed = Boolean(this.changed || this.fresh) && slow && !this.passed;
        const shows = this.fresh && !this.passed;
        if (this.changed && !this.passed) this.take();
        if (shows) this.show();
        this.unmoved += elapsed;
        if (this.visible && !(shows && slow)) {
          this.animate(this.unmoved);
          this.unmoved = 0;
        }
        requestAnimationFrame((next) => this.frame(next));
      }

      // What the reader has changed goes to the worker, the controls and the diagram.
      take() {
        this.changed = false;
        this.order++;
        this.follower.postMessage({ id: this.order, state: this.state });
        this.showControls(this.state);
        this.showDiagram();
        this.starts.of(this.state);
      }

      // From the worker: a motion, how long it has been watched by now, or its next stretch.
      receive({ id, shown, lasted, recorded }) {
        if (shown) this.fresh = { ...shown, id };
        const present = this.fresh ?? this.shown;
        if (id !== present?.id) return;
        if (recorded) present.following = recorded;
        if (lasted) {
          present.lasted = lasted;
          if (present === this.shown) this.showReadout(present, false);
        }
      }

      // Everything on the page speaks of one motion, the last that the worker has told of.
      show() {
        const { fresh, shown } = this;
        const same = shown?.id === fresh.id && shown.status === fresh.status && fresh.points[0]?.x === shown.points[0]?.x;
        this.fresh = null;
        this.shown = fresh;
        this.pending = fresh.id !== this.order || fresh.status === "settling";
        this.theme ??= plotting.readTheme(this.root);
        if (!same) {
          if (this.runUp.way) this.diagram.trace = this.runUp.trace;
          this.comparison.show(fresh);
          this.draw();
          this.diagram.draws(this.theme);
          if (fresh.status === "aperiodic" || fresh.status === "unsettled") this.follower.postMessage({ id: fresh.id });
        } else Object.assign(fresh, { recorded: shown.recorded, following: shown.following }); // watched for longer
        if (fresh.id === this.order && fresh.status !== "settling") this.starts.show(fresh, this.phasePlot.own);
        this.runUp.show(fresh);
        this.showReadout(fresh, !same);
        this.find("tells").textContent = spectra.tells(fresh);
        if (fresh.status === "periodic") {
          this.diagram.follow({ value: fresh.state[this.state.diagram], points: fresh.points });
        }
        this.root.dispatchEvent(new CustomEvent("motionshown", { detail: fresh }));
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

      // Draw the pictures in sight, on `paper` all.
      draw(paper = false) {
        const { shown, theme } = this;
        const { state } = shown;
        const escaped = shown.name === "escaped"; // its colour is too faint for a line
        const colour = escaped ? theme.muted : theme.motion[verdict.colourName(shown.name)];
        if (colour !== this.colour) this.root.style.setProperty("--motion", (this.colour = colour));
        const { points, name, lasted } = shown;
        this.diagram.mark({ value: state[this.state.diagram], points, colour, name, lasted });
        const all = paper || !this.historyPlot;
        const draws = (name) => all || !this.hidden.has(name);
        if (draws("history")) this.historyPlot = history.drawHistory(this.find("history"), theme, { ...shown, colour, kept: this.comparison.kept });
        if (draws("phase")) this.drawPhase();
        if (draws("spectrum")) spectra.drawSpectrum(this.find("spectrum"), theme, { ...shown, colour });
        this.still = false;
      }

      drawPhase() {
        const { shown, theme, starts, colour } = this;
        const { x, v } = shown.state;
        const { kept } = this.comparison;
        this.phasePlot = phase.drawPhase(this.find("phase"), theme, { ...shown, start: { x, v }, colour, starts, kept });
        this.still = false;
      }

      // The teeth, and the dots that run along the time history and the phase portrait.
      animate(elapsed) {
        if (!this.shown || (!this.playing && this.still)) return;
        const { recorded, following } = this.shown;
        this.still = !this.playing;
        if (this.playing) this.time += elapsed * this.speed;
        if (this.time >= recorded.periods) {
          this.time %= recorded.periods;
          if (following) {
            Object.assign(this.shown, { recorded: following, following: null });
            this.draw();
            this.follower.postMessage({ id: this.shown.id });
          }
        }
        const now = player.at(this.shown.recorded, this.time, this.speed);
        const mean = Math.abs(this.shown.state.mean_force) || 1;
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
