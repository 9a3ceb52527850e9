"""How a graded example differs from the reference: an edit of a cell, or code behind its answer."""

Edit = tuple[str, str, str]
END = "### END SOLUTION"


def then(cell: str, code: str) -> list[Edit]:
    """The reference solution, and behind it code that answers otherwise."""
    return [(cell, END, code)]
