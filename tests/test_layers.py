"""The library's rooms: imports point downwards only (contracts in pyproject.toml), and what is private stays inside."""

import ast
import importlib
import subprocess
import sys

import pytest
from importlinter.cli import lint_imports

from tests.support import ROOT

LIBRARY = sorted((ROOT / "gearpair").rglob("*.py"))
LONGEST_FILE = 400
# Below every room: the kernels, and what all rooms check, compare and run with.
SHARED = {"_flow", "_checks", "_cores", "_equality", "_locks"}


def test_imports_keep_the_contracts():
    assert lint_imports(config_filename=str(ROOT / "pyproject.toml"), no_cache=True) == 0


def test_importing_the_library_is_quick():
    """What is seldom needed and takes long to import waits for the call that needs it; numba imports scipy itself."""
    program = "import gearpair, sys; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    parts = ("integrate", "linalg", "optimize", "signal", "sparse", "spatial", "stats")
    assert not {"matplotlib", "nbformat", "papermill", *(f"scipy.{part}" for part in parts)} & {*done.stdout.split()}


@pytest.mark.parametrize("path", sorted((ROOT / "gearpair" / "_flow").rglob("*.py")), ids=lambda path: path.name)
def test_kernels_import_only_numpy_numba_and_math(path):
    # These leave nothing to run inside a kernel: they declare, name the cache, and make ready what is to be compiled.
    declarations = {"__future__", "collections", "functools", "hashlib", "os", "pathlib", "typing", "warnings"}
    allowed = {"gearpair._flow", "math", "numba", "numpy", *declarations, "concurrent.futures", "threading"}
    modules = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            modules |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            modules.add("gearpair._flow" if node.level == 1 else "." * node.level + (node.module or ""))
    strangers = {m for m in modules if not any(m == name or m.startswith(f"{name}.") for name in allowed)}
    assert not strangers


@pytest.mark.parametrize("path", LIBRARY, ids=lambda path: str(path.relative_to(ROOT / "gearpair")))
def test_nothing_private_is_imported_from_another_room(path):
    room = path.relative_to(ROOT / "gearpair").parts[0]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("gearpair."):
            _, there, *inside = node.module.split(".")
            if there not in SHARED | {room}:
                private = [name for name in (*inside, *(alias.name for alias in node.names)) if name.startswith("_")]
                assert not private, f"{', '.join(private)} of {node.module} is private"


@pytest.mark.parametrize("folder", ["gearpair", "tests", "tools", "benchmarks"])
def test_a_module_fits_in_the_head(folder):
    lengths = {str(path): len(path.read_text(encoding="utf-8").splitlines()) for path in (ROOT / folder).rglob("*.py")}
    assert {path: n for path, n in lengths.items() if n > LONGEST_FILE} == {}


@pytest.mark.parametrize("room", sorted(p.parent.name for p in (ROOT / "gearpair").glob("[a-z]*/__init__.py")))
def test_no_public_function_hides_a_module_of_its_room(room):
    modules = {path.stem for path in (ROOT / "gearpair" / room).glob("*.py")}
    public = importlib.import_module(f"gearpair.{room}").__dict__
    assert not [name for name in modules & public.keys() if callable(public[name])]
