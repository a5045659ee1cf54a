"""``axcomp create`` as it is called."""

import json

import numpy as np
import pytest

from axcomp.cli import main
from axcomp.lists import read_machine


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Change to a folder with a measurement of each kind."""
    monkeypatch.chdir(tmp_path)
    targets = np.linspace(-100.0, 100.0, 9)
    rows = [f"{q},{run},{d},{0.02 * q + 0.1 * run}" for q in targets for run in (1, 2) for d in "+-"]
    (tmp_path / "x.csv").write_text("\n".join(rows))
    (tmp_path / "plane.csv").write_text("\n".join(f"{p},{q},{0.01 * p - 0.02 * q}" for p in targets for q in targets))
    (tmp_path / "friction.csv").write_text("\n".join(f"{v},{1000 * np.sign(v) + v}" for v in (-50, -5, 5, 50)))
    tests = [f"{a},{d},{0.004 * a},{p}" for a in (2000, -2000) for d in "+-" for p in (0, 100, 200)]
    (tmp_path / "tests.csv").write_text("acceleration,direction,deviation,position1\n" + "\n".join(tests))
    return tmp_path


COMMANDS = {
    "leadscrew": ["--from", "x.csv"],
    "cross": ["--from", "x.csv", "--master", "2"],
    "plane": ["--from", "plane.csv", "--masters", "2", "3"],
    "friction": ["--from", "friction.csv"],
    "crosstalk": ["--from", "tests.csv", "--master", "2", "--adaptation", "3"],
}


def test_all_kinds_go_into_one_list_one_after_the_other(folder, capsys):
    for kind, words in COMMANDS.items():
        assert main(["create", kind, *words, "--into", "new.lis", "--axis", "1", "--plot", f"{kind}.png"]) == 0
        assert (folder / f"{kind}.png").read_bytes().startswith(b"\x89PNG")
        out, err = capsys.readouterr()
        assert "Written to new.lis." in out
        assert "predicted" in out
        assert not err
    reading = read_machine("new.lis", strict=True)
    axis = reading.machine.axes[0]
    assert {one.kind for one in axis.compensations} == set(COMMANDS)
    assert (folder / "new.lis").read_text().count("kopf.achs_nr") == 1


def test_json_says_what_the_table_says(folder, capsys):
    assert main(["create", "leadscrew", "--from", "x.csv", "x.csv", "--into", "a.lis", "--axis", "1",
                 "--bound", "0.5", "--dry-run", "--format", "json"]) == 0  # fmt: skip
    found = json.loads(capsys.readouterr().out)
    assert found["figures"]["measured"]["E_up"] == pytest.approx(4.0)
    assert found["points"] == 2
    assert found["written"] is None
    assert not (folder / "a.lis").exists()


def test_the_list_can_be_written_elsewhere(folder):
    assert main(["create", "leadscrew", "--from", "x.csv", "--into", "a.lis", "--axis", "1"]) == 0
    before = (folder / "a.lis").read_bytes()
    words = ["--one-sided", "--output", "b.lis"]
    assert main(["create", "leadscrew", "--from", "x.csv", "--into", "a.lis", *words]) == 0
    assert (folder / "a.lis").read_bytes() == before
    assert b"kw.ssfk.bilateral                        0" in (folder / "b.lis").read_bytes()


NEW = ["--from", "x.csv", "--into", "a.lis", "--axis", "1"]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["leadscrew", *NEW[:4]], "a.lis: The list does not say which axis it is for"),
        (["leadscrew", *NEW, "--from", "none.csv"], "none.csv: The file cannot be read"),
        (["leadscrew", *NEW, "--into", "."], ".: The list cannot be read"),
        (["leadscrew", *NEW, "--into", "no/a.lis"], "axcomp: no/a.lis: No such file"),
        (["leadscrew", *NEW, "--bound", "0.001"], "axcomp create: values are rounded"),
        (["leadscrew", *NEW, "--max-points", "1"], "axcomp create: a table has two entries at least"),
        (["leadscrew", *NEW, "--on-top"], "axcomp create: no leadscrew compensation of this axis acts"),
        (["cross", *NEW], "axcomp create: the list does not say which axis is the master"),
        (["plane", *NEW], "x.csv:1: There are 4 cells for 3 columns."),
    ],
)
def test_faults_are_sentences(folder, capsys, words, sentence):
    assert main(["create", *words]) == 1
    out, err = capsys.readouterr()
    assert not out
    assert err.startswith(sentence)
    assert not (folder / "a.lis").exists()


@pytest.mark.parametrize("kind", COMMANDS)
def test_every_kind_has_help_with_an_example(kind, capsys):
    with pytest.raises(SystemExit) as stop:
        main(["create", kind, "--help"])
    assert stop.value.code == 0
    assert f"axcomp create {kind} --from" in capsys.readouterr().out
