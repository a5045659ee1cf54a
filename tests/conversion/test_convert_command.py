"""``axcomp convert`` as a user meets it: files, sentences and exit status."""

import argparse
import json
from pathlib import Path

import pytest

from axcomp.cli import convert, main
from axcomp.kinds import Cross, Leadscrew, Plane
from axcomp.lists import read_machine, write_machine
from axcomp.model import Axis, Machine

SCREW = Leadscrew((0.0, 10.0, 20.0), (0.0, 0.004, 0.001), (0.002, 0.005, 0.003), manual_activation=True)
MACHINE = Machine(
    (
        Axis(1, "X", leadscrew=SCREW, plane=Plane(2, 3, 0.0, 0.0, 1.0, 1.0, ((0.0, 0.1), (0.0, 0.1)))),
        Axis(2, "Y", leadscrew=Leadscrew((-5.0, 5.0, 15.0), (0.0, 0.004, 0.001))),
        Axis(3, "Z", cross=Cross(1, (0.0, 10.0), (0.0, 0.01))),
    )
)


def _run(*arguments: str | Path) -> int:
    parser = argparse.ArgumentParser()
    convert.add_subparser(parser.add_subparsers(required=True))
    args = parser.parse_args(["convert", *map(str, arguments)])
    status: int = args.do(args)
    return status


@pytest.fixture
def lists(tmp_path: Path) -> Path:
    write_machine(MACHINE, tmp_path / "lists")
    return tmp_path / "lists"


def test_a_table_goes_out_and_comes_back_into_the_machine(
    lists: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "x.mpf"
    assert _run(lists, "--axis", "X", "--kind", "leadscrew", "--to", "cec", "--output", file) == 0
    report = capsys.readouterr().out
    assert "the leadscrew table of X: 3 points, written 3; largest difference 0.0000 µm" in report
    assert "switched on by command only; the other format does not say so" in report
    assert _run(file, "--to", "lists", "--machine", lists, "--output", tmp_path / "new") == 0
    assert read_machine(tmp_path / "new").machine == MACHINE


def test_without_output_the_file_goes_to_standard_output_and_the_report_beside_it(
    lists: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert _run(lists, "--axis", "Y", "--to", "linuxcnc-1") == 0
    printed = capsys.readouterr()
    assert printed.out == "-5 0 0\n5 -0.004 -0.004\n15 -0.001 -0.001\n"
    assert "largest difference" in printed.err


def test_the_report_is_json_on_request(lists: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert _run(lists, "--axis", "Z", "--to", "csv", "--output", tmp_path / "z.csv", "--format", "json") == 0
    [table] = json.loads(capsys.readouterr().out)["tables"]
    assert (table["axis"], table["over"], table["kind"], table["written_points"]) == ("Z", "X", "cross", 2)
    assert table["largest_difference"] == 0.0


def test_formats_are_told_by_their_content(lists: Path, tmp_path: Path) -> None:
    for name in ("enc-comp", "cec", "heidenhain", "itnc", "csv"):
        assert _run(lists, "--axis", "Y", "--to", name, "--output", tmp_path / "y") == 0
        assert _run(tmp_path / "y", "--to", "lists", "--output", tmp_path / name) == 0
        assert read_machine(tmp_path / name).machine.axes[0].leadscrew == MACHINE.axes[1].leadscrew


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("--to", "csv"), "the plane compensation of X is a table over two axes"),
        (("--axis", "Q", "--to", "csv"), "there is no axis 'Q'"),
        (("--axis", "X", "--kind", "leadscrew", "--to", "enc-comp"), "is bilateral"),
        (("--axis", "Y", "--to", "lists"), "with --output"),
        (("--axis", "Y", "--to", "csv", "--within", "-1"), "--within must be 0 µm or more"),
        (("--axis", "Y", "--to", "csv", "--to-inch"), "in mm only"),
    ],
)
def test_a_refusal_is_one_sentence(
    lists: Path, arguments: tuple[str, ...], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert _run(lists, *arguments) == 1
    assert sentence in capsys.readouterr().err


def test_a_wrong_file_is_named_with_its_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "joint.comp"
    file.write_text("0 0 0\n1 one 1\n")
    assert _run(file, "--from", "linuxcnc-0", "--axis", "X", "--to", "csv") == 1
    assert capsys.readouterr().err == f"{file}:2: error: forward must be a number, not 'one'\n"


@pytest.mark.parametrize("content", [b"\x00\x01\x02", b"G1 X0", b""])
def test_a_file_of_no_format_is_refused(content: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "what"
    file.write_bytes(content)
    assert _run(file, "--to", "csv") == 1
    assert capsys.readouterr().err.startswith(f"{file}:0: error: ")
    assert main(["convert", str(tmp_path / "missing"), "--to", "csv"]) == 1
    assert capsys.readouterr().err == f"axcomp: {tmp_path / 'missing'}: No such file or directory\n"


def test_help_shows_an_example_and_every_format(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        _run("--help")
    assert caught.value.code == 0
    text = capsys.readouterr().out
    assert all(word in text for word in ("examples:", "enc-comp", "cec", "heidenhain", "linuxcnc-1", "csv", "lists"))
