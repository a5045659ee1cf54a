"""What each control does with its file, written down a second time, and the correction of the lists beside it."""

import numpy as np
import pytest

from axcomp.conversion import (
    CompensationTable,
    Options,
    machine_with,
    read_cec,
    read_csv,
    read_enc_comp,
    read_heidenhain,
    read_linuxcnc,
    tables_of,
    write_cec,
    write_enc_comp,
    write_heidenhain,
    write_itnc,
    write_linuxcnc,
)
from axcomp.kinds import Cross, Leadscrew
from axcomp.model import Axis, Machine
from axcomp.runtime import Runtime

POSITIONS = (0.0, 100.0, 200.0)
ERROR = (0.0, 0.010, 0.030)
"""Actual − programmed: the axis travels 10 µm too far at 100 mm, 30 µm at 200 mm."""
LEADSCREW = Machine((Axis(1, "X", leadscrew=Leadscrew(POSITIONS, ERROR)),))
TOO_FAR = tables_of(LEADSCREW)[0]


def _corrections(machine: Machine, axis: int, moved: int, path: list[float]) -> list[float]:
    """What the kernel adds to the setpoint while one axis goes along a path."""
    runtime = Runtime(machine)
    found = []
    for position in path:
        runtime.inputs.axis[moved].setpoint = position
        runtime.cycle()
        found.append(runtime.outputs.axis[axis].corrected_setpoint - runtime.inputs.axis[axis].setpoint)
    return found


def test_the_table_is_what_the_kernel_adds_to_the_setpoint() -> None:
    path = [-50.0, 0.0, 33.0, 100.0, 150.0, 200.0, 260.0]
    assert np.allclose(_corrections(LEADSCREW, 0, 0, path), TOO_FAR.at(path), atol=1e-15)
    assert TOO_FAR.positive.at(100.0) == -0.010


def test_a_bilateral_table_has_its_second_curve_for_negative_motion() -> None:
    machine = Machine((Axis(1, "X", leadscrew=Leadscrew(POSITIONS, ERROR, (0.001, 0.013, 0.035))),))
    table = tables_of(machine)[0]
    forth, back = [0.0, 50.0, 120.0, 200.0], [170.0, 100.0, 20.0]
    found = _corrections(machine, 0, 0, [*forth, *back])
    assert np.allclose(found, [*table.at(forth, 1), *table.at(back, -1)], atol=1e-15)


def test_a_cross_table_is_added_as_it_stands() -> None:
    machine = Machine((Axis(1, "X"), Axis(2, "Z", cross=Cross(1, POSITIONS, (0.0, 0.02, 0.05)))))
    table = tables_of(machine)[0]
    path = [0.0, 40.0, 150.0, 250.0]
    assert np.allclose(_corrections(machine, 1, 0, path), table.at(path), atol=1e-15)
    assert (table.axis, table.over, table.positive.at(100.0)) == ("Z", "X", 0.02)


def test_enc_comp_holds_the_error_because_it_is_added_to_the_measured_position() -> None:
    text = write_enc_comp([TOO_FAR])
    assert "$AA_ENC_COMP[0,2,X]=0.03\n" in text
    assert "$AA_ENC_COMP_STEP[0,X]=100\n" in text
    # The control moves until measured + value = programmed. Without a value the axis stands 10 µm too far when its
    # encoder shows what is programmed; with it the encoder stands at programmed − value.
    encoder = 100.0 - 0.010
    assert encoder - 100.0 == pytest.approx(TOO_FAR.positive.at(100.0))


def test_the_manuals_example_of_enc_comp_is_read() -> None:
    points = {0: 0.003, 1: 0.01, 2: 0.012, **dict.fromkeys(range(3, 801), 0.0)}
    blocks = [f"$AA_ENC_COMP[0,{index},X1]={value} ; {value * 1e3:+g}μm" for index, value in points.items()]
    ends = [f"$AA_ENC_COMP_{name}[0,X1]={value}" for name, value in (("STEP", 1.0), ("MIN", -200.0), ("MAX", 600.0))]
    text = "\n".join(["%_N_AX_EEC_INI", "CHANDATA(1)", *blocks, *ends, "$AA_ENC_COMP_IS_MODULO[0,X1]=0", "M17"])
    [table] = read_enc_comp(text)
    assert len(table.positions) == 801
    assert table.at([-300.0, -200.0, -199.5, -198.0, 600.0]) == pytest.approx([-0.003, -0.003, -0.0065, -0.012, 0.0])


