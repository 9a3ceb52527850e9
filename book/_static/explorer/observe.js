// What a walk sees on its way: exact extremes of X, the largest mesh force, impacts and samples.
// The record is that of gearpair/_flow/records.py. The extremes are those of reach.py, which spares itself most searches
// for turns by certificates; here every segment that may hold something new is searched.
gearpair.define("observe", ["closed_form", "certified", "flow"], function (closedForm, certified, flow) {
  const { value, evaluate } = closedForm;
  const { nextTurn, leastStep } = certified;
  const { series, ahead, walk } = flow;

  // Range of X and largest modulus of the mesh force k f over `periods`, and over what was `seen` before:
  // { status, low, high, force }.
  function extremes(cells, motion, periods, seen = { low: motion.x, high: motion.x, force: 0 }) {
    let { low, high, force } = seen;
    const status = walk(cells, motion, periods, {
      whole(j, { region }) {
        const reached = Math.abs(region) * Math.max(Math.abs(ahead[2] - region), Math.abs(ahead[3] - region));
        return ahead[2] >= low && ahead[3] <= high && cells.stiffness[cells.level[j]] * reached <= force;
      },
      segment(_period, j, _t, duration, { region }) {
        const stiffness = region === 0 ? 0 : cells.stiffness[cells.level[j]];
        const see = (x) => {
          low = Math.min(low, x);
          high = Math.max(high, x);
          force = Math.max(force, stiffness * Math.abs(x - region));
        };
        see(series[0]);
        evaluate(series, duration);
        see(value[0]);
        for (let t = nextTurn(series, 0, duration); t <= duration; t = nextTurn(series, t + leastStep(series, duration), duration)) {
          evaluate(series, t);
          see(value[0]);
        }
      },
    });
    return { status, low, high, force };
  }

  // `count` samples at equal steps over `periods`, the start included and the end not, and every crossing of X = +-1:
  // { status, periods, x, v, force, crossings }, a crossing being { time, side, velocity, contact }, its time in
  // mesh periods from the start. `force` is the mesh force k f at the samples.
  function record(cells, motion, periods, count) {
    const x = new Float64Array(count);
    const v = new Float64Array(count);
    const force = new Float64Array(count);
    const crossings = [];
    let row = 0;
    const status = walk(cells, motion, periods, {
      whole: () => false,
      segment(period, j, t, duration, { x: boundary, v: velocity, region }, crossed) {
        const span = cells.width[j] / cells.period;
        const start = period + cells.start[j];
        const stiffness = region === 0 ? 0 : cells.stiffness[cells.level[j]];
        const last = j === cells.size - 1 && !crossed ? Infinity : duration; // rounding must not drop a sample
        for (; row < count; row++) {
          const time = (row * periods) / count;
          const at = (time - start) / span - t;
          if (at >= last || time >= period + 1) break;
          evaluate(series, Math.max(at, 0));
          x[row] = value[0];
          v[row] = value[1] / cells.width[j];
          force[row] = stiffness * (value[0] - region);
        }
        if (crossed) {
          crossings.push({ time: start + (t + duration) * span, side: boundary, velocity, contact: region === 0 });
        }
      },
    });
    return { status, periods, x, v, force, crossings };
  }

  return { extremes, record };
});
