"""A minute's story: what each step says is so by the library, and it is told by keyboard, on a phone and at rest."""

import re
from functools import cache

import numpy as np
import pytest

import gearpair as gp
from tests.explorer.test_listen import CLATTER, RATTLE, by_the_library
from tests.support import ROOT
from tests.support.engines import MODULES
from tests.support.explorer_pages import STATIC, opened, write_page

STORY = "document.querySelector('.gp-story').story"
MANNERS = {"none_drive": "quiet", "single_drive": "rattle", "double": "clatter"}


@cache
def truth(mesh_frequency: float, x: float = 1.0, v: float = 0.0) -> tuple[str, float, gp.SteadyState]:
    """The library's manner, load factor and motion."""
    state = gp.steady_state(gp.Oscillator(mesh_frequency=mesh_frequency), x, v)
    return MANNERS[str(state.impact_state)], gp.motion.impact_measures(state).load_factor, state


@pytest.fixture
def story(browser, tmp_path):
    """Opens the story of the first page."""
    text = (ROOT / "book" / "introduction.md").read_text(encoding="utf-8")
    fragment = re.findall(r"```\{raw\} html\n(<link.*?)```", text, flags=re.DOTALL)[0].replace(
        "../_static", STATIC.as_uri()
    )
    path = tmp_path / "story.html"
    head = '<meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>Story</title>'
    path.write_text(
        f'<!DOCTYPE html><html lang="en"><head>{head}</head><body style="margin:0">{fragment}</body></html>',
        encoding="utf-8",
    )
    with opened(browser) as go:

        def open_story(width: int = 1280, **media: str):
            page = go(path.as_uri(), **media)
            page.set_viewport_size({"width": width, "height": 800})
            page.wait_for_function(f"{STORY}?.theme")
            return page

        yield open_story


def verdict(page) -> str:
    return page.inner_text(".gp-verdict").replace("−", "-")


def press(page, name: str) -> None:
    page.get_by_role("button", name=name, exact=True).click()


def move(page, value: float) -> None:
    page.evaluate("""(value) => {
      const range = document.querySelector(".gp-act input");
      range.value = value;
      range.dispatchEvent(new Event("input"));
    }""", value)  # fmt: skip


def said(text: str) -> float:
    """How many times the mean force, by a verdict."""
    return float(re.findall(r"([\d.]+) times the mean", text)[0])


def test_slowly_the_teeth_stay_together_and_faster_they_part(story):
    page = story(reduced_motion="reduce")
    slow, faster = page.evaluate("(({ SLOW, FASTER }) => [SLOW, FASTER])(gearpair.use('story'))")
    assert verdict(page) == ""
    press(page, "Push")
    assert truth(slow)[0] == "quiet"
    assert verdict(page).startswith("Quiet: the teeth stay together.")
    assert said(verdict(page)) == pytest.approx(truth(slow)[1], rel=0.05)

    press(page, "Next")
    assert not page.is_enabled("[data-way='1']")
    manners = []
    for speed in np.arange(slow, faster + 1e-9, 0.01).round(2).tolist():
        move(page, speed)
        manner, load, _ = truth(speed)
        manners.append(manner)
        assert page.evaluate(f"{STORY}.motion.manner") == manner
        assert verdict(page).startswith("The teeth part" if manner == "rattle" else "At this speed the teeth"), speed
        assert page.is_enabled("[data-way='1']") == ("rattle" in manners)
        if manner == "rattle":
            assert said(verdict(page)) == pytest.approx(load, rel=0.05)
    assert set(manners) == {"quiet", "rattle"}
    assert manners[-1] == "rattle"
    press(page, "Next")
    assert page.inner_text(".gp-title") == "Predict"


@pytest.mark.parametrize(("answer", "judged"), [("Yes", "Not so."), ("No", "Right.")])
def test_the_prediction_is_judged_by_what_happens(story, answer, judged):
    page = story(reduced_motion="reduce")
    page.evaluate(f"{STORY}.go(2)")
    assert verdict(page) == "" and not page.is_enabled("[data-way='1']")
    press(page, answer)
    manner, _, state = truth(page.evaluate("gearpair.use('story').FAST"))
    assert manner == "rattle"
    assert verdict(page).startswith(f"{judged} It turns back after {50 * (1 - state.x_min):.0f}% of the play. So ")
    assert "So one flank is struck: it rattles, with " in verdict(page)
    assert said(verdict(page)) == pytest.approx(truth(0.7)[1], rel=0.05)
    assert page.is_enabled("[data-way='1']")


