"""Format, lint and types, notebooks included."""

import subprocess
import sys

import pytest

from tests.support import ROOT


@pytest.mark.parametrize("command", ["ruff format --check", "ruff check", pytest.param("mypy", marks=pytest.mark.slow)])
def test_style(command):
    result = subprocess.run([sys.executable, "-m", *command.split()], cwd=ROOT, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr
