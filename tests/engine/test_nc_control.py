from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from axcomp.engine import Engine, NcError, Result
from axcomp.kinds import Cross, Friction, Leadscrew
from axcomp.lists import write_machine
from axcomp.model import Axis, AxisType, ErrorTable, Machine, Volumetric
from axcomp.runtime import UpdateError

N = 20


def machine(**parameters: Any) -> Machine:
    """Return X with cross and leadscrew, Y with friction, Z, and two volumetric compensations of 0.01 and 0.1 mm."""
    cross = Cross(2, (0.0, 1.0), (0.5, 0.5), n_cycles=4, manual_activation=True)
    limits = {"volumetric_limit": 1.0, "volumetric_velocity": 1e6}
    x = Axis(1, "X", cross=cross, leadscrew=Leadscrew((0.0, 1.0), (-2.0, -2.0)), **limits)
    y = Axis(2, "Y-Achse", friction=Friction((0.0,), (100.0,)), **limits)
    z = Axis(3, "Z", AxisType.TRANSLATORY, **limits)
    axes = (("X", 1), ("Y", 2), ("Z", 3))
    volumetric = tuple(
        Volumetric(index, axes, errors=(ErrorTable("X0X", (-value,)),), **parameters)
        for index, value in ((0, 0.01), (2, 0.1))
    )
    return Machine((x, y, z), volumetric)


def run(engine: Engine, cycles: int, commands: dict[int, str], **inputs: Any) -> Result:
    column = [commands.get(row, "") for row in range(cycles)]
    return engine.run({"command": column, **{name.replace("__", "."): v for name, v in inputs.items()}})


def test_axis_compensations_follow_their_commands() -> None:
    engine = Engine(machine())
    result = run(
        engine, 20, {2: "X[COMP ON CROSS]", 8: "X[COMP OFF LEAD]", 12: "X[COMP OFF_ALL]", 15: "X[COMP ON LEAD]"}
    )
    ramp = np.sin(np.pi / 2 * np.clip(np.arange(20) - 1, 0, 4) / 4) ** 2
    ramp[12:] = np.sin(np.pi / 2 * np.clip(4 - np.arange(1, 9), 0, 4) / 4) ** 2
    assert result["X.cross.correction"] == pytest.approx(0.5 * ramp)
    on = (np.arange(20) < 8) | (np.arange(20) >= 15)
    assert result["X.leadscrew.correction"].tolist() == [2.0 * active for active in on]


def test_several_axes_in_a_block() -> None:
    engine = Engine(machine())
    result = run(engine, 3, {1: "X[COMP OFF LEAD] \\\n Y-ACHSE[COMP OFF FRICT]"})
    assert result["X.leadscrew.active"].tolist() == [True, False, False]
    assert result["Y_Achse.friction.active"].tolist() == [True, False, False]


def test_off_lasts_beyond_the_end_of_the_program() -> None:
    engine = Engine(machine())
    result = run(engine, 6, {1: "X[COMP OFF LEAD]"}, program_end=[False, False, True, False, True, False])
    assert result["X.leadscrew.active"].tolist() == [True] + [False] * 5


def test_a_command_can_be_repeated_after_the_end_of_the_program() -> None:
    engine = Engine(machine())
    program_end = np.arange(30) == 10
    result = run(engine, 30, {0: "X[COMP ON CROSS]", 20: "X[COMP ON CROSS]"}, program_end=program_end)
    active = result["X.cross.active"]
    assert active[:10].all()
    assert not active[15:20].any()
    assert active[20:].all()


def test_no_move_holds_for_its_command_only() -> None:
    engine = Engine(machine())
    result = run(engine, 12, {2: "X[COMP ON CROSS NO_MOVE]", 6: "X[COMP OFF LEAD]"})
    assert result["X.corrected_setpoint"][:6] == pytest.approx([2.01 + 0.1] * 6)
    assert result["X.setpoint_shift"][5] == -0.5
    assert result["X.corrected_setpoint"][6] == pytest.approx(0.11)
    assert engine.runtime.inputs.axis[0].no_move is False


@pytest.mark.parametrize(
    "block",
    [
        "X[COMP ON CROSS NO_MOVE] X[COMP OFF LEAD]",
        "X[COMP ON CROSS] X[COMP OFF LEAD NO_MOVE]",
        "X[COMP ON CROSS NO_MOVE] X[COMP OFF LEAD NO_MOVE]",
    ],
)
@pytest.mark.parametrize("given", [False, True])
def test_two_commands_for_an_axis_in_one_cycle_leave_no_move_as_it_was(block: str, given: bool) -> None:
    engine = Engine(machine())
    engine.step({"X.no_move": given})
    engine.step(command=block)
    assert engine.runtime.inputs.axis[0].no_move is given


