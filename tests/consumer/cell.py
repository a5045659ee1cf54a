"""A project that uses axcomp as a library: every name it offers, with the types a checker must see."""

from pathlib import Path

import axcomp
from axcomp import (
    Axis,
    Built,
    Curve,
    Engine,
    Finding,
    Grid,
    Iso230Result,
    ListError,
    Machine,
    Reading,
    Result,
    Severity,
    Tables,
)


def errors(lists: Path) -> list[Finding]:
    """Return the errors in some lists."""
    reading: Reading = axcomp.check(lists)
    return [finding for finding in reading.findings if finding.severity is Severity.ERROR]


def corrected(lists: Path, axis: str, positions: list[float]) -> list[float]:
    """Return setpoints with their corrections."""
    try:
        engine = Engine(lists, cycle_time=0.002)
    except ListError as error:
        first: Finding = error.findings[0]
        raise SystemExit(first.message) from None
    result: Result = engine.run({f"{axis}.setpoint": positions})
    unit: str = result.units[f"{axis}.corrected_setpoint"]
    print(unit, result.cycles, sorted(result))
    return [float(value) for value in result[f"{axis}.corrected_setpoint"]]


def names(machine: Machine) -> dict[str, tuple[str, ...]]:
    """Return the kinds of each axis."""
    found: dict[str, tuple[str, ...]] = {}
    axis: Axis
    for axis in machine.axes:
        found[axis.name] = axis.kinds
    return found


def pack(lists: Path, folder: Path) -> Path:
    """Build an FMU."""
    built: Built = axcomp.build_fmu(lists, folder, runtime="native", cycle_time=0.002, platforms=["linux64"])
    return built.path


def tables(lists: Path) -> int:
    """Count the points of all tables."""
    shown: Tables = axcomp.show(lists, kind="leadscrew")
    return sum(len(one.records().rows) for one in shown)


def reversal(file: Path) -> float:
    """Return the reversal value of a measurement."""
    result: Iso230Result = axcomp.measure(file)
    return result.B


def between(curve: Curve, grid: Grid) -> float:
    """Look tables up."""
    return curve.at(1.5) + grid.at(1.0, 2.0)


def saved(machine: Machine, folder: Path) -> None:
    """Write lists."""
    axcomp.write_machine(machine, folder)


print(axcomp.__version__, axcomp.models())
