// What the motion is, in words and numbers, on the page and read out once it stands.
gearpair.define("readout", ["verdict", "plot"], function ({ IMPACT_NAMES, FLANKS, watched, meaning }, { sign }) {
  const QUIET = 700; // milliseconds without a change before a motion is read out
  const RAISED = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

  const short = (value, digits = 3) => sign(Number(value).toPrecision(digits));
  const fixed = (value) => sign(value.toFixed(3));

  // Three decimals, or two digits of what is less than these can show.
  function significant(value) {
    const size = Math.abs(value);
    if (size >= 0.01 || size === 0) return fixed(value);
    if (size >= 1e-4) return sign(value.toFixed(1 + Math.ceil(-Math.log10(size))));
    const [digits, power] = value.toExponential(1).split("e");
    return `${sign(digits)}·10${[...String(Number(power))].map((letter) => RAISED[letter]).join("")}`;
  }

  // A modulus: so many digits that one below 1 does not look like 1.
  function modulus(value) {
    const gap = Math.abs(1 - value);
    return value.toFixed(gap > 0 && gap < 5e-4 ? Math.min(1 + Math.ceil(-Math.log10(gap)), 9) : 3);
  }

  // A value and its error, two digits of it.
  function measured(value, error) {
    const digits = Math.min(Math.max(Math.ceil(-Math.log10(error)) + 1, 3), 9);
    return [sign(value.toFixed(digits)), `± ${error.toFixed(digits)}`];
  }

  function multiplierText([[re, im], [other]]) {
    return im === 0 ? `${significant(re)}, ${significant(other)}` : `${significant(re)} ± ${significant(Math.abs(im))} i`;
  }

  function values(motion) {
    const { multipliers, exponent, error, loadFactor, low, high, impact } = motion;
    const known = low !== undefined;
    const [rate, spread] = known && error > 0 ? measured(exponent, error) : [known ? significant(exponent) : "–", ""];
    return {
      motion: motion.title,
      manner: known ? FLANKS[impact] : "",
      watched: watched(motion),
      impact: known ? IMPACT_NAMES[impact] : "–",
      load: known && loadFactor !== null ? short(loadFactor) : "–",
      range: known ? `${fixed(low)} to ${fixed(high)}` : "–",
      multipliers: multipliers ? multiplierText(multipliers) : "–",
      modulus: multipliers ? `largest modulus ${modulus(Math.hypot(...multipliers[0]))}` : "",
      exponent: rate,
      error: spread,
    };
  }

  // `root` holds elements marked data-value; `live` is the status region for screen readers.
  function build(root, live, place) {
    let timer;
    const elements = root.querySelectorAll("[data-value]");
    return function show(motion, aloud = true) {
      const shown = values(motion);
      for (const element of elements) {
        const text = shown[element.dataset.value];
        if (element.textContent !== text) element.textContent = text;
      }
      const sense = meaning(motion);
      if (place.textContent !== sense) place.textContent = sense;
      if (!aloud) return;
      clearTimeout(timer);
      timer = setTimeout(() => (live.textContent = sentence(motion, shown)), QUIET);
    };
  }

  function sentence(motion, shown) {
    if (motion.low === undefined) return `${motion.title}. ${meaning(motion)}`;
    const stability = motion.multipliers ? shown.modulus : `largest exponent ${shown.exponent} ${shown.error}`;
    return (
      `${motion.title}, ${shown.manner}, ${shown.watched}, impacts: ${shown.impact}, load factor ${shown.load}, ` +
      `X from ${shown.range}, ${stability}.`
    );
  }

  return { build, values };
});
