"""Every sample file makes the list it is for."""

import numpy as np
import pytest

from axcomp.cli import main
from axcomp.lists import read_machine
from axcomp.model import models

SAMPLES = models() / "measurements"
THREE = [
    "--chain",
    "YXZ",
    "--axes",
    "2",
    "1",
    "3",
    "--tool-position",
    "0",
    "0",
    "-100",
    "--tool-orientation",
    "0",
    "0",
    "-1",
]
FIVE = ["--chain", "CAYXZ", "--axes", "6", "4", "2", "1", "3", "--workpiece-axes", "2", *THREE[-8:]]
COMMANDS = {
    "tcp.csv": ["volumetric", *THREE],
    "tracker.csv": ["volumetric", *THREE],
    "ball_bar_lengths.csv": ["volumetric", "--nodes", "3", *THREE],
    "tracer.csv probe.csv": ["volumetric", "--nodes", "3", *FIVE],
    "plane.csv": ["plane", "--masters", "1", "2", "--axis", "3"],
    "crosstalk.csv": ["crosstalk", "--master", "1", "--adaptation", "1", "--axis", "3"],
    "sag.csv": ["cross", "--master", "1", "--axis", "3"],
    "x.rtl": ["leadscrew", "--axis", "1"],
    "x_outlier.csv": ["leadscrew", "--axis", "1", "--outliers", "drop"],
    "x.csv": ["backlash", "--axis", "1"],
}


@pytest.mark.parametrize("names", COMMANDS)
def test_a_sample_makes_its_list(tmp_path, monkeypatch, capsys, names):
    monkeypatch.chdir(tmp_path)
    kind, *words = COMMANDS[names]
    files = [str(SAMPLES / name) for name in names.split()]
    into = "vol_comp0.lis" if kind == "volumetric" else "new.lis"
    assert main(["create", kind, "--from", *files, "--into", into, *words]) == 0
    assert not capsys.readouterr().err
    if kind == "volumetric":
        (tmp_path / "hochlauf.lis").write_text("vol_comp[0].file_name vol_comp0.lis\nvol_comp[0].max_records 900\n")
        found = read_machine(tmp_path, strict=True).machine.volumetric[0]
        assert len(found.errors) > 12
        if "probe" in names:
            assert np.array(found.centers[0][1:]) == pytest.approx([12.3, -350.4], abs=0.3)


def test_the_sample_with_an_outlier_is_stopped(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    words = ["create", "leadscrew", "--from", str(SAMPLES / "x_outlier.csv"), "--into", "new.lis", "--axis", "1"]
    assert main(words) == 1
    assert "run 3, target 200 mm ↑: +12" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
