"""The speed chart's modules run by node, and its page without the book's theme."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from tests.support import ROOT

STATIC = ROOT / "book" / "_static"
CHART = STATIC / "chart"
NODE = """
const [, folder] = process.argv;
require(`${folder}/explorer/load.js`);
for (const name of gearpairParts.motion) require(`${folder}/explorer/${name}.js`);
require(`${folder}/chart/load.js`);
for (const name of gearpairChart.engine) require(`${folder}/chart/${name}.js`);
const { source, data } = JSON.parse(require("fs").readFileSync(0, "utf8"));
process.stdout.write(JSON.stringify((0, eval)(`(${source})`)(data)));
"""


def run(source: str, data: Any) -> Any:
    """``source(data)``, `source` a JavaScript function that may use ``gearpair`` with the chart's modules."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("no node: install nodejs")
    result = subprocess.run(
        [node, "-e", NODE, str(STATIC)], input=json.dumps({"source": source, "data": data}),
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def write_page(folder: Path) -> Path:
    """The raw HTML of book/drive.md as a page of its own, beside the scripts where they are."""
    text = (ROOT / "book" / "drive.md").read_text(encoding="utf-8")
    (fragment,) = re.findall(r"```\{raw\} html\n(.*?)```", text, flags=re.DOTALL)
    fragment = fragment.replace("../_static", STATIC.as_uri())
    page = folder / "drive.html"
    page.write_text(
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Speed chart</title>'
        f'<meta name="viewport" content="width=device-width"></head><body>{fragment}</body></html>',
        encoding="utf-8",
    )
    return page
