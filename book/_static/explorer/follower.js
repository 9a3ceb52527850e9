// What follows the page's motion in a worker, so that the page has only to draw.
//
// An order { id, state } is a new gear pair and start, one without a state asks for the next stretch of a motion that
// does not repeat. An answer { id, shown } is the motion described, { id, lasted } how long it has been watched by now,
// { id, recorded } a next stretch.
gearpair.define("follower", ["model"], function ({ Model }) {
  function serve({ Model }, port) {
    const [SLICE, PASSING, REPORT] = [12, 150, 400]; // milliseconds: of work, between pictures on the way, between reports
    const model = new Model();
    let order = null;
    let saidAt = -Infinity;
    let running = false;

    function tell(shown) {
      saidAt = performance.now();
      port.postMessage({ id: order, shown });
    }

    function go() {
      running = false;
      const before = model.settled;
      const judged = model.advance(SLICE);
      const { settled, done } = model;
      const waited = performance.now() - saidAt;
      if (!judged && waited > PASSING) tell(model.describe());
      // A verdict whose points are the same is of the same motion, watched for longer.
      else if (judged && (settled.points !== before?.points || settled.watching !== before?.watching)) tell(model.describe());
      else if (judged && settled !== before && waited > REPORT) {
        saidAt = performance.now();
        port.postMessage({ id: order, lasted: settled.lasted });
      }
      if (!done) later();
    }

    function later() {
      if (!running) setTimeout(go, 0);
      running = true;
    }

    port.onmessage = ({ data }) => {
      if (data.state) {
        order = data.id;
        model.reset(data.state);
        later();
      } else if (data.id === order && model.settled?.points.length) {
        port.postMessage({ id: order, recorded: model.next() });
      }
    };
  }

  // A port that takes orders: a worker's, or one on this thread where the browser refuses a worker.
  const start = () => gearpair.use("worker").start("model", serve);

  return { start, serve };
});
