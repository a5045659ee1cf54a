"""Tables are looked at before they are trusted: what the compiler makes fits, what is damaged does not."""

import copy
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, get_args, get_origin

import pytest
from hypothesis import given, settings, strategies as st
from strategies import machines

from axcomp.interface import slot_in
from axcomp.kernel import CROSS, Outputs, State, Tables, Vec, cosine, cycle, fields_of, sine, tables_fit, zero
from axcomp.kinds import Backlash, Temperature
from axcomp.lists import read_machine
from axcomp.model import Axis, Machine
from axcomp.runtime import Compiled, Runtime, SnapshotError, compile_tables, initial_inputs

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


def survives(tables: Tables, pool: Vec) -> None:
    """Run a few cycles; an index outside its list raises."""
    inputs, state, outputs = initial_inputs(tables), zero(State), zero(Outputs)
    for k in range(4):
        for axis in inputs.axis:
            axis.setpoint = (-1) ** k * 37.0 * k
            axis.velocity, axis.acceleration = 5.0 * (-1) ** k, 1000.0 * (-1) ** k
        cycle(tables, pool, state, inputs, outputs)


@pytest.mark.parametrize("model", ["three_axis", "five_axis", "rotary_table"])
def test_compiled_tables_fit_and_a_shorter_pool_does_not(model: str) -> None:
    tables, pool = compile_tables(read_machine(MODELS / model).machine)
    assert tables_fit(tables, pool, len(pool))
    assert not tables_fit(tables, pool, len(pool) - 1)


@pytest.mark.parametrize("model", ["three_axis", "five_axis"])
@settings(max_examples=150)
@given(data=st.data())
def test_whatever_number_is_damaged_tables_that_fit_read_nothing_else(model: str, data: st.DataObject) -> None:
    tables, pool = compiled(model)
    places = list(whole_numbers(tables))
    container, key = places[data.draw(st.integers(0, len(places) - 1))]
    old = container[key] if isinstance(container, list) else getattr(container, key)
    set_number(container, key, data.draw(st.sampled_from((*WRONG, old + 1, old - 1, 0, 5))))
    if tables_fit(tables, pool, len(pool)) and len(initial_inputs(tables).axis) > 0:
        survives(tables, pool)


@settings(max_examples=30)
@given(machines())
def test_any_compiled_machine_fits(machine: Machine) -> None:
    tables, pool = compile_tables(machine)
    assert tables_fit(tables, pool, len(pool))


NAN, INF = float("nan"), float("inf")
DAMAGES: list[tuple[str, Any]] = [
    ("cycle_time", 0.0),
    ("axis_count", 33),
    ("volumetrics", 6),
    ("axis[0].shift_cycles", 0),
    ("axis[0].first", -1),
    ("axis[0].numbers", 10**7),
    ("axis[0].compensation.plane.master1.axis", 3),
    ("axis[0].compensation.plane.master2.axis", -1),
    ("axis[0].compensation.plane.master1.start", NAN),
    ("axis[0].compensation.plane.master2.period", -1.0),
    ("axis[0].compensation.plane.interval1", 0.0),
    ("axis[0].compensation.plane.points1", 10**9),
    ("axis[0].compensation.leadscrew.positive.points", 0),
    ("axis[0].compensation.leadscrew.negative.y", -1),
    ("axis[0].compensation.leadscrew.reversal_cycles", 0),
    ("axis[0].compensation.leadscrew.modulo_range", NAN),
    ("axis[0].compensation.friction.delay", 249),
    ("axis[0].compensation.friction.lookahead", 5),
    ("axis[0].compensation.leadscrew.negative.points", 2),
    ("axis[0].compensation.plane.interval2", INF),
    ("axis[0].compensation.plane.start2", 1e15),
    ("axis[0].compensation.friction.scaling", 1e16),
    ("axis[0].compensation.friction.position_delay", NAN),
    ("axis[0].compensation.plane.master1.period", 1e-7),
    ("axis[0].kind[1]", 0),
    ("axis[0].modulo_range", 1e-9),
    ("axis[1].compensation.crosstalk.variant", 9),
    ("axis[1].compensation.crosstalk.deceleration", 0.0),
    ("axis[1].compensation.crosstalk.values", 10**7),
    ("axis[1].compensation.crosstalk.adaptation1.axis", 3),
    ("axis[1].compensation.crosstalk.adaptation2.period", INF),
    ("axis[2].compensation.cross.curve.x", 10**7),
    (f"axis[2].switching[{CROSS}].cycles", 21),
    (f"axis[2].switching[{CROSS}].cycles", 0),
    (f"axis[2].switching[{CROSS}].blend_cycles", 21),
    (f"axis[2].switching[{CROSS}].blend_cycles", 0),
    (f"axis[2].switching[{CROSS}].needs", 4),
    (f"axis[2].switching[{CROSS}].need[0]", 3),
]


def damaged(tables: Tables, path: str, value: Any) -> None:
    slot = slot_in(tables, path)
    assert slot is not None
    assert slot.get() != value
    slot.set(value)


