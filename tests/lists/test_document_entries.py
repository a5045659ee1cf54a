"""Documents: where entries stand, what a change leaves alone, and files that are written whole or not at all."""

import os
import re
from decimal import Decimal
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from axcomp.kinds import DataType, ListKind
from axcomp.lists import CATALOGUE, Document, read_machine
from axcomp.saving import write_whole

LIST = """\
# Maß
  kopf.achs_nr\t 1   (axis X)
kopf.log_achs_name "X 1" (its name)
kw.ssfk.table[ 3].pos  -12.5 third
kw.unknown 7 what
End
kw.ssfk.table[4].pos 5
"""


def document(text: str = LIST, encoding: str = "utf-8") -> Document:
    return Document("achskw1.lis", text.encode(encoding), ListKind.COMPENSATION)


def test_entries_know_where_they_stand() -> None:
    found = [(e.name, e.value, e.comment, e.line, e.column, e.value_column) for e in document().entries]
    assert found == [
        ("kopf.achs_nr", "1", "(axis X)", 2, 3, 17),
        ("kopf.log_achs_name", '"X 1"', "(its name)", 3, 1, 20),
        ("kw.ssfk.table[3].pos", "-12.5", "third", 4, 1, 24),
        ("kw.unknown", "7", "what", 5, 1, 12),
    ]
    for entry in document().entries:
        line = LIST.split("\n")[entry.line - 1]
        assert line[entry.value_column - 1 :].startswith(entry.value)
    assert [entry.parameter is None for entry in document().entries] == [False, False, False, True]


@pytest.mark.parametrize(
    ("encoding", "mark"),
    [("utf-8", ""), ("utf-8", "\ufeff"), ("utf-16-le", "\ufeff"), ("utf-16-be", "\ufeff"), ("latin-1", "")],
)
def test_encoding_and_line_ends_are_kept(encoding: str, mark: str) -> None:
    text = mark + "# Maß\r\nkopf.achs_nr 1\nkopf.log_achs_name X\rkw.ssfk.interval 5"
    one = document(text, encoding)
    one.set("kopf.log_achs_name", "Ä")
    one.set("kw.ssfk.interval", 6)
    wanted = text.replace("name X", "name Ä").replace("interval 5", "interval 6").encode(encoding)
    assert one.changed
    assert one.to_bytes() == wanted
    assert (one.encoding, one.newline) == ((encoding, bool(mark)), "\r\n")


COMMENTED = """\
kw.ssfk.kw_nr_max 2 /* as many
as there are */
kw.ssfk.table[0].pos 1 /* first
End
kw.ssfk.table[0].pos 7 */
kw.ssfk.table[1].pos 2 /* second
and last */
"""


def test_nothing_is_put_into_a_comment_or_left_of_one() -> None:
    one = document(COMMENTED)
    one.set("kw.ssfk.table[i].neg", 5, 0)
    one.set("kw.ssfk.table[i].neg", 6, 1)
    one.set("kopf.achs_nr", 1)
    one.set("kw.ssfk.kw_nr_max", 3)
    added = [f"{name:<40} {value}" for name, value in (("kw.ssfk.table[0].neg", 5), ("kw.ssfk.table[1].neg", 6))]
    lines = COMMENTED.replace("max 2", "max 3").split("\n")
    assert one.text.split("\n") == [*lines[:5], added[0], *lines[5:7], added[1], f"{'kopf.achs_nr':<40} 1", ""]
    one.remove("kw.ssfk.table[i].pos", 0)
    assert one.text.split("\n")[2:5] == [added[0], *lines[5:7]]
    one.replace_entries(["kw.ssfk.table[1].pos 9"], ["kw.ssfk.table[i].pos"], "Table", keep_row_comments=False)
    assert one.text.split("\n")[3:5] == ["kw.ssfk.table[1].pos 9", added[1]]


def test_joined_bits_are_replaced_together() -> None:
    one = Document("md.lis", b"kenngr.achs_mode ACHSMODE_MODULO | 0x800 (turntable)\n", ListKind.AXIS)
    one.set("kenngr.achs_mode", 1)
    assert one.text.split() == ["kenngr.achs_mode", "1", "(turntable)"]


