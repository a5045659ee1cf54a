"""Machine → tables: indices, closed modulo tables, and a sentence for everything the kernel could not run."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from strategies import machines

from axcomp.kernel import (
    CROSS,
    CROSSTALK_CONSTANT,
    CROSSTALK_GRID,
    CROSSTALK_LINE,
    CROSSTALK_TRIANGLES,
    FRICTION,
    PLANE as PLANE_KIND,
    tables_fit,
)
from axcomp.kinds import (
    KINDS,
    Backlash,
    Cross,
    Crosstalk,
    CrosstalkCurve,
    CrosstalkTest,
    Friction,
    Leadscrew,
    Plane,
    Temperature,
)
from axcomp.model import CYCLE_TIME, Axis, AxisType, Machine, ModuloRange
from axcomp.runtime import CompileError, compile_tables

NAN, INF = math.nan, math.inf
X = Axis(1, "X")
T = CrosstalkTest


def crosstalk(mode: int, *tests: CrosstalkTest, **options: object) -> Crosstalk:
    return replace(Crosstalk(1, 1.0, -1.0, mode, tests, 1, 1), **options)


PLANE = Plane(1, 1, 0.0, 0.0, 1.0, 1.0, ((0.0, 0.0), (0.0, 0.0)))
CURVE = (0.0, 1.0), (0.0, 0.0)
REFUSED: dict[str, Axis] = {
    "its master axis 9 does not exist": replace(X, cross=Cross(9, *CURVE)),
    "master axis 8 does not exist": replace(X, plane=replace(PLANE, master2=8)),
    "master axis 7 does not exist": replace(X, crosstalk=CrosstalkCurve(7, *CURVE)),
    "master axis 6 does not exist": replace(X, crosstalk=crosstalk(2, T(), T(1.0), adaptation1=6)),
    "adaptation axis is missing": replace(X, crosstalk=crosstalk(3, T(), T(1.0), T(0.0, 1.0), adaptation2=None)),
    "cross: the points do not ascend": replace(X, cross=Cross(1, (0.0, 0.0), (1.0, 2.0))),
    "cross: the points do not": replace(X, cross=Cross(1, (0.0, NAN), (1.0, 2.0))),
    "leadscrew: the points do not ascend": replace(X, leadscrew=Leadscrew((1.0, 0.0), (1.0, 2.0))),
    "crosstalk: the points do not ascend": replace(X, crosstalk=crosstalk(2, T(), T())),
    "friction: the points do not ascend": replace(X, friction=Friction((2.0, 1.0), (1.0, 2.0))),
    "friction: velocities are not negative": replace(X, friction=Friction((-1.0, 1.0), (1.0, 2.0))),
    "cross: 2 points but 1 values": replace(X, cross=Cross(1, (0.0, 1.0), (0.0,))),
    "leadscrew: 2 points but 3 values": replace(X, leadscrew=Leadscrew((0.0, 1.0), (0.0, 0.0), (0.0, 0.0, 0.0))),
    "cross: 0 points": replace(X, cross=Cross(1, (), ())),
    "not finite": replace(X, cross=Cross(1, (0.0,), (INF,))),
    "holds a number": replace(X, leadscrew=Leadscrew((0.0,), (NAN,))),
    "crosstalk: a position is not finite": replace(X, crosstalk=crosstalk(3, T(NAN), T(1.0), T(0.0, 1.0))),
    "n_cycles is 0 … 20, not 21": replace(X, cross=Cross(1, *CURVE, n_cycles=21)),
    "n_cycles is 0 … 20, not -1": replace(X, plane=replace(PLANE, n_cycles=-1)),
    "n_backlash_cyc is 0 … 20": replace(X, backlash_cycles=21),
    "the intervals must be above 0": replace(X, plane=replace(PLANE, interval2=0.0)),
    "plane: the intervals must be": replace(X, plane=replace(PLANE, interval1=NAN)),
    "plane: the starts must be finite": replace(X, plane=replace(PLANE, start2=INF)),
    "plane: the table is empty": replace(X, plane=replace(PLANE, corrections=())),
    "plane: the rows differ in length": replace(X, plane=replace(PLANE, corrections=((0.0,), (0.0, 1.0)))),
    "acceleration > 0 > deceleration": replace(X, crosstalk=crosstalk(1, T(), deceleration=0.0)),
    "crosstalk: acceleration > 0": replace(X, crosstalk=crosstalk(1, T(), acceleration=NAN)),
    "there are 1 … 15 tests": replace(X, crosstalk=crosstalk(1)),
    "1 … 15 tests": replace(X, crosstalk=crosstalk(2, *(T(float(i)) for i in range(16)))),
    "mode 2 needs two tests": replace(X, crosstalk=crosstalk(2, T())),
    "three tests that are not in a line": replace(X, crosstalk=crosstalk(3, T(), T(1.0, 1.0), T(0.1, 0.1))),
    "two tests stand at the same positions": replace(X, crosstalk=crosstalk(3, T(), T(1.0), T(1.0), T(0.0, 1.0))),
    "mode 4 is not 1, 2 or 3": replace(X, crosstalk=crosstalk(4, T())),
    "a modulo table needs a modulo axis": replace(X, leadscrew=Leadscrew(*CURVE, modulo=True)),
    "the modulo range must be above 0": replace(X, modulo=ModuloRange(360.0, 0.0)),
    "modulo range must be above 0 and finite": replace(X, modulo=ModuloRange(0.0, INF)),
    "the look-ahead is 0 … 4 cycles": replace(X, friction=Friction(*CURVE, reversal_lookahead=5)),
    "the delay is 0 … 248 cycles": replace(X, friction=Friction(*CURVE, delay_cycles=249)),
    "the position delay is not negative": replace(X, friction=Friction(*CURVE, position_delay=-1.0)),
    "friction: the position delay": replace(X, friction=Friction(*CURVE, position_delay=NAN)),
    "friction: the scaling must be finite": replace(X, friction=Friction(*CURVE, scaling=INF)),
    "temperature: a number is not finite": replace(X, temperature=Temperature(NAN)),
    "temperature: a number is not": replace(X, temperature=Temperature(coefficient=INF)),
    "n_cycles is 0 … 20, not 22": replace(X, temperature=Temperature(n_cycles=22)),
    "backlash: the amount is not finite": replace(X, backlash=Backlash(-INF)),
    "backlash: mode 3 is not 1 or 2": replace(X, backlash=Backlash(0.01, 3)),
}


@pytest.mark.parametrize(("sentence", "axis"), REFUSED.items())
def test_what_cannot_run_is_refused_by_a_sentence_with_the_axis(sentence: str, axis: Axis) -> None:
    with pytest.raises(CompileError) as refused:
        compile_tables(Machine((axis,)))
    assert sentence in str(refused.value)
    assert "axis X" in str(refused.value)


def test_machines_that_are_too_many_or_not_unique() -> None:
    with pytest.raises(CompileError, match="33 axes"):
        compile_tables(Machine(tuple(Axis(i, f"A{i}") for i in range(1, 34))))
    with pytest.raises(CompileError, match="same logical number"):
        compile_tables(Machine((X, Axis(1, "Y"))))


@pytest.mark.parametrize("cycle_time", [0.0, -1e-3, NAN, INF])
def test_the_cycle_time_must_be_usable(cycle_time: float) -> None:
    with pytest.raises(CompileError, match="cycle time"):
        compile_tables(Machine(), cycle_time)


def test_axis_numbers_become_indices() -> None:
    masters = Machine((Axis(17, "A"), Axis(3, "B", cross=Cross(40, *CURVE)), Axis(40, "C", cross=Cross(17, *CURVE))))
    tables = compile_tables(masters).tables
    assert (tables.axis_count, tables.cycle_time) == (3, CYCLE_TIME)
    assert [axis.switching[CROSS].configured for axis in tables.axis] == [False, True, True]
    assert [axis.compensation.cross.master.axis for axis in tables.axis[1:3]] == [2, 0]
    assert [axis.switching[CROSS].need[: axis.switching[CROSS].needs] for axis in tables.axis] == [[], [2], [0]]


def test_a_modulo_table_is_closed_by_its_first_point() -> None:
    leadscrew = Leadscrew((10.0, 100.0), (1.0, 2.0), (3.0, 4.0), modulo=True)
    tables, pool = compile_tables(Machine((Axis(1, "C", AxisType.ROTARY, ModuloRange(), leadscrew=leadscrew),)))
    table = tables.axis[0].compensation.leadscrew
    assert (table.positive.points, table.negative.points, table.positive.x) == (3, 3, table.negative.x)
    assert pool[table.positive.x :][:3] == [10.0, 100.0, 370.0]
    assert pool[table.positive.y :][:3] == [1.0, 2.0, 1.0]
    assert pool[table.negative.y :][:3] == [3.0, 4.0, 3.0]


def test_a_modulo_table_over_its_whole_range_gets_no_further_point() -> None:
    leadscrew = Leadscrew((0.0, 360.0), (1.0, 2.0), modulo=True)
    tables, _ = compile_tables(Machine((Axis(1, "C", AxisType.ROTARY, ModuloRange(), leadscrew=leadscrew),)))
    assert tables.axis[0].compensation.leadscrew.positive.points == 2


@pytest.mark.parametrize(("listed", "reserved"), [(None, 10201), (0, 10201), (12, 12)])
def test_a_plane_has_10201_entries_where_the_list_does_not_say(listed: int | None, reserved: int) -> None:
    tables, _ = compile_tables(Machine((X.having(replace(PLANE, max_points=listed)),)))
    assert tables.axis[0].switching[list(KINDS).index("plane")].reserved == reserved


@pytest.mark.parametrize(
    ("tests", "variant"),
    [
        ((1, T()), CROSSTALK_CONSTANT),
        ((2, T(), T(1.0)), CROSSTALK_LINE),
        ((3, T(), T(1.0), T(0.0, 1.0), T(1.0, 1.0)), CROSSTALK_GRID),
        ((3, T(), T(1.0), T(0.0, 1.0), T(1.0, 1.1)), CROSSTALK_TRIANGLES),
        ((3, T(), T(1.0), T(0.0, 1.0)), CROSSTALK_TRIANGLES),
    ],
)
def test_a_full_rectangular_grid_is_bilinear_and_anything_else_triangles(tests, variant: int) -> None:
    axis = replace(X, crosstalk=crosstalk(*tests))
    assert compile_tables(Machine((axis,))).tables.axis[0].compensation.crosstalk.variant == variant


@settings(max_examples=40)
@given(machines())
def test_all_that_lists_can_hold_compiles_to_tables_that_fit(machine: Machine) -> None:
    tables, pool = compile_tables(machine)
    assert tables_fit(tables, pool, len(pool))
    assert all(isinstance(number, float) and math.isfinite(number) for number in pool)


@settings(max_examples=20)
@given(machines())
def test_the_pool_is_cut_into_the_numbers_of_each_axis(machine: Machine) -> None:
    tables, pool = compile_tables(machine)
    at = 0
    for axis in tables.axis[: tables.axis_count]:
        assert axis.first == at
        at += axis.numbers
    assert at == len(pool)


def test_an_axis_lists_the_kinds_that_it_activates_with_or_without_a_table() -> None:
    axis = replace(X, friction=Friction(*CURVE), cross=Cross(1, *CURVE, max_points=77), reserved={"plane": 100})
    table = compile_tables(Machine((axis,))).tables.axis[0]
    assert table.kind[: table.kinds] == [CROSS, PLANE_KIND, FRICTION]
    assert [switching.reserved for switching in table.switching] == [77, 100, 0, 0, 0, 0, 20]
    assert [switching.configured for switching in table.switching] == [True, False, False, False, False, False, True]


@pytest.mark.parametrize(
    ("first", "last", "start"), [(0.0, 10.0, -175.0), (-90.0, 90.0, -180.0), (350.0, 370.0, 180.0), (7.0, 7.0, -173.0)]
)
def test_the_position_of_a_modulo_axis_is_folded_into_the_turn_centred_on_the_table(
    first: float, last: float, start: float
) -> None:
    positions = (first, last) if last > first else (first,)
    slave = Axis(2, "Y", cross=Cross(1, positions, tuple(0.0 for _ in positions)))
    tables, _ = compile_tables(Machine((Axis(1, "C", AxisType.ROTARY, ModuloRange()), slave)))
    master = tables.axis[1].compensation.cross.master
    assert (master.start, master.period) == (start, 360.0)


def test_the_position_of_an_axis_that_does_not_count_modulo_is_not_folded() -> None:
    tables, _ = compile_tables(Machine((Axis(1, "C", AxisType.ROTARY), Axis(2, "Y", cross=Cross(1, *CURVE)))))
    assert tables.axis[1].compensation.cross.master.period == 0.0


def test_the_largest_machine_compiles() -> None:
    grid = tuple(tuple(float(i + j) for i in range(101)) for j in range(101))
    line = tuple(float(i) for i in range(1500))
    axis = Axis(
        1,
        "A",
        cross=Cross(1, line[:1001], line[:1001]),
        plane=Plane(1, 1, 0.0, 0.0, 1.0, 1.0, grid),
        crosstalk=CrosstalkCurve(1, *CURVE),
        leadscrew=Leadscrew(line, line, line),
        temperature=Temperature(100.0, 0.01, 1e-5, 20),
        backlash=Backlash(0.01, 2),
        friction=Friction(line[:20], line[:20], delay_cycles=248),
    )
    tables, pool = compile_tables(Machine(tuple(replace(axis, number=i, name=f"A{i}") for i in range(1, 33))))
    assert tables_fit(tables, pool, len(pool))
    assert [table.kinds for table in tables.axis] == [7] * 32
