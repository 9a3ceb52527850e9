// X' over X, with the section points, the start that a click moves, and the plane of starts behind.
gearpair.define("phase", ["plot", "starts"], function ({ prepare, axes, inside, padded }, { union }) {
  function drawPhase(canvas, theme, { recorded, period, points, start, colour, starts, kept }) {
    const paper = prepare(canvas);
    const { ctx } = paper;
    const { x: xs, v: vs } = recorded;
    const behind = kept?.recorded ?? { x: [], v: [] };
    const within = (value) => Math.min(Math.max(value, -12), 12); // a far start does not shrink the motion to a dot
    const [left, right] = padded(Math.min(-1.5, within(start.x), ...xs, ...behind.x), Math.max(1.5, within(start.x), ...xs, ...behind.x));
    const [bottom, top] = padded(Math.min(-1, within(start.v), ...vs, ...behind.v), Math.max(1, within(start.v), ...vs, ...behind.v));
    const own = { left, right, bottom, top };
    const range = starts.range ? union(own, starts.range) : own; // it holds still from start to start
    const plot = axes(paper, range, theme, { xLabel: "X", yLabel: "X′" });
    inside(paper, plot, () => {
      ctx.fillStyle = theme.backlash;
      ctx.fillRect(plot.x(-1), plot.box.top, plot.x(1) - plot.x(-1), plot.box.bottom - plot.box.top);
      starts.draw(ctx, plot, theme);
      ctx.lineJoin = "round";
      if (kept) {
        orbit(ctx, plot, kept);
        ctx.strokeStyle = theme.muted;
        ctx.lineWidth = 1.4;
        ctx.stroke();
      }
      orbit(ctx, plot, { recorded, period });
      const many = points.length > 64;
      if (starts.range && !many) {
        ctx.strokeStyle = theme.paper; // so that it stands out from starts of its own colour
        ctx.lineWidth = 4;
        ctx.stroke();
      }
      ctx.strokeStyle = colour;
      ctx.globalAlpha = many ? 0.35 : 1;
      ctx.lineWidth = many ? 1 : 1.6;
      ctx.stroke();
      ctx.globalAlpha = 1;
      drawPoints(ctx, theme, plot, points, colour);
      drawStart(ctx, theme, plot.x(start.x), plot.y(start.v));
    });
    return { ...plot, own };
  }

  function orbit(ctx, plot, { recorded: { x: xs, v: vs, periods }, period }) {
    const once = period ? Math.ceil((xs.length * period) / periods) : xs.length - 1; // a cycle need not be retraced
    ctx.beginPath();
    for (let i = 0; i <= once; i++) ctx.lineTo(plot.x(xs[i % xs.length]), plot.y(vs[i % xs.length]));
  }

  function drawPoints(ctx, theme, plot, points, colour) {
    if (points.length > 64) {
      ctx.fillStyle = theme.ink;
      for (const { x, v } of points) ctx.fillRect(plot.x(x) - 0.8, plot.y(v) - 0.8, 1.6, 1.6);
      return;
    }
    for (const { x, v } of points) {
      ctx.beginPath();
      ctx.arc(plot.x(x), plot.y(v), 4.4, 0, 2 * Math.PI);
      ctx.fillStyle = colour;
      ctx.fill();
      ctx.lineWidth = 1.5;
      ctx.strokeStyle = theme.paper;
      ctx.stroke();
    }
  }

  function drawStart(ctx, theme, x, y) {
    ctx.strokeStyle = theme.ink;
    ctx.lineWidth = 1.6;
    ctx.beginPath();
    for (const [dx, dy] of [[1, 1], [1, -1]]) {
      ctx.moveTo(x - 5 * dx, y - 5 * dy);
      ctx.lineTo(x + 5 * dx, y + 5 * dy);
    }
    ctx.stroke();
  }

  return { drawPhase };
});
