"""The library's layers: imports point downwards only (contracts in pyproject.toml)."""

import ast
from pathlib import Path

import pytest
from importlinter.cli import lint_imports

ROOT = Path(__file__).parents[1]


def test_imports_keep_the_contracts():
    assert lint_imports(config_filename=str(ROOT / "pyproject.toml"), no_cache=True) == 0


@pytest.mark.parametrize("path", sorted((ROOT / "gearpair" / "_flow").rglob("*.py")), ids=lambda path: path.name)
def test_kernels_import_only_numpy_numba_and_math(path):
    # These leave nothing to run inside a kernel; the last two say once that a strange numba cannot cache.
    declarations = {"__future__", "hashlib", "pathlib", "typing", "functools", "warnings"}
    allowed = {"gearpair._flow", "math", "numba", "numpy", *declarations}
    modules = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            modules |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            modules.add("gearpair._flow" if node.level == 1 else "." * node.level + (node.module or ""))
    strangers = {m for m in modules if not any(m == name or m.startswith(f"{name}.") for name in allowed)}
    assert not strangers
