"""Errors of machines identified from what instruments really give: points, lengths, places of spheres."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from simulated_machine import (
    DISPLACEMENT,
    LENGTH,
    NAMES,
    NODES,
    POINT,
    SPHERE,
    TrueMachine,
    drawn,
    in_volume,
    less_rigid,
    readings,
)

from axcomp.cli import main
from axcomp.engine import TcpModel
from axcomp.fit import CannotCreateError, Identifier, Options, TcpDeviations, VolumetricTarget, create, fit_of
from axcomp.measurement import MeasurementError, joined

STATIONS = np.array([[-200, -200, -700], [900, -300, -600], [300, 900, -650], [300, 250, -1000]], dtype=float)
SCATTER = 1e-3


def compensated(machine, found, lengths=0.0, seed=9, turns=False, centers=None, few=NODES):
    """Return what is left of the true tip at places that were not measured, rigid motion apart, and what was, µm.

    The true machine goes where the kernel's model of the found errors sends it.
    """
    random = np.random.default_rng(seed)
    positions = in_volume(400, random, few, at_nodes=False)
    if turns:
        for k in (3, 4, 5):
            if "XYZABC"[k] in machine.chain:
                positions[:, k] = random.uniform(-90.0, 90.0, len(positions))
    described = machine.described(**({} if centers is None else {"centers": centers}))
    model = TcpModel(replace(described, errors=found.tables()))
    tools = np.full(len(positions), lengths)
    corrected = positions.copy()
    corrected[:, :3] += model.corrections(model.places(positions), tools)
    wanted = model.nominal(model.places(positions), tools)
    left = (machine.tips(corrected, tools) - wanted) * 1e3
    return less_rigid(left, wanted), less_rigid((machine.tips(positions, tools) - wanted) * 1e3, wanted), positions


def lengths_of(machine, positions, tools, scatter, seed, *, dead_paths=True):
    """Return what tracers at four places measure: lengths to the tip, all but a dead path."""
    random = np.random.default_rng(seed)
    station = np.repeat(np.arange(4), len(positions))
    at, tool = np.tile(positions, (4, 1)), np.tile(tools, 4)
    dead = random.uniform(10.0, 100.0, 4) * dead_paths
    length = np.linalg.norm(machine.tips(at, tool) - STATIONS[station], axis=1) - dead[station]
    length += random.normal(0.0, scatter, len(length))
    return readings(DISPLACEMENT if dead_paths else LENGTH, at, tool, station + 1, length)


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("dead_paths", [True, False])
def test_lengths_from_four_unknown_stations_leave_3_um(seed, dead_paths):
    """21 errors, 1 µm noise: multilateration with unknown places and dead paths, or a ball-bar's absolute lengths."""
    machine = drawn("YXZ", seed=seed)
    random = np.random.default_rng(seed)
    positions, tools = in_volume(350, random), random.choice([0.0, 150.0], 350)
    data = lengths_of(machine, positions, tools, SCATTER, seed, dead_paths=dead_paths)
    identifier = Identifier(data, machine.described(), NAMES)
    found = identifier.fit()
    assert found.scatter == pytest.approx(1.0, abs=0.1)
    assert not found.regularized
    for lengths in (0.0, 150.0):
        left, before, at = compensated(machine, found, lengths)
        assert np.linalg.norm(before, axis=1).max() > 15.0
        assert np.linalg.norm(left, axis=1).max() <= 3.0
        stated = identifier.tip_uncertainty(found, at, lengths)
        assert np.mean(np.linalg.norm(left, axis=1) <= 1.5 * stated) > 0.9  # of one draw; see over 50 below
    places = dict(found.unknowns)
    assert len(places) == 4
    for k, values in enumerate(places.values()):
        assert np.linalg.norm(values[:3] - STATIONS[k]) < 0.3


