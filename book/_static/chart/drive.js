// The drive of the page's fields: what they may hold, in the library's words, and what follows from a drawing.
// gearpair/parameters.py, drive.py and scales.py for solid discs of steel and an error of one harmonic.
gearpair.define(
  "chart/drive",
  ["chart/data", "chart/numbers", "chart/pair", "chart/mesh"],
  function (data, { repr, general, linspace }, { SpurPair }, { meshStiffness, inertia }) {
    const FIELDS = data.groups.flatMap(({ fields }) => fields);
    const DEFAULTS = Object.fromEntries(FIELDS.map(({ name, value }) => [name, value]));
    const SAMPLES = 256; // over a mesh period, of what is not known exactly
    const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
    const LIMITS = [["above", "above"], ["at_least", "at least"], ["below", "below"], ["at_most", "at most"]];

    // What stands in a field: a number, null where it is empty, else the text, which `check` refuses.
    function read(field, text) {
      const bare = text.trim();
      if (bare === "") return null;
      return !field.choices && NUMBER.test(bare) ? Number(bare) : bare;
    }

    const quoted = (value) => (typeof value === "number" ? (Number.isInteger(value) ? String(value) : repr(value)) : `'${value}'`);

    // Throw a sentence unless the field may have this value.
    function check(field, value) {
      const { name, choices, whole, limits } = field;
      if (choices) {
        if (!choices.includes(value)) {
          throw new Error(`${name} must be one of ${choices.map((each) => `'${each}'`).join(", ")}, got ${quoted(value)}`);
        }
        return;
      }
      if (value === null) {
        if (field.value === null) return;
        throw new Error(`${name} is needed (${field.meaning})`);
      }
      if (whole) {
        if (Number.isInteger(value) && value >= limits.at_least) return;
        throw new Error(`${name} must be a whole number of at least ${limits.at_least}, got ${quoted(value)}`);
      }
      const number = typeof value === "number";
      const inside = { above: (a) => value > a, at_least: (a) => value >= a, below: (a) => value < a, at_most: (a) => value <= a };
      if (number && Number.isFinite(value) && LIMITS.every(([key]) => limits[key] === undefined || inside[key](limits[key]))) return;
      const told = LIMITS.filter(([key]) => limits[key] !== undefined).map(([key, word]) => `${word} ${general(limits[key])}`);
      const allowed = `a finite number${told.length ? ` ${told.join(" and ")}` : ""}`;
      throw new Error(`${name} must be ${allowed}, got ${number ? repr(value) : quoted(value)}`);
    }

    // The drive of a state { name: value }, or a sentence thrown. Plain numbers and arrays, which a worker can be sent.
    function driveOf(state) {
      for (const field of FIELDS) check(field, state[field.name]);
      const pair = new SpurPair({ ...data.steel, ...state });
      const { lowest_rpm: low, highest_rpm: high } = state;
      if (low !== null && high !== null && !(low < high)) {
        throw new Error(`lowest_rpm must be below highest_rpm, got lowest_rpm = ${quoted(low)} and highest_rpm = ${quoted(high)}`);
      }
      const { mean, edges, levels, share } = meshStiffness(pair, data.n_levels, SAMPLES);
      const inertias = ["pinion", "gear"].map((who) => inertia(pair[who], state.face_width_mm) + state[`${who}_added_inertia_kg_m2`]);
      const [r1, r2] = [pair.pinion.base * 1e-3, pair.gear.base * 1e-3];
      const mass = 1 / (r1 ** 2 / inertias[0] + r2 ** 2 / inertias[1]);
      const natural = Math.sqrt(mean / mass); // rad/s
      const backlash = pair.normalBacklash(state.backlash_um, state.backlash);
      const half = backlash * 0.5e-6; // m: one unit of X
      const meanForce = state.pinion_torque_nm / r1; // N
      return {
        teeth: pair.pinion.teeth, contactRatio: pair.contactRatio, pitch: pair.pinion.pitch, mass, mean, natural, half, meanForce, edges, levels,
        unitForce: half * mean, // N: one unit of force
        resonance: (60 * natural) / (2 * Math.PI * pair.pinion.teeth), // rpm
        damping_ratio: state.damping_ratio,
        error: state.transmission_error_um * 1e-6,
        most: share.map((each, i) => each * levelAt(edges, levels, i / SAMPLES)), // of the largest tooth force, at samples
        state,
      };
    }

    function levelAt(edges, levels, fraction) {
      let i = levels.length - 1;
      while (edges[i] > fraction) i--;
      return levels[i];
    }

    // The oscillator at a speed of the pinion and a phase of the error, as the engine takes it.
    function oscillatorAt(drive, rpm, phase) {
      return {
        mean_force: drive.meanForce / drive.unitForce,
        error_amplitude: drive.error / drive.half,
        error_phase: phase,
        damping_ratio: drive.damping_ratio,
        mesh_frequency: (drive.teeth * rpm * 2 * Math.PI) / 60 / drive.natural,
        edges: drive.edges,
        levels: drive.levels,
      };
    }

    // The speeds of the chart, as `gearpair drive` takes them: as given, or around the mesh resonance.
    function speedsOf({ resonance, state }, count) {
      const { first, last, beyond } = data.reach;
      const high = state.highest_rpm ?? Math.max(last * resonance, beyond * (state.lowest_rpm ?? 0));
      return linspace(state.lowest_rpm ?? Math.min(first * resonance, 0.5 * high), high, count);
    }

    // The phases of the error that are tried: one where there is no error.
    function phasesOf(drive) {
      if (drive.error === 0) return [0];
      return Array.from({ length: data.n_phases }, (_, k) => (2 * Math.PI * k) / data.n_phases);
    }

    return { FIELDS, DEFAULTS, SAMPLES, read, check, driveOf, levelAt, oscillatorAt, speedsOf, phasesOf };
  },
);
