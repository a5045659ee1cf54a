"""The rigid bodies against SciPy's rotations, by the ISO 230 model to first order, and what a perfect machine does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from planting import axis
from scipy.spatial.transform import Rotation

from axcomp.plant import Plant, PlantError, curves, poses, rigid_bodies

NAMES = ("X", "Y", "Z", "A", "B", "C")
ROTARY = (False, False, False, True, True, True)
DIRECTIONS = np.vstack([np.eye(3), np.eye(3)])
RANDOM = np.random.default_rng(11)
TOOL = (3.0, -4.0, -150.0)


def random_joint(index: int, size: float = 1.0) -> dict[str, Any]:
    def three(scale: float) -> list[float]:
        return (size * RANDOM.normal(scale=scale, size=3)).tolist()

    joint: dict[str, Any] = {"direction": DIRECTIONS[index].tolist(), "tilt": three(1e4), "motion": {}}
    if ROTARY[index]:
        joint |= {"center": RANDOM.normal(scale=200.0, size=3).tolist(), "offset": three(1e3)}
    for name, scale in zip("xyzabc", (1e3, 1e3, 1e3, 1e4, 1e4, 1e4), strict=True):
        amplitude, phase = size * scale * RANDOM.uniform(0.3, 1.0), RANDOM.uniform(0.0, 360.0)
        wave = {"amplitude": amplitude, "period": 180.0, "phase": phase}
        joint["motion"][name] = {"scale": 200.0, "polynomial": three(scale), "waves": [wave]}
    return joint


def bodies(workpiece: str, tool: str, size: float = 1.0) -> tuple[Any, dict[str, Any]]:
    joints = {name: random_joint(index, size) for index, name in enumerate(NAMES)}
    description = {"workpiece": [*workpiece], "tool": [*tool], "axes": joints, "tool_direction": [0, 0, -1]}
    return rigid_bodies.RigidBodies(description, NAMES, ROTARY), joints


def matrix(turn: Rotation, shift: Sequence[float]) -> NDArray[np.float64]:
    made = np.eye(4)
    made[:3, :3], made[:3, 3] = turn.as_matrix(), shift
    return made


def joint_matrix(name: str, joint: dict[str, Any], q: float) -> NDArray[np.float64]:
    """The pose of the carried body, put together from frames: to the axis, along or about it, wobbling, and back."""
    tilt = Rotation.from_rotvec(1e-6 * np.array(joint["tilt"]))
    e = np.array(joint["direction"])
    values = [curves.Curve(joint["motion"][k])(q) - curves.Curve(joint["motion"][k])(0.0) for k in "xyzabc"]
    wobble = Rotation.from_rotvec(1e-6 * np.array(values[3:]))
    shift = 1e-3 * np.array(values[:3])
    still = Rotation.identity()
    if name in "XYZ":
        return matrix(still, q * tilt.apply(e) + shift) @ matrix(wobble, [0.0] * 3)
    center = np.array(joint["center"])
    beside = matrix(tilt, center + 1e-3 * np.array(joint["offset"]))
    turning = beside @ matrix(Rotation.from_rotvec(np.radians(q) * e), [0.0] * 3) @ np.linalg.inv(beside)
    return matrix(still, center + shift) @ matrix(wobble, [0.0] * 3) @ matrix(still, -center) @ turning


@pytest.mark.parametrize(
    ("workpiece", "tool"), [("CB", "YXZ"), ("", "YXZ"), ("XCA", "YZ"), ("CBYXZ", ""), ("", "XYZABC")]
)
def test_the_tool_is_where_scipy_says(workpiece: str, tool: str) -> None:
    machine, joints = bodies(workpiece, tool)
    for _ in range(10):
        q = RANDOM.uniform(-300.0, 300.0, size=6).tolist()
        seen = np.eye(4)
        for name in workpiece:
            seen = seen @ np.linalg.inv(joint_matrix(name, joints[name], q[NAMES.index(name)]))
        for name in tool:
            seen = seen @ joint_matrix(name, joints[name], q[NAMES.index(name)])
        assert np.allclose(machine.place(TOOL, q), (seen @ [*TOOL, 1.0])[:3], rtol=0.0, atol=1e-9)


def test_without_errors_it_is_at_its_nominal_place() -> None:
    machine, _ = bodies("CB", "YXZ", size=0.0)
    for _ in range(10):
        q = RANDOM.uniform(-300.0, 300.0, size=6).tolist()
        assert machine.place(TOOL, q) == pytest.approx(machine.nominal_place(TOOL, q), abs=1e-10)


def test_with_all_axes_at_0_everything_is_where_it_should_be() -> None:
    machine, _ = bodies("CB", "YXZ")
    assert machine.place(TOOL, [0.0] * 6) == pytest.approx(TOOL, abs=1e-12)


def test_a_turn_of_the_table_carries_the_workpiece_away_under_the_tool() -> None:
    description = {
        "workpiece": ["C"],
        "tool": ["X"],
        "axes": {"C": {"direction": [0, 0, 1], "center": [100, 0, 0]}, "X": {"direction": [1, 0, 0]}},
        "tool_position": [0, 0, 50],
        "tool_direction": [0, 0, -1],
    }
    machine = rigid_bodies.RigidBodies(description, ("X", "C"), (False, True))
    assert machine.tip(30.0) == (0.0, 0.0, 20.0)
    # The table turns left about x = 100; the point above x = 130 was in front of it, at y = −30, before.
    assert machine.nominal_place(machine.tip(30.0), [130.0, 90.0]) == pytest.approx((100.0, -30.0, 20.0))
    assert machine.place(machine.tip(30.0), [130.0, 90.0 - 720.0]) == pytest.approx((100.0, -30.0, 20.0))


def test_small_errors_add_up_as_iso_230_1_says() -> None:
    """X on Y, Z on X, tool at rest: translations add, rotations act with the arms that lie beyond them."""
    machine, joints = bodies("", "YXZ", size=1e-3)
    q = [120.0, -80.0, -150.0]
    x, _, z = q
    shifts, turns, ways = [], [], []
    for name, position in zip("XYZ", q, strict=True):
        values = [curves.Curve(joints[name]["motion"][k]) for k in "xyzabc"]
        found = np.array([curve(position) - curve(0.0) for curve in values])
        shifts.append(1e-3 * found[:3])
        turns.append(1e-6 * found[3:])
        ways.append(position * np.cross(1e-6 * np.array(joints[name]["tilt"]), joints[name]["direction"]))
    error = sum(shifts) + sum(ways)
    error += np.cross(turns[1], [x, 0.0, z]) + np.cross(turns[0], [0.0, 0.0, z]) + np.cross(sum(turns), TOOL)
    found = np.subtract(machine.place(TOOL, [*q, 0.0, 0.0, 0.0]), machine.nominal_place(TOOL, [*q, 0.0, 0.0, 0.0]))
    assert np.max(np.abs(error)) > 1e-3
    assert np.allclose(found, error, rtol=0.0, atol=1e-6)


def test_a_pose_turns_about_its_center() -> None:
    turn, center = RANDOM.normal(size=3), RANDOM.normal(scale=50.0, size=3)
    pose = poses.turned(tuple(turn), tuple(center))
    assert pose.place(tuple(center)) == pytest.approx(center, abs=1e-12)
    assert np.allclose(pose.rows, Rotation.from_rotvec(turn).as_matrix(), rtol=0.0, atol=1e-14)
    assert pose.place_back(pose.place(TOOL)) == pytest.approx(TOOL, abs=1e-12)


def test_the_plants_tool_follows_the_axes_own_errors_too() -> None:
    machine = {"workpiece": [], "tool": ["X"], "axes": {"X": {"direction": [1, 0, 0]}}, "tool_direction": [0, 0, 1]}
    description = {"sub_step": 1e-3, "rigid_bodies": machine}
    plant = Plant({**description, "axes": [axis(errors={"pitch": {"positive": {"polynomial": [5.0]}}})]})
    plant.rest_at([10.0])
    assert plant.place((0.0, 0.0, 7.0)) == pytest.approx((10.005, 0.0, 7.0))
    with pytest.raises(PlantError, match="no rigid bodies"):
        Plant({"sub_step": 1e-3, "axes": [axis()]}).place((0.0, 0.0, 0.0))


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"tool": ["Q"]}, "ValueError"),
        ({"axes": {}}, "'X' is missing"),
        ({"axes": {"X": {"direction": [0, 0, 0]}}}, "ZeroDivisionError"),
        ({"axes": {"X": {"direction": [1, 0]}}}, "ValueError"),
        ({"axes": {"X": {"direction": [1, 0, 0], "motion": {"d": {}}}}}, "motion has no d"),
        ({"axes": []}, "TypeError"),
    ],
)
def test_a_wrong_description_is_refused(changes: dict[str, Any], what: str) -> None:
    right = {"workpiece": [], "tool": ["X"], "axes": {"X": {"direction": [1, 0, 0]}}, "tool_direction": [0, 0, 1]}
    Plant({"sub_step": 1e-3, "axes": [axis()], "rigid_bodies": right})
    with pytest.raises(PlantError, match=f"rigid_bodies: .*{what}"):
        Plant({"sub_step": 1e-3, "axes": [axis()], "rigid_bodies": right | changes})
