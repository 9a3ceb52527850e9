// The amplitude spectrum of X: lines of a motion that repeats, a curve of one that does not.
gearpair.define("spectrum_view", ["plot"], function ({ prepare, axes, inside }) {
  const HIGHEST = 5.2; // in mesh frequencies
  const [LEAST, MOST] = [-4, 1]; // powers of ten
  const HALVES = [[0, "0"], [0.5, "1/2"], [1, "1"], [2, "2"], [3, "3"], [4, "4"], [5, "5"]];
  const POWERS = [[-4, "10⁻⁴"], [-3, "10⁻³"], [-2, "10⁻²"], [-1, "0.1"], [0, "1"], [1, "10"]];

  function drawSpectrum(canvas, theme, { spectrum, lines, colour }) {
    const paper = prepare(canvas);
    const { ctx } = paper;
    const range = { left: 0, right: HIGHEST, bottom: LEAST, top: MOST };
    const words = { xLabel: "frequency / mesh frequency", yLabel: "amplitude of X", xTicks: HALVES, yTicks: POWERS };
    const plot = axes(paper, range, theme, words);
    const { frequency, amplitude } = spectrum;
    inside(paper, plot, () => {
      ctx.strokeStyle = colour;
      ctx.fillStyle = colour;
      ctx.lineWidth = lines ? 2 : 1.1;
      ctx.beginPath();
      for (let i = 1; i < frequency.length && frequency[i] <= HIGHEST; i++) {
        const y = plot.y(Math.log10(Math.max(amplitude[i], 1e-12)));
        if (lines) ctx.moveTo(plot.x(frequency[i]), plot.box.bottom);
        ctx.lineTo(plot.x(frequency[i]), y);
        if (lines) ctx.fillRect(plot.x(frequency[i]) - 2.5, y - 2.5, 5, 5);
      }
      ctx.stroke();
    });
    return plot;
  }

  // What its lines tell.
  function tells({ status, period }) {
    if (status === "settling") return "";
    if (status === "floating" || period === 1) return "lines at whole numbers alone: it repeats in every mesh period";
    if (period === 2) return "lines at halves: the period has doubled";
    if (period) return `lines at multiples of 1/${period}: it repeats every ${period} mesh periods`;
    return status === "escaped" ? "" : "a broad band: it does not repeat";
  }

  return { drawSpectrum, tells };
});
