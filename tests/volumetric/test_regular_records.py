"""Records that are numbers alone are read at once: with the same result as one by one, whatever stands in a file."""

from collections.abc import Callable
from unittest.mock import patch

import pytest
from hypothesis import given, settings, strategies as st

from axcomp.lists import Findings, ParameterBlock, read_etalon, read_isg_csv

CELLS = st.integers(-50, 50).map(str) | st.sampled_from(
    ("0.5", "-1e-3", "1,5", "1_0", "nan", "inf", "1e999", "٣", '"2"', "...", "x", "5//", "}", "{", ";", "", "\u2003")
)
HEADS = ("X Y EXX", "X EYX", "Y;X;EXX", "X\tEXX", "X,EXX", "#", "// note", "")
SECTIONS = ("[EXX]", "[HEADER]", "[EAY]", "Gridpoints = {", "}", "VALUE = 1", "{", "Gridpoints = { 1 2")
LINES = st.sampled_from((*HEADS, *SECTIONS))
RECORDS = st.tuples(st.integers(1, 3), st.integers(1, 6)).flatmap(
    lambda size: st.lists(
        st.lists(st.integers(-9, 9), min_size=size[0], max_size=size[0]), min_size=1, max_size=size[1]
    )
)
TEXTS = st.lists(
    LINES
    | RECORDS.map(lambda rows: "\n".join(" ".join(map(str, row)) for row in rows))
    | st.lists(CELLS, max_size=4).map(" ".join)
    | st.text(max_size=8),
    max_size=14,
).map("\n".join)
Reader = Callable[[str, str, Findings], list[ParameterBlock]]


def said(read: Reader, text: str) -> tuple[object, ...]:
    findings = Findings()
    return read(text, "a.csv", findings), findings.all()


@pytest.mark.parametrize("read", [read_isg_csv, read_etalon])
@given(text=TEXTS)
@settings(max_examples=300)
def test_both_readers_agree_on_any_text(read: Reader, text: str) -> None:
    with (
        patch("axcomp.lists.isg_csv.regular_rows", return_value=[]),
        patch("axcomp.lists.etalon.regular_rows", return_value=[]),
    ):
        alone = said(read, text)
    assert said(read, text) == alone


@pytest.mark.parametrize("text", ["X Y EXX\n" + "1 2\n" * 20_000, "X EXX\n" + "1 2 //\n3 4\n" * 10_000])
def test_irregular_records_do_not_make_it_slow(text: str) -> None:
    # Each line is looked at a fixed number of times: with one pass a line this would take minutes.
    read_isg_csv(text, "a.csv", Findings())
