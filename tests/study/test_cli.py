"""The command line: what it prints, and one sentence for whatever is wrong."""

import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

from gearpair.study.chapters import Chapter, Parameter
from gearpair.study.cli import main
from gearpair.study.estimate import work_ratio
from tests.support.notebooks import MEAN, write_notebook
from tools.accept import accept


def run(root, *words):
    return main(["--root", str(root), *words])


def test_chapters_are_listed_with_their_schema(small_book, capsys):
    assert run(small_book, "chapters") == 0
    assert capsys.readouterr().out == (
        "small: A small chapter\n  a: float = 0.116  stiffness added in double contact\n"
    )


@pytest.mark.parametrize("words", [("-p", "a", "1e-1"), ("--parameter", "a", "0.1")])
@pytest.mark.slow
def test_run_puts_the_value_in_place_of_the_default(small_book, tmp_path, capsys, words):
    output = tmp_path / "out.ipynb"
    assert run(small_book, "run", "small", *words, "-o", str(output)) == 0
    assert capsys.readouterr().out == f"{output}\n"
    printed = nbformat.read(output, as_version=4).cells[-2].outputs[0].text
    assert printed == "0.9355\n"  # 1 + 0.1 * 0.68 - 0.414 * 0.32 = 0.93552


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["run", "large"], "there is no chapter 'large'; there are small"),
        (["run", "smal"], "there is no chapter 'smal'; did you mean 'small'?"),
        (["run", "small", "-p", "c", "1"], "small has no parameter 'c'; it has a"),
        (["run", "small", "-p", "aa", "1"], "small has no parameter 'aa'; did you mean 'a'?"),
        (["run", "small", "-f", "no.yml"], "no.yml cannot be read: No such file or directory"),
        (["run", "small", "--html", "-o", "out.ipynb"], "must be a page (a name that ends in .html), got 'out.ipynb'"),
        (["run", "small", "-p", "a", "much"], "a of small must be a number, got 'much'"),
        (["run", "small", "-o", "out.html"], "must be a notebook (a name that ends in .ipynb), got 'out.html'"),
        (["run", "small", "-o", "nowhere/out.ipynb"], "there is no directory"),
        (["run", "small", "-o", "{root}/notebooks/small.ipynb"], "is the chapter's own source"),
        (["run", "no/such.ipynb"], "there is no chapter 'no/such.ipynb'"),
    ],
)
def test_bad_input_gets_one_sentence(small_book, tmp_path, monkeypatch, capsys, words, sentence):
    monkeypatch.chdir(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    assert run(small_book, *[word.format(root=small_book) for word in words]) == 1
    error = capsys.readouterr().err
    assert sentence in error
    assert error.startswith("gearpair: ")
    assert error.count("\n") == 1
    assert sorted(tmp_path.rglob("*")) == before


def test_a_value_may_be_negative(small_book, tmp_path):
    output = tmp_path / "out.ipynb"
    assert run(small_book, "run", "small", "-p", "a", "-1e-1", "-o", str(output)) == 0
    printed = nbformat.read(output, as_version=4).cells[-2].outputs[0].text
    assert printed == "0.7995\n"  # 1 - 0.1 * 0.68 - 0.414 * 0.32 = 0.79952


@pytest.mark.slow
def test_a_value_out_of_range_stops_the_run_with_the_librarys_sentence(small_book, tmp_path, capsys):
    output = tmp_path / "out.ipynb"
    assert run(small_book, "run", "small", "-p", "a", "-1.5", "-o", str(output)) == 1
    error = capsys.readouterr().err.splitlines()[-1]
    assert error == (
        "gearpair: chapter small failed in code cell 2 (cell 3 of the notebook): "
        "ValueError: a must be a finite number above -1, got -1.5"
    )
    assert sorted(path.name for path in tmp_path.iterdir()) == ["checkout"]


@pytest.mark.slow
def test_parameters_from_a_file_go_behind_those_of_the_command_line(small_book, tmp_path):
    output, file = tmp_path / "out.ipynb", tmp_path / "mine.yml"
    file.write_text("a: 3\n")
    assert run(small_book, "run", "small", "-f", str(file), "-p", "a", "1e-1", "-o", str(output)) == 0
    assert nbformat.read(output, as_version=4).cells[-2].outputs[0].text == "0.9355\n"
    file.write_text("- 3\n")
    assert run(small_book, "run", "small", "-f", str(file), "-o", str(output)) == 1


CHECKED = """from gearpair.parameters import check_parameters
check_parameters(globals(), fastest="mesh_frequency")
raise RuntimeError("a kernel was started")"""
STARTED = "chapter small failed in code cell 2 (cell 3 of the notebook): RuntimeError: a kernel was started"


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["-p", "lowest", "2"], "lowest must be below highest, got lowest = 2.0 and highest = 1.7"),
        (["-p", "fastest", "0"], "fastest: mesh_frequency must be a finite number above 0, got 0.0"),
        (["-p", "a", "-1.5"], "a must be a finite number above -1, got -1.5"),
        (["-f", "mine.yml"], "lowest must be below highest, got lowest = 3.0 and highest = 1.7"),
        (["-f", "mine.yml", "-p", "lowest", "1"], STARTED),
    ],
)
@pytest.mark.slow
def test_ranges_and_relations_are_checked_before_a_kernel_starts(
    small_book, tmp_path, monkeypatch, capsys, words, sentence
):
    """The whole line is compared: the same sentence out of a kernel comes with the cell that it failed in."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.yml").write_text("lowest: 3")
    names = {"a": 0.116, "lowest": 0.7, "highest": 1.7, "fastest": 2.0}
    parameters = "\n".join(f"{name}: float = {value}  # a number" for name, value in names.items())
    write_notebook(small_book / "notebooks" / "small.ipynb", CHECKED, parameters=parameters)
    assert run(small_book, "run", "small", "--quiet", *words) == 1
    assert capsys.readouterr().err == f"gearpair: {sentence}\n"


@pytest.mark.parametrize(
    ("changed", "ratio"),
    [
        ({}, 1.0),
        ({"mesh_frequency": 0.07}, 10.0),  # as many mesh periods, each ten times as long
        ({"n_transient": 200}, 2.0),
        ({"n_x": 20}, 2.0),
        ({"n_x": 20, "n_v": 30}, 6.0),
        ({"n_values": 300}, 3.0),
        ({"n_frequency": 30}, 3.0),
        ({"n_starts": 400, "n_speeds": 30}, 12.0),
        ({"n_starts": 400, "n_x": 20}, 4.0),  # the part of the chapter that grows most
    ],
)
def test_work_is_counted_in_motions_mesh_periods_and_their_length(changed, ratio):
    names = {"n_x": 10, "n_v": 10, "n_values": 100, "n_transient": 100, "mesh_frequency": 0.7}
    names |= {"n_frequency": 10, "n_starts": 100, "n_speeds": 10}
    chapter = Chapter(Path("small.ipynb"), "", tuple(Parameter(name, "", value, "") for name, value in names.items()))
    assert work_ratio(chapter, changed) == pytest.approx(ratio)


@pytest.mark.slow
def test_what_will_take_long_is_told_before_it_starts(small_book, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    cache = small_book / "_build" / "cache"
    cache.mkdir(parents=True)
    made = {"gearpair": {"seconds": 30.0, "parameters": {}}}
    parameters = "damping_ratio: float = 0.02  # zeta\nn_values: int = 11  # values"
    write_notebook(small_book / "notebooks" / "small.ipynb", "pass", parameters=parameters)
    words = ["run", "small", "--quiet", "-p", "damping_ratio", "1e-4", "-p", "n_values", "22"]
    assert run(small_book, *words) == 0
    sentence = "small: with these parameters about 80 times the work of the chapter as it stands"
    assert capsys.readouterr().err == f"{sentence}\n"
    nbformat.write(nbformat.v4.new_notebook(metadata=made), cache / "small-0.ipynb")
    assert run(small_book, *words) == 0
    assert capsys.readouterr().err == f"{sentence}, which took 30 s here: up to 40 minutes\n"
    assert run(small_book, *words[:3]) == 0
    assert capsys.readouterr().err == ""


def test_a_directory_without_a_book_is_named(tmp_path, capsys):
    assert run(tmp_path, "chapters") == 1
    assert f"no book here: {tmp_path} has no _toc.yml" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ([], "gearpair: Missing command. See gearpair --help"),
        (["paint"], "gearpair: No such command 'paint'. See gearpair --help"),
        (["run"], "gearpair: Missing argument 'CHAPTER'. See gearpair run --help"),
        (["run", "small", "-p", "a"], "gearpair: Option '-p' requires 2 arguments. See gearpair run --help"),
        (["run", "small", "-o"], "gearpair: Option '-o' requires an argument. See gearpair run --help"),
        (
            ["run", "small", "-o", ""],
            "gearpair: Invalid value for '-o' / '--output': a name is needed, got ''. See gearpair run --help",
        ),
        (
            ["run", "small", "-p", "a=1", "-o", "out.ipynb"],
            "gearpair: Got unexpected extra argument (out.ipynb). See gearpair run --help",
        ),
        (["run", "small", "--zzz"], "gearpair: No such option '--zzz'. See gearpair run --help"),
    ],
)
def test_wrong_usage_exits_with_2(words, sentence, capsys):
    assert main(words) == 2
    assert capsys.readouterr() == ("", f"{sentence}\n")


def test_help_exits_with_0(capsys):
    assert main(["run", "--help"]) == 0
    assert "-p, --parameter NAME VALUE" in capsys.readouterr().out


@pytest.mark.slow
def test_accept_stores_outputs_and_finds_nothing_to_do_the_second_time(small_book, capsys):
    figure = "import matplotlib.pyplot as plt, sys\nprint('noise', file=sys.stderr)\nplt.plot([0, 1])\nplt.show()"
    path = write_notebook(small_book / "notebooks" / "small.ipynb", MEAN, figure)
    assert main(["--root", str(small_book)], run=accept) == 0
    assert "new outputs stored: small" in capsys.readouterr().out
    text = path.read_text()
    assert main(["--root", str(small_book)], run=accept) == 0
    assert capsys.readouterr().out == "nothing changed\n"
    assert path.read_text() == text
    assert "0.9464" in text
    for unstable in ("image/png", '"name": "stderr"', "papermill", str(small_book), "ipykernel_"):
        assert unstable not in text
    assert [cell.execution_count for cell in nbformat.reads(text, as_version=4).cells[1:]] == [1, 2, 3]


BOTH_AT_ONCE = """
import os, signal, sys, click
from gearpair.study.cli import main

@click.command()
def two():
    both = {signal.SIGINT, signal.SIGTERM}
    signal.pthread_sigmask(signal.SIG_BLOCK, both)
    for each in both:
        os.kill(os.getpid(), each)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, both)

sys.exit(main([], run=two))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no signal can be held back there")
def test_two_signals_at_once_stop_with_one_sentence():
    done = subprocess.run([sys.executable, "-c", BOTH_AT_ONCE], capture_output=True, text=True)
    assert (done.returncode, done.stderr.strip()) == (130, "gearpair: stopped")
