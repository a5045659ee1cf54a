"""A volumetric compensation made by hand: a sentence for everything the kernel could not run."""

from __future__ import annotations

import math
from typing import Any

import pytest
from rigid_bodies import machine_of, volumetric

from axcomp.compile import CompileError, compile_tables
from axcomp.volumetric import ErrorTable, Interpolation, Volumetric

SQUARE = ((0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0))
GRID, SCATTER, PATH = Interpolation.GRID, Interpolation.SCATTER, Interpolation.PATH


def over(nodes: tuple[tuple[float, ...], ...], interpolation: Interpolation, arguments: str = "XY") -> dict[str, Any]:
    """Return the errors of a compensation that has EXX over some nodes."""
    values = tuple(0.001 * (k + 1) for k in range(len(nodes)))
    return {"errors": (ErrorTable("EXX", values, arguments, nodes, interpolation),)}


REFUSED: dict[str, dict[str, Any]] = {
    "the nodes of EXX fill no grid": over(SQUARE[:3], GRID),
    "nodes of EXX fill no grid": over((*SQUARE, (0.5, 0.5)), GRID),
    "EXX has two values at one node": over((*SQUARE, (0.0, 0.0)), SCATTER),
    "EXX has two values": over((*SQUARE, (0.0, 0.0)), GRID),
    "EXX stands still": over(((0.0,), (1.0,), (1.0,)), PATH, "X"),
    "EXX has no path over C": over(((0.0,), (1.0,)), PATH, "C"),
    "EXX depends on an axis twice": over(SQUARE, GRID, "XX"),
    "EXX depends on an axis that is not assigned": over(SQUARE, GRID, "XA"),
    "EXX has a node that is no position of XY": over(((0.0, 0.0), (1.0,)), SCATTER),
    "a node that is no position of XY": over(((0.0, 0.0), (math.inf, 0.0)), SCATTER),
    "EXX has not one value for each node": {"errors": (ErrorTable("EXX", (0.1, 0.2)),)},
    "EXX has a value beyond ±1e+06": {"errors": (ErrorTable("EXX", (math.inf,)),)},
    "EAX has a value beyond ±1": {"errors": (ErrorTable("EAX", (1.5,)),)},
    "XXX is no error": {"errors": (ErrorTable("XXX", (0.1,)),)},
    "an error has two tables": {"errors": (ErrorTable("EXX", (0.1,)), ErrorTable("EXX", (0.1,)))},
    "filter_steps is not negative": {"filter_steps": -1},
    "workpiece_axes is larger than the chain": {"workpiece_axes": 5},
    "an axis of the chain CXYZ is not assigned": {"axes": (("X", 1), ("Y", 2), ("Z", 3))},
    "its axis C = 9 does not exist": {"axes": (("X", 1), ("Y", 2), ("Z", 3), ("C", 9))},
    "an axis is assigned twice": {"axes": (("X", 1), ("Y", 2), ("Z", 3), ("C", 3))},
    "is not scaled to length 1": {"directions": ((1.0, 0.1, 0.0), *(((0.0, 1.0, 0.0),) * 5))},
    "a length is beyond 1e+06 mm": {"tool_position": (0.0, 0.0, 1e7)},
}


@pytest.mark.parametrize(("sentence", "parameters"), REFUSED.items())
def test_what_cannot_run_is_refused_by_a_sentence_with_the_compensation(
    sentence: str, parameters: dict[str, Any]
) -> None:
    with pytest.raises(CompileError) as refused:
        compile_tables(machine_of(volumetric("CXYZ", **parameters)))
    assert sentence in str(refused.value)
    assert str(refused.value).startswith("volumetric compensation 0: ")


@pytest.mark.parametrize(
    "parameters",
    [over(SQUARE, GRID), over(SQUARE, SCATTER), over(SQUARE[:3], SCATTER), over(((0.0,), (1.0,), (0.0,)), PATH, "X")],
)
def test_what_is_refused_is_usable_with_one_thing_less(parameters: dict[str, Any]) -> None:
    tables = compile_tables(machine_of(volumetric("CXYZ", **parameters)))
    assert [table.blocks for table in tables.volumetric[: tables.volumetrics]] == [1]


@pytest.mark.parametrize("chain", ["XY", "XXYZ", "XYZU", "ABC"])
def test_a_chain_is_x_y_z_and_rotary_axes_each_once(chain: str) -> None:
    axes = (("X", 1), ("Y", 2), ("Z", 3))
    with pytest.raises(CompileError, match="the chain is X, Y, Z and some of A, B, C"):
        compile_tables(machine_of(Volumetric(0, axes, chain=chain)))


@pytest.mark.parametrize("indices", [(0, 0), (5,), (-1,)])
def test_compensations_have_different_numbers_from_0_to_4(indices: tuple[int, ...]) -> None:
    with pytest.raises(CompileError, match="different numbers 0 … 4"):
        compile_tables(machine_of(*(volumetric("XYZ", index=index) for index in indices)))
