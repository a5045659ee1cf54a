from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from axcomp.kinds import Severity
from axcomp.lists import Finding, Findings, ParameterBlock, read_etalon, read_isg_csv, write_etalon, write_isg_csv
from axcomp.model import LETTERS, PARAMETERS

Block = tuple[tuple[str, ...], tuple[str, ...], list[list[float]]]


def csv(text: str) -> tuple[list[ParameterBlock], tuple[Finding, ...]]:
    findings = Findings()
    return read_isg_csv(text, "errors.csv", findings), findings.all()


def etalon(text: str) -> tuple[list[ParameterBlock], tuple[Finding, ...]]:
    findings = Findings()
    return read_etalon(text, "errors.exc", findings), findings.all()


def plain(blocks: list[ParameterBlock]) -> list[Block]:
    return [(block.arguments, block.names, block.rows) for block in blocks]


def shown(findings: tuple[Finding, ...]) -> list[tuple[str, int, str]]:
    return [(finding.code, finding.line, finding.parameter) for finding in findings]


def test_the_manual_examples_of_isg_csv_are_read() -> None:
    blocks, findings = csv("""// The header only contains position errors.
Y0A    Z0A    X0B

// constant
0.1    0.2    0.11
#
// The argument "Z" now crops up in the header.
Z      X      EXX    EYX    EZX    EAX    EBX    ECX
0.0    0.0    0.02   0.01   0.07   0.00   0.0042 0.003
0.0    10.0   0.00   -0.1   0.01   0.00   0.0011 0.002
// In the second block Z is always = 100.
100.0  0.0    0.01   0.02   0.03   0.07   0.0040 0.003
100.0  10.0   0.03   -0.09  0.03   0.06   0.0015 0.000
""")
    assert findings == ()
    assert plain(blocks)[0] == ((), ("Y0A", "Z0A", "X0B"), [[0.1, 0.2, 0.11]])
    assert blocks[1].arguments == ("Z", "X")
    assert blocks[1].names == ("EXX", "EYX", "EZX", "EAX", "EBX", "ECX")
    assert blocks[1].rows[3] == [100.0, 10.0, 0.03, -0.09, 0.03, 0.06, 0.0015, 0.0]
    assert (blocks[1].line, blocks[1].lines) == (8, [9, 10, 12, 13])


def test_what_the_manual_leaves_out_is_a_warning() -> None:
    blocks, findings = csv("Y0A Z0A X0B …\n0.1 0.2 0.11 …\n...\n")
    assert plain(blocks) == [((), ("Y0A", "Z0A", "X0B"), [[0.1, 0.2, 0.11]])]
    assert shown(findings) == [("AXC-ELISION", 1, ""), ("AXC-ELISION", 2, ""), ("AXC-ELISION", 3, "")]


@pytest.mark.parametrize("text", ["X;EXX\n0;0.5\n", "X,EXX\n0,0.5", "x\texx\n0\t0.5\n", " X  EXX // c\n\n0 .5//\n"])
def test_columns_may_be_separated_in_many_ways(text: str) -> None:
    blocks, findings = csv(text)
    assert plain(blocks) == [(("X",), ("EXX",), [[0.0, 0.5]])]
    assert findings == ()


@pytest.mark.parametrize(
    "text",
    [
        "X;EXX;EYX\n-10,5;0,02;-1,5E-3\n",  # Excel with German settings
        "X;EXX;EYX;;\n-10,5;0,02;-1,5E-3;;\n",
        '"X";"EXX";"EYX"\n"-10,5";"0,02";"-1,5E-3"\n',
        '"X","EXX","EYX"\n"-10,5","0,02","-1,5E-3"\n',
        "X,EXX,EYX\n-10.5,0.02,-1.5E-3\n",
        "X\tEXX\tEYX\n-10,5\t0,02\t-1,5E-3\n",
        "X EXX EYX\n-10,5  0,02  -1,5E-3\n",
        "X EXX EYX\n-10.5, 0.02, -1.5E-3\n",
        "X, EXX, EYX\n-10.5, 0.02, -1.5E-3 // c\n",
    ],
)
def test_numbers_may_have_commas_and_cells_quotes(text: str) -> None:
    blocks, findings = csv(text)
    assert plain(blocks) == [(("X",), ("EXX", "EYX"), [[-10.5, 0.02, -1.5e-3]])]
    assert findings == ()


def test_a_single_column_may_have_a_comma() -> None:
    assert plain(csv("X0X\n0,01\n")[0]) == [((), ("X0X",), [[0.01]])]


@pytest.mark.parametrize(
    "text",
    [
        "[EXY]\nGridpoints = {\n-280,5 -0,0013\n10,0\t0,002 // c\n}\n[A0C]\nVALUE = 1,5E-5\n",
        '"[EXY]"\n"Gridpoints = {"\n"-280,5 -0,0013"\n"10,0";"0,002"\n}\n[A0C]\nVALUE = "1,5E-5"\n',
    ],
)
def test_etalon_files_may_have_commas_and_quotes_too(text: str) -> None:
    blocks, findings = etalon(text)
    assert plain(blocks) == [(("Y",), ("EXY",), [[-280.5, -0.0013], [10.0, 0.002]]), ((), ("A0C",), [[1.5e-5]])]
    assert findings == ()


