"""Buttons that open a chapter elsewhere, where the book is published with the address of its repository.

The address is the environment variable ``GEARPAIR_REPOSITORY``, ``https://github.com/OWNER/NAME``, which the workflow
that publishes sets. A book built without it has no such buttons: there is nothing that they could open.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

ADDRESS = "GEARPAIR_REPOSITORY"
CHAPTERS = "book/chapters/"
# What the button says, what opening it needs, and its address.
PLACES = (
    (
        "Binder",
        "Free, without an account; takes some minutes to start, and nothing is kept",
        "https://mybinder.org/v2/gh/{repository}/main?urlpath=lab/tree/notebooks/{chapter}.ipynb",
    ),
    (
        "Colab",
        "Needs a Google account; run first: %pip install git+https://github.com/{repository}",
        "https://colab.research.google.com/github/{repository}/blob/main/notebooks/{chapter}.ipynb",
    ),
    (
        "Codespaces",
        "Needs a GitHub account; a whole development environment, in your browser",
        "https://codespaces.new/{repository}",
    ),
)


def repository() -> str | None:
    """``OWNER/NAME`` of the repository whose address is given, or None.

    Raises
    ------
    ExtensionError
        If the address is of another form.
    """
    address = os.environ.get(ADDRESS, "")
    if not address:
        return None
    if found := re.fullmatch(r"https://github\.com/([\w.-]+/[\w.-]+?)(\.git)?/?", address):
        return found[1]
    raise ExtensionError(f"{ADDRESS} must be of the form https://github.com/OWNER/NAME, got {address!r}")


def buttons(repository: str, chapter: str) -> dict[str, Any]:
    """The group of buttons for a chapter, in the form in which the theme's header takes it.

    Examples
    --------
    >>> buttons("somebody/gearpair", "impacts")["buttons"][2]["url"]
    'https://codespaces.new/somebody/gearpair'
    """
    return {
        "type": "group",
        "label": "launch-buttons",
        "icon": "fas fa-rocket",
        "tooltip": "Run this chapter elsewhere",
        "buttons": [
            {
                "type": "link",
                "text": name,
                "tooltip": needs.format(repository=repository),
                "url": url.format(repository=repository, chapter=chapter),
            }
            for name, needs, url in PLACES
        ],
    }


def add_buttons(app: Sphinx, pagename: str, templatename: str, context: dict[str, Any], doctree: object) -> None:
    """Put the buttons at the head of a chapter's page."""
    chapter = pagename.removeprefix(CHAPTERS)
    is_chapter = pagename.startswith(CHAPTERS) and Path(app.srcdir, "notebooks", f"{chapter}.ipynb").is_file()
    if is_chapter and (where := repository()):  # a variant has no notebook of its own
        context["header_buttons"].append(buttons(where, chapter))


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    repository()  # a wrong address is told before anything is built
    app.connect("html-page-context", add_buttons, priority=900)  # after the theme has made its own
    return {"parallel_read_safe": True, "parallel_write_safe": True}
