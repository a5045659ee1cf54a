from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from rigid_bodies import NUMBERS, machine_of, volumetric

from axcomp.kinds import ListKind, Manual
from axcomp.lists import CATALOGUE, ListError, Reading, read_machine, write_machine
from axcomp.model import ERRORS, LETTERS, LINEAR, AxisType, ErrorTable, Interpolation, Volumetric
from axcomp.runtime import Runtime, compile_tables

Files = dict[str, str]

CSV = "X EXX EYX\n0 0.01 0.02\n100 0.03 0.04\n"


def machine_files(**changes: Any) -> Files:
    """Return the lists of a five-axis machine; ``volumetric``, ``start_up``, ``csv``: what to add or put instead."""
    axes = {letter: number for letter, number in NUMBERS.items() if letter != "A"}
    start_up = [f"zahl_mds {len(axes)}", *(f"achs_mds[{i}] achsmd{n}.lis" for i, n in enumerate(axes.values()))]
    start_up += ["vol_comp[0].file_name vol_comp0.lis"]
    start_up += changes.get("start_up", ["vol_comp[0].max_records 1000"])
    lists = [*(f"{letter} {number}" for letter, number in axes.items()), "chain CBYXZ", "workpiece_axes 2"]
    lists += ["file[0] errors.csv", *changes.get("volumetric", [])]
    files = {"hochlauf.lis": "\n".join(start_up), "vol_comp0.lis": "\n".join(lists)}
    files["errors.csv"] = changes.get("csv", CSV)
    for letter, number in axes.items():
        limit = "lr_param.vol_comp.s_limit 10000\n" if letter in changes.get("limited", LINEAR) else ""
        limit += "lr_param.vol_comp.v_limit 2500\n" if letter in changes.get("slowed", LINEAR) else ""
        axis_type = 1 if letter in LINEAR else 2
        files[f"achsmd{number}.lis"] = (
            f"kopf.achs_nr {number}\nkopf.log_achs_name {letter}\nkenngr.achs_typ {axis_type}\n{limit}"
        )
    return files | changes.get("files", {})


@pytest.fixture
def read(tmp_path: Path) -> Callable[..., Reading]:
    def read_files(**changes: Any) -> Reading:
        for name, text in machine_files(**changes).items():
            (tmp_path / name).write_text(text, encoding="utf-8")
        return read_machine(tmp_path)

    return read_files


def found(reading: Reading) -> list[tuple[str, str, int]]:
    return [(finding.code, Path(finding.file).name, finding.line) for finding in reading.findings]


def test_a_machine_with_its_parameter_file_is_read(read: Callable[..., Reading], tmp_path: Path) -> None:
    reading = read()
    machine, findings = reading.machine, reading.findings
    assert findings == ()
    (one,) = machine.volumetric
    assert one.axes == (("X", 1), ("Y", 2), ("Z", 3), ("B", 5), ("C", 6))
    assert (one.index, one.chain, one.workpiece_axes, one.filter_steps, one.max_records) == (0, "CBYXZ", 2, 20, 1000)
    assert [axis.volumetric_limit for axis in machine.axes] == [1.0, 1.0, 1.0, None, None]
    assert one.errors == (
        ErrorTable("EXX", (0.01, 0.03), "X", ((0.0,), (100.0,))),
        ErrorTable("EYX", (0.02, 0.04), "X", ((0.0,), (100.0,))),
    )
    assert {path.name for path in read_machine(tmp_path).documents} >= {"vol_comp0.lis", "errors.csv"}


def test_every_entry_of_the_list_has_its_place(read: Callable[..., Reading]) -> None:
    lines = ["negate ZX", 'set_to_zero "Y"', "alternative_model 1", "manual_activation TRUE", "filter_steps 7"]
    lines += ["associate_to_channel 1", "diagnosis_file d.xlsx", "file_format[0] isg_csv", "interpolation auto"]
    reading = read(volumetric=lines)
    machine, findings = reading.machine, reading.findings
    assert findings == ()
    one = machine.volumetric[0]
    assert (one.negate, one.set_to_zero, one.alternative_model, one.manual_activation) == ("XZ", "Y", True, True)
    assert (one.filter_steps, one.associate_to_channel, one.diagnosis_file) == (7, True, "d.xlsx")
    assert one.files[0] == "errors.csv"


