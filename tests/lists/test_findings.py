"""Every finding there is, provoked by a list, and what the machine is then."""

from collections.abc import Callable
from dataclasses import replace
from itertools import takewhile
from pathlib import Path

import pytest
from finding_cases import (
    CASES,
    CROSS,
    CROSSTALK,
    FRICTION,
    LEADSCREW,
    MDS,
    OLD_CROSSTALK,
    PLANE,
    Case,
    axis_list,
    places,
    start_up,
)
from frozen import SEVERITIES

from axcomp.lists import CODES, LIMIT, Finding, Findings, ListError, Reading, Severity, read_machine
from axcomp.model import Axis

ReadLists = Callable[..., Reading]

UPDATE_ONLY = {"110638", "110639", "110640", "110641"}
"""Codes of an update while the machine runs."""


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.code)
def test_lists_provoke_a_finding_at_its_place_and_the_rest_keeps_working(case: Case, read_lists: ReadLists) -> None:
    reading = read_lists(case.files)
    found = [f for f in reading.findings if f.code == case.code]
    assert (case.line, case.parameter) in [(f.line, f.parameter) for f in found], reading.findings
    for finding in found:
        assert finding.severity.value == SEVERITIES[case.code]
        assert finding.message.endswith(".")
        assert finding.file
    axis = next((axis for axis in reading.machine.axes if axis.number == 1), None)
    assert (None if axis is None else tuple(one.kind for one in axis.compensations)) == (
        case.kinds if case.kinds or axis is not None else None
    )


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.code)
def test_a_printed_finding_names_the_entry(case: Case, read_lists: ReadLists) -> None:
    for finding in read_lists(case.files).findings:
        assert finding.parameter in str(finding)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (FRICTION.replace("in 2000", "in 500"), "frict_comp.table[1].in = 500 is not above the entry before it, 1000;"),
        (CROSS.replace("last_index 1", "last_index 2"), "(is kw.crosscomp.last_index = 2 too large?)"),
        (CROSSTALK.replace("deceleration -1000", "deceleration 0") + places((0, 0)), "deceleration is needed and must"),
        (
            f"kw.ssfk.max_points 2\n{LEADSCREW}",
            "By kw.ssfk.kw_nr_max the table has 3 entries, but there is room for 2;",
        ),
    ],
)
def test_errors_speak_in_the_numbers_of_the_list(text: str, sentence: str, read_lists: ReadLists) -> None:
    found = [f for f in read_lists({"achskw1.lis": text}).findings if f.severity is Severity.ERROR]
    assert [sentence in finding.message for finding in found if finding.code != "AXC-GAP"] == [True]


def test_codes_and_severities_are_the_ones_users_know() -> None:
    assert {code: severity.value for code, (severity, _) in CODES.items()} == SEVERITIES


def test_every_code_is_provoked() -> None:
    # The volumetric compensation, whose codes come last, has its own tests.
    of_lists = set(takewhile(lambda code: code != "70468", CODES))
    assert {case.code for case in CASES} == of_lists - UPDATE_ONLY


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        (LEADSCREW, "leadscrew"),
        (CROSS, "cross"),
        (PLANE, "plane"),
        (FRICTION, "friction"),
        (OLD_CROSSTALK, "crosstalk"),
        (CROSSTALK + places((0, 0)), "crosstalk"),
        (f"kw.crosstalk.mode 3\n{CROSSTALK}{places((0, 0), (9, 0), (5, 5))}", "crosstalk"),
    ],
)
def test_the_lists_these_cases_begin_with_are_faultless(text: str, kind: str, read_lists: ReadLists) -> None:
    reading = read_lists({"achskw1.lis": text})
    assert reading.findings == ()
    assert list(reading.machine.axes[0].kinds) == [kind]


def test_the_same_fault_in_every_row_is_counted_not_repeated(read_lists: ReadLists) -> None:
    rows = "".join(f"kw.crosscomp2.table[{j}][{i}].correction no\n" for j in range(100) for i in range(100))
    last = "kw.crosscomp2.last_index_master1 99\nkw.crosscomp2.last_index_master2 99\n"
    reading = read_lists({"achskw1.lis": f"{PLANE.rsplit(chr(10), 2)[0]}\n{last}{rows}kw.ssfk.nothing 1\n"})
    values = [f for f in reading.findings if f.code == "AXC-ZEROED"]
    assert len(values) == LIMIT + 1
    assert "9,990 more" in values[-1].message
    assert "AXC-UNKNOWN" in [f.code for f in reading.findings]