@pytest.mark.parametrize(
    ("name", "value", "indices", "line"),
    [
        ("kw.ssfk.table[i].pos", 7, (3,), "kw.ssfk.table[ 3].pos  7     third"),
        ("KW.SSFK.TABLE[3].POS", Decimal("1e2"), (), "kw.ssfk.table[ 3].pos  100   third"),
        ("kw.ssfk.table[].pos", 123456.5, (3,), "kw.ssfk.table[ 3].pos  123456.5 third"),
        ("kopf.achs_nr", "0x1F", (), "  kopf.achs_nr\t 0x1F   (axis X)"),
        ("kopf.log_achs_name", "A 2 (b)", (), 'kopf.log_achs_name "A 2 (b)" (its name)'),
    ],
)
def test_a_value_is_set_in_its_line(name: str, value: object, indices: tuple[int, ...], line: str) -> None:
    one = document()
    one.set(name, value, *indices)
    changed = [new for old, new in zip(LIST.split("\n"), one.text.split("\n"), strict=True) if old != new]
    assert changed == [line]


def test_a_new_entry_comes_behind_those_of_its_table_or_before_the_end() -> None:
    one = document()
    one.set("kw.ssfk.table[i].neg", 9, 3)
    one.set("kw.ssfk.table[i].neg", 8, 1)
    one.set("frict_comp.mode", 1)
    written = [(entry.name, entry.value) for entry in one.entries]
    assert written[2:] == [
        ("kw.ssfk.table[3].pos", "-12.5"),
        ("kw.ssfk.table[3].neg", "9"),
        ("kw.unknown", "7"),
        ("kw.ssfk.table[1].neg", "8"),
        ("frict_comp.mode", "1"),
    ]
    assert one.text.endswith("End\nkw.ssfk.table[4].pos 5\n")


def test_an_entry_is_removed_each_time_it_is_given() -> None:
    one = document("kw.ssfk.interval 1\r\n# stays\nKW.SSFK.INTERVALL 2\r\n")
    one.remove("kw.ssfk.interval")
    assert one.to_bytes() == b"# stays\n"
    with pytest.raises(ValueError, match="has no entry"):
        one.remove("kw.ssfk.interval")


@pytest.mark.parametrize(
    ("name", "value", "sentence"),
    [
        ("kw.ssfk.nothing", 1, r"a list achskw\*.lis has no entry kw.ssfk.nothing"),
        ("kw.ssfk.table[i].pos", 1, "needs 1 indices, not 0"),
        ("kw.ssfk.interval", float("nan"), "cannot be nan"),
        ("kw.ssfk.interval", "1 2", "cannot be '1 2'"),
        ("kopf.log_achs_name", 'a"b\n', "cannot be"),
        ("kopf.log_achs_name", "a\0", "cannot be"),
    ],
)
def test_what_a_list_cannot_hold_is_refused_and_changes_nothing(name: str, value: object, sentence: str) -> None:
    one = document()
    with pytest.raises(ValueError, match=sentence):
        one.set(name, value)
    assert not one.changed


ROWS = [row for row in CATALOGUE[ListKind.COMPENSATION] if not row.values and not row.index_max]
NAMES = st.sampled_from(ROWS).flatmap(
    lambda row: st.tuples(st.just(row), st.tuples(*[st.integers(0, 3)] * row.name.count("[")))
)
BLANKS = st.sampled_from(["", " ", "\t "])
VALUES = st.sampled_from(["", "5", "-0.5", "x", '"a b"', "a/*b*/", "7(c)"])
COMMENTS = st.sampled_from(["", " ", " # why", " (why ß)", "\t/* why */ ", " /* why"])


@st.composite
def entry_lines(draw: st.DrawFn) -> str:
    row, indices = draw(NAMES)
    name = row.named(*indices) if indices else row.name
    name = draw(st.sampled_from([name, name.upper(), name.replace("[", "[ ")]))
    return draw(BLANKS) + name + " " + draw(BLANKS) + draw(VALUES) + draw(COMMENTS)


LINES = st.lists(
    st.tuples(
        st.one_of(entry_lines(), st.sampled_from(["", "# ß", "…", "kw.stranger 1", "\x1a", " 5"])),
        st.sampled_from(["\n", "\r\n", "\r"]),
    ),
    max_size=12,
)