def test_the_catalogue_numbers_the_parameters_in_the_order_of_the_manual() -> None:
    rows = CATALOGUE[ListKind.VOLUMETRIC]
    assert [row.ids[Manual.VOLUMETRIC] for row in rows] == [f"P-VOLC-{i:05}" for i in range(1, 21)]
    ids = {row.name: row.ids[Manual.VOLUMETRIC] for row in rows}
    assert (ids["file[j]"], ids["manual_activation"], ids["filter_steps"]) == (
        "P-VOLC-00012",
        "P-VOLC-00017",
        "P-VOLC-00018",
    )


def test_describing_parameters_and_numbers_of_axes_come_from_the_files(read: Callable[..., Reading]) -> None:
    csv = "P0Z N0X N0Y N0Z PXC PZC IDZ IDC LNX LNY\n50 0 0.6 -0.8 1 2 -550 0.5 2 1\n#\nVXB VYB VZB\n0 0.6 0.8\n"
    reading = read(csv=csv)
    machine, findings = reading.machine, reading.findings
    assert findings == ()
    one = machine.volumetric[0]
    assert one.axes[:2] == (("X", 2), ("Y", 1))
    assert (one.tool_position, one.tool_orientation) == ((0, 0, 50), (0, 0.6, -0.8))
    assert (one.centers[2], one.offsets) == ((1, 0, 2), (0, 0, -550, 0, 0, 0.5))
    assert one.directions[4] == (0, 0.6, 0.8)


def test_parameter_files_may_be_utf_16_with_decimal_commas(read: Callable[..., Reading], tmp_path: Path) -> None:
    read(csv="X EXX\n0 1\n")
    (tmp_path / "errors.csv").write_bytes("X;EXX // µm\r\n0;0,5\r\n100;-0,25\r\n".encode("utf-16"))
    reading = read_machine(tmp_path)
    assert reading.findings == ()
    assert reading.machine.volumetric[0].errors == (ErrorTable("EXX", (0.5, -0.25), "X", ((0.0,), (100.0,))),)


def test_etalon_and_csv_files_add_up(read: Callable[..., Reading]) -> None:
    lines = ["file[3] rotary.exc", "file_format[3] ETALON_EXCHANGE", "enable_splicing 1"]
    exc = "[HEADER]\nDate = -\n[EXC]\nGridpoints = {\n0 0.01\n90 0.02\n}\n[A0C]\nVALUE = 1e-5\n"
    reading = read(volumetric=lines, files={"rotary.exc": exc})
    machine, findings = reading.machine, reading.findings
    assert findings == ()
    tables = {table.name: table for table in machine.volumetric[0].errors}
    assert list(tables) == ["EXX", "EYX", "A0C", "EXC"]
    assert tables["EXC"].nodes == ((0.0,), (90.0,), (360.0,))
    assert tables["EXC"].values == (0.01, 0.02, 0.01)
    assert tables["A0C"] == ErrorTable("A0C", (1e-5,))


def test_splicing_closes_the_turn_so_that_nothing_jumps(read: Callable[..., Reading]) -> None:
    csv = "C EXC EAC\n" + "".join(f"{q} {0.01 * np.cos(np.radians(q))} 1e-5\n" for q in range(0, 360, 10))
    for splicing, step in ((0, 1e-5), (1, 1e-6)):
        reading = read(csv=csv, volumetric=[f"enable_splicing {splicing}"])
        machine, findings = reading.machine, reading.findings
        assert findings == ()
        runtime = Runtime(machine)
        values = []
        for q in (359.99, 0.01):
            runtime.inputs.axis[4].setpoint = q
            runtime.cycle()
            values.append(runtime.outputs.axis[0].volumetric_correction)
        assert (abs(values[1] - values[0]) < step) == bool(splicing)


def test_splicing_leaves_other_tables_alone(read: Callable[..., Reading]) -> None:
    blocks = ["C EXC\n10 1e-5\n350 2e-5", "C X EYC\n0 0 1e-5\n0 9 1e-5\n90 0 0\n90 9 0", "C EZC\n0 1\n360 2"]
    csv = "\n#\n".join([*blocks, "X EXX\n0 1\n9 2\n"])
    reading = read(csv=csv, volumetric=["enable_splicing 1"])
    machine = reading.machine
    sizes = {table.name: len(table.values) for table in machine.volumetric[0].errors}
    assert sizes == {"EXC": 3, "EYC": 4, "EZC": 2, "EXX": 2}


