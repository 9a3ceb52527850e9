"""The assignments of the course, what they are worth, and graded examples of each."""

from tests.teach.honest import HONEST
from tests.teach.wrong import WRONG

__all__ = ["FULL", "HONEST", "NAMES", "WRITTEN", "WRONG"]

FULL = 15.0
WRITTEN = 5.0
NAMES = ("stiffness", "frequency", "damping", "impacts", "speed_chart", "in_service")
