// Loads the speed chart's scripts in the order of their dependencies, after those of the explorer that it rests on:
// <script src=".../explorer/load.js" data-part="teeth" defer></script><script src=".../chart/load.js" defer></script>
(function (scope) {
  "use strict";
  const ENGINE = ["data", "numbers", "tooth", "pair", "body", "mesh", "drive", "standards", "motions", "verdict", "file"];
  const PAGE = ["worker", "study", "words", "figure", "page"];
  scope.gearpairChart = { engine: ENGINE };
  if (typeof document === "undefined") return;
  const { src } = document.currentScript;
  for (const name of [...ENGINE, ...PAGE]) {
    const script = document.createElement("script");
    script.src = src.replace("load.js", `${name}.js`);
    script.async = false; // run in this order
    document.head.append(script);
  }
})(globalThis);