def test_blocks_with_the_same_arguments_make_one_table(read: Callable[..., Reading]) -> None:
    csv = "Z X EXX\n0 0 0.1\n0 9 0.2\n#\nX Z EXX\n0 5 0.3\n9 5 0.4\n"
    reading = read(csv=csv)
    machine, findings = reading.machine, reading.findings
    assert findings == ()
    (table,) = machine.volumetric[0].errors
    assert (table.arguments, table.interpolation) == ("XZ", Interpolation.GRID)
    assert table.nodes == ((0, 0), (0, 5), (9, 0), (9, 5))
    assert table.values == (0.1, 0.3, 0.2, 0.4)


def test_of_two_records_the_later_one_counts(read: Callable[..., Reading]) -> None:
    reading = read(csv="X EXX\n0 0.1\n9 0.2\n0 0.3\n#\nX EXX\n9 0.4\n#\nC0Y\n1e-3\n2e-3\n")
    machine, findings = reading.machine, reading.findings
    assert [finding.code for finding in findings] == ["AXC-TWICE"] * 3
    assert [finding.line for finding in findings] == [2, 6, 10]
    assert {table.name: table.values for table in machine.volumetric[0].errors} == {"C0Y": (2e-3,), "EXX": (0.3, 0.4)}


SCATTERED = "X Y EXX\n0 0 0.1\n9 1 0.2\n4 7 0.3\n"
GRIDDED = "X Y EXX\n0 0 0.1\n9 0 0.2\n0 7 0.3\n9 7 0.4\n"


@pytest.mark.parametrize(
    ("mode", "csv", "interpolation", "codes"),
    [
        ("GRID", GRIDDED, Interpolation.GRID, []),
        ("GRID", SCATTERED, None, ["70471"]),
        ("SCATTER", SCATTERED, Interpolation.SCATTER, []),
        ("SCATTER", GRIDDED, Interpolation.SCATTER, ["70474"]),
        ("AUTO", GRIDDED, Interpolation.GRID, []),
        ("AUTO", SCATTERED, Interpolation.SCATTER, []),
        ("PATH", SCATTERED, Interpolation.PATH, []),
        ("PATH_XY", GRIDDED, Interpolation.PATH_XY, []),
        ("PATH_XY", SCATTERED.replace("Y", "Z", 1), None, ["AXC-POLYLINE"]),
        ("PATH", SCATTERED.replace("Y", "C", 1), None, ["AXC-POLYLINE"]),
        ("LINEAR", GRIDDED, Interpolation.GRID, ["AXC-RANGE"]),
    ],
)
def test_records_are_interpolated_as_the_list_says_if_they_can_be(
    read: Callable[..., Reading], mode: str, csv: str, interpolation: Interpolation | None, codes: list[str]
) -> None:
    reading = read(csv=csv, volumetric=[f"interpolation {mode}"])
    machine, findings = reading.machine, reading.findings
    assert [finding.code for finding in findings] == codes
    assert [v.errors[0].interpolation for v in machine.volumetric] == ([interpolation] if interpolation else [])


def test_a_path_keeps_the_order_of_its_corners(read: Callable[..., Reading]) -> None:
    csv = "Y X EXX\n5 9 0.1\n1 0 0.2\n1 0 0.25\n5 9 0.1\n"
    reading = read(csv=csv, volumetric=["interpolation PATH_XY"])
    machine, findings = reading.machine, reading.findings
    assert [finding.code for finding in findings] == ["AXC-TWICE"]
    assert machine.volumetric[0].errors[0].nodes == ((9, 5), (0, 1), (9, 5))
    assert machine.volumetric[0].errors[0].values == (0.1, 0.25, 0.1)


