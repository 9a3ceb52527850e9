// Loads the scripts of one part of the book, in the order of their dependencies:
// <script src=".../explorer/load.js" data-part="explorer" defer></script>
(function (scope) {
  "use strict";
  const MOTION = ["modules", "library", "closed_form", "cells", "certified", "flow", "tangent", "observe", "settle", "measures", "verdict"];
  const WORK = ["model", "batches", "branches", "plane", "worker", "follower"];
  const TEETH = ["state", "player", "view/plot", "view/teeth"];
  const PICTURES = ["view/history", "view/starts", "view/phase", "view/spectrum", "view/diagram", "controls", "readout", "compare", "run_up"];
  const SOUND = ["sounds", "listen"];
  const PARTS = {
    motion: [...MOTION, ...WORK, "sounds"],
    explorer: [...MOTION, ...WORK, ...TEETH, ...PICTURES, ...SOUND, "story", "challenges", "explorer"],
    teeth: [...MOTION, "batches", ...TEETH], // for a page with pictures of its own
    story: [...MOTION, ...WORK, ...TEETH, ...SOUND, "story"],
  };
  scope.gearpairParts = PARTS;
  if (typeof document === "undefined") return;
  const { src, dataset } = document.currentScript;
  for (const name of PARTS[dataset.part]) {
    const script = document.createElement("script");
    script.src = src.replace("load.js", `${name}.js`);
    script.async = false; // run in this order
    document.head.append(script);
  }
})(globalThis);
