// The tooth force through the loudspeaker: after a click only, faded in and out, of one full scale, and never for long.
gearpair.define("listen", ["sounds", "plot"], function (sounds, { sign }) {
  const FADE = 0.06; // seconds, at both ends and from one motion to the next; as FADE of gearpair/design/sounds.py
  const LONGEST = 10; // seconds after the last change
  const LEVEL = 0.5; // of what the loudspeaker can do, at full scale
  const NATURAL = { value: 1000, least: 50, most: 6000 }; // Hz; the chapter In service plays the baseline at 1000, its own drive has 5190

  // One motion on its way to `output`, 1 where its force is full scale: { fadeOut(at) }, which ends it. Times are `context`'s.
  function voice(context, output, heard, fullScale, at) {
    const source = heard.samples ? circle(context, heard) : oscillator(context, heard);
    const [scale, rise, fall] = [0, 1, 2].map(() => context.createGain());
    scale.gain.value = 1 / fullScale;
    rise.gain.setValueCurveAtTime([0, 0.146, 0.5, 0.854, 1], at, FADE);
    source.connect(scale).connect(rise).connect(fall).connect(output);
    source.start(at);
    return {
      fadeOut(end) {
        fall.gain.setValueCurveAtTime([1, 0.854, 0.5, 0.146, 0], end, FADE);
        source.stop(end + FADE);
      },
    };
  }

  function oscillator(context, { real, imag, base }) {
    const source = context.createOscillator();
    source.setPeriodicWave(context.createPeriodicWave(real, imag, { disableNormalization: true }));
    source.frequency.value = base;
    return source;
  }

  function circle(context, { samples }) {
    const source = context.createBufferSource();
    source.buffer = context.createBuffer(1, samples.length, sounds.RATE);
    source.buffer.copyToChannel(samples, 0);
    source.loop = true;
    return source;
  }

  // The way to the loudspeaker. By the rule of full scale one motion stays within 1, and so do two while one fades into
  // the other; whatever did not would be clipped.
  function output(context) {
    const clip = context.createWaveShaper();
    clip.curve = new Float32Array([-1, 1]);
    const level = context.createGain();
    level.gain.value = LEVEL;
    clip.connect(level).connect(context.destination);
    return clip;
  }

  let sounding = null; // the one Listener of the page that may be heard

  // Plays one motion at a time. `onChange(heard)` is told what is heard now, null for silence.
  class Listener {
    constructor(onChange) {
      this.onChange = onChange;
      this.fullScale = 0;
      this.heard = null;
      this.order = 0; // counts what was asked for, so that what comes too late is not played
      document.addEventListener("keydown", ({ key }) => key === "Escape" && this.stop());
      document.addEventListener("visibilitychange", () => document.hidden && this.stop());
    }

    // Take these sounds, too, into what stands for full scale.
    compare(...all) {
      for (const { peak, meanForce } of all) this.fullScale = sounds.fullScale(peak, meanForce, this.fullScale);
    }

    // To be called in answer to a click: no browser lets a page sound otherwise.
    wake() {
      if (!this.context) {
        this.context = new AudioContext();
        this.output = output(this.context);
      }
      this.context.resume();
    }

    // Play it, or go over to it.
    hear(heard) {
      if (sounding !== this) sounding?.stop();
      sounding = this;
      this.compare(heard);
      const at = this.context.currentTime + 0.01;
      this.voice?.fadeOut(at);
      this.voice = voice(this.context, this.output, heard, this.fullScale, at);
      this.heard = heard;
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.stop(), 1000 * LONGEST);
      this.onChange(heard);
    }

    stop() {
      this.order++;
      clearTimeout(this.timer);
      if (!this.heard) return;
      this.voice.fadeOut(this.context.currentTime + 0.01);
      this.voice = null;
      this.heard = null;
      this.onChange(null);
    }

    // How loud it is: decibels below a tone of full scale.
    level({ rms }) {
      return 20 * Math.log10((rms * Math.SQRT2) / this.fullScale);
    }
  }

  function main(module) {
    self.onmessage = ({ data }) => self.postMessage({ id: data.id, heard: module.sound(...data.order) });
  }

  let worker, last = 0;

  // `sounds.sound` of these, for a motion that does not repeat in a worker; a promise.
  function prepare(...order) {
    if (order[1].period) return Promise.resolve(sounds.sound(...order));
    try {
      const source = () => new Blob([gearpair.program("sounds", main)], { type: "text/javascript" });
      worker ??= new Worker(URL.createObjectURL(source()));
    } catch {
      return Promise.resolve(sounds.sound(...order)); // a browser that refuses a worker
    }
    const id = ++last;
    return new Promise((resolve) => {
      const take = ({ data }) => {
        if (data.id !== id) return;
        worker.removeEventListener("message", take);
        resolve(data.heard);
      };
      worker.addEventListener("message", take);
      worker.postMessage({ id, order: [order[0], { period: null, points: order[1].points.slice(0, 1) }, order[2]] });
    });
  }

  // What is heard, in words.
  function told(listener, heard) {
    if (!heard) return "";
    const hz = (value) => `${Number(value.toPrecision(3))} Hz`;
    const mesh = `the mesh frequency${heard.meshHz < sounds.LOWEST ? ", too low to be heard; its overtones are" : ""}`;
    let pitch = `No pitch; ${hz(heard.meshHz)} is ${mesh}.`;
    if (heard.base === heard.meshHz) pitch = `${hz(heard.base)}: ${mesh}.`;
    else if (heard.base) pitch = `${hz(heard.base)}: 1/${Math.round(heard.meshHz / heard.base)} of ${hz(heard.meshHz)}, ${mesh}.`;
    return `${pitch} ${sign(listener.level(heard).toFixed(0))} dB of full scale.`;
  }

  // Fills `element` with a button, a field and a caption, to hear the motions { state, status, period, points } that `root`
  // tells of by the event `motionshown`.
  function build(root, element) {
    element.classList.add("gp-listen");
    element.innerHTML =
      `<button type="button" aria-pressed="false">Listen</button>` +
      `<label>Natural frequency of the mesh <input type="number" inputmode="decimal" min="${NATURAL.least}" max="${NATURAL.most}"` +
      ` step="any" value="${NATURAL.value}"> Hz</label>` +
      `<span class="gp-heard" role="status"></span>` +
      `<p>Tooth force as sound, not your gearbox. It stops after ${LONGEST} s without a change, or with Esc.</p>`;
    const [button, field, status] = ["button", "input", "[role=status]"].map((each) => element.querySelector(each));
    const listener = new Listener((heard) => {
      button.setAttribute("aria-pressed", String(heard !== null));
      status.textContent = told(listener, heard);
    });
    let now = null;

    async function play(wanted) {
      if (!now) return;
      const own = ++listener.order;
      const natural = field.valueAsNumber;
      if (!(natural >= NATURAL.least && natural <= NATURAL.most)) {
        status.textContent = `The natural frequency must be ${NATURAL.least} to ${NATURAL.most} Hz, got “${field.value}”.`;
        return;
      }
      const { state } = now;
      if (listener.fullScale && listener.meanForce !== state.mean_force) listener.fullScale = 0; // another load: a new scale
      listener.meanForce = state.mean_force;
      const heard = await prepare(state, now, natural * state.mesh_frequency);
      if (own !== listener.order || !(wanted || listener.heard)) return;
      if (heard) listener.hear(heard);
      else {
        listener.stop();
        status.textContent = `Nothing to hear: ${now.points.length ? `all of it lies above ${sounds.HIGHEST / 1000} kHz` : "the motion does not stay bounded"}.`;
      }
    }

    button.addEventListener("click", () => {
      if (listener.heard) listener.stop();
      else {
        listener.wake();
        play(true);
      }
    });
    field.addEventListener("change", () => play(false));
    let timer;
    element.listener = listener;
    root.addEventListener("motionshown", ({ detail }) => {
      if (detail.status === "settling") return;
      now = detail;
      if (!listener.heard) return;
      clearTimeout(timer);
      timer = setTimeout(() => play(false), 1000 * FADE); // no faster than one fades into the next
    });
  }

  const root = document.getElementById("explorer");
  if (root) build(root, root.querySelector("[data-part=listen]"));

  return { FADE, LEVEL, NATURAL, Listener, voice, output, told };
});
