"""Several chapters at once, each in a process of its own; what is in the cache is not computed again."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

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

    page: Chapter | Variant
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
    jobs = [Job(page, cache.path(_chapter(page), _values(page), lock)) for page in pages]
    found = {job.kept: cache.read(job.kept) for job in jobs}
    missing = {job.kept: job for job in jobs if found[job.kept] is None}
    _run(longest_first([*missing.values()], cache), scratch)
    cache.prune(found)
    for kept in missing:
        found[kept] = cache.read(kept)
    return {job.page.name: (job.page, nbformat.from_dict(found[job.kept])) for job in jobs}


def longest_first(jobs: list[Job], cache: Cache) -> list[Job]:
    """The jobs by what their chapters took here the last time, else by what their notebooks tell; the longest first.

    One that began last would keep a single core at work while the others wait.
    """
    chapters = {_chapter(job.page) for job in jobs}
    seconds = {chapter.path: cache.seconds(chapter.name) or chapter.seconds for chapter in chapters}
    return sorted(jobs, key=lambda job: seconds[_chapter(job.page).path], reverse=True)


def _chapter(page: Chapter | Variant) -> Chapter:
    return page.chapter if isinstance(page, Variant) else page


def _values(page: Chapter | Variant) -> dict[str, object]:
    return page.values if isinstance(page, Variant) else {}


def _run(jobs: list[Job], scratch: Path) -> None:
    waiting, running = deque(jobs), dict[subprocess.Popen[bytes], Job]()
    at_once = max(1, min(len(jobs), os.cpu_count() or 1))
    if jobs:
        _say(f"to execute: {', '.join(job.page.name for job in jobs)} ({at_once} at a time)")
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
                _say(f"running: {', '.join(f'{job.page.name} ({_since(job)})' for job in running.values())}")
                told = time.monotonic()
            time.sleep(POLL)
    finally:
        for process in running:
            process.terminate()
        for process in running:
            process.wait()


def _start(job: Job, scratch: Path) -> subprocess.Popen[bytes]:
    """`gearpair run` in a process and a session of its own: Ctrl-C reaches it by way of this one alone."""
    chapter, job.began, job.log = _chapter(job.page), time.monotonic(), scratch / f"{job.page.name}.log"
    words = ["run", str(chapter.path), "--output", str(job.kept), "--quiet"]
    parameters = scratch / f"{job.page.name}.yml"
    parameters.write_text(json.dumps(_values(job.page)), encoding="utf-8")  # JSON is YAML
    path = os.pathsep.join(filter(None, [str(LIBRARY.parent), os.environ.get("PYTHONPATH")]))
    with job.log.open("wb") as log:
        return subprocess.Popen(
            [sys.executable, "-m", "gearpair", *words, "--file", str(parameters)],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            env={**os.environ, "PYTHONPATH": path},
            start_new_session=True,
        )


def _finish(job: Job, code: int) -> None:
    if code:
        last = (job.log.read_text(encoding="utf-8", errors="replace").strip() or f"exit code {code}").splitlines()[-1]
        raise StudyError(last.removeprefix("gearpair: ").replace(_chapter(job.page).name, job.page.name, 1))
    _say(f"{job.page.name}: executed in {_since(job)}")


def _since(job: Job) -> str:
    return duration(time.monotonic() - job.began)


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
