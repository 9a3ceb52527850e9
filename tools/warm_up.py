"""Compile every kernel once, on all cores, so that no chapter and no test has to wait for it."""

from __future__ import annotations

import sys

from gearpair.study.first_hour import get_ready

if __name__ == "__main__":
    get_ready(progress=sys.stderr.isatty())
