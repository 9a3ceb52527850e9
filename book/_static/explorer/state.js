// The explorer's state: one gear pair and one start, in the address after the #.
gearpair.define("state", ["library"], function (library) {
  const [NUMBERS, CHOICES] = [library.numbers, library.choices]; // flight_damping need not be given
  const ENTRIES = [...NUMBERS, ...CHOICES];
  const DEFAULTS = Object.fromEntries(ENTRIES.map(({ name, value }) => [name, value]));

  // The entry's value that `text` stands for, or null where it stands for none.
  function readValue(entry, text) {
    if (entry.choices) return entry.choices.includes(text) ? text : null;
    const value = text.trim() === "" ? NaN : Number(text);
    return value >= entry.lowest && value <= entry.highest ? value : null;
  }

  // What is wrong with `text` as a value of the entry: one sentence.
  function complaint(entry, text) {
    const allowed = entry.choices ? `one of ${entry.choices.join(", ")}` : `a number from ${entry.lowest} to ${entry.highest}`;
    return `${entry.name} must be ${allowed}, got “${text}”.`;
  }

  // { state, complaints } of an address's hash, such as "#mesh_frequency=0.8&reading=swapped". What is not given, or
  // not valid, has its default.
  function parse(hash) {
    const state = { ...DEFAULTS };
    const complaints = [];
    for (const [name, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
      const entry = ENTRIES.find((candidate) => candidate.name === name);
      const value = entry ? readValue(entry, text) : null;
      if (!entry) complaints.push(`There is no parameter “${name}”; there are ${ENTRIES.map((e) => e.name).join(", ")}.`);
      else if (value === null) complaints.push(`${complaint(entry, text)} The default ${entry.value ?? "(as in contact)"} is used.`);
      else state[name] = value;
    }
    return { state, complaints };
  }

  // The hash of a state: what differs from the defaults.
  function format(state) {
    const changed = ENTRIES.filter(({ name, value }) => state[name] !== value);
    return changed.map(({ name }) => `${name}=${state[name]}`).join("&");
  }

  return { NUMBERS, CHOICES, DEFAULTS, readValue, complaint, parse, format };
});