def test_points_in_the_frames_of_two_trackers_are_as_good_as_deviations():
    machine = drawn("YXZ", seed=3)
    random = np.random.default_rng(3)
    positions, tools = in_volume(500, random), random.choice([0.0, 150.0], 500)
    station = random.integers(1, 3, 500)
    poses = {
        1: (Rotation.from_euler("xyz", [170, 20, -100], degrees=True), [3000, -200, 1500]),
        2: (Rotation.identity(), [9, 8, 7]),
    }
    tips = machine.tips(positions, tools)
    seen = np.array([poses[s][0].apply(tip) + poses[s][1] for s, tip in zip(station, tips, strict=True)])
    data = readings(POINT, positions, tools, station, seen + random.normal(0.0, SCATTER, seen.shape))
    found = Identifier(data, machine.described(), NAMES).fit()
    assert found.scatter == pytest.approx(1.0, abs=0.1)
    left, _, _ = compensated(machine, found, 150.0)
    assert np.linalg.norm(left, axis=1).max() <= 2.0
    assert any("pose of station 1" in other for r in found.redundancies for other in r.others)
    turn = Rotation.from_rotvec(found.unknowns[0][1][:3] * 1e-3)
    assert (turn * poses[1][0].inv()).magnitude() < 2e-4


CENTERS = {"A": (0.0, 12.3, -350.4), "C": (301.7, 249.1, 0.0)}
ROTARY_ERRORS = {"B0A": 4e-5, "C0A": -3e-5, "A0C": 5e-5, "B0C": -2e-5}


def five_axes(seed):
    """Return a machine with a swivelling table (A carries C), its own errors of location and of the motion of C."""
    machine = drawn("CAYXZ", 2, seed=seed, centers=CENTERS)
    machine.errors |= ROTARY_ERRORS
    turn = np.linspace(-90.0, 90.0, 7)
    for name, size in (("EXC", 0.004), ("EZC", 0.006), ("EAC", 2e-5), ("EZA", 0.005), ("EBA", 1e-5)):
        machine.errors[name] = (turn, size * np.sin(np.radians(turn) * 3.0 + len(name)) * (turn != 0.0))
    return machine


def spheres_of(machine, seed, scatter=SCATTER, count=90):
    """Return where X, Y, Z stand while the tip is at the centre of one of four spheres on the table, at many turns.

    Found by Newton's method on the true machine, as a touch-probe cycle does.
    """
    random = np.random.default_rng(seed)
    found = []
    nominal = TrueMachine(machine.chain, 2, {}, machine.centers, machine.tool)
    for sphere, at in enumerate([(150, 150, -300), (450, 200, -250), (300, 380, -350), (200, 300, -200)], start=1):
        target = nominal.tips(np.array([[*at, 0.0, 0.0, 0.0]]), np.zeros(1))[0]
        positions = np.zeros((count, 6))
        positions[:, :3] = at
        positions[:, 3], positions[:, 5] = random.choice(np.linspace(-90, 90, 7), (2, count))
        for _ in range(12):
            tips = machine.tips(positions, np.zeros(count))
            slopes = np.empty((count, 3, 3))
            for k in range(3):
                moved = positions.copy()
                moved[:, k] += 1.0
                slopes[:, :, k] = machine.tips(moved, np.zeros(count)) - tips
            positions[:, :3] -= np.linalg.solve(slopes, (tips - target)[:, :, None])[:, :, 0]
        positions[:, :3] += random.normal(0.0, scatter, (count, 3))
        found.append(readings(SPHERE, positions, np.zeros(count), np.full(count, sphere)))
    return joined(found)


@pytest.mark.parametrize("seed", [0, 1])
def test_five_axes_with_centres_from_spheres_leave_5_um(seed):
    """Lengths for the linear axes, spheres for the rotary ones; the list has the centres wrong by millimetres."""
    machine = five_axes(seed)
    random = np.random.default_rng(seed)
    positions, tools = in_volume(300, random), random.choice([0.0, 150.0], 300)
    data = joined([lengths_of(machine, positions, tools, SCATTER, seed), spheres_of(machine, seed)])
    described = machine.described(centers=((0.0, 10.0, -348.0), (0.0, 0.0, 0.0), (303.0, 250.0, 0.0)))
    names = [*NAMES, *ROTARY_ERRORS, "EXC", "EZC", "EAC", "EZA", "EBA", "PYA", "PZA", "PXC", "PYC"]
    found = Identifier(data, described, names).fit()
    centers = found.centers(described.centers)
    assert np.array(centers[0])[1:] == pytest.approx(np.array(CENTERS["A"])[1:], abs=0.05)
    left, before, _ = compensated(machine, found, turns=True, centers=centers)
    assert np.linalg.norm(left, axis=1).max() <= 5.0
    assert np.linalg.norm(before, axis=1).max() > 20.0