def test_no_move_holds_for_all_its_command_switches() -> None:
    """Cross comes on with 0.5 mm and the leadscrew's 2 mm go: the axis stays where it is, by the shift 1.5 mm."""
    engine = Engine(machine())
    result = run(engine, 6, {3: "X[COMP ON CROSS NO_MOVE OFF LEAD]"})
    assert result["X.corrected_setpoint"] == pytest.approx([2.0 + 0.11] * 6)
    assert result["X.setpoint_shift"].tolist() == [0.0] * 3 + [1.5] * 3


def test_comp_on_without_a_kind_switches_all_on_and_says_so() -> None:
    engine = Engine(machine())
    result = run(engine, 6, {0: "X[COMP OFF_ALL]", 1: "X[COMP ON]"})
    assert result["X.leadscrew.active"].tolist() == [False] + [True] * 5
    assert result["X.cross.active"].tolist() == [False] + [True] * 5
    assert result.notices == ("X[COMP ON] names no kind of compensation: cross, leadscrew is switched on.",)


def smooth(steps: Any) -> Any:
    u = np.clip(np.asarray(steps) / N, 0, 1)
    return 10 * u**3 - 15 * u**4 + 6 * u**5


def test_volumetric_compensations_follow_their_commands() -> None:
    engine = Engine(machine(manual_activation=True))
    result = run(engine, 100, {5: "#VOLCOMP ON [ID=0]", 40: "#VOLCOMP ON [ID2 CFACT_X=0.5]", 70: "#VOLCOMP OFF ALL"})
    k = np.arange(100)
    first = 0.01 * np.where(k < 70, smooth(k - 4), smooth(N - (k - 69)))
    second = 0.05 * np.where(k < 70, smooth(k - 39), smooth(N - (k - 69)))
    assert result["X.volumetric.correction"] == pytest.approx(first + second, abs=1e-12)
    assert not result["volumetric[2].active"][:40].any()
    assert engine.runtime.inputs.volumetric[2].reduction_x == 0.0


def test_cfact_is_not_modal() -> None:
    engine = Engine(machine(manual_activation=True, filter_steps=0))
    result = run(engine, 6, {0: "#VOLCOMP ON [ID=2 CFACT_X=0.5]", 2: "#VOLCOMP OFF [ID=2]", 4: "#VOLCOMP ON [ID=2]"})
    assert result["X.volumetric.correction"] == pytest.approx([0.05, 0.05, 0.0, 0.0, 0.1, 0.1])


def test_two_factors_of_one_cycle_do_not_stay() -> None:
    engine = Engine(machine(manual_activation=True, filter_steps=0))
    result = run(engine, 4, {0: "#VOLCOMP ON [ID=2 CFACT_X=0.5] #VOLCOMP ON [ID=2 CFACT_X=0.3 NO_MOVE]"})
    assert result["X.volumetric.correction"] == pytest.approx([0.03] * 4)
    given = engine.runtime.inputs.volumetric[2]
    assert (given.reduction_x, given.no_move) == (0.0, False)


def test_volcomp_with_no_move_moves_nothing() -> None:
    engine = Engine(machine(manual_activation=True))
    result = run(engine, 60, {5: "#VOLCOMP ON [ID=2 NO_MOVE]", 30: "#VOLCOMP OFF [ID=2 NO_MOVE]"})
    assert result["X.corrected_setpoint"] == pytest.approx([2.0] * 60)
    assert result["X.setpoint_shift"][10] == pytest.approx(-0.1)


def test_after_reset_a_compensation_needs_its_command() -> None:
    engine = Engine(machine(filter_steps=0))
    reset = np.arange(8) == 2
    result = run(engine, 8, {5: "#VOLCOMP ON ALL"}, reset=reset)
    assert result["volumetric[0].active"].tolist() == [True, True, False, False, False, True, True, True]
    assert result["X.corrected_setpoint"] == pytest.approx([2.11] * 8)


def test_a_run_with_commands_is_as_many_steps() -> None:
    commands = ["", "X[COMP ON CROSS]", "", "#VOLCOMP OFF [ID=0 NO_MOVE]", "#VOLCOMP ON [ID=0 CFACT_X=0.3]", "", ""]
    x = np.linspace(0.0, 1.0, 7)
    no_move = [False, False, True, True, False, False, True]
    result = Engine(machine()).run({"X.setpoint": x, "volumetric[0].no_move": no_move, "command": commands})
    engine = Engine(machine())
    steps = [
        engine.step({"X.setpoint": q, "volumetric[0].no_move": held}, command)
        for q, held, command in zip(x.tolist(), no_move, commands, strict=True)
    ]
    for name in steps[0]:
        assert result[name].tolist() == [step[name] for step in steps]


