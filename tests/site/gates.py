"""What the browser tells of a page: each gate gives a list of what is wrong, empty where nothing is."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import unquote, urlsplit

from tools.browser import serve

AXE = Path(sys.prefix) / "node_modules" / "axe-core" / "axe.min.js"  # from npm, by `make check-site`
PHONE = {"width": 360, "height": 740}
DESK = {"width": 1280, "height": 900}
SHARED = (".js", ".css", ".woff", ".woff2")  # below _static: fetched once for all pages
# What MathJax draws is hidden from screen readers, which get its MathML; axe need not look at each of its boxes.
RUN_AXE = """rules => axe.run({exclude: [["mjx-math"]]},
    {resultTypes: ["violations"], preload: false, ...(rules ? {runOnly: rules} : {})})"""
RULES = {"light": None, "dark": ["color-contrast", "link-in-text-block"]}  # those that depend on the scheme
MATHEMATICS = """() => {
    const failed = [...document.querySelectorAll("mjx-merror, [data-mjx-error], .MathJax_Error")];
    const raw = [...document.querySelectorAll(".math")].filter(math => !math.querySelector("mjx-container"));
    return [...failed, ...raw].map(element => element.textContent.trim().slice(0, 120));
}"""
WIDER = """() => {
    const width = document.documentElement.clientWidth;
    if (document.documentElement.scrollWidth <= width) return [];
    const scrolls = element => {
        for (let parent = element.parentElement; parent && parent !== document.body; parent = parent.parentElement)
            if (getComputedStyle(parent).overflowX !== "visible") return true;
        return false;
    };
    const out = [...document.body.querySelectorAll("*")].filter(
        element => element.getBoundingClientRect().right > width + 1 && !scrolls(element));
    const first = out.slice(0, 5).map(element => element.outerHTML.slice(0, 120));
    return [document.documentElement.scrollWidth + " px wide", ...first];
}"""


@dataclass
class Visit:
    """A page as a browser saw it, and what happened while it loaded."""

    name: str
    page: Any
    origin: str
    root: Path
    complaints: list[str] = field(default_factory=list)  # of the console, and of scripts that failed
    elsewhere: list[str] = field(default_factory=list)  # requests that wanted to leave the site
    paths: set[str] = field(default_factory=set)  # what was loaded, by its path within the site

    def load(self) -> None:
        """Load the page, its mathematics and its pictures, as on a first visit."""
        self.page.on("console", self._console)
        self.page.on("pageerror", lambda error: self.complaints.append(f"uncaught: {error}"))
        self.page.on("response", self._response)
        self.page.on("request", self._request)
        self.page.goto(f"{self.origin}/{self.name}", wait_until="load")
        self.page.evaluate("() => window.MathJax?.startup?.promise.then(() => null)")

    def _console(self, message: Any) -> None:
        if message.type in {"error", "warning"}:
            self.complaints.append(f"{message.type}: {message.text}")

    def _response(self, response: Any) -> None:
        if response.status >= 400:
            self.complaints.append(f"{response.status} {response.url}")

    def _request(self, request: Any) -> None:
        if request.url.startswith(self.origin):
            self.paths.add(unquote(urlsplit(request.url).path))
        elif not request.url.startswith(("data:", "blob:")):
            self.elsewhere.append(request.url)

    def failed_mathematics(self) -> list[str]:
        """Formulas that MathJax refused or never reached."""
        return self.page.evaluate(MATHEMATICS)

    def violations(self, scheme: str) -> list[str]:
        """What axe finds wrong: in the light scheme by all of its rules, in the dark by those about colours."""
        self.page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
        if not self.page.evaluate("() => 'axe' in window"):
            self.page.add_script_tag(path=AXE)
        found = self.page.evaluate(RUN_AXE, RULES[scheme])["violations"]
        return [f"{rule['id']}: {rule['help']} -- {node['html'][:160]}" for rule in found for node in rule["nodes"][:4]]

    def wider_than_a_phone(self) -> list[str]:
        """Whether the page itself scrolls sideways at 360 px, and what sticks out."""
        self.page.set_viewport_size(PHONE)
        return self.page.evaluate(WIDER)

    def own_weight(self) -> int:
        """Bytes that the page does not share with all others: its text, its pictures, its own scripts."""
        own = [self.root / path.lstrip("/") for path in self.paths if not is_shared(path)]
        return sum(path.stat().st_size for path in own if path.is_file())


def is_shared(path: str) -> bool:
    """Whether a file belongs to all pages: a script, style or font of the theme's."""
    pure = PurePosixPath(path)
    return pure.suffix in SHARED and "_static" in pure.parts and "explorer" not in pure.parts


@contextmanager
def visits(browser: Any, root: Path) -> Iterator[Callable[[str], AbstractContextManager[Visit]]]:
    """Serve a site and give what opens its pages; they share the browser's cache and nothing else."""
    context = browser.new_context(viewport=DESK, color_scheme="light", reduced_motion="reduce")
    context.add_init_script("try { localStorage.clear(); sessionStorage.clear() } catch {}")

    with serve(root) as origin:

        @contextmanager
        def visit(name: str) -> Iterator[Visit]:
            seen = Visit(name, context.new_page(), origin, root)
            try:
                seen.load()
                yield seen
            finally:
                seen.page.close()

        try:
            yield visit
        finally:
            context.close()
