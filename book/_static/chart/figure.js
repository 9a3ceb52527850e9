// The picture of a chart: the dynamic factor over the speed. Colours of lines as in gearpair/plotting/speed_chart.py.
gearpair.define("chart/figure", ["plot", "chart/verdict", "chart/words"], function ({ prepare, axes, inside }, { degrees }, { differences }) {
  const LEAP = 0.25; // change from one speed to the next, of the largest factor, that is drawn as a jump
  const FLOOR = 0.8;
  const BEYOND = 1e5; // where a motion without bound is drawn
  const TALL = 16; // a factor beyond which the axis is logarithmic, so that the rest can be seen too
  const DECADES = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000].map((factor) => [Math.log10(factor), String(factor)]);

  // The colours of chart.css as they are now.
  function readInks(element) {
    const style = getComputedStyle(element);
    const names = ["together", "single", "double", "other", "avoid", "grey", "phases", "damping", "ghost"];
    return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--gp-${name}`).trim()]));
  }

  const STATES = {
    none_drive: "together", none_coast: "together", single_drive: "single", single_coast: "single", double: "double",
  };

  // `shown`: { chart, iso, told }, and perhaps `linear`, `band`, `ghost` (another `shown`). Returns the plot's maps.
  function drawChart(canvas, theme, inks, { chart, iso, told, linear, band, ghost }) {
    const paper = prepare(canvas);
    const { ctx, width } = paper;
    const { speeds } = chart;
    const tops = [...chart.factorHigh, ...(iso?.factors ?? []), ...(ghost ? ghost.chart.factorHigh : []), ...(band ? band.factors[0] : [])];
    const most = Math.max(1.2, ...tops.filter(Number.isFinite));
    const tall = most > TALL;
    const scale = tall ? Math.log10 : (value) => value;
    const top = tall ? scale(most * 1.3) : FLOOR + (most - FLOOR) * 1.08;
    const range = { left: speeds[0], right: speeds.at(-1), bottom: scale(FLOOR), top };
    const yTicks = tall ? DECADES.filter(([value]) => value < top) : undefined;
    const yLabel = "largest mesh force / mean force";
    const drawn = axes(paper, range, theme, { xLabel: "speed of the pinion (rpm)", yLabel, xTicks: ticksOf(range, width), yTicks });
    const plot = { ...drawn, y: (factor) => drawn.y(scale(factor)) };
    inside(paper, plot, () => {
      ctx.fillStyle = inks.avoid;
      for (const { lower, upper } of told.avoid) {
        ctx.fillRect(plot.x(lower), plot.box.top, Math.max(plot.x(upper) - plot.x(lower), 2), plot.box.bottom - plot.box.top);
      }
      if (band) area(ctx, plot, band.speeds, band.factors[1], band.factors[0], inks.damping);
      if (chart.unknown) area(ctx, plot, speeds, chart.factorLow, chart.factorHigh, inks.phases);
      ctx.lineJoin = "round";
      if (linear) line(ctx, plot, linear.speeds, linear.factors, { colour: inks.grey, width: 1 });
      if (iso && !iso.outside) line(ctx, plot, speeds, iso.factors, { colour: inks.grey, width: 1.4, dash: [6, 3] });
      if (ghost) line(ctx, plot, ghost.chart.speeds, ghost.chart.factorHigh, { colour: inks.ghost, width: 2.2, dash: [1.5, 3.5] });
      run(ctx, plot, inks, chart, "down", { width: 1.9, dash: [5, 3] });
      run(ctx, plot, inks, chart, "up", { width: 2.4, dash: [] });
      if (!chart.unknown) circles(ctx, plot, inks, chart);
    });
    avoided(ctx, plot, theme, told.avoid);
    return plot;
  }

  // Round speeds, none so near to an end that its words would be cut off.
  function ticksOf({ left, right }, width) {
    const rough = (right - left) / Math.max(3, width / 90);
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough);
    const last = right - ((right - left) * 14) / width;
    const values = [];
    for (let k = Math.ceil(left / step); k * step < last; k++) values.push(Number((k * step).toPrecision(12)));
    return values.map((value) => [value, String(value)]);
  }

  function line(ctx, plot, xs, ys, { colour, width, dash = [] }) {
    ctx.strokeStyle = colour;
    ctx.lineWidth = width;
    ctx.lineCap = "butt";
    ctx.setLineDash(dash);
    ctx.beginPath();
    xs.forEach((x, i) => {
      if (!Number.isFinite(ys[i])) return;
      if (Number.isFinite(ys[i - 1])) ctx.lineTo(plot.x(x), plot.y(ys[i]));
      else ctx.moveTo(plot.x(x), plot.y(ys[i]));
    });
    ctx.stroke();
    ctx.setLineDash([]);
  }

  function area(ctx, plot, xs, low, high, colour) {
    ctx.fillStyle = colour;
    ctx.beginPath();
    xs.forEach((x, i) => ctx.lineTo(plot.x(x), plot.y(high[i] || BEYOND)));
    for (let i = xs.length - 1; i >= 0; i--) ctx.lineTo(plot.x(xs[i]), plot.y(low[i] || BEYOND));
    ctx.closePath();
    ctx.fill();
  }

  // A run, broken where it jumps, in the colour of the impact state.
  function run(ctx, plot, inks, chart, name, { width, dash }) {
    const { speeds } = chart;
    const motions = chart[name];
    const most = Math.max(...motions.map(({ factor }) => factor || 0));
    const states = motions.map(({ impact }) => STATES[impact] ?? "other");
    const jumps = (i) => Math.abs(motions[i].factor - motions[i - 1].factor) > LEAP * most;
    for (let first = 0; first < speeds.length; ) {
      let last = first + 1;
      while (last < speeds.length && states[last] === states[first] && !jumps(last)) last++;
      const end = last < speeds.length && !jumps(last) ? last + 1 : last;
      line(ctx, plot, speeds.slice(first, end), motions.slice(first, end).map(({ factor }) => factor), { colour: inks[states[first]], width, dash });
      first = last;
    }
  }

  // Where a start found a worse motion than either run.
  function circles(ctx, plot, inks, { speeds, up, down, worst }) {
    ctx.strokeStyle = inks.other;
    ctx.lineWidth = 1.2;
    worst.forEach(({ factor }, i) => {
      if ([up[i], down[i]].some((each) => Math.abs(each.factor - factor) <= 1e-6 * factor) || !Number.isFinite(factor)) return;
      ctx.beginPath();
      ctx.arc(plot.x(speeds[i]), plot.y(factor), 2.6, 0, 2 * Math.PI);
      ctx.stroke();
    });
  }

  // "avoid" over each shaded range that is wide enough for the word.
  function avoided(ctx, plot, theme, ranges) {
    ctx.font = `600 11.5px ${theme.font}`;
    ctx.fillStyle = theme.drive;
    ctx.textAlign = "left";
    ctx.textBaseline = "top";
    for (const { lower, upper } of ranges) {
      const word = plot.x(upper) - plot.x(lower) > 96 ? "speeds to avoid" : "avoid";
      if (plot.x(upper) - plot.x(lower) > 36) ctx.fillText(word, plot.x(lower) + 6, plot.box.top + 5);
    }
  }

  // The cursor on a canvas of its own: a line at a speed, and a dot on each run.
  function drawCursor(canvas, theme, inks, plot, chart, i) {
    const { ctx } = prepare(canvas);
    const x = plot.x(chart.speeds[i]);
    ctx.strokeStyle = theme.ink;
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(x, plot.box.top);
    ctx.lineTo(x, plot.box.bottom);
    ctx.stroke();
    for (const [name, radius] of [["down", 6.5], ["up", 4.5]]) {
      const { factor, impact } = chart[name][i];
      if (!Number.isFinite(factor)) continue;
      ctx.beginPath();
      ctx.arc(x, plot.y(factor), radius, 0, 2 * Math.PI);
      ctx.fillStyle = name === "up" ? inks[STATES[impact] ?? "other"] : theme.paper;
      ctx.fill();
      ctx.lineWidth = 2;
      ctx.strokeStyle = name === "up" ? theme.paper : inks[STATES[impact] ?? "other"];
      ctx.stroke();
    }
  }

  // What the legend names: [class, words].
  function legendOf({ chart, iso, linear, band, ghost }) {
    const states = new Set([...chart.up, ...chart.down].map(({ impact }) => STATES[impact] ?? "other"));
    const words = { together: "teeth together", single: "one flank struck", double: "both flanks struck", other: "other" };
    const phase = chart.unknown ? `, at the worst phase, ${degrees(chart.phases[chart.chosen])}` : "";
    return [
      ["line", `run up${phase}`], ["dash", "run down"],
      ...Object.keys(words).filter((name) => states.has(name)).map((name) => [`dot ${name}`, words[name]]),
      ...(chart.unknown ? [["area phases", "any phase of the error"]] : []),
      ...(iso && !iso.outside ? [["dash grey", "ISO 6336-1"]] : []),
      ...(linear ? [["thin grey", "linear response"]] : []),
      ...(band ? [["area damping", "damping halved to doubled"]] : []),
      ...(ghost ? [["dots ghost", `pinned: ${differences(ghost.chart.drive.state, chart.drive.state)}`]] : []),
    ];
  }

  return { readInks, drawChart, drawCursor, legendOf };
});
