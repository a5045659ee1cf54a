"""A machine as a system of SSP 1.0: commands, compensation and plant, connected, with units and parameters.

Only connectors that something is connected to are listed, and the system has none: FMPy, ecos and libcosim differ on
the others. Every connection has the delay of a step that co-simulation has.
"""

from __future__ import annotations

import csv
import json
import os
import tempfile
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, register_namespace

from .. import __version__
from ..fmu import (
    PACKAGE,
    BuildError,
    Built,
    Description,
    accompanying,
    add_units,
    document,
    generation_date,
    package_native,
    write_fmu,
    write_python_fmu,
)
from ..interface import Variable, by_name
from ..lists import TypeName
from ..model import CYCLE_TIME, fmu_sources
from ..plant import package_plant, plant_variables
from .examples import INPUT

COMMANDS, COMPENSATION, PLANT = "commands", "axcomp", "plant"
MEASURED = "actual_position"
"""Input that the plant gives, whatever the commands say."""

NAMESPACES = {
    kind: f"http://ssp-standard.org/SSP1/SystemStructure{name}"
    for kind, name in (("ssd", "Description"), ("ssc", "Common"), ("ssv", "ParameterValues"))
}
PARAMETERS = "resources/parameters.ssv"

Connections = list[tuple[str, str, str, str]]
"""Element and variable that gives, element and variable that takes."""


class Part(NamedTuple):
    """An FMU of the system, and its variables by name."""

    name: str
    path: Path
    variables: Mapping[str, Variable]


def write_ssp(
    lists: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    cycle_time: float = CYCLE_TIME,
    platforms: Sequence[str] = (),
    axis_type: TypeName | None = None,
    external_tool: bool = True,
    allow_outside: Sequence[str | os.PathLike[str]] = (),
) -> Built:
    """Write the system of a machine whose folder has a ``plant.json``; a folder as output: ``machine.ssp`` in it.

    The commands are those of ``input.csv`` in that folder; without one there are none, and whoever runs the system
    sets the setpoints. The other arguments are those of ``package_native`` and ``package_plant``.

    Raises
    ------
    BuildError
        If there is no machine or no plant, they do not fit, or the file cannot be written.
    """
    path = Path(output) / "machine.ssp" if Path(output).is_dir() else Path(output)
    model = Path(lists) if Path(lists).is_dir() else Path(lists).parent
    plant = by_name(plant_variables(model))
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        built = package_native(
            lists, folder, cycle_time=cycle_time, platforms=platforms, axis_type=axis_type, allow_outside=allow_outside
        )
        parts = [
            Part(COMPENSATION, built.path, by_name(built.variables)),
            Part(PLANT, package_plant(model, folder, external_tool=external_tool), plant),
        ]
        rows: Mapping[str, Sequence[float]] = {}
        if (model / INPUT).exists():
            rows = _commands(model / INPUT, parts[0].variables)
            parts.insert(0, _package_commands(rows, parts[0].variables, cycle_time, folder, external_tool))
        connections = list(_connections(rows, parts[-2].variables, plant))
        files = {f"resources/{part.path.name}": part.path.read_bytes() for part in parts}
    duration = cycle_time * (max(map(len, rows.values()), default=1001) - 1)
    files["SystemStructure.ssd"] = _structure(parts, connections, duration)
    files[PARAMETERS] = _parameters(rows, parts, cycle_time)
    write_fmu(path, files)
    return built._replace(path=path)


def _commands(path: Path, known: Mapping[str, Variable]) -> dict[str, list[float]]:
    try:
        with path.open(encoding="utf-8", newline="") as file:
            head, *rows = csv.reader(file)
        columns = dict(zip(head, zip(*[[float(cell) for cell in row] for row in rows], strict=True), strict=True))
    except (OSError, ValueError) as error:
        raise BuildError(f"{path} holds no commands: {error}") from None
    columns.pop("time", None)
    unknown = ", ".join(name for name in columns if name not in known)
    if unknown:
        raise BuildError(f"{path}: the machine has no input {unknown}.")
    return {name: list(column) for name, column in columns.items() if not name.endswith(f".{MEASURED}")}


def _package_commands(
    rows: Mapping[str, Sequence[float]], known: Mapping[str, Variable], step: float, folder: Path, external_tool: bool
) -> Part:
    variables = [
        Variable(
            name,
            index,
            "output",
            known[name].start,
            f"Command: {known[name].description}",
            known[name].unit,
            known[name].variability,
        )
        for index, name in enumerate(rows)
    ]
    description = Description(
        name=COMMANDS,
        text="Commands over time",
        step_size=step,
        version=__version__,
        generated=generation_date(),
        capabilities={"needsExecutionTool": external_tool},
    )
    given = json.dumps({"step": step, "rows": list(zip(*rows.values(), strict=True))}).encode()
    sources = (fmu_sources() / "commands_slave.py", PACKAGE)
    shown = accompanying(description, variables)
    path = write_python_fmu(folder, description, variables, sources, {"commands.json": given}, shown)
    return Part(COMMANDS, path, by_name(variables))


