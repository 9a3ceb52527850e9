// The bifurcation diagram, computed in a worker while one looks: a rising sweep from the start, then a falling one.
gearpair.define("worker", ["cells", "flow", "settle", "measures"], function (tables, flow, settle, measures) {
  const SETTINGS = { maxPeriod: 32, exponentPeriods: 400, samples: 64 };

  // Columns { value, falling, motion, points } one by one; each motion starts where the one before it ended.
  function* columns({ oscillator, parameter, lower, upper, count, x, v }) {
    let [fromX, fromV] = [x, v];
    for (let i = 0; i < 2 * count; i++) {
      const falling = i >= count;
      const step = falling ? 2 * count - 1 - i : i;
      const value = lower + ((upper - lower) * step) / (count - 1);
      const cells = tables.buildCells({ ...oscillator, [parameter]: value });
      const motion = flow.startAt(cells, fromX, fromV);
      const work = settle.settling(cells, motion, SETTINGS);
      let result;
      do {
        result = work.next();
        if (!result.done) yield null;
      } while (!result.done);
      const { status, period, points } = result.value;
      const bounded = points.length > 0;
      [fromX, fromV] = bounded ? [motion.x, motion.v] : [x, v];
      yield { value, falling, motion: measures.motionName(status, period), points };
    }
  }

  // What runs in the worker. A new order takes the place of the one under way.
  function main({ columns }) {
    let order = 0;
    self.onmessage = ({ data }) => {
      const own = ++order;
      if (!data.parameter) return; // an order without one only ends the last
      const work = columns(data);
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
