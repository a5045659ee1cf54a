"""Uncertainty of the tool tip: Monte Carlo against linear propagation and against hand-computed cases."""

from dataclasses import replace

import numpy as np
import pytest

from axcomp import read_machine
from axcomp.analysis.budget import Uncertainty, budget_of, tcp_uncertainty
from axcomp.engine import InputFile, read_input
from axcomp.kinds import Leadscrew
from axcomp.model import Axis, AxisType, ErrorTable, Machine, Volumetric, models

XYZ = tuple(Axis(number, name, volumetric_limit=10.0) for number, name in ((1, "X"), (2, "Y"), (3, "Z")))
NODES = ((0.0,), (100.0,))
VOLUME = Volumetric(
    0, (("X", 1), ("Y", 2), ("Z", 3)), "YXZ", 0, (ErrorTable("EXX", (0.0, 0.01), "X", NODES),), filter_steps=0
)


def budget_at(*places, machine: Machine | None = None):
    columns = np.array(places, dtype=float).T
    path = InputFile({f"{axis}.setpoint": column for axis, column in zip("XYZ", columns, strict=True)})
    return budget_of(machine or Machine(XYZ, (VOLUME,)), path)


def test_lengths_come_through_as_they_are_and_angles_times_their_arm() -> None:
    budget = budget_at((0, 0, 0), (100, 200, -300))
    given = [Uncertainty("EXX", 1e-3, False, 0), Uncertainty("C0Y", 2e-6, False, 0)]
    found = tcp_uncertainty(budget, given, trials=2000)
    assert found.axes == ("X", "Y", "Z")
    expected = [[1.0, 0, 0], [np.hypot(1.0, 2e-6 * 200e3), 0, 0]]
    assert found.linear == pytest.approx(np.array(expected), abs=1e-6)
    assert found.standard == pytest.approx(np.array(expected), rel=0.03, abs=1e-6)


def test_nodes_of_their_own_count_less_between_them() -> None:
    """Half-way between two independent nodes: σ/√2; at a node: σ."""
    budget = budget_at((0, 0, 0), (50, 0, 0), (25, 0, 0))
    found = tcp_uncertainty(budget, [Uncertainty("EXX", 1e-3, True, 0)], trials=4000)
    expected = [1.0, np.sqrt(0.5), np.hypot(0.75, 0.25)]
    assert found.linear[:, 0] == pytest.approx(expected, rel=1e-6)
    assert found.standard[:, 0] == pytest.approx(expected, rel=0.03)


@pytest.mark.parametrize(("chain", "carried"), [("CXYZ", 1), ("XYZC", 3)])
def test_the_node_at_0_and_360_degrees_is_one_place_with_one_error(chain: str, carried: int) -> None:
    """EZC lifts the tip wherever C stands: σ at a node, σ · √(w² + (1 − w)²) between two, also at the seam."""
    turns = np.array([0.0, 45.0, 180.0, 337.5, 350.0, 359.0, 360.0, 382.5, -22.5])
    nodes = ((0.0,), (90.0,), (180.0,), (270.0,), (360.0,))
    table = ErrorTable("EZC", (0.01, 0.02, 0.0, 0.01, 0.01), "C", nodes)
    axes = (("X", 1), ("Y", 2), ("Z", 3), ("C", 6))
    volume = Volumetric(0, axes, chain, carried, (table,), filter_steps=0)
    machine = Machine((*XYZ, Axis(6, "C", AxisType.ROTARY)), (volume,))
    budget = budget_of(machine, InputFile({"C.setpoint": turns}))
    found = tcp_uncertainty(budget, [Uncertainty("EZC", 1e-3, True, 0)], trials=4000)
    share = np.mod(turns, 90.0) / 90.0
    expected = np.hypot(share, 1.0 - share)
    assert found.linear[:, 2] == pytest.approx(expected, rel=1e-6)
    assert found.standard[:, 2] == pytest.approx(expected, rel=0.04)


def test_the_radius_is_the_quantile_of_the_known_distribution() -> None:
    """Equal σ in three directions: the 95 % quantile of the chi distribution with 3 degrees is 2.7955 σ."""
    budget = budget_at((0, 0, 0), (1, 0, 0))
    given = [Uncertainty(name, 1e-3, False, 0) for name in ("EXX", "EYY", "EZZ")]
    assert tcp_uncertainty(budget, given, trials=8000).radius == pytest.approx([2.7955] * 2, rel=0.03)


def test_trials_agree_with_linear_propagation_on_a_five_axis_machine() -> None:
    machine = read_machine(models() / "five_axis").machine
    budget = budget_of(machine, read_input(models() / "five_axis" / "input.csv"), points=20)
    names = [("EXX", 0), ("EAX", 0), ("B0Z", 0), ("ECC", 1), ("EBB", 1), ("X0C", 1), ("A0C", 1)]
    given = [Uncertainty(n, 3e-6 if n[0] in "ABC" or n[1] in "ABC" else 1e-3, False, index) for n, index in names]
    found = tcp_uncertainty(budget, given, trials=600, places=5)
    assert found.standard == pytest.approx(found.linear, rel=0.08, abs=1e-3)
    assert found.sources.keys() == {f"volumetric[{index}] {name}" for name, index in names}


def test_tables_of_axes_move_the_tool_tip_too() -> None:
    screw = Leadscrew((0.0, 100.0), (0.0, 0.0))
    machine = Machine((replace(XYZ[0], leadscrew=screw), *XYZ[1:]), ())
    budget = budget_at((0, 0, 0), (50, 0, 0), machine=machine)
    given = [Uncertainty("X.leadscrew", 1e-3), Uncertainty("X.leadscrew", 1e-3, True)]
    found = tcp_uncertainty(budget, given, trials=3000)
    expected = [np.sqrt(2.0), np.sqrt(1.5)]
    assert found.linear[:, 0] == pytest.approx(expected)
    assert found.standard[:, 0] == pytest.approx(expected, rel=0.04)
    assert not found.standard[:, 1:].any()


def test_the_same_seed_gives_the_same_numbers() -> None:
    budget = budget_at((0, 0, 0), (100, 0, 0))
    given = [Uncertainty("EXX", 1e-3, False, 0)]
    one, again, other = (tcp_uncertainty(budget, given, seed=seed, trials=50) for seed in (1, 1, 2))
    assert np.array_equal(one.standard, again.standard)
    assert not np.array_equal(one.standard, other.standard)
