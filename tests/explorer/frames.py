"""How smoothly the explorer answers while a slider is dragged; by hand, since it depends on the clock.

    python -m tests.explorer.frames [slowdown] [page]

Drags three sliders over their whole range in Chromium without a window, one mouse event a frame, its processor slowed
down so many times (1), and prints frames per second, the longest frame, and how many of the frames showed a new motion.
"""

import sys
import tempfile
from pathlib import Path

from tests.support.explorer_pages import opened, write_page
from tools.browser import chromium

WATCH = """
window.watch = () => {
  const explorer = document.getElementById("explorer").explorer;
  const draw = explorer.draw;
  const seen = { frames: [], draws: 0 };
  explorer.draw = (...all) => { seen.draws++; return draw.apply(explorer, all); };
  const tick = (now) => { seen.frames.push(now); seen.id = requestAnimationFrame(tick); };
  requestAnimationFrame(tick);
  window.watched = seen;
  window.unwatch = () => { cancelAnimationFrame(seen.id); explorer.draw = draw; };
};
"""
DRAG = """
(async (name, frames) => {
  const range = document.querySelector(`#gp-${name}`);
  watch();
  for (let i = 0; i <= frames; i++) {
    range.value = Number(range.min) + (range.max - range.min) * i / frames;
    range.dispatchEvent(new Event("input", { bubbles: true }));
    await new Promise(requestAnimationFrame);
  }
  unwatch();
  const times = watched.frames.slice(1).map((time, i) => time - watched.frames[i]);
  return { fps: 1000 * times.length / times.reduce((a, b) => a + b, 0), longest: Math.max(...times),
           frames: times.length, draws: watched.draws };
})
"""


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        slowdown = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
        address = sys.argv[2] if len(sys.argv) > 2 else write_page(Path(folder)).as_uri()
        with chromium() as browser, opened(browser) as go:
            page = go(address)
            page.wait_for_function("document.getElementById('explorer').explorer?.shown")
            page.evaluate(f"() => {{ {WATCH} }}")
            page.context.new_cdp_session(page).send("Emulation.setCPUThrottlingRate", {"rate": slowdown})
            for name in ("mesh_frequency", "damping_ratio", "error_amplitude"):
                seen = page.evaluate(f"({DRAG})({name!r}, 300)")
                print(f"{name}: {seen['fps']:.1f} frames/s, longest {seen['longest']:.0f} ms, "
                      f"{seen['draws']} new pictures in {seen['frames']} frames")  # fmt: skip


if __name__ == "__main__":
    main()
