"""``axcomp create`` loses nothing: what changes is shown, the old is kept, what others name stays."""

import json
import shutil

import numpy as np
import pytest

from axcomp.cli import main
from axcomp.lists import read_machine
from axcomp.model import models

SAMPLES = models() / "measurements"
LEADSCREW = ["create", "leadscrew", "--from", "x.csv", "--into", "a.lis", "--axis", "1"]
VOLUMETRIC = ["create", "volumetric", "--from", "tcp.csv", "--errors", "EXX"]
NEW = ["--chain", "XYZ", "--axes", "1", "2", "3"]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shutil.copy(SAMPLES / "x.csv", tmp_path)
    shutil.copy(SAMPLES / "axes.csv", tmp_path)
    rows = [f"{x},{y},{z},{0.02 * x},0,0" for x in (0, 100, 300) for y in (0, 200) for z in (0, 100)]
    (tmp_path / "tcp.csv").write_text("x,y,z,dx,dy,dz\n" + "\n".join(rows))
    return tmp_path


def test_a_dry_run_shows_what_would_change(folder, capsys):
    assert main([*LEADSCREW, "--dry-run"]) == 0
    out = capsys.readouterr().out
    assert "--- /dev/null\n+++ a.lis\n" in out
    assert "+kopf.achs_nr                             1" in out
    assert main(LEADSCREW) == 0
    assert main([*LEADSCREW, "--dry-run"]) == 0
    assert "+++" not in capsys.readouterr().out.rpartition("Written")[2]
    assert main([*LEADSCREW, "--one-sided", "--dry-run", "--format", "json"]) == 0
    diff = json.loads(capsys.readouterr().out)["diff"]
    assert any(line.startswith("-kw.ssfk.bilateral") for line in diff)
    assert not list(folder.glob("*.bak*"))


def test_what_was_there_is_kept_however_often(folder, capsys):
    assert main(LEADSCREW) == 0
    first = (folder / "a.lis").read_bytes()
    assert "What was there" not in capsys.readouterr().out
    assert main([*LEADSCREW, "--one-sided"]) == 0
    second = (folder / "a.lis").read_bytes()
    assert "What was there before is in a.lis.bak." in capsys.readouterr().out
    assert (folder / "a.lis.bak").read_bytes() == first
    assert main([*LEADSCREW, "--bound", "2"]) == 0
    assert (folder / "a.lis.bak").read_bytes() == first
    assert (folder / "a.lis.bak2").read_bytes() == second
    before = (folder / "a.lis").read_bytes()
    assert main([*LEADSCREW, "--bound", "2"]) == 0
    assert (folder / "a.lis").read_bytes() == before
    assert not (folder / "a.lis.bak3").exists()


def test_a_second_volumetric_list_gets_a_parameter_file_of_its_own(folder):
    """Tried before: vol_comp0.csv of the first list was overwritten without a word."""
    assert main([*VOLUMETRIC, "--into", "vol_comp0.lis", *NEW]) == 0
    first = (folder / "vol_comp0.csv").read_bytes()
    assert main([*VOLUMETRIC, "--into", "second.lis", *NEW]) == 0
    assert (folder / "vol_comp0.csv").read_bytes() == first
    assert "second.csv" in (folder / "second.lis").read_text()
    assert (folder / "second.csv").exists()


