"""Regular stretches are read column by column: with the same result as line by line, whatever stands in a list."""

from collections.abc import Callable
from typing import Any
from unittest.mock import patch

import pytest
from hypothesis import given, settings, strategies as st

import axcomp.lists.values
from axcomp.kinds import ListKind, Parameter
from axcomp.lists import CATALOGUE, Document, Finding, Findings, read_machine, read_values

TABLES = [row for row in CATALOGUE[ListKind.COMPENSATION] if "[" in row.name]
ODD_VALUES = (
    "1.5",
    "1_0",
    "+7",
    "-0",
    "007",
    "٣",
    "5 (comment)",
    "5 # 2",
    "5\t",
    "nan",
    "9" * 30,
    "",
    "0x1",
    "5/*",
    "*/",
)
ODD_LINES = ("", "# comment", "   ", "End", "...", "/* begin", "end */ kw.ssfk.table[3].pos 5", "kw.ssfk.bilateral 1")


@st.composite
def lists(draw: st.DrawFn) -> str:
    """Tables as a program writes them, then a few lines changed, left out, doubled, moved or put between."""
    lines: list[str] = []
    for _ in range(draw(st.integers(1, 3))):
        row: list[Parameter] = draw(st.lists(st.sampled_from(TABLES), min_size=1, max_size=3))
        first, fixed = draw(st.integers(0, 3)), draw(st.integers(0, 2))
        blank = draw(st.sampled_from((" ", "   ", "\t", " \t", "\u2003")))
        name = draw(st.sampled_from((str, str.upper, str.lower)))
        for i in range(first, first + draw(st.integers(1, 40))):
            for parameter in row:
                indices = (fixed, i)[2 - parameter.name.count("[") :]
                lines.append(f"{name(parameter.named(*indices))}{blank}{draw(st.integers(-9, 99))}")
    for _ in range(draw(st.integers(0, 4))):
        at = draw(st.integers(0, len(lines) - 1))
        match draw(st.sampled_from(("value", "lose", "double", "line", "indent", "join", "blank"))):
            case "value":
                lines[at] = f"{lines[at].split()[0] if lines[at].split() else ''} {draw(st.sampled_from(ODD_VALUES))}"
            case "lose" if len(lines) > 1:
                del lines[at]
            case "double":
                lines.insert(at, draw(st.sampled_from(lines)))
            case "line":
                lines.insert(at, draw(st.sampled_from(ODD_LINES)))
            case "indent":
                lines[at] = f" {lines[at]}"
            case "join":
                lines[at : at + 2] = [" ".join(lines[at : at + 2])]
            case "blank":
                lines[at] = draw(st.sampled_from(("[", ".", " 0", "x"))).join(lines[at].split(None, 1))
    return "\n".join(lines)


def said(text: str) -> tuple[object, ...]:
    """Return all that is read from a list: values, lines, spellings, findings."""
    findings = Findings()
    values = read_values(text, "a.lis", ListKind.COMPENSATION, findings)
    columns = [(row.name, values.count(row.name), values.cells(row.name)) for row in TABLES]
    spelt = [row.name for row in TABLES if values.spelt(row.name)]
    return columns, spelt, values.foreign, values.others, findings.all()


def exactly(text: str) -> tuple[object, ...]:
    """Return what the exact reader alone reads."""
    with patch("axcomp.lists.stretches.Finder.taken", lambda *_: 0):
        return said(text)


def exact_values(*arguments: Any) -> Any:
    with patch("axcomp.lists.stretches.Finder.taken", lambda *_: 0):
        return read_values(*arguments)


def of_machine(text: str, reader: Callable[..., Any]) -> tuple[object, tuple[Finding, ...]]:
    document = Document("achskw1.lis", f"kw.ssfk.kw_nr_max 12\nkw.crosscomp2.last_index_1 5\n{text}".encode())
    with patch("axcomp.lists.document.read_values", reader):
        reading = read_machine("achskw1.lis", documents=[document])
    return reading.machine, reading.findings


@given(lists())
@settings(max_examples=150)
def test_both_readers_agree_on_tables_with_slips(text: str) -> None:
    assert said(text) == exactly(text)
    assert of_machine(text, read_values) == of_machine(text, exact_values)


@given(st.text() | st.lists(st.text("kw.ssfktable[]0123 .pos\t-+_#/*\n"), max_size=30).map("kw.ssfk.table".join))
@settings(max_examples=200)
def test_both_readers_agree_on_any_text(text: str) -> None:
    assert said(text) == exactly(text)


@pytest.fixture
def taken(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The stretches that were taken."""
    found: list[Any] = []
    take = axcomp.lists.values._take_stretch

    def spying(stretch: Any, columns: Any) -> bool:
        if take(stretch, columns):
            found.append(stretch)
        return stretch in found

    monkeypatch.setattr("axcomp.lists.values._take_stretch", spying)
    return found


def table(rows: range, fields: tuple[str, ...] = ("pos", "neg")) -> list[str]:
    return [f"kw.ssfk.table[{i}].{field} {10 * i}" for i in rows for field in fields]


def test_a_table_is_one_stretch_and_no_entry_of_it_is_made(taken: list[Any]) -> None:
    text = "\n".join(["kw.ssfk.bilateral 1", *table(range(100))])
    findings = Findings()
    values = Document("a.lis", text.encode()).read_as(ListKind.COMPENSATION, findings)
    assert [(s.fixed, s.first, s.line, s.lines) for s in taken] == [((), 0, 2, 200)]
    assert values.filled("kw.ssfk.table[i].neg", (100,)) == [10 * i for i in range(100)]
    assert values.place("kw.ssfk.table[i].neg", 7) == ("a.lis", 17)
    # Once a cell was asked for, they are cells.
    assert values.filled("kw.ssfk.table[i].neg", (100,)) is None


def test_a_comment_interrupts_a_stretch_only_where_it_stands(taken: list[Any]) -> None:
    lines = table(range(400))
    lines[300] += " (measured twice)"
    values = Document("a.lis", "\n".join(lines).encode()).read_as(ListKind.COMPENSATION, Findings())
    assert sum(stretch.lines for stretch in taken) >= 780
    assert values.count("kw.ssfk.table[i].pos") == 400
    assert values.value("kw.ssfk.table[i].pos", 150) == 1500


def test_rows_of_a_plane_are_stretches(taken: list[Any]) -> None:
    lines = [f"kw.crosscomp2.table[{j}][{i}].correction {j - i}" for j in range(5) for i in range(30)]
    values = Document("a.lis", "\n".join(lines).encode()).read_as(ListKind.COMPENSATION, Findings())
    assert [stretch.fixed for stretch in taken] == [(j,) for j in range(5)]
    assert values.filled("kw.crosscomp2.table[j][i].correction", (5, 30)) == [
        j - i for j in range(5) for i in range(30)
    ]
    for counts in ((5, 29), (4, 30), (6, 30), (5, 31)):
        assert values.filled("kw.crosscomp2.table[j][i].correction", counts) is None


def test_an_edited_document_is_read_as_it_now_is() -> None:
    data = "\r\n".join(table(range(50))).encode()
    document = Document("a.lis", data, ListKind.COMPENSATION)
    assert document.values.count("kw.ssfk.table[i].pos") == 50
    document.set("kw.ssfk.table[i].pos", -5, 20)
    assert document.values.value("kw.ssfk.table[i].pos", 20) == -5
    assert document.to_bytes() == data.replace(b"table[20].pos 200", b"table[20].pos -5")
