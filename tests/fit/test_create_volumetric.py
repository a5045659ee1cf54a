"""Volumetric lists made from deviations of the tool tip, and what they leave of them."""

import json
import shutil
import warnings
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from scipy.spatial.transform import Rotation
from test_volumetric_identification import PLAIN, X, Y, Z, over, places_of, simulated

from axcomp.cli import main
from axcomp.engine import TcpModel
from axcomp.fit import LEFT_OUT, MEASURED, PREDICTED, Options, TcpDeviations, VolumetricTarget, create
from axcomp.kernel import correction_with, errors_at, zeros
from axcomp.lists import read_machine
from axcomp.measurement import MeasurementError
from axcomp.model import Axis, ErrorTable, Machine, models
from axcomp.plant import load_plant
from axcomp.runtime import compile_tables

FIVE_AXIS = models() / "five_axis"
FINE = np.linspace(-400.0, 400.0, 161)
SMOOTH = (
    over("X", FINE, 0.02 * np.sin(FINE / 90.0), "EXX"),
    over("X", FINE, 3e-5 * np.cos(FINE / 150.0), "EBX"),
    over("Y", FINE, 0.015 * np.sin(FINE / 200.0), "EZY"),
    ErrorTable("C0Y", (6e-5,)),
)
TRUE = replace(PLAIN, errors=SMOOTH)
NAMES = ["EXX", "EBX", "EZY", "C0Y", "X0X", "Z0X", "A0Y", "B0Z"]

START_UP = "zahl_kw 0\nvol_comp[1].file_name vol_comp1.lis\nvol_comp[1].max_records 200\n"
LIST = """\
# five lines that stay
x 1
y 2
z 3
chain YXZ (from the workpiece)
file[0] errors.csv (measured)
"""
PARAMETERS = """\
// tracker, spring
P0X P0Y P0Z N0X N0Y N0Z Y0Y
10 -20 -150 0 0 -1 0.001
"""


def create_volumetric(measurement, target, errors=None, nodes_max=None):
    return create("volumetric", measurement, target, Options(errors=errors, nodes=nodes_max))


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "hochlauf.lis").write_text(START_UP)
    (tmp_path / "vol_comp1.lis").write_text(LIST)
    (tmp_path / "errors.csv").write_text(PARAMETERS)
    return tmp_path


def corrected_by(found, measurement):
    """Return the positions of a measurement as the kernel corrects them."""
    tables, pool = compile_tables(Machine(tuple(Axis(n, name) for name, n in found.axes), (replace(found, index=0),)))
    table = tables.volumetric[0]
    corrected = measurement.positions.copy()
    for place, position, tool in zip(corrected, measurement.positions.tolist(), measurement.tool_lengths, strict=True):
        errors, correction = zeros(72), zeros(3)
        errors_at(pool, table, position, [0] * 72, errors)
        assert correction_with(table, position, float(tool), errors, correction)
        place[:3] += correction
    return corrected


def compensated(measurement, found):
    """Return what is left when the true machine moves where the kernel puts it, µm."""
    truth = TcpModel(TRUE)
    corrected = corrected_by(found, measurement)
    left = truth.deviations(corrected, measurement.tool_lengths, truth.known_errors(corrected))
    # The nominal tool tip moves with the axes one to one in this chain.
    return (left + corrected[:, :3] - measurement.positions[:, :3]) * 1e3


def test_predicted_and_simulated_deviations_agree_within_a_tenth(folder):
    measurement = simulated(places_of(np.linspace(-400.0, 400.0, 17), Y, Z), TRUE)
    creation = create_volumetric(measurement, VolumetricTarget(folder / "vol_comp1.lis"), NAMES, nodes_max=7)
    creation.write()
    reading = read_machine(folder, strict=True)
    left = compensated(measurement, reading.machine.volumetric[0])
    rms = np.sqrt(np.mean(np.sum(left**2, axis=1)))
    known_offset = np.array([0.0, 1.0, 0.0])  # Y0Y of the file: known there, but not in the true machine
    predicted = creation.figures[PREDICTED]["rms"]
    assert predicted < 0.4 * creation.figures[MEASURED]["rms"]
    assert rms == pytest.approx(predicted, rel=0.1)
    assert np.abs(np.abs(left[:, 1]) - known_offset[1]).max() < 0.5


def test_description_comments_and_other_errors_of_the_file_stay(folder):
    measurement = simulated(places_of(X, Y, Z), TRUE)
    before = (folder / "vol_comp1.lis").read_bytes()
    creation = create_volumetric(measurement, VolumetricTarget(folder / "vol_comp1.lis"), ["EXX"])
    assert [path.name for path in creation.files] == ["errors.csv"]
    creation.write()
    text = (folder / "errors.csv").read_text()
    assert text.startswith("// tracker, spring\n")
    assert (folder / "vol_comp1.lis").read_bytes() == before
    volumetric = read_machine(folder, strict=True).machine.volumetric[0]
    assert [table.name for table in volumetric.errors] == ["EXX", "Y0Y"]
    assert volumetric.tool_position == PLAIN.tool_position
    assert volumetric.index == 1


