// What the motion is, in words and numbers, on the page and read out once it stands.
gearpair.define("readout", ["measures", "plot"], function ({ IMPACT_NAMES }, { sign }) {
  const QUIET = 700; // milliseconds without a change before a motion is read out

  const MEANINGS = {
    periodic: "The motion has settled on a stable periodic orbit.",
    aperiodic: "Chaos for as long as it was followed: the largest Lyapunov exponent is positive, well outside its uncertainty.",
    unsettled: "Neither periodic nor of a resolved positive exponent; without damping there is nothing to settle on.",
    escaped: "The motion grows without bound: start nearer to the play, or raise the damping.",
    capped: "Too many impacts in one mesh period: this is outside what a gear can do.",
    settling: "Still settling: the pictures show the motion on its way.",
  };

  const short = (value, digits = 3) => sign(Number(value).toPrecision(digits));
  const fixed = (value) => sign(value.toFixed(3));

  function multiplierText([[re, im], [other]]) {
    return im === 0 ? `${fixed(re)}, ${fixed(other)}` : `${fixed(re)} ± ${fixed(Math.abs(im))} i`;
  }

  function values(motion) {
    const { status, multipliers, exponent, error, loadFactor, low, high, impact } = motion;
    const known = low !== undefined;
    return {
      motion: motion.name,
      impact: known ? IMPACT_NAMES[impact] : "–",
      load: known && loadFactor !== null ? short(loadFactor) : "–",
      range: known ? `${fixed(low)} to ${fixed(high)}` : "–",
      multipliers: multipliers ? multiplierText(multipliers) : "–",
      modulus: multipliers ? `largest modulus ${Math.hypot(...multipliers[0]).toFixed(3)}` : "",
      exponent: known ? fixed(exponent) : "–",
      error: status === "periodic" || !known ? "" : `± ${error.toFixed(3)}`,
    };
  }

  // `root` holds elements marked data-value; `live` is the status region for screen readers.
  function build(root, live, meaning) {
    let timer;
    return function show(motion) {
      const shown = values(motion);
      for (const element of root.querySelectorAll("[data-value]")) {
        const text = shown[element.dataset.value];
        if (element.textContent !== text) element.textContent = text;
      }
      meaning.textContent = MEANINGS[motion.status];
      clearTimeout(timer);
      timer = setTimeout(() => (live.textContent = sentence(motion, shown)), QUIET);
    };
  }

  function sentence(motion, shown) {
    if (motion.low === undefined) return `${motion.name}. ${MEANINGS[motion.status]}`;
    const stability = motion.multipliers ? shown.modulus : `largest exponent ${shown.exponent} ${shown.error}`;
    return `${motion.name}, impacts: ${shown.impact}, load factor ${shown.load}, X from ${shown.range}, ${stability}.`;
  }

  return { build, values, MEANINGS };
});
