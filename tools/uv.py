"""uv for an environment, taking packages from where this machine's pip takes them; pip itself where uv cannot be had.

Run by any Python 3.11, before there are packages: ``python tools/uv.py .venv pip install --requirement FILE``.
"""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

UV = "uv==0.13.9"  # installs in seconds what takes pip a minute
PIP = ["-m", "pip", "--quiet", "--quiet", "--disable-pip-version-check"]  # errors are told
# uv reads nothing of pip's configuration. Where a machine takes its packages from is handed on, and how pip chooses
# among several places; where pip separates by blanks, uv takes what stands here.
HANDED_ON = {
    "index-url": ("UV_DEFAULT_INDEX", " "),
    "extra-index-url": ("UV_INDEX", " "),
    "find-links": ("UV_FIND_LINKS", ","),
    "cert": ("SSL_CERT_FILE", " "),
    "no-index": ("UV_NO_INDEX", " "),
    "proxy": ("ALL_PROXY", " "),
}
LIKE_PIP = {"UV_INDEX_STRATEGY": "unsafe-best-match"}


def settings_for_uv(listed: str, given: Mapping[str, str]) -> dict[str, str]:
    """uv's environment: what ``pip config list`` tells, less what `given` says to uv already.

    Examples
    --------
    >>> settings_for_uv("global.find-links='/a /b'\\n:env:.find-links='/c'\\nglobal.timeout='9'", {})
    {'UV_INDEX_STRATEGY': 'unsafe-best-match', 'UV_FIND_LINKS': '/c'}
    """
    found: dict[str, str] = {}
    lines = [line.partition("=") for line in listed.splitlines()]
    for name, _, value in sorted(lines, key=lambda line: line[0].startswith(":env:")):  # the environment goes first
        variable, separator = HANDED_ON.get(name.rpartition(".")[2], ("", ""))
        if variable:
            found[variable] = separator.join(ast.literal_eval(value).split())
    return {name: value for name, value in (LIKE_PIP | found).items() if name not in given}


def get_uv(environment: Path) -> Path | None:
    """uv in an environment made by ``python -m venv``; None where it cannot be had."""
    uv = environment / "bin" / "uv"
    if not uv.is_file():
        command = [str(environment / "bin" / "python"), *PIP, "install", "--no-compile", "--retries", "1", UV]
        subprocess.run(command, check=False)
    return uv if uv.is_file() else None


def main(environment: Path, words: list[str]) -> int:
    """Run uv for the environment; return its exit code, or pip's for ``pip install`` where uv fails."""
    python = str(environment / "bin" / "python")
    if uv := get_uv(environment):
        listed = subprocess.run([python, *PIP, "config", "list"], check=False, capture_output=True, text=True).stdout
        settings = {**os.environ, **settings_for_uv(listed, os.environ), "VIRTUAL_ENV": str(environment.absolute())}
        code = subprocess.run([uv, "--quiet", *words], check=False, env=settings).returncode
        if code == 0:
            return 0
    if words[:2] != ["pip", "install"]:
        return 1
    print("uv does not do it here: going on with pip (a minute more)", file=sys.stderr)
    return subprocess.run([python, *PIP, "install", "--no-compile", *words[2:]], check=False).returncode


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2:]))
