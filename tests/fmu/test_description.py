from __future__ import annotations

from xml.etree import ElementTree

import pytest
from fmu_machines import three_axes

from axcomp.fmu.description import UNITS, Description, model_description
from axcomp.interface.variables import variables_of

DESCRIPTION = Description("axcomp", 'Corrects "X" & <Y>', 0.002, "1.2.3", capabilities={"needsExecutionTool": True})


@pytest.fixture
def root() -> ElementTree.Element:
    return ElementTree.fromstring(model_description(DESCRIPTION, variables_of(three_axes()), "{guid}"))


def test_the_default_experiment_steps_by_the_cycle_time(root: ElementTree.Element) -> None:
    experiment = root.find("DefaultExperiment")
    assert experiment is not None
    assert experiment.attrib == {"startTime": "0.0", "stopTime": "2.0", "stepSize": "0.002"}


def test_units_lead_to_si(root: ElementTree.Element) -> None:
    found = {unit.get("name"): dict(base.attrib) for unit in root.iter("Unit") for base in unit}
    assert found["mm/s2"] == {"m": "1", "s": "-2", "factor": "0.001"}
    assert found["deg"] == {"rad": "1", "factor": "0.017453292519943295"}
    assert {real.get("unit") for real in root.iter("Real")} - {None} == set(found)
    assert set(found) == set(UNITS) - {"mA"}


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
