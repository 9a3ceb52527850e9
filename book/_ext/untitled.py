"""Lets the links from code (sphinx-codeautolink) pass the untitled sections that exercises are made of."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx_codeautolink.extension.block import CodeBlockAnalyser


def depart_section(self: Any, node: nodes.section) -> None:
    """Forget the latest title, where the section brought one."""
    if any(isinstance(child, nodes.title) for child in node.children):
        self.title_stack.pop()


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    CodeBlockAnalyser.depart_section = depart_section
    return {"parallel_read_safe": True, "parallel_write_safe": True}
