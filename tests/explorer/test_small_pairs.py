"""The two small pairs of the first page, and what all scripts of the site have in common."""

from gearpair.plotting.style import MOTION_COLOURS
from tests.support.engines import MODULES
from tests.support.explorer_pages import opened, write_pairs_page


def test_the_small_pairs_move_and_rest(tmp_path, browser):
    with opened(browser) as go:
        page = go(write_pairs_page(tmp_path).as_uri())
        page.wait_for_function("globalThis.gearpair?.use('pair').groups.length === 1")
        group = "gearpair.use('pair').groups[0]"
        lowest = page.evaluate(f"{group}.pairs.map((pair) => Math.min(...pair.recorded.x))")
        assert lowest[0] > -1.0  # rattles: never reaches the coast side
        assert lowest[1] < -1.0  # clatters
        page.wait_for_function(f"{group}.pairs[0].time > 0")
        page.evaluate(f"{group}.button.click()")
        assert page.evaluate(f"{group}.button.textContent") == "Play"


def test_colours_are_the_book_s():
    css = (MODULES / "colours.css").read_text(encoding="utf-8")
    for name, colour in MOTION_COLOURS.items():
        assert f"--gp-{name.replace(' ', '-')}: {colour.lower()};" in css


def test_no_script_is_long():
    paths = [*MODULES.rglob("*.js"), *MODULES.rglob("*.css")]
    lengths = {path.name: len(path.read_text(encoding="utf-8").splitlines()) for path in paths}
    assert len(lengths) > 15
    assert {name for name, length in lengths.items() if length > 400} == set()
