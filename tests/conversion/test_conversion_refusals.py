"""What another format cannot hold is refused in words, and what is wrong with a file is said with its line."""

from collections.abc import Callable

import pytest
from drawn_tables import changed
from hypothesis import example, given, settings, strategies as st

from axcomp.conversion import (
    FORMATS,
    CannotHoldError,
    CompensationTable,
    FormatError,
    Options,
    beginning_at,
    largest_difference,
    machine_with,
    on_equidistant_points,
    recognized,
    tables_of,
    written,
)
from axcomp.kinds import KINDS, Friction, Plane
from axcomp.model import Axis, Machine

UNEVEN = CompensationTable.of("X", "X", (0.0, 10.0, 30.0, 45.0), (0.0, 0.01, 0.02, 0.0))
BILATERAL = CompensationTable.of("X", "X", (0.0, 10.0), (0.0, 0.01), (0.001, 0.012))
CROSS = CompensationTable.of("Z", "X", (0.0, 10.0), (0.0, 0.01))
TURNING = CompensationTable.of("C", "C", (0.0, 90.0, 180.0, 270.0), (0.0, 0.01, 0.02, 0.0), None, 360.0, "deg", "deg")
HALF = changed(TURNING, positions=(0.0, 30.0, 60.0, 90.0), period=180.0)
ROTARY = changed(TURNING, period=None)
LONG = CompensationTable.of("X", "X", tuple(map(float, range(300))), (0.0,) * 300)


@pytest.mark.parametrize(
    ("name", "table", "because"),
    [
        ("enc-comp", UNEVEN, "10 to 20 mm apart"),
        ("enc-comp", BILATERAL, "bilateral"),
        ("enc-comp", CROSS, "its own position"),
        ("cec", UNEVEN, "10 to 20 mm apart"),
        ("itnc", BILATERAL, "bilateral"),
        ("itnc", UNEVEN, "equidistant"),
        ("itnc", LONG, "300 points; the control takes 256"),
        ("linuxcnc-0", CROSS, "its own position"),
        ("linuxcnc-1", TURNING, "repeats every 360 deg"),
        ("linuxcnc-1", LONG, "300 points; LinuxCNC takes 256"),
        ("heidenhain", HALF, "repeats every 180 deg"),
        ("heidenhain", ROTARY, "does not repeat"),
    ],
)
def test_what_a_format_cannot_hold_is_said(name: str, table: CompensationTable, because: str) -> None:
    with pytest.raises(CannotHoldError, match=because):
        written([table], name, Options())


def test_more_points_than_the_control_reserves_are_refused() -> None:
    with pytest.raises(CannotHoldError, match="300 points; there is room for 200"):
        written([LONG], "enc-comp", Options(max_points=200))


def test_as_many_points_as_the_control_reserves_are_taken_and_not_one_more() -> None:
    for count, room in ((300, 300), (2, 2)):
        table = changed(LONG, positions=LONG.positions[:count], positive=LONG.positive.y[:count])
        assert len(on_equidistant_points(table, room, None).positions) == count
        with pytest.raises(CannotHoldError, match=f"{count} points; there is room for {room - 1}"):
            on_equidistant_points(table, room - 1, None)
    # 0, 10, 30 and 45 are among ten points 5 mm apart, and among no fewer.
    assert len(on_equidistant_points(UNEVEN, 10, 0.0).positions) == 10
    with pytest.raises(CannotHoldError, match="on up to 9 equidistant points"):
        on_equidistant_points(UNEVEN, 9, 0.0)


def test_other_points_are_taken_only_within_the_stated_bound() -> None:
    _, [result] = written([UNEVEN], "enc-comp", Options(within=1.0))
    assert 0.05 < result.difference.size <= 1.0
    _, [exact] = written([UNEVEN], "enc-comp", Options(within=0.0))
    assert exact.difference.size < 1e-6
    assert exact.after.positions == pytest.approx(range(0, 46, 5))
    with pytest.raises(CannotHoldError, match="on up to 4 equidistant points"):
        written([UNEVEN], "enc-comp", Options(within=1.0, max_points=4))


@given(bound=st.floats(0.1, 5.0), values=st.lists(st.integers(-300, 300), min_size=4, max_size=4))
@settings(max_examples=25, deadline=None)
def test_resampling_never_exceeds_its_bound(bound: float, values: list[int]) -> None:
    table = changed(UNEVEN, positive=tuple(value * 1e-4 for value in values))
    assert largest_difference(table, on_equidistant_points(table, 2000, bound)).size <= bound + 1e-6