def test_a_nudge_decides_and_both_can_be_heard(story):
    page = story(reduced_motion="reduce")
    page.evaluate(f"{STORY}.go(3)")
    fast, nudge, most = page.evaluate("(({ FAST, NUDGE, MOST }) => [FAST, NUDGE, MOST])(gearpair.use('story'))")
    x, v = page.evaluate(f"(({{ x, v }}) => [x, v])({STORY}.first().settled.points[0])")
    assert np.abs(truth(fast)[2].points - [x, v]).max(1).min() < 1e-8  # a moment of that motion
    found = {}
    for push in (*np.linspace(-most, most, 21).round(1).tolist(), nudge):
        move(page, push)
        press(page, "Nudge")
        manner, load, _ = truth(fast, round(x, 4), round(v + push, 4))
        found[push] = manner
        assert page.evaluate(f"{STORY}.motion.manner") == manner, push
        if manner == "clatter":
            assert "now both flanks are struck: it clatters" in verdict(page)
            assert said(verdict(page)) == pytest.approx(load, rel=0.05)
        else:
            assert "It comes back to what it did" in verdict(page)
        assert page.is_enabled("[data-way='1']") == ("clatter" in found.values())
    assert found[nudge] == found[most] == "clatter"
    assert "rattle" in found.values()

    press(page, "Next")
    louder = 20 * np.log10(np.std(by_the_library(CLATTER)) / np.std(by_the_library(RATTLE)))
    words, by = re.findall(r"The clatter is (louder|softer) by (\d+) dB", verdict(page))[0]
    assert (words, float(by)) == ("louder", pytest.approx(louder, abs=1.0))
    assert "not your gearbox" in page.inner_text(".gp-text")
    links = page.eval_on_selector_all(
        ".gp-verdict a", "(all) => all.map((link) => [link.textContent, link.getAttribute('href')])"
    )
    for text, address in links:
        values = [float(value) for value in re.findall(r"=([-\d.]+)", address)]
        assert f"the {truth(*values)[0]}" == text
    assert len(links) == 2


def test_by_keyboard_alone_and_nothing_sounds_before_it_is_asked_for(story):
    page = story()
    begun = page.evaluate("performance.now()")
    for keys in (
        ["Tab", "Enter", "Tab", "Enter"],  # Push, Next
        ["Tab", "End", "Tab", "Tab", "Enter"],  # the speed, Back, Next
    ):
        for key in keys:
            page.keyboard.press(key)
    assert page.inner_text(".gp-title") == "Predict"
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent") == "No"
    page.keyboard.press("Enter")
    for _ in range(2):
        page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    assert page.inner_text(".gp-title") == "Nudge it"
    for key in ("Tab", "End", "Tab", "Enter"):
        page.keyboard.press(key)
    page.wait_for_function("document.querySelector('.gp-verdict').textContent.includes('clatters')")
    for key in ("Tab", "Tab", "Enter"):
        page.keyboard.press(key)
    assert page.inner_text(".gp-title") == "Listen to both"
    assert page.evaluate(f"{STORY}.listener.context === undefined")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent") == "Hear the rattle"
    page.keyboard.press("Enter")
    page.wait_for_function(f"{STORY}.listener.heard?.base === 350")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    page.wait_for_function(f"{STORY}.listener.heard?.base === 700")
    page.keyboard.press("Escape")
    assert page.evaluate(f"{STORY}.listener.heard === null")
    assert page.evaluate("performance.now()") - begun < 60_000


def test_the_tooth_is_pushed_on_the_picture_too(story):
    page = story(reduced_motion="reduce")
    press(page, "Push")
    page.evaluate(f"{STORY}.go(3)")
    box = page.locator("canvas").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 0.25 * box["width"], y, steps=4)
    page.mouse.up()
    assert page.evaluate(f"{STORY}.nudge.valueAsNumber") == 2.0
    assert "clatters" in verdict(page)


def test_it_rests_for_who_prefers_that_and_moves_for_others(story):
    page = story(reduced_motion="reduce")
    press(page, "Push")
    page.wait_for_timeout(300)
    assert page.evaluate(f"{STORY}.time") == 0
    assert page.inner_text("[data-way=still]") == "Play"
    page = story()
    assert page.inner_text("[data-way=still]") == "Pause"
    press(page, "Push")
    page.wait_for_function(f"{STORY}.time > 0")


def test_it_fits_a_phone(story):
    page = story(360)
    press(page, "Push")
    for step in range(5):
        page.evaluate(f"{STORY}.go({step})")
        assert page.evaluate("document.documentElement.scrollWidth") <= 360
        for button in page.query_selector_all(".gp-story button, .gp-story input"):
            box = button.bounding_box()
            assert box is None or min(box["height"], box["width"]) >= 43.9


def test_at_the_explorer_s_head_it_is_folded_for_a_link_to_a_motion(browser, tmp_path):
    with opened(browser) as go:
        address = write_page(tmp_path).as_uri()
        for hash, is_open in (("", True), ("#mesh_frequency=1.8", False)):
            page = go(address + hash)
            page.wait_for_function(f"{STORY}")
            assert page.evaluate("document.querySelector('.gp-minute').open") == is_open


def test_one_orientation_and_one_pair_of_colours():
    """The driving gear above, in the drawing and in the moving picture, each gear in its colour."""
    drawing = (STATIC / "two_teeth.svg").read_text(encoding="utf-8")
    heights = {name: float(y) for y, name in re.findall(r'y="([\d.]+)"[^>]*>(driv\w+ gear)<', drawing)}
    assert heights["driving gear"] < heights["driven gear"]
    css = (MODULES / "motion.css").read_text(encoding="utf-8")
    book = (STATIC / "book.css").read_text(encoding="utf-8")
    for gear, name in (("driving", "steel2"), ("driven", "steel")):
        moving = re.findall(rf"--gp-{name}: (#\w+)", css)
        still = re.findall(rf"\.two-teeth \.{gear} {{\n  fill: (#\w+)", book)
        assert len(moving) == 2
        assert moving == still
