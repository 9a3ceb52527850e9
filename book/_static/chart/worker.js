// The chart's work, shared by workers: orders in, rows out as they are known.
gearpair.define("chart/worker", ["batches", "chart/motions", "chart/standards", "chart/drive"], function ({ deliver }, { rows }, { linearFactors }, { oscillatorAt }) {
  const SLICE = 40; // milliseconds between two looks for another order

  // What answers orders: { id, ...order of `rows` }, or { id, linear: true, drive, speeds, phase }; one without an id ends
  // the work under way. Answers are { id, batch, done } or { id, linear, done }.
  function server(post) {
    let turn = 0;
    return function take(order) {
      const own = ++turn;
      if (order.id === undefined) return;
      if (order.linear) {
        const factor = linearFactors(order.drive);
        post({ id: order.id, linear: order.speeds.map((rpm) => factor(oscillatorAt(order.drive, rpm, order.phase))), done: true });
        return;
      }
      deliver(rows(order), () => own === turn, (batch, done) => post({ id: order.id, batch, done }), SLICE);
    };
  }

  function main({ server }) {
    const take = server((answer) => self.postMessage(answer));
    self.onmessage = ({ data }) => take(data);
  }

  // A few workers that take orders one after the other; the page itself where the browser refuses one.
  class Pool {
    constructor(onAnswer) {
      this.queue = [];
      this.count = 0;
      const size = Math.min(4, Math.max(1, (navigator.hardwareConcurrency || 2) - 1));
      const members = Array.from({ length: size }, () => this.member(onAnswer));
      this.members = members[0].worker ? members : members.slice(0, 1);
    }

    member(onAnswer) {
      const member = { order: null, worker: null }; // the order under way, { id, about }
      const answered = (answer) => {
        const { order } = member;
        if (order?.id !== answer.id) return; // of an order that was ended
        if (answer.done) member.order = null;
        onAnswer(order.about, answer);
        this.next();
      };
      try {
        const source = gearpair.program("chart/worker", main);
        member.worker = new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
        member.worker.onmessage = ({ data }) => answered(data);
        member.send = (order) => member.worker.postMessage(order);
      } catch {
        member.send = server((answer) => setTimeout(() => answered(answer), 0));
      }
      return member;
    }

    // `order.about` stays here and comes back with the answers.
    add(orders) {
      this.queue.push(...orders);
      this.next();
    }

    next() {
      for (const member of this.members) {
        if (member.order || !this.queue.length) continue;
        const { about, ...sent } = this.queue.shift();
        member.order = { id: ++this.count, about };
        member.send({ ...sent, id: this.count });
      }
    }

    // End all that is under way.
    clear() {
      this.queue = [];
      for (const member of this.members) {
        if (member.order) member.send({});
        member.order = null;
      }
    }
  }

  return { server, Pool };
});