def _split(data: bytes) -> list[bytes]:
    return re.split(rb"(?<=\n)|(?<=\r)(?!\n)", data)


@settings(deadline=None, max_examples=300)
@given(LINES, st.sampled_from(["utf-8", "utf-8-sig", "latin-1"]), st.booleans(), st.data())
def test_a_set_entry_reads_back_and_every_other_byte_stays(
    lines: list[tuple[str, str]], encoding: str, closed: bool, data: st.DataObject
) -> None:
    text = "".join(line + newline for line, newline in lines)
    before = (text if closed else text[:-1]).encode(encoding, "ignore")
    one = Document("a.lis", before, ListKind.COMPENSATION)
    known = [entry for entry in one.entries if entry.parameter in ROWS]
    if not known:
        return
    entry = data.draw(st.sampled_from(known))
    assert entry.parameter is not None
    if entry.parameter.type is DataType.STRING:
        value = data.draw(st.sampled_from(["A", "a b", "(x)", ""]))
    else:
        low, high = max(-(10**6), entry.parameter.plausible.low + 1), min(10**6, entry.parameter.plausible.high - 1)
        value = data.draw(st.integers(low, max(low, high)))
    one.set(entry.parameter.name, value, *entry.indices)
    after = one.to_bytes()
    # Of an entry that is given twice, the later one counts.
    last = max(e.line for e in known if (e.parameter, e.indices) == (entry.parameter, entry.indices))
    for again in (one, Document("a.lis", after, ListKind.COMPENSATION)):
        assert again.values.value(entry.parameter.name, *entry.indices) == value
        assert again.values.line(entry.parameter.name, *entry.indices) == last
    old, new = _split(before), _split(after)
    assert len(old) == len(new)
    assert [i for i, (a, b) in enumerate(zip(old, new, strict=True), 1) if a != b] in ([], [last])
    changed = next(e for e in one.entries if e.line == last)
    kept = next(e for e in known if e.line == last)
    assert (changed.column, changed.key, changed.comment) == (kept.column, kept.key, kept.comment)
    assert one.entries == Document("a.lis", after, ListKind.COMPENSATION).entries


def test_saving_writes_the_file_and_keeps_who_may_read_it(tmp_path: Path) -> None:
    path = tmp_path / "a.lis"
    path.write_bytes(b"kopf.achs_nr 1\n")
    path.chmod(0o640)
    one = Document(path, path.read_bytes(), ListKind.COMPENSATION)
    one.set("kopf.achs_nr", 2)
    one.save()
    assert path.read_bytes() == b"kopf.achs_nr 2\n"
    assert not one.changed
    assert os.name == "nt" or path.stat().st_mode & 0o777 == 0o640
    assert list(tmp_path.iterdir()) == [path]


def test_what_is_not_changed_is_not_written(tmp_path: Path) -> None:
    one = Document(tmp_path / "no" / "a.lis", b"kopf.achs_nr 1\n", ListKind.COMPENSATION)
    one.set("kopf.achs_nr", 1)
    one.save()
    assert not (tmp_path / "no").exists()