OFF = [
    ({"csv": "X EXX EXQ\n0 1 1\n"}, ("70468", "errors.csv", 1)),
    ({"csv": "X EXX EXX\n0 1 1\n"}, ("70469", "errors.csv", 1)),
    ({"csv": SCATTERED}, ("70471", "errors.csv", 1)),
    ({"csv": "X EXX\n0 0.1\n1\n"}, ("AXC-RECORD", "errors.csv", 3)),
    ({"csv": "X EAX\n0 30\n"}, ("AXC-MAGNITUDE", "errors.csv", 2)),
    ({"csv": "X EXX\n0 1\n#\nY EXX\n0 1\n"}, ("AXC-ARGUMENTS", "errors.csv", 4)),
    ({"csv": "X N0Z\n0 1\n9 1\n"}, ("AXC-CONSTANT", "errors.csv", 1)),
    ({"csv": "A EXX\n0 1\n9 1\n"}, ("AXC-ASSIGNMENT", "vol_comp0.lis", 6)),
    ({"csv": CSV + "#\nLNX\n77\n"}, ("AXC-ASSIGNMENT", "errors.csv", 6)),
    ({"csv": CSV + "#\nLNX\n1.5\n"}, ("AXC-ASSIGNMENT", "errors.csv", 6)),
    ({"csv": CSV + "#\nLNX\n2\n"}, ("AXC-ASSIGNMENT", "vol_comp0.lis", 2)),
    ({"csv": "VXX VYX VZX\n0 1 0\n"}, ("AXC-SINGULAR", "errors.csv", 2)),
    ({"volumetric": ["x 77"]}, ("AXC-ASSIGNMENT", "vol_comp0.lis", 9)),
    ({"volumetric": ["x 6", "c 0", "chain XYZ"]}, ("AXC-ASSIGNMENT", "vol_comp0.lis", 9)),
    ({"volumetric": ["chain CBYXZA"]}, ("AXC-ASSIGNMENT", "vol_comp0.lis", 9)),
    ({"volumetric": ["chain CBYX"]}, ("AXC-CHAIN", "vol_comp0.lis", 9)),
    ({"volumetric": ["chain XYZZ"]}, ("AXC-CHAIN", "vol_comp0.lis", 9)),
    ({"volumetric": ["chain XYZW"]}, ("AXC-CHAIN", "vol_comp0.lis", 9)),
    ({"volumetric": ["workpiece_axes 6"]}, ("AXC-CHAIN", "vol_comp0.lis", 9)),
    ({"volumetric": ["file[1] missing.csv"]}, ("AXC-MISSING", "vol_comp0.lis", 9)),
    ({"volumetric": ["file[10] errors.csv"]}, ("70507", "vol_comp0.lis", 9)),
    ({"volumetric": ["file_format[0] ETALON_EXCHANGE"], "csv": "[EXX]\nVALUE = 1 2\n"},
     ("AXC-RECORD", "errors.csv", 2)),
    ({"start_up": ["vol_comp[0].max_records 3"]}, ("AXC-MAX-RECORDS", "hochlauf.lis", 8)),
    ({"start_up": []}, ("AXC-MAX-RECORDS", "hochlauf.lis", 7)),
]  # fmt: skip


@pytest.mark.parametrize(("changes", "expected"), OFF)
def test_an_error_keeps_this_compensation_off_and_the_rest_of_the_machine_works(
    read: Callable[..., Reading], tmp_path: Path, changes: dict[str, Any], expected: tuple[str, str, int]
) -> None:
    start_up = changes.get("start_up", ["vol_comp[0].max_records 1000"])
    start_up = [*start_up, "vol_comp[2].max_records 9", "vol_comp[2].file_name vol_comp2.lis"]
    start_up += ["zahl_kw 1", "achs_kw[0] kw"]
    good = "x 1\ny 2\nz 3\nfile[0] good.csv"
    cross = "kopf.achs_nr 1\nkw.ssfk.kw_nr_max 1\nkw.ssfk.table[0].pos 100\nkw.ssfk.table[0].setpoint 0\n"
    active = machine_files()["achsmd1.lis"] + "lr_param.ssfk 1\n"
    files = {"vol_comp2.lis": good, "good.csv": "X0X\n0.01\n", "kw": cross, "achsmd1.lis": active}
    reading = read(**changes | {"start_up": start_up, "files": files | changes.get("files", {})})
    assert expected in found(reading)
    assert [one.index for one in reading.machine.volumetric] == [2]
    runtime = Runtime(reading.machine)
    runtime.cycle()
    assert runtime.outputs.axis[0].corrected_setpoint == pytest.approx(-0.01 - 0.01)
    assert runtime.outputs.axis[0].error == 0
    with pytest.raises(ListError):
        read_machine(tmp_path, strict=True)


