"""Tables are looked at before they are trusted: what the compiler makes fits, what is damaged does not."""

import copy
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, get_args, get_origin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import machines

from axcomp.kernel.cycle import cycle
from axcomp.kernel.fit import tables_fit
from axcomp.kernel.record import Vec, fields_of, zero
from axcomp.kernel.records import Outputs, State, Tables
from axcomp.lists import read_machine
from axcomp.model.machine import Machine
from axcomp.runtime.compile import compile_tables
from axcomp.runtime.runtime import initial_inputs

MODELS = Path(__file__).parents[2] / "models"
WRONG = (-(2**31), -1, 10**6, 2**31 - 1)


class Guarded(list[float]):
    """A pool that refuses what C would read from elsewhere."""

    def __getitem__(self, index: Any) -> Any:
        if index < 0:
            raise IndexError(index)
        return super().__getitem__(index)


def whole_numbers(record: Any) -> Iterator[tuple[Any, Any]]:
    """Yield (container, key) of every int of a record, configured or not."""
    for name, hint in fields_of(type(record)).items():
        value = getattr(record, name)
        if hint is int:
            yield record, name
        elif get_origin(hint) is Annotated and get_args(get_args(hint)[0])[0] is int:
            yield from ((value, k) for k in range(len(value)))
        elif get_origin(hint) is Annotated and get_args(get_args(hint)[0])[0] not in (float, bool):
            for element in value:
                yield from whole_numbers(element)
        elif hint not in (float, bool, Vec) and get_origin(hint) is not Annotated:
            yield from whole_numbers(value)


def set_number(container: Any, key: Any, value: int) -> None:
    if isinstance(container, list):
        container[key] = value
    else:
        setattr(container, key, value)


def survives(tables: Tables) -> None:
    """Run a few cycles; an index outside its list raises."""
    inputs, state, outputs = initial_inputs(tables), zero(State), zero(Outputs)
    for k in range(4):
        for axis in inputs.axis:
            axis.setpoint = (-1) ** k * 37.0 * k
            axis.velocity, axis.acceleration = 5.0 * (-1) ** k, 1000.0 * (-1) ** k
        cycle(tables, state, inputs, outputs)


@pytest.mark.parametrize("model", ["three_axis", "five_axis", "rotary_table"])
def test_compiled_tables_fit_and_a_shorter_pool_does_not(model: str) -> None:
    tables = compile_tables(read_machine(MODELS / model).machine)
    assert tables_fit(tables, len(tables.pool))
    assert not tables_fit(tables, len(tables.pool) - 1)


@pytest.mark.parametrize("model", ["three_axis", "five_axis"])
@settings(max_examples=150)
@given(data=st.data())
def test_whatever_number_is_damaged_tables_that_fit_read_nothing_else(model: str, data: st.DataObject) -> None:
    tables = compiled(model)
    places = list(whole_numbers(tables))
    container, key = places[data.draw(st.integers(0, len(places) - 1))]
    old = container[key] if isinstance(container, list) else getattr(container, key)
    set_number(container, key, data.draw(st.sampled_from((*WRONG, old + 1, old - 1, 0, 5))))
    if tables_fit(tables, len(tables.pool)) and len(initial_inputs(tables).axis) > 0:
        survives(tables)


@settings(max_examples=30)
@given(machines())
def test_any_compiled_machine_fits(machine: Machine) -> None:
    tables = compile_tables(machine)
    assert tables_fit(tables, len(tables.pool))


def test_each_of_these_is_refused() -> None:
    damages: list[tuple[str, Any]] = [
        ("cycle_time", 0.0),
        ("axis_count", 33),
        ("volumetrics", 6),
        ("axis.0.shift_cycles", 0),
        ("axis.0.plane.master1", 3),
        ("axis.0.plane.interval1", 0.0),
        ("axis.0.plane.points1", 10**9),
        ("axis.0.leadscrew.positive.points", 0),
        ("axis.0.leadscrew.negative.y", -1),
        ("axis.0.leadscrew.reversal_cycles", 0),
        ("axis.0.friction.delay", 249),
        ("axis.0.friction.lookahead", 5),
        ("axis.1.crosstalk.variant", 9),
        ("axis.1.crosstalk.deceleration", 0.0),
        ("axis.1.crosstalk.values", 10**7),
        ("axis.2.cross.curve.x", 10**7),
        ("axis.2.cross.switching.cycles", 21),
    ]
    for path, value in damages:
        tables = compiled("three_axis")
        *parents, name = path.split(".")
        record: Any = tables
        for parent in parents:
            record = record[int(parent)] if parent.isdigit() else getattr(record, parent)
        assert getattr(record, name) != value
        setattr(record, name, value)
        assert not tables_fit(tables, len(tables.pool)), path


def test_abscissae_that_do_not_ascend_are_refused() -> None:
    tables = compiled("three_axis")
    tables.pool[tables.axis[2].cross.curve.x + 1] = tables.pool[tables.axis[2].cross.curve.x]
    assert not tables_fit(tables, len(tables.pool))


_COMPILED: dict[str, Tables] = {}


def compiled(model: str) -> Tables:
    """Return fresh tables of a model whose pool is guarded."""
    if model not in _COMPILED:
        _COMPILED[model] = compile_tables(read_machine(MODELS / model).machine)
    tables = copy.deepcopy(_COMPILED[model])
    pool = Guarded(tables.pool)
    tables.pool = pool
    for axis in tables.axis:
        axis.pool = pool
    return tables