def _connections(
    commands: Collection[str], compensation: Mapping[str, Variable], plant: Mapping[str, Variable]
) -> Iterator[tuple[str, str, str, str]]:
    """Yield all connections: what the plant knows of an axis, and what the commands say."""
    axes = [name.removesuffix(".corrected_setpoint") for name in compensation if name.endswith(".corrected_setpoint")]
    missing = ", ".join(axis for axis in axes if f"{axis}.setpoint" not in plant)
    if missing:
        raise BuildError(f"The plant has no axis {missing}.")
    for name in commands:
        yield COMMANDS, name, COMPENSATION, name
        if name in plant and compensation[name].axis is None:  # the length of the tool
            yield COMMANDS, name, PLANT, name
    for axis in axes:
        yield COMPENSATION, f"{axis}.corrected_setpoint", PLANT, f"{axis}.setpoint"
        if f"{axis}.current" in compensation:
            yield COMPENSATION, f"{axis}.current", PLANT, f"{axis}.current"
        if f"{axis}.setpoint" in commands and f"{axis}.commanded_position" in plant:
            yield COMMANDS, f"{axis}.setpoint", PLANT, f"{axis}.commanded_position"
        yield PLANT, f"{axis}.measured_position", COMPENSATION, f"{axis}.{MEASURED}"


def _tag(kind: str, name: str) -> str:
    register_namespace(kind, NAMESPACES[kind])
    return f"{{{NAMESPACES[kind]}}}{name}"


def _structure(parts: Sequence[Part], connections: Connections, duration: float) -> bytes:
    root = Element(_tag("ssd", "SystemStructureDescription"), version="1.0", name="machine", generationTool="axcomp")
    system = SubElement(root, _tag("ssd", "System"), name="machine")
    bindings = SubElement(system, _tag("ssd", "ParameterBindings"))
    SubElement(bindings, _tag("ssd", "ParameterBinding"), source=PARAMETERS)
    elements = SubElement(system, _tag("ssd", "Elements"))
    units = set()
    for part in parts:
        source = f"resources/{part.path.name}"
        component = SubElement(elements, _tag("ssd", "Component"), name=part.name, source=source)
        listed = SubElement(component, _tag("ssd", "Connectors"))
        ends = [(name, "output") for start, name, _, _ in connections if start == part.name]
        ends += [(name, "input") for _, _, end, name in connections if end == part.name]
        for name, kind in dict.fromkeys(ends):
            variable = part.variables[name]
            units.add(variable.unit)
            connector = SubElement(listed, _tag("ssd", "Connector"), name=name, kind=kind)
            unit = {"unit": variable.unit} if variable.unit else {}
            SubElement(connector, _tag("ssc", variable.type), unit)
    wires = SubElement(system, _tag("ssd", "Connections"))
    for start, given, end, taken in connections:
        ends_of = {"startElement": start, "startConnector": given, "endElement": end, "endConnector": taken}
        SubElement(wires, _tag("ssd", "Connection"), ends_of)
    _add_units(root, "ssd", units)
    SubElement(root, _tag("ssd", "DefaultExperiment"), startTime="0.0", stopTime=repr(duration))
    return document(root)


def _parameters(rows: Mapping[str, Sequence[float]], parts: Sequence[Part], cycle_time: float) -> bytes:
    """Return the parameter file: the machine stands where the commands begin."""
    known = {part.name: part.variables for part in parts}
    values: dict[str, Variable] = {}
    given: dict[str, float] = {}
    for name, column in rows.items():
        axis, _, quantity = name.rpartition(".")
        places = [(COMPENSATION, name), (PLANT, name)]
        if quantity == "setpoint":
            places += [(COMPENSATION, f"{axis}.{MEASURED}"), (PLANT, f"{axis}.commanded_position")]
        for part, place in places:
            if place in known[part]:
                values[f"{part}.{place}"], given[f"{part}.{place}"] = known[part][place], column[0]
    name = f"{COMPENSATION}.cycle_time"
    values[name], given[name] = known[COMPENSATION]["cycle_time"], cycle_time
    root = Element(_tag("ssv", "ParameterSet"), version="1.0", name="parameters")
    parent = SubElement(root, _tag("ssv", "Parameters"))
    for name, variable in values.items():
        value = int(given[name]) if variable.type != "Real" else float(given[name])
        node = SubElement(SubElement(parent, _tag("ssv", "Parameter"), name=name), _tag("ssv", variable.type))
        node.set("value", str(bool(value)).lower() if variable.type == "Boolean" else repr(value))
        if variable.unit:
            node.set("unit", variable.unit)
    _add_units(root, "ssv", {variable.unit for variable in values.values()})
    return document(root)


def _add_units(root: Element, kind: str, used: Collection[str]) -> None:
    """Add the definitions of units, which are those of FMI under other names."""
    plain = Element("root")
    add_units(plain, used)
    units = SubElement(root, _tag(kind, "Units"))
    for unit in plain[0]:
        node = SubElement(units, _tag("ssc", "Unit"), unit.attrib)
        SubElement(node, _tag("ssc", "BaseUnit"), unit[0].attrib)
