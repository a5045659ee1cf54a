"""The one list of the FMU's variables: each is declared once, and a machine says which of them there are.

A value reference is ``BLOCK * block + identifier``. Block 0 holds the variables of the whole machine, block 1 + i those
of axis i; an identifier never changes its meaning, so a reference means the same in every machine.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal, NamedTuple

from ..kernel import Inputs, Outputs
from ..kinds import KINDS, kinds_of
from ..model import AXES_MAX, COMPENSATIONS_MAX, CYCLE_TIME, LARGEST_STEP, Axis, Machine, Volumetric
from .dependencies import Dependencies, Input, volumetric_input, volumetric_switch
from .slot import Slot, slot_in
from .variable import BLOCK, Causality, Value, Variability, Variable

Naming = Literal["structured", "flat"]
"""``X.leadscrew.correction`` or ``X_leadscrew_correction``."""

MACHINE_BLOCK = 0
AXIS_BLOCK = 1  # … 32
VOLUMETRIC_BLOCK = AXIS_BLOCK + AXES_MAX  # … 37; the next blocks are free

VOLUMETRIC = "volumetric"
"""Kind of what appears only where there are volumetric compensations."""

PARTICIPANT = "participant"
"""Kind of what an axis has that takes part in one, whether it is corrected or not."""

POSITION, VELOCITY, ACCELERATION = "{}", "{}/s", "{}/s2"
"""Units of an axis' quantities; {} stands for mm or deg."""

_OF_CURRENT = next(kind for kind in KINDS.values() if kind.adds_to == "current")


class Declaration(NamedTuple):
    """A variable of the machine, of every axis, or of every volumetric compensation.

    ``kind``: it appears only where this compensation is configured; "": always. ``variability``: where it is not the
    usual one of its type. ``path``: of its field in the records, where that is not called as the variable is.
    """

    identifier: int
    name: str
    causality: Causality
    start: Value
    description: str
    unit: str = ""
    kind: str = ""
    variability: Variability | None = None
    path: str = ""

    @property
    def flat(self) -> str:
        """Name without dots and brackets."""
        return self.name.replace(".", "_").replace("[", "_").replace("]", "")

    @property
    def field(self) -> str:
        """Path of its field in the kernel's records or in ``Controls``."""
        return self.path or self.flat


@dataclass(slots=True)
class Controls:
    """The variables that the kernel does not know."""

    cycle_time: float = CYCLE_TIME
    largest_step: int = LARGEST_STEP
    reload: bool = False
    update_path: str = ""


OF_MACHINE = (
    Declaration(0, "reset", "input", False, "Reset: manual compensations off, errors cleared"),
    Declaration(1, "program_end", "input", False, "End of the NC program: manual compensations off"),
    Declaration(2, "reload", "input", False, "A rising edge reads what update_path names"),
    Declaration(
        3,
        "update_path",
        "parameter",
        "",
        "What reload reads: an image of tables, or lists where Python runs in the FMU; empty: what lies in resources",
        variability="tunable",
    ),
    Declaration(
        4, "cycle_time", "parameter", CYCLE_TIME, "Cycle time of the position controller", "s", variability="fixed"
    ),
    Declaration(
        7,
        "largest_step",
        "parameter",
        LARGEST_STEP,
        "Cycles that a communication step may have; a longer one is refused",
        variability="fixed",
    ),
    Declaration(
        6,
        "derive_motion",
        "parameter",
        False,
        "Velocities and accelerations are not given: they follow from the setpoints",
        variability="fixed",
    ),
    Declaration(5, "tool_length", "input", 0.0, "Length of the tool along its orientation (N0*)", "mm", VOLUMETRIC),
)

