"""The modules of the explorer and of the speed chart, by node and in a browser: a function of some JSON, its answer."""

from __future__ import annotations

import json
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import pytest

import gearpair as gp
from tests.support.explorer_pages import STATIC, opened

MODULES = STATIC / "explorer"
CHART = STATIC / "chart"
NODE = """
const [, folder, chart] = process.argv;
require(`${folder}/load.js`);
for (const name of gearpairParts.motion) require(`${folder}/${name}.js`);
if (chart) {
  require(`${chart}/load.js`);
  for (const name of gearpairChart.engine) require(`${chart}/${name}.js`);
}
const { source, data } = JSON.parse(require("fs").readFileSync(0, "utf8"));
process.stdout.write(JSON.stringify((0, eval)(`(${source})`)(data)));
"""


def run_in_node(source: str, data: Any, *, chart: bool = False) -> Any:
    """``source(data)``, `source` a JavaScript function that may use ``gearpair``."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("no node: install nodejs, or leave it to the browser")
    result = subprocess.run(
        [node, "-e", NODE, str(MODULES), *[str(CHART)] * chart], input=json.dumps({"source": source, "data": data}),
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def run_in_chart(source: str, data: Any) -> Any:
    """The same with the modules of the speed chart."""
    return run_in_node(source, data, chart=True)


def run_in_chromium(browser: Any, source: str, data: Any) -> Any:
    """The same in a page of a real browser."""
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.html"
        load = (MODULES / "load.js").as_uri()
        page.write_text(f'<!DOCTYPE html><title>x</title><script src="{load}" data-part="motion" defer></script>')
        with opened(browser) as go:
            return json.loads(go(page.as_uri()).evaluate(f"JSON.stringify(({source})({json.dumps(data)}))"))


def as_json(osc: gp.Oscillator, x: float = 1.0, v: float = 0.0) -> dict[str, Any]:
    """An oscillator and a start as the modules take them."""
    scalars = {name: osc.parameter(name) for name in osc.parameters if name not in ("contact_ratio", "a", "b")}
    return {
        **scalars,
        "edges": [*osc.stiffness.edges, 1.0],
        "levels": list(osc.stiffness.levels),
        "x": x,
        "v": v,
    }
