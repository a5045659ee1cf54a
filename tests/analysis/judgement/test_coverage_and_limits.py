"""What an input file uses of the tables, and volumetric corrections against their limits."""

from dataclasses import replace

import numpy as np
import pytest
from judging import codes, cross_machine, example, judge, plane_machine, said, table_of_c

from axcomp.analysis.judgement import largest_corrections
from axcomp.engine import Engine, read_input
from axcomp.kinds import CrosstalkCurve
from axcomp.lists import read_machine
from axcomp.model import Axis, AxisType, ErrorTable, Machine, ModuloRange, Volumetric, models


def test_positions_outside_are_named_with_distance_and_share() -> None:
    machine = cross_machine((0.0, 50.0, 100.0), (0.0, 0.01, 0.0))
    used = np.array([-20.0, 0.0, 50.0, 105.0])
    message = said(judge(machine, trajectory={"Y.setpoint": used}), "AXC-COVERAGE")
    assert message == (
        "Y goes from -20 to 105 mm, the cross table of X over Y from 0 to 100: up to 20 mm below and 5 mm above, and "
        "in 50 % of the rows its end value is held."
    )


@pytest.mark.parametrize("name", ["Y.setpoint", "Y_setpoint"])
def test_the_ends_belong_to_the_table(name: str) -> None:
    machine = cross_machine((0.0, 100.0), (0.0, 0.01))
    judgement = judge(machine, trajectory={name: np.array([0.0, 100.0])})
    assert judgement.findings == ()
    assert [(one.used, one.outside) for one in judgement.coverage] == [((0.0, 100.0), 0.0)]


def test_planes_accelerations_and_volumes_are_covered_too() -> None:
    plane = plane_machine(np.zeros((3, 3)))
    assert codes(plane, trajectory={"Y.setpoint": np.array([21.0]), "Z.setpoint": np.array([40.0])}) == ["AXC-COVERAGE"]
    crosstalk = Machine(
        (Axis(1, "X", crosstalk=CrosstalkCurve(2, (-900.0, 0.0, 900.0), (-0.1, 0.0, 0.1))), Axis(2, "Y"))
    )
    fast = {"Y.setpoint": np.zeros(2), "Y.acceleration": np.array([0.0, 1000.0])}
    assert "the crosstalk table of X from -900 to 900: up to 100 mm/s² above" in said(
        judge(crosstalk, trajectory=fast), "AXC-COVERAGE"
    )
    volume = judge(volumetric_machine(), trajectory={"X.setpoint": np.array([0.0, 150.0])})
    assert "volumetric compensation 0 (EXX) from -100 to 100: up to 50 mm above" in said(volume, "AXC-COVERAGE")


def test_a_modulo_table_covers_everything() -> None:
    machine = table_of_c((0.0, 90.0, 180.0), (0.0, 0.0, 0.0))
    assert codes(machine, trajectory={"C.setpoint": np.array([300.0])}) == []


def rotary_volume(nodes: tuple[float, ...]) -> Machine:
    axes = (*(Axis(n, letter) for n, letter in enumerate("XYZ", 1)), Axis(4, "C", AxisType.ROTARY, ModuloRange()))
    table = ErrorTable("EXC", (0.01,) * len(nodes), "C", tuple((node,) for node in nodes))
    letters = tuple((axis.name, axis.number) for axis in axes)
    return Machine(axes, (Volumetric(0, letters, "CXYZ", errors=(table,)),))


def test_an_axis_that_counts_modulo_may_leave_a_volumetric_table_in_its_gap_only() -> None:
    used = {"C.setpoint": np.array([350.0, 450.0, 400.0, 180.0])}
    message = said(judge(rotary_volume((-90.0, 0.0, 90.0)), trajectory=used), "AXC-COVERAGE")
    assert "(EXC) from -90 to 90" in message
    assert "in 25 % of the rows" in message
    assert codes(rotary_volume((-170.0, 0.0, 190.0)), trajectory=used) == []


