// The numbers that describe a settled motion.
gearpair.define("measures", [], function () {
  // Largest mesh force over the mean force, both as moduli; null where there is no mean force.
  function loadFactor(force, meanForce) {
    return meanForce === 0 ? null : force / Math.abs(meanForce);
  }

  // Eigenvalues [re, im] of [m00, m01, m10, m11], the largest modulus first (then the larger imaginary part).
  function multipliers(m) {
    const half = 0.5 * (m[0] + m[3]);
    const determinant = m[0] * m[3] - m[1] * m[2];
    const square = half * half - determinant;
    if (square <= 0) {
      const imaginary = Math.sqrt(-square);
      return [[half, imaginary], [half, -imaginary]];
    }
    const first = half + (half < 0 ? -1 : 1) * Math.sqrt(square);
    return [[first, 0], [determinant / first, 0]];
  }

  // One-sided amplitude spectrum of samples over `periods` mesh periods, their number a power of two: { frequency,
  // amplitude }, frequency in units of the mesh frequency. `hann` suits motions that do not repeat within the span.
  function spectrum(samples, periods, hann = false) {
    const n = samples.length;
    const re = new Float64Array(n);
    const im = new Float64Array(n);
    for (let i = 0; i < n; i++) re[i] = samples[i] * (hann ? 1 - Math.cos((2 * Math.PI * i) / n) : 1);
    transform(re, im);
    const frequency = Float64Array.from({ length: n / 2 }, (_, k) => k / periods);
    const amplitude = frequency.map((_, k) => ((k === 0 ? 1 : 2) * Math.hypot(re[k], im[k])) / n);
    return { frequency, amplitude };
  }

  // The discrete Fourier transform in place (Cooley and Tukey, 1965); the length is a power of two.
  function transform(re, im) {
    const n = re.length;
    for (let i = 1, j = 0; i < n; i++) {
      let bit = n >> 1;
      for (; j & bit; bit >>= 1) j ^= bit;
      j ^= bit;
      if (i < j) {
        [re[i], re[j]] = [re[j], re[i]];
        [im[i], im[j]] = [im[j], im[i]];
      }
    }
    for (let length = 2; length <= n; length *= 2) {
      const half = length / 2;
      for (let k = 0; k < half; k++) {
        const c = Math.cos((-2 * Math.PI * k) / length);
        const s = Math.sin((-2 * Math.PI * k) / length);
        for (let i = k; i < n; i += length) {
          const a = re[i + half] * c - im[i + half] * s;
          const b = re[i + half] * s + im[i + half] * c;
          re[i + half] = re[i] - a;
          im[i + half] = im[i] - b;
          re[i] += a;
          im[i] += b;
        }
      }
    }
  }

  return { loadFactor, multipliers, spectrum, transform };
});
