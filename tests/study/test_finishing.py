"""The last touches to a built site, and its pages as one document for print."""

import numpy as np
import pytest
from PIL import Image

from gearpair.study.book import Book
from gearpair.study.errors import StudyError
from tests.support.extensions import extension
from tools.browser import find_chromium
from tools.pdf import one_document

FINISHING = extension("finishing")
finish_site, mend = FINISHING.finish_site, FINISHING.mend

THEBE = '<script>const THEBE_JS_URL = "https://example.org/thebe.js"; const other = 1</script>'
X = r'<span class="math notranslate nohighlight">\(X\)</span>'
CELL = (
    '<div class="cell tag_hide-input docutils container">\n<details class="admonition hide above-input">\n<summary>'
    "<span>Show the code</span></summary>\n{}\n</details>\n</div>\n"
)
TOGGLE = "<script>var togglebuttonSelector = '.toggle';</script>"


@pytest.mark.parametrize(
    ("page", "mended"),
    [
        (f"a{THEBE}b{THEBE}c", "abc"),
        (f"{TOGGLE}x{TOGGLE}", f"x{TOGGLE}"),
        ('<meta name="viewport" content="1"><meta name="viewport" content="2">', '<meta name="viewport" content="2">'),
        (
            '<summary aria-label="Toggle hidden content">\n<p class="collapsed admonition-title">Show</p></summary>',
            '<summary>\n<span class="collapsed admonition-title">Show</span></summary>',
        ),
        ('<link rel="preload" as="font" href="a.woff2" />\n<link rel="icon">', '<link rel="icon">'),
        ('<th style="x"></th><th>m</th>', '<td style="x"></td><th>m</th>'),
        ('<i id="search-input"><b id="search-input">', '<i id="search-input"><b id="search-field">'),
        (
            '<button class="btn search-button-field" title="Search" aria-label="Search" id="x">',
            '<button class="btn search-button-field" title="Search" id="x">',
        ),
        ("<i>Show code cell source</i><b>Hide code cell outputs</b>", "<i>Show the code</i><b>Hide the result</b>"),
        ('<section id="solution-content">a</section>', "<section>a</section>"),
        (
            f"<p>of {X}, and {X} (of {X}).</p>",
            f'<p>of <span class="whole">{X},</span> and {X} (of <span class="whole">{X}).</span></p>',
        ),
        (f"<p>({X} large)</p>", f'<p><span class="whole">({X}</span> large)</p>'),
        (
            '<span class="pre">-p</span> <span class="pre">a-b</span>',
            '<span class="pre option">-p</span> <span class="pre">a-b</span>',
        ),
        (f"{CELL.format('first')}{CELL.format('second')}", CELL.format("first\n\nsecond")),
        (
            f"{CELL.format('first')}a result{CELL.format('second')}",
            f"{CELL.format('first')}a result{CELL.format('second')}",
        ),
        ("<p>nothing to mend</p>", "<p>nothing to mend</p>"),
    ],
)
def test_what_is_mended(page, mended):
    assert mend(page) == mended
    assert mend(mended) == mended


@pytest.mark.parametrize(("rows", "scrolls"), [(10, False), (60, True)])
def test_a_table_longer_than_a_screen_scrolls_by_itself_and_by_keyboard(rows, scrolls):
    table = f'<div class="output text_html"><table class="table">{rows * "<tr><td>1</td></tr>"}</table></div>'
    page = mend(f"{table}<p>between</p>{table}")
    assert page.count("long-table") == page.count('tabindex="0"') == (2 if scrolls else 0)
    assert mend(page) == page


