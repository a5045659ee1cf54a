from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from axcomp.engine import (
    Assignment,
    AxisCommand,
    AxisVariable,
    Command,
    NcError,
    Variable,
    VolumetricSwitch,
    VolumetricUpdate,
    parse_block,
)


@pytest.mark.parametrize(
    ("block", "commands"),
    [
        ("", []),
        ("N10 ; only a comment", []),
        ("X[COMP ON CROSS]", [AxisCommand(1, "X", on=("cross",))]),
        ("x[comp on cross plane lead frict crosstalk]",
         [AxisCommand(1, "X", on=("cross", "plane", "leadscrew", "friction", "crosstalk"))]),
        ("N20 Y1[COMP OFF LEAD NO_MOVE]", [AxisCommand(5, "Y1", off=("leadscrew",), no_move=True)]),
        ("Z[COMP OFF_ALL]", [AxisCommand(1, "Z", all_off=True)]),
        ("Z[COMP OFF_ALL NO_MOVE]", [AxisCommand(1, "Z", all_off=True, no_move=True)]),
        ("X[COMP ON]", [AxisCommand(1, "X", all_on=True)]),
        ("X[COMP ON CROSS OFF PLANE LEAD]", [AxisCommand(1, "X", on=("cross",), off=("plane", "leadscrew"))]),
        ("X[COMP ON CROSS NO_MOVE OFF LEAD]",
         [AxisCommand(1, "X", on=("cross",), off=("leadscrew",), no_move=True)]),
        ("X[COMP ON CROSS OFF LEAD NO_MOVE]",
         [AxisCommand(1, "X", on=("cross",), off=("leadscrew",), no_move=True)]),
        ("X[COMP ON CROSS] Y[COMP OFF PLANE]",
         [AxisCommand(1, "X", on=("cross",)), AxisCommand(18, "Y", off=("plane",))]),
        ("X[COMP \\\n  ON CROSS] \\  \n Y[COMP OFF_ALL]",
         [AxisCommand(1, "X", on=("cross",)), AxisCommand(27, "Y", all_off=True)]),
        ("N1 X[COMP OFF_ALL]\n\nN2 #VOLCOMP OFF ALL\n",
         [AxisCommand(4, "X", all_off=True), VolumetricSwitch(24, False, None)]),
        ("X[COMP (these) ON CROSS] ; and no more", [AxisCommand(1, "X", on=("cross",))]),
        ("Y-ACHSE[COMP ON FRICT]", [AxisCommand(1, "Y-ACHSE", on=("friction",))]),
        ("#VOLCOMP ON [ID=0]", [VolumetricSwitch(1, True, 0)]),
        ("#VOLCOMP ON [ID0]", [VolumetricSwitch(1, True, 0)]),
        ("#VOLCOMP ON [ID 0]", [VolumetricSwitch(1, True, 0)]),
        ("V.A.CROSSTALK_COMP_ACTIVE.X2", [AxisVariable(1, "crosstalk", "X2")]),
        ("V.A.BACKLASH_COMP_ACTIVE.X", [AxisVariable(1, "backlash", "X")]),
        ("V.A.TEMP_COMP_ACTIVE.X", [AxisVariable(1, "temperature", "X")]),
        ("X[COMP ON BACKLASH TEMP]", [AxisCommand(1, "X", on=("backlash", "temperature"))]),
        ("N90 #VOLCOMP OFF [ID4 NO_MOVE]", [VolumetricSwitch(5, False, 4, no_move=True)]),
        ("# volcomp on [ id = 3 cfact_y=0.25 no_move CFACT_X = 1 ]",
         [VolumetricSwitch(1, True, 3, True, (1.0, 0.25, 1.0))]),
        ("#VOLCOMP ON ALL", [VolumetricSwitch(1, True, None)]),
        ("#VOLCOMP OFF ALL", [VolumetricSwitch(1, False, None)]),
        ("#VOLCOMP [ID=2 UPDATE]", [VolumetricUpdate(1, 2)]),
        ("#VOLCOMP [ID02 UPDATE]", [VolumetricUpdate(1, 2)]),
        ("V.G.VOLCOMP[0].ACTIVE", [Variable(1, 0, None)]),
        ('V.G.VOLCOMP[1].FILE[2] = "new (1).csv"', [Assignment(Variable(1, 1, 2), "new (1).csv")]),
        ("V.G.VOLCOMP[1].FILE[2]=V.G.VOLCOMP[0].FILE[3]", [Assignment(Variable(1, 1, 2), Variable(24, 0, 3))]),
    ],
)  # fmt: skip
def test_blocks_say_what_the_manuals_say(block: str, commands: list[Command]) -> None:
    assert list(parse_block(block)) == commands


