from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import is_dataclass, replace
from typing import Any

import pytest
from fmu_machines import three_axes, trajectory

from axcomp.engine import Engine
from axcomp.interface import AXIS_DECLARATIONS, by_name, slot_of, variables_of, with_causality
from axcomp.kernel import AxisInputs, AxisOutputs, fields_of, zero
from axcomp.kinds import Cross, Friction, Leadscrew
from axcomp.model import Axis, AxisType, Machine
from axcomp.runtime import compile_tables, initial_inputs

NO_CROSS = Cross(1, (0.0, 1.0), (0.0, 0.0))


def bare(*names: str) -> Machine:
    return Machine(tuple(Axis(number, name) for number, name in enumerate(names, start=1)))


def test_only_what_is_configured_appears_and_fault_always() -> None:
    machine = Machine((Axis(1, "X", leadscrew=Leadscrew((0.0, 1.0), (0.0, 0.0))), Axis(2, "Y")))
    names = set(by_name(variables_of(machine)))
    assert {"X.leadscrew.switch", "X.leadscrew.correction", "X.leadscrew.active", "X.fault", "Y.fault"} <= names
    assert not {name for name in names if name.startswith("Y.leadscrew") or "cross" in name or "current" in name}


def test_friction_has_a_current_and_no_correction() -> None:
    names = by_name(variables_of(Machine((Axis(1, "X", friction=Friction((0.0,), (1.0,))),))))
    assert "X.current" in names
    assert "X.friction.correction" not in names


@pytest.mark.parametrize(("kind", "unit"), [(AxisType.TRANSLATORY, "mm"), (AxisType.ROTARY, "deg")])
def test_units_are_those_of_the_axis(kind: AxisType, unit: str) -> None:
    variables = by_name(variables_of(Machine((Axis(1, "A", kind),))))
    assert variables["A.setpoint"].unit == unit
    assert variables["A.velocity"].unit == f"{unit}/s"
    assert variables["A.acceleration"].unit == f"{unit}/s2"
    assert variables["A.error"].unit == ""
    assert variables["cycle_time"].unit == "s"


def test_a_value_reference_means_the_same_in_every_machine() -> None:
    variables = by_name(variables_of(three_axes()))
    references = {name: variables[name].reference for name in ("reset", "cycle_time", "X.setpoint", "C.error")}
    assert references == {"reset": 0, "cycle_time": 4, "X.setpoint": 64, "C.error": 3 * 64 + 12}
    other = by_name(variables_of(bare("U", "V", "W")))
    assert other["W.error"].reference == variables["C.error"].reference
    assert variables["Y_ACHSE.friction.active"].reference == 2 * 64 + 33


@pytest.mark.parametrize("naming", ["structured", "flat"])
def test_names_and_references_are_unique(naming: str) -> None:
    machine = bare("X", "X_leadscrew", "x.y", "x-y", "", "1X", "reset", "Ä", "Ö", "X_2")
    machine = Machine(
        tuple(replace(axis, leadscrew=Leadscrew((0.0, 1.0), (0.0, 0.0)), cross=NO_CROSS) for axis in machine.axes)
    )
    variables = variables_of(machine, naming)  # type: ignore[arg-type]
    assert len({variable.name for variable in variables}) == len(variables)
    assert len({variable.reference for variable in variables}) == len(variables)
    for variable in variables:
        assert all(part.isidentifier() and part.isascii() for part in variable.name.split("."))
        assert naming == "structured" or "." not in variable.name


def test_start_values_are_those_of_the_runtime() -> None:
    cross = Cross(1, (0.0, 1.0), (0.0, 0.0), manual_activation=True)
    machine = three_axes()
    machine = Machine((replace(machine.axes[0], cross=cross), *machine.axes[1:]))
    inputs = initial_inputs(compile_tables(machine).tables)
    variables = [v for v in with_causality(variables_of(machine), "input") if v.axis is not None]
    slots = {v.name: slot_of(v, v.axis, inputs) for v in variables}
    assert not any(v.start for v in variables)
    assert {v.name: v.start for v in variables} == {name: slot and slot.get() for name, slot in slots.items()}