def test_the_examples_input_is_covered() -> None:
    given = read_input(models() / "three_axis" / "input.csv")
    judgement = judge(example(), trajectory=given.columns)
    assert judgement.findings == ()
    assert {one.table for one in judgement.coverage} >= {"the leadscrew table of X", "the crosstalk table of Z"}


def volumetric_machine(limit: float | None = 1.0, **more) -> Machine:
    errors = (ErrorTable("EXX", (0.3, 0.0, -0.9), "X", ((-100.0,), (0.0,), (100.0,))),)
    axes = tuple(Axis(number, name, volumetric_limit=limit) for number, name in ((1, "X"), (2, "Y"), (3, "Z")))
    return Machine(axes, (Volumetric(0, (("X", 1), ("Y", 2), ("Z", 3)), errors=errors, **more),))


@pytest.mark.parametrize(
    ("limit", "expected"), [(0.8, ["AXC-LIMIT-EXCEEDED"]), (1.0, ["AXC-LIMIT-NEAR"]), (1.2, []), (None, [])]
)
def test_the_largest_correction_is_compared_with_s_limit(limit: float | None, expected: list[str]) -> None:
    machine = volumetric_machine(limit)
    assert codes(machine) == expected
    x = next(largest_corrections(machine))
    assert (x.axis.name, x.position["X"]) == ("X", 100.0)
    assert x.correction == pytest.approx(0.9, abs=1e-9)


def test_the_message_has_the_figures_and_the_engine_agrees() -> None:
    message = said(judge(volumetric_machine(0.75)), "AXC-LIMIT-EXCEEDED")
    assert "moves X by 0.9000 mm at X = 100, Y = 0, Z = 0, 120 % of its s_limit of 0.75 mm" in message
    for limit, error in ((0.8, True), (1.0, False)):
        engine = Engine(volumetric_machine(limit))
        assert bool(engine.step({"X.setpoint": 100.0})["X.error"]) == error


def test_gantry_slaves_negation_and_axes_left_out() -> None:
    machine = volumetric_machine(negate="X", set_to_zero="Y")
    slave = Axis(9, "X2", volumetric_limit=0.5, gantry_master=1)
    found = {one.axis.name: one for one in largest_corrections(replace(machine, axes=(*machine.axes, slave)))}
    assert set(found) == {"X", "Z", "X2"}
    assert found["X2"].correction == found["X"].correction == pytest.approx(-0.9, abs=1e-9)


@pytest.mark.slow
def test_no_random_position_of_the_five_axis_machine_is_corrected_more() -> None:
    machine = read_machine(models() / "five_axis").machine
    largest: dict[str, float] = {}
    for one in largest_corrections(machine):
        largest[one.axis.name] = largest.get(one.axis.name, 0.0) + abs(one.correction)
    random = np.random.default_rng(3)
    rows = 400
    spans = {"X": (-300, 300), "Y": (-250, 250), "Z": (-400, 0), "B": (-100, 100), "C": (0, 360)}
    result = Engine(machine).run({f"{name}.setpoint": random.uniform(*span, rows) for name, span in spans.items()})
    for name in "XYZ":
        assert np.abs(result[f"{name}.volumetric.correction"]).max() <= 1.02 * largest[name]


def test_places_of_rotary_axes_with_range_are_in_degrees() -> None:
    turn = (0.0, 90.0, 180.0)
    machine = volumetric_machine()
    errors = (ErrorTable("EXC", (0.0, 0.5, 0.0), "C", tuple((c,) for c in turn)),)
    axes = (*machine.axes, Axis(6, "C", AxisType.ROTARY))
    table = Volumetric(0, (("X", 1), ("Y", 2), ("Z", 3), ("C", 6)), "XYZC", errors=errors)
    x, *_ = largest_corrections(Machine(axes, (table,)))
    assert x.position == {"X": 0.0, "Y": 0.0, "Z": 0.0, "C": 90.0}
