"""What ``pip install`` brings: the library, the command, and the chapters it works on."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.support import ROOT

pytestmark = pytest.mark.slow

TAKEN = (
    "gearpair",
    "notebooks",
    "book",
    "_toc.yml",
    "_config.yml",
    "pyproject.toml",
    "README.md",
    "LICENSE",
    "CITATION.cff",
)


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The wheel, built from a copy of the sources, and a prefix that it is installed in."""
    place = tmp_path_factory.mktemp("install")
    source = place / "source"
    for name in TAKEN:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, source / name, ignore=shutil.ignore_patterns("__pycache__", "chapters"))
        else:
            source.mkdir(exist_ok=True)
            shutil.copy(ROOT / name, source / name)
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    options = ["--no-deps", "--no-build-isolation", "--no-index"]
    subprocess.run([*pip, "wheel", *options, "--wheel-dir", str(place), str(source)], check=True)
    (wheel,) = place.glob("*.whl")
    # Without --ignore-installed pip takes the editable installation out of the environment that the tests run in.
    options = ["--ignore-installed", "--no-deps", "--no-index", "--prefix", str(place / "prefix")]
    subprocess.run([*pip, "install", *options, str(wheel)], check=True)
    return wheel, place / "prefix"


def test_the_wheel_holds_the_library_its_data_and_the_chapters(installed):
    names = set(zipfile.ZipFile(installed[0]).namelist())
    inside = {name.partition("/data/share/gearpair/")[2] for name in names if "/data/share/gearpair/" in name}
    assert "gearpair/teeth/data/finite_elements.json" in names
    assert {f"notebooks/{path.name}" for path in (ROOT / "notebooks").glob("*.ipynb")} <= inside
    generated = {"__pycache__", "chapters"}
    book = {path.relative_to(ROOT) for path in (ROOT / "book").rglob("*.*") if path.is_file()}
    assert {path.as_posix() for path in book if not generated & {*path.parts}} <= inside
    assert {"_toc.yml", "_config.yml", "CITATION.cff", "LICENSE"} <= inside
    assert not [name for name in names if name.startswith(("tests", "tools"))]


def test_the_installed_command_finds_its_chapters_from_anywhere(installed, tmp_path):
    _, prefix = installed
    (library,) = prefix.rglob("site-packages")
    command = next(path for path in prefix.rglob("gearpair*") if path.parent.name in ("bin", "Scripts"))
    environment = {**os.environ, "PYTHONPATH": str(library)}
    done = subprocess.run(
        [sys.executable, str(command), "chapters"], cwd=tmp_path, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert "stiffness: From teeth to the wave" in done.stdout
    where = "from gearpair.study.book import Book; book = Book.find(); print(book.root, book.target, sep='\\n')"
    done = subprocess.run(
        [sys.executable, "-c", where], cwd=tmp_path, env=environment, capture_output=True, text=True, check=True
    )
    root, target = map(Path, done.stdout.split())
    assert root == prefix / "share" / "gearpair"
    assert target == tmp_path / "_build"  # nothing is built into an installation
