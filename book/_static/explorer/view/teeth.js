// Two teeth and the play between them, drawn larger than life: a tooth of one gear in the space of the other.
gearpair.define("teeth", ["plot"], function ({ prepare }) {
  const LEAN = Math.tan((20 * Math.PI) / 180);
  const FLASH = 0.35; // seconds that the ring of an impact is seen

  // Where the tooth stands for a displacement X, in half widths of the play. Beyond contact the teeth give way, which
  // is drawn too small, and the less the further, so that every motion fits the picture.
  function place(x) {
    const beyond = Math.max(Math.abs(x) - 1, 0);
    const give = 0.8 * Math.tanh(beyond / 2.5);
    return Math.sign(x) * (Math.min(Math.abs(x), 1) + give);
  }

  // A flank from the root (s = -1) over the pitch line (s = 0) to the tip (s = 1) of a tooth, bulging a little.
  function flank(path, x, y, height, side, bend, down) {
    for (let i = 0; i <= 12; i++) {
      const s = down ? 1 - i / 6 : i / 6 - 1;
      const root = (s + 1) / 2;
      path.push([x - side * (LEAN * s * height + 0.05 * height * s * s) + bend * root * root * 4 * 0.7, y(s)]);
    }
  }

  function trace(ctx, points) {
    ctx.beginPath();
    points.forEach(([x, y], i) => (i ? ctx.lineTo(x, y) : ctx.moveTo(x, y)));
    ctx.closePath();
  }

  // `now`: X, the mesh force over the mean force, and the last impact { side, age } in seconds (or null).
  function drawTeeth(canvas, theme, now, labels = true) {
    const paper = prepare(canvas);
    const { ctx, width, height } = paper;
    const scale = Math.min(width / 340, height / 250);
    const cx = width / 2;
    const cy = height * (labels ? 0.44 : 0.5);
    const tall = 52 * scale; // half the height of a flank
    const half = 34 * scale; // half the thickness of a tooth at the pitch line
    const play = 20 * scale; // half the play
    const at = place(now.x);
    const shift = play * at;
    const over = play * (Math.abs(at) > 1 ? at - Math.sign(at) : 0);
    const edge = 1.6;

    // The space: a tooth on either side, the touched one bent.
    const lower = (s) => cy - s * tall;
    for (const side of [-1, 1]) {
      const touched = over !== 0 && Math.sign(over) === side;
      const bend = touched ? over : 0;
      const near = cx + side * (half + play);
      const far = cx + side * (3 * half + play + 6 * scale);
      const points = [[near - side * (30 * scale), height + 4]];
      points.push([near - side * 12 * scale + side * LEAN * tall, lower(-1) + 10 * scale]);
      flank(points, near, lower, tall, -side, bend, false);
      const outer = [];
      flank(outer, far, lower, tall, side, bend, true);
      points.push(...outer, [far + side * (26 * scale), lower(-1) + 10 * scale], [far + side * (60 * scale), height + 4]);
      trace(ctx, points);
      ctx.fillStyle = theme.steel;
      ctx.strokeStyle = theme["steel-edge"];
      ctx.lineWidth = edge;
      ctx.lineJoin = "round";
      ctx.fill();
      ctx.stroke();
    }
    // The root between them, over the two outlines.
    ctx.fillStyle = theme.steel;
    ctx.fillRect(cx - half - play - 22 * scale, lower(-1) + 11 * scale, 2 * (half + play + 22 * scale), height);

    // The tooth in the space.
    const upper = (s) => cy + s * tall;
    const mine = [[cx + shift - 80 * scale, -4], [cx + shift - half - LEAN * tall - 12 * scale, upper(-1) - 12 * scale]];
    flank(mine, cx + shift - half, upper, tall, -1, 0, false);
    flank(mine, cx + shift + half, upper, tall, 1, 0, true);
    mine.push([cx + shift + half + LEAN * tall + 12 * scale, upper(-1) - 12 * scale], [cx + shift + 80 * scale, -4]);
    trace(ctx, mine);
    ctx.fillStyle = theme.paper;
    ctx.fill();
    ctx.globalAlpha = 0.22;
    ctx.fillStyle = theme.ink;
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.strokeStyle = theme.ink;
    ctx.stroke();

    glow(ctx, theme, now, { cx, cy, half, play, shift, scale });
    if (labels) gauge(ctx, theme, now.x, { cx, play, at, width, height, scale });
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
  function gauge(ctx, theme, x, { cx, play, at, height, scale }) {
    const unit = 2.2 * play;
    const y = height - 26;
    ctx.fillStyle = theme.paper;
    ctx.globalAlpha = 0.82;
    ctx.beginPath();
    ctx.roundRect(cx - 2 * unit, y - 14, 4 * unit, 38, 8);
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
    ctx.fillStyle = x > 1 ? theme.drive : x < -1 ? theme.coast : theme.ink;
    ctx.beginPath();
    ctx.arc(cx + at * unit, y, 5, 0, 2 * Math.PI);
    ctx.fill();
  }

  return { drawTeeth, place };
});
