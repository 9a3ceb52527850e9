// The bifurcation diagram, computed in a worker while one looks: a rising sweep from the start, then a falling one; on
// demand also the branch of a motion that the two have missed, followed up and down to where it meets what is known. At
// last all that is chaotic so far is watched on, for as long as the library watches.
gearpair.define("branches", ["library", "cells", "flow", "settle", "verdict", "batches"], function (library, tables, flow, settle, verdict, batches) {
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

  // What runs in the worker: the columns of an order; one with `from` adds to the last.
  function answer(port) {
    let known = new Map();
    batches.answer(port, (order) => {
      if (!order.parameter) return null;
      if (order.from === undefined) known = new Map();
      return columns(order, known);
    });
  }

  const start = () => gearpair.use("worker").start("branches", (branches, port) => branches.answer(port));

  return { columns, answer, start };
});