@pytest.mark.parametrize(("path", "value"), DAMAGES)
def test_each_of_these_is_refused(path: str, value: Any) -> None:
    tables, pool = compiled("three_axis")
    damaged(tables, path, value)
    assert not tables_fit(tables, pool, len(pool))


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("temperature.position", NAN),
        ("temperature.offset", INF),
        ("temperature.coefficient", -INF),
        ("backlash.amount", NAN),
        ("backlash.reversal_cycles", 0),
        ("backlash.reversal_cycles", 21),
    ],
)
def test_damaged_numbers_of_kinds_without_tables_are_refused(path: str, value: Any) -> None:
    axis = Axis(1, "X", temperature=Temperature(1.0, 0.1, 1e-5), backlash=Backlash(0.01), backlash_cycles=3)
    tables, pool = compile_tables(Machine((axis,)))
    assert tables_fit(tables, pool, 0)
    damaged(tables, f"axis[0].compensation.{path}", value)
    assert not tables_fit(tables, pool, 0)


VOLUMETRIC_DAMAGES: list[tuple[str, Any]] = [
    ("chain[1]", 1),
    ("chain_length", 2),
    ("chain_length", 7),
    ("column[0]", 2),
    ("workpiece_axes", 7),
    ("offset[3]", NAN),
    ("member_limit[0]", INF),
    ("direction[4]", NAN),
    ("block[0].steps_per_unit[0]", 1e9),
    ("block[0].steps_per_unit[0]", -1.0),
    ("block[0].nodes", 1),
    ("block[0].points[0]", 1),
    ("block[0].period[0]", INF),
    ("block[0].start[0]", -1e16),
    ("block[0].arguments", 0),
]


@pytest.mark.parametrize(("path", "value"), VOLUMETRIC_DAMAGES)
def test_each_of_these_of_a_volumetric_compensation_is_refused(path: str, value: Any) -> None:
    tables, pool = compiled("five_axis")
    damaged(tables, f"volumetric[0].{path}", value)
    assert not tables_fit(tables, pool, len(pool))


def test_six_letters_of_which_each_comes_twice_are_no_chain() -> None:
    tables, pool = compiled("five_axis")
    volumetric = tables.volumetric[0]
    volumetric.chain_length, volumetric.chain[:] = 6, [0, 1, 2, 0, 1, 2]
    assert not tables_fit(tables, pool, len(pool))


def test_a_step_that_leads_to_the_last_knot_is_refused() -> None:
    tables, pool = compiled("five_axis")
    block = next(block for block in tables.volumetric[0].block if block.points[0] > 2)
    first = block.steps[0]
    pool[first + 1] = block.points[0] - 1.0
    assert not tables_fit(tables, pool, len(pool))


@pytest.mark.parametrize("value", [1e20, 1e5, NAN, -INF])
def test_an_angle_that_cannot_be_reduced_is_refused(value: float) -> None:
    tables, pool = compiled("five_axis")
    volumetric = tables.volumetric[0]
    volumetric.constants, volumetric.constant = 1, len(pool)
    numbers = [*pool, 3.0, value]
    assert tables_fit(tables, [*numbers[:-1], 0.001], len(numbers))
    assert not tables_fit(tables, numbers, len(numbers))


@pytest.mark.parametrize("x", [1e20, 1e60, -1e300, NAN, INF])
def test_no_angle_stops_the_sine(x: float) -> None:
    assert isinstance(sine(x), float)
    assert isinstance(cosine(x), float)


STATE_DAMAGES: list[tuple[str, Any]] = [
    ("axis[0].compensation.friction.head", -561),
    ("axis[0].compensation.friction.head", 249),
    ("axis[0].compensation.friction.since_reversal", 5),
    ("axis[0].compensation.friction.direction", 2),
    ("axis[0].compensation.leadscrew.lookup.interval", 10**6),
    ("axis[0].compensation.leadscrew.reversal_step", 21),
    ("axis[1].compensation.crosstalk.lookup.interval", -1),
    ("axis[2].compensation.cross.lookup.interval", 2**31 - 1),
    (f"axis[2].switching[{CROSS}].step", 21),
    (f"axis[2].switching[{CROSS}].weight", NAN),
    (f"axis[2].switching[{CROSS}].weight", 1.5),
    ("axis[0].shift.step", 21),
    ("axis[0].volumetric_shift", INF),
    ("motion.axis[0].sign", 2),
    ("motion.axis[0].counted", NAN),
    ("tool_length", NAN),
]


@pytest.mark.parametrize(("path", "value"), STATE_DAMAGES)
def test_a_state_that_no_run_leads_to_is_refused_and_nothing_changes(path: str, value: Any) -> None:
    runtime = Runtime(read_machine(MODELS / "three_axis").machine)
    runtime.advance(0.02)
    before = runtime.save()
    slot = slot_in(runtime.state, path)
    assert slot is not None
    kept = slot.get()
    slot.set(value)
    forged = runtime.save()
    slot.set(kept)
    with pytest.raises(SnapshotError):
        runtime.restore(forged)
    assert runtime.save() == before
    runtime.restore(before)


def test_abscissae_that_do_not_ascend_are_refused() -> None:
    tables, pool = compiled("three_axis")
    first = tables.axis[2].compensation.cross.curve.x
    pool[first + 1] = pool[first]
    assert not tables_fit(tables, pool, len(pool))


_COMPILED: dict[str, Compiled] = {}


def compiled(model: str) -> Compiled:
    """Return fresh tables of a model, and a pool that is guarded."""
    if model not in _COMPILED:
        _COMPILED[model] = compile_tables(read_machine(MODELS / model).machine)
        # As many as C has: a number of axes that is too large is found out by what is behind the last.
        whole, tables = zero(Tables), _COMPILED[model].tables
        tables.axis += whole.axis[len(tables.axis) :]
        tables.volumetric += whole.volumetric[len(tables.volumetric) :]
    tables, pool = _COMPILED[model]
    return Compiled(copy.deepcopy(tables), Guarded(pool))
