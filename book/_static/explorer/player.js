// A recorded motion played back: where it is at a moment, and what it has just struck.
gearpair.define("player", [], function () {
  // X, X', mesh force and the last impact at `time` (mesh periods, from 0 to the record's end).
  function at(recorded, time, periodsPerSecond) {
    const { x, v, force, periods, crossings } = recorded;
    const exact = (time / periods) * x.length;
    const i = Math.min(Math.floor(exact), x.length - 1);
    const next = Math.min(i + 1, x.length - 1);
    const share = exact - i;
    let last = null;
    for (const crossing of crossings) {
      if (crossing.time > time) break;
      if (crossing.contact) last = crossing;
    }
    return {
      x: x[i] + share * (x[next] - x[i]),
      v: v[i] + share * (v[next] - v[i]),
      force: force[i],
      impact: last && { side: last.side, age: (time - last.time) / periodsPerSecond },
    };
  }

  const prefersStill = () => window.matchMedia("(prefers-reduced-motion: reduce)").matches;

  return { at, prefersStill };
});
