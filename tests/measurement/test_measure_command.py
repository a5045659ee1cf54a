"""``axcomp measure`` as it is called."""

import argparse
import json

import pytest

from axcomp.cli.measure import add_subparser

TABLE = "".join(
    f"{target},{run},{direction},{0.01 * target + 0.1 * run + (0.5 if direction == '-' else 0)}\n"
    for target in range(0, 101, 25)
    for run in range(1, 6)
    for direction in "+-"
)


@pytest.fixture
def measure(tmp_path, monkeypatch, capsys):
    """Run the command in a folder with x.csv; return exit status, output and errors."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "x.csv").write_text(TABLE)

    def run(*words):
        parser = argparse.ArgumentParser(prog="axcomp")
        add_subparser(parser.add_subparsers(required=True))
        args = parser.parse_args(["measure", *words])
        status = args.do(args)
        return status, *capsys.readouterr()

    return run


def test_tables_show_every_target_and_figure(measure):
    status, out, err = measure("x.csv", "--drift", "0.5")
    assert status == 0
    assert not err
    for piece in ("target [mm]", "x̄↑", "ISO 230-2:2014", "A↓", "B̄", "-0.50", "U (k = 2)"):
        assert piece in out
    assert not any(line.endswith("…") for line in out.splitlines())


def test_json_holds_all_results(measure):
    status, out, _ = measure("x.csv", "x.csv", "--format", "json")
    results = json.loads(out)
    assert status == 0
    assert len(results) == 2
    assert results[0]["parameters"]["B"] == pytest.approx(0.5)
    assert results[0]["parameters"]["E_up"] == pytest.approx(1.0)


def test_files_of_one_measurement_are_evaluated_together(measure):
    _, out, _ = measure("x.csv", "x.csv", "--together", "--format", "json")
    [result] = json.loads(out)
    assert result["targets"][0]["count_up"] == 10


def test_pictures_are_written(measure, tmp_path):
    status, _, _ = measure("x.csv", "x.csv", "--plot", "p.png")
    assert status == 0
    assert (tmp_path / "p.png").read_bytes().startswith(b"\x89PNG")


def test_faults_are_sentences_and_the_status_counts_them(measure, tmp_path):
    (tmp_path / "bad.csv").write_text("0,1,+,one\n")
    status, out, err = measure("bad.csv", "none.csv", "x.csv")
    assert status == 2
    assert err.splitlines() == [
        "bad.csv:1: “one” is no number, as deviation has to be.",
        "none.csv: The file cannot be read: No such file or directory.",
    ]
    assert "x.csv" in out


@pytest.mark.parametrize("words", [("--drift", "-1"), ("--plot", "nowhere/p.png"), ("--plot", "p.docx")])
def test_what_cannot_be_done_is_said(measure, words):
    status, _, err = measure("x.csv", *words)
    assert status == 1
    assert err.startswith("axcomp measure: ")
    assert "Errno" not in err