@pytest.mark.parametrize(
    ("block", "place", "expected"),
    [
        ("Q[COMP ON CROSS]", 1, "an axis (X, Y-Achse, Z) is expected, not “Q”"),
        ("X[COMP ON CROSS] Z[COMP ON LEAD]", 18, "axis Z has no leadscrew compensation"),
        ("X[COMP ON FRICT]", 1, "error 70495: axis X has no friction compensation"),
        ("#VOLCOMP ON [ID=1]", 1, "error 21749: there is no volumetric compensation 1: there is only 0, 2"),
        ("V.G.VOLCOMP[1].ACTIVE", 1, "error 70506"),
        ("V.G.VOLCOMP[0].FILE[0] = V.G.VOLCOMP[4].FILE[0]", 26, "error 70506"),
        ("#VOLCOMP [ID=0 UPDATE]", 1, "was not read from any"),
    ],
)
def test_what_the_machine_has_not_is_an_error_before_anything_runs(block: str, place: int, expected: str) -> None:
    engine = Engine(machine())
    with pytest.raises(NcError) as caught:
        engine.step(command=block)
    assert caught.value.place == place
    assert expected in str(caught.value)
    with pytest.raises(ValueError, match="command in row 3: character"):
        run(engine, 5, {3: block})
    assert engine.runtime.cycles == 0


def test_off_of_what_is_not_there_does_nothing() -> None:
    engine = Engine(machine())
    assert run(engine, 2, {0: "Z[COMP OFF CROSS] X[COMP OFF FRICT]"})["X.leadscrew.active"].all()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_machine(machine(manual_activation=True, filter_steps=0), tmp_path)
    (tmp_path / "other.csv").write_text("X0X\n-0.3\n")
    (tmp_path / "bad.csv").write_text("X0X X0X\n-0.3 1\n")
    return tmp_path


def test_an_update_reads_the_parameter_files_of_one_compensation_again(folder: Path) -> None:
    engine = Engine(folder)
    engine.step(command="#VOLCOMP ON ALL")
    (folder / "vol_comp0.csv").write_text("X0X\n-0.02\n")
    (folder / "vol_comp2.csv").write_text("X0X\n-0.7\n")
    held = engine.step(command="#VOLCOMP [ID=0 UPDATE]")
    # Switched off for the update, without motion; compensation 2 stays on with its old data.
    assert held["X.corrected_setpoint"] == pytest.approx(2.11)
    assert (held["volumetric[0].active"], held["volumetric[2].active"]) == (False, True)
    assert engine.step(command="#VOLCOMP ON [ID=0]")["X.volumetric.correction"] == pytest.approx(0.12)
    assert engine.step()["X.corrected_setpoint"] == pytest.approx(2.12)


def test_the_file_variables_say_what_the_next_update_reads(folder: Path) -> None:
    engine = Engine(folder)
    assert engine.nc.read("V.G.VOLCOMP[0].FILE[0]") == "vol_comp0.csv"
    assert engine.nc.read("V.G.VOLCOMP[2].FILE[9]") == ""
    assert engine.nc.read("V.G.VOLCOMP[0].ACTIVE") is False
    commands = {
        0: 'V.G.VOLCOMP[0].FILE[0] = "other.csv"',
        1: "#VOLCOMP [ID=0 UPDATE]",
        2: "#VOLCOMP ON [ID=0]  V.G.VOLCOMP[0].FILE[0]",
        3: "V.G.VOLCOMP[0].ACTIVE V.G.VOLCOMP[2].FILE[1] = V.G.VOLCOMP[0].FILE[0]",
    }
    result = run(engine, 5, commands)
    assert result["X.volumetric.correction"] == pytest.approx([0.0, 0.0, 0.3, 0.3, 0.3])
    assert result.notices == ("V.G.VOLCOMP[0].FILE[0] = other.csv", "V.G.VOLCOMP[0].ACTIVE = True")
    assert engine.nc.read("v.g.volcomp[2].file[1]") == "other.csv"
    engine.nc.write("V.G.VOLCOMP[0].FILE[0]", "vol_comp0.csv")
    engine.step(command="#VOLCOMP [ID=0 UPDATE]")
    assert engine.step(command="#VOLCOMP ON [ID=0]")["X.volumetric.correction"] == pytest.approx(0.01)