def test_a_table_that_jumps_where_it_begins_again_cannot_begin_elsewhere() -> None:
    jumping = changed(TURNING, positions=(90.0, 180.0, 270.0, 450.0), positive=(0.0, 0.01, 0.02, 0.03))
    with pytest.raises(CannotHoldError, match="jumps at 90 deg"):
        beginning_at(jumping, 0.0)


def test_a_file_with_values_finer_than_the_format_writes_is_refused_where_it_matters() -> None:
    # Four decimals move the only steep flank sideways by 0.00005 mm: 0.25 µm at 5 µm/µm.
    steep = CompensationTable.of("X", "X", (0.0, 1.00005, 1.00105), (0.0, 0.0, 5.0))
    with pytest.raises(CannotHoldError, match="would differ by"):
        written([steep], "heidenhain", Options())


def test_kinds_over_more_than_one_axis_are_refused() -> None:
    plane = Plane(1, 2, 0.0, 0.0, 1.0, 1.0, ((0.0, 0.0), (0.0, 0.0)))
    machine = Machine(
        (Axis(1, "X"), Axis(2, "Y"), Axis(3, "Z", plane=plane, friction=Friction((0.0, 1.0), (0.0, 1.0))))
    )
    with pytest.raises(CannotHoldError, match="the plane compensation of Z is a table over two axes"):
        tables_of(machine)
    with pytest.raises(CannotHoldError, match="friction compensation of Z is a table of currents"):
        tables_of(machine, "Z", "friction")
    with pytest.raises(CannotHoldError, match="there is no axis 'A'; the machine has X, Y, Z"):
        tables_of(machine, "A")
    with pytest.raises(CannotHoldError, match="no leadscrew compensation of axis X"):
        tables_of(machine, "X", "leadscrew")


def test_every_kind_is_converted_or_refused() -> None:
    for kind in KINDS:
        with pytest.raises(CannotHoldError):
            tables_of(Machine((Axis(1, "X"),)), kind=kind)


@pytest.mark.parametrize(
    ("tables", "because"),
    [
        ([changed(CROSS, negative=(0.0, 0.0))], "bilateral"),
        ([changed(TURNING, axis="Z", unit="mm")], "repeats every 360 deg"),
        ([CROSS, changed(CROSS, over="Y")], "two cross tables"),
        ([changed(TURNING, unit="mm", over_unit="mm")], "the lists repeat rotary axes only"),
    ],
)
def test_what_the_lists_cannot_hold_is_said(tables: list[CompensationTable], because: str) -> None:
    with pytest.raises(CannotHoldError, match=because):
        machine_with(tables)


ENC = "$AA_ENC_COMP[0,0,X]=0\n$AA_ENC_COMP[0,1,X]=0.01\n$AA_ENC_COMP_STEP[0,X]=10\n$AA_ENC_COMP_MIN[0,X]=0\n"
ENC += "$AA_ENC_COMP_MAX[0,X]=10\n"
CEC = ENC.replace("AA_ENC_COMP", "AN_CEC").replace(",X]", "]")
CEC += "$AN_CEC_INPUT_AXIS[0]=(X)\n$AN_CEC_OUTPUT_AXIS[0]=(Y)\n"
COM = "BEGIN AXIS_X.COM MM\nNR   AXISPOS       BACKLASH      X\n0    +0.0000                     +0.0000\n"


