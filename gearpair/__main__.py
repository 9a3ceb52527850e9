"""``python -m gearpair``."""

import sys

from gearpair.study.cli import main

if __name__ == "__main__":
    sys.exit(main())