def test_a_list_that_names_no_file_gets_one(tmp_path):
    file = tmp_path / "vol_comp3.lis"
    file.write_text("x 1\ny 2\nz 3 # up\nEnd\n")
    creation = create_volumetric(simulated(places_of(X, Y, Z), TRUE), VolumetricTarget(file), ["EXX"])
    creation.write()
    text = file.read_text()
    assert text.startswith("x 1\ny 2\nz 3 # up\n")
    assert "file[0]                                  vol_comp3.csv\n" in text
    assert text.endswith("End\n")
    assert (tmp_path / "vol_comp3.csv").read_text().startswith("X\tEXX\n")


def test_etalon_files_stay_etalon_files(folder):
    (folder / "vol_comp1.lis").write_text(LIST.replace("errors.csv", "e.exc") + "file_format[0] ETALON_EXCHANGE\n")
    (folder / "e.exc").write_text("[C0Y]\nVALUE = 0.001\n")
    target = VolumetricTarget(folder / "vol_comp1.lis")
    create_volumetric(simulated(places_of(X, Y, Z), TRUE), target, ["EXX"]).write()
    assert (folder / "e.exc").read_text().count("Gridpoints") == 1
    assert {t.name for t in read_machine(folder, strict=True).machine.volumetric[0].errors} == {"EXX", "C0Y"}


def test_runs_left_out_check_the_errors(folder):
    measurement = simulated(places_of(X, Y, Z, runs=3), TRUE, scatter=1.0)
    creation = create_volumetric(measurement, VolumetricTarget(folder / "vol_comp1.lis"), NAMES)
    assert creation.figures[PREDICTED]["rms"] < creation.figures[LEFT_OUT]["rms"]
    assert creation.figures[LEFT_OUT]["rms"] == pytest.approx(creation.figures[PREDICTED]["rms"], rel=0.1)


def test_records_beyond_those_reserved_are_said(folder):
    (folder / "hochlauf.lis").write_text(START_UP.replace("200", "5"))
    creation = create_volumetric(
        simulated(places_of(X, Y, Z), TRUE), VolumetricTarget(folder / "vol_comp1.lis"), ["EXX"]
    )
    assert creation.points == 5 + 1 + 6  # nodes of EXX, Y0Y, tool position and orientation
    assert any("reserves 5 records (vol_comp[1].max_records), but there are 12" in note for note in creation.notes)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (LIST + "file[1] more.csv\n", "several files"),
        (LIST + "interpolation SCATTER\n", "interpolates by SCATTER"),
        (LIST.replace("YXZ", "YXX"), "chain YXX is not"),
        ("\0", "no text"),
    ],
)
def test_lists_that_cannot_take_errors_are_refused(folder, text, sentence):
    (folder / "vol_comp1.lis").write_text(text)
    with pytest.raises(MeasurementError, match=sentence):
        VolumetricTarget(folder / "vol_comp1.lis")


@pytest.fixture
def tracker(tmp_path, monkeypatch):
    """Write a tracker's file into the current folder."""
    monkeypatch.chdir(tmp_path)
    measurement = simulated(places_of(X, Y, Z, runs=2), TRUE, scatter=0.5)
    rows = np.column_stack(
        [measurement.runs, measurement.positions[:, :3], measurement.tool_lengths, measurement.deviations]
    )
    lines = [",".join(f"{value:.4f}" for value in row) for row in rows]
    (tmp_path / "tcp.csv").write_text("run,x,y,z,tool_length,dx,dy,dz\n" + "\n".join(lines))
    return tmp_path


NEW = ["--into", "vol_comp0.lis", "--chain", "YXZ", "--axes", "2", "1", "3", "--tool-position", "10", "-20", "-150"]
COMMAND = ["create", "volumetric", "--from", "tcp.csv", *NEW, "--tool-orientation", "0", "0", "-1"]


def test_the_command_makes_a_list_and_says_what_the_data_do_not_tell(tracker, capsys):
    assert main([*COMMAND, "--plot", "v.png"]) == 0
    out, err = capsys.readouterr()
    assert not err
    assert "EXX: its constant part cannot be told from X0X; it is 0 here." in out
    assert "A0X: all of it has no effect on what was measured; it is 0." in out
    assert "Written to vol_comp0.csv and vol_comp0.lis." in out
    assert (tracker / "v.png").read_bytes().startswith(b"\x89PNG")
    (tracker / "hochlauf.lis").write_text("vol_comp[0].file_name vol_comp0.lis\nvol_comp[0].max_records 200\n")
    volumetric = read_machine(tracker, strict=True).machine.volumetric[0]
    assert dict(volumetric.axes) == {"X": 1, "Y": 2, "Z": 3}
    assert volumetric.tool_orientation == (0.0, 0.0, -1.0)


