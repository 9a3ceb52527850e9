"""A motion as sound: pitch, loudness and ends of what the page would play, rendered offline, against `design.sound`."""

import json
from functools import cache

import numpy as np
import pytest

import gearpair as gp
from gearpair import design
from gearpair.design.sounds import FADE, LOUD, RATE
from tests.explorer.test_explorer import EXPLORER, SETTLED
from tests.support.explorer_pages import STATIC, opened, write_page

NATURAL = 1000.0  # Hz
RATTLE = {"mesh_frequency": 0.7, "x": 1.0, "v": 0.0}
CLATTER = {"mesh_frequency": 0.7, "x": -2.3, "v": 1.5}
CHAOS = {"mesh_frequency": 1.219, "x": 1.0, "v": 0.0}

# One second of some motions as the page would play them, one after another at one full scale.
RENDER = """async ([changes, excess]) => {
  const [settle, sounds, listen] = ["settle", "sounds", "listen"].map(gearpair.use);
  const all = changes.map((change) => {
    const state = { ...gearpair.use("state").DEFAULTS, ...change };
    const motion = settle.settle(gearpair.use("cells").buildCells(state), state.x, state.v, {});
    return sounds.sound(state, motion, 1000 * state.mesh_frequency);
  });
  const scale = all.reduce((before, { peak, meanForce }) => sounds.fullScale(peak, meanForce, before), 0) / excess;
  const rendered = [];
  for (const heard of all) {
    const context = new OfflineAudioContext(1, sounds.RATE, sounds.RATE);
    const voice = listen.voice(context, listen.output(context), heard, scale, 0);
    voice.fadeOut(1 - listen.FADE);
    const { base, peak, rms } = heard;
    const samples = Array.from((await context.startRendering()).getChannelData(0), (value) => value / listen.LEVEL);
    rendered.push({ base, peak, rms, samples, round: Array.from(heard.samples ?? []) });
  }
  return { scale, rendered, rules: [sounds.LOUD, listen.FADE, sounds.RATE], band: [sounds.LOWEST, sounds.HIGHEST] };
}"""


@pytest.fixture(scope="module")
def render(browser, tmp_path_factory):
    """Renders motions at one full scale: a dictionary as `RENDER` gives it, the samples as arrays."""
    path = tmp_path_factory.mktemp("listen") / "page.html"
    load = (STATIC / "explorer" / "load.js").as_uri()
    path.write_text(f'<!DOCTYPE html><title>x</title><script src="{load}" data-part="story" defer></script>')
    with opened(browser) as go:
        page = go(path.as_uri())
        page.wait_for_function("globalThis.gearpair?.use('listen')")

        def answer(*changes: dict, excess: float = 1.0) -> dict:
            found = page.evaluate(f"({RENDER})({json.dumps([changes, excess])})")
            for each in found["rendered"]:
                each["samples"] = np.array(each["samples"])
            return found

        yield answer


@cache
def drive() -> gp.GearDrive:
    """One with the natural frequency of NATURAL Hz that moves as the baseline."""
    drawn = gp.GearDrive.from_pair(
        gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0, transmission_error_um=5.0, damping_ratio=0.05,
        pinion_speed_rpm=3000.0,
    )  # fmt: skip
    heavy = (drawn.natural_frequency_rad_s / (2 * np.pi * NATURAL)) ** 2
    wheels = {name: heavy * getattr(drawn, name) for name in ("pinion_inertia_kg_m2", "gear_inertia_kg_m2")}
    return drawn.replace(**wheels)


def by_the_library(change: dict, seconds: float = 1.0) -> np.ndarray:
    """The library's sound of a motion in mean forces."""
    state = gp.steady_state(gp.Oscillator(mesh_frequency=change["mesh_frequency"]), change["x"], change["v"])
    pitched = drive().with_oscillator(state.oscillator)
    heard = design.sound(pitched, state, seconds)
    return heard.samples * heard.full_scale_n / pitched.mean_force_n


