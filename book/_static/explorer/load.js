// Loads the scripts of one part of the book, in the order of their dependencies:
// <script src=".../explorer/load.js" data-part="explorer" defer></script>
(function (scope) {
  "use strict";
  const MOTION = ["modules", "library", "closed_form", "cells", "certified", "flow", "tangent", "observe", "settle", "measures", "verdict"];
  const WORK = ["model", "branches", "worker", "follower"];
  const TEETH = ["state", "player", "view/plot", "view/teeth"];
  const PICTURES = ["view/history", "view/phase", "view/spectrum", "view/diagram", "controls", "readout"];
  const PARTS = {
    motion: [...MOTION, ...WORK],
    explorer: [...MOTION, ...WORK, ...TEETH, ...PICTURES, "explorer"],
    pair: [...MOTION, "model", ...TEETH, "pair"],
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
