"""The page in a real browser: by the keyboard alone, on a phone, without workers, and what it hands over."""

import pytest

from gearpair import GearDrive
from gearpair.drive_file import read_drive_file
from tests.support.engines import CHART
from tests.support.explorer_pages import opened, write_page

PAGE = "document.getElementById('drive-chart').page"
WITHOUT_WORKERS = "delete globalThis.Worker"
INKED = """(name) => {
  const canvas = document.querySelector(`[data-part=${name}]`);
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  return new Set(new Uint32Array(data.buffer)).size;
}"""


@pytest.fixture
def chart(browser, tmp_path):
    """Opens the page at a hash, a stage of its work done."""
    path = write_page(tmp_path, "drive")
    with opened(browser) as go:

        def open_at(hash: str = "", stage: int = 0, width: int = 1300, before: str = "", **media: str):
            page = go("about:blank", **media)
            page.set_viewport_size({"width": width, "height": 900})
            page.add_init_script(before)
            page.goto(path.as_uri() + hash)
            page.wait_for_function(f"{PAGE}?.study.done.has({stage})")
            return page

        yield open_at


def text(page, name: str) -> str:
    return page.evaluate(f"document.querySelector('[data-part={name}]').textContent")


def tab_to(page, selector: str) -> None:
    """Press Tab until an element has the focus."""
    for _ in range(80):
        page.keyboard.press("Tab")
        if page.evaluate("(selector) => document.activeElement.matches(selector)", selector):
            return
    raise AssertionError(f"Tab does not reach {selector}")


def test_by_the_keyboard_alone(chart):
    page = chart()
    first = text(page, "rule")
    assert first.startswith("To keep the teeth together: run between 1667 and ")
    tab_to(page, "[name=module_mm]")
    page.keyboard.press("Control+A")
    page.keyboard.type("0")
    page.wait_for_selector("[data-part=complaint]:not([hidden])")
    assert text(page, "complaint") == "module_mm must be a finite number above 0, got 0.0."
    assert page.get_attribute("[name=module_mm]", "aria-invalid") == "true"
    assert page.get_attribute("[data-part=save]", "href") is None
    page.keyboard.press("Control+A")
    page.keyboard.type("2")
    page.wait_for_function(f"location.hash === '#module_mm=2' && {PAGE}.study.done.has(0)")
    assert page.is_hidden("[data-part=complaint]")
    assert text(page, "rule") != first
    tab_to(page, "[data-part=cursor]")
    page.keyboard.press("Home")
    start = page.get_attribute("[data-part=cursor]", "aria-valuenow")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("PageUp")
    assert float(page.get_attribute("[data-part=cursor]", "aria-valuenow")) > float(start)
    page.keyboard.press("End")
    told = page.get_attribute("[data-part=cursor]", "aria-valuetext")
    assert told.split(" rpm")[0] == text(page, "speed").split(" rpm")[0]
    assert f"run up {text(page, 'name-up')}" in told
    tab_to(page, "[data-part=pin]")
    page.keyboard.press("Enter")
    assert text(page, "legend").endswith("pinned: this drive")
    page.fill("[name=module_mm]", "3")
    page.wait_for_function(f"location.hash === '' && {PAGE}.study.done.has(1)")
    assert text(page, "legend").endswith("pinned: module 2 mm")
    tab_to(page, "[data-part=band]")
    page.keyboard.press("Space")
    page.wait_for_function(f"{PAGE}.study.band?.rest === 0")
    assert "damping halved to doubled" in text(page, "legend")


def test_the_teeth_follow_the_cursor(chart):
    page = chart(reduced_motion="reduce")
    assert text(page, "play") == "Play"
    page.wait_for_timeout(200)
    for name in ("chart", "cursor", "teeth-up", "teeth-down"):
        assert page.evaluate(INKED, name) > 5
    page.focus("[data-part=cursor]")
    page.keyboard.press("Home")
    before = text(page, "bears-up")
    page.keyboard.press("ArrowRight")
    assert text(page, "bears-up") != before
    factor = page.evaluate(f"{PAGE}.told.chart.up[{PAGE}.at].factor")
    recorded = f"{PAGE}.moving[0].recorded.force"
    assert page.evaluate(f"Math.max(...{recorded}) / {PAGE}.meanForce") == pytest.approx(factor, rel=1e-2)


def test_on_a_phone(chart):
    page = chart(width=360)
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
    for name in ("chart", "teeth-up", "teeth-down", "rule", "rows"):
        box = page.locator(f"[data-part={name}]").bounding_box()
        assert box["x"] >= 0.0
        assert box["x"] + box["width"] <= 360.0


@pytest.mark.slow
def test_workers_or_none_come_to_one_verdict(chart):
    hash = "#transmission_error_um=0&pinion_torque_nm=300"
    pages = [chart(hash, 2), chart(hash, 2, before=WITHOUT_WORKERS)]
    assert text(pages[0], "sentences") == text(pages[1], "sentences")
    assert text(pages[0], "rule") == text(pages[1], "rule") == text(pages[0], "live")
    assert text(pages[0], "progress").endswith(": done")


def test_what_it_hands_over(chart, tmp_path):
    hash = "#module_mm=2.5&backlash=thickness&damping_ratio=0.04"
    page = chart(hash)
    with page.expect_download() as download:
        page.click("[data-part=save]")
    assert download.value.suggested_filename == "pair.yml"
    download.value.save_as(tmp_path / "pair.yml")
    file = read_drive_file(tmp_path / "pair.yml")
    assert (file.pair.module_mm, file.given["backlash"], file.given["damping_ratio"]) == (2.5, "thickness", 0.04)
    assert file.made(GearDrive).resonance_rpm == pytest.approx(page.evaluate(f"{PAGE}.drive.resonance"), rel=1e-9)
    assert page.evaluate("location.hash") == hash
    page.fill("[name=gear_teeth]", "58")
    page.wait_for_function("location.hash.includes('gear_teeth=58')")
    page.click("[data-part=reset]")
    assert page.evaluate("location.hash") == ""


def test_an_address_that_cannot_be(chart):
    page = chart("#module_mm=two&speed=3")
    assert "module_mm must be a finite number above 0, got 'two'. 3 is taken." in text(page, "complaint")
    assert "There is no “speed” on this page" in text(page, "complaint")


def test_no_script_is_long():
    lengths = {path.name: len(path.read_text(encoding="utf-8").splitlines()) for path in CHART.iterdir()}
    assert {name for name, length in lengths.items() if length > 460} == set()
