"""Whole sweeps: the rows are those of engines run by hand, whatever fails, stops or goes on in between."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from axcomp import Engine
from axcomp.fmu import package_axcomp
from axcomp.model import models
from axcomp.sweep import ERROR, Journal, job_of, keys_of, perform, read_spec, run_sweep

MODEL = models() / "three_axis"
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(models().parent)}


def spec_of(folder: Path, **changes):
    content = {
        "machine": str(MODEL),
        "input": {"file": str(MODEL / "input.csv")},
        "vary": {"scale Y.leadscrew": [0.0, 1.0, 2.0], "input X.plane.switch": [-1, 1]},
        "results": {
            "peak": "peak X.correction",
            "rms": "rms Y.corrected_setpoint - Y.setpoint",
            "at": "at 0.5 Z.correction",
        },
    }
    (folder / "sweep.json").write_text(json.dumps({**content, **changes}))
    return read_spec(folder / "sweep.json")


def rows_of(spec):
    job, _ = job_of(spec)
    return [perform(job, run) for run in spec.every_run()]


def test_rows_are_those_of_an_engine_run_by_hand(tmp_path: Path) -> None:
    rows = rows_of(spec_of(tmp_path))
    table = np.genfromtxt(MODEL / "input.csv", delimiter=",", names=True, deletechars="")
    inputs = {name: table[name] for name in table.dtype.names if name != "time"}
    for row, switch in ((rows[2], -1), (rows[3], 1)):
        result = Engine(MODEL).run({**inputs, "X.plane.switch": np.full(len(table), switch)})
        assert row[ERROR] == ""
        assert row["peak"] == np.abs(result["X.correction"]).max()
        assert row["rms"] == pytest.approx(
            np.sqrt(np.mean((result["Y.corrected_setpoint"] - inputs["Y.setpoint"]) ** 2)), rel=1e-12
        )
        assert row["at"] == result["Z.correction"][500]
    assert rows[0]["rms"] != rows[2]["rms"]


def test_a_bad_run_has_its_error_in_its_row_and_stops_no_other(tmp_path: Path) -> None:
    spec = spec_of(
        tmp_path,
        vary={"parameter duration": [0.1, 1.0]},
        runs=[{}, {"input Q.setpoint": 1}, {"achsmd2.lis: lr_param.ssfk": 0}],
        results={"at": "at 0.5 Y.leadscrew.correction"},
    )
    errors = [row[ERROR] for row in rows_of(spec)]
    assert errors[0] == "at: at 0.5 s: the run ends at 0.099 s"
    assert errors[1] == ""
    assert errors[2].startswith("Q.setpoint is no input; the inputs are reset")
    assert errors[5].startswith("at: there is no variable Y.leadscrew.correction in this run; there are ")


def test_what_a_change_gives_rise_to_stands_in_the_row(tmp_path: Path) -> None:
    key = "achskw2.lis: kw.ssfk.kw_nr_max"
    spec = spec_of(tmp_path, vary={key: [100, 99999]})
    good, bad = rows_of(spec)
    assert "kw_nr_max" not in good["findings"]
    assert "achskw2.lis" in bad["findings"]
    assert str(tmp_path) not in bad["findings"]


def test_what_is_known_of_the_lists_as_they_are_is_said_once_not_in_every_row(tmp_path: Path) -> None:
    lists = tmp_path / "lists"
    shutil.copytree(MODEL, lists)
    text = (lists / "achskw2.lis").read_text()
    (lists / "achskw2.lis").write_text(f"kw.ssfk.nothing 1\nkw.ssfk.n_cycels 1\n{text}")
    spec = spec_of(tmp_path, machine=str(lists), vary={"achskw2.lis: kw.ssfk.kw_nr_max": [61, 99999]})
    job, said = job_of(spec)
    assert [sum(name in text for text in said) for name in ("kw.ssfk.nothing", "n_cycels")] == [1, 1]
    good, bad = (perform(job, run) for run in spec.every_run())
    assert (good["findings"], good[ERROR]) == ("", "")
    assert "nothing" not in bad["findings"]
    assert "n_cycels" not in bad["findings"]
    assert "kw_nr_max" in bad["findings"]


def test_cycle_time_and_feed_are_parameters_of_a_run(tmp_path: Path) -> None:
    motion = {"start": {"X": 0.0}, "moves": [{"X": 40.0}]}
    spec = spec_of(
        tmp_path,
        input=motion,
        vary={"parameter velocity": [50.0, 100.0], "parameter cycle_time": [0.001, 0.002]},
        results={"v": "max X.velocity", "last": "last X.setpoint"},
    )
    rows = rows_of(spec)
    assert [row["last"] for row in rows] == [40.0] * 4
    assert [row["v"] for row in rows] == pytest.approx([50.0, 50.0, 100.0, 100.0], rel=1e-6)


def test_keys_change_with_everything_that_decides_a_row(tmp_path: Path) -> None:
    def key(**changes):
        spec = spec_of(tmp_path, **changes)
        job, _ = job_of(spec)
        return keys_of(job, list(spec.every_run()))

    base = key()
    assert len(set(base)) == 6
    assert key() == base
    longer = key(vary={"scale Y.leadscrew": [1.0, 2.0, 3.0], "input X.plane.switch": [-1, 1]})
    assert set(longer) & set(base) == set(base[2:])
    for changes in (
        {"cycle_time": 0.002},
        {"duration": 0.5},
        {"results": {"peak": "max X.correction"}},
        {"input": {"start": {"X": 0}, "moves": [{"X": 1}]}},
        {"machine": str(models() / "three_axis" / "achskw1.lis")},
    ):
        assert not set(key(**changes)) & set(base), changes


def test_a_journal_that_was_cut_off_loses_its_last_row_only(tmp_path: Path) -> None:
    path = tmp_path / "r.csv.journal"
    with Journal(path) as journal:
        for k in range(3):
            journal.add(f"key{k}", {"a": k / 3, ERROR: "bad" if k == 1 else ""})
    whole = path.read_text()
    path.write_text(whole[:-9])
    with Journal(path) as journal:
        assert list(journal.rows()) == ["key0", "key1"]
        assert list(journal.rows(failed=False)) == ["key0"]
        journal.add("key2", {"a": 2 / 3, ERROR: ""})
        assert {key: row["a"] for key, row in journal.rows().items()} == {"key0": 0.0, "key1": 1 / 3, "key2": 2 / 3}


def test_a_finished_half_is_taken_over_and_the_rows_are_the_same(tmp_path: Path) -> None:
    """No cluster is needed where nothing is missing; the rest is what the slow test runs."""
    spec = spec_of(tmp_path)
    job, _ = job_of(spec)
    runs = list(spec.every_run())
    with Journal(tmp_path / "r.csv.journal") as journal:
        for run, key in reversed(list(zip(runs, keys_of(job, runs), strict=True))):
            journal.add(key, perform(job, run))
    told = []
    sweep = run_sweep(spec, job, tmp_path / "r.csv", progress=lambda *counts: told.append(counts))
    assert told == [(6, 6)]
    assert sweep.taken_over == 6
    assert not (tmp_path / "r.csv.journal").exists()
    written = pd.read_csv(tmp_path / "r.csv", keep_default_na=False)
    assert written["run"].tolist() == list(range(6))
    assert written["peak"].tolist() == [row["peak"] for row in rows_of(spec)]


def test_a_picture_has_a_line_for_each_combination_of_the_rest(tmp_path: Path) -> None:
    spec = spec_of(tmp_path)
    job, _ = job_of(spec)
    runs = list(spec.every_run())
    with Journal(tmp_path / "r.csv.journal") as journal:
        for run, key in zip(runs, keys_of(job, runs), strict=True):
            journal.add(key, perform(job, run))
    sweep = run_sweep(spec, job, tmp_path / "r.csv")
    assert sweep.varied == ("scale Y.leadscrew", "input X.plane.switch")
    ax = sweep.plot("scale Y.leadscrew", "at")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("scale Y.leadscrew", "at [mm]")
    assert sweep.table.attrs["units"]["at"] == "mm"
    assert [line.get_label() for line in ax.lines] == [f"input X.plane.switch = {on}" for on in (-1, 1)]
    for line, on in zip(ax.lines, (-1, 1), strict=True):
        chosen = sweep.table[sweep.table["input X.plane.switch"] == on]
        assert line.get_xdata().tolist() == [0.0, 1.0, 2.0]
        assert line.get_ydata().tolist() == chosen["at"].tolist()
    with pytest.raises(ValueError, match="there is no column nothing of numbers; there are run"):
        sweep.plot("scale Y.leadscrew", "nothing")


def test_values_of_several_kinds_become_texts(tmp_path: Path) -> None:
    spec = spec_of(tmp_path, vary={"achskw1.lis: kw.crosscomp2.grid": ["RECTANGULAR", 5]})
    job, _ = job_of(spec)
    runs = list(spec.every_run())
    with Journal(tmp_path / "r.parquet.journal") as journal:
        for run, key in zip(runs, keys_of(job, runs), strict=True):
            journal.add(key, perform(job, run))
    run_sweep(spec, job, tmp_path / "r.parquet")
    read = pd.read_parquet(tmp_path / "r.parquet")
    assert read["achskw1.lis: kw.crosscomp2.grid"].tolist() == ["RECTANGULAR", "5"]


def test_an_fmu_gives_the_rows_of_the_engine(tmp_path: Path) -> None:
    fmu = package_axcomp(MODEL, tmp_path / "axcomp.fmu").path
    script = tmp_path / "run.py"
    script.write_text(
        "import json, sys\n"
        "from pathlib import Path\n"
        "from axcomp.sweep.spec import read_spec\n"
        "from axcomp.sweep.sweep import job_of\n"
        "from axcomp.sweep.task import perform\n"
        "spec = read_spec(Path(sys.argv[1]))\n"
        "job, _ = job_of(spec)\n"
        "rows = [perform(job, run) for run in spec.every_run()]\n"
        "Path(sys.argv[2]).write_text(json.dumps(rows))\n"
    )
    spec = spec_of(
        tmp_path, machine=["axcomp.fmu", str(MODEL)], vary={"input X.plane.switch": [-1, 1]}, duration=0.3,
        results={"peak": "peak X.correction", "at": "at 0.2 Y.corrected_setpoint", "on": "last X.plane.active"},
    )  # fmt: skip
    # In a process of its own: an embedded interpreter may fail when the process ends.
    subprocess.run([sys.executable, script, spec.file, tmp_path / "rows.json"], check=False, env=ENVIRONMENT)
    rows = json.loads((tmp_path / "rows.json").read_text())
    assert fmu.exists()
    assert rows[:2] == rows[2:]
    assert [row["on"] for row in rows[:2]] == [0.0, 1.0]


def test_an_fmu_has_no_lists_to_vary(tmp_path: Path) -> None:
    (tmp_path / "a.fmu").write_bytes(b"")
    spec = spec_of(tmp_path, machine="a.fmu", vary={"scale Y.leadscrew": [1.0]})
    with pytest.raises(ValueError, match="is an FMU, whose lists cannot be varied"):
        job_of(spec)


@pytest.mark.slow
def test_killed_half_way_it_finishes_the_rest_only_with_the_same_bytes(tmp_path: Path) -> None:
    spec_of(tmp_path, duration=5.0, vary={"scale Y.leadscrew": {"from": 0, "to": 2, "count": 30}},
            runs=[{}, {"input Q.setpoint": 0}])  # fmt: skip
    command = [sys.executable, "-m", "axcomp", "sweep", "sweep.json", "--output"]

    def sweep(output: str, **options):
        return subprocess.Popen(
            [*command, output, *options.pop("more", [])], cwd=tmp_path, env=ENVIRONMENT, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )  # fmt: skip

    whole = sweep("whole.csv")
    _, said = whole.communicate(timeout=300)
    assert whole.returncode == 30, said
    assert "run 30: Q.setpoint is no input" in said

    stopped = sweep("half.csv")
    journal = tmp_path / "half.csv.journal"
    deadline = time.monotonic() + 240
    while not (journal.exists() and journal.read_text().count("\n") >= 20) and time.monotonic() < deadline:
        time.sleep(0.02)
    stopped.send_signal(signal.SIGKILL)
    stopped.communicate()
    done = journal.read_text().count("\n")
    assert 20 <= done < 60
    assert not (tmp_path / "half.csv").exists()

    again = sweep("half.csv", more=["--workers", "1"])
    printed, _ = again.communicate(timeout=300)
    assert again.returncode == 30
    taken_over = int(printed.split(" of them from before")[0].rsplit(" ", 1)[1])
    assert done <= taken_over < 60
    assert journal.read_text().count("\n") == 60
    assert (tmp_path / "half.csv").read_bytes() == (tmp_path / "whole.csv").read_bytes()


@pytest.mark.slow
def test_a_run_that_takes_its_worker_with_it_is_one_failed_run(tmp_path: Path) -> None:
    script = tmp_path / "deadly.py"
    script.write_text(
        "import os, sys\n"
        "from axcomp.sweep.cluster import completed\n"
        "def task(common, item):\n"
        "    return os._exit(3) if item == 2 else common + item\n"
        "if __name__ == '__main__':\n"
        "    for item, result, error in completed(task, 10, [0, 1, 2, 3, 4, 5], workers=2):\n"
        "        print(item, result, type(error).__name__, flush=True)\n"
    )
    run = subprocess.run(
        [sys.executable, script], capture_output=True, text=True, timeout=240, check=False,
        env={**os.environ, "PYTHONPATH": f"{models().parent}{os.pathsep}{tmp_path}"}, cwd=tmp_path,
    )  # fmt: skip
    lines = sorted(run.stdout.split("\n"))[1:]
    assert lines == [f"{k} {10 + k} NoneType" if k != 2 else "2 None KilledWorker" for k in range(6)], run.stderr


@pytest.mark.parametrize("damage", ["a byte that is no text", "another value", "another key", "a newline gone"])
def test_a_line_of_a_journal_that_was_altered_is_none_and_the_others_are_taken(damage: str, tmp_path: Path) -> None:
    path = tmp_path / "r.csv.journal"
    with Journal(path) as journal:
        for k in range(4):
            journal.add(f"key{k}", {"a": 0.5 + k, ERROR: ""})
    lines = path.read_bytes().splitlines(keepends=True)
    lines[1] = {
        "a byte that is no text": lines[1][:30] + b"\xff" + lines[1][31:],
        "another value": lines[1].replace(b"1.5", b"2.5"),
        "another key": lines[1].replace(b"key1", b"key9"),
        "a newline gone": lines[1][:-1],
    }[damage]
    path.write_bytes(b"".join(lines))
    with Journal(path) as journal:
        left = {"key0": 0.5, "key3": 3.5} | ({} if damage == "a newline gone" else {"key2": 2.5})
        assert {key: row["a"] for key, row in journal.rows().items()} == left
