"""Volumetric compensations made by hand: what the kernel could not run is refused by a sentence."""

from dataclasses import replace

import pytest
from rigid_bodies import machine_of, volumetric

from axcomp.model import ErrorTable, Interpolation, Machine, Volumetric
from axcomp.runtime import CompileError, compile_tables

NODES = ((0.0,), (100.0,))
TABLE = ErrorTable("EXX", (0.01, 0.02), "X", NODES)
GOOD = volumetric("CXYZ", errors=(TABLE,))
CORNERS = ((0.0, 0.0), (0.0, 1.0), (1.0, 0.0))
THREE = ErrorTable("EXX", (0.01, 0.02, 0.03), "XY", CORNERS)
PATH = Interpolation.PATH


def with_table(**changes: object) -> Volumetric:
    return replace(GOOD, errors=(replace(TABLE, **changes),))


REFUSED: dict[str, Volumetric] = {
    "filter_steps is not negative": replace(GOOD, filter_steps=-1),
    "each once, not XYZZ": replace(GOOD, chain="XYZZ"),
    "each once, not XY": replace(GOOD, chain="XY"),
    "each once, not XYZW": replace(GOOD, chain="XYZW"),
    "an axis of the chain CXYZ is not assigned": replace(GOOD, axes=GOOD.axes[:3]),
    "axes are called X, Y, Z, A, B, C": replace(GOOD, axes=(*GOOD.axes, ("W", 5))),
    "workpiece_axes is larger than the chain": replace(GOOD, workpiece_axes=5),
    "an axis is assigned twice": replace(GOOD, axes=(*GOOD.axes, ("B", 1))),
    "its axis B = 77 does not exist": replace(GOOD, axes=(*GOOD.axes, ("B", 77))),
    "a length is beyond 1e+06 mm": replace(GOOD, tool_position=(0.0, 0.0, 2e6)),
    "direction (0.0, 0.0, 2.0) is not scaled to length 1": replace(GOOD, tool_orientation=(0.0, 0.0, 2.0)),
    "a vector lacks": replace(GOOD, centers=GOOD.centers[:2]),
    "an error has two tables": replace(GOOD, errors=(TABLE, TABLE)),
    "EXQ is no error": with_table(name="EXQ"),
    "EXX has not one value for each node": with_table(values=(0.01,)),
    "EXX depends on an axis twice": with_table(arguments="XX", nodes=((0.0, 0.0), (1.0, 1.0))),
    "EXX depends on an axis that is not assigned": with_table(arguments="A"),
    "EXX has a node that is no position of XY": with_table(arguments="XY"),
    "EXX has a node that is no position of X": with_table(nodes=((0.0,), (2e6,))),
    "EXX has a value beyond": with_table(values=(0.01, -2e6)),
    "EXX has no path over C": with_table(arguments="C", interpolation=PATH),
    "EXX stands still": with_table(nodes=((1.0,), (1.0,)), interpolation=PATH),
    "EXX has two values at one node": with_table(nodes=((1.0,), (1.0,))),
    "the nodes of EXX fill no grid": replace(GOOD, errors=(THREE,)),
}


def test_what_the_cases_begin_with_compiles() -> None:
    assert compile_tables(machine_of(GOOD)).tables.volumetric[0].blocks == 1


@pytest.mark.parametrize(("sentence", "compensation"), REFUSED.items())
def test_what_cannot_run_is_refused_by_a_sentence_with_its_compensation(
    sentence: str, compensation: Volumetric
) -> None:
    with pytest.raises(CompileError) as refused:
        compile_tables(machine_of(compensation))
    assert str(refused.value).startswith("volumetric compensation 0: ")
    assert sentence in str(refused.value)


@pytest.mark.parametrize("corner", [None, (1.0, 1.0), (1.0, 1.000001)])
def test_a_grid_wants_every_combination_of_its_coordinates(corner: tuple[float, float] | None) -> None:
    """Three corners of a rectangle are none, the fourth makes it one, a fourth beside its place does not."""
    nodes = CORNERS if corner is None else (*CORNERS, corner)
    table = ErrorTable("EXX", tuple(0.01 * n for n in range(1, len(nodes) + 1)), "XY", nodes)
    compile_tables(machine_of(volumetric("XYZ", errors=(replace(table, interpolation=Interpolation.SCATTER),))))
    machine = machine_of(volumetric("XYZ", errors=(table,)))
    if corner == (1.0, 1.0):
        assert compile_tables(machine).tables.volumetric[0].block[0].points[:2] == [2, 2]
    else:
        with pytest.raises(CompileError, match="fill no grid"):
            compile_tables(machine)


@pytest.mark.parametrize("indices", [(0, 0), (5,), (-1,)])
def test_compensations_have_different_numbers_from_0_to_4(indices: tuple[int, ...]) -> None:
    machine = Machine(machine_of().axes, tuple(replace(GOOD, index=index) for index in indices))
    with pytest.raises(CompileError, match="have different numbers 0 … 4"):
        compile_tables(machine)