def test_json_has_values_uncertainties_and_covariance(tracker, capsys):
    assert main([*COMMAND, "--errors", "EXX", "X0X", "--format", "json", "--dry-run", "--nodes", "3"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [error["name"] for error in found["errors"]] == ["X0X", "EXX"]
    assert found["errors"][1]["nodes"] == [-400.0, 0.0, 400.0]
    assert np.shape(found["covariance"]) == (3, 3)
    assert found["redundant"] == [{"name": "EXX", "part": "its constant part", "others": ["X0X"]}]
    assert not (tracker / "vol_comp0.lis").exists()


COORDINATE = st.one_of(st.integers(-300, 300).map(float), st.floats(-1e9, 1e9), st.just(0.0))


@settings(deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.tuples(*[COORDINATE] * 6), min_size=1, max_size=10), st.sampled_from([["X0X", "EXX"], None]))
def test_any_readings_make_a_plausible_list_or_a_sentence(tmp_path_factory, capsys, rows, names):
    folder = tmp_path_factory.mktemp("v")
    (folder / "m.csv").write_text("\n".join(",".join(map(str, row)) for row in rows))
    words = ["--from", str(folder / "m.csv"), "--into", str(folder / "vol_comp0.lis"), *NEW[2:]]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        status = main(["create", "volumetric", *words, *(["--errors", *names] if names else [])])
    out, err = capsys.readouterr()
    assert (folder / "vol_comp0.lis").exists() == (status == 0)
    assert err.count("\n") == status
    assert "nan" not in out


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--into", "none.lis"], "none.lis: There is no such list; give the chain"),
        ([*NEW, "--axes", "1"], "axcomp create: --chain names"),
        ([*NEW, "--nodes", "1"], "axcomp create: an error has two nodes"),
        ([*NEW, "--errors", "EXC"], "axcomp create: EXC: no error of an axis"),
    ],
)
@pytest.mark.usefixtures("tracker")
def test_faults_are_sentences(capsys, words, sentence):
    assert main(["create", "volumetric", "--from", "tcp.csv", *words]) == 1
    assert capsys.readouterr().err.startswith(sentence)


@pytest.mark.slow
def test_a_five_axis_machine_of_rigid_bodies_is_identified_at_random_places(tmp_path):
    """The plant and the nominal tool tip (SciPy) share nothing with the model that is fitted."""
    folder = tmp_path / "m"
    shutil.copytree(FIVE_AXIS, folder)
    plant = load_plant(FIVE_AXIS)
    random = np.random.default_rng(0)
    limits = np.array([[-300, -250, -400, 0, -100, 0], [300, 250, 0, 0, 100, 360]], dtype=float)

    def tip_errors(commanded, moved, tools):
        found = []
        for q, p, tool in zip(commanded, moved, tools, strict=True):
            at = dict(zip("XYZABC", p.tolist(), strict=True))
            plant.rest_at([at[name] for name in plant.names])
            center = np.array([0.0, 0.0, -450.0])
            tilted = Rotation.from_euler("y", -q[4], degrees=True).apply(q[:3] - [0.0, 0.0, tool] - center) + center
            nominal = Rotation.from_euler("z", -q[5], degrees=True).apply(tilted)
            found.append((np.array(plant.place((0.0, 0.0, -tool))) - nominal) * 1e3)
        return np.array(found)

    positions = random.uniform(*limits, (300, 6)).round(3)
    tools = random.choice([0.0, 120.0, 200.0], 300)
    deviations = tip_errors(positions, positions, tools)
    target = VolumetricTarget(folder / "vol_comp1.lis")
    target.volumetric = replace(target.volumetric, errors=())
    measurement = TcpDeviations(positions, tools, deviations, np.ones(300, int))
    creation = create_volumetric(measurement, target, nodes_max=9)
    creation.write()
    found = next(v for v in read_machine(folder, strict=True).machine.volumetric if v.index == 1)
    left = tip_errors(positions, corrected_by(found, measurement), tools)
    rms = np.sqrt(np.mean(np.sum(left**2, axis=1)))
    assert creation.figures[PREDICTED]["rms"] < 0.03 * creation.figures[MEASURED]["rms"]
    assert rms == pytest.approx(creation.figures[PREDICTED]["rms"], rel=0.1)
