// Two teeth and the play between them, drawn larger than life: a tooth of one gear in the space of the other.
gearpair.define("teeth", ["plot"], function ({ prepare, stamp }) {
  const LEAN = Math.tan((20 * Math.PI) / 180);
  const FLASH = 0.35; // seconds that the ring of an impact is seen

  // Where the tooth stands for a displacement X, in half widths of the play. Beyond contact the teeth give way, which
  // is drawn too small, and the less the further, so that every motion fits the picture.
  function place(x) {
    const beyond = Math.max(Math.abs(x) - 1, 0);
    return Math.sign(x) * (Math.min(Math.abs(x), 1) + 0.5 * Math.tanh(beyond / 2));
  }

  // The outline of a rack whose teeth point up (way 1) or down (way -1), the teeth shifted by `shift` and bent by `bend`
  // at the pitch line; over the whole width of the picture.
  function rack(ctx, { cx, cy, half, tall, fillet, pitch, width, edge }, first, way, shift, bend) {
    const y = (s) => cy - way * s * tall; // s: -1 at the root of a flank, 0 on the pitch line, 1 at its tip
    const root = cy + way * (tall + fillet);
    const flank = (centre, side, s) => {
      const thick = half - LEAN * s * tall - 0.07 * tall * s * s;
      return centre + side * thick + bend * ((s + 1) / 2) ** 1.3 * 2 ** 1.3;
    };
    ctx.beginPath();
    ctx.moveTo(-9, edge);
    for (let k = -2; k <= 2; k++) {
      const centre = cx + first + k * pitch + shift;
      ctx.lineTo(flank(centre, -1, -1) - fillet, root);
      ctx.quadraticCurveTo(flank(centre, -1, -1), root, flank(centre, -1, -1), y(-1));
      for (let i = 1; i <= 10; i++) ctx.lineTo(flank(centre, -1, i / 5.2 - 1), y(i / 5.2 - 1));
      ctx.quadraticCurveTo(flank(centre, -1, 1), y(1), flank(centre, -1, 1) + 4, y(1));
      ctx.lineTo(flank(centre, 1, 1) - 4, y(1));
      ctx.quadraticCurveTo(flank(centre, 1, 1), y(1), flank(centre, 1, 10 / 5.2 - 1), y(10 / 5.2 - 1));
      for (let i = 9; i >= 0; i--) ctx.lineTo(flank(centre, 1, i / 5.2 - 1), y(i / 5.2 - 1));
      ctx.quadraticCurveTo(flank(centre, 1, -1), root, flank(centre, 1, -1) + fillet, root);
    }
    ctx.lineTo(width + 9, root);
    ctx.lineTo(width + 9, edge);
    ctx.closePath();
  }

  // `now`: X, the mesh force over the mean force, and the last impact { side, age } in seconds (or null).
  function drawTeeth(canvas, theme, now, labels = true) {
    const paper = prepare(canvas);
    const { ctx, width, height } = paper;
    const scale = Math.min(width / 320, height / 240);
    const half = 31 * scale; // half the thickness of a tooth on the pitch line
    const play = 22 * scale; // half the play
    const shape = {
      cx: width / 2,
      cy: height * (labels ? 0.43 : 0.5),
      half,
      tall: 50 * scale, // half the height of a flank
      fillet: 13 * scale,
      pitch: 4 * half + 2 * play,
      width,
    };
    const at = place(now.x);
    const over = Math.abs(at) > 1 ? at - Math.sign(at) : 0;
    ctx.lineWidth = 1.6;
    ctx.lineJoin = "round";
    rack(ctx, { ...shape, edge: height + 9 }, 2 * half + play, 1, 0, play * over);
    ctx.fillStyle = theme.steel;
    ctx.strokeStyle = theme["steel-edge"];
    ctx.fill();
    ctx.stroke();
    rack(ctx, { ...shape, edge: -9 }, 0, -1, play * at, 0);
    ctx.fillStyle = theme.steel2;
    ctx.strokeStyle = theme.ink;
    ctx.fill();
    ctx.stroke();
    const drawn = { ...shape, play, shift: play * at, at, height, scale };
    glow(ctx, theme, now, drawn);
    if (labels) gauge(paper, theme, now.x, drawn);
  }

  // Contact: a spot that grows with the mesh force, and a ring that spreads from each impact.
  function glow(ctx, theme, { force, impact }, { cx, cy, half, shift, scale }) {
    const spot = (side) => [cx + shift + side * half, cy];
    if (force !== 0) {
      const side = Math.sign(force);
      const [x, y] = spot(side);
      const radius = scale * Math.min(9 + 9 * Math.sqrt(Math.abs(force)), 46);
      const fill = ctx.createRadialGradient(x, y, 0, x, y, radius);
      const colour = side > 0 ? theme.drive : theme.coast;
      fill.addColorStop(0, colour);
      fill.addColorStop(0.25, `${colour}b0`);
      fill.addColorStop(1, `${colour}00`);
      ctx.fillStyle = fill;
      ctx.beginPath();
      ctx.arc(x, y, radius, 0, 2 * Math.PI);
      ctx.fill();
    }
    if (impact && impact.age < FLASH) {
      const [x, y] = spot(impact.side);
      const share = impact.age / FLASH;
      ctx.globalAlpha = 1 - share;
      ctx.strokeStyle = impact.side > 0 ? theme.drive : theme.coast;
      ctx.lineWidth = 2.5 * scale;
      ctx.beginPath();
      ctx.arc(x, y, scale * (8 + 34 * share), 0, 2 * Math.PI);
      ctx.stroke();
      ctx.globalAlpha = 1;
    }
  }

  // Where X is: a pointer over the play from -1 to 1.
  function gauge(paper, theme, x, { cx, play, at, height }) {
    const { ctx } = paper;
    const unit = 1.6 * play;
    const y = height - 26;
    stamp(paper, theme, "gauge", (still) => scaleOfX(still, theme, { cx, unit, y }));
    ctx.fillStyle = x > 1 ? theme.drive : x < -1 ? theme.coast : theme.ink;
    ctx.beginPath();
    ctx.arc(cx + at * unit, y, 5, 0, 2 * Math.PI);
    ctx.fill();
  }

  function scaleOfX(ctx, theme, { cx, unit, y }) {
    ctx.fillStyle = theme.paper;
    ctx.globalAlpha = 0.82;
    ctx.beginPath();
    ctx.roundRect(cx - 2.2 * unit, y - 14, 4.4 * unit, 38, 8);
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.fillStyle = theme.backlash;
    ctx.fillRect(cx - unit, y - 4, 2 * unit, 8);
    ctx.strokeStyle = theme.muted;
    ctx.lineWidth = 1;
    ctx.font = `11.5px ${theme.font}`;
    ctx.textAlign = "center";
    ctx.textBaseline = "top";
    ctx.fillStyle = theme.muted;
    ctx.beginPath();
    ctx.moveTo(cx - 1.9 * unit, y);
    ctx.lineTo(cx + 1.9 * unit, y);
    for (const [mark, text] of [[-1, "−1"], [0, "X"], [1, "1"]]) {
      if (mark) ctx.moveTo(cx + mark * unit, y - 5);
      if (mark) ctx.lineTo(cx + mark * unit, y + 5);
      ctx.fillText(text, cx + mark * unit, y + 8);
    }
    ctx.stroke();
  }

  return { drawTeeth, place };
});
