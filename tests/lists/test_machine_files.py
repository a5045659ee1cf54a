"""Which files make up a machine, how they are found, and what the axes then are."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from axcomp.cli import main
from axcomp.lists import Reading, read_machine
from axcomp.model import AxisType, ModuloRange

ReadLists = Callable[..., Reading]

TABLE = "kw.ssfk.unit 1\nkw.ssfk.interval 10000\nkw.ssfk.kw_nr_max 2\nkw.ssfk.table[0].pos 1\nkw.ssfk.table[1].pos 2\n"
CROSS = "kw.crosscomp.table[0].setpoint 0\nkw.crosscomp.table[0].correction 1\nkw.crosscomp.master_ax_nr"


LEADSCREW_ROWS = (
    "kw.ssfk.unit 1\nkw.ssfk.kw_nr_max 2\nkw.ssfk.interval 10\nkw.ssfk.table[0].pos 1\nkw.ssfk.table[1].pos 2\n"
)


def axis(number: int, text: str = "") -> str:
    return f"kopf.achs_nr {number}\n{text}"


def compensation(number: int, text: str = TABLE) -> str:
    return f"kopf.achs_nr {number}\n{text}"


def codes(reading: Reading) -> list[str]:
    return [finding.code for finding in reading.findings]


def numbers(reading: Reading) -> list[int]:
    return [axis.number for axis in reading.machine.axes]


def acting(reading: Reading) -> dict[int, list[str]]:
    return {axis.number: [one.kind for one in axis.compensations] for axis in reading.machine.axes}


@pytest.mark.parametrize("path", ["", "hochlauf.lis"])
def test_a_machine_is_its_start_up_list_or_the_folder_of_it(path: str, read_lists: ReadLists) -> None:
    files = {
        "hochlauf.lis": "zahl_kw 1\nachs_kw[0] kw.lis\nzahl_mds 2\nachs_mds[0] z.lis\nachs_mds[1] x.lis\n",
        "kw.lis": compensation(1),
        "x.lis": axis(1, "kopf.log_achs_name X\nlr_param.ssfk 1\n"),
        "z.lis": axis(3, "kopf.log_achs_name Z\nkenngr.achs_typ ACHSTYP_SPINDEL\n"),
        "achskw9.lis": compensation(9),
    }
    reading = read_lists(files, path)
    assert codes(reading) == []
    assert [(a.number, a.name, a.type) for a in reading.machine.axes] == [
        (3, "Z", AxisType.SPINDLE),
        (1, "X", AxisType.TRANSLATORY),
    ]
    assert acting(reading) == {3: [], 1: ["leadscrew"]}


def test_a_start_up_list_may_have_any_name(read_lists: ReadLists) -> None:
    reading = read_lists({"machine.txt": "zahl_kw 1\nachs_kw[0] kw.lis\n", "kw.lis": compensation(1)}, "machine.txt")
    assert acting(reading) == {1: ["leadscrew"]}


def test_a_compensation_list_can_be_tried_on_its_own(read_lists: ReadLists) -> None:
    reading = read_lists({"any.lis": compensation(4, f"kopf.log_achs_name Y\n{TABLE}{CROSS} 7\n")}, "any.lis")
    assert codes(reading) == []
    assert [(a.number, a.name, a.type) for a in reading.machine.axes] == [
        (4, "Y", AxisType.TRANSLATORY),
        (7, "axis7", AxisType.TRANSLATORY),
    ]
    assert acting(reading) == {4: ["cross", "leadscrew"], 7: []}


def test_a_folder_of_compensation_lists_is_a_machine_in_the_order_of_their_numbers(read_lists: ReadLists) -> None:
    files = {f"achskw{i}.lis": compensation(i) for i in (10, 9, 1)} | {"ACHSKW2.LIS": compensation(2, f"{CROSS} 5\n")}
    reading = read_lists(files)
    assert codes(reading) == []
    assert numbers(reading) == [2, 1, 9, 10, 5] or numbers(reading) == [1, 2, 9, 10, 5]


def test_axis_lists_in_a_folder_decide_what_acts_there(read_lists: ReadLists) -> None:
    files = {"achskw1.lis": compensation(1), "achskw2.lis": compensation(2)}
    files |= {"achsmd1.lis": axis(1, "lr_param.ssfk 1\n"), "achsmd2.lis": axis(2)}
    reading = read_lists(files)
    assert codes(reading) == ["AXC-INACTIVE"]
    assert acting(reading) == {1: ["leadscrew"], 2: []}


def test_the_default_axis_list_holds_for_all_axes_and_their_own_lists_win(read_lists: ReadLists) -> None:
    files = {
        "hochlauf.lis": "default_achs_mds all.lis\nzahl_kw 2\nachs_kw[0] kw1.lis\nachs_kw[1] kw2.lis\n"
        "zahl_mds 1\nachs_mds[0] one.lis\n",
        "all.lis": "kopf.achs_nr 9\nkopf.log_achs_name ALL\nlr_param.ssfk 1\nkenngr.achs_typ 2\nkenngr.achs_mode 4\n"
        "getriebe[0].modulou -1800000\ngetriebe[0].moduloo 1800000\nlr_param.n_backlash_cyc 7\n",
        "one.lis": axis(1, "lr_param.ssfk 0\nlr_param.n_backlash_cyc 3\n"),
        "kw1.lis": compensation(1),
        "kw2.lis": compensation(2),
    }
    reading = read_lists(files)
    assert codes(reading) == ["AXC-INACTIVE"]
    assert acting(reading) == {1: [], 2: ["leadscrew"]}
    assert [a.backlash_cycles for a in reading.machine.axes] == [3, 7]
    assert [a.modulo for a in reading.machine.axes] == [ModuloRange(-180.0, 180.0)] * 2
    assert [a.name for a in reading.machine.axes] == ["axis1", "axis2"]


def test_a_finding_about_a_value_of_the_default_axis_list_names_that_list_and_its_line(read_lists: ReadLists) -> None:
    files = {
        "hochlauf.lis": "default_achs_mds all.lis\nzahl_kw 1\nachs_kw[0] kw1.lis\nzahl_mds 1\nachs_mds[0] one.lis\n",
        "all.lis": "lr_param.ssfk 1\nlr_param.crosscomp 1\nkenngr.achs_typ 2\nkenngr.achs_mode 4\n"
        "getriebe[0].modulou 100\ngetriebe[0].moduloo 100\n",
        "one.lis": axis(1),
        "kw1.lis": compensation(1),
    }
    places = {f.code: (Path(f.file).name, f.line) for f in read_lists(files).findings}
    assert places == {"110052": ("all.lis", 6), "AXC-NO-TABLE": ("all.lis", 2)}


def test_the_number_in_the_start_up_list_serves_where_the_list_has_none(read_lists: ReadLists) -> None:
    reading = read_lists({"hochlauf.lis": "zahl_kw 1\nachs_kw[0] a.lis\nachs_kw_log_ax_nr[0] 6\n", "a.lis": TABLE})
    assert (codes(reading), acting(reading)) == ([], {6: ["leadscrew"]})


def test_lists_without_a_number_get_one_that_no_other_list_has(read_lists: ReadLists) -> None:
    reading = read_lists({"achskw1.lis": TABLE, "achskw2.lis": compensation(1), "achskw3.lis": TABLE})
    assert codes(reading) == ["AXC-NUMBER", "AXC-NUMBER"]
    assert numbers(reading) == [2, 1, 3]


def test_names_are_made_unique(read_lists: ReadLists) -> None:
    names = {1: "axis3", 2: "axis3", 3: "", 4: "axis3_2"}
    files = {f"achskw{i}.lis": compensation(i, f'kopf.log_achs_name "{name}"\n') for i, name in names.items()}
    reading = read_lists(files)
    assert [a.name for a in reading.machine.axes] == ["axis3", "axis3_2", "axis3_3", "axis3_2_4"]
    assert codes(reading) == ["AXC-NAME"] * 3


@pytest.mark.parametrize(
    ("names", "unique"),
    [
        (["X", "X", "X"], ["X", "X_2", "X_3"]),
        (["X", "X_3", "X"], ["X", "X_3", "X_3_"]),
        (["X", "X_4", "X_4_", "X"], ["X", "X_4", "X_4_", "X_4__"]),
    ],
)
def test_axes_of_one_name_get_a_name_that_no_axis_before_has(
    names: list[str], unique: list[str], read_lists: ReadLists
) -> None:
    files = {f"achskw{i}.lis": compensation(i, f"kopf.log_achs_name {name}\n") for i, name in enumerate(names, 1)}
    reading = read_lists(files)
    assert [a.name for a in reading.machine.axes] == unique
    assert set(codes(reading)) == {"AXC-NAME"}


@pytest.mark.parametrize("name", [r"sub\kw.lis", "sub/kw.lis", r".\sub\\kw.lis", r"sub\..\sub\kw.lis"])
def test_both_slashes_separate(name: str, read_lists: ReadLists) -> None:
    reading = read_lists({"hochlauf.lis": f"zahl_kw 1\nachs_kw[0] {name}\n", "sub/kw.lis": compensation(1)})
    assert (codes(reading), acting(reading)) == ([], {1: ["leadscrew"]})


@pytest.mark.parametrize("name", [r"SUB\KW.LIS", r"D:\other\kw.lis", "/home/cnc/KW.lis"])
def test_names_of_another_computer_are_matched_with_a_warning(name: str, read_lists: ReadLists) -> None:
    files = {"cnc/hochlauf.lis": f"zahl_kw 1\nachs_kw[0] {name}\n", "cnc/sub/kw.lis": compensation(1)}
    files["cnc/kw.lis"] = compensation(1)
    reading = read_lists(files, "cnc")
    assert (codes(reading), acting(reading)) == (["AXC-PATH"], {1: ["leadscrew"]})


@pytest.mark.parametrize("name", ["{}/elsewhere/kw.lis", r"..\elsewhere\kw.lis", "../cnc/../elsewhere/kw.lis"])
def test_a_name_that_leads_elsewhere_is_used_where_that_is_allowed(name: str, tmp_path: Path) -> None:
    for file, text in (("elsewhere/kw.lis", compensation(1)), ("cnc/x", "")):
        (tmp_path / file).parent.mkdir()
        (tmp_path / file).write_text(text)
    start = tmp_path / "cnc" / "hochlauf.lis"
    start.write_text(f"zahl_kw 1\nachs_kw[0] {name.format(tmp_path)}\n")
    assert codes(read_machine(start)) == ["AXC-FOLDER"]
    reading = read_machine(start, allow_outside=[tmp_path / "elsewhere"])
    assert codes(reading) == []
    assert acting(reading) == acting(reading.again()) == {1: ["leadscrew"]}


def test_a_list_that_may_not_be_read_is_named(read_lists: ReadLists, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(path: Path, *_: object) -> int:
        raise PermissionError(13, "Permission denied", str(path))

    path = read_lists({"achskw1.lis": compensation(1)}).path
    with monkeypatch.context() as patch:
        patch.setattr(os, "open", refuse)
        [finding] = read_machine(path).findings
    assert (finding.code, finding.file[-11:]) == ("AXC-UNREADABLE", "achskw1.lis")
    assert "Permission denied" in finding.message


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "achskw1.lis")
    assert [f.code for f in read_machine(tmp_path).findings] == ["AXC-UNREADABLE"]


def test_a_file_too_large_for_a_list_is_not_read(tmp_path: Path) -> None:
    with (tmp_path / "achskw1.lis").open("wb") as file:
        file.truncate(10**12)
    assert [f.code for f in read_machine(tmp_path).findings] == ["AXC-UNREADABLE"]


def test_a_folder_without_lists_is_named(tmp_path: Path) -> None:
    [finding] = read_machine(tmp_path).findings
    assert (finding.code, finding.file) == ("AXC-MISSING", str(tmp_path))


def test_of_more_than_32_lists_the_first_are_read(read_lists: ReadLists) -> None:
    reading = read_lists({f"achskw{i}.lis": compensation(i) for i in range(1, 40)})
    assert numbers(reading) == list(range(1, 33))
    assert codes(reading) == ["AXC-AXES"]


def test_axes_beyond_32_are_left_out(read_lists: ReadLists) -> None:
    files = {f"m{i}.lis": axis(i) for i in range(1, 33)} | {"k.lis": compensation(99)}
    files["hochlauf.lis"] = "zahl_mds 32\nzahl_kw 1\nachs_kw[0] k.lis\ndefault_achs_mds m1.lis\n"
    files["hochlauf.lis"] += "".join(f"achs_mds[{i}] m{i + 1}.lis\n" for i in range(32))
    reading = read_lists(files)
    assert (numbers(reading), codes(reading)) == (list(range(1, 33)), ["AXC-AXES"])


def test_the_files_of_a_machine_can_be_listed(read_lists: ReadLists, tmp_path: Path) -> None:
    files = {
        "hochlauf.lis": "zahl_kw 2\nachs_kw[0] kw.lis\nachs_kw[1] no.lis\nzahl_mds 1\nachs_mds[0] md.lis\n"
        "default_achs_mds all.lis\n",
        "kw.lis": compensation(1),
        "md.lis": axis(1),
        "all.lis": "lr_param.ssfk 1\n",
        "other.lis": "",
    }
    read_lists(files)
    assert [path.name for path in read_machine(tmp_path).documents] == ["hochlauf.lis", "all.lis", "md.lis", "kw.lis"]


def test_masters_need_an_axis_list_where_there_are_axis_lists(read_lists: ReadLists) -> None:
    files = {"achskw1.lis": compensation(1, f"{CROSS} 2\n"), "achsmd1.lis": axis(1, "lr_param.crosscomp 1\n")}
    assert acting(read_lists(files)) == {1: []}
    assert acting(read_lists(files | {"achsmd2.lis": axis(2)})) == {1: ["cross"], 2: []}


@pytest.mark.parametrize(
    ("axis", "table", "code"),
    [
        ("lr_param.ssfk 0\n", "kw.ssfk.kw_nr_max 10\nkw.ssfk.interval 10\n", "AXC-INACTIVE"),
        ("lr_param.frict_comp 0\n", "frict_comp.table_entries 3\n", "AXC-INACTIVE"),
        ("kenngr.achs_typ 2\nkenngr.achs_mode 5\ngetriebe[0].moduloo 0.001\n", LEADSCREW_ROWS, "110052"),
        ("kenngr.achs_typ 2\nkenngr.achs_mode 5\ngetriebe[0].moduloo 0.01\n", LEADSCREW_ROWS, "110052"),
    ],
)
def test_what_stands_alone_or_is_too_small_is_told_and_stops_neither_check_nor_build(
    axis: str, table: str, code: str, read_lists: ReadLists, tmp_path: Path
) -> None:
    start = "zahl_mds 1\nachs_mds[0] md.lis\nzahl_kw 1\nachs_kw[0] kw.lis\n"
    files = {"hochlauf.lis": start, "md.lis": f"kopf.achs_nr 1\n{axis}", "kw.lis": f"kopf.achs_nr 1\n{table}"}
    assert code in codes(read_lists(files))
    for words in (["check"], ["build", "--image", str(tmp_path / "t.bin"), "--machine"]):
        errors = sum(finding.severity.value == "error" for finding in read_machine(tmp_path).findings)
        assert main([*words, str(tmp_path)]) == errors
