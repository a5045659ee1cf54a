"""Which records there are, where they come from, and which of them count."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from diagnosed_lists import write_lists
from hypothesis import given, settings, strategies as st

from axcomp.analysis.diagnosis import Diagnosis, Record, diagnose, volumetric_lists
from axcomp.lists import read_machine
from axcomp.model import LETTERS


def diagnosis_of(folder: Path) -> Diagnosis:
    reading = read_machine(folder)
    (source,), faults = volumetric_lists(reading)
    assert faults == []
    return diagnose(source, reading)


def short(records: tuple[Record, ...]) -> list[tuple[str, tuple[float, ...], float, int, str]]:
    return [(r.parameter, tuple(x for x in r.position if x is not None), r.value, r.line, r.note) for r in records]


def test_records_are_sorted_and_keep_their_lines(tmp_path: Path) -> None:
    csv = "Z EYZ X EXX\n10 4 5 .3\n0 3 5 .2\n0 2 -5 .1\n#\nN0Z X0Z X0X\n-1 7 8\n"
    (file,) = diagnosis_of(write_lists(tmp_path, "file[0] e.csv", e_csv=csv)).files
    assert (file.index, file.path, file.was_read) == (0, tmp_path / "e.csv", True)
    assert short(file.records) == [
        ("X0X", (), 8, 7, ""),
        ("EXX", (-5, 0), 0.1, 4, ""),
        ("EXX", (5, 0), 0.2, 3, ""),
        ("EXX", (5, 10), 0.3, 2, ""),
        ("X0Z", (), 7, 7, ""),
        ("EYZ", (-5, 0), 2, 4, ""),
        ("EYZ", (5, 0), 3, 3, ""),
        ("EYZ", (5, 10), 4, 2, ""),
        ("N0Z", (), -1, 7, ""),
    ]


def test_records_that_do_not_count_say_why(tmp_path: Path) -> None:
    csv = "X EXX\n0 .1\n9 .2\n0 .3\n#\nX0X EXA\n.4 .5\n"
    exc = "[EXX]\nGridpoints = {\n9 .6\n}\n[X0X]\nVALUE = .7\n"
    lists = ["file[0] e.csv", "file[4] e.exc", "file_format[4] ETALON_EXCHANGE"]
    diagnosis = diagnosis_of(write_lists(tmp_path, *lists, e_csv=csv, e_exc=exc))
    assert [file.index for file in diagnosis.files] == [0, 4]
    assert short(diagnosis.files[0].records) == [
        ("X0X", (), 0.4, 7, "replaced by e.exc:6"),
        ("EXX", (0,), 0.1, 2, "replaced by e.csv:4"),
        ("EXX", (0,), 0.3, 4, ""),
        ("EXX", (9,), 0.2, 3, "replaced by e.exc:3"),
        ("EXA", (), 0.5, 7, "not used: A is not in the chain CXYZ"),
    ]
    assert {note for *_, note in short(diagnosis.files[1].records)} == {""}
    assert (diagnosis.counted, diagnosis.spliced) == (4, 0)


def test_records_of_a_polyline_stay_in_its_order(tmp_path: Path) -> None:
    csv = "Y X EXX\n5 9 0.1\n1 0 0.2\n1 0 0.25\n5 9 0.1\n5 9 0.3\n"
    (file,) = diagnosis_of(write_lists(tmp_path, "file[0] e.csv", "interpolation PATH_XY", e_csv=csv)).files
    assert short(file.records) == [
        ("EXX", (9, 5), 0.1, 2, ""),
        ("EXX", (0, 1), 0.2, 3, "replaced by e.csv:4"),
        ("EXX", (0, 1), 0.25, 4, ""),
        ("EXX", (9, 5), 0.1, 5, "replaced by e.csv:6"),
        ("EXX", (9, 5), 0.3, 6, ""),
    ]


def test_spliced_records_count(tmp_path: Path) -> None:
    csv = "C EXC EYC\n0 0 0\n90 1e-3 0\n#\nX0Y PXC\n0.1 3\n"
    diagnosis = diagnosis_of(write_lists(tmp_path, "file[0] e.csv", "enable_splicing 1", e_csv=csv))
    assert (diagnosis.counted, diagnosis.spliced) == (8, 2)


def test_axis_numbers_in_a_parameter_file_beat_the_list(tmp_path: Path) -> None:
    diagnosis = diagnosis_of(write_lists(tmp_path, "file[0] e.csv", e_csv="LNX EXX\n7 0\n"))
    assert diagnosis.axes == {
        "X": (7, "e.csv:2"),
        "Y": (2, "vol_comp0.lis:2"),
        "Z": (3, "vol_comp0.lis:3"),
        "C": (6, "vol_comp0.lis:4"),
    }
    assert dict(read_machine(tmp_path).machine.volumetric[0].axes) == {k: v for k, (v, _) in diagnosis.axes.items()}


def test_files_that_cannot_be_read_have_their_place(tmp_path: Path) -> None:
    write_lists(tmp_path, "file[0] C:\\iso\\gone.csv", "file[1] binary.csv", "file[2] e.csv", e_csv="X0X\n1\n")
    (tmp_path / "binary.csv").write_bytes(bytes(range(256)))
    diagnosis = diagnosis_of(tmp_path)
    assert [(f.path.name, f.was_read, len(f.records)) for f in diagnosis.files] == [
        ("gone.csv", False, 0),
        ("binary.csv", False, 0),
        ("e.csv", True, 1),
    ]
    assert {finding.code for finding in diagnosis.findings} == {"AXC-FOLDER", "AXC-BINARY"}
    assert not diagnosis.in_force


NUMBER = st.sampled_from(["0", "1", "-0.0", "2", "5", "0.25", "360"])
BLOCK = st.lists(st.sampled_from(["X", "Y", "C", "EXX", "EYX", "A0C", "EXA", "N0Z"]), min_size=1, unique=True).flatmap(
    lambda header: st.lists(
        st.lists(NUMBER, min_size=len(header), max_size=len(header)).map(" ".join), min_size=1, max_size=6
    ).map(lambda rows: "\n".join([" ".join(header), *rows]))
)


@settings(max_examples=80)
@given(
    st.lists(BLOCK, min_size=1, max_size=3).map("\n#\n".join),
    st.lists(BLOCK, min_size=1, max_size=2).map("\n#\n".join),
    st.sampled_from(["AUTO", "SCATTER", "PATH_XY"]),
    st.booleans(),
)
def test_records_without_a_note_are_those_of_the_machine(first: str, second: str, mode: str, splicing: bool) -> None:
    entries = ["file[0] a.csv", "file[1] b.csv", f"interpolation {mode}", f"enable_splicing {int(splicing)}"]
    with TemporaryDirectory() as name:
        folder = write_lists(Path(name), *entries, a_csv=first, b_csv=second)
        machine = read_machine(folder).machine
        diagnosis = diagnosis_of(folder)
    assert diagnosis.in_force == bool(machine.volumetric)
    for volumetric in machine.volumetric:
        found: dict[str, list[tuple[tuple[float, ...], float]]] = {}
        for file in diagnosis.files:
            for parameter, position, value, _, note in short(file.records):
                if not note:
                    found.setdefault(parameter, []).append((position, value))
        found.pop("N0Z", None)
        assert set(found) == {table.name for table in volumetric.errors}
        spliced = 0
        for table in volumetric.errors:
            expected = list(zip(table.nodes, table.values, strict=True))
            rows = found[table.name] if mode == "PATH_XY" else sorted(found[table.name])
            if len(expected) > len(rows):
                assert expected.pop()[0] == (rows[0][0][0] + 360.0,)
                spliced += 1
            assert rows == expected
        if not any(parameter.startswith("E") and parameter[-1] == "A" for parameter in (first + second).split()):
            assert diagnosis.spliced == spliced


def test_every_letter_has_a_place_in_a_position(tmp_path: Path) -> None:
    header, row = " ".join(LETTERS), " ".join(str(i) for i in range(6))
    (file,) = diagnosis_of(write_lists(tmp_path, "file[0] e.csv", e_csv=f"{header} EXX\n{row} .5\n")).files
    assert file.records[0].position == (0, 1, 2, 3, 4, 5)
