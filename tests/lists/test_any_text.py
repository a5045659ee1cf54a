"""Whatever is in the files and whatever they are called: there is a machine and there are findings, no exception."""

from pathlib import Path
from tempfile import TemporaryDirectory

from hypothesis import given, settings, strategies as st
from strategies import machines

from axcomp.kinds import ListKind, Parameter
from axcomp.lists import CATALOGUE, Reading, read_machine, write_machine
from axcomp.model import AXES_MAX, Machine
from axcomp.runtime import compile_tables

NUMBERS = ("0", "1", "2", "3", "15", "-1", "0.5", "1e-300", "1e99", "140", "1000", "1e300", "0x4", "nan", "inf")
LIMITS = [str(number + i) for number in (2**15, 2**16, 2**31, 2**32, 2**63, -(2**15), -(2**31)) for i in (-1, 0)]
OTHERS = ("TRUE", "End", "...", ":", "QUADRATIC", "RECTANGULAR", "#", "/*", "(", "“", '"', ".", "..", "/", "\\")
FILES = ("achskw1.lis", "achsmd1.lis", "hochlauf.lis", "no.lis")
WORDS = st.sampled_from((*NUMBERS, *LIMITS, *OTHERS, *FILES))


@st.composite
def entry_lines(draw: st.DrawFn, rows: tuple[Parameter, ...]) -> str:
    """A line that is an entry of a list, more or less."""
    row = draw(st.sampled_from(rows))
    name = row.named(*draw(st.lists(st.integers(0, 16), min_size=2, max_size=2)))
    return f"{name} {draw(WORDS | st.integers(-5, 10**6).map(str) | st.text(max_size=5))}"


def texts(kind: ListKind) -> st.SearchStrategy[str]:
    return st.lists(entry_lines(CATALOGUE[kind]) | st.text(max_size=20), max_size=60).map("\n".join)


def check(reading: Reading) -> None:
    """Check what always holds of a reading: it compiles, its axes are told apart, findings are sentences."""
    machine, findings = reading.machine, reading.findings
    if any(axis.compensations for axis in machine.axes):
        compile_tables(machine)
    assert len(machine.axes) <= AXES_MAX
    assert len({axis.number for axis in machine.axes}) == len({axis.name for axis in machine.axes}) == len(machine.axes)
    for finding in findings:
        assert finding.message.endswith(".")
        assert finding.line >= 0


def read_files(files: dict[str, bytes]) -> Reading:
    with TemporaryDirectory() as folder:
        for name, data in files.items():
            Path(folder, name).write_bytes(data)
        reading = read_machine(folder)
        assert set(read_machine(folder).documents) <= {Path(folder, name) for name in files}
    return reading


@given(st.binary(max_size=300))
def test_any_bytes_are_read(data: bytes) -> None:
    for mark in (b"", b"\xff\xfe", b"\xfe\xff"):
        check(read_files({"achskw1.lis": mark + data}))
    check(read_files({"hochlauf.lis": data}))


@given(st.text(max_size=300))
def test_any_text_is_read(text: str) -> None:
    data = text.encode("utf-8", "surrogatepass")
    check(read_files({"hochlauf.lis": b"zahl_kw 1\nachs_kw[0] achskw1.lis\n" + data, "achskw1.lis": data}))


@given(texts(ListKind.START_UP), texts(ListKind.AXIS), texts(ListKind.COMPENSATION))
@settings(max_examples=100)
def test_any_entries_are_read(start_up: str, axis: str, compensation: str) -> None:
    lists = "\nzahl_kw 1\nachs_kw[0] achskw1.lis\nzahl_mds 1\nachs_mds[0] achsmd1.lis\n"
    for files in (
        {"hochlauf.lis": start_up + lists, "achskw1.lis": compensation, "achsmd1.lis": axis},
        {"achskw1.lis": compensation, "achskw2.lis": axis},
    ):
        check(read_files({name: text.encode("utf-8", "surrogatepass") for name, text in files.items()}))


@given(machines(), st.data())
@settings(max_examples=60)
def test_damaged_lists_are_read(machine: Machine, data: st.DataObject) -> None:
    with TemporaryDirectory() as folder:
        files = write_machine(machine, folder)
        for _ in range(data.draw(st.integers(1, 5))):
            path = data.draw(st.sampled_from(files))
            path.write_bytes(damaged(path.read_bytes(), data))
        check(read_machine(folder))


def damaged(content: bytes, data: st.DataObject) -> bytes:
    """Change a list in one place: cut it off, lose a line, swap words, double a line or write into it."""
    lines = content.split(b"\n")
    place = data.draw(st.integers(0, len(lines) - 1))
    match data.draw(st.sampled_from(("cut", "lose", "word", "double", "byte"))):
        case "cut":
            return content[: data.draw(st.integers(0, len(content)))]
        case "lose":
            del lines[place]
        case "word":
            name = lines[place].split(b" ")[0]
            lines[place] = name + b" " + data.draw(WORDS).encode()
        case "double":
            lines.insert(place, data.draw(st.sampled_from(lines)))
        case "byte":
            lines[place] = lines[place][:5] + data.draw(st.binary(max_size=3)) + lines[place][5:]
    return b"\n".join(lines)


@given(st.text(max_size=40) | st.text("./\\:~ aC*?\0ü", max_size=20))
def test_any_file_name_is_found_or_missing(name: str) -> None:
    quoted = name.replace("\n", "").replace('"', "")
    text = f'zahl_kw 1\nachs_kw[0] "{quoted}"\nzahl_mds 1\nachs_mds[0] "{quoted}"\ndefault_achs_mds "{quoted}"\n'
    check(read_files({"hochlauf.lis": text.encode("utf-8", "surrogatepass"), "achskw1.lis": b"kopf.achs_nr 1\n"}))


@given(st.text(max_size=40) | st.just("a" * 5000) | st.just("\0"))
def test_any_path_is_read_or_refused(path: str) -> None:
    with TemporaryDirectory() as folder:
        check(read_machine(Path(folder, "no") / path))
