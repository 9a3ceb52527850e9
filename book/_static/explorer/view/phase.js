// X' over X, with the section points, and the start that a click moves.
gearpair.define("phase", ["plot"], function ({ prepare, axes, inside, padded }) {
  function drawPhase(canvas, theme, { recorded, period, points, start, colour }) {
    const paper = prepare(canvas);
    const { ctx } = paper;
    const { x: xs, v: vs } = recorded;
    const within = (value) => Math.min(Math.max(value, -12), 12); // a far start does not shrink the motion to a dot
    const [left, right] = padded(Math.min(-1.5, within(start.x), ...xs), Math.max(1.5, within(start.x), ...xs));
    const [bottom, top] = padded(Math.min(-1, within(start.v), ...vs), Math.max(1, within(start.v), ...vs));
    const plot = axes(paper, { left, right, bottom, top }, theme, { xLabel: "X", yLabel: "X′" });
    inside(paper, plot, () => {
      ctx.fillStyle = theme.backlash;
      ctx.fillRect(plot.x(-1), plot.box.top, plot.x(1) - plot.x(-1), plot.box.bottom - plot.box.top);
      ctx.strokeStyle = colour;
      ctx.globalAlpha = points.length > 64 ? 0.35 : 1;
      ctx.lineWidth = points.length > 64 ? 1 : 1.6;
      ctx.lineJoin = "round";
      ctx.beginPath();
      const once = period ? Math.ceil((xs.length * period) / recorded.periods) : xs.length - 1; // a cycle need not be retraced
      for (let i = 0; i <= once; i++) ctx.lineTo(plot.x(xs[i % xs.length]), plot.y(vs[i % xs.length]));
      ctx.stroke();
      ctx.globalAlpha = 1;
      drawPoints(ctx, theme, plot, points, colour);
      drawStart(ctx, theme, plot.x(start.x), plot.y(start.v));
    });
    return plot;
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