def test_variables_of_the_machine_cannot_be_misused(folder: Path) -> None:
    engine = Engine(folder)
    for name in (
        "V.G.VOLCOMP[5].ACTIVE",
        "V.G.VOLCOMP[0].FILE[10]",
        "V.G.VOLCOMP[1].ACTIVE",
        "X",
        "V.G.VOLCOMP[0].ACTIVE 1",
    ):
        with pytest.raises(NcError):
            engine.nc.read(name)
    with pytest.raises(NcError, match="can only be read"):
        engine.nc.write("V.G.VOLCOMP[0].ACTIVE", "1")


@pytest.mark.parametrize(("name", "code"), [("bad.csv", "70469"), ("missing.csv", "AXC-MISSING")])
def test_a_refused_update_keeps_the_old_data(folder: Path, name: str, code: str) -> None:
    engine = Engine(folder)
    engine.step(command="#VOLCOMP ON ALL")
    engine.nc.write("V.G.VOLCOMP[0].FILE[0]", name)
    with pytest.raises(NcError, match=f"keeps its old data.*{code}"):
        engine.step(command="#VOLCOMP [ID=0 UPDATE]")
    assert engine.step()["X.volumetric.correction"] == pytest.approx(0.11)


def test_an_update_renews_everything_of_the_list(folder: Path) -> None:
    engine = Engine(folder)
    assert engine.step(command="#VOLCOMP ON [ID=0]")["X.volumetric.correction"] == pytest.approx(0.01)
    text = (folder / "vol_comp0.lis").read_text().replace("End", "") + "manual_activation 0\nfilter_steps 2\n"
    (folder / "vol_comp0.lis").write_text(text + "negate X\n")
    (folder / "vol_comp0.csv").write_text("X0X Y0Y\n-0.02 0.03\n")
    held = engine.step(command="#VOLCOMP [ID=0 UPDATE]")
    # It is automatic now: it comes back by itself, over two cycles.
    assert held["volumetric[0].active"]
    assert held["X.corrected_setpoint"] == pytest.approx(2.0 + 0.01 - 0.5 * (0.01 + 0.02))
    after = engine.step()
    assert after["X.volumetric.correction"] == pytest.approx(-0.02)
    assert after["Y_Achse.volumetric.correction"] == pytest.approx(-0.03)
    assert after["X.corrected_setpoint"] == pytest.approx(1.98)
    (folder / "vol_comp0.lis").write_text(text + "set_to_zero X\n")
    engine.step(command="#VOLCOMP [ID=0 UPDATE]")
    engine.step()
    assert engine.step()["X.volumetric.correction"] == 0.0


def test_a_volumetric_command_in_motion_is_told(folder: Path) -> None:
    engine = Engine(folder)
    engine.step({"X.velocity": 5.0})
    with_motion = engine.run({"command": ["#VOLCOMP ON ALL", "#VOLCOMP [ID=0 UPDATE]"]}).notices
    told = "#VOLCOMP while X moves: the controller stops the machine first."
    assert with_motion == (told, told)
    engine.step({"X.velocity": 0.0})
    assert engine.run({"command": ["#VOLCOMP OFF ALL"]}).notices == ()


def test_what_is_active_can_be_read() -> None:
    engine = Engine(machine())
    engine.step(command="X[COMP ON CROSS]")
    assert engine.nc.read("V.A.CROSS_COMP_ACTIVE.X") is True
    assert engine.nc.read("v.a.lead_comp_active.x") is True
    result = run(engine, 2, {0: "X[COMP OFF LEAD]", 1: "V.A.LEAD_COMP_ACTIVE.X V.A.FRICT_COMP_ACTIVE.Y-ACHSE"})
    assert result.notices == ("V.A.LEAD_COMP_ACTIVE.X = False", "V.A.FRICT_COMP_ACTIVE.Y-ACHSE = True")
    for name in ("V.A.PLANE_COMP_ACTIVE.X", "V.A.CROSS_COMP_ACTIVE.W", "V.A.CROSS_COMP_INIT.X"):
        with pytest.raises(NcError):
            engine.nc.read(name)
    with pytest.raises(NcError, match="can only be read"):
        engine.nc.write("V.A.CROSS_COMP_ACTIVE.X", "1")


def test_an_update_is_told_to_whom_it_may_concern(folder: Path) -> None:
    engine = Engine(folder)
    engine.nc.on_update = lambda index: [f"{index} is new"]
    assert engine.run({"command": ["#VOLCOMP [ID=2 UPDATE]"]}).notices == ("2 is new",)


def test_an_update_cannot_change_the_axes_of_the_machine() -> None:
    engine = Engine(machine())
    with pytest.raises(UpdateError):
        engine.runtime.update(replace(machine(), axes=machine().axes[:2], volumetric=()))
