"""Building the book: what is shown is what ran, and a failure leaves the last good book in place."""

import re
from types import SimpleNamespace

import docutils.nodes
import docutils.utils
import nbformat
import papermill
import pytest
from bs4 import BeautifulSoup

import gearpair as gp
from gearpair.article import published
from gearpair.article.case import Verdict, verdict_table
from gearpair.study.book import Book
from gearpair.study.chapters import Parameter
from gearpair.study.cli import main
from gearpair.study.errors import StudyError
from gearpair.study.variants import variant_page
from tests.support import ROOT
from tests.support.extensions import extension
from tests.support.notebooks import MEAN, write_notebook

BOOK = Book.find(ROOT)
LAST_GOOD = "the last good book"


@pytest.fixture
def built_before(small_book):
    """The small book with a site from an earlier build."""
    html = small_book / "_build" / "html"
    html.mkdir(parents=True)
    (html / "index.html").write_text(LAST_GOOD)
    return small_book


def site(root):
    return (root / "_build" / "html" / "index.html").read_text()


@pytest.mark.slow
def test_a_good_build_takes_the_place_of_the_last(built_before):
    assert main(["--root", str(built_before), "book"]) == 0
    assert LAST_GOOD not in site(built_before)
    page = (built_before / "_build" / "html" / "book" / "chapters" / "small.html").read_text()
    assert "0.9464" in page
    made = sorted(path.name for path in (built_before / "_build").iterdir())
    assert made == ["cache", "chapters", "html", "site.json"]
    offered = built_before / "_build" / "html" / "_sources" / "book" / "chapters" / "small.ipynb"
    assert str(built_before) not in offered.read_text()
    rerun = papermill.execute_notebook(offered, None, {"a": 0.2}, progress_bar=False)  # as it is, by a reader
    assert [cell.outputs[0].text for cell in rerun.cells if cell.get("outputs")] == ["1.0035\n"]


@pytest.mark.slow
def test_a_failed_chapter_is_named_and_the_last_book_stays(built_before, capsys):
    write_notebook(built_before / "notebooks" / "small.ipynb", MEAN, "gp.StiffnessWave((0.0, 0.0), (1.0, 1.0))")
    assert main(["--root", str(built_before), "book"]) == 1
    assert capsys.readouterr().err.splitlines()[-1] == (
        "gearpair: chapter small failed in code cell 3 (cell 4 of the notebook): ValueError: "
        "edges must increase strictly and stay below 1; got edges[0] = 0.0 followed by 0.0"
    )
    assert site(built_before) == LAST_GOOD


@pytest.mark.slow
def test_an_error_that_a_chapter_expects_still_stops_the_build(built_before, capsys):
    path = built_before / "notebooks" / "small.ipynb"
    write_notebook(path, "raise RuntimeError('hidden')")
    notebook = nbformat.read(path, as_version=4)
    notebook.cells[-1].metadata["tags"] = ["raises-exception"]
    nbformat.write(notebook, path)
    assert main(["--root", str(built_before), "book"]) == 1
    assert "RuntimeError: hidden" in capsys.readouterr().err
    assert site(built_before) == LAST_GOOD


@pytest.mark.slow
def test_a_warning_of_the_page_builder_is_an_error(built_before, capfd):
    (built_before / "book" / "introduction.md").write_text("# A small book\n\nSee {ref}`no-such-place`.\n")
    assert main(["--root", str(built_before), "book"]) == 1
    error = capfd.readouterr().err
    assert "no-such-place" in error
    assert "the last book stays" in error
    assert site(built_before) == LAST_GOOD


@pytest.mark.slow
def test_a_page_to_hand_around_holds_all_that_it_shows(small_book, tmp_path):
    figure = "import matplotlib.pyplot as plt\nplt.plot([0, 1])\nplt.show()"
    path = write_notebook(small_book / "notebooks" / "small.ipynb", MEAN, figure)
    notebook = nbformat.read(path, as_version=4)
    notebook.cells.append(nbformat.v4.new_markdown_cell("As [](other.ipynb) and [before](../introduction.md) say."))
    nbformat.write(notebook, path)
    output = tmp_path / "page.html"
    assert main(["--root", str(small_book), "run", "small", "-p", "a", "0.2", "--html", "-o", str(output)]) == 0
    text = output.read_text()
    page = BeautifulSoup(text, "html.parser")
    assert "1.0035" in page.get_text()
    assert [image["src"][:22] for image in page.find_all("img")] == ["data:image/webp;base64"]
    assert not [tag for tag in page.find_all(["link", "iframe"]) or page.find_all(src=True) if tag.name != "img"]
    assert {link["href"][0] for link in page.find_all("a", href=True)} <= {"#"}
    assert "As other and before say." in page.get_text()
    assert "url(http" not in text and "@import" not in text and str(tmp_path) not in text
    assert sorted(path.name for path in tmp_path.iterdir()) == ["checkout", "page.html"]


VARIANTS = """
common: {a: 0.2, speed: 3}
variants:
  more:
    chapter: small
    title: More
    why: Because.
    parameters: {PARAMETERS}
"""


def variants(book, parameters="{}", old="", new=""):
    text = VARIANTS.replace("{PARAMETERS}", parameters).replace(old or "\0", new)
    (book / "book" / "variants.yml").write_text(text)
    return Book(book).variants()


