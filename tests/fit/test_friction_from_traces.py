"""Friction tables from traces: of a LuGre axis that SciPy integrates, with noise, outliers and asymmetry."""

from __future__ import annotations

import json
from functools import cache

import numpy as np
import pytest
from tracing import CYCLE, LuGreAxis, to_and_fro, write_trace

from axcomp.cli import main
from axcomp.fit import FrictionReadings, Options, TargetList, create
from axcomp.lists import read_machine
from axcomp.measurement import AxisTrace

SPEEDS = np.geomspace(0.7, 230.0, 16)
AXIS = LuGreAxis()


@cache
def recorded(offset: float = AXIS.offset, asymmetry: float = AXIS.asymmetry):
    time, velocity = to_and_fro(SPEEDS)
    return time, velocity, AXIS._replace(offset=offset, asymmetry=asymmetry).force(time, velocity)


def noisy(folder, seed=0, noise=6.0, **which):
    time, velocity, force = recorded(**which)
    random = np.random.default_rng(seed)
    position = np.cumsum(velocity) * CYCLE
    return write_trace(
        folder / f"trace{seed}.csv",
        time=time,
        position=np.round(position, 5),
        velocity=velocity + random.normal(0.0, 0.02, len(time)),
        force=force + random.normal(0.0, noise, len(time)),
        other=np.zeros(len(time)),
    )


def create_json(capsys, *words):
    status = main(["create", "friction", *map(str, words), "--format", "json"])
    captured = capsys.readouterr()
    assert status == 0, captured.err
    return json.loads(captured.out)


def table_of(path):
    return read_machine(path, strict=True).machine.axes[0].friction


@pytest.mark.parametrize("seed", range(4))
def test_the_table_is_within_3_percent_of_the_steady_curve(seed, tmp_path, capsys):
    made = create_json(capsys, "--from", noisy(tmp_path, seed), "--into", tmp_path / "new.lis", "--axis", 1)
    table = table_of(tmp_path / "new.lis")
    at = np.geomspace(1.0, 200.0, 400)
    assert np.interp(at, table.velocities, table.currents) == pytest.approx(AXIS.steady(at), rel=0.03)
    assert made["offset"] == pytest.approx(AXIS.offset, abs=made["offset_uncertainty"])
    assert made["asymmetry"] == pytest.approx(AXIS.asymmetry, abs=made["asymmetry_uncertainty"])
    assert made["asymmetry_uncertainty"] < 0.04
    ((inertia, uncertainty),) = made["inertia"]
    assert inertia == pytest.approx(AXIS.mass * 1e-3, abs=uncertainty + 2e-3)
    assert any("Columns that are not used: other" in note for note in made["notes"])


def test_each_direction_is_known_within_its_uncertainty(tmp_path, capsys):
    made = create_json(capsys, "--from", noisy(tmp_path, 9), "--into", tmp_path / "new.lis", "--axis", 1)
    levels = made["levels"]
    speeds, inside = np.array(levels["velocities"]), []
    for way, sign in (("positive", 1.0), ("negative", -1.0)):
        expected = (1.0 + sign * AXIS.asymmetry) * AXIS.steady(speeds) + sign * AXIS.offset
        inside += list(np.abs(np.array(levels[way]) - expected) < np.array(levels[f"uncertainty_{way}"]))
    assert len(inside) == 2 * len(SPEEDS)
    assert np.mean(inside) > 0.85


def test_coverage_of_offset_and_asymmetry_over_seeds(tmp_path):
    time, velocity, force = recorded()
    inside = []
    for seed in range(20):
        noise = np.random.default_rng(seed).normal(0.0, (0.02, 6.0), (len(time), 2)).T
        columns = {"velocity": velocity + noise[0], "current": force + noise[1]}
        readings = FrictionReadings.of(AxisTrace(time, columns, "mm", "memory"))
        made = create("friction", readings, TargetList(tmp_path / "new.lis", 1)).to_dict()
        for name in ("offset", "asymmetry"):
            inside.append(abs(made[name] - getattr(AXIS, name)) < made[f"{name}_uncertainty"])
    assert np.mean(inside) >= 0.85