@pytest.mark.parametrize("name", ["second.csv", "SECOND.csv", ".\\second.csv"])
def test_a_file_that_another_list_names_is_not_overwritten(folder, capsys, name):
    (folder / "vol_comp0.lis").write_text(f"x 1\ny 2\nz 3\nfile[0] {name}\n")
    (folder / "second.csv").write_text("X0X\n0.001\n")
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert main([*VOLUMETRIC, "--into", "second.lis", *NEW]) == 1
    assert "second.lis: Its parameter file second.csv is not overwritten: vol_comp0.lis names it too." in (
        capsys.readouterr().err
    )
    (folder / "second.lis").write_text("x 1\ny 2\nz 3\nfile[0] second.csv\n")
    assert main([*VOLUMETRIC, "--into", "second.lis"]) == 1
    (folder / "second.lis").unlink()
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_another_place_that_a_list_names_is_not_overwritten(folder, capsys):
    (folder / "hochlauf.lis").write_text("zahl_kw 1\nachs_kw[0] other.lis\n")
    (folder / "other.lis").write_text("kopf.achs_nr 2\n")
    assert main([*LEADSCREW, "--output", "other.lis"]) == 1
    assert "other.lis is not overwritten: hochlauf.lis names it" in capsys.readouterr().err
    assert (folder / "other.lis").read_text() == "kopf.achs_nr 2\n"


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--chain", "YXZ"], "The list says XYZ, not YXZ as --chain does"),
        (["--chain", "XYZ", "--axes", "1", "2", "4"], "The list says X=1 Y=2 Z=3, not X=1 Y=2 Z=4 as --axes does"),
        (["--workpiece-axes", "1"], "The list says 0, not 1 as --workpiece-axes does"),
        (["--tool-position", "0", "0", "-150"], "The list says 0 0 0, not 0 0 -150 as --tool-position does"),
    ],
)
def test_kinematics_that_contradict_the_list_are_refused(folder, capsys, words, sentence):
    assert main([*VOLUMETRIC, "--into", "vol_comp0.lis", *NEW]) == 0
    before = (folder / "vol_comp0.csv").read_bytes()
    assert main([*VOLUMETRIC, "--into", "vol_comp0.lis", *words]) == 1
    assert sentence in capsys.readouterr().err
    assert main([*VOLUMETRIC, "--into", "vol_comp0.lis", *NEW]) == 0
    assert (folder / "vol_comp0.csv").read_bytes() == before


def test_of_several_axes_the_one_the_list_is_for_counts(folder, capsys):
    (folder / "hochlauf.lis").write_text(
        "zahl_kw 1\nachs_kw[0] y.lis\nachs_kw_log_ax_nr[0] 2\nzahl_mds 1\nachs_mds[0] md.lis\n"
    )
    (folder / "md.lis").write_text("kopf.achs_nr 2\nkopf.log_achs_name Y\nkenngr.achs_typ 1\nlr_param.ssfk 1\n")
    (folder / "y.lis").write_text("kopf.achs_nr 2\n")
    command = ["create", "leadscrew", "--from", "axes.csv", "--into", "y.lis"]
    assert main(command) == 0
    table = read_machine(folder).machine.axes[0].leadscrew
    assert table.positive[-1] < 0.0  # of Y, not of X
    assert main([*command, "--measured", "X"]) == 0
    assert read_machine(folder).machine.axes[0].leadscrew.positive[-1] > 0.0
    assert main([*command, "--measured", "Q"]) == 1
    assert "holds 2 measurements, of the axes X, Y" in capsys.readouterr().err


def test_a_forgotten_machine_is_said(tmp_path, capsys):
    (tmp_path / "p.csv").write_text("X.setpoint\n0\n1\n")
    with pytest.raises(SystemExit) as stop:
        main(["run", "p.csv"])
    assert stop.value.code == 2
    assert "--machine" in capsys.readouterr().err
    for option in ("--output", "--image"):
        assert main(["build", option, "x"]) == 2
        assert "--machine is missing" in capsys.readouterr().err
    assert not (tmp_path / "x").exists()


def test_rounded_tables_of_the_sample_files_agree(folder):
    for name in ("x.rtl", "x_german.csv", "axes.xlsx"):
        shutil.copy(SAMPLES / name, folder)
    tables = []
    for k, name in enumerate(("x.csv", "x.rtl", "x_german.csv", "axes.xlsx")):
        words = ["create", "leadscrew", "--from", name, "--into", f"{k}.lis", "--axis", "1", "--measured", "X"]
        assert main(words[:-2] if k < 3 else words) == 0
        tables.append(np.array(read_machine(folder / f"{k}.lis").machine.axes[0].leadscrew.positive))
    assert all(np.array_equal(one, tables[0]) for one in tables)
