"""The README's examples are true."""

import re

import pytest

from gearpair.study.book import Book
from tests.support import ROOT
from tools.check_wheel import library_example

README = (ROOT / "README.md").read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_library_example_runs(capsys):
    example = library_example()  # as `make check-wheel` runs it
    assert len([line for line in example.splitlines() if line]) == 7
    exec(compile(example, "README.md", "exec"), {})
    assert capsys.readouterr().out == "5065 to 15000 rpm: up to 7.0 times the mean force\n"


def test_the_door_is_a_drawing_a_command_and_a_figure_and_says_what_it_is_not_for():
    opening = README[: README.index("```python")]
    pictures, commands = re.findall(r'src="([^"]+)"', opening), re.findall(r"```bash\n(.*?)```", opening, re.DOTALL)
    assert pictures == ["book/_static/pair_drawing.png", "book/_static/speed_chart.png"]
    assert [line.split("  ")[0].split()[:2] for line in commands[0].splitlines()] == [["gearpair", "drive"]] * 2
    assert "spur gears, one mesh and rigid shafts; not for" in opening.split("<img")[0]


def test_the_papermill_example_names_a_chapter_and_its_parameters():
    (name, options) = re.search(r"papermill notebooks/(\w+)\.ipynb \S+ (.*)", README).groups()
    given = re.findall(r"-p (\S+) (\S+)", options)
    assert Book(ROOT).chapter(name).parse(given)


def test_links_to_files_lead_somewhere():
    targets = re.findall(r"\]\(([^)#:]+)\)|src=\"([^\":]+)\"", README)
    assert targets
    missing = [path for pair in targets for path in pair if path and not (ROOT / path).exists()]
    assert not missing
