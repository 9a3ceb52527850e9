// X over time, with a dot at each contact made.
gearpair.define("history", ["plot"], function ({ prepare, axes, inside, padded }) {
  function drawHistory(canvas, theme, { recorded, colour }) {
    const paper = prepare(canvas);
    const { ctx } = paper;
    const { x: values, periods, crossings } = recorded;
    const [bottom, top] = padded(Math.min(-1, ...values), Math.max(1, ...values));
    const range = { left: 0, right: periods, bottom, top };
    const plot = axes(paper, range, theme, { xLabel: "time (mesh periods)", yLabel: "X" });
    inside(paper, plot, () => {
      ctx.fillStyle = theme.backlash;
      ctx.fillRect(plot.box.left + 1, plot.y(1), plot.box.right - plot.box.left, plot.y(-1) - plot.y(1));
      ctx.strokeStyle = colour;
      ctx.lineWidth = 1.6;
      ctx.lineJoin = "round";
      ctx.beginPath();
      const step = Math.max(1, Math.floor(values.length / (2 * paper.width)));
      for (let i = 0; i < values.length; i += step) ctx.lineTo(plot.x((i * periods) / values.length), plot.y(values[i]));
      ctx.stroke();
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

  return { drawHistory };
});
