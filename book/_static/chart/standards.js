// What is usually taken: ISO 6336-1's dynamic factor, method B, and the linear, time-invariant response.
// gearpair/teeth/iso6336.py, gearpair/design/dynamic_factor.py and linear.py.
gearpair.define("chart/standards", ["measures", "chart/data", "chart/numbers", "chart/drive"], function ({ transform }, data, { general }, { levelAt }) {
  const [MAIN_RESONANCE, SUPERCRITICAL] = [1.15, 1.5];
  const N_SAMPLES = 4096; // over a mesh period

  // c' and c_gamma in N/(mm um) at a specific load; throws a sentence outside the formula's range.
  function isoStiffness({ state, contactRatio }, load) {
    const gears = [[state.pinion_teeth, state.pinion_shift], [state.gear_teeth, state.gear_shift]];
    gears.sort(([z, x], [other, shift]) => z - other || shift - x);
    const [[z1, x1], [z2, x2]] = gears;
    if (x1 < x2) {
      throw new Error(
        `ISO 6336-1's formula needs the smaller gear's shift to be at least the larger one's, ${general(x2)}, got ${general(x1)}`,
      );
    }
    if (!(x1 + x2 >= -0.5 && x1 + x2 <= 2)) {
      throw new Error(`ISO 6336-1's formula needs pinion_shift + gear_shift from -0.5 to 2, got ${general(x1 + x2)}`);
    }
    const light = Math.min(load / 100, 1) ** 0.25;
    const terms = [1, 1 / z1, 1 / z2, x1, x1 / z1, x2, x2 / z2, x1 ** 2, x2 ** 2];
    const theoretical = 1 / data.flexibility.reduce((sum, c, i) => sum + c * terms[i], 0);
    const rack = (1 + 0.5 * (1.2 - state.addendum - state.clearance)) * (1 - 0.02 * (20 - state.pressure_angle_deg));
    const single = (0.8 * theoretical * rack * light * data.steel.youngs_modulus_gpa * 1e3) / data.steel_mpa;
    return { single, mesh: single * (0.75 * contactRatio + 0.25) };
  }

  // { factors, outside }: K_v at each speed; NaN and a sentence where the standard has none.
  function isoFactors(drive, speeds) {
    const { state, contactRatio: e } = drive;
    const load = (state.pinion_torque_nm * 1e3) / drive.pitch / state.face_width_mm;
    let stiffness;
    try {
      stiffness = isoStiffness(drive, load);
    } catch (refusal) {
      return { factors: speeds.map(() => NaN), outside: refusal.message };
    }
    const lower = load >= 100 ? 0.85 : 0.5 + 0.35 * Math.sqrt(load / 100);
    const [pitch, profile] = [state.base_pitch_um, state.profile_um].map((size) => (stiffness.single / load) * size);
    const resonance = (30000 / (Math.PI * drive.teeth)) * Math.sqrt(stiffness.mesh / (drive.mass / state.face_width_mm));
    let [c2, c3, c4, c6] = [0.34, 0.23, 0.9, 0.47];
    if (e > 2) [c2, c3, c4, c6] = [0.57 / (e - 0.3), 0.096 / (e - 1.56), (0.57 - 0.05 * e) / (e - 1.44), 0.12 / (e - 1.74)];
    const c7 = e <= 1.5 ? 0.75 : e <= 2.5 ? 0.125 * Math.sin(Math.PI * (e - 2)) + 0.875 : 1;
    const slow = 0.32 * pitch + c2 * profile + c3;
    const peak = 0.32 * pitch + c2 * profile + c4 + 1;
    const fast = 0.47 * pitch + c6 * profile + c7;
    const factors = speeds.map((speed) => {
      const ratio = speed / resonance;
      let factor = fast;
      if (ratio <= lower) factor = 1 + ratio * slow;
      else if (ratio <= MAIN_RESONANCE) factor = peak;
      else if (ratio < SUPERCRITICAL) factor = fast + ((peak - fast) / (SUPERCRITICAL - MAIN_RESONANCE)) * (SUPERCRITICAL - ratio);
      return Math.max(factor, 1);
    });
    return { factors, outside: "" };
  }

  // The largest force of the forced vibration about the static deflection over the mean force, as a function of an
  // oscillator: teeth always in contact, mean stiffness, every harmonic by itself.
  function linearFactors(drive) {
    const half = N_SAMPLES / 2;
    const [waveRe, waveIm] = harmonics(drive, half);
    const levels = Float64Array.from({ length: N_SAMPLES }, (_, i) => levelAt(drive.edges, drive.levels, i / N_SAMPLES));
    return function factor({ mean_force, error_amplitude, error_phase, damping_ratio, mesh_frequency }) {
      const [re, im] = [new Float64Array(N_SAMPLES), new Float64Array(N_SAMPLES)];
      for (let n = 1; n < half; n++) {
        let [a, b] = [-waveRe[n] * mean_force, -waveIm[n] * mean_force];
        if (n === 1) {
          a += 0.5 * error_amplitude * Math.sin(error_phase) * mesh_frequency ** 2;
          b -= 0.5 * error_amplitude * Math.cos(error_phase) * mesh_frequency ** 2;
        }
        const [c, d] = [1 - (n * mesh_frequency) ** 2, 2 * damping_ratio * n * mesh_frequency];
        const square = c * c + d * d;
        re[n] = 2 * ((a * c + b * d) / square);
        im[n] = 2 * ((b * c - a * d) / square);
      }
      transform(im, re); // the sum over e^(+2 pi i n k / N): the two parts change places
      let largest = -Infinity;
      for (let i = 0; i < N_SAMPLES; i++) largest = Math.max(largest, mean_force + re[i] + (levels[i] - 1) * mean_force);
      return largest / mean_force;
    };
  }

  // Fourier coefficients of the staircase from order 1 to below `count`.
  function harmonics({ edges, levels }, count) {
    const [re, im] = [new Float64Array(count), new Float64Array(count)];
    for (let m = 1; m < count; m++) {
      levels.forEach((level, i) => {
        const [a, b] = [2 * Math.PI * m * edges[i], 2 * Math.PI * m * edges[i + 1]];
        re[m] += (level * (Math.sin(b) - Math.sin(a))) / (2 * Math.PI * m);
        im[m] += (level * (Math.cos(b) - Math.cos(a))) / (2 * Math.PI * m);
      });
    }
    return [re, im];
  }

  return { isoFactors, linearFactors };
});