def lines(samples: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (Hz) and amplitudes of what lies between the two ends."""
    inner = samples[RATE // 10 : -RATE // 10]
    window = np.hanning(len(inner))
    return np.fft.rfftfreq(len(inner), 1 / RATE), 2 * np.abs(np.fft.rfft(inner * window)) / window.sum()


def test_the_rule_is_the_library_s(render):
    answer = render(RATTLE)
    assert answer["rules"] == [LOUD, FADE, RATE]
    peak = answer["rendered"][0]["peak"]
    assert answer["scale"] == max(LOUD * 0.1, peak)
    assert render(RATTLE, CLATTER)["scale"] == max(each["peak"] for each in render(RATTLE, CLATTER)["rendered"])


@pytest.mark.parametrize(("change", "share"), [(RATTLE, 2), (CLATTER, 1)])
def test_pitch_and_every_overtone_are_the_library_s(render, change, share):
    answer = render(change)
    heard = answer["rendered"][0]
    mesh = NATURAL * change["mesh_frequency"]
    assert heard["base"] == pytest.approx(mesh / share)
    frequency, amplitude = lines(heard["samples"] * answer["scale"] / 0.1)
    wanted = lines(by_the_library(change))[1]
    loudest = wanted.max()
    overtones = np.arange(1, int(8000 / mesh * share) + 1) * mesh / share
    for overtone in overtones:
        near = np.abs(frequency - overtone) < 10.0
        assert abs(amplitude[near].max() - wanted[near].max()) < 0.005 * loudest, overtone
    peaks = frequency[amplitude > 0.02 * amplitude.max()]
    assert np.abs(peaks[:, None] - overtones).min(1).max() < 5.0  # and nothing between them
    assert np.abs(peaks - mesh / share).min() < 5.0
    assert amplitude[frequency > 8100.0].max() < 1e-3 * loudest


def test_loudness_compares(render):
    quieter, louder = render(RATTLE, CLATTER)["rendered"]
    levels = [lines(each["samples"])[1] for each in (quieter, louder)]
    frequency = lines(quieter["samples"])[0]
    band = (frequency >= 30.0) & (frequency <= 8000.0)
    truth = [lines(by_the_library(change))[1] for change in (RATTLE, CLATTER)]
    ratio, wanted = (np.sqrt((b[band] ** 2).sum() / (a[band] ** 2).sum()) for a, b in (levels, truth))
    assert wanted > 3.0
    assert ratio == pytest.approx(wanted, rel=5e-3)
    assert louder["rms"] / quieter["rms"] == pytest.approx(wanted, rel=5e-3)


@pytest.mark.parametrize("change", [RATTLE, CLATTER, CHAOS])
def test_it_stays_within_1_and_begins_and_ends_without_a_click(render, change):
    (heard,) = render(change)["rendered"]
    samples = heard["samples"]
    assert 0.2 < np.abs(samples).max() <= 1.0 + 1e-3
    edge = RATE // 1000  # a millisecond
    for end in (samples[:edge], samples[::-1][:edge]):
        assert np.abs(end).max() < 0.02 * np.abs(samples).max()
    assert np.abs(samples[-1]) < 1e-3
    steps = np.abs(np.diff(samples))
    assert max(steps[: 60 * edge].max(), steps[-60 * edge :].max()) <= steps[60 * edge : -60 * edge].max()


def test_whatever_is_too_loud_is_clipped(render):
    (heard,) = render(CLATTER, excess=10.0)["rendered"]
    assert np.abs(heard["samples"]).max() == pytest.approx(1.0, abs=1e-6)


def test_chaos_goes_round_without_a_seam_and_is_as_loud_as_the_library_s(render):
    (heard,) = render(CHAOS)["rendered"]
    assert heard["base"] is None
    samples = np.array(heard["round"])
    assert len(samples) > 2.5 * RATE
    assert abs(samples[0] - samples[-1]) < np.abs(np.diff(samples)).max()
    spectrum = np.abs(np.fft.rfft(samples)) ** 2
    frequency = np.fft.rfftfreq(len(samples), 1 / RATE)
    assert spectrum[(frequency < 3.0) | (frequency > 10_500.0)].sum() < 1e-3 * spectrum.sum()
    wanted = by_the_library(CHAOS, 4.0)
    wanted_in = np.abs(np.fft.rfft(wanted)) ** 2
    wanted_at = np.fft.rfftfreq(len(wanted), 1 / RATE)
    kept = np.sqrt(2 * wanted_in[(wanted_at > 30.0) & (wanted_at < 8000.0)].sum()) / len(wanted)
    assert heard["rms"] / 0.1 == pytest.approx(kept, rel=0.1)  # another stretch of the same chaos


@pytest.fixture
def page(browser, tmp_path):
    with opened(browser) as go:
        opened_page = go(write_page(tmp_path).as_uri())
        opened_page.wait_for_function(SETTLED)
        yield opened_page


LISTENER = "document.querySelector('[data-part=listen]').listener"
BUTTON = "[data-part=listen] button"


def test_it_sounds_on_a_click_follows_the_sliders_and_stops(page):
    assert page.evaluate(f"{LISTENER}.context === undefined")  # nothing plays, or could, before
    page.click(BUTTON)
    page.wait_for_function(f"{LISTENER}.heard?.base === 350")
    assert page.get_attribute(BUTTON, "aria-pressed") == "true"
    assert "350 Hz: 1/2 of 700 Hz" in page.inner_text("[data-part=listen] [role=status]")
    page.evaluate(f"{EXPLORER}.change({{ mesh_frequency: 1.8 }})")
    page.wait_for_function(f"Math.abs({LISTENER}.heard?.base - 1800) < 1e-9")
    page.fill("[data-part=listen] input", "500")
    page.press("[data-part=listen] input", "Enter")
    page.wait_for_function(f"Math.abs({LISTENER}.heard?.base - 900) < 1e-9")
    page.evaluate(f"{EXPLORER}.change({{ mesh_frequency: 1.219 }})")
    page.wait_for_function(f"{LISTENER}.heard?.samples")  # rendered in a worker
    page.keyboard.press("Escape")
    assert page.evaluate(f"{LISTENER}.heard === null")
    page.click(BUTTON)
    page.wait_for_function(f"{LISTENER}.heard")
    page.evaluate("Object.defineProperty(document, 'hidden', { value: true }); "
                  "document.dispatchEvent(new Event('visibilitychange'))")  # fmt: skip
    assert page.evaluate(f"{LISTENER}.heard === null")
    page.fill("[data-part=listen] input", "9000")
    page.click(BUTTON)
    assert "50 to 6000 Hz, got “9000”" in page.inner_text("[data-part=listen] [role=status]")
    assert page.evaluate(f"{LISTENER}.heard === null")


def test_it_stops_by_itself(page):
    page.evaluate("""() => {
      const later = setTimeout;
      window.asked = [];
      window.setTimeout = (action, wait) => { window.asked.push(wait); return later(action, wait / 20); };
    }""")
    page.click(BUTTON)
    page.wait_for_function(f"{LISTENER}.heard")
    assert 10_000 in page.evaluate("window.asked")
    page.wait_for_function(f"{LISTENER}.heard === null")
    assert page.get_attribute(BUTTON, "aria-pressed") == "false"


def test_what_escapes_makes_no_sound(browser, tmp_path):
    with opened(browser) as go:
        page = go(
            write_page(tmp_path).as_uri() + "#mesh_frequency=2&damping_ratio=0&a=0.5&b=0.5&contact_ratio=1.5&x=50"
        )
        page.wait_for_function(SETTLED)
        page.click(BUTTON)
        page.wait_for_function(
            "document.querySelector('[data-part=listen] [role=status]').textContent.startsWith('Nothing')"
        )
