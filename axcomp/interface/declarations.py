"""The variables of an FMU, as they are declared: once each, whatever the machine is.

A value reference is ``BLOCK * block + identifier``. Block 0 holds the variables of the whole machine, block 1 + i those
of axis i; an identifier never changes its meaning, so a reference means the same in every machine.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ..kernel import LARGEST, LARGEST_TOOL
from ..kinds import KINDS
from ..model import AXES_MAX, CYCLE_TIME, CYCLE_TIME_MAX, LARGEST_STEP
from .variable import Causality, Limits, Value, Variability

MACHINE_BLOCK = 0
AXIS_BLOCK = 1  # … 32
VOLUMETRIC_BLOCK = AXIS_BLOCK + AXES_MAX  # … 37; the next blocks are free

VOLUMETRIC = "volumetric"
"""Kind of what appears only where there are volumetric compensations."""

PARTICIPANT = "participant"
"""Kind of what an axis has that takes part in one, whether it is corrected or not."""

POSITION, VELOCITY, ACCELERATION = "{}", "{}/s", "{}/s2"
"""Units of an axis' quantities; {} stands for mm or deg."""

FINITE = (-LARGEST, LARGEST)
NOMINAL_CORRECTION = 0.01  # mm or °

_OF_CURRENT = next(kind for kind in KINDS.values() if kind.adds_to == "current")


class Declaration(NamedTuple):
    """A variable of the machine, of every axis, or of every volumetric compensation.

    ``kind``: it appears only where this compensation is configured; "": always. ``variability``: where it is not the
    usual one of its type. ``path``: of its field in the records, where that is not called as the variable is.
    ``limits``: values beyond are refused or not used; ``nominal``: about how large its values are.
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
    limits: Limits | None = None
    nominal: float | None = None

    @property
    def flat(self) -> str:
        """Name without dots and brackets."""
        return self.name.replace(".", "_").replace("[", "_").replace("]", "")

    @property
    def field(self) -> str:
        """Path of its field in the kernel's records or in ``Controls``."""
        return self.path or self.flat


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
        4,
        "cycle_time",
        "parameter",
        CYCLE_TIME,
        "Cycle time of the position controller",
        "s",
        variability="fixed",
        limits=(1e-9, CYCLE_TIME_MAX),
        nominal=CYCLE_TIME,
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
    Declaration(
        5,
        "tool_length",
        "input",
        0.0,
        "Length of the tool along its orientation (N0*)",
        "mm",
        VOLUMETRIC,
        limits=(-LARGEST_TOOL, LARGEST_TOOL),
        nominal=100.0,
    ),
)

OF_AXIS = (
    Declaration(
        0,
        "setpoint",
        "input",
        0.0,
        "Setpoint position before all compensations",
        POSITION,
        limits=FINITE,
        nominal=100.0,
    ),
    Declaration(1, "velocity", "input", 0.0, "Setpoint velocity", VELOCITY, limits=FINITE, nominal=100.0),
    Declaration(2, "acceleration", "input", 0.0, "Setpoint acceleration", ACCELERATION, limits=FINITE, nominal=1000.0),
    Declaration(3, "actual_position", "input", 0.0, "Measured position", POSITION, limits=FINITE, nominal=100.0),
    Declaration(4, "unreferenced", "input", False, "The axis has no reference (yet)"),
    Declaration(5, "fault", "input", False, "The axis is in error"),
    Declaration(6, "no_move", "input", False, "What is switched now moves no axis: its value becomes setpoint_shift"),
    Declaration(7, "released", "input", False, "A rising edge gives the axis back: manual compensations off"),
    Declaration(
        8, "corrected_setpoint", "output", 0.0, "Setpoint with all corrections, for the drive", POSITION, nominal=100.0
    ),
    Declaration(
        9, "display_position", "output", 0.0, "Measured position without the corrections", POSITION, nominal=100.0
    ),
    Declaration(
        10, "correction", "output", 0.0, "Sum of all corrections of the setpoint", POSITION, nominal=NOMINAL_CORRECTION
    ),
    Declaration(
        11,
        "setpoint_shift",
        "output",
        0.0,
        "Offset that keeps the setpoint continuous (no_move)",
        POSITION,
        nominal=NOMINAL_CORRECTION,
    ),
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
    Declaration(
        15,
        "volumetric.correction",
        "output",
        0.0,
        "Sum of all volumetric corrections",
        POSITION,
        VOLUMETRIC,
        nominal=NOMINAL_CORRECTION,
    ),
)

COMMANDS = "0 as the lists say, 1 on, -1 off"
"""What the values of a switch mean."""

OF_VOLUMETRIC = (
    Declaration(
        0, "switch", "input", 0, f"Command of the volumetric compensation: {COMMANDS}", path="wanted", limits=(-1, 1)
    ),
    Declaration(1, "no_move", "input", False, "The command moves no axis: its value becomes setpoint_shift"),
    *(
        Declaration(
            2 + i, f"reduction_{letter}", "input", 0.0, f"1 - CFACT_{letter.upper()}, with a command", limits=(0.0, 1.0)
        )
        for i, letter in enumerate("xyz")
    ),
    Declaration(5, "active", "output", False, "The volumetric compensation acts at least partly"),
)


def _of_kinds() -> Iterator[Declaration]:
    for name, kind in KINDS.items():
        first, number = kind.identifier, kind.number
        called = f"{name} compensation"
        text = f"Command of the {called}: {COMMANDS}"
        yield Declaration(
            first, f"{name}.switch", "input", 0, text, kind=name, path=f"wanted[{number}]", limits=(-1, 1)
        )
        text = f"The {called} acts at least partly"
        yield Declaration(first + 1, f"{name}.active", "output", False, text, kind=name, path=f"active[{number}]")
        if kind.adds_to == "setpoint":
            text, path = f"Correction of the setpoint by the {called}", f"contribution[{number}]"
            yield Declaration(
                first + 2,
                f"{name}.correction",
                "output",
                0.0,
                text,
                POSITION,
                name,
                path=path,
                nominal=NOMINAL_CORRECTION,
            )
        for own in kind.inputs:
            start: Value = False if own.boolean else 0.0
            path = f"compensation.{name}.{own.path}"
            yield Declaration(own.identifier, own.name, "input", start, own.description, own.unit, name, path=path)


AXIS_DECLARATIONS = (*OF_AXIS, *_of_kinds())