OF_AXIS = (
    Declaration(0, "setpoint", "input", 0.0, "Setpoint position before all compensations", POSITION),
    Declaration(1, "velocity", "input", 0.0, "Setpoint velocity", VELOCITY),
    Declaration(2, "acceleration", "input", 0.0, "Setpoint acceleration", ACCELERATION),
    Declaration(3, "actual_position", "input", 0.0, "Measured position", POSITION),
    Declaration(4, "referenced", "input", True, "The axis has its reference"),
    Declaration(5, "fault", "input", False, "The axis is in error"),
    Declaration(6, "no_move", "input", False, "What is switched now moves no axis: its value becomes setpoint_shift"),
    Declaration(7, "released", "input", False, "A rising edge gives the axis back: manual compensations off"),
    Declaration(8, "corrected_setpoint", "output", 0.0, "Setpoint with all corrections, for the drive", POSITION),
    Declaration(9, "display_position", "output", 0.0, "Measured position without the corrections", POSITION),
    Declaration(10, "correction", "output", 0.0, "Sum of all corrections of the setpoint", POSITION),
    Declaration(11, "setpoint_shift", "output", 0.0, "Offset that keeps the setpoint continuous (no_move)", POSITION),
    Declaration(12, "error", "output", 0, "0, or the number of an error: 901 as long as its cause, others until reset"),
    Declaration(
        13,
        "current",
        "output",
        0.0,
        "Additional motor current, in the drive's own unit",
        kind=_OF_CURRENT.name,
        path=f"contribution[{_OF_CURRENT.number}]",
    ),
    Declaration(
        14, "stop_request", "output", False, "A volumetric compensation asks the axis to stop", kind=PARTICIPANT
    ),
    Declaration(15, "volumetric.correction", "output", 0.0, "Sum of all volumetric corrections", POSITION, VOLUMETRIC),
)

OF_VOLUMETRIC = (
    Declaration(0, "enable", "input", True, "Command of the volumetric compensation: on or off"),
    Declaration(1, "no_move", "input", False, "The command moves no axis: its value becomes setpoint_shift"),
    *(
        Declaration(2 + i, f"factor_{letter}", "input", 1.0, f"Share of {letter.upper()}'s correction, with a command")
        for i, letter in enumerate("xyz")
    ),
    Declaration(5, "active", "output", False, "The volumetric compensation acts at least partly"),
)


def _of_kinds() -> Iterator[Declaration]:
    for name, kind in KINDS.items():
        first, number = kind.identifier, kind.number
        called = f"{name} compensation"
        text = f"Command of the {called}: on or off"
        yield Declaration(first, f"{name}.enable", "input", True, text, kind=name, path=f"enable[{number}]")
        text = f"The {called} acts at least partly"
        yield Declaration(first + 1, f"{name}.active", "output", False, text, kind=name, path=f"active[{number}]")
        if kind.adds_to == "setpoint":
            text, path = f"Correction of the setpoint by the {called}", f"contribution[{number}]"
            yield Declaration(first + 2, f"{name}.correction", "output", 0.0, text, POSITION, name, path=path)
        for own in kind.inputs:
            start: Value = False if own.boolean else 0.0
            path = f"compensation.{name}.{own.path}"
            yield Declaration(own.identifier, own.name, "input", start, own.description, own.unit, name, path=path)


AXIS_DECLARATIONS = (*OF_AXIS, *_of_kinds())


def variables_of(
    machine: Machine, naming: Naming = "structured", cycle_time: float = CYCLE_TIME
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
    """
    starts: dict[str, Value] = {"cycle_time": cycle_time}
    every_axis = list(enumerate(zip(machine.axes, _prefixes(machine, naming), strict=True)))
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
                    _start(d, axis),
                    d.unit.format(axis.unit),
                    tuple(name for key, name in inputs.items() if key in needed),
                    index,
                )
            )
    for one in machine.volumetric:
        variables += _of_volumetric(machine, one, inputs, naming)
    return tuple(variables)


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
            not volumetric.manual_activation if d.name == "enable" else d.start,
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
            if not isinstance(record, Inputs if declared.causality == "input" else Outputs):
                continue
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


def _start(declaration: Declaration, axis: Axis) -> Value:
    """Return the start value: an enable input begins as the compensation activates without a command."""
    if declaration.name.endswith(".enable"):
        return not getattr(getattr(axis, declaration.kind), "manual_activation", False)
    if declaration.kind in KINDS:
        compensation = getattr(axis, declaration.kind)
        for own in KINDS[declaration.kind].inputs:
            if declaration.name == own.name and own.field and compensation is not None:
                return float(getattr(compensation, own.field))
    return declaration.start


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
    )


def _name(prefix: str, declaration: Declaration, naming: Naming) -> str:
    return f"{prefix}.{declaration.name}" if naming == "structured" else f"{prefix}_{declaration.flat}"


def _prefixes(machine: Machine, naming: Naming) -> list[str]:
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
