"""What the tests share: where the checkout is, oscillators to try, independent references."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
