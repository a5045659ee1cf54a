"""What ``--fix`` mends: nothing else changes, comments stay, a second time there is nothing left to do."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given, settings, strategies as st
from linting import Write
from small_lists import LEADSCREW
from strategies import machines

from axcomp.cli import main
from axcomp.lint import Settings, fixed
from axcomp.lists import read_machine, write_machine
from axcomp.model import Machine

Codes = Callable[..., list[str]]
CROSS = """\
kopf.achs_nr 1
kw.crosscomp.unit 1
kw.crosscomp.last_index 2
kw.crosscomp.master_ax_nr 2
kw.crosscomp.table[0].setpoint 1000  # the middle
kw.crosscomp.table[0].correction 1
# between
kw.crosscomp.table[1].setpoint 0     # the begin
kw.crosscomp.table[1].correction 2
kw.crosscomp.table[2].setpoint 2000  # the end
kw.crosscomp.table[2].correction 3
"""
PLANE = """\
kopf.achs_nr 1
kw.crosscomp2.unit 1
kw.crosscomp2.interval 100000
kw.crosscomp2.master1_ax_nr 2
kw.crosscomp2.master2_ax_nr 3
""" + "".join(f"kw.crosscomp2.table[{j}][{i}].correction {10 * j + i}\n" for j in range(2) for i in range(3))
FRICTION = """\
kopf.achs_nr 1
frict_comp.mode 3
frict_comp.table[0].in 1000
frict_comp.table[0].out 10
frict_comp.table[1].in 2000
frict_comp.table[1].out 20
"""


def lines(path: str) -> list[str]:
    return Path(path).read_text(encoding="utf-8").splitlines()


@pytest.mark.parametrize(
    ("before", "changed", "code"),
    [
        (
            LEADSCREW.replace("interval 1", "intervall    1"),
            {"kw.ssfk.intervall    100000": "kw.ssfk.interval     100000"},
            "AXC-TYPO",
        ),
        (LEADSCREW.replace("kw_nr_max", "kw_nr_mx"), {"kw.ssfk.kw_nr_mx 3": "kw.ssfk.kw_nr_max 3"}, "AXC-UNKNOWN"),
        (f"{LEADSCREW}kw.ssfk.table[ 2].pos 7 # new\n", {"kw.ssfk.table[2].pos 3": None}, "AXC-TWICE"),
        (f"kw.ssfk.table[2].pos 1 # old\n{LEADSCREW}", {"kw.ssfk.table[2].pos 1 # old": "# old"}, "AXC-TWICE"),
        (f"kw.ssfk.table[2].pos 1 old\n{LEADSCREW}", {"kw.ssfk.table[2].pos 1 old": "# old"}, "AXC-TWICE"),
    ],
)
def test_a_line_is_mended_where_it_stands(
    before: str, changed: dict[str, str | None], code: str, write: Write, codes: Codes
) -> None:
    write({"achskw1.lis": before})
    assert code in codes("achskw1.lis")
    assert main(["check", "achskw1.lis", "--fix"]) == 0
    assert lines("achskw1.lis") == [new for line in before.splitlines() if (new := changed.get(line, line)) is not None]
    assert code not in codes("achskw1.lis")


@pytest.mark.parametrize(
    ("name", "text", "added"),
    [
        ("leadscrew", LEADSCREW.replace("kw.ssfk.kw_nr_max 3\n", ""), {"kw.ssfk.kw_nr_max": "3"}),
        ("cross", CROSS.replace("kw.crosscomp.last_index 2\n", ""), {"kw.crosscomp.last_index": "2"}),
        ("plane", PLANE, {"kw.crosscomp2.last_index_master1": "2", "kw.crosscomp2.last_index_master2": "1"}),
        ("friction", FRICTION, {"frict_comp.table_entries": "2"}),
    ],
)
def test_a_size_that_is_missing_is_counted(name: str, text: str, added: dict[str, str], write: Write) -> None:
    write({"achskw1.lis": text})
    main(["check", "achskw1.lis", "--fix"])
    new = [line.split() for line in lines("achskw1.lis") if line.split()[0] in added]
    assert dict(new) == added
    assert name in read_machine("achskw1.lis").machine.axes[0].kinds


def test_the_number_of_lists_is_counted(write: Write) -> None:
    write(
        {
            "hochlauf.lis": "# all\nachs_kw[0] a.lis\nachs_kw[1] b.lis\n",
            "a.lis": LEADSCREW,
            "b.lis": LEADSCREW.replace("nr 1", "nr 2"),
        }
    )
    assert main(["check", ".", "--fix"]) == 0
    assert lines("hochlauf.lis")[1].split() == ["zahl_kw", "2"]
    assert len(read_machine("hochlauf.lis").machine.axes) == 2


def test_rows_are_sorted_with_their_comments(write: Write) -> None:
    write({"achskw1.lis": CROSS})
    assert main(["check", "achskw1.lis", "--fix"]) == 0
    assert lines("achskw1.lis")[4:] == [
        "kw.crosscomp.table[0].setpoint 0     # the begin",
        "kw.crosscomp.table[0].correction 2",
        "# between",
        "kw.crosscomp.table[1].setpoint 1000  # the middle",
        "kw.crosscomp.table[1].correction 1",
        "kw.crosscomp.table[2].setpoint 2000  # the end",
        "kw.crosscomp.table[2].correction 3",
    ]
    cross = read_machine("achskw1.lis").machine.axes[0].cross
    assert cross is not None
    assert (cross.positions, cross.corrections) == ((0.0, 0.1, 0.2), (2e-4, 1e-4, 3e-4))


def test_a_file_gets_its_name(write: Write) -> None:
    write({"hochlauf.lis": 'zahl_kw 1\nachs_kw[0] "SUB\\KW.LIS" (the only one)\n', "sub/kw.lis": LEADSCREW})
    assert main(["check", ".", "--fix"]) == 0
    assert lines("hochlauf.lis")[1].startswith("achs_kw[0] sub/kw.lis")
    assert lines("hochlauf.lis")[1].endswith("(the only one)")


@pytest.mark.parametrize(
    "text",
    [
        LEADSCREW.replace("pos 2", "pos x"),
        LEADSCREW.replace("kw.ssfk.table[1].pos 2\n", ""),
        CROSS.replace("setpoint 0", "setpoint 1000"),
        CROSS.replace("last_index 2", "last_index 1").replace(
            "kw.crosscomp.table[1].setpoint 0 ", "kw.crosscomp.table[1].setpoint 5 "
        ),
        FRICTION.replace("in 1000", "in -1000").replace("mode 3", "mode 3\nfrict_comp.table_entries 2"),
        f"{LEADSCREW}kw.ssfk.mod 1\n",
        f"{LEADSCREW}kw.ssfk.intervals 1\nkw.ssfk.interval 2 /* goes\non */\n",
    ],
)
def test_what_needs_a_decision_is_left(text: str, write: Write) -> None:
    folder = write({"achskw1.lis": text})
    before = read_machine(folder).machine
    main(["check", ".", "--fix"])
    assert Path("achskw1.lis").read_text() == text or read_machine(folder).machine == before


def test_only_what_is_told_is_mended(write: Write) -> None:
    text = f"{LEADSCREW}kw.ssfk.table[2].pos 7\n"
    write({"achskw1.lis": text, "axcomp.toml": 'ignore = ["AXC-TWICE"]\n'})
    assert main(["check", ".", "--fix"]) == 0
    assert Path("achskw1.lis").read_text() == text


def test_a_diff_is_shown_and_nothing_written(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    text = LEADSCREW.replace("interval", "intervall")
    write({"achskw1.lis": text})
    assert main(["check", ".", "--diff"]) == 1
    told = capsys.readouterr().out.splitlines()
    assert [line for line in told if line[0] in "+-" and line[:3] not in ("+++", "---")] == [
        "-kw.ssfk.intervall 100000",
        "+kw.ssfk.interval  100000",
    ]
    assert Path("achskw1.lis").read_text() == text
    write({"achskw1.lis": LEADSCREW})
    assert main(["check", ".", "--diff"]) == 0


@pytest.mark.parametrize(("codec", "newline"), [("latin-1", "\r\n"), ("utf-16", "\n"), ("utf-8-sig", "\r\n")])
def test_encoding_and_line_ends_stay(codec: str, newline: str, write: Write) -> None:
    text = LEADSCREW.replace("interval 100000", "intervall 100000 # größer") + "# ä\n"
    write({"achskw1.lis": text.replace("\n", newline).encode(codec)})
    assert main(["check", "achskw1.lis", "--fix"]) == 0
    expected = text.replace("intervall 100000", "interval  100000").replace("\n", newline)
    assert Path("achskw1.lis").read_bytes() == expected.encode(codec)


def test_300_faults_are_mended(write: Write) -> None:
    rows = "".join(f"kw.ssfk.table[{i}].poss {i}\n" for i in range(300))
    write({"achskw1.lis": LEADSCREW.partition("kw.ssfk.table")[0].replace("max 3", "max 300") + rows})
    assert main(["check", ".", "--fix"]) == 0
    leadscrew = read_machine("achskw1.lis").machine.axes[0].leadscrew
    assert leadscrew is not None
    assert leadscrew.positive == tuple(i / 10_000 for i in range(300))


class _Faults:
    """Puts faults into a list that can be mended by themselves."""

    def __init__(self, text: str, draw: st.DrawFn) -> None:
        self.lines = text.split("\n")
        self.draw = draw

    def duplicate(self) -> None:
        names = [line.split()[0] for line in self.lines if line.startswith(("kw.", "frict_comp."))]
        for name in self.draw(st.lists(st.sampled_from(names), max_size=3)) if names else ():
            self.lines.insert(0, f"{name.upper()}  {self.draw(st.integers(0, 9))} # an older one")

    def misspell(self) -> None:
        for i, line in enumerate(self.lines):
            if line.startswith("kw.ssfk.interval ") and self.draw(st.booleans()):
                self.lines[i] = line.replace("interval ", "intervall ")

    def forget_sizes(self) -> None:
        sizes = (
            "kw.ssfk.kw_nr_max",
            "kw.crosscomp.last_index ",
            "kw.crosscomp2.last_index",
            "frict_comp.table_entries",
        )
        for size in sizes:
            if self.draw(st.booleans()):
                self.lines = [line for line in self.lines if not line.startswith(size)]


@settings(max_examples=15, deadline=None)
@given(data=st.data(), machine=machines())
def test_what_is_mended_is_the_machine_that_was_meant_and_a_second_time_changes_nothing(
    data: st.DataObject, machine: Machine
) -> None:
    with TemporaryDirectory() as name:
        folder = Path(name)
        write_machine(machine, folder)
        meant = read_machine(folder).machine
        for path in sorted(folder.glob("achskw*.lis")):
            faults = _Faults(path.read_text(), data.draw)  # type: ignore[arg-type]
            faults.forget_sizes()
            faults.misspell()
            faults.duplicate()
            path.write_text("\n".join(faults.lines))
        reading, _ = fixed(folder, Settings())
        for document in reading.documents.values():
            document.save()
        assert read_machine(folder).machine == meant
        again, count = fixed(folder, Settings())
        assert count == 0
        assert not any(document.changed for document in again.documents.values())
