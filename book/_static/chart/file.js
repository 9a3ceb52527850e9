// A drive in an address and in a file: `#module_mm=2&...` as this page reads it, pair.yml as the library does.
gearpair.define("chart/file", ["chart/drive", "chart/numbers"], function ({ FIELDS, DEFAULTS, read, check }, { repr }) {
  // { state, complaints } of an address's hash. What is not given, or not allowed, has its default.
  function parse(hash) {
    const state = { ...DEFAULTS };
    const complaints = [];
    for (const [name, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
      const field = FIELDS.find((candidate) => candidate.name === name);
      if (!field) {
        complaints.push(`There is no “${name}” on this page; there are ${FIELDS.map((each) => each.name).join(", ")}.`);
        continue;
      }
      try {
        check(field, read(field, text));
        state[name] = read(field, text);
      } catch (refusal) {
        complaints.push(`${refusal.message}. ${field.value === null ? "None" : field.value} is taken.`);
      }
    }
    return { state, complaints };
  }

  // The hash of a state: what differs from the page's own.
  function format(state) {
    const changed = FIELDS.filter(({ name, value }) => state[name] !== value);
    return changed.map(({ name }) => `${name}=${state[name] ?? ""}`).join("&");
  }

  // The text of pair.yml: what differs from the library's defaults, each line with its meaning.
  function yaml(state) {
    const lines = FIELDS.filter(({ name, default: taken }) => state[name] !== null && state[name] !== taken).map((field) => {
      const value = state[field.name];
      const text = typeof value !== "number" || field.whole ? String(value) : repr(value);
      return `${`${field.name}: ${text}`.padEnd(36)}  # ${field.meaning}${field.unit ? `; ${field.unit}` : ""}`;
    });
    return `# A drive from the speed chart in the page. The command: gearpair drive pair.yml\n${lines.join("\n")}\n`;
  }

  return { parse, format, yaml };
});