def test_a_missing_parameter_file_is_said_once_not_as_missing_parameters_too(read: Callable[..., Reading]) -> None:
    lists = machine_files()["vol_comp0.lis"].replace("errors.csv", "missing.csv")
    reading = read(files={"vol_comp0.lis": lists})
    assert found(reading) == [("AXC-MISSING", "vol_comp0.lis", 8)]
    assert reading.machine.volumetric == ()


def test_of_two_compensations_that_name_the_same_bad_list_neither_acts(read: Callable[..., Reading]) -> None:
    start_up = [f"vol_comp[{i}].max_records 1000" for i in (0, 1)] + ["vol_comp[1].file_name vol_comp0.lis"]
    reading = read(start_up=start_up, csv="X EAX\n0 30\n")
    assert found(reading) == [("AXC-MAGNITUDE", "errors.csv", 2)] * 2
    assert reading.machine.volumetric == ()


def test_a_file_too_many_is_said_to_keep_the_compensation_off(read: Callable[..., Reading]) -> None:
    (finding,) = read(volumetric=["file[10] errors.csv"]).findings
    assert finding.message == "file[10]: the index goes to 9 only; the compensation stays off."


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"volumetric": ["use_axis_offsets 1"]}, ("AXC-NOT-MODELLED", "vol_comp0.lis", 9)),
        ({"volumetric": ["negate XA"]}, ("AXC-RANGE", "vol_comp0.lis", 9)),
        ({"csv": CSV + "#\nEXA\n1e-3\n"}, ("AXC-UNUSED", "errors.csv", 5)),
        ({"csv": CSV + "#\nN0X N0Y N0Z\n0 0 -2\n"}, ("AXC-VECTOR", "errors.csv", 6)),
        ({"csv": CSV + "#\nN0X N0Y N0Z\n0 0 0\n"}, ("AXC-VECTOR", "errors.csv", 6)),
        ({"csv": CSV + "#\nX0C A0C\n10.1 0.1\n"}, ("AXC-LARGE", "errors.csv", 6)),
        ({"csv": CSV + "#\nX0C A0C\n10 -0.101\n"}, ("AXC-LARGE", "errors.csv", 6)),
        ({"volumetric": ["enable_splicing 1"]}, ("AXC-SPLICING", "vol_comp0.lis", 9)),
        ({"csv": "C EXC\n-180 0.001\n0 0.002\n180 0.0015\n"}, ("AXC-OPEN", "errors.csv", 1)),
        ({"limited": "XZ"}, ("AXC-LIMIT", "vol_comp0.lis", 2)),
        ({"slowed": "Y"}, ("AXC-V-LIMIT", "vol_comp0.lis", 0)),
        ({"start_up": ["vol_comp[0].max_records 1000", "vol_comp[5].max_records 5"]}, ("70506", "hochlauf.lis", 9)),
    ],
)
def test_less_grave_findings_leave_the_compensation_in_place(
    read: Callable[..., Reading], changes: dict[str, Any], expected: tuple[str, str, int]
) -> None:
    reading = read(**changes)
    assert found(reading) == [expected]
    assert len(reading.machine.volumetric) == 1


MODULO_C = machine_files()["achsmd6.lis"] + "kenngr.achs_mode 0x4\n"
GAP = "C EXC EAC EYC\n10 0.001 0 0\n180 0 5e-6 0\n350 -0.002 1e-5 0\n"


def test_a_gap_on_an_axis_that_counts_modulo_is_told_with_the_size_of_the_jump(read: Callable[..., Reading]) -> None:
    (finding,) = read(csv=GAP, files={"achsmd6.lis": MODULO_C}).findings
    assert finding.message == (
        "The records over C do not close: at 0° the correction jumps, EXC by 3 µm, EAC by 10 µrad."
    )
    assert read(csv=GAP).findings == ()  # an axis with ends never gets into the gap
    assert read(csv=GAP, files={"achsmd6.lis": MODULO_C}, volumetric=["enable_splicing 1"]).findings == ()


