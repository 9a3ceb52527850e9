// Loads the scripts of one part of the book, in the order of their dependencies:
// <script src=".../explorer/load.js" data-part="explorer" defer></script>
(function (scope) {
  "use strict";
  const MOTION = ["modules", "closed_form", "cells", "certified", "flow", "tangent", "observe", "settle", "measures"];
  const TEETH = ["state", "model", "player", "view/plot", "view/teeth"];
  const PICTURES = ["view/history", "view/phase", "view/spectrum", "worker", "view/diagram", "controls", "readout"];
  const SOUND = ["sounds", "listen"];
  const PARTS = {
    motion: [...MOTION, "worker", "sounds"],
    explorer: [...MOTION, ...TEETH, ...PICTURES, ...SOUND, "story", "challenges", "explorer"],
    pair: [...MOTION, ...TEETH, "pair"],
    story: [...MOTION, ...TEETH, ...SOUND, "story"],
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
