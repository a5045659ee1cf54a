"""Varied lists: the machine that comes out is the one that lists written by hand describe."""

from dataclasses import replace
from pathlib import Path

import pytest

from axcomp import read_machine
from axcomp.kinds import KINDS, ListKind
from axcomp.lists import Document
from axcomp.model import models
from axcomp.sweep import ListEntry, Table, read_files, varied

LIST = b"""\
# a list
kopf.achs_nr 1      ( the axis )
kopf.log_achs_name X
kw.ssfk.interval 0
kw.ssfk.kw_nr_max 3
kw.ssfk.bilateral 1
kw.ssfk.table[0].setpoint 0
kw.ssfk.table[0].pos 10   # first
kw.ssfk.table[0].neg -10
kw.ssfk.table[1].setpoint 100000
kw.ssfk.table[1].pos 20
kw.ssfk.table[1].neg 25
kw.ssfk.table[2].setpoint 200000
kw.ssfk.table[2].pos -30
kw.ssfk.table[2].neg 0.5
End
"""
FILES = {"lists/achskw1.lis": LIST}


def reading_of(*changes):
    reading = read_files("lists/achskw1.lis", FILES)
    return read_machine(reading.path, documents=varied(reading, changes))


def machine_of(*changes):
    return reading_of(*changes).machine.axes[0].leadscrew


def test_without_changes_it_is_the_machine_of_the_files(tmp_path: Path) -> None:
    (tmp_path / "achskw1.lis").write_bytes(LIST)
    assert read_files("lists/achskw1.lis", FILES).machine == read_machine(tmp_path / "achskw1.lis").machine


def test_an_entry_is_set() -> None:
    screw = machine_of((ListEntry("achskw1.lis", "kw.ssfk.bilateral", False), False))
    assert screw == replace(machine_of(), negative=None)


def test_an_entry_that_is_not_there_is_added() -> None:
    assert machine_of((ListEntry("achskw1.lis", "kw.ssfk.manual_activation", False), 1)).manual_activation


def test_a_row_is_set_and_all_others_stay() -> None:
    screw = machine_of((ListEntry("ACHSKW1.LIS", "kw.ssfk.table[1].pos", False), 123.5))
    assert screw.positive == pytest.approx((1e-3, 123.5e-4, -3e-3), abs=1e-15)
    assert screw.negative == machine_of().negative


def test_all_rows_are_scaled_exactly() -> None:
    screw = machine_of((ListEntry("lists/achskw1.lis", "kw.ssfk.table[].neg", True), 1.1))
    assert screw.negative == pytest.approx((-1.1e-3, 2.75e-3, 0.55e-4), abs=1e-18)
    assert screw.positive == machine_of().positive


def test_changes_come_one_after_the_other() -> None:
    entry = "kw.ssfk.table[0].pos"
    screw = machine_of((ListEntry("achskw1.lis", entry, False), 50), (ListEntry("achskw1.lis", entry, True), 2))
    assert screw.positive[0] == pytest.approx(0.01)


def test_the_rest_of_a_list_stays_as_it_is() -> None:
    document = Document("x", LIST, ListKind.COMPENSATION)
    ListEntry("x", "kw.ssfk.bilateral", False).applied(document, 0)
    assert document.to_bytes() == LIST.replace(b"bilateral 1", b"bilateral 0")


def test_findings_name_the_list_and_no_temporary_folder() -> None:
    findings = reading_of((ListEntry("achskw1.lis", "kw.ssfk.interval", False), -7)).findings
    assert findings
    assert all(str(finding).startswith("lists/achskw1.lis:") and "tmp" not in str(finding) for finding in findings)


@pytest.mark.parametrize(
    ("entry", "value", "said"),
    [
        (ListEntry("achskw2.lis", "kw.ssfk.bilateral", False), 1, "no list achskw2.lis; the machine's files are lists"),
        (ListEntry("achskw1.lis", "kw.ssfk.bilaterall", False), 1, "no entry kw.ssfk.bilaterall"),
        (ListEntry("achskw1.lis", "kw.crosscomp.n_cycles", True), 1.0, "has no entry kw.crosscomp.n_cycles"),
        (ListEntry("achskw1.lis", "kw.ssfk.table[7].pos", True), 1.0, r"has no entry kw.ssfk.table\[7\].pos"),
        (ListEntry("achskw1.lis", "kopf.log_achs_name", True), 2.0, "no number to scale"),
    ],
)
def test_changes_that_cannot_be_made_say_why(entry: ListEntry, value: float, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        reading_of((entry, value))


def test_tables_of_every_kind_are_scaled() -> None:
    scaled = set()
    for machine in (read_machine(models() / name).machine for name in ("three_axis", "warm_axis")):
        for table in (Table(f"{axis.name}.{one.kind}") for axis in machine.axes for one in axis.compensations):
            scaled.add(table.name.rpartition(".")[2])
            once = table.applied(machine, 3.0)
            assert once != machine
            assert [a == b for a, b in zip(once.axes, machine.axes, strict=True)].count(False) == 1
            assert table.applied(table.applied(machine, 2.0), 0.5) == machine
    assert scaled == set(KINDS)
    machine = read_machine(models() / "three_axis").machine
    plane = next(axis for axis in machine.axes if axis.plane)
    warm = Table("X.temperature").applied(read_machine(models() / "warm_axis").machine, 2.0).axis("X").temperature
    assert (warm.position, warm.offset, warm.coefficient) == (20.0, 0.003, 24e-6)
    doubled = Table(f"{plane.name}.plane").applied(machine, 2.0).axis(plane.name).plane
    assert doubled.corrections[3][5] == 2.0 * plane.plane.corrections[3][5]


def test_one_error_or_all_errors_of_a_volumetric_compensation_are_scaled() -> None:
    machine = read_machine(models() / "five_axis").machine
    every, one = Table("volumetric[0]").applied(machine, 2.0), Table("volumetric[0].EXX").applied(machine, 2.0)
    for before, all_of, single in zip(
        machine.volumetric[0].errors, every.volumetric[0].errors, one.volumetric[0].errors, strict=True
    ):
        twice = tuple(2.0 * value for value in before.values)
        assert all_of.values == twice
        assert single.values == (twice if before.name == "EXX" else before.values)
    assert every.volumetric[1] == machine.volumetric[1]


@pytest.mark.parametrize("name", ["Q.leadscrew", "X.nothing", "volumetric[0]", "volumetric[1].EXX"])
def test_a_table_that_is_not_there_is_named_with_those_that_are(name: str) -> None:
    machine = read_machine(models() / "three_axis").machine
    with pytest.raises(ValueError, match=r"there are .*X\.plane"):
        Table(name).applied(machine, 2.0)
