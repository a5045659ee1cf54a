"""The C host measures what it says: every variable is set and read, and the figures are those of the libraries."""

from pathlib import Path

import pytest

from axcomp.bench import NativeHost, machine_of, plan_of
from axcomp.interface import variables_of
from axcomp.native import CompilerError, compiler_of, own_platform

MACHINE = machine_of(2, 10)


def test_the_plan_names_every_input_and_output_once() -> None:
    step, *lines = plan_of(MACHINE).splitlines()
    numbers = [[int(word) for word in line.split()] for line in lines]
    references = [n for line in numbers for n in line[1:]]
    wanted = [v for v in variables_of(MACHINE) if v.causality != "parameter" and v.name != "reload"]
    assert sorted(references) == sorted(v.reference for v in wanted)
    assert (float(step), [line[0] for line in numbers]) == (0.001, [len(line) - 1 for line in numbers])


def test_a_cycle_costs_something_in_every_way(tmp_path: Path) -> None:
    try:
        compiler_of(own_platform())
    except CompilerError as error:
        pytest.skip(str(error))
    host = NativeHost(tmp_path)
    for measure in (host.cycle, host.copying, host.kernel):
        values = measure(MACHINE, 3)
        assert len(values) == 3
        assert min(values) > 0.0
    with pytest.raises(RuntimeError, match="failed"):
        host._run("fmu", "nowhere", ".", "{}", str(tmp_path / "plan.txt"), "1")
