"""Backlash from bidirectional positioning measurements, put into the axis list, and what the engine makes of it."""

import json
import shutil
import warnings
from functools import partial

import numpy as np
import pytest
from creating import THREE_AXIS, copied_lists, measured
from hypothesis import HealthCheck, given, settings, strategies as st

from axcomp.cli import main
from axcomp.engine import Engine
from axcomp.fit import LEFT_OUT, MEASURED, PREDICTED, AxisList, CannotCreateError, Options, create
from axcomp.kinds import Backlash
from axcomp.lists import read_machine
from axcomp.measurement import MeasurementError

create_backlash = partial(create, "backlash")
TARGETS = np.arange(-400.0, 401.0, 50.0)
ERROR = 6.0 * np.sin(TARGETS / 120.0)


def with_backlash(amount, **more):
    """Measure an axis whose slide stays behind by an amount (µm) after negative motion."""
    return measured(TARGETS, {1: ERROR, -1: ERROR + amount}, **more)


@pytest.fixture
def lists(tmp_path):
    return copied_lists(tmp_path / "m")


@pytest.fixture
def new_list(tmp_path):
    return AxisList(tmp_path / "new.lis", 1)


def machine_of(folder, mode=0, rotary=False):
    """Write a machine of one axis; return its axis list."""
    (folder / "hochlauf.lis").write_text("zahl_mds 1\nachs_mds[0] achsmd1.lis\nzahl_kw 0\n")
    selected = f"lr_param.anwahl_losekomp {mode}\n" if mode else ""
    (folder / "achsmd1.lis").write_text(f"kopf.achs_nr 1\nkenngr.achs_typ {1 + rotary}\n{selected}End\n")
    return folder / "achsmd1.lis"


def played(setpoints, amount):
    """Return where a slide rests that its drive takes along by either flank of a play, amount apart."""
    slide, places = setpoints[0], []
    for drive in setpoints:
        slide = min(max(slide, drive), drive + amount)
        places.append(slide)
    return np.array(places)


def measured_with(engine, amount, unit):
    """Measure the axis that the engine corrects, each target from below and from above."""
    path = np.concatenate([[TARGETS[0] - 1.0], TARGETS, [TARGETS[-1] + 1.0], TARGETS[::-1]])
    corrected = engine.run({"axis1.setpoint": path})["axis1.corrected_setpoint"]
    off = (played(corrected, amount) - path) * (1e3 if unit == "mm" else 3600.0)
    count = len(TARGETS)
    return measured(TARGETS, {1: off[1 : count + 1], -1: off[count + 2 :][::-1]}, runs=1, unit=unit)


@pytest.mark.parametrize("rotary", [False, True])
@pytest.mark.parametrize("mode", [0, 1, 2])
def test_a_known_backlash_is_gone_but_for_rounding_when_the_engine_runs_the_list(tmp_path, mode, rotary):
    file = machine_of(tmp_path, mode, rotary)
    unit, small = ("deg", 3600.0) if rotary else ("mm", 1e3)
    amount = 0.01234
    before = measured_with(Engine(read_machine(tmp_path).machine), amount, unit)
    assert before.deviations.max() == pytest.approx(amount * small)
    create_backlash(before, AxisList(file)).write()
    machine = read_machine(tmp_path, strict=True).machine
    assert machine.axes[0].of(Backlash) == Backlash(0.0123, mode or 1)
    after = measured_with(Engine(machine), amount, unit)
    reversal = after.deviations[after.directions > 0] - after.deviations[after.directions < 0]
    assert np.abs(reversal).max() <= 0.5e-4 * small
    assert np.abs(reversal).max() == pytest.approx(0.00004 * small)


def test_what_remains_is_measured_again_and_put_on_top(tmp_path):
    file = machine_of(tmp_path, 1)
    file.write_text(file.read_text().replace("End", "getriebe[0].lose 100 # guessed\nEnd"))
    rest = measured_with(Engine(read_machine(tmp_path).machine), 0.0152, "mm")
    creation = create_backlash(rest, AxisList(file), Options(on_top=True))
    assert creation.compensation == Backlash(0.0152, 1)
    assert creation.figures[PREDICTED]["B"] == pytest.approx(0.0, abs=1e-9)
    assert b"getriebe[0].lose 152 # guessed\n" in creation.data
    assert create_backlash(rest, AxisList(file)).compensation == Backlash(0.0052, 1)