@pytest.mark.parametrize("fails", ["write", "fsync", "replace"])
def test_a_disk_that_is_full_leaves_the_old_file(fails: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.lis"
    path.write_bytes(b"kopf.achs_nr 1\n")
    one = Document(path, path.read_bytes(), ListKind.COMPENSATION)
    one.set("kopf.achs_nr", 2)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    class _Full:
        def __init__(self, file: object) -> None:
            self.file = file

        def __enter__(self) -> "_Full":
            return self

        def __exit__(self, *_: object) -> None:
            self.file.close()

        def write(self, data: bytes) -> None:
            self.file.write(data[: len(data) // 2])
            full()

    if fails == "fsync":
        monkeypatch.setattr(os, "fsync", full)
    elif fails == "replace":
        monkeypatch.setattr(Path, "replace", full)
    else:
        opened = Path.open
        monkeypatch.setattr(Path, "open", lambda self, *mode: _Full(opened(self, *mode)))
    with pytest.raises(OSError, match="No space left") as raised:
        one.save()
    monkeypatch.undo()
    assert raised.value.filename == str(path)
    assert path.read_bytes() == b"kopf.achs_nr 1\n"
    assert list(tmp_path.iterdir()) == [path]
    assert one.changed


def test_links_and_pipes_stay_what_they_are(tmp_path: Path) -> None:
    if os.name == "nt":
        pytest.skip("links need rights there")
    (tmp_path / "a.lis").write_bytes(b"old")
    (tmp_path / "link.lis").symlink_to("a.lis")
    write_whole(tmp_path / "link.lis", b"new")
    assert (tmp_path / "link.lis").is_symlink()
    assert (tmp_path / "a.lis").read_bytes() == b"new"
    write_whole(os.devnull, b"gone")
    assert not Path(os.devnull).is_file()


FILES = {
    "cnc/hochlauf.lis": "zahl_mds 1\nachs_mds[0] ..\\Lists\\md.lis\nzahl_kw 2\nachs_kw[0] KW.lis\nachs_kw[1] no.lis\n",
    "lists/md.lis": "kopf.achs_nr 1\nkopf.log_achs_name X\nlr_param.ssfk 1\n",
    "cnc/kw.lis": "kopf.achs_nr 1\nkw.ssfk.unit 1\nkw.ssfk.interval 10\nkw.ssfk.kw_nr_max 2\n"
    "kw.ssfk.table[0].pos 1\n  kw.ssfk.table[1].pos x\n",
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path / "cnc"


def test_a_reading_says_which_document_is_which(folder: Path) -> None:
    reading = read_machine(folder, allow_outside=[folder.parent])
    assert [path.name for path in reading.documents] == ["hochlauf.lis", "md.lis", "kw.lis"]
    assert [one.path.name for one in (reading.start_up, reading.axis_list(1), reading.compensation_list(1))] == [
        "hochlauf.lis",
        "md.lis",
        "kw.lis",
    ]
    assert reading.axis_list(2) is None
    assert [path.read_bytes() for path in reading.documents] == [one.data for one in reading.documents.values()]


def test_documents_held_in_memory_are_a_machine_like_files(folder: Path) -> None:
    reading = read_machine(folder)
    held = read_machine("cnc", documents=[Document(name, text.encode()) for name, text in FILES.items()])
    assert held.machine == reading.machine
    root = f"{folder.parent}{os.sep}"
    assert list(map(str, held.findings)) == [str(finding).replace(root, "") for finding in reading.findings]
    assert len(held.findings) == 4


def test_only_what_was_changed_is_parsed_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    reading = read_machine(folder)
    for name in FILES:
        (folder.parent / name).unlink()
    assert reading.again().machine == reading.machine
    assert reading.again().findings == reading.findings
    parsed = []

    def noted(text: str, file: str, *rest: object) -> object:
        parsed.append(Path(file).name)
        return read_values(text, file, *rest)

    from axcomp.lists import document as module

    read_values = module.read_values
    monkeypatch.setattr(module, "read_values", noted)
    reading.compensation_list(1).set("kw.ssfk.table[1].pos", 20)
    again = reading.again()
    assert parsed == ["kw.lis"]
    assert again.machine.axes[0].leadscrew.positive == (1e-4, 2e-3)
    assert {f.code for f in reading.findings} - {f.code for f in again.findings} == {"AXC-ZEROED"}


def test_findings_know_the_column_of_their_entry(folder: Path) -> None:
    found = {(f.code, f.line): f.column for f in read_machine(folder, allow_outside=[folder.parent]).findings}
    assert found == {("AXC-PATH", 2): 1, ("AXC-PATH", 4): 1, ("AXC-MISSING", 5): 1, ("AXC-ZEROED", 6): 3}


def test_a_string_that_loses_its_quotes_does_not_swallow_the_comment_behind_it() -> None:
    document = Document("a.lis", b'kopf.log_achs_name "a b"   # why\n', ListKind.COMPENSATION)
    document.set("kopf.log_achs_name", "A")
    assert document.to_bytes() == b'kopf.log_achs_name "A"     # why\n'
    assert document.values.value("kopf.log_achs_name") == "A"
