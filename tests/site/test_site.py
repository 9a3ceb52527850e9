"""The built book, page by page, in a real browser; the site's directory is named by GEARPAIR_SITE."""

import hashlib
import os
import shutil
from pathlib import Path

import pytest

from gearpair.study.book import Book, build_book
from tests.site.gates import visits
from tests.site.pages import Site, html_errors

ROOT = Path(__file__).parents[2]
SITE = Site((ROOT / os.environ["GEARPAIR_SITE"]).resolve())
HEAVIEST = 1_500_000  # bytes of one page without what all pages share
FRONT_DOOR = "index.html"  # leads on to the first page at once
pages = pytest.mark.parametrize("name", sorted(SITE.pages))


@pytest.fixture(scope="session")
def visit(browser):
    with visits(browser, SITE.root) as opened:
        yield opened


@pytest.fixture(scope="session")
def html_problems():
    return html_errors(SITE.root)


def test_the_book_was_built():
    assert FRONT_DOOR in SITE.pages, f"no book in {SITE.root}; run make book first"


@pages
def test_every_link_within_the_book_leads_somewhere(name):
    assert SITE.broken_links(name) == []


@pages
def test_nothing_is_taken_from_elsewhere(name):
    assert SITE.external_resources(name) == []


@pages
def test_every_picture_says_what_is_seen(name):
    assert SITE.poor_alts(name) == []


@pages
def test_no_markup_shows_through(name):
    assert SITE.unresolved(name) == []


@pages
def test_the_html_is_valid(name, html_problems):
    assert html_problems.get(name, []) == []


def test_every_page_has_the_books_icon():
    without = [name for name, page in SITE.pages.items() if name != FRONT_DOOR and not page.icons]
    assert without == []


@pytest.mark.parametrize("name", sorted(set(SITE.pages) - {FRONT_DOOR}))
def test_in_the_browser(name, visit):
    with visit(name) as page:
        weight = page.own_weight()
        problems = {
            "requests to elsewhere": page.elsewhere,
            "console": list(page.complaints),
            "mathematics": page.failed_mathematics(),
            "accessibility, light": page.violations("light"),
            "accessibility, dark": page.violations("dark"),
            "wider than a phone": page.wider_than_a_phone(),
            "heavier than 1.5 MB": [f"{weight / 1e6:.2f} MB"] if weight > HEAVIEST else [],
        }
    told = [f"{gate}: {line}" for gate, found in problems.items() for line in found]
    assert not told, "\n".join(told)


def test_two_builds_of_one_source_are_the_same_to_the_byte(tmp_path):
    book = Book.find(ROOT)
    shutil.copytree(book.target / "cache", tmp_path / "cache")  # two executions differ in the time they took
    build_book(book, tmp_path)
    first, second = _digests(SITE.root), _digests(tmp_path / "html")
    assert len(first) > 50
    assert {path for path in first.keys() | second.keys() if first.get(path) != second.get(path)} == set()


def _digests(root: Path) -> dict[str, str]:
    return {
        path.relative_to(root).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in root.rglob("*")
        if path.is_file()
    }
