// The page: fields in, verdict and chart out, a cursor that moves the teeth, and what it hands over.
gearpair.define(
  "chart/page",
  [
    ...["cells", "flow", "observe", "player", "plot", "teeth"],
    ...["chart/data", "chart/drive", "chart/file", "chart/study", "chart/figure", "chart/words"],
  ],
  function (tables, flow, observe, player, plotting, teeth, data, drives, files, { Study }, figure, words) {
    const QUIET = 250; // milliseconds without a change before a drive is made
    const SHOWN = 8; // mesh periods of a motion without a period, at a time
    const SPEED = 0.6; // mesh periods a second
    const NARROW = 640; // pixels, below which only what matters is unfolded
    const RUNS = ["up", "down"];

    const LETTERS = { alpha: "α", zeta: "ζ", z1: "z₁", z2: "z₂", x1: "x₁", x2: "x₂", T1: "T₁", f_pb: "f<sub>pb</sub>", f_falpha: "f<sub>fα</sub>" };

    class Page {
      constructor(root) {
        this.root = root;
        root.classList.add("gp", "gp-explorer"); // whose colours it has; on paper it has no place
        this.find = (name) => root.querySelector(`[data-part="${name}"]`);
        this.study = new Study(() => this.news());
        this.playing = !player.prefersStill();
        this.time = 0;
        this.build();
        this.listen();
        this.readAddress();
        requestAnimationFrame((now) => this.frame(now));
      }

      build() {
        const narrow = this.root.clientWidth < NARROW;
        this.find("fields").innerHTML = data.groups
          .map(({ title, fields }, i) => {
            const open = i < (narrow ? 1 : 2) ? " open" : "";
            return `<details${open}><summary>${title}</summary>${fields.map(row).join("")}</details>`;
          })
          .join("");
        this.heads = [...this.find("ranges").querySelectorAll("th")].map((head) => head.textContent);
        this.inputs = Object.fromEntries([...this.find("fields").querySelectorAll("[name]")].map((input) => [input.name, input]));
      }

      listen() {
        this.find("fields").addEventListener("input", ({ target }) => this.input(target));
        this.find("fields").addEventListener("submit", (event) => event.preventDefault());
        this.find("reset").addEventListener("click", () => this.set({ ...drives.DEFAULTS }));
        this.find("pin").addEventListener("click", () => this.pin());
        this.find("band").addEventListener("change", ({ target }) => this.setBand(target.checked));
        this.find("play").addEventListener("click", () => this.play(!this.playing));
        this.find("link").addEventListener("click", () => this.copy("link", location.href, "It is in the address bar"));
        this.find("command").addEventListener("click", () => this.copy("command", this.find("command").dataset.text, this.find("command").dataset.text));
        const cursor = this.find("cursor");
        cursor.addEventListener("keydown", (event) => this.key(event));
        cursor.addEventListener("pointerdown", (event) => (cursor.setPointerCapture(event.pointerId), this.point(event)));
        cursor.addEventListener("pointermove", (event) => event.buttons && this.point(event));
        window.addEventListener("hashchange", () => this.readAddress());
        new ResizeObserver(() => this.redraw()).observe(this.root);
        new MutationObserver(() => this.redraw()).observe(document.documentElement, { attributeFilter: ["data-theme"] });
        new IntersectionObserver(([{ isIntersecting }]) => (this.visible = isIntersecting)).observe(this.find("motions"));
        this.play(this.playing);
      }

      readAddress() {
        const own = location.hash.slice(1);
        if (own === this.written) return;
        this.written = own;
        const { state, complaints } = files.parse(own);
        this.set(state);
        if (complaints.length) this.say(complaints.join(" "));
      }

      set(state) {
        this.state = state;
        for (const field of drives.FIELDS) this.inputs[field.name].value = state[field.name] ?? "";
        for (const input of Object.values(this.inputs)) input.removeAttribute("aria-invalid");
        this.make();
      }

      input(target) {
        const field = drives.FIELDS.find(({ name }) => name === target.name);
        this.state = { ...this.state, [field.name]: drives.read(field, target.value) };
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.make(), QUIET);
      }

      // A drive of the state, or the sentence that refuses it; the fields that are refused by themselves are marked.
      make() {
        for (const field of drives.FIELDS) this.mark(field);
        try {
          this.drive = drives.driveOf(this.state);
        } catch (refusal) {
          this.say(`${refusal.message}.`);
          this.root.classList.add("gp-refused");
          this.find("save").removeAttribute("href"); // it would be another drive's
          this.study.pool.clear();
          return;
        }
        this.say("");
        this.root.classList.remove("gp-refused");
        const hash = files.format(this.state);
        if (hash !== this.written) window.history.replaceState(null, "", hash ? `#${hash}` : location.pathname + location.search);
        this.written = hash;
        this.handOver();
        this.study.start(this.drive);
        this.news();
      }

      mark(field) {
        const input = this.inputs[field.name];
        try {
          drives.check(field, this.state[field.name]);
          input.removeAttribute("aria-invalid");
        } catch {
          input.setAttribute("aria-invalid", "true");
        }
      }

      say(text) {
        this.find("complaint").textContent = text;
        this.find("complaint").hidden = text === "";
      }

      handOver() {
        const text = files.yaml(this.state);
        URL.revokeObjectURL(this.address);
        this.address = URL.createObjectURL(new Blob([text], { type: "text/yaml" }));
        this.find("save").href = this.address;
        this.find("yaml").textContent = text;
        this.find("facts").innerHTML = words.factsOf(this.drive).map(([name, value]) => `<div><dt>${name}</dt><dd>${value}</dd></div>`).join("");
      }

      async copy(name, text, otherwise) {
        const button = this.find(name);
        const label = (button.dataset.label ??= button.textContent);
        try {
          await navigator.clipboard.writeText(text);
          button.textContent = "Copied";
        } catch {
          button.textContent = otherwise;
        }
        setTimeout(() => (button.textContent = label), 1600);
      }

      // Keep the chart as a ghost behind the next one; a second time lets it go.
      pin() {
        const shown = this.study.shown;
        this.ghost = this.ghost || !shown ? null : shown;
        this.find("pin").textContent = this.ghost ? "Let the pinned one go" : "Pin this variant";
        this.draw();
      }

      setBand(wanted) {
        this.study.wantsBand = wanted;
        if (wanted) this.study.askBand();
        this.draw();
      }

      play(playing) {
        this.playing = playing;
        this.find("play").textContent = playing ? "Pause" : "Play";
      }

      news() {
        this.find("progress").textContent = this.study.progress;
        this.root.classList.toggle("gp-working", this.study.done.size < 3);
        const { shown, done } = this.study;
        if (!shown) return;
        if (done.size === 3 && this.find("live").textContent !== shown.told.sentences[0]) {
          this.find("live").textContent = shown.told.sentences[0];
        }
        if (shown !== this.told) {
          this.told = shown;
          this.tell(shown);
        }
        this.draw();
      }

      tell({ chart, iso, told }) {
        const [first, ...rest] = told.sentences;
        const missing = iso.outside ? [`${iso.outside}.`] : [];
        this.find("rule").textContent = first;
        this.find("sentences").innerHTML = [...rest, ...missing].map((text) => `<p>${text}</p>`).join("");
        this.root.dataset.verdict = told.avoid.length ? "avoid" : "together";
        const cell = (text, i) => `<td data-head="${this.heads[i]}">${text}</td>`;
        const rows = told.avoid.map((range) => `<tr>${words.rangeRow(range).map(cell).join("")}</tr>`);
        this.find("ranges").hidden = rows.length === 0;
        this.find("rows").innerHTML = rows.join("");
        this.rpm ??= this.mostApart(chart);
        this.showCursor(chart);
      }

      // Where the runs differ most, or the worst of the chart.
      mostApart({ speeds, up, down, factorHigh }) {
        const apart = up.map(({ factor }, i) => Math.abs(Math.log(factor / down[i].factor)) || 0);
        const by = Math.max(...apart) > 0.05 ? apart : factorHigh;
        return speeds[by.indexOf(Math.max(...by))];
      }

      showCursor(chart) {
        const { speeds } = chart;
        const near = speeds.map((speed) => Math.abs(speed - this.rpm));
        this.at = near.indexOf(Math.min(...near));
        const speed = speeds[this.at];
        const cursor = this.find("cursor");
        const text = `${speed.toFixed(0)} rpm, run up ${words.nameOf(chart.up[this.at])}, run down ${words.nameOf(chart.down[this.at])}`;
        for (const [name, value] of [["min", speeds[0]], ["max", speeds.at(-1)], ["now", speed]]) cursor.setAttribute(`aria-value${name}`, value.toFixed(0));
        cursor.setAttribute("aria-valuetext", text);
        this.find("speed").textContent = `${speed.toFixed(0)} rpm`;
        this.find("hertz").textContent = `mesh frequency ${((speed * this.study.drive.teeth) / 60).toFixed(0)} Hz`;
        for (const run of RUNS) {
          const motion = chart[run][this.at];
          this.find(`name-${run}`).textContent = words.nameOf(motion);
          this.find(`bears-${run}`).textContent = words.bears(motion);
        }
        this.record(chart);
      }

      // The motions under the cursor, of which the teeth are drawn.
      record(chart) {
        const phase = chart.phases[chart.chosen];
        const same = JSON.stringify([this.written, this.at, phase, RUNS.map((run) => chart[run][this.at].start)]);
        if (same === this.recordedOf) return;
        this.recordedOf = same;
        const oscillator = drives.oscillatorAt(this.study.drive, chart.speeds[this.at], phase);
        this.cells = tables.buildCells(oscillator);
        this.meanForce = oscillator.mean_force;
        this.time = 0;
        this.moving = RUNS.map((run) => {
          const { start, period } = chart[run][this.at];
          if (!start) return null;
          const motion = flow.startAt(this.cells, start.x, start.v);
          const periods = period ? period * Math.max(1, Math.round(SHOWN / period)) : SHOWN;
          return { motion, period, recorded: observe.record(this.cells, motion, periods, 256 * periods) };
        });
        this.still = false;
      }

      key(event) {
        if (!this.told) return;
        const last = this.told.chart.speeds.length - 1;
        const steps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10, Home: -last, End: last };
        if (!(event.key in steps)) return;
        event.preventDefault();
        this.moveTo(this.told.chart.speeds[Math.min(Math.max(this.at + steps[event.key], 0), last)]);
      }

      point({ offsetX, offsetY }) {
        if (this.plot) this.moveTo(this.plot.data(offsetX, offsetY).x);
      }

      moveTo(rpm) {
        this.rpm = rpm;
        this.showCursor(this.told.chart);
        this.drawCursor();
      }

      redraw() {
        plotting.forgetSizes();
        this.theme = plotting.readTheme(this.root);
        this.inks = figure.readInks(this.root);
        this.draw();
        this.still = false;
      }

      draw() {
        if (!this.told || !this.theme) return;
        const { linear, band, wantsBand } = this.study;
        const drawn = { ...this.told, linear, ghost: this.ghost, band: wantsBand && band?.rest === 0 ? band : null };
        this.plot = figure.drawChart(this.find("chart"), this.theme, this.inks, drawn);
        const legend = figure.legendOf(drawn).map(([kind, text]) => `<li class="gp-key ${kind}">${text}</li>`).join("");
        if (legend !== this.legend) this.find("legend").innerHTML = this.legend = legend;
        this.drawCursor();
      }

      drawCursor() {
        figure.drawCursor(this.find("cursor"), this.theme, this.inks, this.plot, this.told.chart, this.at);
      }

      frame(now) {
        const elapsed = Math.min(now - (this.last ?? now), 100) / 1000;
        this.last = now;
        requestAnimationFrame((next) => this.frame(next));
        if (!this.moving || !this.theme || ((!this.playing || !this.visible) && this.still)) return;
        if (this.playing) this.time += elapsed * SPEED;
        this.still = true; // once is drawn what does not move, or is not seen
        this.moving.forEach((each, k) => {
          if (!each) return;
          const { periods } = each.recorded;
          const turn = Math.floor(this.time / periods);
          if (!each.period && turn > (each.turn ?? 0)) {
            each.turn = turn;
            each.recorded = observe.record(this.cells, each.motion, periods, 256 * periods);
          }
          const at = player.at(each.recorded, this.time % periods, SPEED);
          teeth.drawTeeth(this.find(`teeth-${RUNS[k]}`), this.theme, { ...at, force: at.force / this.meanForce });
        });
      }
    }

    function row({ name, label, unit, symbol, choices, meaning }) {
      const id = `gp-${name}`;
      const input = choices
        ? `<select id="${id}" name="${name}">${choices.map((each) => `<option>${each}</option>`).join("")}</select>`
        : `<input id="${id}" name="${name}" inputmode="decimal" autocomplete="off" spellcheck="false">`;
      const units = unit.replace("um", "µm").replace("^2", "²");
      return `<div class="gp-field" title="${name}: ${meaning}"><label for="${id}">${label} <i>${LETTERS[symbol] ?? symbol}</i></label>${input}<span>${units}</span></div>`;
    }

    const root = document.getElementById("drive-chart");
    if (root) root.page = new Page(root);
    return { Page };
  },
);
