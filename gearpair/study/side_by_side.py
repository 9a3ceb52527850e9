"""Several chapters at once, each in a process of its own; what is in the cache is not computed again."""

from __future__ import annotations

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

import nbformat

from gearpair.study.cache import LIBRARY, Cache
from gearpair.study.chapters import Chapter
from gearpair.study.errors import StudyError
from gearpair.study.estimate import duration
from gearpair.study.variants import Variant

SIGN_OF_LIFE = 30.0  # seconds between two lines that say what is running
POLL = 0.05


@dataclass
class Job:
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

    Parameters
    ----------
    pages : iterable of Chapter or Variant
    cache : Cache
        What is computed is kept there as soon as it is there, so that a build that is stopped loses little.
    lock : Path
        The lock file, part of the content keys.
    scratch : Path
        A directory for the processes' messages.

    Raises
    ------
    StudyError
        That of the first page to fail; the others are stopped.
    """
    cache.directory.mkdir(parents=True, exist_ok=True)
    named = {page.name: page for page in pages}
    jobs = []
    for name, page in named.items():
        chapter, values = (page.chapter, page.values) if isinstance(page, Variant) else (page, {})
        jobs.append(Job(name, chapter, values, cache.path(chapter, values, lock)))
    found = {job.kept: cache.read(job.kept) for job in jobs}
    missing = {job.kept: job for job in jobs if found[job.kept] is None}
    _run(longest_first([*missing.values()], cache), scratch)
    cache.prune(found)
    found |= {kept: cache.read(kept) for kept in missing}
    return {job.name: (named[job.name], nbformat.from_dict(found[job.kept])) for job in jobs}


def longest_first(jobs: list[Job], cache: Cache) -> list[Job]:
    """The jobs by what their chapters took here the last time, else by what their notebooks tell; the longest first.

    One that began last would keep a single core at work while the others wait.
    """
    return sorted(jobs, key=lambda job: cache.seconds(job.chapter.name) or job.chapter.seconds, reverse=True)


def _run(jobs: list[Job], scratch: Path) -> None:
    waiting, running = deque(jobs), dict[subprocess.Popen[bytes], Job]()
    at_once = max(1, min(len(jobs), os.cpu_count() or 1))
    if jobs:
        _say(f"to execute: {', '.join(job.name for job in jobs)} ({at_once} at a time)")
    told = time.monotonic()
    try:
        while waiting or running:
            while waiting and len(running) < at_once:
                job = waiting.popleft()
                running[_start(job, scratch)] = job
            for process in [process for process in running if process.poll() is not None]:
                _finish(running.pop(process), process.returncode)
                told = time.monotonic()
            if time.monotonic() - told > SIGN_OF_LIFE:
                _say(f"running: {', '.join(f'{job.name} ({_since(job)})' for job in running.values())}")
                told = time.monotonic()
            time.sleep(POLL)
    finally:
        for process in running:
            process.terminate()
        for process in running:
            process.wait()


def _start(job: Job, scratch: Path) -> subprocess.Popen[bytes]:
    """`gearpair run` in a process and a session of its own: Ctrl-C reaches it by way of this one alone."""
    job.began, job.log = time.monotonic(), scratch / f"{job.name}.log"
    parameters = scratch / f"{job.name}.yml"
    parameters.write_text(json.dumps(job.values), encoding="utf-8")  # JSON is YAML
    words = ["run", str(job.chapter.path), "--output", str(job.kept), "--quiet", "--file", str(parameters)]
    path = os.pathsep.join(filter(None, [str(LIBRARY.parent), os.environ.get("PYTHONPATH")]))
    with job.log.open("wb") as log:
        return subprocess.Popen(
            [sys.executable, "-m", "gearpair", *words],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            env={**os.environ, "PYTHONPATH": path},
            start_new_session=True,
        )


def _finish(job: Job, code: int) -> None:
    if code:
        last = (job.log.read_text(encoding="utf-8", errors="replace").strip() or f"exit code {code}").splitlines()[-1]
        raise StudyError(last.removeprefix("gearpair: ").replace(job.chapter.name, job.name, 1))
    _say(f"{job.name}: executed in {_since(job)}")


def _since(job: Job) -> str:
    return duration(time.monotonic() - job.began)


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
