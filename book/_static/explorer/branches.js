// The bifurcation diagram, computed in a worker while one looks: a rising sweep from the start, then a falling one; on
// demand also the branch of a motion that the two have missed, followed up and down to where it meets what is known. At
// last all that is chaotic so far is watched on, for as long as the library watches.
gearpair.define("branches", ["library", "cells", "flow", "settle", "verdict"], function (library, tables, flow, settle, verdict) {
  const SETTINGS = { exponentPeriods: library.settling.manyExponentPeriods, samples: 64, watch: library.settling.watch };
  const SAME = 1e-3; // section points of known motions that lie this close are of one motion

  // Columns { place, value, falling, motion, points, lasted } one by one, nothing in between them; each motion starts where
  // the one before it ended. A column that has come before, by its `place`, takes its place. `known` keeps them by their
  // value on the grid. With `from`, a value of the parameter, the motion through (x, v) there is followed to either side.
  function* columns({ oscillator, parameter, lower, upper, count, x, v, from }, known = new Map()) {
    const grid = Array.from({ length: count }, (_, i) => i);
    const first = from === undefined ? 0 : Math.ceil(((from - lower) / (upper - lower)) * (count - 1));
    const ways = from === undefined ? [grid, grid.toReversed()] : [grid.slice(first), grid.slice(0, first).toReversed()];
    let places = [...known.values()].flat().length;
    const open = []; // [column, the work that goes on watching it]
    let motion = { x, v };
    for (const [falling, way] of ways.entries()) {
      if (from !== undefined) motion = { x, v };
      for (const i of way) {
        const value = lower + ((upper - lower) * i) / (count - 1);
        const cells = tables.buildCells({ ...oscillator, [parameter]: value });
        motion = flow.startAt(cells, motion.x, motion.v);
        const work = settle.settling(cells, motion, SETTINGS);
        const settled = yield* judged(work);
        if (!settled.points.length) motion = { x, v };
        const column = { place: places, value, falling: falling === 1, ...seen(settled) };
        const here = known.get(i) ?? [];
        if (from !== undefined && here.some((other) => same(column, other))) break;
        known.set(i, [...here, column]);
        places++;
        yield { ...column };
        if (settled.watching) open.push([column, work]);
        motion = { ...motion }; // the work may move its own
      }
    }
    for (const [column, work] of open) yield { ...Object.assign(column, seen(yield* ended(work))) };
  }

  // The first verdict of a work.
  function* judged(work) {
    for (;;) {
      const { value } = work.next();
      if (value) return value;
      yield;
    }
  }

  // Its last.
  function* ended(work) {
    for (;;) {
      const { done, value } = work.next();
      if (done) return value;
      yield;
    }
  }

  const seen = ({ status, period, points, lasted }) => ({ motion: verdict.motionName(status, period), points, lasted });

  function same(one, other) {
    if (one.motion !== other.motion || one.motion === "chaos") return one.motion === other.motion;
    const [p] = one.points;
    return one.points.length === 0 || other.points.some((q) => Math.hypot(p.x - q.x, p.v - q.v) < SAME);
  }

  // What runs in the worker. A new order takes the place of the one under way; one with `from` adds to the last.
  function serve({ columns }, port) {
    let order = 0;
    let known = new Map();
    port.onmessage = ({ data }) => {
      const own = ++order;
      if (!data.parameter) return; // an order without one only ends the last
      if (data.from === undefined) known = new Map();
      const work = columns(data, known);
      const go = () => {
        if (own !== order) return;
        const batch = [];
        const end = performance.now() + 120; // seldom enough not to slow a drag
        let result = { done: false };
        while (!result.done && performance.now() < end) {
          result = work.next();
          if (result.value) batch.push(result.value);
        }
        port.postMessage({ id: data.id, batch, done: result.done });
        if (!result.done) setTimeout(go, 0);
      };
      go();
    };
  }

  const start = () => gearpair.use("worker").start("branches", serve);

  return { columns, start, serve };
});