def test_pictures_take_less_room_and_lose_nothing(tmp_path):
    (tmp_path / "_images").mkdir()
    pixels = np.random.default_rng(0).integers(0, 4, (40, 50, 3), dtype=np.uint8) * 60
    Image.fromarray(pixels).save(tmp_path / "_images" / "figure.png")
    (tmp_path / "page.html").write_text('<img src="../_images/figure.png"><img src="_static/figure.png">')
    finish_site(tmp_path, first_page="page", title="A book")
    assert [path.name for path in (tmp_path / "_images").iterdir()] == ["figure.webp"]
    assert np.array_equal(np.asarray(Image.open(tmp_path / "_images" / "figure.webp").convert("RGB")), pixels)
    expected = '<img src="../_images/figure.webp"><img src="_static/figure.png">'
    assert (tmp_path / "page.html").read_text() == expected
    assert 'url=page.html"' in (tmp_path / "index.html").read_text()


def test_the_pages_become_one_document_whose_links_stay_inside(small_book):
    html = small_book / "_build" / "html" / "book"
    (html / "chapters").mkdir(parents=True)
    first = '<a href="chapters/small.html#there">x</a><a href="https://example.org/">y</a><a href="#here">z</a>'
    first += '<section class="gp-explorer"><canvas></canvas></section>'
    first += '<a href="chapters/small.html#x=1&amp;v=2">w</a>'
    folded = "<details><summary>Show the code</summary>hidden</details>"
    folded += "<details><summary>Show the result</summary>kept</details>"
    folded += '<details><summary class="sd-summary-title">A title</summary>a table</details>'
    page = "<html><head></head><body><nav>menu</nav><article><h1>{}</h1>{}</article></body></html>"
    (html / "introduction.html").write_text(page.format("First", first))
    second = f'<p id="there"><img src="../../_images/a.png"></p>{folded}'
    (html / "chapters" / "small.html").write_text(page.format("The second", second))
    text = one_document(Book(small_book), {"First": 2, "Thesecond": 7}, '<img src="data:,still">')
    for piece in (
        '<a href="#book-chapters-small--there">x</a>',
        '<a href="https://example.org/">y</a>',
        '<a href="#book-introduction--here">z</a>',
        '<a href="#book-chapters-small">w</a>',
        'id="book-chapters-small--there"',
        'src="_images/a.png"',
        '<a href="#book-chapters-small">The second</a><span>7</span>',
        '<img src="data:,still"/>',
        "<div>kept</div>",
        '<div><h4 class="sd-summary-title">A title</h4>a table</div>',
    ):
        assert piece in text
    assert not any(word in text for word in ("hidden", "menu", "canvas", "<details", "<summary"))


@pytest.mark.parametrize(("rows", "left", "told"), [(100, 100, ""), (176, 51, "… 126 more rows, on the site …")])
def test_of_a_table_of_many_pages_paper_gets_the_beginning_and_the_end(small_book, rows, left, told):
    html = small_book / "_build" / "html" / "book"
    (html / "chapters").mkdir(parents=True)
    body = "".join(f"<tr><td>place {i}</td><td>x</td></tr>" for i in range(1, rows + 1))
    table = f"<table><thead><tr><th>place</th><th>x</th></tr></thead><tbody>{body}</tbody></table>"
    page = "<html><head></head><body><article><h1>First</h1>{}</article></body></html>"
    (html / "introduction.html").write_text(page.format(table))
    (html / "chapters" / "small.html").write_text(page.format(""))
    text = one_document(Book(small_book), {})
    assert text.count("<tr><td") == left
    assert "<td>place 1</td>" in text and f"<td>place {rows}</td>" in text
    assert f'<td colspan="2">{told}</td>' in text if told else "more rows" not in text


def test_a_missing_browser_is_told_in_a_sentence(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CHROMIUM", raising=False)
    with pytest.raises(StudyError, match="none of chromium, .* is installed; on Debian: apt-get install chromium"):
        find_chromium()
    monkeypatch.setenv("CHROMIUM", "/nowhere/chromium")
    with pytest.raises(StudyError, match="CHROMIUM=/nowhere/chromium is not a program"):
        find_chromium()
