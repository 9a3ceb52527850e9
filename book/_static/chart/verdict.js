// What a chart says: columns over the speed, the speeds to avoid, and the sentences of the library's `design.verdict`.
// gearpair/design/charts.py, speed_ranges.py and verdicts.py.
gearpair.define("chart/verdict", ["chart/data", "chart/numbers"], function (data, { fixed, general }) {
  const numbers = (values) => values.filter((value) => !Number.isNaN(value));
  const largest = (values) => numbers(values).reduce((most, value) => Math.max(most, value), -Infinity);
  const orNaN = (value) => (value === -Infinity ? NaN : value);
  const finite = (value) => (Number.isNaN(value) ? Infinity : value);
  const argmax = (values) => values.indexOf(Math.max(...values));

  // Columns over the speed of `seen[k][i]`, what was found at phase k and speed i.
  function columnsOf(drive, speeds, phases, seen) {
    const chosen = argmax(seen.map((row) => Math.max(...row.flatMap(({ motions }) => motions.map(({ meshForce }) => finite(meshForce))))));
    const at = speeds.map((_, i) => seen.map((row) => row[i]));
    const most = (name) => at.map((column) => column.map(({ motions }) => orNaN(largest(motions.map((motion) => motion[name])))));
    const factors = most("factor");
    const worst = at.map((column) => argmax(column.map(({ motions, worst: k }) => finite(motions[k].toothForce))));
    return {
      drive, speeds, phases, chosen,
      unknown: drive.error > 0, // the phase, of which not all may have been tried yet
      up: seen[chosen].map(({ motions }) => motions[0]),
      down: seen[chosen].map(({ motions, down }) => motions[down]),
      worst: at.map((column, i) => column[worst[i]].motions[column[worst[i]].worst]),
      worstPhase: worst.map((k) => phases[k]),
      factorHigh: factors.map((row) => orNaN(largest(row))),
      factorLow: factors.map((row) => -orNaN(largest(row.map((value) => -value)))),
      apartHigh: most("apart").map((row) => orNaN(largest(row))),
      velocityHigh: most("velocity").map((row) => orNaN(largest(row))),
      loss: at.map((column) => data.losses[Math.max(...column.map(({ loss }) => data.losses.indexOf(loss)))]),
    };
  }

  // The ranges in which the teeth part, by rising speed; bounded midway between two speeds of the chart.
  function speedsToAvoid({ speeds, unknown, loss, ...chart }) {
    const stretches = [];
    for (let first = 0; first < speeds.length; ) {
      let last = first;
      while (last < speeds.length && (loss[last] !== "") === (loss[first] !== "")) last++;
      const before = stretches.at(-1);
      if (loss[first] && before && speeds[first] - speeds[before[1] - 1] < data.narrowest * speeds[first]) before[1] = last;
      else if (loss[first]) stretches.push([first, last]);
      first = last;
    }
    const edge = (i) => (i === 0 ? speeds[0] : i === speeds.length ? speeds.at(-1) : 0.5 * (speeds[i - 1] + speeds[i]));
    return stretches.map(([first, last]) => {
      const factors = chart.factorHigh.slice(first, last);
      const top = argmax(factors.map(finite));
      const ways = [...new Set(loss.slice(first, last).filter(Boolean))];
      const told = unknown && numbers(factors).length > 0;
      return {
        lower: edge(first), upper: edge(last),
        why: `the teeth ${ways.join("; at other speeds they ")}`,
        factor: orNaN(largest(factors)),
        apart: orNaN(largest(chart.apartHigh.slice(first, last))),
        velocity: orNaN(largest(chart.velocityHigh.slice(first, last))),
        phase: told ? chart.worstPhase[first + top] : null,
      };
    });
  }

  const degrees = (phase) => `${fixed((phase * 180) / Math.PI, 0)}°`;
  const percent = (share) => `${fixed(share * 100, 0)}%`;
  const threeDigits = (value) => (Math.abs(value) >= 99.95 ? fixed(value, 0) : general(value, 3));
  const byIso = (factor) =>
    Number.isFinite(factor) ? `against ${fixed(factor, 2)} by ISO 6336-1` : "where ISO 6336-1 defines none for this pair";

  // { avoid, together, rule, sentences }: the point first. `iso` are ISO's factors at the chart's speeds.
  function verdictOf(chart, iso) {
    const { speeds } = chart;
    const avoid = speedsToAvoid(chart);
    const edges = [speeds[0], ...avoid.flatMap(({ lower, upper }) => [lower, upper]), speeds.at(-1)];
    const together = [];
    for (let i = 0; i < edges.length; i += 2) if (edges[i] < edges[i + 1]) together.push([edges[i], edges[i + 1]]);
    const spans = together.map(([low, high]) => `${fixed(low, 0)} and ${fixed(high, 0)}`).join(" or between ");
    const rule = together.length ? `run between ${spans} rpm` : "no speed of the range will do";
    const sentences = [
      `To keep the teeth together: ${rule}.`,
      phaseSentence(chart),
      quietSentence(chart, iso, together),
      worstSentence(chart, iso),
      `The chart has ${speeds.length} speeds from ${fixed(speeds[0], 0)} to ${fixed(speeds.at(-1), 0)} rpm; between them it may miss a narrow range, and beyond them nothing was computed.`,
    ];
    return { avoid, together, rule, sentences: sentences.filter(Boolean) };
  }

  function phaseSentence({ phases, chosen, unknown }) {
    if (!unknown) return "No phase had to be chosen: there is no transmission error.";
    const worst = degrees(phases[chosen]);
    const n = phases.length;
    const held = `of the ${n} that were tried ${worst} is the worst; the verdict holds for all ${n}, not for every other`;
    const tried = n > 1 ? held : `${worst} alone was tried; the verdict holds for no other`;
    return `No drawing gives the phase of the error against the stiffness wave; ${tried}.`;
  }

  function quietSentence({ speeds, factorHigh }, iso, together) {
    const free = speeds.map((speed, i) => Number.isFinite(factorHigh[i]) && together.some(([low, high]) => low <= speed && speed <= high));
    if (!free.includes(true)) return "";
    const loud = argmax(speeds.map((_, i) => (free[i] ? factorHigh[i] / (Number.isNaN(iso[i]) ? 1 : iso[i]) : 0)));
    const top = argmax(speeds.map((_, i) => (free[i] ? factorHigh[i] : 0)));
    const compared = Number.isFinite(iso[loud])
      ? `over ISO 6336-1 it is most at ${fixed(speeds[loud], 0)} rpm, ${fixed(factorHigh[loud], 2)} to ${fixed(iso[loud], 2)}`
      : "ISO 6336-1 defines none for this pair";
    return (
      "Together is not quiet: there the dynamic factor, the largest mesh force over the mean, reaches " +
      `${fixed(factorHigh[top], 2)} at ${fixed(speeds[top], 0)} rpm; ${compared}.`
    );
  }

  function worstSentence({ drive, speeds, factorHigh, apartHigh }, iso) {
    if (!numbers(factorHigh).length) return "";
    const top = argmax(factorHigh.map((value) => (Number.isNaN(value) ? -Infinity : value)));
    const force = (factorHigh[top] * drive.meanForce) / 1000;
    const apart = largest(apartHigh);
    const parted = apart > 0 ? `apart for up to ${percent(apart)} of the time` : "never apart";
    return (
      `The worst of the range is a dynamic factor of ${fixed(factorHigh[top], 1)} at ${fixed(speeds[top], 0)} rpm, ` +
      `${byIso(iso[top])}; the mesh then carries up to ${threeDigits(force)} kN. The teeth are ${parted}.`
    );
  }

  return { columnsOf, verdictOf, degrees, percent, threeDigits };
});
