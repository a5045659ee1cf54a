"""The options that tables are judged by, for ``axcomp check`` and ``axcomp report``."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..analysis.judgement import Evidence
from ..model import CYCLE_TIME, Machine

if TYPE_CHECKING:
    from ..analysis.judgement import Demand
    from ..measurement import Positioning

SPEEDS = {"mm/min": 1 / 60, "m/min": 1e3 / 60, "mm/s": 1.0, "m/s": 1e3}
SPEEDS |= {"deg/min": 1 / 60, "°/min": 1 / 60, "deg/s": 1.0, "°/s": 1.0, "rpm": 6.0}
"""Units of velocities, in mm/s or °/s."""
ACCELERATIONS = {"mm/s2": 1.0, "m/s2": 1e3, "deg/s2": 1.0, "°/s2": 1.0}
"""Units of accelerations, in mm/s² or °/s²."""

_QUANTITY = re.compile(r"(?:([^=]+)=)?\s*(\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)\s*(\D.*)?\Z")


def add_judgement_options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    group = parser.add_argument_group("judgement of the tables")

    def add(name: str, metavar: str, meaning: str) -> None:
        group.add_argument(name, action="append", default=[], metavar=metavar, help=meaning)

    add("--measurement", "FILE", "taken without the compensation, as axcomp measure takes it; repeatable")
    group.add_argument("--axis", metavar="NAME", help="axis that deviates, where the measurement does not say")
    group.add_argument("--over", metavar="NAME", help="axis that was moved, for a cross table (default: the same)")
    add("--feed", "[AXIS=]VALUE", "of the axes, mm/min or °/min unless with a unit: 500mm/s; repeatable")
    add("--max-velocity", "[AXIS=]VALUE", "of the axes, in the same units")
    add("--max-acceleration", "[AXIS=]VALUE", "of the axes, mm/s² or °/s² unless with a unit: 5m/s2")
    group.add_argument(
        "--cycle-time", type=float, default=CYCLE_TIME, metavar="s", help=f"of the controller ({CYCLE_TIME:g})"
    )
    group.add_argument("--input", type=Path, metavar="FILE.csv", help="setpoints in use: columns X.setpoint and so on")
    group.add_argument("--tool-length", type=float, default=0.0, metavar="mm", help="for volumetric corrections (0)")


def evidence_of(options: argparse.Namespace, machine: Machine) -> Evidence:
    """Return what the options give; what is wrong with one of them does not hide the others."""
    faults: list[str] = []
    measurements, readings = _measurements(options, machine, faults) if options.measurement else ([], [])
    demand = None
    try:
        demand = _demand(options, machine)
    except ValueError as error:
        faults.append(str(error))
    given = None
    try:
        if options.input is not None:
            from ..analysis.judgement import setpoints
            from ..engine import read_input

            found = read_input(options.input)
            setpoints(found.columns, machine)
            given = found
    except ValueError as error:
        faults.append(str(error))
    return Evidence(tuple(measurements), tuple(readings), demand, given, options.tool_length, tuple(faults))


def _measurements(
    options: argparse.Namespace, machine: Machine, faults: list[str]
) -> tuple[list[tuple[Positioning, str, str]], list[Positioning]]:
    """Return the measurements that can be used, with their axes, and all that could be read."""
    from ..analysis.judgement import sign_of
    from ..measurement import MeasurementError, read_positioning

    measurements, readings = [], []
    for file in options.measurement:
        try:
            measurement = read_positioning(file, options.axis or "", of_another_axis=options.over is not None)
            readings.append(measurement)
            axis = options.axis or measurement.axis or _only_axis(machine, file)
            over = options.over or axis
            sign_of(machine, measurement, axis, over)
            measurements.append((measurement, axis, over))
        except (MeasurementError, ValueError) as error:
            faults.append(str(error))
    return measurements, readings


def _only_axis(machine: Machine, file: str) -> str:
    """Return the axis that is meant where the measurement does not say: the only one with a leadscrew table."""
    names = [axis.name for axis in machine.axes if axis.leadscrew is not None]
    if len(names) != 1:
        raise ValueError(f"{file}: It does not say which axis it is of; --axis NAME does.")
    return names[0]


def _demand(options: argparse.Namespace, machine: Machine) -> Demand | None:
    if not (options.feed or options.max_velocity or options.max_acceleration):
        return None
    from ..analysis.judgement import Demand

    if not options.cycle_time > 0.0:
        raise ValueError(f"--cycle-time: {options.cycle_time:g} s is no cycle time")
    return Demand(
        _by_axis("--feed", options.feed, SPEEDS, "mm/min", machine),
        _by_axis("--max-velocity", options.max_velocity, SPEEDS, "mm/min", machine),
        _by_axis("--max-acceleration", options.max_acceleration, ACCELERATIONS, "mm/s2", machine),
        options.cycle_time,
    )


def _by_axis(
    option: str, words: Sequence[str], units: dict[str, float], default: str, machine: Machine
) -> dict[str, float]:
    """Return values by axis, "" for all others."""
    found = {}
    for word in words:
        match = _QUANTITY.match(word.strip())
        axis, unit = (match[1] or "", (match[3] or default).strip().replace("²", "2")) if match else ("", "")
        if match is None or unit not in units:
            raise ValueError(f"{option}: “{word}” is no [AXIS=]VALUE in {', '.join(units)}")
        if axis and axis not in {one.name for one in machine.axes}:
            names = ", ".join(one.name for one in machine.axes) or "none"
            raise ValueError(f"{option}: there is no axis {axis!r}; the machine has {names}")
        found[axis] = float(match[2]) * units[unit]
    return found
