"""How a computation ended, in a word and a sentence."""

from enum import StrEnum
from typing import Self


class Outcome(StrEnum):
    """A word, which compares with a string, and its `remedy`: what it means and what a user may do.

    Examples
    --------
    >>> class Search(Outcome):
    ...     LOST = "lost", "nothing was found: start nearer to it"
    >>> Search("lost") == "lost", Search.LOST.remedy
    (True, 'nothing was found: start nearer to it')
    """

    remedy: str

    def __new__(cls, word: str, remedy: str = "") -> Self:
        """A member from its word and its sentence."""
        member = str.__new__(cls, word)
        member._value_, member.remedy = word, remedy
        return member
