"""A browser for the built pages: to check them, and to print them."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any

from gearpair.study.errors import StudyError

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
# No request leaves this machine: not the pages', nor the browser's own.
ALONE = [
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
]


def find_chromium() -> str:
    """The browser's path: ``$CHROMIUM``, else the first of the usual names that is installed.

    Raises
    ------
    StudyError
        If there is none.
    """
    named = os.environ.get("CHROMIUM")
    for name in (named,) if named else NAMES:
        if path := shutil.which(name):
            return path
    looked_for = f"CHROMIUM={named} is not a program" if named else f"none of {', '.join(NAMES)} is installed"
    raise StudyError(f"a Chromium browser is needed, and {looked_for}; on Debian: apt-get install chromium")


@contextmanager
def chromium() -> Iterator[Any]:
    """A headless browser of playwright's, closed at the end."""
    path = find_chromium()
    from playwright.sync_api import sync_playwright  # an extra, which reading and running the book do without

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=ALONE)
        try:
            yield browser
        finally:
            browser.close()


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: Any) -> None:
        pass


@contextmanager
def serve(directory: Path) -> Iterator[str]:
    """Serve the files of a directory to this machine; give the address, without a slash at its end."""
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(directory))) as server:
        thread = Thread(target=server.serve_forever, daemon=True)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}"
        finally:
            server.shutdown()
            thread.join()
