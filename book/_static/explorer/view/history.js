// X over time, with a dot at each contact made, and the motion kept in grey behind.
gearpair.define("history", ["plot"], function ({ prepare, axes, inside, padded }) {
  function drawHistory(canvas, theme, { recorded, colour, kept }) {
    const paper = prepare(canvas);
    const { ctx } = paper;
    const { x: values, periods, crossings } = recorded;
    const others = kept?.recorded.x ?? [];
    const [bottom, top] = padded(Math.min(-1, ...values, ...others), Math.max(1, ...values, ...others));
    const range = { left: 0, right: periods, bottom, top };
    const plot = axes(paper, range, theme, { xLabel: "time (mesh periods)", yLabel: "X" });
    inside(paper, plot, () => {
      ctx.fillStyle = theme.backlash;
      ctx.fillRect(plot.box.left + 1, plot.y(1), plot.box.right - plot.box.left, plot.y(-1) - plot.y(1));
      ctx.lineJoin = "round";
      if (kept) {
        const spans = kept.repeats ? Math.ceil(periods / kept.recorded.periods) : 1; // what repeats goes on
        ctx.strokeStyle = theme.muted;
        ctx.lineWidth = 1.4;
        for (let i = 0; i < spans; i++) line(ctx, plot, kept.recorded, i * kept.recorded.periods);
      }
      ctx.strokeStyle = colour;
      ctx.lineWidth = 1.6;
      line(ctx, plot, recorded, 0);
      ctx.fillStyle = theme.paper;
      ctx.lineWidth = 1.2;
      for (const { time, side, contact } of crossings) {
        if (!contact) continue;
        ctx.beginPath();
        ctx.arc(plot.x(time), plot.y(side), 2.8, 0, 2 * Math.PI);
        ctx.fill();
        ctx.stroke();
      }
    });
    return plot;
  }

  function line(ctx, plot, { x: values, periods }, from) {
    const step = Math.max(1, Math.floor((values.length / (2 * (plot.x(periods) - plot.x(0))))));
    ctx.beginPath();
    for (let i = 0; i < values.length; i += step) ctx.lineTo(plot.x(from + (i * periods) / values.length), plot.y(values[i]));
    ctx.stroke();
  }

  return { drawHistory };
});
