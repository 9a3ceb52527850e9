// Long work in a worker: a batch of results at a time, so that a new order can take the place of the one under way.
gearpair.define("batches", [], function () {
  const BATCH = 120; // milliseconds: seldom enough not to slow a drag

  // Hand the results of the generator `work` to `post(batch, done)`, as long as `wanted()`.
  function deliver(work, wanted, post, milliseconds = BATCH) {
    const go = () => {
      if (!wanted()) return;
      const batch = [];
      const end = performance.now() + milliseconds;
      let result = { done: false };
      while (!result.done && performance.now() < end) {
        result = work.next();
        if (result.value) batch.push(result.value);
      }
      post(batch, result.done);
      if (!result.done) setTimeout(go, 0);
    };
    go();
  }

  // Answer the orders { id, ... } at `port` by { id, batch, done }. `workOf(order)` is a generator of results, or null
  // where the order only ends the last.
  function answer(port, workOf) {
    let latest = 0;
    port.onmessage = ({ data }) => {
      const own = ++latest;
      const work = workOf(data);
      const post = (batch, done) => port.postMessage({ id: data.id, batch, done });
      if (work) deliver(work, () => own === latest, post);
    };
  }

  return { deliver, answer };
});
