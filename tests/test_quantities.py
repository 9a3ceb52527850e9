"""The vocabulary: one row a quantity, and a row for whatever is shown."""

import pytest

from gearpair import Oscillator
from gearpair.design.loads import MEASURES as LOADS
from gearpair.design.sensitivities import OUTCOMES
from gearpair.motion.measures import MEASURES
from gearpair.quantities import QUANTITIES, ROWS, attributes, axis_label, part_of
from tests.support import ROOT

PLAIN = [name for name in Oscillator().parameters if part_of(name) is None]  # parts have words of their own


def test_no_quantity_has_two_rows():
    assert len(QUANTITIES) == len(ROWS)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_a_symbol_stands_where_the_words_have_a_place_for_it(row):
    assert row.symbol or "{}" not in row.words + row.axis
    assert row.long_name and row.unit and not set("{}$") & set(row.long_name)
    assert row.label.count("$") == 2 * (row.axis or row.words).count("{}")


def test_parameters_measures_and_outcomes_have_rows():
    assert {*PLAIN, *MEASURES, *LOADS, *OUTCOMES.values()} <= QUANTITIES.keys()
    assert all(QUANTITIES[name].symbol for name in PLAIN)


def test_units_are_told_where_there_are_any():
    assert attributes("error_phase") == {"long_name": "transmission error phase phi_h", "units": "rad"}
    assert axis_label("error_phase") == r"phase of the transmission error $\varphi_h$ (rad)"
    assert axis_label("dte_rms") == "dynamic transmission error, rms (µm)"
    assert axis_label("damping_ratio") == r"damping ratio $\zeta$"
    assert attributes("attractor_period") == attributes("period")
    assert axis_label("of no quantity") == "of no quantity"


def test_the_book_s_table_of_symbols_says_the_same():
    rows = [line for line in (ROOT / "book" / "notation.md").read_text(encoding="utf-8").splitlines() if "|" in line]
    for name in (*PLAIN, "x_min", "x_max"):
        assert any(f"`{name}`" in row and QUANTITIES[name].in_tex in row for row in rows), name
