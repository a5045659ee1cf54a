"""The variables of an FMU: which of the declared ones a machine has, and where their values are."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal

from ..kernel import Inputs, Outputs
from ..kinds import kinds_of
from ..model import COMPENSATIONS_MAX, CYCLE_TIME, LARGEST_STEP, Axis, Machine, Volumetric
from .declarations import (
    AXIS_BLOCK,
    AXIS_DECLARATIONS,
    MACHINE_BLOCK,
    OF_MACHINE,
    OF_VOLUMETRIC,
    PARTICIPANT,
    VOLUMETRIC,
    VOLUMETRIC_BLOCK,
    Declaration,
)
from .dependencies import Dependencies, Input, volumetric_input, volumetric_switch
from .slot import Slot, slot_in
from .variable import BLOCK, Value, Variable

Naming = Literal["structured", "flat"]
"""``X.leadscrew.correction`` or ``X_leadscrew_correction``."""

Types = Literal["own", "real"]
"""Of the variables: each its own, or Real instead of Boolean and Integer."""


@dataclass(slots=True)
class Controls:
    """The variables that the kernel does not know."""

    cycle_time: float = CYCLE_TIME
    largest_step: int = LARGEST_STEP
    reload: bool = False
    update_path: str = ""


def variables_of(
    machine: Machine, naming: Naming = "structured", cycle_time: float = CYCLE_TIME, types: Types = "own"
) -> tuple[Variable, ...]:
    """Return the variables of a machine's FMU: those of the machine, then axis by axis.

    Parameters
    ----------
    machine : Machine
        Every master must be one of its axes.
    naming : str
        ``structured`` (``X.leadscrew.correction``) or ``flat`` (``X_leadscrew_correction``).
    cycle_time : float
        Start value of the parameter of that name, s.
    types : str
        ``own``, or ``real``: Booleans and Integers are Real, Strings left out, for importers that take all as Real.
    """
    starts: dict[str, Value] = {"cycle_time": cycle_time}
    every_axis = list(enumerate(zip(machine.axes, prefixes_of(machine, naming), strict=True)))
    of_machine = [d for d in OF_MACHINE if d.kind != VOLUMETRIC or machine.volumetric]
    inputs: dict[Input, str] = {(None, d.name): d.name for d in of_machine if d.causality == "input"}
    inputs.update(
        ((index, d.name), _name(prefix, d, naming))
        for index, (axis, prefix) in every_axis
        for d in _present(machine, axis)
        if d.causality == "input"
    )
    inputs.update(
        ((None, volumetric_input(one, d.name)), _name(_volumetric_prefix(one.index, naming), d, naming))
        for one in machine.volumetric
        for d in OF_VOLUMETRIC
        if d.causality == "input"
    )
    variables = [_variable(d, d.name, MACHINE_BLOCK, starts.get(d.name, d.start)) for d in of_machine]
    for index, (axis, prefix) in every_axis:
        dependencies = Dependencies(machine, index)
        for d in _present(machine, axis):
            needed = dependencies.of(d.name) if d.causality == "output" else frozenset()
            variables.append(
                _variable(
                    d,
                    _name(prefix, d, naming),
                    AXIS_BLOCK + index,
                    d.start,
                    d.unit.format(axis.unit),
                    tuple(name for key, name in inputs.items() if key in needed),
                    index,
                )
            )
    for one in machine.volumetric:
        variables += _of_volumetric(machine, one, inputs, naming)
    if types == "real":
        variables = [_as_real(v) for v in variables if not isinstance(v.start, str)]
    return tuple(variables)


def _as_real(variable: Variable) -> Variable:
    limits = (0.0, 1.0) if isinstance(variable.start, bool) else variable.limits
    return replace(variable, start=float(variable.start), limits=limits and (float(limits[0]), float(limits[1])))


def _of_volumetric(
    machine: Machine, volumetric: Volumetric, inputs: dict[Input, str], naming: Naming
) -> Iterator[Variable]:
    """Yield the variables of a volumetric compensation."""
    needed = volumetric_switch(machine, volumetric)
    for d in OF_VOLUMETRIC:
        yield _variable(
            d,
            _name(_volumetric_prefix(volumetric.index, naming), d, naming),
            VOLUMETRIC_BLOCK + volumetric.index,
            d.start,
            depends_on=tuple(name for key, name in inputs.items() if key in needed and d.causality == "output"),
            volumetric=volumetric.index,
        )


def slot_of(
    declared: Declaration | Variable,
    axis: int | None,
    *records: Inputs | Outputs | Controls,
    volumetric: int | None = None,
) -> Slot | None:
    """Return where the value of a variable is; ``axis``: place of its axis, None: of no axis.

    ``records`` are those to look in: ``Inputs`` and ``Outputs``, and ``Controls`` where there are some. None: in none.
    ``volumetric``: place of its volumetric compensation, None: of none.
    """
    for record in records:
        candidate: object = record
        if axis is not None or volumetric is not None:
            # By its name: the records of a compiled kernel are no dataclasses, but called alike.
            if type(record).__name__ != ("Inputs" if declared.causality == "input" else "Outputs"):
                continue
            assert not isinstance(record, Controls)
            candidate = record.axis[axis] if axis is not None else record.volumetric[volumetric or 0]
        found = slot_in(candidate, declared.field)
        if found is not None:
            return found
    return None


def every_slot(
    axis_count: int, *records: Inputs | Outputs | Controls, volumetrics: int = 0
) -> Iterator[tuple[int, Declaration, Slot]]:
    """Yield reference, declaration and slot of every variable that so many axes and compensations can have."""
    blocks: list[tuple[int, tuple[Declaration, ...], int | None, int | None]]
    blocks = [(MACHINE_BLOCK, OF_MACHINE, None, None)]
    blocks += [(AXIS_BLOCK + index, AXIS_DECLARATIONS, index, None) for index in range(axis_count)]
    blocks += [(VOLUMETRIC_BLOCK + index, OF_VOLUMETRIC, None, index) for index in range(volumetrics)]
    for block, declarations, axis, volumetric in blocks:
        for declaration in declarations:
            slot = slot_of(declaration, axis, *records, volumetric=volumetric)
            if slot is not None:
                yield BLOCK * block + declaration.identifier, declaration, slot


def _present(machine: Machine, axis: Axis) -> Iterator[Declaration]:
    kinds = {"", *axis.kinds}
    if any(machine.index_of(axis.number) in machine.members(one) for one in machine.volumetric):
        kinds.add(PARTICIPANT)
    if any(axis.number in machine.corrected_by(one) for one in machine.volumetric):
        kinds.add(VOLUMETRIC)
    absent = {own.name for kind in kinds_of(axis) for own in kind.inputs if not own.present(getattr(axis, kind.name))}
    return (one for one in AXIS_DECLARATIONS if one.kind in kinds and one.name not in absent)


def _volumetric_prefix(index: int, naming: Naming) -> str:
    return f"volumetric[{index}]" if naming == "structured" else f"volumetric_{index}"


def _variable(
    declaration: Declaration,
    name: str,
    block: int,
    start: Value,
    unit: str | None = None,
    depends_on: tuple[str, ...] = (),
    axis: int | None = None,
    volumetric: int | None = None,
) -> Variable:
    return Variable(
        name,
        BLOCK * block + declaration.identifier,
        declaration.causality,
        start,
        declaration.description,
        declaration.unit if unit is None else unit,
        declaration.variability or ("continuous" if isinstance(start, float) else "discrete"),
        depends_on,
        axis,
        declaration.field,
        volumetric,
        declaration.name,
        declaration.limits,
        declaration.nominal,
    )


def _name(prefix: str, declaration: Declaration, naming: Naming) -> str:
    return f"{prefix}.{declaration.name}" if naming == "structured" else f"{prefix}_{declaration.flat}"


def prefixes_of(machine: Machine, naming: Naming) -> list[str]:
    """Return the axes' names as identifiers, so that no two variables get the same name."""
    prefixes: list[str] = []
    taken = {declaration.name for declaration in OF_MACHINE}
    for index in range(COMPENSATIONS_MAX):
        taken.update(_name(_volumetric_prefix(index, naming), d, naming) for d in OF_VOLUMETRIC)
    for axis in machine.axes:
        wanted = identifier(axis.name) or f"axis{axis.number}"
        prefix, count = wanted, 1
        while taken & (names := {prefix, *(_name(prefix, d, naming) for d in AXIS_DECLARATIONS)}):
            count += 1
            prefix = f"{wanted}_{count}"
        prefixes.append(prefix)
        taken |= names
    return prefixes


def identifier(name: str) -> str:
    """Return an axis name with ``_`` for what an identifier of FMI cannot hold; "" stays."""
    letters = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in name)
    return f"_{letters}" if letters[:1].isdigit() else letters


def by_name(variables: Iterable[Variable]) -> dict[str, Variable]:
    """Return the variables by their names."""
    return {variable.name: variable for variable in variables}
