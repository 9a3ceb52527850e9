"""The README's library example as somebody runs it who has installed nothing but the wheel: `make check-wheel`."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def library_example() -> str:
    """The one piece of Python in the README."""
    (example,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    return str(example)


if __name__ == "__main__":
    python = Path(sys.argv[1]).absolute()  # the path of the environment, not of what it links to
    check = "import gearpair, pathlib; assert 'site-packages' in gearpair.__file__, gearpair.__file__\n"
    script = check + library_example()
    subprocess.run([python, "-I", "-c", script], check=True, cwd="/")
