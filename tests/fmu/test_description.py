from __future__ import annotations

from xml.etree import ElementTree

import pytest
from fmu_machines import three_axes
from frozen import DEPENDENCIES, UNITS, VARIABLES, VOLUMETRIC_DEPENDENCIES, every_variable, two_axes

from axcomp.fmu import Description, model_description
from axcomp.interface import variables_of
from axcomp.model import Machine

DESCRIPTION = Description("axcomp", 'Corrects "X" & <Y>', 0.002, "1.2.3", capabilities={"needsExecutionTool": True})


def described(machine: Machine) -> ElementTree.Element:
    return ElementTree.fromstring(model_description(DESCRIPTION, variables_of(machine), "{guid}"))


@pytest.fixture
def root() -> ElementTree.Element:
    return described(three_axes())


def test_the_default_experiment_steps_by_the_cycle_time(root: ElementTree.Element) -> None:
    experiment = root.find("DefaultExperiment")
    assert experiment is not None
    assert experiment.attrib == {"startTime": "0.0", "stopTime": "2.0", "stepSize": "0.002"}


def test_units_lead_to_si(root: ElementTree.Element) -> None:
    found = {unit.get("name"): dict(base.attrib) for unit in root.iter("Unit") for base in unit}
    assert found == UNITS
    assert {real.get("unit") for real in root.iter("Real")} - {None} == set(found)


def test_variables_are_the_ones_hosts_know() -> None:
    found = {}
    for variable in described(every_variable()).iter("ScalarVariable"):
        known, (kind,) = variable.attrib, variable
        found[known["name"]] = (
            int(known["valueReference"]),
            kind.tag,
            known["causality"],
            known["variability"],
            kind.get("unit"),
            kind.get("start"),
        )
    assert {name: row for name, row in found.items() if name[:2] not in ("Y.", "Z.")} == VARIABLES
    assert {name[2:] for name in found if name[:2] == "Y."} == {name[2:] for name in found if name[:2] == "Z."}


def dependencies(machine: Machine, section: str) -> dict[str, set[str]]:
    root = described(machine)
    names = [variable.attrib["name"] for variable in root.iter("ScalarVariable")]
    return {
        names[int(unknown.attrib["index"]) - 1]: {names[int(k) - 1] for k in unknown.attrib["dependencies"].split()}
        for unknown in root.findall(f"ModelStructure/{section}/Unknown")
    }


@pytest.mark.parametrize("section", ["Outputs", "InitialUnknowns"])
def test_outputs_depend_on_the_inputs_they_are_computed_from(section: str) -> None:
    assert dependencies(two_axes(), section) == {name: set(text.split()) for name, text in DEPENDENCIES.items()}
    found = dependencies(every_variable(), section)
    expected = {name: set(text.split()) for name, text in VOLUMETRIC_DEPENDENCIES.items()}
    assert {name: found[name] for name in expected} == expected


def test_every_output_is_an_initial_unknown_with_its_dependencies(root: ElementTree.Element) -> None:
    variables = list(root.iter("ScalarVariable"))
    outputs = [str(i) for i, variable in enumerate(variables, start=1) if variable.get("causality") == "output"]
    for section in ("Outputs", "InitialUnknowns"):
        unknowns = root.findall(f"ModelStructure/{section}/Unknown")
        assert [unknown.get("index") for unknown in unknowns] == outputs
        for unknown in unknowns:
            for index in unknown.attrib["dependencies"].split():
                assert variables[int(index) - 1].get("causality") == "input"


def test_only_what_is_set_has_a_start_value(root: ElementTree.Element) -> None:
    for variable in root.iter("ScalarVariable"):
        assert ("start" in variable[0].attrib) == (variable.get("causality") != "output")
        assert variable.get("variability") != "continuous" or variable[0].tag == "Real"


def test_capabilities_and_date(root: ElementTree.Element) -> None:
    interface = root.find("CoSimulation")
    assert interface is not None
    for name in ("canHandleVariableCommunicationStepSize", "canGetAndSetFMUstate", "canSerializeFMUstate"):
        assert interface.get(name) == "true"
    assert interface.get("needsExecutionTool") == "true"
    assert root.get("generationDateAndTime", "").endswith("Z")
    assert root.get("description") == 'Corrects "X" & <Y>'
