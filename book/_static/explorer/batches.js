// Long work in a worker: a batch of results at a time, so that a new order can take the place of the one under way.
gearpair.define("batches", [], function () {
  const BATCH = 120; // milliseconds: seldom enough not to slow a drag

  // Answer the orders { id, ... } at `port` by { id, batch, done }. `workOf(order)` is a generator of results, or null
  // where the order only ends the last.
  function answer(port, workOf) {
    let latest = 0;
    port.onmessage = ({ data }) => {
      const own = ++latest;
      const work = workOf(data);
      if (!work) return;
      const go = () => {
        if (own !== latest) return;
        const batch = [];
        const end = performance.now() + BATCH;
        let result = { done: false };
        while (!result.done && performance.now() < end) {
          result = work.next();
          if (result.value) batch.push(result.value);
        }
        port.postMessage({ id: data.id, batch, done: result.done });
        if (!result.done) setTimeout(go, 0);
      };
      go();
    };
  }

  return { answer };
});