def test_what_a_list_cannot_hold_is_said_in_figures(tmp_path, capsys):
    file = noisy(tmp_path)
    assert main(["create", "friction", "--from", str(file), "--into", str(tmp_path / "new.lis"), "--axis", "1"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "constant current of -2" in said
    assert "off the mean of both directions in the positive one" in said
    assert "Together they leave up to" in said
    assert "velocities within 5 % count as one" in said


def test_a_symmetric_axis_is_not_said_to_be_asymmetric(tmp_path, capsys):
    made = create_json(
        capsys, "--from", noisy(tmp_path, 3, offset=0.0, asymmetry=0.0), "--into", tmp_path / "new.lis", "--axis", 1
    )
    assert not [note for note in made["notes"] if "constant current" in note or "off the mean" in note]


def test_spikes_in_the_current_move_nothing(tmp_path, capsys):
    time, velocity, force = recorded()
    random = np.random.default_rng(5)
    force = force + random.normal(0.0, 3.0, len(time))
    spiked = force.copy()
    spiked[random.choice(len(time), 200, replace=False)] += 4000.0
    tables = []
    for name, values in (("clean", force), ("spiked", spiked)):
        file = write_trace(tmp_path / f"{name}.csv", time=time, velocity=velocity, current=values)
        create_json(capsys, "--from", file, "--into", tmp_path / f"{name}.lis", "--axis", 1)
        tables.append(table_of(tmp_path / f"{name}.lis"))
    at = np.geomspace(1.0, 200.0, 50)
    clean, off = (np.interp(at, table.velocities, table.currents) for table in tables)
    assert off == pytest.approx(clean, rel=0.01)


def test_columns_are_mapped_with_units_as_in_replay(tmp_path, capsys):
    time, velocity, force = recorded()
    file = write_trace(
        tmp_path / "t.csv", T=time * 1e3, Vist=velocity * 0.06, Iist=force, Xsoll=np.cumsum(velocity) * CYCLE
    )
    words = ["--from", file, "--into", tmp_path / "new.lis", "--axis", 1]
    made = create_json(capsys, *words, "--map", "time=T[ms],velocity=Vist[m/min],current=Iist")
    assert made["asymmetry"] == pytest.approx(AXIS.asymmetry, abs=0.02)
    # Without a velocity it follows from the setpoint; without a time from the cycle.
    again = create_json(capsys, *words, "--map", "setpoint=Xsoll,current=Iist,time=", "--cycle-time", CYCLE)
    assert again["asymmetry"] == pytest.approx(AXIS.asymmetry, abs=0.02)
    assert main(["create", "friction", *map(str, words), "--map", "velocity=V,current=Iist"]) == 1
    assert "t.csv: There is no column 'V'" in capsys.readouterr().err


def test_velocities_close_together_do_not_zig_zag(tmp_path):
    """As on a public benchmark: 34 and 40 N one µm/s apart."""
    random = np.random.default_rng(2)
    speeds = np.sort(np.concatenate([np.geomspace(0.5, 200.0, 40), np.geomspace(0.5, 200.0, 40) + 0.001]))
    currents = 30.0 + 12.0 * np.exp(-speeds / 3.0) + 0.1 * speeds + random.normal(0.0, 2.5, 80)
    currents[40:42] = 34.0, 40.0
    readings = FrictionReadings(
        np.tile(speeds, 2) * np.repeat([1, -1], 80), np.repeat([1, -1], 80) * np.tile(currents, 2), np.ones(160, int)
    )
    creation = create("friction", readings, TargetList(tmp_path / "new.lis", 1), Options(max_points=40))
    table = creation.compensation
    turns = np.diff(np.sign(np.diff(table.currents)[np.diff(table.currents) != 0.0]))
    assert np.count_nonzero(turns) <= 2
    assert np.min(np.diff(table.velocities) / table.velocities[:-1]) > 0.02
    at = np.geomspace(1.0, 200.0, 50)
    assert np.interp(at, table.velocities, table.currents) == pytest.approx(
        30.0 + 12.0 * np.exp(-at / 3.0) + 0.1 * at, abs=3.0
    )


def test_reversals_propose_the_parameters_and_go_into_the_list_on_demand(tmp_path, capsys):
    time, velocity = to_and_fro(np.full(4, 20.0), hold=0.4)
    velocity = 20.0 * np.sin(2.0 * np.pi * time / 2.0)
    force = AXIS.force(time, velocity)
    slow = to_and_fro(SPEEDS[::3])
    time = np.concatenate([time, time[-1] + CYCLE + slow[0]])
    velocity = np.concatenate([velocity, slow[1]])
    force = np.concatenate([force, AXIS.force(*slow)])
    setpoint = np.cumsum(velocity) * CYCLE
    position = np.concatenate([np.full(3, setpoint[0]), setpoint[:-3]])
    file = write_trace(
        tmp_path / "t.csv", time=time, setpoint=setpoint, position=position, velocity=velocity, current=force
    )
    words = ["--from", file, "--into", tmp_path / "new.lis", "--axis", 1]
    proposed = create_json(capsys, *words)["reversal"]
    assert table_of(tmp_path / "new.lis").position_delay == 0.0
    # Friction goes as 1 − 2 exp(−s/z) over the travel s, z = 0.015 mm: the ramp that comes closest, found on its own.
    s = np.linspace(0.0, 1.0, 200_001)
    ramps = [
        np.mean((1.0 - 2.0 * np.exp(-s / 0.015) - np.minimum(s / d, 1.0)) ** 2) for d in np.geomspace(0.005, 0.2, 400)
    ]
    assert proposed["position_delay"] == pytest.approx(np.geomspace(0.005, 0.2, 400)[np.argmin(ramps)], rel=0.3)
    assert proposed["delay_cycles"] == 3
    create_json(capsys, *words, "--reversal")
    table = table_of(tmp_path / "new.lis")
    assert (table.position_delay, table.delay_cycles) == (proposed["position_delay"], 3)


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"time": np.arange(100) * 0.01, "velocity": np.ones(100)}, "no column for current"),
        ({"time": np.arange(100) * 0.01, "current": np.ones(100)}, "Nothing says how the axis moves"),
        ({"time": np.zeros(100), "velocity": np.ones(100), "current": np.ones(100)}, r"t.csv:3: time must ascend"),
        ({"time": np.arange(9), "velocity": np.ones(9), "current": np.ones(9)}, "9 rows are too few"),
        ({"time": np.arange(100) * 0.01, "velocity": np.zeros(100), "current": np.ones(100)}, "never moves"),
        (
            {"time": np.arange(200) * 0.01, "velocity": np.linspace(-1.0, 100.0, 200), "current": np.ones(200)},
            "no stretch of 0.04 s",
        ),
    ],
)
def test_a_trace_that_cannot_be_used_is_refused_with_a_sentence(columns, words, tmp_path, capsys):
    file = write_trace(tmp_path / "t.csv", **columns)
    assert main(["create", "friction", "--from", str(file), "--into", str(tmp_path / "new.lis"), "--axis", "1"]) == 1
    error = capsys.readouterr().err
    assert words.replace(r"t.csv", str(file)) in error
    assert "Traceback" not in error


def test_inertia_is_taken_off_where_the_velocity_changes_slowly():
    """Ramps of 60 mm/s² take 60 of a heavy axis; quick ones tell how heavy it is."""
    time, velocity = to_and_fro([30.0, 60.0, 120.0, 200.0], hold=0.4)
    slow = np.concatenate([np.linspace(20.0, 200.0, 1500), np.linspace(200.0, 0.0, 200), np.zeros(60)])
    velocity = np.convolve(np.concatenate([velocity, slow, -slow]), np.ones(15) / 15.0, "same")
    time = np.arange(len(velocity)) * CYCLE
    force = np.gradient(velocity, time) + np.sign(velocity) * (300.0 + 0.6 * np.abs(velocity))
    force += np.random.default_rng(1).normal(0.0, 2.0, len(time))
    readings = FrictionReadings.of(AxisTrace(time, {"velocity": velocity, "current": force}, "mm", "memory"))
    assert len(readings.velocities) > 20
    off = np.sign(readings.velocities) * readings.currents - (300.0 + 0.6 * np.abs(readings.velocities))
    assert np.median(np.abs(off)) < 3.0
    assert np.max(np.abs(off)) < 15.0
