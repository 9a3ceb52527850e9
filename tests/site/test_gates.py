"""Each gate closes: a page made wrong on purpose is found out by the gate meant for it, and a good one passes all."""

import pytest

from tests.site.gates import is_shared, visits
from tests.site.pages import Site, html_errors

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>A page</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><link rel="icon" href="data:,">{head}</head>
<body><main><h1 id="top-of-page">A page</h1>{body}</main></body></html>
"""
GOOD = '<p><a href="#top-of-page">up</a> and <a href="other.html#there">over there</a></p>'


@pytest.fixture
def make_site(tmp_path):
    def make(body=GOOD, head=""):
        (tmp_path / "page.html").write_text(PAGE.format(body=body, head=head))
        (tmp_path / "other.html").write_text(PAGE.format(body='<p id="there">There.</p>', head=""))
        return Site(tmp_path)

    return make


def test_a_good_page_passes_every_gate(make_site, browser):
    site = make_site()
    assert site.broken_links("page.html") == site.unresolved("page.html") == site.poor_alts("page.html") == []
    assert site.external_resources("page.html") == []
    assert html_errors(site.root) == {}
    with visits(browser, site.root) as visit, visit("page.html") as page:
        assert page.complaints == page.elsewhere == page.failed_mathematics() == []
        assert page.violations("light") == page.violations("dark") == page.wider_than_a_phone() == []
        assert page.own_weight() == (site.root / "page.html").stat().st_size


@pytest.mark.parametrize(
    ("gate", "body", "found"),
    [
        ("broken_links", '<a href="nowhere.html">x</a>', "nowhere.html"),
        ("broken_links", '<a href="other.html#elsewhere">x</a>', "other.html#elsewhere"),
        ("broken_links", '<a href="../page.html">x</a>', "../page.html"),
        ("broken_links", '<img src="lost.png" alt="a picture that is lost">', "lost.png"),
        ("external_resources", '<script src="https://example.org/x.js"></script>', "https://example.org/x.js"),
        ("poor_alts", '<img src="data:," alt="figure">', "data:,: 'figure'"),
        ("poor_alts", '<img src="data:,">', "data:,: None"),
        ("unresolved", "<p>see {numref}`fig-wave`</p>", "{numref}`"),
        ("unresolved", '<p>it is (<a href="#top-of-page">(17)</a>)</p>', "((17))"),
    ],
)
def test_a_gate_without_a_browser_closes(make_site, gate, body, found):
    assert getattr(make_site(body), gate)("page.html") == [found]


def test_a_motion_of_the_explorer_is_no_broken_link(make_site):
    explorer = '<section id="explorer"><a href="#x=1&amp;v=0.5">this motion</a> <a href="#lost">lost</a></section>'
    assert make_site(explorer).broken_links("page.html") == ["#lost"]


def test_code_may_show_markup(make_site):
    assert make_site("<pre>{numref}`fig-wave`</pre>").unresolved("page.html") == []


def test_invalid_html_is_found(make_site):
    (line,) = html_errors(make_site("<table><tr><p>no</p></tr></table>").root)["page.html"][:1]
    assert "p" in line


def test_a_request_to_elsewhere_is_seen_and_goes_nowhere(make_site, browser):
    body = '<script>fetch("https://example.org/x").catch(() => null)</script>'
    with visits(browser, make_site(body).root) as visit, visit("page.html") as page:
        assert page.elsewhere == ["https://example.org/x"]


def test_the_consoles_complaints_are_seen(make_site, browser):
    body = '<script>let a = 1</script><script>let a = 2</script><script>console.error("no")</script>'
    with visits(browser, make_site(body).root) as visit, visit("page.html") as page:
        assert any("already been declared" in line for line in page.complaints)
        assert "error: no" in page.complaints


def test_a_formula_that_failed_or_was_never_set_is_seen(make_site, browser):
    body = '<p class="math">\\(x\\)</p><mjx-merror>bad</mjx-merror>'
    with visits(browser, make_site(body).root) as visit, visit("page.html") as page:
        assert page.failed_mathematics() == ["bad", "\\(x\\)"]


def test_the_dark_scheme_is_checked_in_the_dark(make_site, browser):
    head = "<style>@media (prefers-color-scheme: dark) { body { background: #222; color: #333 } }</style>"
    with visits(browser, make_site(head=head).root) as visit, visit("page.html") as page:
        assert page.violations("light") == []
        assert any(line.startswith("color-contrast") for line in page.violations("dark"))


def test_a_page_wider_than_a_phone_is_seen_and_what_scrolls_by_itself_is_not(make_site, browser):
    wide = '<div style="width: 500px">wide</div>'
    with visits(browser, make_site(wide).root) as visit, visit("page.html") as page:
        assert page.wider_than_a_phone()[0] == "508 px wide"
    scrolls = f'<div style="overflow-x: auto" tabindex="0">{wide}</div>'
    with visits(browser, make_site(scrolls).root) as visit, visit("page.html") as page:
        assert page.wider_than_a_phone() == []


@pytest.mark.parametrize(
    ("path", "shared"),
    [
        ("/_static/mathjax/tex-chtml.js", True),
        ("/_static/book.css", True),
        ("/_images/a.webp", False),
        ("/_static/frequency_branches.png", False),
        ("/_static/explorer/worker.js", False),
        ("/book/model.html", False),
    ],
)
def test_what_a_page_shares(path, shared):
    assert is_shared(path) == shared
