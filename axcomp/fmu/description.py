"""modelDescription.xml of FMI 2.0 for co-simulation, from a list of variables."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from ..interface import Value, Variable, with_causality

MILLI = 1e-3
DEGREE = math.pi / 180.0

UNITS: dict[str, dict[str, float]] = {
    "s": {"s": 1},
    "mm": {"m": 1, "factor": MILLI},
    "mm/s": {"m": 1, "s": -1, "factor": MILLI},
    "mm/s2": {"m": 1, "s": -2, "factor": MILLI},
    "deg": {"rad": 1, "factor": DEGREE},
    "deg/s": {"rad": 1, "s": -1, "factor": DEGREE},
    "deg/s2": {"rad": 1, "s": -2, "factor": DEGREE},
    "mA": {"A": 1, "factor": MILLI},
}
"""Units of variables: exponents of the SI base units, and the factor to them."""

QUANTITIES = {
    "s": "Time",
    "mm": "Length",
    "mm/s": "Velocity",
    "mm/s2": "Acceleration",
    "deg": "Angle",
    "deg/s": "AngularVelocity",
    "deg/s2": "AngularAcceleration",
    "mA": "ElectricCurrent",
}
"""Unit → name of what is measured in it. The current of a friction compensation is in the drive's unit, which no list
tells (P-COMP-00047): it has this name and no unit."""

LOG_CATEGORIES = {
    "logStatusWarning": "A list was not taken as it is written, or an unusual call",
    "logStatusError": "Something does not act, or a call could not be carried out",
    "logAll": "Everything else",
}


AUTHOR = "the axcomp authors"
"""Of libraries, sources and description; the tables are the machine's."""

STEPS = 1000
"""Steps of the default experiment: FMPy doubles the step size until there are no more than these."""


@dataclass(frozen=True)
class Description:
    """What an FMU says about itself, apart from its variables.

    ``name`` is that of the model and of its binaries, ``text`` a sentence about it, ``step_size`` the recommended
    communication step in s, ``version`` that of the software it comes from, ``naming`` ``structured`` or ``flat``,
    ``generated`` date and time in ISO 8601 ending in ``Z``. ``capabilities`` are further attributes of
    ``CoSimulation``, ``source_files`` those in ``sources`` to compile; none: it comes without sources.
    """

    name: str
    text: str
    step_size: float
    version: str
    naming: str = "structured"
    generated: str = "2000-01-01T00:00:00Z"
    capabilities: Mapping[str, bool] = field(default_factory=dict)
    source_files: Sequence[str] = ()

    @property
    def tool(self) -> str:
        """What made the FMU."""
        return f"axcomp {self.version}"

    def root(self, fmi: str, **token: str) -> Element:
        """Return the root of a modelDescription.xml; ``token``: the attribute that tells one FMU from another."""
        attributes = {
            "fmiVersion": fmi,
            "modelName": self.name,
            **token,
            "description": self.text,
            "author": AUTHOR,
            "version": self.version,
            "copyright": f"Copyright {AUTHOR}",
            "license": "MIT",
            "generationTool": self.tool,
            "generationDateAndTime": self.generated,
            "variableNamingConvention": self.naming,
        }
        return Element("fmiModelDescription", attributes)


CAPABILITIES = {
    "canHandleVariableCommunicationStepSize": True,
    "canGetAndSetFMUstate": True,
    "canSerializeFMUstate": True,
    "canNotUseMemoryManagementFunctions": True,
}


def model_description(description: Description, variables: Sequence[Variable], guid: str) -> bytes:
    """Return modelDescription.xml, the same bytes for the same arguments."""
    root = description.root("2.0", guid=guid)
    capabilities = {name: text_of(value) for name, value in {**CAPABILITIES, **description.capabilities}.items()}
    co_simulation = SubElement(root, "CoSimulation", {"modelIdentifier": description.name, **capabilities})
    if description.source_files:
        sources = SubElement(co_simulation, "SourceFiles")
        for name in description.source_files:
            SubElement(sources, "File", name=name)
    add_units(root, {variable.unit for variable in variables})
    add_log_categories(root)
    add_experiment(root, description.step_size)
    _add_variables(root, variables)
    _add_structure(root, variables)
    return document(root)


def document(root: Element) -> bytes:
    """Return an XML file."""
    ElementTree.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, encoding="unicode")}\n'.encode()


def add_log_categories(root: Element) -> None:
    """Add the categories of messages."""
    categories = SubElement(root, "LogCategories")
    for name, text in LOG_CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=text)


def add_experiment(root: Element, step_size: float) -> None:
    """Add the default experiment."""
    times = {"startTime": "0.0", "stopTime": text_of(STEPS * step_size), "stepSize": text_of(step_size)}
    SubElement(root, "DefaultExperiment", times)


def quantity_of(variable: Variable) -> str | None:
    """Return the name of what is measured in the variable's unit."""
    return QUANTITIES.get(variable.unit, "ElectricCurrent" if variable.quantity == "current" else None)


def add_units(root: Element, used: Collection[str]) -> None:
    """Add the definitions of those units that are used."""
    definitions = SubElement(root, "UnitDefinitions")
    for name, base in UNITS.items():
        if name in used:
            unit = SubElement(definitions, "Unit", name=name)
            SubElement(unit, "BaseUnit", {key: text_of(value) for key, value in base.items()})


def _add_variables(root: Element, variables: Sequence[Variable]) -> None:
    parent = SubElement(root, "ModelVariables")
    for variable in variables:
        output = variable.causality == "output"
        node = SubElement(
            parent,
            "ScalarVariable",
            name=variable.name,
            valueReference=str(variable.reference),
            description=variable.description,
            causality=variable.causality,
            variability=variable.variability,
        )
        if variable.causality != "input":
            node.set("initial", "calculated" if output else "exact")
        kind = SubElement(node, variable.type)
        attributes: dict[str, float | str | None] = {"quantity": quantity_of(variable), "unit": variable.unit or None}
        if variable.limits is not None:
            attributes["min"], attributes["max"] = variable.limits
        if variable.type == "Real":
            attributes["nominal"] = variable.nominal
        for name, value in attributes.items():
            if value is not None:
                kind.set(name, text_of(value))
        if not output:
            kind.set("start", text_of(variable.start))


def _add_structure(root: Element, variables: Sequence[Variable]) -> None:
    """Add the outputs with their dependencies; all of them are computed at the end of initialization too."""
    index = {variable.name: str(number) for number, variable in enumerate(variables, start=1)}
    structure = SubElement(root, "ModelStructure")
    for section in ("Outputs", "InitialUnknowns"):
        outputs = with_causality(variables, "output")
        if not outputs:
            continue
        parent = SubElement(structure, section)
        for variable in outputs:
            unknown = SubElement(parent, "Unknown", index=index[variable.name])
            if variable.depends_on is not None:
                unknown.set("dependencies", " ".join(index[name] for name in variable.depends_on))


def text_of(value: Value) -> str:
    """Write a value so that reading it gives the same one."""
    return str(value).lower() if isinstance(value, bool) else value if isinstance(value, str) else repr(value)