def test_cec_holds_the_correction_because_it_is_added_to_the_setpoint() -> None:
    cross = CompensationTable.of("Z1", "Y1", (-400.0, 0.0, 400.0), (0.02, 0.0, 0.02))
    text = write_cec([cross])
    assert "$AN_CEC[0,0]=0.02\n" in text
    assert "$AN_CEC_INPUT_AXIS[0]=(Y1)\n" in text
    assert "$AN_CEC_OUTPUT_AXIS[0]=(Z1)\n" in text
    assert read_cec(text) == [cross]
    # A leadscrew changes its sign against ENC_COMP: there the measured position is changed, here the setpoint.
    assert "$AN_CEC[0,2]=-0.03\n" in write_cec([TOO_FAR])


def test_two_cec_tables_with_directions_are_a_bilateral_leadscrew() -> None:
    bilateral = CompensationTable.of("X", "X", POSITIONS, (0.0, -0.01, -0.03), (0.001, -0.02, -0.03))
    text = write_cec([bilateral])
    assert [text.count(f"$AN_CEC_DIRECTION[{t}]={d}\n") for t, d in ((0, 1), (1, -1))] == [1, 1]
    assert read_cec(text) == [bilateral]


def test_cec_tables_of_one_pair_add_up_with_their_weights() -> None:
    def table(t: int, step: int, values: list[float], extra: str = "") -> str:
        points = "\n".join(f"$AN_CEC[{t},{n}]={value}" for n, value in enumerate(values))
        ends = f"$AN_CEC_MIN[{t}]=0\n$AN_CEC_MAX[{t}]={step * (len(values) - 1)}\n$AN_CEC_STEP[{t}]={step}"
        return f"{points}\n{ends}\n$AN_CEC_INPUT_AXIS[{t}]=(X)\n$AN_CEC_OUTPUT_AXIS[{t}]=(Z)\n{extra}"

    text = "\n".join(
        [
            table(0, 100, [0.0, 0.01, 0.03]),
            table(1, 150, [0.0, 0.03], "$AN_CEC_FACTOR[1]=0.5\n"),
            table(2, 50, [0.1, 0.1], "$AN_CEC_DIRECTION[2]=-1\n"),
            table(3, 50, [9.0, 9.0], "$SN_CEC_TABLE_ENABLE[3]=0\n"),
            table(4, 100, [0.0, 0.02], "$SN_CEC_TABLE_WEIGHT[4]=-0.25\n"),
            table(5, 100, [0.04, 0.0], "$AN_CEC_FACTOR[5]=0.5\n$SN_CEC_TABLE_WEIGHT[5]=3\n$SN_CEC_TABLE_ENABLE[5]=1\n"),
        ]
    )
    [found] = read_cec(text)
    x = np.linspace(-20, 230, 251)
    expected = np.interp(x, [0, 100, 200], [0.0, 0.01, 0.03]) + 0.5 * np.interp(x, [0, 150], [0.0, 0.03])
    expected += -0.25 * np.interp(x, [0, 100], [0.0, 0.02]) + 0.5 * 3.0 * np.interp(x, [0, 100], [0.04, 0.0])
    assert np.allclose(found.at(x, 1), expected, atol=1e-15)
    assert np.allclose(found.at(x, -1), expected + 0.1, atol=1e-15)


def test_a_modulo_table_of_sinumerik_follows_its_end_with_its_beginning() -> None:
    points = "\n".join(f"$AA_ENC_COMP[1,{n},C]={0.001 * (n % 4)}" for n in range(5))
    text = f"{points}\n$AA_ENC_COMP_STEP[1,C]=90\n$AA_ENC_COMP_MIN[1,C]=0\n$AA_ENC_COMP_MAX[1,C]=360\n"
    [table] = read_enc_comp(text + "$AA_ENC_COMP_IS_MODULO[1,C]=1", Options(encoder=1))
    assert (table.period, table.unit) == (360.0, "deg")
    assert np.allclose(table.at([45.0, 405.0, -315.0]), -0.0005)
    assert np.allclose(table.at([315.0, -45.0, 675.0]), -0.0015)


