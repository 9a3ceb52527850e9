// Programs beside the page: `serve(module, port)` runs in a worker, its port the worker's own.
gearpair.define("worker", [], function () {
  // A worker that takes orders by `postMessage` and answers to `onmessage`; where the browser refuses one, what does the
  // same on the page's thread.
  function start(name, serve) {
    try {
      const source = gearpair.program(name, serve);
      return new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
    } catch {
      const outside = { postMessage: (data) => setTimeout(() => inside.onmessage({ data }), 0) };
      const inside = { postMessage: (data) => setTimeout(() => outside.onmessage({ data }), 0) };
      serve(gearpair.use(name), inside);
      return outside;
    }
  }

  return { start };
});
