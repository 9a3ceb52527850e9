"""`gp.published` holds what the article states, and nothing else.

The expected values are typed here a second time, from the article's numbered items, so that a slip in either shows.
"""

import dataclasses

import pytest

import gearpair as gp
from gearpair.article import published

ITEMS_PER_SECTION = {"M": 6, "K": 5, "N": 3, "F": 14, "D": 6, "I": 5, "C": 5}


def test_every_item_is_there_once_in_order():
    expected = [f"{letter}{i}" for letter, n in ITEMS_PER_SECTION.items() for i in range(1, n + 1)]
    assert [s.item for s in published.STATEMENTS] == expected


def test_every_statement_says_something_and_knows_its_section():
    for s in published.STATEMENTS:
        assert s.text.endswith(".") and len(s.text) > 20
        assert s.section == published.SECTIONS[s.item[0]]


def test_the_librarys_defaults_are_the_baseline():
    osc = gp.Oscillator()
    for name, value in vars(published.BASELINE).items():
        assert osc.parameter(name) == value
    assert osc.mesh_frequency == published.DAMPING_FREQUENCY


def test_baseline_values():
    assert dataclasses.astuple(published.BASELINE) == (0.1, 0.2, 0.0, 1.68, 0.116, 0.414, 0.02)


def test_stiffness_table():
    assert [dataclasses.astuple(row) for row in published.STIFFNESS_TABLE] == [
        (34, 34, 1.65, 0.116, 0.414),
        (34, 44, 1.78, 0.125, 0.395),
        (34, 54, 1.88, 0.131, 0.382),
    ]


@pytest.mark.parametrize(
    ("parameter", "ends", "periods", "items"),
    [
        (
            "mesh_frequency",
            [0.7, 0.799, 0.865, 1.028, 1.191, 1.459, 1.555, 1.7],
            [1, 2, 4, 2, None, 2, 1],
            ["F1", "F3", "F5", "F7", "F8", "F10", "F11"],
        ),
        ("damping_ratio", [0.0, 0.00275, 0.0165, 0.025], [None, 3, 1], ["D1", "D3", "D5"]),
    ],
)
def test_ranges_are_contiguous_and_as_printed(parameter, ends, periods, items):
    ranges = published.ranges(parameter)
    assert [ranges[0].lower, *(r.upper for r in ranges)] == ends
    assert all(left.upper == right.lower for left, right in zip(ranges, ranges[1:], strict=False))
    assert [r.motion.period for r in ranges] == periods
    assert [r.item for r in ranges] == items
    assert [b.value for b in published.boundaries(parameter)] == ends[1:-1]
    assert all((r.motion.status == "periodic") == (r.motion.period is not None) for r in ranges)


def test_a_value_lies_in_one_range():
    for parameter, value, item in (("mesh_frequency", 0.799, "F3"), ("damping_ratio", 0.02, "D5")):
        assert [r.item for r in published.ranges(parameter) if value in r] == [item]


def test_single_values():
    assert published.CHAOTIC_FREQUENCY == 1.219
    assert published.COMPLEX_WINDOWS == (3, 6)
    assert published.SUFFICIENT_DAMPING == 0.0165


def test_criteria_are_items():
    assert [c.item for c in published.IMPACT_CRITERIA] == ["I1", "I2", "I3"]
    for criterion in published.IMPACT_CRITERIA:
        assert criterion.condition in published.statement(criterion.item).text


def test_data_cannot_be_changed():
    with pytest.raises(dataclasses.FrozenInstanceError):
        published.BASELINE.a = 0.0


@pytest.mark.parametrize("call", [published.ranges, published.boundaries])
def test_unknown_parameter(call):
    with pytest.raises(ValueError, match="one of 'mesh_frequency', 'damping_ratio', got 'a'"):
        call("a")


def test_unknown_item():
    with pytest.raises(ValueError, match="got 'F99'"):
        published.statement("F99")
