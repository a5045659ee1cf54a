"""The files in ``models/`` are what the commands write now, and show what they are there for."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from axcomp.examples.files import EXPECTED, INPUT, read_csv, write_expected, write_input, write_lists
from axcomp.examples.machines import MACHINES
from axcomp.examples.trajectories import TRAJECTORIES
from axcomp.lists import read_machine
from axcomp.lists.findings import Severity
from axcomp.machine import KINDS, Crosstalk, CrosstalkCurve
from axcomp.places import models

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


@pytest.mark.parametrize("name", MODELS)
def test_every_model_is_complete(name: str) -> None:
    present = {path.name for path in (models() / name).iterdir()}
    assert {"hochlauf.lis", INPUT, EXPECTED, "README.md"} <= present


@pytest.mark.parametrize("name", sorted(MACHINES))
def test_there_is_nothing_to_say_about_measured_lists(name: str) -> None:
    assert read_machine(models() / name).findings == ()


def test_three_axis_has_all_kinds_and_the_tables_it_promises() -> None:
    x, y, z = read_machine(models() / "three_axis").machine.axes
    assert {kind for axis in (x, y, z) for kind, _ in axis.compensations()} == set(KINDS)
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


def test_expected_plane_correction_is_bilinear_in_the_raw_setpoints() -> None:
    model = models() / "three_axis"
    plane = read_machine(model).machine.axis("X").plane
    assert plane is not None
    rows, columns = np.shape(plane.corrections)
    grid = (
        plane.start2 + plane.interval2 * np.arange(rows),
        plane.start1 + plane.interval1 * np.arange(columns),
    )
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
    machine, findings = read_machine(MANUALS)
    found = {(Path(finding.file).name, finding.line, finding.code) for finding in findings}
    assert ("achsmd2.lis", 3, "AXC-ELISION") in found
    assert ("achskw1.lis", 23, "AXC-ELISION") in found
    assert ("achskw3.lis", 14, "AXC-ELISION") in found
    assert ("achskw3.lis", 5, "AXC-SYNTAX") in found
    unknown = {line for name, line, code in found if (name, code) == ("achskw4.lis", "AXC-UNKNOWN")}
    assert unknown == {9, 10, 11, 12, 15, 16, 17, 18, 19, 20}
    errors = {Path(finding.file).name: finding.code for finding in findings if finding.severity is Severity.ERROR}
    assert errors == {"achskw2.lis": "AXC-ORDER", "achskw3.lis": "70245"}
    acting = {axis.name: [kind for kind, _ in axis.compensations()] for axis in machine.axes}
    assert acting == {
        "X": ["plane"],
        "Y-ACHSE": [],
        "Z": [],
        "STRING_1": [],
        "Y_PRINTED": ["leadscrew"],
        "Z_PRINTED": ["cross"],
    }
