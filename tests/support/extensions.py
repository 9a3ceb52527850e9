"""The book's own Sphinx extensions, which are no package."""

import importlib.util
from types import ModuleType

from tests.support import ROOT


def extension(name: str) -> ModuleType:
    """The module `name` of book/_ext."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "book" / "_ext" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
