"""The README's examples are true."""

import re

from gearpair.study.book import Book
from tests.support import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_library_example_runs(capsys):
    (example,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    assert len([line for line in example.splitlines() if line]) == 5
    exec(compile(example, "README.md", "exec"), {})
    assert capsys.readouterr().out == "periodic 2 single_drive\n"


def test_the_papermill_example_names_a_chapter_and_its_parameters():
    (name, options) = re.search(r"papermill notebooks/(\w+)\.ipynb \S+ (.*)", README).groups()
    given = re.findall(r"-p (\S+) (\S+)", options)
    assert Book(ROOT).chapter(name).parse(given)


def test_links_to_files_lead_somewhere():
    targets = re.findall(r"\]\(([^)#:]+)\)|src=\"([^\":]+)\"", README)
    assert targets
    missing = [path for pair in targets for path in pair if path and not (ROOT / path).exists()]
    assert not missing
