"""What a trajectory does not say but its setpoints do: velocity, acceleration, and the velocities to come."""

from __future__ import annotations

import numpy as np
import pytest
from fmu_host import Host, in_child
from hypothesis import given, settings, strategies as st

from axcomp.engine import Engine
from axcomp.fmu import package_axcomp, package_native
from axcomp.kinds import CrosstalkCurve, Friction
from axcomp.lists import write_machine
from axcomp.model import Axis, AxisType, Machine, ModuloRange

T = 0.001
FRICTION = Friction((1.0, 100.0), (1.0, 3.0), 0.8, 0.01, 4)


def of(friction: Friction) -> Machine:
    return Machine((Axis(1, "X", friction=friction),))


def curved(seed: int, cycles: int = 300) -> np.ndarray:
    """Velocities in mm/s that turn round, stand still and slow down without turning, and never decelerate evenly."""
    rng = np.random.default_rng(seed)
    knots = rng.uniform(-60.0, 60.0, cycles // 20 + 2)
    knots[rng.random(len(knots)) < 0.3] = 0.0
    knots[1::3] = np.abs(knots[1::3]) * 0.05
    at = np.arange(cycles) / 20.0
    return np.interp(at, np.arange(len(knots)), knots) + 0.5 * np.sin(at) * (np.arange(cycles) % 3)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, 3), st.integers(1, 4))
def test_with_the_trajectory_known_the_look_ahead_is_that_of_a_long_delay(
    seed: int, delay: int, lookahead: int
) -> None:
    velocity = curved(seed)
    setpoint = np.cumsum(velocity) * T
    given_ = {"X.setpoint": setpoint, "X.velocity": velocity}
    currents = []
    for cycles in (delay, 20):
        machine = of(Friction((1.0, 100.0), (1.0, 3.0), 0.8, 0.0, lookahead, cycles))
        currents.append(Engine(machine, T).run(given_).columns["X.current"][cycles:])
    n = len(velocity) - 20
    # The delay line holds the same values, only later: what the last cycles see is not known to it.
    assert currents[0][:n] == pytest.approx(currents[1][:n], abs=1e-12)


def test_a_slow_down_that_goes_on_the_same_way_is_not_weighted() -> None:
    velocity = np.concatenate([np.linspace(20.0, 1.0, 20), np.linspace(1.0, 20.0, 20)])
    run = Engine(of(Friction((1.0, 100.0), (1.0, 3.0), 1.0, 0.0, 4)), T).run(
        {"X.setpoint": np.cumsum(velocity) * T, "X.velocity": velocity}
    )
    assert run.columns["X.current"] == pytest.approx(np.interp(velocity, [1.0, 100.0], [1.0, 3.0]), abs=1e-12)


def test_velocity_and_acceleration_follow_from_setpoints_by_backward_differences_and_this_is_told() -> None:
    setpoint = np.cumsum(curved(5)) * T
    velocity = np.diff(setpoint, prepend=setpoint[0]) / T
    acceleration = np.diff(velocity, prepend=0.0) / T
    crosstalk = CrosstalkCurve(1, (-1e5, 0.0, 1e5), (-0.1, 0.0, 0.1))
    machine = Machine((Axis(1, "X", friction=FRICTION), Axis(2, "Y", crosstalk=crosstalk)))
    derived = Engine(machine, T).run({"X.setpoint": setpoint})
    typed = {"X.setpoint": setpoint, "X.velocity": velocity, "X.acceleration": acceleration}
    said = Engine(machine, T).run(typed)
    for name in ("X.current", "Y.crosstalk.correction"):
        assert np.abs(derived.columns[name]).max() > 0.0
        assert derived.columns[name].tolist() == said.columns[name].tolist()
    assert [notice for notice in derived.notices if "X.velocity, X.acceleration not given" in notice]
    assert said.notices == ()


def test_on_a_modulo_axis_the_velocity_goes_on_over_the_seam() -> None:
    machine = Machine((Axis(1, "C", AxisType.ROTARY, ModuloRange(0.0, 360.0), friction=FRICTION),))
    counted = np.arange(100) * 0.05 + 358.0
    folded = Engine(machine, T).run({"C.setpoint": np.mod(counted, 360.0)})
    whole = Engine(machine, T).run({"C.setpoint": counted})
    assert folded.columns["C.current"] == pytest.approx(whole.columns["C.current"], abs=1e-9)
    assert folded.columns["C.current"][-1] > 0.8


def test_a_run_goes_on_where_the_last_one_ended() -> None:
    setpoint = np.cumsum(curved(7)) * T
    friction = Friction((1.0, 100.0), (1.0, 3.0), 1.0, 0.01)
    whole = Engine(of(friction), T).run({"X.setpoint": setpoint})
    engine = Engine(of(friction), T)
    parts = [engine.run({"X.setpoint": part}).columns["X.current"] for part in np.split(setpoint, [100, 101])]
    assert np.concatenate(parts).tolist() == whole.columns["X.current"].tolist()


def currents(fmu: str, setpoints: list[float], derive: bool) -> list[float]:
    with Host(fmu, parameters={"derive_motion": derive}) as host:
        return [host.step({"X.setpoint": setpoint})["X.current"] for setpoint in setpoints]


@pytest.mark.parametrize("package", [package_axcomp, package_native])
def test_an_fmu_derives_motion_where_it_is_asked_to(package, tmp_path) -> None:
    """For hosts that only have setpoints: the parameter ``derive_motion``."""
    friction = Friction((1.0, 100.0), (1.0, 3.0), 1.0, 0.01)
    write_machine(of(friction), tmp_path / "lists")
    fmu = package(tmp_path / "lists", tmp_path / "axcomp.fmu", cycle_time=T).path
    setpoints = (np.cumsum(curved(11, 60)) * T).tolist()
    expected = Engine(of(friction), T).run({"X.setpoint": setpoints}).columns["X.current"]
    assert in_child(currents, fmu, setpoints, True) == expected.tolist()
    assert in_child(currents, fmu, setpoints, False) == [0.0] * 60
