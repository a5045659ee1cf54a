"""What every kind of compensation owes to the rooms above: a kind that forgets something fails, by its name."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, get_type_hints

import numpy as np
import pytest

from axcomp.cli import main
from axcomp.engine import AxisCommand, Engine, parse_block
from axcomp.interface import AXIS_DECLARATIONS, BLOCK, ERRORS, by_name, variables_of, with_causality
from axcomp.kernel import tables_fit
from axcomp.kinds import (
    KIND_NAMES,
    KINDS,
    Backlash,
    Cross,
    CrosstalkCurve,
    Friction,
    Kind,
    Leadscrew,
    Parameter,
    Plane,
    Temperature,
)
from axcomp.lists import CODES, read_machine, write_machine
from axcomp.model import Axis, Compensation, Machine
from axcomp.runtime import Runtime, compile_tables

EXAMPLES: dict[str, Compensation] = {
    "cross": Cross(1, (-100.0, 0.0, 100.0), (0.01, 0.02, -0.03), n_cycles=4),
    "plane": Plane(1, 3, -100.0, -100.0, 100.0, 200.0, ((0.01, 0.02, 0.03), (0.02, 0.01, 0.0)), n_cycles=3),
    "crosstalk": CrosstalkCurve(1, (-1000.0, 0.0, 1000.0), (-0.01, 0.0, 0.02), n_cycles=2),
    "temperature": Temperature(50.0, 0.01, 12e-6, 5),
    "leadscrew": Leadscrew((-100.0, 0.0, 100.0), (0.01, 0.02, -0.03), (0.02, 0.0, 0.01)),
    "backlash": Backlash(0.02, 2),
    "friction": Friction((1.0, 10.0, 100.0), (1.0, 0.5, 2.0)),
}
"""A compensation of every kind, as it acts on axis S; its masters are M and P."""


def machine_with(kind: Kind[Any], **options: Any) -> Machine:
    slave = Axis(2, "S", backlash_cycles=3, compensations=(EXAMPLES[kind.name],), **options)
    return Machine((Axis(1, "M"), slave, Axis(3, "P")))


def without(machine: Machine, kind: Kind[Any]) -> Machine:
    return Machine(tuple(replace(axis, **{kind.name: None}) for axis in machine.axes))


def in_motion(cycles: int = 60) -> dict[str, np.ndarray]:
    """A trajectory on which every example adds something in every cycle but a few."""
    t = 0.02 * np.arange(cycles)
    columns = {}
    for k, name in enumerate("MSP"):
        columns[f"{name}.setpoint"] = 30.0 + 5.0 * k + 40.0 * t
        columns[f"{name}.velocity"] = np.full(cycles, 40.0)
        columns[f"{name}.acceleration"] = np.full(cycles, 300.0)
    return columns


def output_of(kind: Kind[Any]) -> str:
    return "S.current" if kind.adds_to == "current" else f"S.{kind.name}.correction"


# The contracts


def is_declared(kind: Kind[Any]) -> None:
    for name in get_type_hints(Kind, include_extras=True):
        assert hasattr(kind, name), f"it has no {name}"
    assert kind.name.isidentifier()
    assert kind.title[0].isupper()
    assert kind.word.isupper()
    assert kind.adds_to in ("setpoint", "current")
    assert isinstance(kind.activator, Parameter)
    assert all(isinstance(row, Parameter) for row in kind.parameters)
    assert len({row.key for row in kind.parameters}) == len(kind.parameters) > 0
    assert all(row.meaning for row in kind.parameters)
    names = {row.name for row in kind.parameters}
    assert {*kind.columns, *kind.sizes} | ({kind.reserves} if kind.reserves else set()) <= names
    assert all(name.startswith(kind.prefix) for name in names)
    assert (kind.points_error != 0) == bool(kind.reserves)


def is_registered(kind: Kind[Any]) -> None:
    assert KINDS[kind.name] is kind
    assert kind.number == list(KINDS).index(kind.name) == KIND_NAMES.index(kind.name)
    assert import_module(f"axcomp.kinds.{kind.name}").KIND is kind
    assert import_module(f"axcomp.kernel.{kind.name}").__doc__
    assert EXAMPLES[kind.name].kind == kind.name
    for other in KINDS.values():
        assert other is kind or not {other.word, other.title, other.prefix, other.activator.name} & {
            kind.word, kind.title, kind.prefix, kind.activator.name,
        }  # fmt: skip


def comes_back_from_its_lists(kind: Kind[Any]) -> None:
    machine = machine_with(kind)
    with TemporaryDirectory() as folder:
        write_machine(machine, Path(folder))
        reading = read_machine(folder)
    assert reading.findings == ()
    assert reading.machine == machine


def is_activated_without_a_table(kind: Kind[Any]) -> None:
    """What is written of an axis that is ready for it reads as an axis that is ready for it."""
    machine = without(machine_with(kind, reserved={kind.name: kind.reserved(None)}), kind)
    names = by_name(variables_of(machine))
    assert {f"S.{kind.name}.switch", f"S.{kind.name}.active", output_of(kind)} <= set(names)
    result = Engine(machine).run(in_motion())
    assert not result[f"S.{kind.name}.active"].any()
    assert not result[output_of(kind)].any()


def compiles_to_tables_that_fit(kind: Kind[Any]) -> None:
    tables, pool = compile_tables(machine_with(kind))
    assert tables_fit(tables, pool, len(pool))
    configured = [switching.configured for switching in tables.axis[1].switching]
    assert configured == [name == kind.name for name in KIND_NAMES]
    assert tables.axis[1].switching[kind.number].reserved == kind.reserved(EXAMPLES[kind.name]) >= 1


def acts_the_same_in_python_and_compiled(kind: Kind[Any]) -> None:
    columns = in_motion()
    result = Engine(machine_with(kind)).run(columns)
    engine = Engine(machine_with(kind))
    rows = [dict(zip(columns, row, strict=True)) for row in zip(*(c.tolist() for c in columns.values()), strict=True)]
    steps = [engine.step(row) for row in rows]
    for name in result:
        assert result[name].tolist() == [step[name] for step in steps], name
    assert np.count_nonzero(result[output_of(kind)]) > 50
    assert result[f"S.{kind.name}.active"].all()
    added = result["S.corrected_setpoint"] - columns["S.setpoint"]
    assert np.any(np.abs(added) > 1e-6) == (kind.adds_to == "setpoint")


def has_variables_of_its_own(kind: Kind[Any]) -> None:
    variables = variables_of(machine_with(kind))
    named = by_name(variables)
    assert len(named) == len(variables)
    assert len({variable.reference for variable in variables}) == len(variables)
    first = 2 * BLOCK + kind.identifier
    assert named[f"S.{kind.name}.switch"].reference == first
    assert named[f"S.{kind.name}.active"].reference == first + 1
    assert (named[f"S.{kind.name}.switch"].causality, named[f"S.{kind.name}.active"].causality) == ("input", "output")
    assert named[output_of(kind)].type == "Real"
    assert (f"S.{kind.name}.correction" in named) == (kind.adds_to == "setpoint")
    for own in kind.inputs:
        if own.present(EXAMPLES[kind.name]):
            variable = named[f"S.{own.name}"]
            assert (variable.causality, variable.reference) == ("input", 2 * BLOCK + own.identifier)
            assert not variable.start
    assert not [name for name in by_name(variables_of(without(machine_with(kind), kind))) if f".{kind.name}." in name]


def has_identifiers_that_no_other_kind_has(kind: Kind[Any]) -> None:
    own = {d.identifier: d.name for d in AXIS_DECLARATIONS if d.kind == kind.name}
    others = {d.identifier: d.name for d in AXIS_DECLARATIONS if d.kind != kind.name}
    assert not own.keys() & others.keys(), [(own[i], others[i]) for i in own.keys() & others.keys()]
    assert len(own) == sum(d.kind == kind.name for d in AXIS_DECLARATIONS)
    assert all(0 <= identifier < BLOCK for identifier in own)


def depends_on_what_exists(kind: Kind[Any]) -> None:
    machine = machine_with(kind)
    variables = by_name(variables_of(machine))
    slave, numbers = machine.axes[1], {axis.number: axis.name for axis in machine.axes}
    assert all(number in numbers for number in kind.needs(EXAMPLES[kind.name], slave))
    for number, name in kind.looks_up(EXAMPLES[kind.name], slave):
        assert variables[f"{numbers[number]}.{name}"].causality == "input"
    output = variables[output_of(kind)]
    assert {f"S.{kind.name}.switch", "S.released", "reset", "program_end"} <= set(output.depends_on or ())


def outputs_depend_on_what_changes_them(kind: Kind[Any]) -> None:
    machine, at = machine_with(kind), 30
    base = Engine(machine).run(in_motion())
    for variable in with_causality(Engine(machine).variables, "input"):
        columns: dict[str, Any] = in_motion()
        values = list(columns.get(variable.name, [variable.start] * 60))
        values[at:] = [not old if isinstance(old, bool) else 0.7 * old - 3.0 for old in values[at:]]
        other = Engine(machine).run({**columns, variable.name: values})
        for output in with_causality(variables_of(machine), "output"):
            if base[output.name].tolist() != other[output.name].tolist():
                assert variable.name in (output.depends_on or ()), f"{output.name} changes with {variable.name}"


def is_switched_by_its_word(kind: Kind[Any]) -> None:
    (command,) = parse_block(f"S[COMP OFF {kind.word}]")
    assert isinstance(command, AxisCommand)
    assert (command.off, command.on) == ((kind.name,), ())
    engine = Engine(machine_with(kind))
    columns = {name: column[0].item() for name, column in in_motion().items()}
    standing = {name: 0.0 if name.endswith("velocity") else value for name, value in columns.items()}
    for block, active in (("", True), (f"S[COMP OFF {kind.word}]", False), (f"S[COMP ON {kind.word}]", True)):
        engine.step(standing, block)
        outputs = [engine.step(standing) for _ in range(25)]
        assert outputs[-1][f"S.{kind.name}.active"] is active, block


def is_updated_and_undone(kind: Kind[Any]) -> None:
    machine = machine_with(kind)
    runtime = Runtime(machine)
    for new in (without(machine, kind), machine, replace(machine), without(machine, kind), machine):
        assert runtime.update(new) == {}
        for k in range(30):
            for axis in runtime.inputs.axis:
                axis.setpoint, axis.velocity, axis.acceleration = 30.0 + k, 0.0, 300.0
            runtime.cycle()
        present = new.axes[1].compensations != ()
        assert runtime.outputs.axis[1].active[kind.number] is present
    if kind.reserves:
        larger = replace(machine.axes[1].compensations[0], max_points=987)  # type: ignore[call-arg]
        axes = (machine.axes[0], machine.axes[1].having(larger), machine.axes[2])
        assert runtime.update(Machine(axes)) == {"S": kind.points_error}
        assert runtime.machine == machine
        assert kind.points_error in ERRORS


def survives_save_and_restore(kind: Kind[Any]) -> None:
    machine = machine_with(kind)
    runtime = Runtime(machine)
    columns = in_motion()

    def go_on(one: Runtime, first: int, last: int) -> list[str]:
        texts = []
        for k in range(first, last):
            for axis, name in zip(one.inputs.axis, "MSP", strict=True):
                axis.setpoint = columns[f"{name}.setpoint"][k].item() * (-1) ** (k // 17)
                axis.velocity = columns[f"{name}.velocity"][k].item() * (-1) ** (k // 17)
                axis.acceleration = columns[f"{name}.acceleration"][k].item()
            one.inputs.axis[1].wanted[kind.number] = 1 if k % 11 < 8 else -1
            one.cycle()
            texts.append(repr(one.outputs))
        return texts

    go_on(runtime, 0, 30)
    data = runtime.save()
    first = go_on(runtime, 30, 60)
    runtime.restore(data)
    assert go_on(runtime, 30, 60) == first
    other = Runtime(machine)
    other.restore(data)
    assert go_on(other, 30, 60) == first


def has_a_page_for_each_of_its_codes(kind: Kind[Any]) -> None:
    codes = {*kind.codes, kind.inactive_code, kind.no_table_code}
    if kind.points_error:
        codes.add(str(kind.points_error))
    for code in codes:
        assert code in CODES, f"{code} has no page"
        _, meaning = CODES[code]
        assert meaning, code
    for code, page in kind.codes.items():
        assert CODES[code] == page
        assert not [other.name for other in KINDS.values() if other is not kind and code in other.codes]


def is_shown_and_checked(kind: Kind[Any]) -> None:
    with TemporaryDirectory() as folder:
        write_machine(machine_with(kind), Path(folder))
        assert main(["check", folder]) == 0
        assert main(["show", folder]) == 0
        assert main(["show", folder, "--axis", "S", "--kind", kind.name]) == 0


CONTRACTS: list[Callable[[Kind[Any]], None]] = [
    is_declared,
    is_registered,
    comes_back_from_its_lists,
    is_activated_without_a_table,
    compiles_to_tables_that_fit,
    acts_the_same_in_python_and_compiled,
    has_variables_of_its_own,
    has_identifiers_that_no_other_kind_has,
    depends_on_what_exists,
    outputs_depend_on_what_changes_them,
    is_switched_by_its_word,
    is_updated_and_undone,
    survives_save_and_restore,
    has_a_page_for_each_of_its_codes,
    is_shown_and_checked,
]


def hold(contract: Callable[[Kind[Any]], None], kind: Kind[Any]) -> None:
    """Fail with the names of the kind and of the contract that it breaks."""
    try:
        contract(kind)
    except Exception as error:
        raise AssertionError(f"{kind.name} breaks “{contract.__name__}”: {error!r}") from error


@pytest.mark.parametrize("contract", CONTRACTS, ids=lambda contract: contract.__name__)
@pytest.mark.parametrize("name", KINDS)
def test_a_kind_keeps_its_contract(name: str, contract: Callable[[Kind[Any]], None]) -> None:
    hold(contract, KINDS[name])


def test_every_kind_has_an_example() -> None:
    assert set(EXAMPLES) == set(KINDS)
    assert [kind.number for kind in KINDS.values()] == list(range(len(KINDS)))


class Toy(Kind[Any]):
    """A kind whose author has written what Python demands, and no more."""

    name = "toy"
    read = write = compile = tables = lambda *_: None  # type: ignore[assignment]


class Overlapping(type(KINDS["cross"])):  # type: ignore[misc]
    """Another cross compensation under a name of its own, with everything else copied."""

    name = "overlapping"


def broken_by(kind: Kind[Any]) -> Iterator[str]:
    for contract in CONTRACTS:
        try:
            hold(contract, kind)
        except AssertionError as error:
            assert str(error).startswith(f"{kind.name} breaks “{contract.__name__}”: ")
            yield contract.__name__


def test_an_unfinished_kind_fails_by_its_name() -> None:
    broken = set(broken_by(Toy()))
    # it has neither variables nor findings yet, so these two have nothing to say
    silent = {"has_identifiers_that_no_other_kind_has", "has_a_page_for_each_of_its_codes"}
    assert broken == {contract.__name__ for contract in CONTRACTS} - silent
    with pytest.raises(AssertionError, match=r"toy breaks “is_declared”: .*it has no title"):
        hold(is_declared, Toy())


def test_a_kind_that_is_a_copy_of_another_fails_by_its_name() -> None:
    assert {"is_registered", "comes_back_from_its_lists", "is_switched_by_its_word"} <= set(broken_by(Overlapping()))


def test_a_kind_without_what_python_demands_cannot_even_be_made() -> None:
    class Nothing(Kind[Any]):
        name = "nothing"

    with pytest.raises(TypeError, match=r"Nothing.*compile, read, tables, write"):
        Nothing()  # type: ignore[abstract]
