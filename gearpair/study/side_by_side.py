"""Several chapters at once, each in a process of its own; what is in the cache is not computed again."""

import json
import os
import subprocess
import sys
import time
from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click
import nbformat

from gearpair.study.cache import LIBRARY, Cache
from gearpair.study.chapters import Chapter
from gearpair.study.errors import StudyError
from gearpair.study.estimate import duration
from gearpair.study.variants import Variant

SIGN_OF_LIFE = 30.0  # seconds between two lines that say what is running
POLL = 0.05


@dataclass
class Task:
    """A page to execute, and where its notebook is kept."""

    name: str
    chapter: Chapter
    values: Mapping[str, Any]
    kept: Path
    began: float = 0.0
    log: Path = Path()


def execute_all(
    pages: Iterable[Chapter | Variant], cache: Cache, lock: Path, scratch: Path
) -> dict[str, tuple[Chapter | Variant, nbformat.NotebookNode]]:
    """The executed notebooks of all pages, by name: from the cache, or computed, as many at once as there are cores.

    What is computed is in the cache at once, so that a build that is stopped loses little. The `lock` file is part of
    the content keys, and the processes' messages go to `scratch`. Where a page fails, a StudyError tells so and the
    others are stopped.
    """
    cache.directory.mkdir(parents=True, exist_ok=True)
    named = {page.name: page for page in pages}
    tasks = []
    for name, page in named.items():
        chapter, values = (page.chapter, page.values) if isinstance(page, Variant) else (page, {})
        tasks.append(Task(name, chapter, values, cache.path(chapter, values, lock)))
    found = {task.kept: cache.read(task.kept) for task in tasks}
    missing = {task.kept: task for task in tasks if found[task.kept] is None}
    _run(longest_first([*missing.values()], cache), scratch)
    cache.prune(found)
    found |= {kept: cache.read(kept) for kept in missing}
    return {task.name: (named[task.name], nbformat.from_dict(found[task.kept])) for task in tasks}


def longest_first(tasks: list[Task], cache: Cache) -> list[Task]:
    """The tasks by what their chapters took here the last time, else by what their notebooks tell; the longest first.

    One that began last would keep a single core at work while the others wait.
    """
    return sorted(tasks, key=lambda task: cache.seconds(task.chapter.name) or task.chapter.seconds, reverse=True)


def _run(tasks: list[Task], scratch: Path) -> None:
    waiting, running = deque(tasks), dict[subprocess.Popen[bytes], Task]()
    at_once = max(1, min(len(tasks), os.cpu_count() or 1))
    if tasks:
        click.echo(f"to execute: {', '.join(task.name for task in tasks)} ({at_once} at a time)", err=True)
    told = time.monotonic()
    try:
        while waiting or running:
            while waiting and len(running) < at_once:
                task = waiting.popleft()
                running[_start(task, scratch)] = task
            for process in [process for process in running if process.poll() is not None]:
                _finish(running.pop(process), process.returncode)
                told = time.monotonic()
            if time.monotonic() - told > SIGN_OF_LIFE:
                click.echo(
                    f"running: {', '.join(f'{task.name} ({_since(task)})' for task in running.values())}", err=True
                )
                told = time.monotonic()
            time.sleep(POLL)
    finally:
        for process in running:
            process.terminate()
        for process in running:
            process.wait()


def _start(task: Task, scratch: Path) -> subprocess.Popen[bytes]:
    """`gearpair run` in a process and a session of its own: Ctrl-C reaches it by way of this one alone."""
    task.began, task.log = time.monotonic(), scratch / f"{task.name}.log"
    parameters = scratch / f"{task.name}.yml"
    parameters.write_text(json.dumps(task.values), encoding="utf-8")  # JSON is YAML
    words = [
        "run",
        str(task.chapter.path),
        "--output",
        str(task.kept),
        "--quiet",
        "--source",
        "--file",
        str(parameters),
    ]
    path = os.pathsep.join(filter(None, [str(LIBRARY.parent), os.environ.get("PYTHONPATH")]))
    with task.log.open("wb") as log:
        return subprocess.Popen(
            [sys.executable, "-m", "gearpair", *words],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            env={**os.environ, "PYTHONPATH": path},
            start_new_session=True,
        )


def _finish(task: Task, code: int) -> None:
    if code:
        last = (task.log.read_text(encoding="utf-8", errors="replace").strip() or f"exit code {code}").splitlines()[-1]
        raise StudyError(last.removeprefix("gearpair: ").replace(task.chapter.name, task.name, 1))
    click.echo(f"{task.name}: executed in {_since(task)}", err=True)


def _since(task: Task) -> str:
    return duration(time.monotonic() - task.began)
