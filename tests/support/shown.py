"""What is wrong with the text that a run chapter shows: numbers that were not found, and numbers that were typed."""

import re

from gearpair.article import published
from gearpair.parameters import BASELINE
from gearpair.study.readable import glued_texts

GLUED = re.compile(r"\{glue:text\}`([^`:]+)`")
NOT_FOUND = re.compile(r"^[–—-]?$|\b(nan|inf)\b")
# "from about nowhere" is no sentence; "it is found nowhere" is.
BEFORE_A_PLACE = re.compile(r"\b(about|above|at|below|between|beyond|by|from|near|of|on|than|to|until|up to)\s$")
NO_PLACE = ("nowhere", "none", "nothing", "never")
# Not prose: blocks of code, formulas, names, addresses, options, roles.
NOT_PROSE = (
    r"^```(?:bash|python|yaml)\n.*?^```$|\$\$.*?\$\$|\$[^$]*\$|\{[\w:]+\}`[^`]*`|`[^`]*`|<[^>]*>|\]\([^)]*\)|^:\w+:.*$"
)
DECIMAL = re.compile(r"(?<![\w.,])\d+\.\d+(?![\w.])")
PUBLISHED = {number for each in published.STATEMENTS for number in DECIMAL.findall(each.text)}


def fallbacks(notebook):
    """The places of an executed notebook at which a text stands for a number that was not found."""
    glued, found = glued_texts(notebook), []
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            for place in GLUED.finditer(cell.source):
                before, text = re.sub(r"\s+", " ", cell.source[: place.start()])[-60:], glued.get(place[1], "")
                lost = NOT_FOUND.search(text) or (text == "None" and not re.search(r"(^|[.:;!?*(] ?)$", before))
                if lost or (text in NO_PLACE and BEFORE_A_PLACE.search(before)):
                    found.append(f"{before}{text}")
        for output in cell.get("outputs", []):
            text = str(output.get("text", output.get("data", {}).get("text/plain", "")))
            found += [line for line in text.splitlines() if re.search(r"\bnan\b", line)]
    return found


def typed_numbers(notebook):
    """The decimals in the prose that is shown for any parameters, but the article's and those of tasks to be done."""
    found = []
    for cell in notebook.cells:
        left_out = cell.cell_type != "markdown" or BASELINE in cell.metadata.get("tags", [])
        if not (left_out or cell.source.startswith("```{exercise}")):
            found += DECIMAL.findall(re.sub(NOT_PROSE, " ", cell.source, flags=re.DOTALL | re.MULTILINE))
    return sorted({*found} - PUBLISHED)
