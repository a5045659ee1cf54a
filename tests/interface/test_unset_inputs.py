"""A host that forgets to connect an input, or connects a 0 to it, changes nothing."""

from __future__ import annotations

import numpy as np
import pytest

from axcomp.engine import Engine, read_input
from axcomp.interface import by_name, variables_of, whole, with_causality
from axcomp.lists import read_machine
from axcomp.model import models

MODELS = sorted(path.parent.name for path in models().glob("*/expected.csv"))


@pytest.mark.parametrize("name", MODELS)
def test_every_input_starts_with_0_or_false(name: str) -> None:
    machine = read_machine(models() / name).machine
    assert {v.name: v.start for v in with_causality(variables_of(machine), "input") if v.start != 0} == {}


@pytest.mark.parametrize("kernel", ["compiled", "python"])
@pytest.mark.parametrize("name", MODELS)
def test_inputs_that_are_set_to_0_give_the_bits_of_inputs_that_are_not_set(
    name: str, kernel: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    if kernel == "python":
        monkeypatch.setattr("axcomp.engine.engine.compiled_kernel", lambda: None)
    columns = {k: v[:300] for k, v in read_input(models() / name / "input.csv").columns.items()}
    moving = {k: v for k, v in columns.items() if k.rpartition(".")[2] in ("setpoint", "velocity", "acceleration")}
    unset = Engine(models() / name).run({**moving, **_ahead_not_known(name)})
    engine = Engine(models() / name)
    inputs = with_causality(engine.variables, "input")
    zeros = engine.run({v.name: moving.get(v.name, np.zeros(300)) for v in inputs})
    for output, values in unset.items():
        assert values.tobytes() == zeros[output].tobytes(), output
    assert any(values.any() for output, values in unset.items() if output.endswith(".active"))


def _ahead_not_known(name: str) -> dict[str, np.ndarray]:
    """Keep the engine from filling in what comes after a cycle."""
    names = by_name(variables_of(read_machine(models() / name).machine))
    return {n: np.zeros(300, bool) for n in names if n.endswith("ahead_known")}


@pytest.mark.parametrize(
    ("value", "expected"),
    [(0.0, 0), (1.0, 1), (-1.0, -1), (0.4, 0), (-0.6, -1), (7.0, 7), (float("nan"), 2**31 - 1), (1e300, 2**31 - 1)],
)
def test_a_number_becomes_the_nearest_integer_or_one_that_commands_nothing(value: float, expected: int) -> None:
    assert whole(value) == expected
