// What the pictures share: a sharp canvas, axes, and the page's colours.
gearpair.define("plot", ["library"], function ({ motions: MOTIONS }) {
  // The page's colours as they are now: they change with the theme, and on paper.
  function readTheme(element) {
    const style = getComputedStyle(element);
    const colour = (name) => style.getPropertyValue(`--gp-${name}`).trim();
    const motion = Object.fromEntries(MOTIONS.map((name) => [name, colour(name.replaceAll(" ", "-"))]));
    const names = ["ink", "muted", "line", "backlash", "boundary", "paper", "steel", "steel2", "steel-edge", "drive", "coast"];
    return { ...Object.fromEntries(names.map((name) => [name, colour(name)])), motion, font: style.fontFamily };
  }

  // Sizes of canvases in CSS pixels. To ask for one makes the browser lay out the page, too slow for every frame.
  let sizes = new WeakMap();

  function forgetSizes() {
    sizes = new WeakMap();
  }

  // A context in CSS pixels, { ctx, width, height }, cleared and as sharp as the screen.
  function prepare(canvas) {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (!sizes.has(canvas)) sizes.set(canvas, { width: canvas.clientWidth, height: canvas.clientHeight });
    const { width, height } = sizes.get(canvas);
    const ctx = canvas.getContext("2d");
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, width, height);
    return { canvas, ratio, ctx, width, height };
  }

  // What changes seldom is drawn once, by `draw(ctx)`, and stamped on the paper until its `key` is another one. Text costs
  // most: in a canvas of the page it makes the browser work out the page's styles first.
  const stamps = new WeakMap(); // by canvas: { key, picture }

  function stamp({ canvas, ratio, ctx, width, height }, theme, key, draw) {
    const { font, paper, line, muted, backlash } = theme;
    const full = JSON.stringify([key, width, height, ratio, font, paper, line, muted, backlash]);
    let known = stamps.get(canvas);
    if (known?.key !== full) {
      known = { key: full, picture: known?.picture ?? document.createElement("canvas") };
      [known.picture.width, known.picture.height] = [canvas.width, canvas.height]; // which clears it
      const own = known.picture.getContext("2d");
      own.setTransform(ratio, 0, 0, ratio, 0, 0);
      draw(own);
      stamps.set(canvas, known);
    }
    if (canvas.width && canvas.height) ctx.drawImage(known.picture, 0, 0, canvas.width / ratio, canvas.height / ratio);
  }

  // Round numbers in [low, high], about `count` of them.
  function ticks(low, high, count) {
    const rough = (high - low) / count;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough);
    const first = Math.ceil(low / step - 1e-9);
    const last = Math.floor(high / step + 1e-9);
    return Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
  }

  // Axes around the data of `range` { left, right, bottom, top }: draws them and returns the maps of data to pixels.
  // `xTicks` and `yTicks` are [value, text] where they are not plain numbers.
  function axes(paper, range, theme, words) {
    const { width, height } = paper;
    const box = { left: 50, right: width - 8, top: 8, bottom: height - 36 };
    const x = (value) => box.left + ((value - range.left) / (range.right - range.left)) * (box.right - box.left);
    const y = (value) => box.bottom - ((value - range.bottom) / (range.top - range.bottom)) * (box.bottom - box.top);
    stamp(paper, theme, [range, words], (ctx) => frame(ctx, { box, x, y, height }, range, theme, words));
    const within = (px, py) => px >= box.left && px <= box.right && py >= box.top && py <= box.bottom;
    const data = (px, py) => ({
      x: range.left + ((px - box.left) / (box.right - box.left)) * (range.right - range.left),
      y: range.bottom + ((box.bottom - py) / (box.bottom - box.top)) * (range.top - range.bottom),
    });
    return { box, x, y, data, within };
  }

  function frame(ctx, { box, x, y, height }, range, theme, { xLabel, yLabel, xTicks, yTicks }) {
    ctx.font = `11.5px ${theme.font}`;
    ctx.lineWidth = 1;
    ctx.strokeStyle = theme.line;
    ctx.fillStyle = theme.muted;
    ctx.textAlign = "center";
    ctx.textBaseline = "top";
    ctx.beginPath();
    ctx.moveTo(box.left, box.top);
    ctx.lineTo(box.left, box.bottom);
    ctx.lineTo(box.right, box.bottom);
    const across = Math.max(3, (box.right - box.left) / 70);
    for (const [value, text] of xTicks ?? ticks(range.left, range.right, across).map((t) => [t, sign(t)])) {
      ctx.moveTo(x(value), box.bottom);
      ctx.lineTo(x(value), box.bottom + 4);
      ctx.fillText(text, x(value), box.bottom + 6);
    }
    ctx.textAlign = "right";
    ctx.textBaseline = "middle";
    for (const [value, text] of yTicks ?? ticks(range.bottom, range.top, (box.bottom - box.top) / 40).map((t) => [t, sign(t)])) {
      ctx.moveTo(box.left - 4, y(value));
      ctx.lineTo(box.left, y(value));
      ctx.fillText(text, box.left - 7, y(value));
    }
    ctx.stroke();
    ctx.textAlign = "center";
    ctx.textBaseline = "bottom";
    ctx.fillText(xLabel, (box.left + box.right) / 2, height - 1);
    ctx.save();
    ctx.translate(9, (box.top + box.bottom) / 2);
    ctx.rotate(-Math.PI / 2);
    ctx.textBaseline = "middle";
    ctx.fillText(yLabel, 0, 0);
    ctx.restore();
  }

  const sign = (value) => String(value).replace("-", "−"); // a minus, not a hyphen

  // Draw inside the box only.
  function inside({ ctx }, { box }, draw) {
    ctx.save();
    ctx.beginPath();
    ctx.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    ctx.clip();
    draw();
    ctx.restore();
  }

  // A range of values with some air, outwards to steps of a quarter, so that the axes hold still under small changes.
  function padded(low, high) {
    const air = 0.08 * (high - low) + 0.05;
    const step = high - low > 6 ? 1 : 0.25;
    return [Math.floor((low - air) / step) * step, Math.ceil((high + air) / step) * step];
  }

  return { readTheme, prepare, stamp, forgetSizes, axes, inside, padded, sign };
});
