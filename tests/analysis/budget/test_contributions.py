"""Contributions against hand-computed tables and the first-order formula of the volumetric model."""

from dataclasses import replace

import numpy as np
import pytest

from axcomp import read_machine
from axcomp.analysis.budget import Budget, budget_of
from axcomp.engine import InputFile, read_input
from axcomp.kinds import Cross, Leadscrew
from axcomp.model import ERRORS, Axis, AxisType, ErrorTable, Machine, Volumetric, models

XYZ = tuple(Axis(number, name, volumetric_limit=10.0) for number, name in ((1, "X"), (2, "Y"), (3, "Z")))


def path_of(**positions) -> InputFile:
    return InputFile({f"{axis}.setpoint": np.asarray(values, dtype=float) for axis, values in positions.items()})


def volumetric_of(**errors: float) -> Volumetric:
    tables = tuple(ErrorTable(name, (errors[name],)) for name in ERRORS if name in errors)
    return Volumetric(
        0, (("X", 1), ("Y", 2), ("Z", 3)), "YXZ", 0, tables, filter_steps=0,
        tool_position=(1.0, 2.0, -3.0), tool_orientation=(0.0, 0.0, -1.0),
    )  # fmt: skip


def by_source(budget: Budget, axis: str) -> dict:
    return {c.source: c for c in budget.of_axis(axis)}


def test_axis_compensations_contribute_what_stands_in_their_tables() -> None:
    leadscrew = Leadscrew((0.0, 100.0), (0.0, 0.02), without_other_compensations=True)
    cross = Cross(2, (0.0, 10.0), (0.0, 0.005))
    machine = Machine((Axis(1, "X", leadscrew=leadscrew, cross=cross), Axis(2, "Y")))
    budget = budget_of(machine, path_of(X=[0, 25, 50, 100], Y=[0, 4, 4, 0]))
    found = by_source(budget, "X")
    assert list(found) == ["leadscrew", "cross"]
    assert found["leadscrew"].values == pytest.approx([0, -5, -10, -20])
    assert found["cross"].values == pytest.approx([0, 2, 2, 0])
    assert found["leadscrew"].max == pytest.approx(20.0)
    assert found["leadscrew"].rms == pytest.approx(np.sqrt((25 + 100 + 400) / 4))
    assert budget.totals["X"] == pytest.approx([0, -3, -8, -20])
    assert budget.worst("X") == 3
    assert budget.of_axis("Y") == ()
    assert budget.gap_to_engine("X") < 1e-12


def test_rotary_axes_are_in_seconds_of_arc() -> None:
    machine = Machine((Axis(4, "C", AxisType.ROTARY, leadscrew=Leadscrew((0.0, 90.0), (0.0, 0.009))),))
    budget = budget_of(machine, path_of(C=[0, 45]))
    assert budget.units["C"] == "″"
    assert by_source(budget, "C")["leadscrew"].values == pytest.approx([0, -16.2])


NO = (0, 0, 0, 0)


@pytest.mark.parametrize(
    ("name", "value", "effects"),
    [
        ("EXX", 0.010, ((1, 0, 0, 0), NO, NO)),
        ("EZY", 0.010, (NO, NO, (1, 0, 0, 0))),
        ("Y0Z", 0.010, (NO, (1, 0, 0, 0), NO)),
        ("C0Y", 1e-5, ((0, 0, -1, 0), NO, NO)),
        ("B0Z", 1e-5, ((0, 0, 0, 1), NO, NO)),
        ("C0X", 1e-5, (NO, (0, 1, 0, 0), NO)),
        ("ECY", 1e-5, ((-2, 0, 0, 0), (1, 1, 0, 0), NO)),
        ("EBX", 1e-5, ((-53, 0, 0, 1), NO, (-1, 0, 0, 0))),
        ("A0X", 1e-5, (NO, NO, NO)),
    ],
)
def test_one_error_contributes_minus_its_first_order_effect(name, value, effects) -> None:
    """Semantics §10: the first-order check, chain YXZ; P0 = (1, 2, −3), N0 = (0, 0, −1), tool length 50 mm.

    ``effects``: of the error on x, y and z, over 1, x, y and z.
    """
    rng = np.random.default_rng(3)
    places = rng.uniform(-300.0, 300.0, (7, 3))
    machine = Machine(XYZ, (volumetric_of(**{name: value}),))
    path = path_of(X=places[:, 0], Y=places[:, 1], Z=places[:, 2])
    budget = budget_of(machine, path, tool_length=50.0)
    expected = 1e3 * value * np.column_stack([np.ones(7), places]) @ np.array(effects).T
    for d, axis in enumerate("XYZ"):
        found = by_source(budget, axis)
        values = found[f"volumetric[0] {name}"].values if found else np.zeros(7)
        # Products of the error with itself: 600 mm · (1e-5)² = 6e-5 µm.
        assert values == pytest.approx(-expected[:, d], abs=1e-4)


def test_the_sum_of_all_is_their_joint_correction_but_for_products() -> None:
    machine = read_machine(models() / "five_axis").machine
    path = read_input(models() / "five_axis" / "input.csv")
    small = budget_of(machine, path, points=9)
    assert small.settled.sum() >= 5
    larger_errors = tuple(
        replace(v, errors=tuple(replace(t, values=tuple(10.0 * x for x in t.values)) for t in v.errors))
        for v in machine.volumetric
    )
    limits = tuple(replace(axis, volumetric_limit=10.0) for axis in machine.axes)
    large = budget_of(Machine(limits, larger_errors), path, points=9)
    for axis in "XYZ":
        assert small.gap_to_joint(axis) < 1e-3
        assert small.gap_to_engine(axis) < 1e-3
        # Ten times the errors, a hundred times the products.
        assert large.gap_to_joint(axis) / small.gap_to_joint(axis) == pytest.approx(100.0, rel=0.2)
        assert by_source(large, axis).keys() == by_source(small, axis).keys()


def test_negated_and_omitted_corrections_contribute_as_the_engine_adds_them() -> None:
    volumetric = replace(volumetric_of(EXX=0.01, EYY=0.02, EZZ=0.03), negate="X", set_to_zero="Y")
    budget = budget_of(Machine(XYZ, (volumetric,)), path_of(X=[0, 1], Y=[0, 0], Z=[0, 0]))
    assert by_source(budget, "X")["volumetric[0] EXX"].values == pytest.approx([10, 10])
    assert not budget.of_axis("Y")
    assert by_source(budget, "Z")["volumetric[0] EZZ"].values == pytest.approx([-30, -30])
    assert max(budget.gap_to_engine(axis) for axis in "XYZ") < 1e-9


def test_a_compensation_that_is_off_contributes_nothing_and_one_on_its_way_is_not_judged() -> None:
    volumetric = replace(volumetric_of(EXX=0.01), filter_steps=20)
    on = np.zeros(100)
    on[30:60] = -1
    path = InputFile({"X.setpoint": np.zeros(100), "volumetric[0].switch": on})
    budget = budget_of(Machine(XYZ, (volumetric,)), path, points=100)
    values = by_source(budget, "X")["volumetric[0] EXX"].values
    assert values[:30] == pytest.approx(np.full(30, -10.0))
    assert not values[51:60].any()
    assert budget.settled.sum() == pytest.approx(60, abs=3)
    assert not budget.settled[32:48].any()
    assert not budget.settled[62:78].any()
    assert budget.gap_to_engine("X") < 1e-9


def test_what_is_no_input_is_named() -> None:
    with pytest.raises(KeyError, match=r"Q\.setpoint is no input"):
        budget_of(models() / "three_axis", path_of(Q=[0, 1]))
