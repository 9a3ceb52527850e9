// What the page says of a motion, of a range and of a drive, in a line each.
gearpair.define("chart/words", ["chart/data", "chart/numbers", "chart/verdict"], function (data, { fixed, general }, { percent, threeDigits, degrees }) {
  // The motion's name: what has no period is told by how long one was looked for.
  function nameOf({ status, period, impact, periods }) {
    if (status === "periodic") return `period ${period}, ${data.impacts[impact]}`;
    if (impact === "") return "leaves what the model can follow";
    return `no period found in ${periods} periods, ${data.impacts[impact]}`;
  }

  function bears({ factor, apart, velocity, rms }) {
    if (Number.isNaN(factor)) return "";
    const struck = velocity > 0 ? `, apart for ${percent(apart)} of the time, flanks meet at ${threeDigits(velocity)} mm/s` : "";
    return `${fixed(factor, 2)} times the mean force${struck}; transmission error ${general(rms, 3)} µm rms`;
  }

  function rangeRow({ lower, upper, why, factor, apart, velocity, phase }) {
    const dash = (value, text) => (Number.isNaN(value) ? "–" : text(value));
    return [
      `${fixed(lower, 0)}–${fixed(upper, 0)}`, why, dash(factor, (value) => fixed(value, 1)), dash(apart, percent),
      dash(velocity, threeDigits), phase === null ? "–" : degrees(phase),
    ];
  }

  // What follows from the drawing: [words, value].
  function factsOf(drive) {
    return [
      ["contact ratio", fixed(drive.contactRatio, 3)],
      ["mesh stiffness", `${fixed(drive.mean / 1e6, 1)} N/µm`],
      ["equivalent mass", `${general(drive.mass, 4)} kg`],
      ["static deflection", `${fixed((drive.meanForce / drive.mean) * 1e6, 2)} µm`],
      ["mean mesh force", `${fixed(drive.meanForce, 0)} N`],
      ["mesh resonance", `${fixed(drive.resonance, 0)} rpm`],
    ];
  }

  // In what one state differs from another, in a few words; the pair itself where in nothing.
  function differences(state, other) {
    const told = data.groups
      .flatMap(({ fields }) => fields)
      .filter(({ name }) => state[name] !== other[name])
      .map(({ name, label, unit }) => `${label} ${state[name] ?? "as it comes"} ${unit.replace("um", "µm")}`.trim());
    return told.length > 3 ? `${told.slice(0, 2).join(", ")} and ${told.length - 2} others` : told.join(", ") || "this drive";
  }

  return { nameOf, bears, rangeRow, factsOf, differences };
});
