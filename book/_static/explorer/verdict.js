// The verdict on a motion in words: what it is called, for how long it was watched, and what that means. The page, its
// readout and its diagram take it from here, so that they say the same.
gearpair.define("verdict", ["library"], function ({ impacts, words, motions }) {
  const FLANKS = {
    none_drive: "quiet (no impact)",
    none_coast: "quiet (no impact)",
    single_drive: "rattles (one flank)",
    single_coast: "rattles (one flank)",
    double: "clatters (both flanks)",
    never_in_contact: "floats (no contact)",
  };
  const MEANINGS = {
    settling: "Still settling: the pictures show the motion on its way.",
    periodic: "The motion has settled on a stable periodic orbit.",
    unsettled: "Neither periodic nor of a resolved positive exponent for as long as it was watched.",
    floating: "Without a mean force the teeth need not touch: the motion repeats, and so does any shift of it within the play.",
    capped: "Too many impacts in one mesh period: this is outside what a gear can do.",
    undecided: "Whether a flank is touched or only almost is not decided within rounding here: move a slider a little.",
  };
  const UNDAMPED = " Without damping there is nothing to settle on.";
  const CHAOS = "The largest Lyapunov exponent is positive, well outside its uncertainty: neighbouring starts part. ";
  const WATCHING = "It is watched on, in case it settles after all.";
  const WATCHED = "It may still settle later.";

  // The name under which a motion has its colour and its place in the legend: the library's.
  function motionName(status, period) {
    if (status === "periodic") return `period ${period}`;
    return words[status] ?? status;
  }

  // The colour of a motion among `motions`, as in gearpair/plotting/style.py.
  function colourName(name) {
    if (motions.includes(name)) return name;
    return name.startsWith("period") ? "other periods" : "unsettled";
  }

  // What a motion is called on the page: no more than is known of it.
  function title({ status, period }) {
    return status === "aperiodic" ? "chaotic so far" : motionName(status, period);
  }

  // The impact state from the extremes of X, as in gearpair.impact_state.
  function impactState(low, high) {
    if (low >= 1) return "none_drive";
    if (high <= -1) return "none_coast";
    if (low >= -1 && high >= 1) return "single_drive";
    if (low < -1 && high > 1) return "double";
    return low <= -1 ? "single_coast" : "never_in_contact";
  }

  // A count in groups of three digits.
  const grouped = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, "\u202f");

  // For how long the motion was followed: what the word before it rests on.
  function watched({ status, period, lasted }) {
    if (status === "settling" || lasted === undefined) return "";
    const span = `${grouped(lasted)} mesh periods`;
    if (status === "periodic") return `settled on period ${period} after ${span}`;
    if (status === "aperiodic" || status === "unsettled") return `${span} watched`;
    return `after ${span}`;
  }

  // A sentence or two on what the verdict means. `damped`: whether anything is; `growth`, of an escaped motion: that of a
  // disturbance in contact; `nearer`: a nearer start that stays, or null.
  function meaning({ status, watching, damped, growth, nearer }) {
    if (status === "aperiodic") return `${CHAOS}${damped ? (watching ? WATCHING : WATCHED) : UNDAMPED.trim()}`;
    if (status === "unsettled") return `${MEANINGS.unsettled}${damped ? "" : UNDAMPED}`;
    if (status === "escaped") {
      const why = `The motion grows without bound: at this speed each mesh period in contact multiplies a disturbance by ${growth.toPrecision(3)}.`;
      if (!nearer) return `${why} Nearer starts that were tried escape too.`;
      return `${why} Start nearer to the play: that from X₀ = ${nearer.x}, X₀′ = ${nearer.v} stays.`.replaceAll("= -", "= −");
    }
    return MEANINGS[status];
  }

  return { IMPACT_NAMES: impacts, FLANKS, motionName, colourName, title, impactState, grouped, watched, meaning };
});
