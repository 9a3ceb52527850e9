// The mesh force less its mean as sound, at the drive's real speed: what gearpair.design.sound gives, for the page.
//
// A periodic motion is a tone: harmonics of the mesh frequency over its period. Any other is some seconds of the motion,
// whose end is faded into its beginning, so that it can go round. Forces are dimensionless, as in the rest of the page.
gearpair.define("sounds", ["cells", "flow", "observe"], function (tables, flow, observe) {
  const LOUD = 4; // mean forces: what stands for full scale, at least; as LOUD of gearpair/design/sounds.py
  const [LOWEST, HIGHEST] = [30, 8000]; // Hz
  const RATE = 44100; // samples a second
  const OVER = 4; // as many times finer is a motion sampled that does not repeat
  const SECONDS = 3; // of it
  const SEAM = 0.25; // seconds that its end and its beginning share
  const TAPS = 32 * OVER; // of the low-pass filter, to either side

  // What stands for full scale: `before` where that is more, so that what is heard one after another can be compared.
  function fullScale(peak, meanForce, before = 0) {
    return Math.max(LOUD * Math.abs(meanForce), peak, before) || 1;
  }

  // What a settled motion { period, points } sounds like where the mesh frequency is `meshHz`: { base, peak, rms } with
  // either the harmonics { real, imag } of `base` Hz or `samples` that go round; null where there is nothing to hear.
  function sound(state, { period, points }, meshHz) {
    if (!points.length) return null;
    const cells = tables.buildCells(state);
    const start = flow.startAt(cells, points[0].x, points[0].v);
    const heard = period ? tone(cells, start, period, meshHz) : noise(cells, start, meshHz);
    return heard && { ...heard, meshHz, meanForce: state.mean_force };
  }

  const powerOfTwo = (least) => 2 ** Math.ceil(Math.log2(least));

  function tone(cells, start, period, meshHz) {
    const base = meshHz / period;
    const last = Math.floor(HIGHEST / base);
    if (last === 0) return null;
    const count = powerOfTwo(Math.max(4096, 32 * last));
    const { force, status } = observe.record(cells, start, period, count);
    if (status !== flow.OK) return null;
    const cosine = Float64Array.from({ length: count }, (_, i) => Math.cos((2 * Math.PI * i) / count));
    const real = new Float32Array(last + 1);
    const imag = new Float32Array(last + 1);
    const values = new Float64Array(count); // the force in the band
    let square = 0;
    for (let k = Math.max(1, Math.ceil(LOWEST / base)); k <= last; k++) {
      let [c, s] = [0, 0];
      for (let i = 0; i < count; i++) {
        const at = (k * i) % count;
        c += force[i] * cosine[at];
        s += force[i] * cosine[(at + 0.75 * count) % count];
      }
      real[k] = (2 * c) / count;
      imag[k] = (2 * s) / count;
      square += 0.5 * (real[k] ** 2 + imag[k] ** 2);
      for (let i = 0; i < count; i++) {
        const at = (k * i) % count;
        values[i] += real[k] * cosine[at] + imag[k] * cosine[(at + 0.75 * count) % count];
      }
    }
    return { base, real, imag, peak: largest(values), rms: Math.sqrt(square) };
  }

  function noise(cells, start, meshHz) {
    const periods = Math.ceil((SECONDS + SEAM) * meshHz);
    const count = Math.round((periods / meshHz) * RATE) * OVER;
    const { force, status } = observe.record(cells, start, periods, count);
    if (status !== flow.OK) return null;
    const samples = goRound(filtered(force), Math.round(SEAM * RATE));
    const square = samples.reduce((sum, value) => sum + value * value, 0);
    return { base: null, samples, peak: largest(samples), rms: Math.sqrt(square / samples.length) };
  }

  const largest = (values) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);

  // Every OVER-th sample of what lies between LOWEST and HIGHEST: a windowed sinc (Blackman), and a first-order high-pass.
  function filtered(fine) {
    const cutoff = (2 * HIGHEST) / (RATE * OVER);
    const kernel = Float64Array.from({ length: 2 * TAPS + 1 }, (_, i) => {
      const [n, turn] = [i - TAPS, (Math.PI * i) / TAPS];
      const sinc = n === 0 ? cutoff : Math.sin(Math.PI * cutoff * n) / (Math.PI * n);
      return sinc * (0.42 - 0.5 * Math.cos(turn) + 0.08 * Math.cos(2 * turn));
    });
    const mean = fine.reduce((sum, value) => sum + value, 0) / fine.length;
    const out = new Float32Array(Math.floor((fine.length - 2 * TAPS) / OVER));
    const keep = Math.exp((-2 * Math.PI * LOWEST) / RATE);
    let [before, passed] = [0, 0];
    for (let row = 0; row < out.length; row++) {
      let low = 0;
      for (let i = 0; i <= 2 * TAPS; i++) low += kernel[i] * (fine[row * OVER + i] - mean);
      passed = keep * (passed + low - before);
      before = low;
      out[row] = passed;
    }
    return out;
  }

  // The last `seam` samples faded into the first, of equal power.
  function goRound(samples, seam) {
    const round = samples.slice(0, samples.length - seam);
    for (let i = 0; i < seam; i++) {
      const turn = (0.5 * Math.PI * (i + 0.5)) / seam;
      round[i] = Math.sin(turn) * samples[i] + Math.cos(turn) * samples[round.length + i];
    }
    return round;
  }

  return { LOUD, LOWEST, HIGHEST, RATE, fullScale, sound };
});