@pytest.mark.parametrize(
    ("block", "place", "expected"),
    [
        ("X[COMP ONE CROSS]", 8, "ON or OFF or OFF_ALL is expected, not “ONE”"),
        ("X[COMP ON CROS]", 11, "CROSS, PLANE, CROSSTALK, TEMP, LEAD, BACKLASH, FRICT, NO_MOVE"),
        ("X[COMP OFF]", 11, "CROSS, PLANE, CROSSTALK, TEMP, LEAD, BACKLASH, FRICT is expected, not “]”"),
        ("X[COMP ON\nCROSS]", 10, "not the end of the line"),
        ("X[COMP ON CROSS", 16, "not the end of the block"),
        ("X[COM ON CROSS]", 3, "COMP is expected"),
        ("X COMP ON", 3, "[ is expected, not “COMP”"),
        ("X[COMP OFF_ALL CROSS]", 16, "NO_MOVE"),
        ("X[COMP ON CROSS OFF CROSS]", 1, "CROSS is both on and off"),
        ("X[COMP ON LEAD PLANE OFF CROSS PLANE LEAD]", 1, "PLANE, LEAD is both on and off"),
        ("X[COMP ON OFF CROSS]", 1, "CROSS is both on and off"),
        ("X[COMP ON CROSS OFF_ALL]", 1, "OFF_ALL stands alone"),
        ("X[COMP OFF_ALL ON]", 1, "OFF_ALL stands alone"),
        ("V.A.SSFK_COMP_ACTIVE.X", 1, "LEAD"),
        ("X100", 5, "[ is expected"),
        ("N10 12", 5, "an axis, #VOLCOMP or V.G.VOLCOMP is expected, not “12”"),
        ("#VOLKOMP ON ALL", 2, "VOLCOMP is expected, not “VOLKOMP”"),
        ("#VOLCOMP ON", 12, "ALL or [ID=… is expected, not the end of the block"),
        ("#VOLCOMP", 9, "ON, OFF or [ is expected"),
        ("#VOLCOMP ON [ID=0 UPDATE]", 19, "NO_MOVE, CFACT_X, CFACT_Y, CFACT_Z or ] is expected, not “UPDATE”"),
        ("#VOLCOMP [ID=0]", 15, "UPDATE is expected, not “]”"),
        ("#VOLCOMP ON [ID=0 CFACT_X=1.5]", 27, "CFACT_X is 0 … 1, not 1.5"),
        ("#VOLCOMP ON [ID=0 CFACT_X=-1]", 27, "CFACT_X is 0 … 1, not -1"),
        ("#VOLCOMP ON [ID=0 CFACT_X 1]", 27, "= is expected"),
        ("V.G.VOLCOMP[0].FILES[0]", 15, ".FILE or .ACTIVE is expected"),
        ("V.G.VOLCOMP[0].ACTIVE = 1", 1, "can only be read"),
        ("V.G.VOLCOMP[0].FILE[0] = new.csv", 26, "a string in quotes is expected"),
        ('V.G.VOLCOMP[0].FILE[0] = "new.csv', 26, "“\"” begins neither a name nor a number nor a string"),
        ("X[COMP ON CROSS] §", 18, "“§” begins neither"),
    ],
)  # fmt: skip
def test_an_error_says_what_was_expected_at_which_character(block: str, place: int, expected: str) -> None:
    with pytest.raises(NcError) as caught:
        parse_block(block)
    assert caught.value.place == place
    assert expected in str(caught.value)
    assert str(caught.value).startswith(f"character {place}: ")


@pytest.mark.parametrize(
    ("block", "place", "code"),
    [
        ("#VOLCOMP ON [ID=5]", 17, "21749"),
        ("#VOLCOMP ON [ID5]", 16, "21749"),
        ("#VOLCOMP [ID=-1 UPDATE]", 14, "21749"),
        ("#VOLCOMP [ID=0.5 UPDATE]", 14, "21749"),
        ("V.G.VOLCOMP[5].ACTIVE", 13, "70506"),
        ("V.G.VOLCOMP[0].FILE[10]", 21, "70507"),
    ],
)
def test_numbers_out_of_range_have_the_vendors_errors(block: str, place: int, code: str) -> None:
    with pytest.raises(NcError) as caught:
        parse_block(block)
    assert (caught.value.place, caught.value.code) == (place, code)
    assert f"error {code}" in str(caught.value)


@given(st.text(alphabet='XY[]=#., \n\\;()"0123456789' + "COMPNFALIDVG_", max_size=60) | st.text(max_size=30))
def test_any_text_is_a_block_or_an_error_with_a_place(block: str) -> None:
    try:
        parse_block(block)
    except NcError as error:
        assert 1 <= error.place <= len(block) + 1