def test_mean_and_uncertainty_are_those_of_the_reversal_values(new_list):
    random = np.random.default_rng(8)
    readings = with_backlash(9.0, runs=4, scatter=1.5)
    keep = random.random(len(readings.runs)) > 0.1
    some = readings.only(keep)
    values, squares = [], []
    for target in TARGETS:
        up, down = (some.deviations[(some.targets == target) & (some.directions == d)] for d in (1, -1))
        values.append(down.mean() - up.mean())
        squares.append(up.var(ddof=1) / len(up) + down.var(ddof=1) / len(down))
    creation = create_backlash(some, new_list)
    found = creation.report.details
    assert found["measured"] == pytest.approx(np.mean(values))
    assert found["uncertainty"] == pytest.approx(2.0 * np.sqrt(np.sum(squares)) / len(TARGETS))
    assert found["reversal_values"] == pytest.approx(np.negative(values))
    assert creation.compensation.amount == pytest.approx(np.mean(values) * 1e-3, abs=0.51e-4)
    assert creation.deviation == pytest.approx(np.max(np.abs(np.array(values) - creation.compensation.amount * 1e3)))
    assert creation.figures[PREDICTED]["B"] == pytest.approx(creation.deviation)
    assert creation.figures[MEASURED]["B_mean"] == pytest.approx(-np.mean(values))
    assert LEFT_OUT in creation.figures
    assert not creation.notes


def test_without_repetitions_the_targets_say_how_well_it_is_known(new_list):
    amounts = 9.0 + 0.3 * np.cos(TARGETS)
    creation = create_backlash(measured(TARGETS, {1: ERROR, -1: ERROR + amounts}, runs=1), new_list)
    expected = 2.0 * np.std(amounts, ddof=1) / np.sqrt(len(TARGETS))
    assert creation.report.details["uncertainty"] == pytest.approx(expected)
    assert creation.report.sentences[0] == (
        f"The measured backlash is {amounts.mean():.2f} µm (U = {expected:.2f} µm, k = 2); "
        f"at the targets it is from {amounts.min():.2f} to {amounts.max():.2f} µm."
    )
    assert creation.notes == ("With one run there is no check by leaving runs out.",)


BETTER = "The backlash differs much over the targets: a bilateral leadscrew table would leave less."
NONE = "The backlash is within its uncertainty: there may be none."
BELOW = "The backlash is below 0: are the directions of the measurement right?"


@pytest.mark.parametrize(
    ("amounts", "scatter", "notes"),
    [
        (np.full(len(TARGETS), 8.0), 0.2, set()),
        (8.0 + TARGETS / 130.0, 0.2, set()),
        (8.0 + TARGETS / 80.0, 0.2, {BETTER}),
        (np.full(len(TARGETS), -8.0), 0.2, {BELOW}),
        (np.zeros(len(TARGETS)), 5.0, {NONE}),
    ],
)
def test_what_a_single_value_cannot_hold_is_said(new_list, amounts, scatter, notes):
    readings = measured(TARGETS, {1: ERROR, -1: ERROR + amounts}, runs=5, scatter=scatter, seed=3)
    assert set(create_backlash(readings, new_list).notes) == notes


def test_one_run_says_too_that_the_targets_differ(new_list):
    readings = measured(TARGETS, {1: ERROR, -1: ERROR + 8.0 + TARGETS / 80.0}, runs=1)
    assert BETTER in create_backlash(readings, new_list).notes


def test_a_bilateral_leadscrew_table_is_pointed_at(lists):
    assert read_machine(lists).machine.axis("X").leadscrew.negative is not None
    creation = create_backlash(with_backlash(8.0), AxisList(lists / "achsmd1.lis"))
    assert any("bilateral leadscrew table takes a reversal error off too" in note for note in creation.notes)
    assert not create_backlash(with_backlash(8.0), AxisList(lists / "achsmd3.lis")).notes


@pytest.mark.parametrize("into", ["achsmd2.lis", "achskw2.lis", "hochlauf.lis", ""])
def test_the_axis_list_is_found_and_all_else_in_it_stays(lists, into):
    before = (lists / "achsmd2.lis").read_text()
    number = None if into.startswith("achs") else 2
    create_backlash(with_backlash(8.0), AxisList(lists / into, number)).write()
    after = (lists / "achsmd2.lis").read_text().splitlines()
    new = ["lr_param.anwahl_losekomp                 1", "getriebe[0].lose                         80"]
    assert [line for line in after if line not in new] == before.splitlines()
    assert [line for line in after if line in new] == new
    machine = read_machine(lists, strict=True).machine
    assert machine.axis("Y").of(Backlash) == Backlash(0.008, 1)
    assert {file.name for file in lists.iterdir()} == {file.name for file in THREE_AXIS.glob("*.lis")}


