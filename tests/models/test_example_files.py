"""The files in ``models/`` are what the commands write now, and show what they are there for."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from axcomp.demo.examples import (
    EXPECTED,
    INPUT,
    MACHINES,
    TRAJECTORIES,
    read_csv,
    write_expected,
    write_input,
    write_lists,
)
from axcomp.engine import Engine
from axcomp.kinds import KINDS, Crosstalk, CrosstalkCurve, ListKind, Severity
from axcomp.lists import read_machine
from axcomp.model import models
from axcomp.plant import load_plant

MODELS = sorted(TRAJECTORIES)
MANUALS = models() / "manual_examples"


@pytest.mark.parametrize("name", sorted(MACHINES))
def test_lists_are_what_the_plant_measures(name: str, tmp_path: Path) -> None:
    written = write_lists(models() / name, tmp_path)
    lists = {path.name for path in (models() / name).iterdir()} - {INPUT, EXPECTED, "plant.json", "README.md"}
    assert {path.name for path in written} == lists
    for path in written:
        assert path.read_bytes() == (models() / name / path.name).read_bytes(), path.name


@pytest.mark.parametrize("name", MODELS)
def test_input_and_expected_output_are_current(name: str, tmp_path: Path) -> None:
    for write in (write_input, write_expected):
        path = write(models() / name, tmp_path)
        assert path.read_bytes() == (models() / name / path.name).read_bytes()


def test_what_is_activated_without_a_usable_table_has_outputs_and_does_nothing() -> None:
    expected = read_csv(MANUALS / EXPECTED)
    for kind in ("Y_ACHSE.leadscrew", "Z.cross"):
        assert not np.any(expected[f"{kind}.active"])
        assert not np.any(expected[f"{kind}.correction"])


@pytest.mark.parametrize("name", MODELS)
def test_every_model_is_complete(name: str) -> None:
    present = {path.name for path in (models() / name).iterdir()}
    assert {"hochlauf.lis", INPUT, EXPECTED, "README.md"} <= present


@pytest.mark.parametrize("name", sorted(MACHINES))
def test_there_is_nothing_to_say_about_measured_lists(name: str) -> None:
    assert read_machine(models() / name).findings == ()


def test_three_axis_has_all_kinds_and_the_tables_it_promises() -> None:
    x, y, z = read_machine(models() / "three_axis").machine.axes
    in_lists = {name for name, kind in KINDS.items() if kind.list_kind is ListKind.COMPENSATION}
    assert {kind for axis in (x, y, z) for kind in axis.kinds} == in_lists
    assert isinstance(y.crosstalk, Crosstalk)
    assert isinstance(z.crosstalk, CrosstalkCurve)
    assert x.leadscrew is not None
    assert x.leadscrew.negative is not None
    assert len(x.leadscrew.positions) == 140
    assert np.ptp(np.diff(x.leadscrew.positions)) > 1.0
    assert x.plane is not None
    assert np.shape(x.plane.corrections) == (101, 101)


def test_rotary_table_is_a_modulo_axis_whose_input_goes_over_the_end_both_ways() -> None:
    (c,) = read_machine(models() / "rotary_table").machine.axes
    assert c.modulo is not None
    assert c.leadscrew is not None
    assert c.leadscrew.modulo
    steps = np.diff(read_csv(models() / "rotary_table" / INPUT)["C.setpoint"])
    assert np.any(steps > 350.0)
    assert np.any(steps < -350.0)


def test_five_axis_has_a_cartesian_and_a_rotary_compensation_in_either_format() -> None:
    machine = read_machine(models() / "five_axis").machine
    cartesian, rotary = machine.volumetric
    assert (cartesian.chain, cartesian.workpiece_axes, cartesian.files[0]) == ("YXZ", 0, "vol_comp0.csv")
    assert (rotary.chain, rotary.workpiece_axes, rotary.files[0]) == ("CBYXZ", 2, "vol_comp1.exc")
    assert {error.name[-1] for error in cartesian.errors} == set("XYZ")
    assert {error.name[-1] for error in rotary.errors} == set("BC")
    assert cartesian.tool_orientation == rotary.tool_orientation == (0.0, 0.0, -1.0)
    formats = [(models() / "five_axis" / f"vol_comp{k}.lis").read_text(encoding="utf-8") for k in (0, 1)]
    assert ["ETALON_EXCHANGE" in text for text in formats] == [False, True]
    assert [axis.modulo is not None for axis in machine.axes] == [False, False, False, False, True]
    assert machine == MACHINES["five_axis"](load_plant(models() / "five_axis"))


def tip_errors(plant: Any, raw: np.ndarray, corrected: np.ndarray, tool_length: float) -> np.ndarray:
    """How far the plant's tool tip is off, µm, shape (rows, 3); positions of all axes, shape (rows, axes)."""
    tip = plant.bodies.tip(tool_length)
    errors = []
    for wanted, driven in zip(raw.tolist(), corrected.tolist(), strict=True):
        plant.rest_at(driven)
        errors.append(np.subtract(plant.place(tip), plant.bodies.nominal_place(tip, wanted)))
    return 1e3 * np.array(errors)


