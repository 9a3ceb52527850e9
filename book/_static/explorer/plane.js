// The plane of starts: which motion each start of a grid ends on, from coarse to fine, computed in a worker while one
// looks. Each label is the verdict of `settle`; what is chaotic so far is watched on at last, as long as the library does.
gearpair.define("plane", ["library", "cells", "flow", "settle", "verdict", "batches"], function (library, tables, flow, settle, verdict, batches) {
  const [ACROSS, UP] = [48, 32]; // starts
  const BLOCKS = [4, 2, 1]; // of so many starts aside one is followed first, then one of fewer
  const SETTINGS = { exponentPeriods: library.settling.manyExponentPeriods, samples: 1, watch: library.settling.watch };
  const SAME = 1e-6; // section points of one periodic motion, found from two starts, lie this close

  // The start in the middle of field (i, j), in few digits, so that the page can start at the very same.
  function startOf({ left, right, bottom, top }, i, j) {
    const place = (low, high, share) => Number((low + (high - low) * share).toFixed(4));
    return { x: place(left, right, (i + 0.5) / ACROSS), v: place(bottom, top, (j + 0.5) / UP) };
  }

  // Labels { i, j, size, x, v, motion } one by one, nothing in between them. Field (i, j) is counted from the lower left;
  // until finer ones come, its label stands for the `size` by `size` fields to its right and above it. A later label of
  // the same field takes its place. `motion` is { status, period, points, impact }, without points unless it is periodic.
  function* labels({ oscillator, range }) {
    const cells = tables.buildCells(oscillator);
    const open = []; // [label, the work that goes on watching its motion]
    for (const [level, size] of BLOCKS.entries()) {
      for (let j = 0; j < UP; j += size) {
        for (let i = 0; i < ACROSS; i += size) {
          const coarser = BLOCKS[level - 1];
          if (coarser && i % coarser === 0 && j % coarser === 0) continue; // has been followed
          const start = startOf(range, i, j);
          const work = settle.settling(cells, flow.startAt(cells, start.x, start.v), SETTINGS);
          const settled = yield* verdictOf(work, false);
          const label = { i, j, size, ...start, motion: seen(settled) };
          if (settled.watching) open.push([label, work]);
          yield label;
        }
      }
    }
    for (const [label, work] of open) {
      const motion = seen(yield* verdictOf(work, true));
      if (motion.status !== label.motion.status) yield { ...label, size: 1, motion };
    }
  }

  // The first verdict of a work, or its last.
  function* verdictOf(work, last) {
    for (;;) {
      const { done, value } = work.next();
      if (done || (value && !last)) return value;
      yield;
    }
  }

  function seen({ status, period, points, low, high }) {
    const impact = low === undefined ? null : verdict.impactState(low, high);
    return { status, period, points: status === "periodic" ? points : [], impact };
  }

  // Whether two motions of one oscillator are the same. Those that do not repeat are one, by their status.
  function same(one, other) {
    if (one.status !== other.status || one.period !== other.period) return false;
    if (one.status !== "periodic") return true;
    const [p] = one.points;
    return other.points.some((q) => Math.max(Math.abs(p.x - q.x), Math.abs(p.v - q.v)) < SAME);
  }

  // What runs in the worker: the labels of an order { id, oscillator, range }.
  const answer = (port) => batches.answer(port, (order) => (order.oscillator ? labels(order) : null));

  const start = () => gearpair.use("worker").start("plane", (plane, port) => plane.answer(port));

  return { ACROSS, UP, labels, same, answer, start };
});
