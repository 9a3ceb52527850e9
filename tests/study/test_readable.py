"""An executed notebook shows its numbers and names, and nothing that only the book's renderer understands."""

import re

import nbformat
import pytest
from bs4 import BeautifulSoup
from nbformat.v4 import new_code_cell, new_markdown_cell

from gearpair.study.book import Book
from gearpair.study.cli import main
from gearpair.study.readable import readable, without_ways_out
from tests.support import ROOT
from tests.support.notebooks import write_notebook

BOOK = Book(ROOT)
RAW = re.compile(r"\{[\w:-]+\}`|^(`{3,}|:{3,})\{|^:[\w-]+:|^\([\w-]+\)=|\]\((?!https?:)|\$\$ \(|<a ", re.MULTILINE)
GLUE = "from myst_nb import glue\nglue('mean', f'{a:.2f}', display=False)"
TEXT = """(sec-here)=
## Here

The mean is {glue:text}`mean` and {glue:text}`missing`; see {numref}`fig-own`, {numref}`fig-other`, {eq}`eq-own`,
{eq}`eq-far`, {ref}`sec-here`, [there](sec-far), [](sec-far), [](other.ipynb), [words](introduction.md), {term}`gap`,
{term}`orbits <orbit>`, {cite:p}`hertz1881,two2000`, {cite:t}`three2001`,
<a class="see-it-move" href="../explorer.html#x=1">move</a>.

$$
x
$$ (eq-own)"""
PROSE = "# A small book\n\n(sec-far)=\n## Far away\n\n$$\ny\n$$ (eq-far)\n"
BIBLIOGRAPHY = """
@article{hertz1881,
  author = {Hertz, Heinrich},
  year = {1881},
}
@article{two2000,
  author = {{de} Oh, Ah and Eh, Bo},
  year = {2000}
}
@book{three2001,
  author = {A, A and B, B and C, C},
  year = {2001}
}
"""


@pytest.fixture
def pages(small_book):
    """The small book with two chapters that refer to one another, and prose."""
    toc = small_book / "_toc.yml"
    toc.write_text(f"{toc.read_text()}  - file: book/chapters/other\n")
    (small_book / "book" / "introduction.md").write_text(PROSE)
    (small_book / "book" / "references.bib").write_text(BIBLIOGRAPHY)
    draws = "import matplotlib.pyplot as plt\nplt.plot([0, 1])\nplt.show()"
    for name, label in (("small", "own"), ("other", "other")):
        path = write_notebook(small_book / "notebooks" / f"{name}.ipynb", GLUE)
        notebook = nbformat.read(path, as_version=4)
        figure = {"figure": {"name": f"fig-{label}", "caption": "As {numref}`fig-other` has it."}}
        notebook.cells.append(new_code_cell(draws, metadata={"mystnb": figure, "tags": ["hide-input"]}))
        if name == "small":
            notebook.cells.append(new_code_cell("'a stamp'", metadata={"tags": ["remove-cell"]}))
            notebook.cells.append(new_markdown_cell(TEXT))
            for block in ("{exercise} One\n:label: ex-one\n\nDo.\n", "{solution-start} ex-one\n", "{solution-end}\n"):
                notebook.cells.append(new_markdown_cell(f"```{block}```"))
        nbformat.write(notebook, path)
    return Book(small_book)


def prose(notebook):
    return "\n\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")


@pytest.mark.slow
def test_a_run_shows_its_numbers_and_names(pages, tmp_path):
    output = tmp_path / "out.ipynb"
    assert main(["--root", str(pages.root), "run", "small", "-p", "a", "0.2", "-o", str(output), "--quiet"]) == 0
    notebook = nbformat.read(output, as_version=4)
    nbformat.validate(notebook)
    text = prose(notebook)
    for words in (
        "The mean is 0.20 and {glue:text}`missing`; see Figure 1, the figure “other” of “A small chapter”, (1),\n"
        "(far, in “A small book”), “Here”, there, “Far away”, “A small chapter”, words, gap,\n"
        "orbits, (Hertz, 1881; de Oh and Eh, 2000), A et al. (2001),\nmove.",
        "\n## Here\n",
        "$$\nx\n\\tag{1}\n$$",
        "*Figure 1.* As the figure “other” of “A small chapter” has it.",
        "**Exercise: One**\n\nDo.",
        "**Solution**",
        "**How this page was made**",
    ):
        assert words in text
    assert not [cell for cell in notebook.cells if "stamp" in cell.source]
    folded = [cell for cell in notebook.cells if cell.metadata.get("jupyter", {}).get("source_hidden")]
    assert ["plt.plot" in cell.source for cell in folded] == [True]


@pytest.mark.slow
def test_a_page_alone_names_what_it_cannot_lead_to(pages, tmp_path):
    path = pages.root / "notebooks" / "small.ipynb"
    text = "See {numref}`fig-own`, {numref}`fig-other`, {ref}`sec-far` and {glue:text}`mean`."
    notebook = nbformat.read(path, as_version=4)
    notebook.cells = [*notebook.cells[:4], new_markdown_cell(text)]
    nbformat.write(notebook, path)
    output = tmp_path / "page.html"
    assert main(["--root", str(pages.root), "run", "small", "--html", "-o", str(output), "--quiet"]) == 0
    shown = BeautifulSoup(output.read_text(), "html.parser").get_text()
    assert re.search(r"See Fig\. \d+, the figure “other” of “A small chapter”, Far away and 0\.12\.", shown), shown


@pytest.mark.parametrize("chapter", BOOK.chapters(), ids=lambda chapter: chapter.name)
def test_nothing_raw_is_left_of_any_chapter(chapter):
    """The chapters are taken as they are stored, with their outputs."""
    notebook = nbformat.read(chapter.path, as_version=4)
    before = nbformat.writes(notebook)
    text = prose(readable(notebook, BOOK))
    assert not [text[max(0, found.start() - 40) : found.end() + 40] for found in RAW.finditer(text)]
    assert nbformat.writes(notebook) == before


def test_a_page_and_a_chapter_of_one_name_are_told_apart():
    text = prose(readable(nbformat.read(BOOK.chapter("method").path, as_version=4), BOOK))
    assert "rests on the claims of “The method”:" in text


@pytest.mark.parametrize("name", ["stiffness", "reproduction"])
def test_figures_are_counted_without_those_that_are_not_shown(name):
    """A stamp for another page has a name too."""
    text = prose(readable(nbformat.read(BOOK.chapter(name).path, as_version=4), BOOK))
    numbers = [int(number) for number in re.findall(r"^\*Figure (\d+)\.\*", text, re.MULTILINE)]
    assert numbers == [*range(1, len(numbers) + 1)] and len(numbers) > 2


def test_what_the_renderer_can_do_is_left_to_it(pages):
    notebook = nbformat.read(pages.root / "notebooks" / "small.ipynb", as_version=4)
    text = prose(without_ways_out(notebook, pages, ["book/introduction"]))
    for kept in ("{glue:text}`mean`", "{numref}`fig-own`", "{eq}`eq-far`", "{ref}`sec-here`", "[there](sec-far)"):
        assert kept in text
    for kept in ("{term}`gap`", "{term}`orbits <orbit>`", "{cite:p}`hertz1881,two2000`", "```{exercise} One"):
        assert kept in text
    assert "the figure “other” of “A small chapter”" in text