def test_variants_are_read_with_the_common_parameters_that_their_chapter_has(small_book):
    assert Book(small_book).variants() == []
    (variant,) = variants(small_book)
    assert (variant.name, variant.title, variant.values) == ("small_more", "More", {"a": 0.2})
    assert variants(small_book, "{a: 1e-1}")[0].values == {"a": 0.1}


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"parameters": "{aa: 1}"}, "variant 'more' in .*: small has no parameter 'aa'; did you mean 'a'?"),
        ({"parameters": "{a: much}"}, "variant 'more' in .*: a of small must be a number, got 'much'"),
        ({"old": "chapter: small", "new": "chapter: smal"}, "there is no chapter 'smal'; did you mean 'small'?"),
        ({"old": "    why: Because.\n"}, "must have a name of a-z, 0-9, _ and chapter, title, why, parameters"),
        ({"old": "  more:", "new": "  More!:"}, "variant 'More!' in .* must have a name of a-z"),
        ({"old": "title: More", "new": "title: [More"}, "is not a list of variants"),
    ],
)
def test_a_variant_that_cannot_be_is_named(small_book, change, sentence):
    with pytest.raises(StudyError, match=sentence):
        variants(small_book, **change)


def test_a_variants_page_tells_what_was_changed_and_keeps_its_labels_apart(small_book):
    (variant,) = variants(small_book)
    assert variant.chapter.parameters == (Parameter("a", "float", 0.116, "stiffness added in double contact"),)
    notebook = nbformat.read(variant.chapter.path, as_version=4)
    notebook.cells[0].source += (
        "\n\n(sec-end)=\n## End\n\n$$\nx\n$$ (eq-x)\n\n:label: ex-one\n\n"
        "[a](sec-end) [](#sec-end) {eq}`eq-x` {eq}`eq-y` "
        "{numref}`Figure %s <fig-z>` sec-end\n\n```{solution} ex-one"
    )
    notebook.cells[-1].metadata["mystnb"] = {"figure": {"name": "fig-z", "caption": "See {eq}`eq-x`."}}
    before = nbformat.writes(notebook)
    page = variant_page(variant, notebook)
    head, text = page.cells[0].source, page.cells[1].source
    assert (
        head.startswith("# More\n\nBecause.")
        and "of its own parameters alone is left out" in head
        and "(small.ipynb)" in head
    )
    assert "| `a` | stiffness added in double contact | `0.116` | **`0.2`** |" in head
    assert text.startswith("## A small chapter")
    assert "(sec-end-more)=" in text and "$$ (eq-x-more)" in text and ":label: ex-one-more" in text
    assert (
        "[a](sec-end-more) [](#sec-end-more) {eq}`eq-x-more` {eq}`eq-y` {numref}`Figure %s <fig-z-more>` sec-end\n"
        in text
    )
    assert text.endswith("```{solution} ex-one-more")
    assert page.cells[-1].metadata.mystnb.figure == {"name": "fig-z-more", "caption": "See {eq}`eq-x-more`."}
    assert nbformat.writes(notebook) == before  # another page is made from the same notebook


@pytest.fixture(scope="module")
def verdict_links():
    """The module of the book that links the verdicts."""
    return extension("executed")


def test_every_item_of_the_article_leads_to_one_section_that_is_there(verdict_links):
    linked = [item for items in verdict_links.EVIDENCE.values() for item in items.split()]
    assert sorted(linked) == sorted(statement.item for statement in published.STATEMENTS)
    for section in verdict_links.EVIDENCE:
        page, _, anchor = section.partition("#")
        if page.startswith("chapters/"):
            cells = nbformat.read(BOOK.chapter(page.removeprefix("chapters/")).path, as_version=4).cells
            text = "\n".join(cell.source for cell in cells if cell.cell_type == "markdown")
        else:
            text = (ROOT / "book" / f"{page}.md").read_text(encoding="utf-8")
        headings = re.findall(r"^#+ (.*)$", text.replace("'", ""), re.MULTILINE)  # as curly apostrophes are dropped
        assert anchor in map(docutils.nodes.make_id, headings), section


def test_in_its_own_chapter_every_verdict_leads_to_its_evidence(verdict_links):
    verdicts = [
        Verdict(each.item, "no", "no", "refuted", "a < b")
        if each.item == "F1"
        else Verdict(each.item, "", "", "advice")
        for each in published.STATEMENTS
    ]
    tables = [verdict_table(verdicts)._repr_html_(), gp.Table(["item", "published"], [["F1", "0.7"]])._repr_html_()]
    page = docutils.utils.new_document("")
    page += [docutils.nodes.raw("", table, format="html") for table in tables]
    app = SimpleNamespace(builder=SimpleNamespace(get_relative_uri=lambda start, page: f"from {start} to {page}"))
    verdict_links.link_verdicts(app, page, "book/conclusions")
    assert [node.astext() for node in page.children] == tables
    verdict_links.link_verdicts(app, page, "book/chapters/reproduction")
    linked, other = (node.astext() for node in page.children)
    assert other == tables[1]
    assert linked.count("<a ") == linked.count("</a></td></tr>") == len(verdicts)
    link = (
        'href="from book/chapters/reproduction to book/chapters/reproduction#which-motions-exist-at-all">a &lt; b</a>'
    )
    assert link in linked
    assert re.sub("<a [^>]*>|</a>", "", linked).replace("nothing; where it is used", "–") == tables[0]