def test_splicing_repeats_the_first_record_wherever_it_is(read: Callable[..., Reading]) -> None:
    reading = read(csv=GAP, files={"achsmd6.lis": MODULO_C}, volumetric=["enable_splicing 1"])
    table = reading.machine.volumetric[0].errors[0]
    assert (table.nodes[-1], table.values[-1]) == ((370.0,), 0.001)


def test_a_gap_over_two_axes_is_told_too(read: Callable[..., Reading]) -> None:
    csv = "X C EXC\n0 0 0.001\n0 270 0.002\n100 0 0\n100 270 0.004\n"
    (finding,) = read(csv=csv, files={"achsmd6.lis": MODULO_C}).findings
    assert finding.message.endswith("at -45° the correction jumps, EXC by 4 µm.")


def test_a_tool_orientation_is_scaled_and_one_of_length_zero_left_out(read: Callable[..., Reading]) -> None:
    for written, taken in (("0 3 -4", (0, 0.6, -0.8)), ("0 0 0", (0, 0, 0)), ("0 0.6 -0.8", (0, 0.6, -0.8))):
        reading = read(csv=f"N0X N0Y N0Z\n{written}\n")
        machine = reading.machine
        assert machine.volumetric[0].tool_orientation == pytest.approx(taken, abs=1e-15)


def test_a_missing_limit_is_an_error_when_the_compensation_is_switched_on(read: Callable[..., Reading]) -> None:
    reading = read(limited="XZ")
    machine, findings = reading.machine, reading.findings
    assert "s_limit" in findings[0].message
    runtime = Runtime(machine)
    runtime.cycle()
    assert [axis.error for axis in runtime.outputs.axis] == [0, 911, 0, 0, 0]


def test_records_are_counted_by_parameter_and_position_with_spliced_ones(read: Callable[..., Reading]) -> None:
    csv = "C EXC EYC\n0 0 0\n90 1e-3 0\n#\nX0Y PXC\n0.1 3\n"
    for bound, splicing, fits in ((6, 0, True), (5, 0, False), (8, 1, True), (7, 1, False)):
        start_up = [f"vol_comp[0].max_records {bound}"]
        reading = read(csv=csv, start_up=start_up, volumetric=[f"enable_splicing {splicing}"])
        machine, findings = reading.machine, reading.findings
        assert bool(machine.volumetric) == fits
        assert [finding.code for finding in findings] == ([] if fits else ["AXC-MAX-RECORDS"])


def test_without_axis_lists_a_volumetric_list_can_be_tried_on_its_own(tmp_path: Path) -> None:
    (tmp_path / "hochlauf.lis").write_text("vol_comp[0].file_name v.lis\nvol_comp[0].max_records 9\n")
    (tmp_path / "v.lis").write_text("x 1\ny 2\nz 3\nc 7\nchain CXYZ\nfile[0] e.csv\n")
    (tmp_path / "e.csv").write_text("X0X X0C\n0.01 0.02\n")
    reading = read_machine(tmp_path)
    machine, findings = reading.machine, reading.findings
    assert findings == ()
    assert [(axis.number, axis.type) for axis in machine.axes] == [
        *((number, AxisType.TRANSLATORY) for number in (1, 2, 3)),
        (7, AxisType.ROTARY),
    ]
    runtime = Runtime(machine)
    runtime.cycle()
    assert runtime.outputs.axis[0].corrected_setpoint == pytest.approx(-0.03)
    write_machine(machine, tmp_path / "written")
    assert read_machine(tmp_path / "written").machine == machine


def test_gantry_slaves_are_read(read: Callable[..., Reading]) -> None:
    text = machine_files()["achsmd2.lis"].replace("name Y", "name Y2").replace("achs_nr 2", "achs_nr 9")
    files = {"achsmd9.lis": text + "kenngr.gantry_ax_nr 2\n"}
    files["hochlauf.lis"] = machine_files()["hochlauf.lis"] + "\nzahl_mds 6\nachs_mds[5] achsmd9.lis\n"
    reading = read(files=files)
    machine, findings = reading.machine, reading.findings
    assert [finding.code for finding in findings] == ["AXC-TWICE"]
    assert machine.axis("Y2").gantry_master == 2
    table = compile_tables(machine).tables.volumetric[0]
    members = sorted(zip(table.member[: table.members], table.member_letter, strict=False))
    assert members == [(0, 0), (1, 1), (2, 2), (3, 4), (4, 5), (5, 1)]


