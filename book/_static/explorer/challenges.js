// Six challenges below the bench: each is met by a motion that the explorer shows, the rest of the gear pair as in the
// baseline. Listens to the event `motionshown`, { state, status, period, low, high, loadFactor }.
gearpair.define("challenges", ["state"], function ({ NUMBERS, DEFAULTS }) {
  const CLATTERING = { x: -2.3, v: 1.5 }; // a start that clatters at the baseline; a test says so
  const together = ({ low }) => low >= 1;
  const clatters = ({ low, high }) => low < -1 && high > 1;

  // `free`: what may differ from the baseline, or from `base`. Of `best` the least or the largest value is kept.
  const CHALLENGES = [
    { text: "Make it clatter by its start alone.", free: ["x", "v"], met: clatters },
    { text: "Reach period 5 by its start alone.", free: ["x", "v"], met: ({ period }) => period === 5 },
    { text: "Silence it, the teeth together, with the least mean force.", free: ["mean_force"], met: together, best: ["mean_force", Math.min] },
    {
      text: "From the start X₀ = −2.3, X₀′ = 1.5: end the clatter with the least damping.",
      base: CLATTERING,
      free: ["damping_ratio"],
      met: (motion) => !clatters(motion),
      best: ["damping_ratio", Math.min],
    },
    {
      text: "Run as fast as you can with the teeth together, by speed and start alone.",
      free: ["mesh_frequency", "x", "v"],
      met: together,
      best: ["mesh_frequency", Math.max],
    },
    {
      text: "Find a load factor above 100, by speed and start alone.",
      free: ["mesh_frequency", "x", "v"],
      met: ({ loadFactor }) => loadFactor > 100,
    },
  ];

  // Whether a settled motion meets the challenge.
  function meets({ base = {}, free, met }, motion) {
    const given = { ...DEFAULTS, ...base, diagram: motion.state.diagram };
    const same = Object.keys(given).every((name) => free.includes(name) || motion.state[name] === given[name]);
    return same && motion.status === "periodic" && met(motion);
  }

  function build(root) {
    const part = document.createElement("details");
    part.className = "gp-challenges";
    part.innerHTML = `<summary>Six challenges</summary><ol>${CHALLENGES.map(({ text }) => `<li>${text} <b></b></li>`).join("")}</ol>`;
    const marks = part.querySelectorAll("b");
    const records = CHALLENGES.map(() => null);
    root.append(part);
    root.addEventListener("motionshown", ({ detail }) => {
      CHALLENGES.forEach((challenge, i) => {
        if (!meets(challenge, detail)) return;
        const { best } = challenge;
        if (!best) marks[i].textContent = "✓ Met.";
        else {
          const [name, better] = best;
          records[i] = records[i] === null ? detail.state[name] : better(records[i], detail.state[name]);
          const { label } = NUMBERS.find((entry) => entry.name === name);
          marks[i].textContent = `✓ Your best: ${label.toLowerCase()} ${records[i]}.`;
        }
      });
    });
  }

  const root = document.getElementById("explorer");
  if (root) build(root);
  return { CHALLENGES, meets };
});