def test_an_etalon_section_that_means_nothing_is_passed_over_with_all_it_holds() -> None:
    text = "[MACHINE]\nVALUE = x\nGridpoints = {\n1 2 3\n}\n}\n[EXX]\nVALUE = 0.1\n[HEADER]\nfree\n[UNITS]\nmm\n"
    blocks, findings = etalon(text)
    assert plain(blocks) == [((), ("EXX",), [[0.1]])]
    assert shown(findings) == [("AXC-SECTION", 1, "MACHINE"), ("AXC-SECTION", 11, "UNITS")]
    assert all(finding.severity is Severity.WARNING for finding in findings)


def test_arguments_may_stand_anywhere_in_a_header() -> None:
    blocks, _ = csv("EXX X EYX Z\n1 2 3 4\n")
    assert plain(blocks) == [(("X", "Z"), ("EXX", "EYX"), [[2.0, 4.0, 1.0, 3.0]])]


def test_a_hash_ends_a_block_whatever_follows_it() -> None:
    blocks, _ = csv("X EXX\n0 1\n# errors of Y\nY EYY\n0 2\n")
    assert [block.names for block in blocks] == [("EXX",), ("EYY",)]


@pytest.mark.parametrize(
    ("text", "code", "line", "parameter"),
    [
        ("X EXX EXQ\n0 1 2\n", "70468", 1, "EXQ"),
        ("X EXX Q\n0 1 2\n", "70468", 1, "Q"),
        ("X EXX EYX EXX\n0 1 2 3\n", "70469", 1, "EXX"),
        ("X EXX X\n0 1 0\n", "70469", 1, "X"),
        ("X EXX\n0 1\n1 2 3\n", "AXC-RECORD", 3, ""),
        ("X EXX\n0\n", "AXC-RECORD", 2, ""),
        ("X EXX\n0 0,02 0,03\n", "AXC-RECORD", 2, ""),
        ("X EXX\n0 1.000,5\n", "AXC-RECORD", 2, ""),
        ("X;EXX\n;0,5\n", "AXC-RECORD", 2, ""),
        ("X EXX\n0 a\n", "AXC-RECORD", 2, ""),
        ("X EXX\n0 nan\n", "AXC-RECORD", 2, ""),
        ("X EXX\n0 1e999\n", "AXC-RECORD", 2, ""),
        ("X EXX\n0 1_0\n", "AXC-RECORD", 2, ""),
        ("X EXX\n0 1\n0.5 2e6\n", "AXC-MAGNITUDE", 3, "EXX"),
        ("X EXX\n1e7 1\n", "AXC-MAGNITUDE", 2, "X"),
        ("X EAX\n0 1.5\n", "AXC-MAGNITUDE", 2, "EAX"),
        ("IDC\n30\n", "AXC-MAGNITUDE", 2, "IDC"),
    ],
)
def test_a_faulty_csv_file_is_told_where(text: str, code: str, line: int, parameter: str) -> None:
    _, findings = csv(text)
    assert (code, line, parameter) in shown(findings)
    assert all(f.severity is Severity.ERROR and f.file == "errors.csv" and f.message.endswith(".") for f in findings)


def test_a_header_without_records_is_a_warning() -> None:
    blocks, findings = csv("X EXX\n#\nY EYY\n0 1\n")
    assert [block.names for block in blocks] == [("EYY",)]
    assert [(f.code, f.line, f.severity) for f in findings] == [("AXC-NO-RECORD", 1, Severity.WARNING)]


def test_the_manual_examples_of_etalon_files_are_read() -> None:
    blocks, findings = etalon("""// Etalon Exchange Format
// Created by a program

[HEADER]
MACHINE_TYPE = X 600
MACHINE_NO   =
USERSPECIFIC_COMMENT = { [free]
[C0B]
VALUE = 0.000022355737

[EXY]
Gridpoints = {
          -280.0 -0.001358635132
          -270.0 -0.000240680764
:
           270.0 -0.000316265101
}  // end of EXY
[EXC]
Gridpoints = {
        0.0 -0.000833484486
360.0 -0.000833484486// <- duplicate of the 0° row
}  // end of EXC
""")
    assert plain(blocks) == [
        ((), ("C0B",), [[0.000022355737]]),
        (("Y",), ("EXY",), [[-280.0, -0.001358635132], [-270.0, -0.000240680764], [270.0, -0.000316265101]]),
        (("C",), ("EXC",), [[0.0, -0.000833484486], [360.0, -0.000833484486]]),
    ]
    assert shown(findings) == [("AXC-ELISION", 15, "")]