@pytest.mark.parametrize(
    ("limits", "expected", "sentence"),
    [
        ("s_limit 10000", ("AXC-V-LIMIT", "vol_comp0.lis", 0), "No lr_param.vol_comp.v_limit for axis 9"),
        ("v_limit 500", ("AXC-LIMIT", "vol_comp0.lis", 2), "Axis 9 has no lr_param.vol_comp.s_limit"),
    ],
)
def test_the_limits_of_a_gantry_slave_are_looked_at_as_its_masters(
    read: Callable[..., Reading], limits: str, expected: tuple[str, str, int], sentence: str
) -> None:
    slave = f"kopf.achs_nr 9\nkopf.log_achs_name Y2\nkenngr.gantry_ax_nr 2\nlr_param.vol_comp.{limits}\n"
    hochlauf = machine_files()["hochlauf.lis"].replace("zahl_mds 5", "zahl_mds 6\nachs_mds[5] achsmd9.lis")
    reading = read(files={"achsmd9.lis": slave, "hochlauf.lis": hochlauf})
    assert found(reading) == [expected]
    assert sentence in reading.findings[0].message


def unit_vectors() -> st.SearchStrategy[tuple[float, ...]]:
    vectors = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1)
    return vectors.map(lambda v: tuple((np.array(v) / np.linalg.norm(v)).tolist()))


@st.composite
def tables(draw: st.DrawFn, name: str, mode: str, letters: str) -> ErrorTable:
    value = st.floats(-0.9, 0.9)
    allowed = letters if mode in ("GRID", "SCATTER", "AUTO") else "XYZ"[: 3 if mode == "PATH" else 2]
    picked = draw(st.sets(st.sampled_from(allowed), max_size=3))
    arguments = "".join(letter for letter in LETTERS if letter in picked)
    if not arguments:
        return ErrorTable(name, (draw(value),))
    positions = st.floats(-1000, 1000)
    interpolation = Interpolation.GRID
    if mode == "GRID" or (mode == "AUTO" and draw(st.booleans())):
        axes = [sorted(draw(st.sets(positions, min_size=1, max_size=3))) for _ in arguments]
        nodes = tuple(map(tuple, np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, len(axes)).tolist()))
    else:
        point = st.tuples(*[positions] * len(arguments))
        nodes = tuple(draw(st.lists(point, min_size=2, max_size=5, unique=True)))
        interpolation = Interpolation.SCATTER if mode == "AUTO" else Interpolation(mode)
        nodes = tuple(sorted(nodes)) if interpolation is Interpolation.SCATTER else nodes
        if mode == "AUTO" and (len(arguments) == 1 or len({n[0] for n in nodes}) * len({n[1] for n in nodes}) == 1):
            return ErrorTable(name, (draw(value),))
    values = tuple(draw(value) for _ in nodes)
    return ErrorTable(name, values, arguments, nodes, interpolation)


@st.composite
def volumetrics(draw: st.DrawFn, index: int) -> Volumetric:
    rotary = sorted(draw(st.sets(st.sampled_from("ABC"))))
    chain = "".join(draw(st.permutations([*LINEAR, *rotary])))
    mode = draw(st.sampled_from(["GRID", "SCATTER", "AUTO", "PATH", "PATH_XY"]))
    names = draw(st.sets(st.sampled_from([name for name in ERRORS if name[-1] in chain]), min_size=1, max_size=5))
    vector = st.tuples(*[st.floats(-1e3, 1e3)] * 3)
    linear = "".join(letter for letter in chain if letter in LINEAR)
    return volumetric(
        chain,
        index=index,
        errors=tuple(draw(tables(name, mode, LINEAR + "".join(rotary))) for name in ERRORS if name in names),
        workpiece_axes=draw(st.integers(0, len(chain))),
        tool_position=draw(vector),
        tool_orientation=draw(unit_vectors() | st.just((0.0, 0.0, 0.0))),
        centers=tuple(draw(vector) for _ in "ABC"),
        directions=(*volumetric(chain).directions[:3], *(draw(unit_vectors()) for _ in "ABC")),
        offsets=(*draw(vector), *draw(st.tuples(*[st.floats(-6, 6)] * 3))),
        alternative_model=draw(st.booleans()),
        negate=draw(st.sampled_from(["", "X", linear and "XYZ", "YZ"])),
        set_to_zero=draw(st.sampled_from(["", "Y", "XZ"])),
        manual_activation=draw(st.booleans()),
        filter_steps=draw(st.integers(0, 1000)),
        associate_to_channel=draw(st.booleans()),
        diagnosis_file=draw(st.sampled_from(["", "records.xlsx", "my records (1).xlsx"])),
    )


