// Motion A, kept by a button and drawn in grey behind the motion shown, B.
gearpair.define("compare", ["state", "readout"], function ({ NUMBERS }, readout) {
  class Comparison {
    // `button` keeps and clears, `note` says what A is, `load` its load factor; `onChange()` draws the pictures.
    constructor({ button, note, load, onChange }) {
      Object.assign(this, { button, note, load, onChange });
      this.kept = null;
      button.addEventListener("click", () => {
        if (!this.shown) return;
        this.wanted = !this.kept;
        this.kept = null;
        this.show(this.shown);
        this.onChange();
      });
    }

    // The motion shown is this now; one that is to be kept is kept once it has settled.
    show(shown) {
      this.shown = shown;
      if (this.wanted && shown.status !== "settling") {
        this.kept = shown.points.length ? shown : null;
        this.wanted = false;
      }
      this.tell();
    }

    tell() {
      const { kept, shown } = this;
      const say = (element, text) => element.textContent !== text && (element.textContent = text);
      const [title, load] = kept ? [words(kept), `A: ${readout.values(kept).load}`] : ["", ""];
      say(this.button, kept ? "Clear A" : "Keep as A");
      say(this.note, kept ? `Grey, A: ${title}. ${difference(kept.state, shown.state)}` : "");
      say(this.load, load);
      this.button.disabled = !kept && !shown.points.length; // nothing to keep of what escapes
    }
  }

  function words(motion) {
    const { motion: title, manner, load } = readout.values(motion);
    return `${title}${manner ? `, ${manner}` : ""}, load factor ${load}`;
  }

  // In which parameters B differs from A, in words.
  function difference(a, b) {
    const value = (state, name) => state[name] ?? "as in contact";
    const changed = NUMBERS.filter(({ name }) => a[name] !== b[name]);
    const named = ({ name, label }) => `${name === "x" || name === "v" ? "start " : ""}${label.toLowerCase()}`;
    const all = changed.map((entry) => [named(entry), entry.name]).map(([label, name]) => `${label} ${short(value(a, name))}, here ${short(value(b, name))}`);
    if (a.reading !== b.reading) all.push(`reading ${a.reading}, here ${b.reading}`);
    return all.length ? `A has ${all.join("; ")}.` : "Here is the same.";
  }

  const short = (value) => (typeof value === "number" ? String(Number(value.toPrecision(4))).replace("-", "−") : value);

  return { Comparison };
});
