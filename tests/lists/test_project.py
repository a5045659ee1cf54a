"""TwinCAT project files: lists as CDATA in the elements of axes, read and written back.

The names of elements are those that tools around TwinCAT read and write: ``AchsMds`` for the list of an axis,
``SdaMds``, ``NullpD``, ``WerkzD``, ``PzvD`` and ``VeD`` for those of a channel; the lists there end with ``Ende``.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from axcomp.cli import main
from axcomp.fmu import packed_lists
from axcomp.lists import Project, read_machine

AXIS = "kopf.achs_nr                 {n}   # größer\nkenngr.achs_typ 1\nlr_param.ssfk 1\nEnde\n"
TABLE = """\
# Tabelle für Achse {n}
kw.ssfk.unit 1
kw.ssfk.interval 100000
kw.ssfk.kw_nr_max 3
kw.ssfk.table[0].pos 1
kw.ssfk.table[1].pos {value}
kw.ssfk.table[2].pos 3
Ende
"""
CHANNEL = "kopf.x 1\ntrafo[0].id 9\nEnde\n"


def project(*axes: str, encoding: str = "utf-8", newline: str = "\r\n") -> bytes:
    text = f"""<?xml version="1.0" encoding="{encoding}"?>
<TcSmProject TcSmVersion="1.0"><!-- <![CDATA[ no list ]]> -->
\t<Project>
\t\t<Cnc>
\t\t\t<Channel Id="1"><Name>Kanal_1</Name><SdaMds><![CDATA[{CHANNEL}]]></SdaMds>
\t\t\t\t<NullpD><![CDATA[]]></NullpD></Channel>
{"".join(axes)}\t\t</Cnc>
\t\t<Plc><ST><![CDATA[x : INT;
kw.count := 3;]]></ST></Plc>
\t</Project>
</TcSmProject>
"""
    return text.replace("\n", newline).encode(encoding)


def axis(number: int, value: str = "2", list_of_axis: str = AXIS) -> str:
    table = TABLE.format(n=number, value=value)
    return (
        f'\t\t\t<Axis Id="{number}">\n\t\t\t\t<Name>Ächse_{number}</Name>\n'
        f"\t\t\t\t<AchsMds><![CDATA[{list_of_axis.format(n=number)}]]></AchsMds>\n"
        f"\t\t\t\t<Korrektur><![CDATA[{table}]]></Korrektur>\n\t\t\t</Axis>\n"
    )


def written(folder: Path, data: bytes, name: str = "machine.tsproj") -> Path:
    path = folder / name
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "iso-8859-1", "windows-1252"])
def test_a_machine_is_read_whatever_the_encoding(encoding: str, tmp_path: Path) -> None:
    path = written(tmp_path, project(axis(1), axis(3), encoding=encoding))
    reading = read_machine(path)
    assert [finding.code for finding in reading.findings] == []
    assert [(one.number, list(one.kinds)) for one in reading.machine.axes] == [(1, ["leadscrew"]), (3, ["leadscrew"])]


def test_a_list_belongs_to_the_axis_in_whose_element_it_stands(tmp_path: Path) -> None:
    without = AXIS.replace("kopf.achs_nr                 {n}   # größer\n", "")
    reading = read_machine(written(tmp_path, project(axis(4, "7", without), axis(2, "9", without))))
    values = {one.number: one.leadscrew and one.leadscrew.positive[1] for one in reading.machine.axes}
    assert values == {4: pytest.approx(7e-4), 2: pytest.approx(9e-4)}


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_findings_point_into_the_xml(encoding: str, tmp_path: Path) -> None:
    path = written(tmp_path, project(axis(1), axis(3, "x"), encoding=encoding))
    [finding] = read_machine(path).findings
    assert (finding.code, finding.file) == ("AXC-ZEROED", str(path))
    line = path.read_bytes().decode(encoding).replace("\r\n", "\n").split("\n")[finding.line - 1]
    assert line[finding.column - 1 :].startswith("kw.ssfk.table[1].pos x")


def test_the_first_line_of_a_list_begins_behind_its_tag(tmp_path: Path) -> None:
    wrong = "kenngr.achs_typ 7\nkopf.achs_nr {n}\n"
    path = written(tmp_path, project(axis(1, list_of_axis=wrong)))
    finding = next(one for one in read_machine(path).findings if one.code == "AXC-RANGE")
    line = path.read_text().split("\n")[finding.line - 1]
    assert line[finding.column - 1 :].startswith("kenngr.achs_typ 7")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "iso-8859-1"])
def test_lists_are_written_back_and_every_other_byte_stays(encoding: str, tmp_path: Path) -> None:
    before = project(axis(1), axis(3), encoding=encoding)
    path = written(tmp_path, before)
    reading = read_machine(path)
    for number, value in ((1, 12345), (3, 6)):
        document = reading.compensation_list(number)
        assert document is not None
        document.set("kw.ssfk.table[1].pos", value)
        document.save()
    assert path.read_bytes() == project(axis(1, "12345"), axis(3, "6"), encoding=encoding)
    again = read_machine(path).machine
    assert [one.leadscrew and one.leadscrew.positive[1] for one in again.axes] == pytest.approx([1.2345, 6e-4])


def test_what_cannot_stand_in_the_file_is_refused(tmp_path: Path) -> None:
    before = project(axis(1), encoding="iso-8859-1")
    path = written(tmp_path, before)
    document = read_machine(path).axis_list(1)
    assert document is not None
    for name in ("]]>", "Ω"):
        copy = document.copy()
        copy.set("kopf.log_achs_name", name)
        with pytest.raises(ValueError, match="machine"):
            copy.save()
    assert path.read_bytes() == before


def test_faults_are_mended_inside(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path, project(axis(1), axis(3)).replace(b"kw.ssfk.interval 100000", b"kw.ssfk.intervall 100000"))
    assert main(["check", str(path), "--format", "json"]) == 0
    told = json.loads(capsys.readouterr().out)["findings"]
    assert [(one["file"], one["code"]) for one in told] == [(str(path), "AXC-TYPO")] * 2
    assert main(["check", str(path), "--fix"]) == 0
    assert path.read_bytes() == project(axis(1), axis(3)).replace(
        b"kw.ssfk.interval 100000", b"kw.ssfk.interval  100000"
    )


def test_a_folder_with_a_project_is_a_machine(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(tmp_path, project(axis(1)), "axes.xti")
    written(tmp_path, b"<a><![CDATA[nothing]]></a>", "other.xml")
    assert main(["check", str(tmp_path)]) == 0
    assert "1 axis with 1 compensation." in capsys.readouterr().out


@pytest.mark.parametrize(
    ("data", "code"),
    [
        (b"<a><![CDATA[kw.ssfk.unit 1]]></b>", "AXC-UNREADABLE"),
        (b"<a><![CDATA[x]]></a>", "AXC-EMPTY"),
        (b'<?xml version="1.0" encoding="utf-8"?><a><![CDATA[\xff]]></a>', "AXC-UNREADABLE"),
    ],
)
def test_what_is_no_project_is_a_finding(data: bytes, code: str, tmp_path: Path) -> None:
    findings = read_machine(written(tmp_path, data)).findings
    assert code in [one.code for one in findings]


def test_entities_do_not_grow(tmp_path: Path) -> None:
    bomb = (
        '<!DOCTYPE a [<!ENTITY b "'
        + "x" * 1000
        + '">'
        + "".join(
            f'<!ENTITY {n} "{"&" + p + ";"}{"&" + p + ";"}{"&" + p + ";"}{"&" + p + ";"}">'
            for p, n in zip("bcdefghijklmno", "cdefghijklmnop", strict=True)
        )
    )
    path = written(tmp_path, f"{bomb}]><a>&p;<![CDATA[kw.ssfk.unit 1]]></a>".encode())
    assert {one.code for one in read_machine(path).findings} <= {"AXC-UNREADABLE", "AXC-EMPTY"}


def test_a_project_is_packed_as_one_file_and_read_again(tmp_path: Path) -> None:
    path = written(tmp_path, project(axis(1), axis(3)))
    reading = read_machine(path)
    start, files = packed_lists(reading)
    assert list(files) == [start] == ["machine/machine.tsproj"]
    again = reading.again()
    assert again.machine == reading.machine
    assert any(isinstance(one, Project) for one in again.documents.values())
