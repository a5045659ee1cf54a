"""modelDescription.xml of FMI 3.0 for co-simulation, from the variables that FMI 2.0 has too, and the tables."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement

from ..interface import TIME_REFERENCE, ArrayVariable, Value, Variable, by_name, with_causality
from .description import Description, add_experiment, add_log_categories, add_units, document, quantity_of, text_of

TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "String": "String"}
"""Type in FMI 2.0 → in FMI 3.0."""

CAPABILITIES = {
    "canHandleVariableCommunicationStepSize": True,
    "canGetAndSetFMUState": True,
    "canSerializeFMUState": True,
    "hasEventMode": True,
}


def model_description_3(
    description: Description, variables: Sequence[Variable], arrays: Sequence[ArrayVariable], token: str
) -> bytes:
    """Return modelDescription.xml, the same bytes for the same arguments."""
    root = description.root("3.0", instantiationToken=token)
    capabilities = {name: text_of(value) for name, value in CAPABILITIES.items()}
    SubElement(root, "CoSimulation", {"modelIdentifier": description.name, **capabilities})
    units = {variable.unit for variable in variables} | {array.unit for array in arrays}
    add_units(root, {"s", *units})
    add_log_categories(root)
    add_experiment(root, description.step_size)
    parent = SubElement(root, "ModelVariables")
    attributes = {"name": "time", "valueReference": str(TIME_REFERENCE), "description": "Simulation time"}
    SubElement(parent, "Float64", {**attributes, "causality": "independent", "variability": "continuous", "unit": "s"})
    for variable in variables:
        _add_variable(parent, variable)
    for array in arrays:
        _add_array(parent, array)
    _add_structure(root, variables)
    return document(root)


def _add_variable(parent: Element, variable: Variable) -> None:
    output = variable.causality == "output"
    node = SubElement(
        parent,
        TYPES[variable.type],
        name=variable.name,
        valueReference=str(variable.reference),
        description=variable.description,
        causality=variable.causality,
        variability=variable.variability,
    )
    if variable.causality != "input":
        node.set("initial", "calculated" if output else "exact")
    attributes: dict[str, Value | None] = {"quantity": quantity_of(variable), "unit": variable.unit or None}
    if variable.limits is not None:
        attributes["min"], attributes["max"] = variable.limits
    if variable.type == "Real":
        attributes["nominal"] = variable.nominal
    if not output and variable.type != "String":
        attributes["start"] = variable.start
    for name, value in attributes.items():
        if value is not None:
            node.set(name, text_of(value))
    if not output and variable.type == "String":
        SubElement(node, "Start", value=text_of(variable.start))


def _add_array(parent: Element, array: ArrayVariable) -> None:
    attributes = {"name": array.name, "valueReference": str(array.reference), "description": array.description}
    attributes |= {"causality": "parameter", "variability": "tunable", "initial": "exact"}
    if array.unit:
        attributes["unit"] = array.unit
    node = SubElement(parent, "Float64", {**attributes, "start": " ".join(map(repr, array.start))})
    for count in array.shape:
        SubElement(node, "Dimension", start=str(count))


def _add_structure(root: Element, variables: Sequence[Variable]) -> None:
    """Add the outputs with their dependencies; all of them are computed at the end of initialization too."""
    references = {name: str(variable.reference) for name, variable in by_name(variables).items()}
    structure = SubElement(root, "ModelStructure")
    for section in ("Output", "InitialUnknown"):
        for variable in with_causality(variables, "output"):
            unknown = SubElement(structure, section, valueReference=str(variable.reference))
            if variable.depends_on is not None:
                unknown.set("dependencies", " ".join(references[name] for name in variable.depends_on))