def test_five_axis_errors_shrink_to_a_half_percent_all_over_the_work_volume() -> None:
    model = models() / "five_axis"
    plant: Any = load_plant(model, choice="memoryless")
    places = np.random.default_rng(1).uniform([-300, -250, -400, -100, 0], [300, 250, 0, 100, 360], size=(200, 5))
    engine = Engine(model)
    given = {f"{name}.setpoint": column for name, column in zip(plant.names, places.T, strict=True)}
    result = engine.run({**given, "tool_length": np.full(len(places), 120.0)})
    corrected = np.column_stack([result[f"{name}.corrected_setpoint"] for name in plant.names])
    without = np.linalg.norm(tip_errors(plant, places, places, 120.0), axis=1)
    compensated = np.linalg.norm(tip_errors(plant, places, corrected, 120.0), axis=1)
    assert without.mean() == pytest.approx(33.7, abs=0.1)
    assert without.max() == pytest.approx(81.7, abs=0.1)
    assert compensated.mean() < 0.12
    assert compensated.max() < 0.25


def test_five_axis_expected_output_leads_the_tool_along_its_way_over_the_end_of_the_turn() -> None:
    model = models() / "five_axis"
    plant: Any = load_plant(model, choice="memoryless")
    given, expected = read_csv(model / INPUT), read_csv(model / EXPECTED)
    raw = np.column_stack([given[f"{name}.setpoint"] for name in plant.names])[:-1]
    corrected = np.column_stack([expected[f"{name}.corrected_setpoint"] for name in plant.names])[1:]
    steps = np.diff(raw[:, -1])
    assert np.any(steps > 350.0)
    assert np.any(steps < -350.0)
    error = np.linalg.norm(tip_errors(plant, raw, corrected, given["tool_length"][0]), axis=1)
    commanded = given["volumetric[1].switch"][:-1] == 0.0
    switching = np.convolve(commanded == 0.0, np.ones(41), "same") > 0
    assert np.max(error[~switching]) < 0.25
    assert np.max(error[~commanded]) > 10.0
    assert set(expected["volumetric[0].active"]) == {1.0}
    assert set(expected["volumetric[1].active"]) == {0.0, 1.0}
    # A switch takes its 20 cycles, and so it never jumps.
    assert np.max(np.abs(np.diff(corrected - raw, axis=0))) < 4e-3


def test_expected_plane_correction_is_bilinear_in_the_raw_setpoints() -> None:
    model = models() / "three_axis"
    plane = read_machine(model).machine.axis("X").plane
    assert plane is not None
    rows, columns = np.shape(plane.corrections)
    grid = (plane.start2 + plane.interval2 * np.arange(rows), plane.start1 + plane.interval1 * np.arange(columns))
    given, expected = read_csv(model / INPUT), read_csv(model / EXPECTED)
    values = RegularGridInterpolator(grid, np.array(plane.corrections))(
        np.column_stack([given["Z.setpoint"], given["Y.setpoint"]])
    )
    assert np.ptp(values) > 1e-3
    assert np.allclose(expected["X.plane.correction"][1:], values[:-1], rtol=0.0, atol=2e-9)


def test_expected_sag_and_pitch_corrections_are_linear_between_the_points() -> None:
    model = models() / "three_axis"
    machine = read_machine(model).machine
    cross, leadscrew = machine.axis("Z").cross, machine.axis("Z").leadscrew
    assert cross is not None
    assert leadscrew is not None
    given, expected = read_csv(model / INPUT), read_csv(model / EXPECTED)
    sag = np.interp(given["X.setpoint"], cross.positions, cross.corrections)[:-1]
    assert np.allclose(expected["Z.cross.correction"][1:], sag, rtol=0.0, atol=2e-9)
    position = given["Z.setpoint"][:-1] + sag + expected["Z.crosstalk.correction"][1:]
    pitch = -np.interp(position, leadscrew.positions, leadscrew.positive)
    assert np.allclose(expected["Z.leadscrew.correction"][1:], pitch, rtol=0.0, atol=2e-9)


def test_the_manuals_value_is_subtracted_in_either_direction() -> None:
    given, expected = read_csv(MANUALS / INPUT), read_csv(MANUALS / EXPECTED)
    at = np.flatnonzero(np.abs(given["Y_PRINTED.setpoint"] + 19.8667) < 1e-9) + 1
    corrections = expected["Y_PRINTED.leadscrew.correction"][at[at < len(expected["time"])]]
    assert corrections[0] == 0.0102
    assert corrections[-1] == -0.008


def test_the_manuals_examples_get_the_findings_they_deserve() -> None:
    reading = read_machine(MANUALS)
    machine, findings = reading.machine, reading.findings
    found = {(Path(finding.file).name, finding.line, finding.code) for finding in findings}
    assert ("achsmd2.lis", 3, "AXC-ELISION") in found
    assert ("achskw1.lis", 23, "AXC-ELISION") in found
    assert ("achskw3.lis", 14, "AXC-ELISION") in found
    assert "AXC-SYNTAX" not in {code for _, _, code in found}
    unknown = {line for name, line, code in found if (name, code) == ("achskw4.lis", "AXC-UNKNOWN")}
    assert unknown == {9, 10, 11, 12, 15, 16, 17, 18, 19, 20}
    errors = {(Path(finding.file).name, finding.code) for finding in findings if finding.severity is Severity.ERROR}
    gaps = {(f"achskw{i}.lis", "AXC-GAP") for i in (1, 2, 3)}
    assert errors == {("achskw2.lis", "AXC-ORDER"), ("achskw3.lis", "70245")} | gaps
    acting = {axis.name: [one.kind for one in axis.compensations] for axis in machine.axes}
    assert acting == {
        "X": ["plane"],
        "Y-ACHSE": [],
        "Z": [],
        "STRING_1": [],
        "Y_PRINTED": ["leadscrew"],
        "Z_PRINTED": ["cross"],
    }
