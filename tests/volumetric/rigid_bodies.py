"""A machine with errors as 4 × 4 matrices of SciPy's rotations: the second formulation the kernel is held against.

Written from semantics §10 alone; positions of rotary axes in °, angular errors in rad.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from axcomp.kernel import FRAME, carry_to_workpiece, zeros
from axcomp.model import ERRORS, LETTERS, LINEAR, Axis, AxisType, ErrorTable, Machine, Volumetric
from axcomp.runtime import Runtime

Matrix = NDArray[np.float64]
FASTEST = 1e6  # mm/s: slows no filter down
NUMBERS = {letter: number for number, letter in enumerate(LETTERS, 1)}


def translation(vector: Iterable[float]) -> Matrix:
    matrix = np.eye(4)
    matrix[:3, 3] = list(vector)
    return matrix


def rotation(turn: Rotation) -> Matrix:
    matrix = np.eye(4)
    matrix[:3, :3] = turn.as_matrix()
    return matrix


def small_turn(a: float, b: float, c: float) -> Rotation:
    return Rotation.from_euler("xyz", [a, b, c])  # about fixed axes: first x, then y, then z


def axis_matrix(letter: str, machine: Volumetric, q: float, errors: Mapping[str, float]) -> Matrix:
    """Return A of one axis at position q, which includes the axis' offset."""

    def given(prefixes: str) -> list[float]:
        return [errors.get(f"{prefix}{letter}", 0.0) for prefix in prefixes.split()]

    position_shift, position_turn = given("X0 Y0 Z0"), given("A0 B0 C0")
    component_shift, component_turn = given("EX EY EZ"), given("EA EB EC")
    e = np.array(machine.directions[LETTERS.index(letter)])
    if letter in LINEAR:
        motion = small_turn(*position_turn).apply(e) * q
        turned = rotation(small_turn(*component_turn))
        return translation(motion) @ translation(position_shift) @ translation(component_shift) @ turned
    center = machine.centers["ABC".index(letter)]
    turn = translation(center) @ rotation(Rotation.from_rotvec(np.radians(q) * e)) @ translation(np.negative(center))
    if machine.alternative_model:
        displaced = translation(position_shift) @ rotation(small_turn(*position_turn))
        displaced_turn = displaced @ turn @ np.linalg.inv(displaced)
        return translation(component_shift) @ rotation(small_turn(*component_turn)) @ displaced_turn
    shift = translation(np.add(position_shift, component_shift))
    return shift @ rotation(small_turn(*np.add(position_turn, component_turn))) @ turn


def interpolated_errors(machine: Volumetric, position: Mapping[str, float]) -> dict[str, float]:
    """Return the errors at setpoints: constants, and tables over one axis."""
    found = {}
    for table in machine.errors:
        found[table.name] = table.values[0]
        if table.arguments:
            index = LETTERS.index(table.arguments)
            offset = machine.offsets[index] if table.arguments in LINEAR else np.degrees(machine.offsets[index])
            nodes = [node[0] for node in table.nodes]
            found[table.name] = float(np.interp(position[table.arguments] + offset, nodes, table.values))
    return found


def tool_place(
    machine: Volumetric, position: Mapping[str, float], errors: Mapping[str, float], tool_length: float = 0.0
) -> Matrix:
    """Return where the tool tip is, seen from the workpiece; ``position``: setpoints by letter."""
    matrix = np.eye(4)
    for place, letter in enumerate(machine.chain):
        index = LETTERS.index(letter)
        offset = machine.offsets[index] if letter in LINEAR else np.degrees(machine.offsets[index])
        a = axis_matrix(letter, machine, position[letter] + offset, errors)
        matrix = matrix @ (np.linalg.inv(a) if place < machine.workpiece_axes else a)
    tip = np.add(machine.tool_position, tool_length * np.array(machine.tool_orientation))
    return (matrix @ [*tip, 1.0])[:3]


def with_constant_errors(machine: Volumetric, errors: Mapping[str, float]) -> Volumetric:
    return replace(machine, errors=tuple(ErrorTable(name, (value,)) for name, value in errors.items()))


def machine_of(*compensations: Volumetric, limit: float | None = 1000.0) -> Machine:
    """Return a machine whose axes X … C have the numbers 1 … 6."""
    types = dict.fromkeys(LINEAR, AxisType.TRANSLATORY)
    axes = (
        Axis(number, letter, types.get(letter, AxisType.ROTARY), volumetric_limit=limit, volumetric_velocity=FASTEST)
        for letter, number in NUMBERS.items()
    )
    return Machine(tuple(axes), compensations)


def volumetric(chain: str, **parameters: Any) -> Volumetric:
    axes = tuple((letter, NUMBERS[letter]) for letter in LETTERS if letter in chain or letter in LINEAR)
    return Volumetric(**{"index": 0, "axes": axes, "chain": chain, "max_records": 100_000} | parameters)


def corrections(machine: Volumetric, position: Mapping[str, float], tool_length: float = 0.0) -> dict[str, float]:
    """Return what the engine adds to X, Y and Z at a position."""
    runtime = Runtime(machine_of(machine))
    return corrections_of(runtime, position, tool_length)


def corrections_of(runtime: Runtime, position: Mapping[str, float], tool_length: float = 0.0) -> dict[str, float]:
    runtime.inputs.tool_length = tool_length
    for letter, q in position.items():
        runtime.inputs.axis[NUMBERS[letter] - 1].setpoint = q
    runtime.cycle()
    assert [axis.error for axis in runtime.outputs.axis] == [0] * 6
    return {letter: runtime.outputs.axis[i].volumetric_correction for i, letter in enumerate(LINEAR)}


def compensated(machine: Volumetric, position: Mapping[str, float], tool_length: float = 0.0) -> dict[str, float]:
    """Return a position with its corrections."""
    added = corrections(machine, position, tool_length)
    return {letter: q + added.get(letter, 0.0) for letter, q in position.items()}


def kernel_tool_place(
    machine: Volumetric, position: Mapping[str, float], errors: Mapping[str, float], tool_length: float = 0.0
) -> Matrix:
    """Return where the kernel says the tool tip is."""
    table = Runtime(machine_of(with_constant_errors(machine, errors))).tables.volumetric[machine.index]
    values = zeros(len(ERRORS))
    for name, value in errors.items():
        values[ERRORS.index(name)] = value
    q = [position.get(letter, 0.0) + table.offset[i] for i, letter in enumerate(LETTERS)]
    nominal, actual = zeros(FRAME), zeros(FRAME)
    carry_to_workpiece(table, q, tool_length, values, nominal, actual)
    return np.array(actual[:3])