def test_what_cannot_be_is_refused(lists, tmp_path, new_list):
    with pytest.raises(CannotCreateError, match="every direction that is needed"):
        create_backlash(measured(TARGETS, {1: ERROR}), new_list)
    with pytest.raises(CannotCreateError, match="no backlash compensation of this axis acts"):
        create_backlash(with_backlash(8.0), AxisList(lists / "achsmd1.lis"), Options(on_top=True))
    with pytest.raises(MeasurementError, match="counts in mm, the measurement in deg"):
        create_backlash(with_backlash(8.0, unit="deg"), AxisList(lists / "achsmd1.lis"))
    with pytest.raises(ValueError, match=r"getriebe\[0\].lose cannot be 40000 in a list"):
        create_backlash(with_backlash(4000.0), new_list)
    with pytest.raises(MeasurementError, match="give the axis' logical number"):
        AxisList(lists)
    with pytest.raises(MeasurementError, match=r"achsmd1.lis:\d+: The list is for axis 1, not 2"):
        AxisList(lists / "achskw1.lis", 2)
    with pytest.raises(MeasurementError, match="there is none of this axis"):
        AxisList(lists, 7)
    shutil.copy(lists / "achskw1.lis", tmp_path / "alone.lis")
    with pytest.raises(MeasurementError, match=r"looks like a list achskw\*.lis, not achsmd\*.lis"):
        AxisList(tmp_path / "alone.lis")
    (tmp_path / "alone.lis").write_bytes(b"\0")
    with pytest.raises(MeasurementError, match="no text"):
        AxisList(tmp_path / "alone.lis")
    with pytest.raises(MeasurementError, match="no file"):
        AxisList(tmp_path)


def test_the_command_tells_and_writes(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    rows = [f"{q},{run},{d},{3.0 if d == '-' else -2.0}" for q in TARGETS for run in (1, 2) for d in "+-"]
    (tmp_path / "x.csv").write_text("\n".join(rows))
    words = ["create", "backlash", "--from", "x.csv", "--into", "new.lis", "--axis", "4", "--name", "U"]
    assert main([*words, "--plot", "b.png"]) == 0
    out, err = capsys.readouterr()
    assert "In mode 1 the drive goes 5.0 µm further after negative motion; a reversal value of 0.00 µm" in out
    assert "Written to new.lis." in out
    assert not err
    assert (tmp_path / "b.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "new.lis").read_text().split() == [
        *("#", "Axis", "kopf.achs_nr", "4", "kopf.log_achs_name", '"U"'),
        *("lr_param.anwahl_losekomp", "1", "getriebe[0].lose", "50"),
    ]
    assert main([*words[:-4], "--on-top", "--output", "other.lis", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["backlash"], found["measured"], found["mode"], found["uncertainty"]) == (10.0, 5.0, 1, 0.0)
    assert found["written"] == "other.lis"
    assert "lose                         50" in (tmp_path / "new.lis").read_text()


NUMBERS = st.one_of(st.integers(-300, 300).map(float), st.floats(-1e6, 1e6), st.sampled_from([0.0, 5e-5, 1e308]))


@settings(deadline=None, max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.tuples(NUMBERS, st.integers(1, 3), st.sampled_from("+-"), NUMBERS), min_size=1, max_size=12))
def test_any_readings_make_a_plausible_list_or_a_sentence(tmp_path_factory, capsys, rows):
    folder = tmp_path_factory.mktemp("backlash")
    file = machine_of(folder)
    before = file.read_bytes()
    (folder / "m.csv").write_text("\n".join(",".join(map(str, row)) for row in rows))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        status = main(["create", "backlash", "--from", str(folder / "m.csv"), "--into", str(file)])
    out, err = capsys.readouterr()
    assert err.count("\n") == status
    assert "nan" not in out
    reading = read_machine(folder)
    assert not [finding for finding in reading.findings if finding.severity.value == "error"]
    if status:
        assert file.read_bytes() == before
    else:
        assert reading.machine.axes[0].of(Backlash) is not None
