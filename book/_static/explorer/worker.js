// The bifurcation diagram, computed in a worker while one looks: a rising sweep from the start, then a falling one; on
// demand also the branch of a motion that the two have missed, followed up and down to where it meets what is known.
gearpair.define("worker", ["cells", "flow", "settle", "measures"], function (tables, flow, settle, measures) {
  const SETTINGS = { maxPeriod: 32, exponentPeriods: 400, samples: 64 };
  const SAME = 1e-3; // section points of known motions that lie this close are of one motion

  // Columns { value, falling, motion, points } one by one, nothing in between them; each motion starts where the one before it
  // ended. `known` keeps them by their place on the grid. With `from`, a value of the parameter, the motion through
  // (x, v) there is followed to either side instead.
  function* columns({ oscillator, parameter, lower, upper, count, x, v, from }, known = new Map()) {
    const grid = Array.from({ length: count }, (_, i) => i);
    const first = from === undefined ? 0 : Math.ceil(((from - lower) / (upper - lower)) * (count - 1));
    const ways = from === undefined ? [grid, grid.toReversed()] : [grid.slice(first), grid.slice(0, first).toReversed()];
    let motion = { x, v };
    for (const [falling, way] of ways.entries()) {
      if (from !== undefined) motion = { x, v };
      for (const i of way) {
        const value = lower + ((upper - lower) * i) / (count - 1);
        const cells = tables.buildCells({ ...oscillator, [parameter]: value });
        motion = flow.startAt(cells, motion.x, motion.v);
        const { status, period, points } = yield* settle.settling(cells, motion, SETTINGS);
        if (!points.length) motion = { x, v };
        const column = { value, falling: falling === 1, motion: measures.motionName(status, period), points };
        const here = known.get(i) ?? [];
        if (from !== undefined && here.some((other) => same(column, other))) break;
        known.set(i, [...here, column]);
        yield column;
      }
    }
  }

  function same(one, other) {
    if (one.motion !== other.motion || one.motion === "chaos") return one.motion === other.motion;
    const [p] = one.points;
    return one.points.length === 0 || other.points.some((q) => Math.hypot(p.x - q.x, p.v - q.v) < SAME);
  }

  // What runs in the worker. A new order takes the place of the one under way; one with `from` adds to the last.
  function main({ columns }) {
    let order = 0;
    let known = new Map();
    self.onmessage = ({ data }) => {
      const own = ++order;
      if (!data.parameter) return; // an order without one only ends the last
      if (data.from === undefined) known = new Map();
      const work = columns(data, known);
      const go = () => {
        if (own !== order) return;
        const batch = [];
        const end = performance.now() + 40;
        let result = { done: false };
        while (!result.done && performance.now() < end) {
          result = work.next();
          if (result.value) batch.push(result.value);
        }
        self.postMessage({ id: data.id, batch, done: result.done });
        if (!result.done) setTimeout(go, 0);
      };
      go();
    };
  }

  // A worker that takes orders, or null where the browser refuses one.
  function start() {
    try {
      const source = gearpair.program("worker", main);
      return new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
    } catch {
      return null;
    }
  }

  return { columns, start };
});
