"""What a release states in several places is the same in all of them, and what its services run exists."""

import json
import os
import re
import shutil
import subprocess
import tomllib

import pytest
import yaml

from tests.support import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
MAKEFILE = (ROOT / "Makefile").read_text(encoding="utf-8")


LOCKS = {"requirements.lock": ("book", "test"), "requirements-teach.lock": ("teach",)}


def read_yaml(name: str):
    return yaml.safe_load((ROOT / name).read_text(encoding="utf-8"))


def make_targets(text: str) -> set[str]:
    """The targets of every ``make`` in a script."""
    return {word for line in re.findall(r"\bmake ([\w ./-]+)", text) for word in line.split()}


def test_the_version_and_its_date_are_the_same_everywhere():
    citation = read_yaml("CITATION.cff")
    first = re.search(r"^## \[(.*)\] - (.*)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert (citation["version"], str(citation["date-released"])) == first.groups()
    assert citation["version"] == PROJECT["version"]
    assert citation["license"] == PROJECT["license"]


def test_the_services_call_what_exists():
    workflow = read_yaml(".github/workflows/ci.yml")
    steps = [step["run"] for job in workflow["jobs"].values() for step in job["steps"] if "run" in step]
    container = json.loads((ROOT / ".devcontainer" / "devcontainer.json").read_text(encoding="utf-8"))
    called = make_targets("\n".join([*steps, container["postCreateCommand"]]))
    assert called
    variables = dict(re.findall(r"^(\w+) := (\S+)$", MAKEFILE, re.MULTILINE))
    made = re.sub(r"\$\((\w+)\)", lambda name: variables.get(name[1], ""), MAKEFILE)
    made = re.sub(r"\$\((\w+)\)", lambda name: variables.get(name[1], ""), made)
    assert called <= set(re.findall(r"^([\w./-]+):(?!=)", made, re.MULTILINE))
    for script in (".ci/run", ".ci/browser", "binder/postBuild"):
        assert os.access(ROOT / script, os.X_OK), script


def test_every_supported_python_is_tried():
    workflow = read_yaml(".github/workflows/ci.yml")
    tried = workflow["jobs"]["test"]["strategy"]["matrix"]["python"]
    assert PROJECT["requires-python"] == f">={tried[0]}"
    assert tried == [f"3.{minor}" for minor in range(11, 15)]
    used = [*re.findall(r'python-version: "([\d.]+)"', (ROOT / ".github/workflows/ci.yml").read_text(encoding="utf-8"))]
    used += re.findall(r"python-([\d.]+)", (ROOT / "binder/runtime.txt").read_text(encoding="utf-8"))
    used += re.findall(r"python:([\d.]+)", (ROOT / ".devcontainer/devcontainer.json").read_text(encoding="utf-8"))
    assert len(used) == 4
    assert set(used) <= set(tried)


def pinned(lock: str) -> dict[str, set[str]]:
    """The packages of a lock, each with its versions (some have one for each Python)."""
    found: dict[str, set[str]] = {}
    for line in (ROOT / lock).read_text(encoding="utf-8").splitlines():
        if match := re.match(r"([\w.-]+)==([\w.]+)", line):
            found.setdefault(match[1], set()).add(match[2])
    return found


@pytest.mark.parametrize("lock", LOCKS)
def test_a_lock_pins_everything_that_the_project_asks_for_and_names_no_place_to_fetch_it_from(lock):
    asked = PROJECT["dependencies"] + [each for name in LOCKS[lock] for each in PROJECT["optional-dependencies"][name]]
    assert {re.match(r"[\w-]+", each)[0] for each in asked} <= set(pinned(lock))
    lines = (ROOT / lock).read_text(encoding="utf-8").splitlines()
    assert all(line.startswith("#") or re.match(r"[\w.-]+==", line) for line in lines)
    assert not [line for line in lines if re.search(r"//|@", line)]


def test_the_two_environments_have_the_same_versions_of_what_both_have():
    book, course = map(pinned, LOCKS)
    assert {name: book[name] for name in book.keys() & course} == {name: course[name] for name in book.keys() & course}


def test_binder_takes_the_lock_and_the_hooks_take_its_tools():
    assert (ROOT / "binder" / "requirements.txt").read_text(encoding="utf-8").split() == ["-r", "../requirements.lock"]
    locked = pinned("requirements.lock")
    hooks = [hook for repo in read_yaml(".pre-commit-config.yaml")["repos"] for hook in repo["hooks"]]
    tools = {"ruff": "ruff", "python -m mypy": "mypy", "lint-imports": "import-linter"}
    for hook in hooks:
        (tool,) = (package for start, package in tools.items() if hook["entry"].startswith(f".venv/bin/{start}"))
        assert tool in locked


APT = """#!/bin/sh
echo "$@" >>"$CALLS"
case "$*" in *install*) for name in $BRINGS; do cp "$0" "${0%/*}/$name"; done ;; esac
"""


@pytest.mark.parametrize(
    ("brings", "named", "code", "asked"),
    [
        ("chromium java npm", "", 0, "chromium default-jre-headless npm"),
        ("java npm", "/opt/chrome", 0, "default-jre-headless npm"),
        ("java npm", "", 1, "chromium default-jre-headless npm"),  # where Chromium is no package: Ubuntu
    ],
)
def test_the_browser_is_installed_where_it_is_missing(tmp_path, brings, named, code, asked):
    for program in ("bash", "sh", "cp", "env", "cat"):
        (tmp_path / program).symlink_to(shutil.which(program))
    for program, script in {"apt-get": APT, "id": "#!/bin/sh\necho 0\n"}.items():
        (tmp_path / program).write_text(script)
        (tmp_path / program).chmod(0o755)
    given = {"PATH": str(tmp_path), "CALLS": str(tmp_path / "calls"), "BRINGS": brings, "CHROMIUM": named}
    done = subprocess.run([str(ROOT / ".ci" / "browser")], env=given, capture_output=True, text=True)
    assert done.returncode == code
    calls = (tmp_path / "calls").read_text().splitlines()
    assert [call.removeprefix("--quiet --quiet ") for call in calls] == [
        "update",
        f"install --yes --no-install-recommends {asked}",
    ]
    assert ("The gates of the site need chromium (" in done.stderr) == bool(code)
