// The explorer's state: one gear pair and one start, in the address after the #.
gearpair.define("state", [], function () {
  // A slider goes from `min` to `max`; an address may give any value from `lowest` to `highest`.
  const number = (name, symbol, label, value, min, max, step, lowest = min, highest = max) => ({
    name, symbol, label, value, min, max, step, lowest, highest,
  });
  const NUMBERS = [
    number("mesh_frequency", "Ω<sub>h</sub>", "Mesh frequency", 0.7, 0.2, 3, 0.001),
    number("damping_ratio", "ζ", "Damping ratio", 0.02, 0, 0.2, 0.0005),
    number("mean_force", "F<sub>m</sub>′", "Mean force", 0.1, 0, 0.5, 0.005),
    number("error_amplitude", "F<sub>ah</sub>", "Error amplitude", 0.2, 0, 1, 0.005),
    number("error_phase", "φ<sub>h</sub>", "Error phase (rad)", 0, -3.14, 3.14, 0.01, -6.3, 6.3),
    number("contact_ratio", "ε", "Contact ratio", 1.68, 1.05, 1.95, 0.005, 1.01, 1.99),
    number("a", "a", "Added in double contact", 0.116, 0, 1, 0.002),
    number("b", "b", "Missing in single contact", 0.414, 0, 0.9, 0.002),
    number("x", "X<sub>0</sub>", "Displacement", 1, -6, 6, 0.01, -1000, 1000),
    number("v", "X<sub>0</sub>′", "Velocity", 0, -6, 6, 0.01, -1000, 1000),
  ];
  const CHOICES = [
    { name: "reading", value: "printed", choices: ["printed", "swapped"] },
    { name: "diagram", value: "mesh_frequency", choices: ["mesh_frequency", "damping_ratio", "mean_force", "error_amplitude"] },
  ];
  // A number that need not be given.
  const FLIGHT_DAMPING = number("flight_damping", "ζ<sub>f</sub>", "Damping ratio in free flight", null, 0, 0.2);
  const ENTRIES = [...NUMBERS, FLIGHT_DAMPING, ...CHOICES];
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
