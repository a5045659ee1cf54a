"""What the values of a switch command: 0 as the lists say, 1 on, −1 off; anything else nothing."""

from __future__ import annotations

import pytest

from axcomp.engine import Engine
from axcomp.kernel import ERROR_SWITCH
from axcomp.kinds import Cross
from axcomp.model import Axis, Machine
from axcomp.runtime import Runtime


def machine(*, manual: bool) -> Machine:
    cross = Cross(1, (0.0, 1.0), (0.25, 0.25), manual_activation=manual)
    return Machine((Axis(1, "M"), Axis(2, "S", cross=cross)))


def active(switch: list[int], *, manual: bool) -> str:
    engine = Engine(machine(manual=manual))
    return "".join("1" if engine.step({"S.cross.switch": s})["S.cross.active"] else "." for s in switch)


@pytest.mark.parametrize(
    ("switch", "manual", "expected"),
    [
        ([0, 0, 0], False, "111"),
        ([0, 0, 0], True, "..."),
        ([1, 1, 0, 0], True, "11.."),
        ([-1, -1, 0, 0, -1], False, "..11."),
        ([0, 1, 0, -1, 1], True, ".1..1"),
        ([0, 1, 0, -1, 1], False, "111.1"),
        ([7, 7], False, "11"),
        ([7, 7, 1], True, "..1"),
        ([1, -2, 0, 1, 3], True, "11.11"),
        ([-1, 2**31 - 1, -1, 0], False, "...1"),
    ],
)
def test_a_change_is_a_command(switch: list[int], manual: bool, expected: str) -> None:
    assert active(switch, manual=manual) == expected


def test_what_commands_nothing_is_an_error_until_reset_and_told_once() -> None:
    engine = Engine(machine(manual=False))
    rows = {"S.cross.switch": [0, 5, 5, 1, 1, 1], "reset": [False] * 5 + [True]}
    result = engine.run(rows)
    assert result["S.error"].tolist() == [0, 904, 904, 904, 904, 0]
    assert not result["M.error"].any()
    assert result["S.cross.active"].all()
    runtime = Runtime(machine(manual=False))
    runtime.inputs.axis[1].wanted[0] = -9
    runtime.cycle()
    assert runtime.outputs.axis[1].error == ERROR_SWITCH
    assert list(runtime.notices()) == ["axis S: an input switch was neither -1, 0 nor 1; it commanded nothing"]
    assert list(runtime.notices()) == []


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 1e300, 2.0])
def test_a_trajectory_with_what_commands_nothing_runs_on(value: float) -> None:
    result = Engine(machine(manual=False)).run({"S.cross.switch": [-1.0, value, value]})
    assert (result["S.cross.active"].tolist(), result["S.error"].tolist()) == ([False] * 3, [0, 904, 904])


def test_lists_that_become_automatic_switch_on_what_is_not_commanded_off() -> None:
    for switch, expected in ((0, True), (-1, False), (1, True)):
        runtime = Runtime(machine(manual=True))
        runtime.cycle()
        runtime.inputs.axis[1].wanted[0] = switch
        runtime.cycle()
        runtime.update(machine(manual=False))
        runtime.cycle()
        assert runtime.outputs.axis[1].active[0] == expected