def test_heidenhain_holds_the_error_and_the_negative_direction_in_backlash() -> None:
    bilateral = CompensationTable.of("X", "X", POSITIONS, (0.0, -0.01, -0.03), (0.001, -0.02, -0.03))
    lines = write_heidenhain([bilateral]).splitlines()
    assert lines[0] == "BEGIN AXIS_X.COM MM"
    assert lines[1].split() == ["NR", "AXISPOS", "BACKLASH", "X"]
    assert lines[3].split() == ["1", "+100.0000", "+0.0200", "+0.0100"]
    assert read_heidenhain("\n".join(lines)) == [bilateral]


def test_a_heidenhain_file_corrects_several_axes_over_one() -> None:
    screw = CompensationTable.of("Y", "Y", (-90.0, 0.0, 410.0), (0.0, 0.001, -0.002))
    sag = CompensationTable.of("Z", "Y", (-90.0, 200.0), (0.01, -0.02))
    text = write_heidenhain([screw, sag])
    found = read_heidenhain(text)
    assert [(table.axis, table.over) for table in found] == [("Y", "Y"), ("Z", "Y")]
    x = np.linspace(-100.0, 420.0, 521)
    assert np.allclose(found[0].at(x), screw.at(x), atol=5e-5)
    assert np.allclose(found[1].at(x), sag.at(x), atol=5e-5)


def test_the_older_heidenhain_file_places_its_points_by_datum_and_distance() -> None:
    # The spacing 2**16 · 0.1 µm and the first points of an example in the manual of the TNC 407.
    text = "BEGIN AXIS-Y.COM DATUM:-90.0000 DISTANCE:+6.5536\nNR                  X          Y          Z\n"
    text += "0       -90.0000                         +0.0100\n1       -83.4464                         +0.0200\n"
    [table] = read_heidenhain(text)
    assert (table.axis, table.over) == ("Z", "Y")
    assert table.positions == pytest.approx((-90.0, -83.4464))
    assert table.positive.y == (-0.01, -0.02)
    [screw] = read_heidenhain(write_itnc([TOO_FAR]))
    assert screw == TOO_FAR


@pytest.mark.parametrize("comp_type", [0, 1])
def test_linuxcnc_adds_the_trim_to_the_commanded_position(comp_type: int) -> None:
    # The three lines of the example in LinuxCNC's documentation for type 0, and the trims they mean.
    rows = [(-1.0, -1.005, -0.995), (0.0, 0.002, -0.003), (1.0, 1.003, 0.998)]
    trims = [(nominal, nominal - forward, nominal - reverse) for nominal, forward, reverse in rows]
    text = "\n".join(" ".join(f"{value:.6f}" for value in row) for row in (trims if comp_type else rows))
    [table] = read_linuxcnc(text, Options(axis="X"), comp_type)
    assert np.allclose(table.at([-1.0, 0.0, 1.0, 5.0], 1), [0.005, -0.002, -0.003, -0.003])
    assert np.allclose(table.at([-5.0, -1.0, 0.0, 1.0], -1), [-0.005, -0.005, 0.003, 0.002])
    written = write_linuxcnc([table], Options(), comp_type)
    assert read_linuxcnc(written, Options(axis="X"), comp_type) == [table]


def test_linuxcnc_inches_become_millimetres() -> None:
    [table] = read_linuxcnc("0 0 0\n1 1.001 1.001\n", Options(axis="X", inch=True), 0)
    assert table.positions == (0.0, 25.4)
    assert table.positive.y[1] == pytest.approx(-0.0254)
    assert table.negative is None


def test_csv_tells_its_sign_by_the_name_of_the_column() -> None:
    [added] = read_csv("position,correction\n0,0\n100,0.01\n", Options(axis="X"))
    [wrong] = read_csv("Position;Error_positive;error_negative\n0;0;0,002\n100;-0,01;\n", Options(axis="X"))
    assert added.positive.y == wrong.positive.y == (0.0, 0.01)
    assert wrong.negative is not None
    assert wrong.negative.y == (-0.002, 0.01)


def test_lists_get_the_error_back() -> None:
    assert machine_with([TOO_FAR]).axes[0].leadscrew == Leadscrew(POSITIONS, ERROR)