def test_r_test_deviations_are_added_to_where_the_axes_stand():
    machine = five_axes(2)
    data = spheres_of(machine, 2, scatter=0.0, count=20)
    rounded = np.round(data.positions, 2)
    given = replace(data, positions=rounded, deviations=(data.positions - rounded)[:, :3] * 1e3)
    names = ["PYA", "PZA", "PXC", "PYC", *ROTARY_ERRORS]
    one, other = (
        Identifier(readings_, machine.described(centers=((0, 0, 0),) * 3), names).fit() for readings_ in (data, given)
    )
    for values, wanted in zip(one.values, other.values, strict=True):
        assert values == pytest.approx(wanted, abs=1e-6)


@pytest.mark.slow
def test_stated_intervals_hold_what_they_promise_over_50_seeds():
    """The share of values within U (k = 2) of those of noiseless readings, for lengths and for spheres."""
    few = {"X": np.linspace(0, 600, 4), "Y": np.linspace(0, 500, 4), "Z": np.linspace(-400, 0, 3)}
    machine = drawn("YXZ", seed=5, nodes=few)
    random = np.random.default_rng(5)
    positions, tools = in_volume(90, random, few), random.choice([0.0, 150.0], 90)
    exact = Identifier(lengths_of(machine, positions, tools, 0.0, 0), machine.described(), NAMES).fit()
    shares, tips = [], []
    for seed in range(50):
        noisy = lengths_of(machine, positions, tools, 0.0, 0)
        noise = np.random.default_rng(100 + seed).normal(0.0, SCATTER, len(noisy.measured))
        noisy.measured[:, 0] += noise
        identifier = Identifier(noisy, machine.described(), NAMES)
        found = identifier.fit()
        inside = [
            np.abs(values - wanted)[u > 0.0] <= u[u > 0.0]
            for values, wanted, u in zip(found.values, exact.values, found.uncertainty, strict=True)
        ]
        shares.append(np.mean(np.concatenate(inside)))
        left, _, at = compensated(machine, found, few=few)
        tips.append(np.mean(np.linalg.norm(left, axis=1) <= identifier.tip_uncertainty(found, at)))
    assert 0.90 <= np.mean(shares) <= 0.99
    assert 0.90 <= np.mean(tips) <= 0.99


def test_badly_told_errors_are_held_near_0_and_said_to_be_so():
    """One station only, in line with X: it hardly sees what goes across."""
    machine = drawn("YXZ", seed=6)
    random = np.random.default_rng(6)
    positions = in_volume(800, random)
    positions[:, 1:3] = np.array([0.0, -400.0]) + random.normal(0.0, 0.5, (800, 2))
    tips = machine.tips(positions, np.zeros(800))
    length = np.linalg.norm(tips - [-3000.0, 0.0, -500.0], axis=1) + random.normal(0.0, SCATTER, 800)
    data = readings(LENGTH, positions, np.zeros(800), np.ones(800, int), length)
    found = Identifier(data, machine.described(), ["EXX", "EYX", "EZX", "EBX", "ECX"], nodes_max=7).fit()
    assert found.regularized
    for sought, values in zip(found.sought, found.values, strict=True):
        assert np.abs(values).max() < (0.5 if sought.name[1] in "XYZ" else 1e-3)


def write(path, header, *columns):
    rows = zip(*(np.asarray(column) for column in columns), strict=True)
    path.write_text(header + "\n" + "\n".join(";".join(f"{v:.6f}" for v in row) for row in rows) + "\n")