@pytest.mark.parametrize(
    "text",
    [
        "[EXY]\nGridpoints\n=\n",
        "[exy]\ngridpoints={ 1 2\n3 4 }\n",
        "[EXY]\nGRIDPOINTS =\n{\n1 2\n3 4\n}\n",
        "[EXY]\nGridpoints = {\n1\t2\n3 4}",
    ],
)
def test_braces_may_stand_on_lines_of_their_own(text: str) -> None:
    blocks, findings = etalon(text)
    if text.endswith("=\n"):
        assert "AXC-NO-RECORD" in [finding.code for finding in findings]
    else:
        assert plain(blocks) == [(("Y",), ("EXY",), [[1.0, 2.0], [3.0, 4.0]])]
        assert findings == ()


@pytest.mark.parametrize(
    ("text", "code", "line"),
    [
        ("[EXQ]\nVALUE = 1\n", "AXC-SECTION", 1),
        ("[EXX]\nVALUE = 1\n[EXX]\nVALUE = 2\n", "70469", 3),
        ("[EXX]\nVALUE = 1\nGridpoints = {\n1 2\n}\n", "70469", 4),
        ("[EXX]\nVALUE = 1 2\n", "AXC-RECORD", 2),
        ("[EXX]\nVALUE =\n", "AXC-RECORD", 2),
        ("[EXX]\nVALUE = one\n", "AXC-RECORD", 2),
        ("[EXX]\nGridpoints = {\n1 2\n3\n}\n", "AXC-RECORD", 4),
        ("[EXX]\nGridpoints = {\n1 2 3\n}\n", "AXC-RECORD", 3),
        ("[EXX]\nGridpoints = {\n1 inf\n}\n", "AXC-RECORD", 3),
        ("[EAX]\nVALUE = 90\n", "AXC-MAGNITUDE", 2),
        ("[EXX]\n", "AXC-NO-RECORD", 1),
        ("[EXX]\nGridpoints = {\n1 2\n[EYX]\nVALUE = 1", "AXC-SYNTAX", 4),
        ("[EXX]\nGridpoints =\n1 2\n", "AXC-SYNTAX", 3),
        ("[EXX\nVALUE = 1", "AXC-SYNTAX", 1),
        ("[EXX]\nUNIT = mm\nVALUE = 1", "AXC-SYNTAX", 2),
    ],
)
def test_a_faulty_etalon_file_is_told_where(text: str, code: str, line: int) -> None:
    _, findings = etalon(text)
    assert (code, line) in [(finding.code, finding.line) for finding in findings]
    assert all(finding.file == "errors.exc" and finding.message.endswith(".") for finding in findings)


VALUES = st.floats(-1.0, 1.0)
NAMES = sorted(PARAMETERS)


@st.composite
def blocks(draw: st.DrawFn) -> list[ParameterBlock]:
    names = iter(draw(st.permutations(NAMES)))
    found = []
    for _ in range(draw(st.integers(1, 4))):
        arguments = tuple(draw(st.lists(st.sampled_from(LETTERS), max_size=3, unique=True)))
        own = tuple(next(names) for _ in range(draw(st.integers(1, 4))))
        row = st.lists(VALUES, min_size=len(arguments + own), max_size=len(arguments + own))
        found.append(ParameterBlock("", 0, arguments, own, draw(st.lists(row, min_size=1, max_size=4))))
    return found


@given(blocks())
def test_what_is_written_as_isg_csv_reads_back(written: list[ParameterBlock]) -> None:
    read, findings = csv(write_isg_csv(written))
    assert plain(read) == plain(written)
    assert {finding.code for finding in findings} <= {"AXC-LARGE"}


@given(st.dictionaries(st.sampled_from(NAMES), st.lists(st.tuples(VALUES, VALUES), max_size=4), min_size=1), VALUES)
def test_what_is_written_as_etalon_reads_back(tables: dict[str, list[tuple[float, float]]], value: float) -> None:
    written = [
        ParameterBlock("", 0, (name[-1],) if rows else (), (name,), [list(row) for row in rows] or [[value]])
        for name, rows in tables.items()
    ]
    read, findings = etalon(write_etalon(written))
    assert plain(read) == plain(written)
    assert {finding.code for finding in findings} <= {"AXC-LARGE"}


def test_etalon_files_cannot_hold_other_arguments() -> None:
    with pytest.raises(ValueError, match="EXX over Z, X"):
        write_etalon([ParameterBlock("", 0, ("Z", "X"), ("EXX",), [[0.0, 0.0, 1.0]])])


@given(st.text(alphabet="[]{}=/#.,;: \n\tXEA01e-…V" + "VALUEGridponts", max_size=200) | st.text(max_size=100))
def test_any_text_is_read_without_an_exception(text: str) -> None:
    for read in (csv, etalon):
        found, findings = read(text)
        assert all(len(row) == len(b.arguments) + len(b.names) for b in found for row in b.rows)
        assert all(0 < finding.line <= text.count("\n") + 1 for finding in findings)


def test_a_foreign_file_does_not_flood_the_findings() -> None:
    _, findings = csv("X EXX\n" + "spam\n" * 5000)
    assert len(findings) < 20
    assert "4,990 more" in findings[-1].message
