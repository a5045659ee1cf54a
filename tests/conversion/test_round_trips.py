"""Whatever a format can hold comes back from it, to half of what the lists resolve."""

from collections.abc import Callable

import pytest
from drawn_tables import HALF_RESOLUTION, changed, tables
from hypothesis import given, settings, strategies as st

from axcomp.conversion import FORMATS, CompensationTable, Options, largest_difference, machine_with, tables_of, written

HOLDS: dict[str, Callable[[], st.SearchStrategy[CompensationTable]]] = {
    "enc-comp": lambda: tables(even=True, bilateral=False, cross=False),
    "cec": lambda: tables(even=True),
    "heidenhain": tables,
    "itnc": lambda: tables(even=True, bilateral=False, from_zero=True),
    "linuxcnc-0": lambda: tables(cross=False, turning=False),
    "linuxcnc-1": lambda: tables(cross=False, turning=False),
    "csv": tables,
}


def test_every_format_is_tried() -> None:
    assert set(HOLDS) == set(FORMATS)


@pytest.mark.parametrize("name", HOLDS)
@given(data=st.data())
@settings(max_examples=30, deadline=None)
def test_a_table_comes_back(name: str, data: st.DataObject) -> None:
    table = data.draw(HOLDS[name]())
    _, result = written([table], name, Options())
    assert len(result) == 1
    assert result[0].difference.size <= HALF_RESOLUTION[table.unit]
    assert (result[0].after.axis, result[0].after.over) == (table.axis, table.over)
    assert (result[0].after.unit, result[0].after.over_unit) == (table.unit, table.over_unit)


@pytest.mark.parametrize("name", ["enc-comp", "cec", "linuxcnc-0", "linuxcnc-1"])
@given(data=st.data())
@settings(max_examples=30, deadline=None)
def test_a_table_comes_back_from_inches(name: str, data: st.DataObject) -> None:
    table = data.draw(HOLDS[name]())
    text, result = written([table], name, Options(inch=True))
    assert result[0].difference.size <= HALF_RESOLUTION[table.unit]
    if table.over_unit == "mm" and any(table.positions):
        assert text != FORMATS[name].write([table], Options())


@given(first=tables(even=True, cross=False), second=tables(even=True, cross=True))
@settings(max_examples=25, deadline=None)
def test_several_tables_share_a_cec_file(first: CompensationTable, second: CompensationTable) -> None:
    if {first.unit, second.unit, first.over_unit, second.over_unit} == {"mm"}:
        _, result = written([first, second], "cec", Options())
        assert max(one.difference.size for one in result) <= HALF_RESOLUTION["mm"]


@given(table=tables(turning=False, cross=False))
@settings(max_examples=25, deadline=None)
def test_a_machine_gives_the_table_it_was_made_with(table: CompensationTable) -> None:
    assert tables_of(machine_with([table])) == [table]


@given(table=tables(turning=False, bilateral=False, cross=True))
@settings(max_examples=25, deadline=None)
def test_a_machine_gives_the_cross_table_it_was_made_with(table: CompensationTable) -> None:
    assert tables_of(machine_with([table])) == [table]


@given(one=tables(), other=tables())
@settings(max_examples=30, deadline=None)
def test_the_difference_is_symmetric_and_not_below_that_at_the_points(
    one: CompensationTable, other: CompensationTable
) -> None:
    other = changed(other, unit=one.unit)
    factor = {"mm": 1e3, "deg": 3600.0}[one.unit]
    difference = largest_difference(one, other)
    assert difference.size == largest_difference(other, one).size
    inner = [x for x in one.positions if one.period is None and other.period is None]
    for here, there in zip(one.at(inner), other.at(inner), strict=True):
        assert difference.size >= factor * abs(here - there) - 1e-9