def test_the_command_takes_files_of_every_kind_together(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    machine = five_axes(4)
    random = np.random.default_rng(4)
    positions, tools = in_volume(150, random), random.choice([0.0, 150.0], 150)
    data, spheres = lengths_of(machine, positions, tools, SCATTER, 4), spheres_of(machine, 4, count=40)
    p, s = data.positions, spheres.positions
    zeros = np.zeros(len(p))
    columns = (p[:, 0], p[:, 1], p[:, 2], zeros, zeros, data.tool_lengths, data.stations, data.measured[:, 0])
    write(tmp_path / "tracer.csv", "x;y;z;a;c;tool_length;station;displacement [mm]", *columns)
    write(tmp_path / "probe.csv", "x;y;z;a;c;sphere", s[:, 0], s[:, 1], s[:, 2], s[:, 3], s[:, 5], spheres.stations)
    words = ["create", "volumetric", "--from", "tracer.csv", "probe.csv", "--into", "vol_comp0.lis", "--format", "json"]
    words += [
        "--chain",
        "CAYXZ",
        "--axes",
        "5",
        "4",
        "2",
        "1",
        "3",
        "--workpiece-axes",
        "2",
        "--tool-position",
        "0",
        "0",
        "-100",
    ]
    words += ["--tool-orientation", "0", "0", "-1", "--errors", *NAMES, *ROTARY_ERRORS, "PYA", "PZA", "PXC", "PYC"]
    assert main(words) == 0
    found = json.loads(capsys.readouterr().out)
    assert {one["name"] for one in found["stations"]} >= {"place and dead path of station 1", "centre of sphere 4"}
    assert found["tip_uncertainty"]["largest"] > 0.0
    text = (tmp_path / "vol_comp0.csv").read_text()
    assert "PZA" in text
    assert "PXC" in text


@pytest.mark.parametrize(
    ("header", "sentence"),
    [
        ("x,y,z,length,displacement", "have to be of one kind"),
        ("x,y,z,length,dx,dy,dz", "have to be of one kind"),
        ("x,y,z", "have to be of one kind"),
        ("x,y,z,px,py", "There is no column for pz"),
        ("x,y,z,sphere,dx,dy", "There is no column for dz"),
        ("x,y,z,length,station", "1.5 is no number of a station"),
    ],
)
def test_columns_that_do_not_go_together_are_said(tmp_path, header, sentence):
    (tmp_path / "m.csv").write_text(header + "\n" + ",".join(["1.5"] * (header.count(",") + 1)) + "\n")
    with pytest.raises(MeasurementError, match=sentence):
        TcpDeviations.read(tmp_path / "m.csv")


def test_one_gross_outlier_in_any_place_is_named_and_left_out(tmp_path):
    """Without it the tip moves by less than twice its uncertainty."""
    few = {"X": np.linspace(0, 600, 4), "Y": np.linspace(0, 500, 4), "Z": np.linspace(-400, 0, 3)}
    machine = drawn("YXZ", seed=7, nodes=few)
    random = np.random.default_rng(7)
    positions, tools = in_volume(110, random, few), random.choice([0.0, 150.0], 110)
    data = lengths_of(machine, positions, tools, SCATTER, 7)
    target = VolumetricTarget(tmp_path / "vol_comp0.lis", machine.described())
    options = Options(errors=NAMES)
    clean = fit_of("volumetric")(data, target, options)
    assert not clean.outliers()
    stated = clean.identifier.tip_uncertainty(clean.identifier.fit(), positions).max()
    for place in range(0, len(data.runs), 29):
        wrong = replace(data, measured=data.measured.copy())
        wrong.measured[place, 0] += 0.06
        fit = fit_of("volumetric")(wrong, target, options)
        assert [one.place for one in fit.outliers()] == [place]
        without = fit_of("volumetric")(wrong.only(np.arange(len(data.runs)) != place), target, options)
        assert without.moved(clean) <= 2.0 * stated + 1.0
    with pytest.raises(CannotCreateError, match=r"X \d.*off its like .* --outliers drop"):
        create("volumetric", wrong, target, options)
