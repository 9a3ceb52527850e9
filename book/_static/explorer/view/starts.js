// The plane of starts as it stands behind the phase portrait, and a button for each motion found in it.
gearpair.define("starts", ["plane", "verdict"], function (planes, verdict) {
  const { ACROSS, UP } = planes;
  const WAIT = 600; // milliseconds without a change before the worker starts
  const PALER = 0.6; // a second motion of a colour, as in gearpair.plotting.basins
  const FAR = 12; // of a motion that escapes, no start further out is tried

  class Starts {
    // `chips` is a list, `note` says how many; `onPick({ x, v })` sets a start, `onChange()` draws the phase portrait.
    constructor({ chips, note, onPick, onChange }) {
      Object.assign(this, { chips, note, onPick, onChange });
      this.worker = planes.start();
      this.worker.onmessage = ({ data }) => this.receive(data);
      this.order = 0;
      this.key = "";
      this.picture = document.createElement("canvas"); // a pixel a start
      [this.picture.width, this.picture.height] = [ACROSS, UP];
      this.clear();
      chips.addEventListener("click", ({ target }) => {
        const button = target.closest("button");
        if (button) this.onPick(this.motions[button.dataset.number].start);
      });
    }

    // No motion is known, and no start is followed. The buttons stay where they are until there are others.
    clear() {
      this.worker.postMessage({ id: ++this.order });
      clearTimeout(this.timer);
      this.motions = []; // { motion, start, count, met }
      this.fields = []; // { number, size } of a motion and of what it stands for, by field
      this.range = null;
      this.drawn = null;
      this.busy = false;
      this.chips.inert = true;
      this.note.textContent = "";
    }

    // Forget what was found unless it is of this gear pair, however it starts.
    of(state) {
      const { x: _x, v: _v, diagram: _diagram, ...rest } = state;
      const key = JSON.stringify(rest);
      if (key === this.key) return;
      this.key = key;
      clearTimeout(this.timer);
      if (this.range || !this.motions) this.clear();
    }

    // A motion that the page shows is found and met; the plane behind it covers the `range` of its picture.
    show(shown, range) {
      this.of(shown.state);
      clearTimeout(this.timer);
      const go = () => this.include(shown, range);
      if (this.range) go();
      else this.timer = setTimeout(go, WAIT);
    }

    include(shown, range) {
      const { x, v } = shown.state;
      this.present = this.number(shown, { x, v });
      this.motions[this.present].met = true;
      const wanted = shown.points.length ? range : clipped(range);
      const wider = !this.range || !covers(this.range, wanted);
      if (wider) {
        this.range = this.range ? union(this.range, wanted) : wanted;
        this.busy = true;
        this.worker.postMessage({ id: ++this.order, oscillator: shown.state, range: this.range });
      }
      this.chips.inert = false;
      this.describe();
    }

    receive({ id, batch, done }) {
      if (id !== this.order) return;
      if (this.drawn !== this.range) {
        this.fields = [];
        for (const known of this.motions) known.count = 0;
        this.drawn = this.range;
        this.picture.getContext("2d").clearRect(0, 0, ACROSS, UP);
      }
      for (const label of batch) this.mark(label);
      this.busy = !done;
      this.describe();
      if (batch.length) this.onChange();
    }

    mark({ i, j, size, x, v, motion }) {
      const field = j * ACROSS + i;
      const before = this.fields[field];
      if (before) this.motions[before.number].count--;
      const number = this.number(motion, { x, v });
      this.fields[field] = { number, size };
      this.motions[number].count++;
      this.paint(field);
    }

    // The place of a motion in the list, at its end if it is new; a start nearer to rest is kept for it.
    number(motion, start) {
      let number = this.motions.findIndex((known) => planes.same(motion, known.motion));
      if (number < 0) number = this.motions.push({ motion, start, count: 0, met: false }) - 1;
      const known = this.motions[number];
      if (Math.hypot(start.x, start.v) < Math.hypot(known.start.x, known.start.v)) known.start = start;
      return number;
    }

    colourName = ({ status, period }) => verdict.colourName(verdict.motionName(status, period));

    // How strong the colour of a motion is: a second one of the colour is paler, and so on.
    shade(number) {
      const name = this.colourName(this.motions[number].motion);
      return PALER ** this.motions.slice(0, number).filter(({ motion }) => this.colourName(motion) === name).length;
    }

    paint(field) {
      if (!this.theme) return;
      const { number, size } = this.fields[field];
      const ctx = this.picture.getContext("2d");
      const place = [field % ACROSS, UP - Math.floor(field / ACROSS) - size, size, size];
      ctx.clearRect(...place);
      ctx.fillStyle = this.theme.motion[this.colourName(this.motions[number].motion)];
      ctx.globalAlpha = this.shade(number);
      ctx.fillRect(...place);
    }

    // Draw it behind the data of `plot`.
    draw(ctx, plot, theme) {
      if (theme !== this.theme) {
        this.theme = theme;
        const coarseFirst = Object.keys(this.fields).sort((p, q) => this.fields[q].size - this.fields[p].size);
        for (const field of coarseFirst) this.paint(field);
      }
      if (!this.drawn || !this.fields.length) return;
      const { left, right, bottom, top } = this.drawn;
      ctx.imageSmoothingEnabled = false;
      ctx.globalAlpha = 0.4;
      ctx.drawImage(this.picture, plot.x(left), plot.y(top), plot.x(right) - plot.x(left), plot.y(bottom) - plot.y(top));
      ctx.globalAlpha = 1;
    }

    // The buttons, and how many of the motions have been shown.
    describe() {
      const total = this.motions.reduce((sum, { count }) => sum + count, 0);
      const found = this.motions.map((known, number) => ({ ...known, number })).filter(({ count, met }) => count || met);
      const met = found.filter((known) => known.met).length;
      const text = found.length ? `motions seen: ${met} of ${found.length} found${this.busy ? " so far" : ""}` : "";
      if (this.note.textContent !== text) this.note.textContent = text;
      found.forEach((known, place) => this.chip(place, known, total));
      while (this.chips.children.length > found.length) this.chips.lastChild.remove();
    }

    // Elements stay where they are, so that none loses the focus.
    chip(place, { motion, number, count, met }, total) {
      const item = this.chips.children[place] ?? this.chips.appendChild(document.createElement("li"));
      if (!item.firstChild) item.innerHTML = '<button type="button"></button>';
      const button = item.firstChild;
      const manner = verdict.FLANKS[motion.impact];
      const name = motion.status === "periodic" && manner ? `${verdict.title(motion)}, ${manner}` : verdict.title(motion);
      const share = total && !(this.busy && !count) ? `, ${count ? Math.max(1, Math.round((100 * count) / total)) : 0} %` : "";
      const text = `${name}${share}${met ? " ✓" : ""}`;
      if (button.textContent !== text) button.textContent = text;
      button.dataset.number = number;
      button.setAttribute("aria-current", String(number === this.present));
      button.style.setProperty("--dot", `var(--gp-${this.colourName(motion).replaceAll(" ", "-")})`);
      button.style.setProperty("--shade", this.shade(number));
    }
  }

  const clipped = ({ left, right, bottom, top }) => ({
    left: Math.max(left, -FAR),
    right: Math.min(right, FAR),
    bottom: Math.max(bottom, -FAR),
    top: Math.min(top, FAR),
  });

  const union = (one, other) => ({
    left: Math.min(one.left, other.left),
    right: Math.max(one.right, other.right),
    bottom: Math.min(one.bottom, other.bottom),
    top: Math.max(one.top, other.top),
  });

  const covers = (one, other) => Object.entries(union(one, other)).every(([side, value]) => one[side] === value);

  return { Starts, union };
});