@settings(max_examples=60)
@given(st.sets(st.integers(0, 4), min_size=1, max_size=2).flatmap(lambda s: st.tuples(*map(volumetrics, sorted(s)))))
def test_written_lists_read_back_to_the_same_machine(compensations: tuple[Volumetric, ...]) -> None:
    machine = machine_of(*compensations, limit=2.5)
    compile_tables(machine)
    with TemporaryDirectory() as folder:
        write_machine(machine, folder)
        read = read_machine(folder)
    assert read.machine == machine
    assert [one.diagnosis_file for one in read.machine.volumetric] == [one.diagnosis_file for one in compensations]
    codes = {finding.code for finding in read.findings}
    # Large errors, and tables over a full turn that do not close.
    assert codes <= {"70474", "AXC-LARGE", "AXC-OPEN"}


def test_a_list_that_cannot_be_read_back_is_not_written(tmp_path: Path) -> None:
    table = ErrorTable("EXX", (0.1, 0.2), "X", ((0.0,), (1.0,)))
    path = replace(table, name="EYX", interpolation=Interpolation.PATH)
    with pytest.raises(ValueError, match="one mode"):
        write_machine(machine_of(volumetric("XYZ", errors=(table, path))), tmp_path)
    with pytest.raises(ValueError, match="max_records"):
        write_machine(machine_of(volumetric("XYZ", errors=(table,), max_records=1)), tmp_path)
    assert not list(tmp_path.iterdir())


WORDS = ["0", "1", "2", "3", "5", "-1", "77", "1.5", "XYZ", "CBYXZ", "XYZXYZ", "GRID", "AUTO", "errors.csv", "no.csv"]


@settings(max_examples=150)
@given(
    st.lists(
        st.tuples(st.sampled_from(CATALOGUE[ListKind.VOLUMETRIC]), st.integers(0, 11), st.sampled_from(WORDS)).map(
            lambda entry: f"{entry[0].named(entry[1])} {entry[2]}"
        ),
        max_size=6,
    ),
    st.lists(
        st.lists(
            st.sampled_from(["X", "C", "B", "EXX", "EBY", "A0Z", "N0Z", "VXX", "VZY", "LNX", "IDC", "PXC"]),
            min_size=1,
            max_size=4,
        ).flatmap(
            lambda header: st.lists(
                st.lists(
                    st.sampled_from(["0", "1", "360", "0.5", "-1", "1e-320", "1e-160", "2", "5e5"]),
                    min_size=len(header),
                    max_size=len(header),
                ),
                max_size=4,
            ).map(lambda rows: "\n".join(map(" ".join, [header, *rows])))
        ),
        max_size=3,
    ),
)
def test_whatever_the_lists_say_the_machine_that_is_read_runs(lines: list[str], blocks: list[str]) -> None:
    with TemporaryDirectory() as folder:
        for name, text in machine_files(volumetric=lines, csv="\n#\n".join(blocks)).items():
            Path(folder, name).write_text(text, encoding="utf-8")
        reading = read_machine(folder)
        machine, findings = reading.machine, reading.findings
    assert all(finding.message.endswith(".") for finding in findings)
    runtime = Runtime(machine)
    for position in (0.0, 1.0, -1e14, 359.9):
        for axis in runtime.inputs.axis:
            axis.setpoint = position
        runtime.cycle()
        assert all(np.isfinite(axis.corrected_setpoint) for axis in runtime.outputs.axis)
