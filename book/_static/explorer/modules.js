// Modules without a loader: `define` runs a factory with the modules that it names, and keeps its source.
//
// The book must open by a double click. From a file's address a browser loads neither ES modules nor the script of a
// worker, so these are classic scripts in the order of their dependencies, and a worker gets the kept sources as a Blob.
(function (scope) {
  "use strict";
  const modules = {};
  const sources = [];

  function define(name, dependencies, factory) {
    modules[name] = factory(...dependencies.map(use));
    sources.push([name, dependencies, factory]);
  }

  function use(name) {
    if (!(name in modules)) throw new Error(`the script of module "${name}" must be loaded first`);
    return modules[name];
  }

  // A program for a worker: the modules named, with all that they need, then a call of `main` with the last of them
  // and the worker's own port.
  function program(name, main) {
    const needed = new Set([name]);
    for (const [own, dependencies] of [...sources].reverse()) {
      if (needed.has(own)) dependencies.forEach((dependency) => needed.add(dependency));
    }
    const parts = sources
      .filter(([own]) => needed.has(own))
      .map(([own, dependencies, factory]) => `define(${JSON.stringify(own)}, ${JSON.stringify(dependencies)}, ${factory});`);
    return `"use strict"; const modules = {}, sources = []; ${define} ${use}\n${parts.join("\n")}\n(${main})(use("${name}"), globalThis);`;
  }

  scope.gearpair = { define, use, program };
})(globalThis);
