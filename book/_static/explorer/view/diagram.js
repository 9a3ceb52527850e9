// The bifurcation diagram as a picker: X on the section over one parameter, drawn as the worker finds it.
gearpair.define("diagram", ["library", "plot", "branches", "verdict"], function (library, { prepare, axes, inside, padded }, branches, verdict) {
  const { colourName, grouped } = verdict;
  const COUNT = 400; // values of the parameter, each visited rising and falling
  const WAIT = 250; // milliseconds without a change before the worker starts
  const [TALLEST, TALLEST_BRANCH] = [10, 4]; // |X| up to which the sweeps, and a branch added to them, widen the axes
  const REACH = 16; // pixels from a click to the point that it means

  class Diagram {
    // `dots` and `overlay` are canvases on top of each other; `onPick` gets { parameter, value, x, v }.
    constructor({ dots, overlay, legend, note, onPick, onHover }) {
      Object.assign(this, { dots, overlay, legend, note, onPick, onHover });
      this.worker = branches.start();
      this.columns = []; // by their place; one that comes again has been watched for longer
      this.order = 0;
      this.key = "";
      this.trace = []; // section points of a run-up: { value, x }
      this.busy = true;
      this.cursor = null; // the point under the keyboard or the pointer: { column, point }
      this.worker.onmessage = ({ data }) => this.receive(data);
      overlay.addEventListener("click", (event) => this.click(event));
      overlay.addEventListener("keydown", (event) => this.press(event));
      overlay.addEventListener("blur", () => this.moveCursor(null));
      overlay.addEventListener("pointermove", ({ offsetX, offsetY }) => this.moveCursor(this.nearest(offsetX, offsetY)));
      overlay.addEventListener("pointerleave", () => this.moveCursor(null));
    }

    // The gear pair and the parameter to sweep; a new diagram starts when they have stood still for a moment.
    show(state, entry) {
      const { [entry.name]: _swept, x, v, diagram: _diagram, ...rest } = state;
      const key = JSON.stringify([entry.name, rest]);
      this.entry = entry;
      if (key === this.key) return;
      this.key = key;
      this.trace = [];
      this.stale = true;
      this.busy = true;
      this.order++;
      this.worker.postMessage({ id: this.order });
      this.dots.style.opacity = 0.35;
      const order = { oscillator: state, parameter: entry.name, lower: entry.min || entry.step, upper: entry.max };
      this.sent = { id: this.order, ...order, count: COUNT, x, v };
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.worker.postMessage(this.sent), WAIT);
      this.note.textContent = "sweeping up and down, takes some seconds …";
    }

    // Add the branch of a motion that both sweeps have missed: { value, points } on the section.
    follow(missed) {
      this.missed = missed;
      if (this.busy) return;
      clearTimeout(this.timer);
      this.timer = setTimeout(() => {
        this.missed = null;
        const { value: from, points } = missed;
        if (from < this.sent.lower || from > this.sent.upper) return;
        this.worker.postMessage({ ...this.sent, from, ...points[0] });
      }, WAIT);
    }

    receive({ id, batch, done }) {
      if (id !== this.order) return;
      if (this.stale) {
        this.columns = [];
        this.stale = false;
        this.cursor = null;
        this.dots.style.opacity = 1;
      }
      const before = this.range();
      const again = batch.some(({ place }) => place < this.columns.length);
      for (const column of batch) this.columns[column.place] = column;
      const after = this.range();
      if (this.plot && !again && before.bottom === after.bottom && before.top === after.top) this.drawColumns(batch);
      else if (this.theme && (batch.length || !this.plot)) this.draw(this.theme);
      this.describe();
      const share = Math.min(Math.round((50 * this.columns.length) / COUNT), 99);
      const work = again || this.columns.length >= 2 * COUNT ? "watching whether the chaos ends …" : `sweeping up and down … ${share} %`;
      this.note.textContent = done ? "" : work;
      this.busy = !done;
      if (done && this.missed) this.follow(this.missed);
    }

    range() {
      let [low, high] = [-1, 1];
      for (const [i, { points }] of this.columns.entries()) {
        const most = i < 2 * COUNT ? TALLEST : TALLEST_BRANCH;
        for (const { x } of points) [low, high] = [Math.min(low, Math.max(x, -most)), Math.max(high, Math.min(x, most))];
      }
      const [bottom, top] = padded(low, high);
      return { left: this.entry.min, right: this.entry.max, bottom, top };
    }

    // Draw it unless it has been.
    draws(theme) {
      if (!this.plot) this.draw(theme);
    }

    draw(theme) {
      this.theme = theme;
      const paper = prepare(this.dots);
      const words = { xLabel: this.entry.label.toLowerCase(), yLabel: "X on the section" };
      this.plot = axes(paper, this.range(), theme, words);
      this.paper = paper;
      this.drawColumns(this.columns);
      this.describe();
      this.mark(this.marked);
    }

    drawColumns(columns) {
      const { ctx } = this.paper;
      inside(this.paper, this.plot, () => {
        for (const { value, motion, points } of columns) {
          if (!points.length) this.flee(ctx, value);
          const many = points.length > 16;
          ctx.fillStyle = this.theme.motion[colourName(motion)];
          ctx.globalAlpha = many ? 0.55 : 1;
          const size = many ? 1.2 : 2.2;
          const x = this.plot.x(value) - size / 2;
          for (const point of points) ctx.fillRect(x, this.plot.y(point.x) - size / 2, size, size);
        }
        ctx.globalAlpha = 1;
      });
    }

    // A motion without points, which left the picture: an arrow at its upper edge.
    flee(ctx, value) {
      const [x, y] = [this.plot.x(value), this.plot.box.top + 1];
      ctx.fillStyle = this.theme.muted;
      ctx.globalAlpha = 1;
      ctx.beginPath();
      ctx.moveTo(x, y);
      ctx.lineTo(x - 3, y + 6);
      ctx.lineTo(x + 3, y + 6);
      ctx.fill();
    }

    // The legend: the motions in the diagram and the one that is marked; of chaos also for how long it was watched.
    describe() {
      const present = new Set(this.columns.map(({ motion }) => colourName(motion)));
      if (this.marked && this.marked.name !== "settling") present.add(colourName(this.marked.name));
      const names = library.motions.filter((name) => present.has(name));
      const least = Math.min(...this.columns.filter(({ motion }) => motion === "chaos").map(({ lasted }) => lasted));
      const key = [...names, least].join();
      if (key === this.names) return;
      this.names = key;
      this.legend.replaceChildren(
        ...names.map((name) => {
          const item = document.createElement("li");
          item.dataset.motion = name;
          item.style.setProperty("--dot", `var(--gp-${name.replaceAll(" ", "-")})`);
          item.textContent = name === "chaos" && least < Infinity ? `chaos, watched for ${grouped(Math.floor(least / 100) * 100)} mesh periods or more` : name;
          return item;
        }),
      );
    }

    // Mark the motion shown: { value, points, colour, name }, a line at its value and a ring around each of its points.
    mark(marked) {
      this.marked = marked;
      this.describe();
      if (!this.plot || !marked) return;
      const paper = prepare(this.overlay);
      const { ctx } = paper;
      inside(paper, this.plot, () => {
        const x = this.plot.x(marked.value);
        ctx.strokeStyle = this.theme.ink;
        ctx.globalAlpha = 0.45;
        ctx.lineWidth = 1;
        ctx.beginPath();
        ctx.moveTo(x, this.plot.box.top);
        ctx.lineTo(x, this.plot.box.bottom);
        ctx.stroke();
        ctx.globalAlpha = 1;
        ctx.fillStyle = this.theme.ink;
        for (const point of this.trace) ctx.fillRect(this.plot.x(point.value) - 1, this.plot.y(point.x) - 1, 2, 2);
        if (marked.points.length <= 64) for (const point of marked.points) this.ring(ctx, x, this.plot.y(point.x), 4, marked.colour);
        if (this.cursor) {
          const { column, point } = this.cursor;
          this.ring(ctx, this.plot.x(column.value), this.plot.y(point.x), 7, this.theme.ink);
        }
      });
    }

    ring(ctx, x, y, radius, colour) {
      ctx.beginPath();
      ctx.arc(x, y, radius, 0, 2 * Math.PI);
      ctx.fillStyle = this.theme.paper;
      ctx.globalAlpha = 0.7;
      ctx.fill();
      ctx.globalAlpha = 1;
      ctx.lineWidth = 2;
      ctx.strokeStyle = colour;
      ctx.stroke();
    }

    // The point { column, point } nearest to a place of the picture, or null where none is near.
    nearest(px, py) {
      if (!this.plot) return null;
      let [best, least] = [null, REACH ** 2];
      for (const column of this.columns) {
        const dx = this.plot.x(column.value) - px;
        if (dx * dx > least) continue;
        for (const point of column.points) {
          const dy = this.plot.y(point.x) - py;
          if (dx * dx + dy * dy < least) [best, least] = [{ column, point }, dx * dx + dy * dy];
        }
      }
      return best;
    }

    // A click picks the nearest point; beside all points it picks the value alone.
    click({ offsetX, offsetY }) {
      if (!this.plot?.within(offsetX, offsetY)) return; // beside the axes
      const best = this.nearest(offsetX, offsetY);
      if (best) this.pick(best);
      else {
        const value = this.plot.data(offsetX, offsetY).x;
        const { name, min, max, step } = this.entry;
        const rounded = Number((Math.round(value / step) * step).toPrecision(10));
        if (value >= min && value <= max) this.onPick({ parameter: name, value: rounded });
      }
    }

    pick({ column, point }) {
      const [value, x, v] = [column.value, point.x, point.v].map((number) => Number(number.toPrecision(12)));
      this.onPick({ parameter: this.entry.name, value, x, v, motion: column.motion });
    }

    // Left and right go to the neighbouring value, Home and End to the first and last, up and down through its points;
    // Enter picks.
    press(event) {
      const moves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1], PageUp: [20, 0], PageDown: [-20, 0], Home: [-COUNT, 0], End: [COUNT, 0] };
      const move = moves[event.key];
      if ((event.key === "Enter" || event.key === " ") && this.cursor) this.pick(this.cursor);
      else if (move && this.columns.length) this.step(...move);
      else return;
      event.preventDefault();
    }

    step(across, up) {
      const sorted = this.columns.filter(({ points }) => points.length).sort((p, q) => p.value - q.value || p.falling - q.falling);
      if (!sorted.length) return;
      const values = [...new Set(sorted.map(({ value }) => value))];
      const present = this.cursor?.column.value ?? this.marked?.value ?? values[0];
      const nearest = values.reduce((best, value, i) => (Math.abs(value - present) < Math.abs(values[best] - present) ? i : best), 0);
      const value = values[Math.min(Math.max(nearest + across, 0), values.length - 1)];
      const here = sorted
        .filter((column) => column.value === value)
        .flatMap((column) => column.points.map((point) => ({ column, point })))
        .sort((p, q) => p.point.x - q.point.x);
      const height = this.cursor?.point.x ?? this.marked?.points[0]?.x ?? 0;
      let at = here.reduce((best, { point }, i) => (Math.abs(point.x - height) < Math.abs(here[best].point.x - height) ? i : best), 0);
      if (up && this.cursor) {
        do at += up;
        while (here[at] && Math.abs(here[at].point.x - height) < 1e-6);
      }
      this.moveCursor(here[Math.min(Math.max(at, 0), here.length - 1)]);
    }

    moveCursor(cursor) {
      if (cursor === this.cursor) return;
      this.cursor = cursor;
      this.mark(this.marked);
      this.onHover(cursor);
    }
  }

  return { Diagram };
});