def places_in(record: Any, path: str = "") -> Iterator[str]:
    """Yield the paths of all numbers and Booleans of a record."""
    for name in fields_of(type(record)):
        value = getattr(record, name)
        if isinstance(value, list):
            yield from (f"{path}{name}[{i}]" for i in range(len(value)))
        elif is_dataclass(value):
            yield from places_in(value, f"{path}{name}.")
        else:
            yield path + name


def test_every_number_of_an_axis_is_declared_once() -> None:
    # the current is the only contribution of friction, and has a name of its own
    for causality, record in (("input", AxisInputs), ("output", AxisOutputs)):
        declared = sorted(d.field for d in AXIS_DECLARATIONS if d.causality == causality)
        assert declared == sorted(places_in(zero(record)))


def test_a_correction_depends_on_its_masters_and_on_nothing_else_that_moves() -> None:
    variables = by_name(variables_of(three_axes()))
    moving = {name for name in variables["Y_ACHSE.corrected_setpoint"].depends_on or () if "setpoint" in name}
    assert moving == {"X.setpoint", "Y_ACHSE.setpoint", "C.setpoint"}
    assert "C.setpoint" not in (variables["Y_ACHSE.cross.correction"].depends_on or ())
    assert set(variables["X.leadscrew.correction"].depends_on or ()) == {
        "reset",
        "program_end",
        "reload",
        "X.setpoint",
        "X.velocity",
        "X.unreferenced",
        "X.no_move",
        "X.released",
        "X.leadscrew.switch",
    }


OTHER = {"Boolean": lambda old: not old, "Integer": lambda old: -1 if old >= 0 else 1, "Real": lambda old: 30.0 - old}
"""Type → a value that differs from another one."""


def test_no_output_changes_with_an_input_it_does_not_depend_on() -> None:
    """Change one input at a time on the way: whatever differs then must depend on it."""
    cycles, at = 40, 12
    base = Engine(three_axes()).run(_columns(cycles))
    variables = Engine(three_axes()).variables
    seen = set()
    for variable in with_causality(variables, "input"):
        columns = _columns(cycles)
        values = columns.setdefault(variable.name, [variable.start] * cycles)  # type: ignore[list-item]
        values[at:] = [OTHER[variable.type](old) for old in values[at:]]
        other = Engine(three_axes()).run(columns)
        for output in with_causality(variables, "output"):
            if base[output.name].tolist() != other[output.name].tolist():
                seen.add(output.name)
                assert variable.name in (output.depends_on or ()), output.name
    assert len(seen) > 15


@pytest.mark.parametrize("quantity", ["setpoint", "velocity", "acceleration", "actual_position"])
@pytest.mark.parametrize("axis", ["X", "Y_ACHSE", "C"])
def test_the_error_of_an_axis_depends_on_what_may_be_no_number(axis: str, quantity: str) -> None:
    columns = _columns(10)
    columns[f"{axis}.{quantity}"][5] = math.nan
    result = Engine(three_axes()).run(columns)
    errors = {name: result[f"{name}.error"].tolist() for name in ("X", "Y_ACHSE", "C")}
    assert errors == {name: [901 * (name == axis and k == 5) for k in range(10)] for name in errors}
    assert f"{axis}.{quantity}" in (by_name(variables_of(three_axes()))[f"{axis}.error"].depends_on or ())


def _columns(cycles: int) -> dict[str, list[float | bool]]:
    """Return a trajectory in which Y-ACHSE stands still, so that its cross compensation can be switched off."""
    rows = trajectory(cycles)
    columns = {name: [row[name] for row in rows] for name in rows[0]}
    columns["Y_ACHSE.setpoint"] = [5.0] * cycles
    columns["Y_ACHSE.velocity"] = [0.0] * cycles
    columns["Y_ACHSE.cross.switch"] = [1 if k < 20 else -1 for k in range(cycles)]
    return columns
