"""The pages that compute, without the book's theme, for tests in a browser and by hand."""

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.support import ROOT

STATIC = ROOT / "book" / "_static"
EXPLORER = "document.getElementById('explorer').explorer"
SETTLED = f"{EXPLORER}?.shown && !{EXPLORER}.pending && !{EXPLORER}.changed"


@contextmanager
def opened(browser: Any) -> Iterator[Callable[..., Any]]:
    """Give what opens an address; in no page may anything go wrong or be fetched from elsewhere."""
    context = browser.new_context(viewport={"width": 1300, "height": 1600})
    context.set_default_timeout(120_000)  # a page that is silent for longer hangs
    errors, requests = [], []
    context.on("weberror", lambda error: errors.append(str(error.error)))
    context.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    context.on("request", lambda request: requests.append(request.url))

    def go(url: str, **media: str) -> Any:
        page = context.new_page()
        page.emulate_media(**media)
        page.goto(url)
        return page

    try:
        yield go
        assert errors == []
        assert [url for url in requests if not url.startswith(("file:", "blob:", "about:"))] == []
    finally:
        context.close()


def write_page(folder: Path, name: str = "explorer") -> Path:
    """The raw HTML of a page of the book as a page of its own, beside the scripts where they are."""
    text = (ROOT / "book" / f"{name}.md").read_text(encoding="utf-8")
    (fragment,) = re.findall(r"```\{raw\} html\n(.*?)```", text, flags=re.DOTALL)
    fragment = fragment.replace("../_static", STATIC.as_uri())
    page = folder / f"{name}.html"
    page.write_text(
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{name}</title>'
        f'<meta name="viewport" content="width=device-width"></head><body>{fragment}</body></html>',
        encoding="utf-8",
    )
    return page


def part(name: str) -> str:
    """An element of the explorer, as JavaScript."""
    return f"document.querySelector('[data-part={name}]')"


def shown(page: Any, name: str) -> str:
    """A value of the readout."""
    text: str = page.evaluate(f"document.querySelector('[data-value={name}]').textContent")
    return text.replace("−", "-")


def state(page: Any) -> dict[str, Any]:
    """The gear pair and the start that the page's controls stand for."""
    found: dict[str, Any] = page.evaluate(f"{EXPLORER}.state")
    return found


def wait_for_diagram(page: Any) -> None:
    """Wait until the diagram is complete, its chaos watched."""
    page.wait_for_function(f"!{EXPLORER}.diagram.busy")
