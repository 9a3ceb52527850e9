// The sliders: each with a field beside it for exact values.
gearpair.define("controls", ["state"], function ({ NUMBERS, CHOICES, readValue, complaint }) {
  const GROUPS = [
    ["Gear pair", "pair", ["mesh_frequency", "damping_ratio", "mean_force", "error_amplitude", "error_phase"]],
    ["Mesh stiffness", "stiffness", ["contact_ratio", "a", "b"]],
    ["Start", "start", ["x", "v"]],
  ];

  function slider(entry) {
    const { name, symbol, label, min, max, step } = entry;
    const row = document.createElement("div");
    row.className = "gp-slider";
    row.innerHTML =
      `<label for="gp-${name}">${label} <i aria-hidden="true">${symbol}</i></label>` +
      `<input type="number" inputmode="decimal" step="${step}" id="gp-${name}-field" aria-label="${label}, exact value">` +
      `<input type="range" id="gp-${name}" name="${name}" min="${min}" max="${max}" step="${step}">`;
    return row;
  }

  // Fill `form` with sliders; `onChange(changes)` for what the reader moves, `onComplaint(sentence)` for what cannot be.
  function build(form, onChange, onComplaint) {
    const fields = {};
    form.noValidate = true; // a field's step is for its arrow keys; any value in range will do
    for (const [title, part, names] of GROUPS) {
      const group = document.createElement("fieldset");
      group.dataset.group = part;
      group.innerHTML = `<legend>${title}</legend>`;
      for (const name of names) {
        const entry = NUMBERS.find((candidate) => candidate.name === name);
        const row = slider(entry);
        const [, field, range] = row.children;
        range.addEventListener("input", () => onChange({ [name]: range.valueAsNumber }));
        field.addEventListener("change", () => {
          const value = readValue(entry, field.value);
          field.setAttribute("aria-invalid", String(value === null));
          if (value === null) onComplaint(complaint(entry, field.value));
          else onChange({ [name]: value });
        });
        fields[name] = { field, range };
        group.append(row);
      }
      if (part === "pair") group.append(freeFlight(onChange));
      if (part === "stiffness") group.append(reading(onChange));
      form.append(group);
    }
    form.addEventListener("submit", (event) => event.preventDefault());
    return (state) => show(form, fields, state);
  }

  const choicesOf = (name) => CHOICES.find((entry) => entry.name === name).choices;

  // Fill a select with the parameters that a diagram may be over.
  function offer(select) {
    const options = choicesOf("diagram").map((name) => new Option(NUMBERS.find((entry) => entry.name === name).label.toLowerCase(), name));
    select.replaceChildren(...options);
  }

  function reading(onChange) {
    const choice = document.createElement("div");
    choice.className = "gp-choice";
    choice.setAttribute("role", "radiogroup");
    choice.setAttribute("aria-label", "Reading of the stiffness wave");
    const label = (value) => `<label><input type="radio" name="reading" value="${value}"><span>${value}</span></label>`;
    choice.innerHTML = `<b aria-hidden="true">Reading</b>${choicesOf("reading").map(label).join("")}`;
    choice.addEventListener("change", ({ target }) => onChange({ reading: target.value }));
    return choice;
  }

  function freeFlight(onChange) {
    const choice = document.createElement("label");
    choice.className = "gp-check";
    choice.innerHTML = '<input type="checkbox" name="undamped_flight"> No damping while the teeth are apart';
    choice.addEventListener("change", ({ target }) => onChange({ flight_damping: target.checked ? 0 : null }));
    return choice;
  }

  // Darken the track of a slider up to its thumb.
  function fill(range) {
    range.style.setProperty("--filled", `${(100 * (range.valueAsNumber - range.min)) / (range.max - range.min)}%`);
  }

  function show(form, fields, state) {
    for (const [name, { field, range }] of Object.entries(fields)) {
      const text = String(Number(state[name].toPrecision(6)));
      if (field.value !== text) field.value = text; // a number that was refused, too
      field.removeAttribute("aria-invalid");
      if (range.shown === state[name]) continue;
      range.shown = state[name];
      range.value = state[name];
      fill(range);
    }
    const box = form.querySelector("[name=undamped_flight]");
    box.checked = state.flight_damping === 0;
    box.indeterminate = state.flight_damping > 0; // by the address
    for (const radio of form.querySelectorAll("[name=reading]")) radio.checked = radio.value === state.reading;
  }

  return { build, fill, offer };
});