@pytest.mark.parametrize(
    ("name", "text", "line", "because"),
    [
        ("enc-comp", ENC + "G1 X10", 6, "expected"),
        ("enc-comp", ENC.replace("=0.01", "=ten"), 2, "must be a number"),
        ("enc-comp", ENC.replace("[0,1,X]", "[0,2,X]"), 1, "lacks the value with index 1"),
        ("enc-comp", ENC + "$AA_ENC_COMP[0,2,X]=0\n", 1, "index 2 has a value too"),
        ("enc-comp", ENC.replace("STEP[0,X]=10", "STEP[0,X]=3"), 5, "its end must be a point"),
        ("enc-comp", ENC.replace("STEP[0,X]=10", "STEP[0,X]=0"), 5, "distance above 0"),
        ("enc-comp", ENC.replace("MAX[0,X]=10", "MAX[0,X]=1000000000"), 5, "points"),
        ("enc-comp", ENC.replace("[0,1,X]", "[0,1]"), 2, "name of an axis"),
        ("enc-comp", ENC.replace("[0,1,X]", "[0,-1,X]"), 2, "index 2"),
        ("enc-comp", ENC.replace("[0,", "[1,"), 0, "it has one for encoder 1"),
        ("enc-comp", CEC, 1, "no variable of a leadscrew compensation"),
        ("cec", CEC + "$AN_CEC_MULT_BY_TABLE[0]=2\n", 8, "multiplied by another one"),
        ("cec", CEC + "$AN_CEC_DIRECTION[0]=2\n", 8, "must be −1, 0 or 1"),
        ("cec", CEC + "$AN_CEC_IS_MODULO[0]=yes\n", 8, "must be 0 or 1"),
        ("cec", CEC.replace("$AN_CEC_INPUT_AXIS[0]=(X)\n", ""), 1, "no $AN_CEC_INPUT_AXIS"),
        ("cec", "", 0, "no table"),
        ("heidenhain", COM.replace("BEGIN", "START"), 1, "expected BEGIN"),
        ("heidenhain", COM.replace("MM", "FEET"), 1, "expected MM, INCH or DATUM"),
        ("heidenhain", COM.replace("AXISPOS", "POS    "), 2, "neither a column AXISPOS"),
        ("heidenhain", COM + "2    +1.0000                     +0.0000\n", 4, "line number 1 expected"),
        ("heidenhain", COM + "1    +0.0000                     +0.0000\n", 4, "must ascend"),
        ("heidenhain", COM + "1    +1.0000\n", 4, "column X is empty here"),
        ("heidenhain", COM + "1    +1.0000       +1.0000       +0.0000\n", 4, "BACKLASH has a value here"),
        ("heidenhain", COM.split("\n0", maxsplit=1)[0], 0, "no points"),
        ("linuxcnc-0", "0 0 0\n1 1\n", 2, "expected three numbers"),
        ("linuxcnc-0", "0 0 0\n\n1 1 1\n", 2, "LinuxCNC stops reading here"),
        ("linuxcnc-0", "# nominal forward reverse\n0 0 0\n", 1, "expected three numbers"),
        ("linuxcnc-1", "1 0 0\n1 0 0\n", 2, "must ascend"),
        ("linuxcnc-1", "\n".join(f"{n} 0 0" for n in range(257)), 257, "at most 256 points"),
        ("linuxcnc-1", "0 nan 0", 1, "forward must be a number"),
        ("csv", "axis,position\nX,0\n", 1, "'correction' or 'error'"),
        ("csv", "position,correction,error\n0,0,0\n", 1, "'correction' or 'error'"),
        ("csv", "position,correction\n0,0\n0,0\n", 3, "must ascend"),
        ("csv", "position,correction\n0\n", 2, "1 cells stand under 2 columns"),
        ("csv", "position,correction,period\n0,0,360\n400,0,360\n", 2, "longer than"),
        ("csv", "position,correction,colour\n", 1, "unknown column 'colour'"),
    ],
)
def test_a_wrong_file_is_refused_with_its_line(name: str, text: str, line: int, because: str) -> None:
    with pytest.raises(FormatError, match=because.replace("$", r"\$")) as caught:
        FORMATS[name].read(text, Options(axis="X"))
    assert caught.value.line == line


GOOD: dict[str, Callable[[], str]] = {
    name: lambda name=name, table=table: written([table], name, Options())[0]  # type: ignore[misc]
    for name, table in (
        ("enc-comp", TURNING),
        ("cec", BILATERAL),
        ("heidenhain", BILATERAL),
        ("itnc", TURNING),
        ("linuxcnc-0", BILATERAL),
        ("linuxcnc-1", BILATERAL),
        ("csv", TURNING),
    )
}
PIECES = st.sampled_from(
    ["", "-", "1e300", "$AN_CEC", "[0,0]", "0,", ";", "END", "nan", "\t", '"', "X", "\x00", "٣", "9" * 50, "="]
)


@pytest.mark.parametrize("name", FORMATS)
@given(data=st.data())
@settings(max_examples=50, deadline=None)
def test_damaged_files_give_tables_or_an_error_with_a_line(name: str, data: st.DataObject) -> None:
    text = GOOD[name]()
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(text)))
        end = data.draw(st.integers(start, min(len(text), start + 12)))
        text = text[:start] + data.draw(PIECES | st.text(max_size=8)) + text[end:]
    _read_or_refuse(name, text)


@pytest.mark.parametrize("name", FORMATS)
@given(text=st.text())
@example(text="BEGIN A DATUM:1 DISTANCE:-1\nNR\n0")
@example(text="BEGIN AXIS_X.COM\nNR AXISPOS X\n")
@settings(max_examples=30, deadline=None)
def test_any_text_gives_tables_or_an_error(name: str, text: str) -> None:
    _read_or_refuse(name, text)


def _read_or_refuse(name: str, text: str) -> None:
    recognized(text)
    for options in (Options(axis="X"), Options(axis="X", rotary=frozenset({"X", "C"}), inch=True)):
        try:
            tables = FORMATS[name].read(text, options)
        except FormatError as error:
            assert 0 <= error.line <= text.count("\n") + len(text.splitlines()) + 1
        else:
            assert tables