def test_slips_are_not_lost_among_entries_of_other_functions(read_lists: ReadLists) -> None:
    strangers = "".join(f"other.parameter_{i} 1\n" for i in range(300))
    files = {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": axis_list(1, f"{strangers}lr_param.sskf 1\n")}
    reading = read_lists(files)
    [slip] = [f for f in reading.findings if f.parameter == "lr_param.sskf"]
    assert "lr_param.ssfk" in slip.message
    assert len(reading.findings) == LIMIT + 2


def test_findings_come_file_by_file_in_the_order_of_the_lines() -> None:
    findings = Findings()
    for file, line in (("a", 5), ("b", 2), ("a", 1), ("b", 1)):
        findings.add("AXC-SYNTAX", file, line, "", "?")
    assert [(f.file, f.line) for f in findings.all()] == [("a", 1), ("a", 5), ("b", 1), ("b", 2)]


def test_a_finding_reads_like_a_compilers() -> None:
    finding = Finding(Severity.WARNING, "achskw1.lis", 3, "kw.ssfk.unit", "AXC-VALUE", "kw.ssfk.unit is odd.")
    assert str(finding) == "achskw1.lis:3: warning AXC-VALUE: kw.ssfk.unit is odd."
    without_entry = replace(finding, message="Something.")
    assert str(without_entry) == "achskw1.lis:3: warning AXC-VALUE: Something. [kw.ssfk.unit]"


@pytest.mark.parametrize(
    ("old", "new", "positive"),
    [
        ("kw.ssfk.table[1].pos 2\n", "", (1e-4, 0.0, 3e-4)),
        ("pos 2", "pos 2;", (1e-4, 0.0, 3e-4)),
        ("pos 2", "pos 4294967296", (1e-4, 0.0, 3e-4)),
        ("pos 2", "pos", (1e-4, 0.0, 3e-4)),
        ("kw_nr_max 3", "kw_nr_max 4", (1e-4, 2e-4, 3e-4, 0.0)),
    ],
)
def test_a_zeroed_place_of_a_table_acts_as_0_but_is_an_error(
    old: str, new: str, positive: tuple[float, ...], read_lists: ReadLists, tmp_path: Path
) -> None:
    reading = read_lists({"achskw1.lis": LEADSCREW.replace(old, new)})
    leadscrew = reading.machine.axes[0].leadscrew
    assert leadscrew is not None
    assert leadscrew.positive == positive
    assert [finding.severity for finding in reading.findings] == [Severity.ERROR]
    with pytest.raises(ListError):
        read_machine(tmp_path, strict=True)


def test_an_implausible_number_of_lists_is_an_error(read_lists: ReadLists, tmp_path: Path) -> None:
    files = {"hochlauf.lis": start_up("kw.lis").replace("zahl_kw 1", "zahl_kw 33"), "kw.lis": LEADSCREW}
    assert read_lists(files).machine.axes == ()
    with pytest.raises(ListError, match="zahl_kw = 33"):
        read_machine(tmp_path, strict=True)


def test_slave_ax_nr_is_told_with_the_axis_that_is_corrected(read_lists: ReadLists) -> None:
    text = CROSS.replace("achs_nr 1", "achs_nr 3").replace("master_ax_nr", "Slave_ax_nr")
    reading = read_lists({"achskw3.lis": text})
    [finding] = reading.findings
    assert (finding.line, finding.column, finding.severity) == (4, 1, Severity.WARNING)
    assert "axis 3, whose list this is, is corrected by the position of axis 2" in finding.message
    assert [(axis.number, list(axis.kinds)) for axis in reading.machine.axes] == [(3, ["cross"]), (2, [])]


@pytest.mark.parametrize(
    ("entry", "expected"),
    [
        ("kw.ssfk.bilateral TRUE", True),
        ("kw.ssfk.bilateral false", False),
        ("kw.ssfk.bilateral 1 # both", True),
        ("kw.ssfk.bilateral 3", False),
        ("kw.ssfk.bilateral 1\nkw.ssfk.bilateral 0", False),
    ],
)
def test_booleans_are_numbers_or_words(entry: str, expected: bool, read_lists: ReadLists) -> None:
    reading = read_lists({"achskw1.lis": f"{LEADSCREW}{entry}\n"})
    table = reading.machine.axes[0].leadscrew
    assert table is not None
    assert (table.negative is not None) == expected


def test_each_axis_without_findings_is_equal_to_one_made_by_hand(read_lists: ReadLists) -> None:
    files = {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": axis_list(1, "kopf.log_achs_name X (first axis)\n")}
    assert read_lists(files).machine.axes == (Axis(1, "X"),)


@pytest.mark.parametrize(
    ("interval", "ends_differ", "expected", "acts"),
    [
        (900_000, True, [], True),  # 180° of 360°: the gap is interpolated
        (1_800_000, True, ["AXC-MODULO-SEAM"], True),
        (1_800_000, False, [], True),
        (1_800_001, False, ["AXC-MODULO-SPAN"], False),
    ],
)
def test_a_modulo_table_is_compared_with_the_range_wherever_that_begins(
    interval: int, ends_differ: bool, expected: list[str], acts: bool, read_lists: ReadLists
) -> None:
    table = f"{LEADSCREW}kw.ssfk.modulo 1\nkw.ssfk.kw_startpos -1800000\n".replace("100000", str(interval), 1)
    files = {
        "achskw1.lis": table if ends_differ else table.replace("pos 3", "pos 1"),
        "achsmd1.lis": axis_list(
            1,
            "lr_param.ssfk 1\nkenngr.achs_typ 2\nkenngr.achs_mode ACHSMODE_MODULO\n"
            "getriebe[0].modulou -1800000\ngetriebe[0].moduloo 1800000\n",
        ),
    }
    reading = read_lists(files)
    assert [finding.code for finding in reading.findings] == expected
    leadscrew = reading.machine.axes[0].leadscrew
    assert (leadscrew is not None) == acts
    assert leadscrew is None or leadscrew.modulo
