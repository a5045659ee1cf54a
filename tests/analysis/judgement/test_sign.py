"""The sign of tables, judged by measurements on the example plant, which shares no code with the tables."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from judging import THREE_AXIS, codes, example, judge, leadscrew_machine, measured, said

from axcomp.analysis.judgement import sign_of
from axcomp.conversion import tables_of
from axcomp.kinds import Cross, Leadscrew
from axcomp.lists import read_machine
from axcomp.measurement import Positioning
from axcomp.model import Axis, AxisType, Machine


def changed(axis: str, **fields) -> Machine:
    axes = [replace(one, **fields) if one.name == axis else one for one in example().axes]
    return Machine(tuple(axes))


def negated(values):
    return tuple(-value for value in values)


@pytest.mark.parametrize(("axis", "over"), [("X", None), ("Y", None), ("Z", None), ("Z", "X")])
def test_the_examples_tables_shrink_the_error_that_the_plant_shows(axis: str, over: str | None) -> None:
    result = sign_of(example(), measured(axis, over), axis, over or axis)
    assert result.verdict == "as written"
    assert result.error("as written") < 0.12 * result.error("without")
    assert result.gain == pytest.approx(1.0, abs=0.03)
    judgement = judge(example(), read_machine(THREE_AXIS), measurements=[(measured(axis, over), axis, over or axis)])
    message = said(judgement, "AXC-SIGN")
    assert f"shrinks from {result.error('without'):.2f} µm to {result.error('as written'):.2f} µm" in message
    [finding] = [finding for finding in judgement.findings if finding.code == "AXC-SIGN"]
    assert finding.file.endswith({"X": "achskw1.lis", "Y": "achskw2.lis", "Z": "achskw3.lis"}[axis])
    line = Path(finding.file).read_text(encoding="utf-8").split("\n")[finding.line - 1]
    assert line.split()[0] == finding.parameter


@pytest.mark.parametrize("axis", ["X", "Y", "Z"])
def test_an_inverted_table_is_named_with_both_figures(axis: str) -> None:
    screw = example().axis(axis).leadscrew
    assert screw is not None
    negative = None if screw.negative is None else negated(screw.negative)
    machine = changed(axis, leadscrew=replace(screw, positive=negated(screw.positive), negative=negative))
    result = sign_of(machine, measured(axis), axis, axis)
    right = sign_of(example(), measured(axis), axis, axis)
    assert result.gain == pytest.approx(-right.gain)
    assert result.error("opposite sign") == pytest.approx(right.error("as written"))
    assert result.error("as written") > 1.8 * result.error("without")
    message = said(judge(machine, measurements=[(measured(axis), axis, axis)]), "AXC-SIGN-INVERTED")
    assert f"from {result.error('without'):.2f} µm to {result.error('as written'):.2f} µm" in message
    assert f"to {right.error('as written'):.2f} µm: the table looks inverted" in message


def test_an_inverted_cross_table_is_named() -> None:
    cross = example().axis("Z").cross
    assert cross is not None
    machine = changed("Z", cross=replace(cross, corrections=negated(cross.corrections)))
    assert codes(machine, measurements=[(measured("Z", "X"), "Z", "X")]) == ["AXC-SIGN-INVERTED"]


def test_interchanged_directions_are_named() -> None:
    screw = Leadscrew((0.0, 100.0, 200.0), (0.01, 0.012, 0.009), (0.0, 0.001, -0.002))
    machine = Machine((Axis(1, "X", leadscrew=screw),))
    places = np.tile([0.0, 50.0, 100.0, 150.0, 200.0], 2)
    directions = np.repeat([1, -1], 5)
    curves = {1: screw.negative, -1: screw.positive}
    deviations = np.array(
        [1e3 * np.interp(x, screw.positions, curves[d]) for x, d in zip(places, directions, strict=True)]
    )
    measurement = Positioning(places, np.ones(10, dtype=int), directions, deviations, axis="X")
    message = said(judge(machine, measurements=[(measurement, "X", "X")]), "AXC-SIGN-SWAPPED")
    # E by hand: without 14 µm (12 − (−2)), with the wrong directions 24 (from −12 to 12 about), interchanged 0.
    assert "from 14.00 µm to 22.00 µm, with the directions interchanged to 0.00 µm" in message


def test_a_measurement_with_the_compensation_on_is_not_taken_for_an_inverted_table() -> None:
    table = tables_of(example(), "Y", "leadscrew")[0]
    raw = measured("Y")
    on = raw.with_deviations(raw.deviations + 1e3 * np.array(table.at(raw.targets)))
    message = said(judge(example(), measurements=[(on, "Y", "Y")]), "AXC-SIGN-NO-HELP")
    assert "was the compensation on" in message


def test_a_table_in_another_unit_is_told_by_the_factor_that_fits() -> None:
    x = np.linspace(0.0, 100.0, 11)
    machine = leadscrew_machine(x, 10.0 * 1e-4 * x)
    measurement = Positioning(x, np.ones(11, dtype=int), np.ones(11, dtype=int), 0.1 * x, axis="X")
    message = said(judge(machine, measurements=[(measurement, "X", "X")]), "AXC-SIGN-NO-HELP")
    assert "E↑ goes from 10.00 µm to 90.00 µm" in message
    assert "fits best is 0.10" in message


@pytest.mark.parametrize(
    ("axis", "over", "unit", "sentence"),
    [
        ("Q", "Q", "mm", "there is no axis 'Q'"),
        ("X", "X", "deg", "it is in deg, the leadscrew table of X in mm"),
        ("X", "Y", "mm", "no cross compensation of axis X"),
        ("Z", "Y", "mm", "is over X, not over Y"),
    ],
)
def test_a_measurement_of_something_else_is_refused_in_a_sentence(axis, over, unit, sentence) -> None:
    with pytest.raises(ValueError, match=sentence):
        sign_of(example(), replace(measured("X"), unit=unit), axis, over)


def cross_over_c() -> tuple[Machine, Positioning]:
    """Return Z with a table over a rotary axis C, and what was measured of it: positions in °, deviations in µm."""
    cross = Cross(2, (0.0, 90.0, 180.0), (0.0, 0.010, 0.004))
    machine = Machine((Axis(1, "Z", cross=cross), Axis(2, "C", AxisType.ROTARY)))
    x = np.array([0.0, 45.0, 90.0, 180.0])
    ones = np.ones(4, dtype=int)
    deviations = np.array([0.0, -5.0, -10.0, -4.0])
    return machine, Positioning(x, ones, ones, deviations, "deg", "Z", deviating_unit="mm", source="z.csv")


def test_a_linear_axis_over_a_rotary_one_is_judged_in_the_units_of_each() -> None:
    machine, measurement = cross_over_c()
    result = sign_of(machine, measurement, "Z", "C")
    assert result.verdict == "as written"
    assert (result.error("without"), result.error("as written")) == pytest.approx((10.0, 0.0))


@pytest.mark.parametrize(
    ("unit", "deviating", "shown"),
    [("deg", "deg", "deg"), ("deg", None, "deg"), ("mm", "mm", "mm"), ("mm", "deg", "mm and deg")],
)
def test_a_measurement_with_one_of_its_two_units_wrong_is_refused(unit: str, deviating: str, shown: str) -> None:
    machine, measurement = cross_over_c()
    with pytest.raises(ValueError, match=f"^z.csv: it is in {shown}, the cross table of Z over C in deg and mm$"):
        sign_of(machine, replace(measurement, unit=unit, deviating_unit=deviating), "Z", "C")


def test_the_picture_shows_both_states() -> None:
    ax = sign_of(example(), measured("X"), "X", "X").plot()
    assert [text.get_text() for text in ax.get_legend().get_texts()] == [
        "without ↑",
        "without ↓",
        "with the table ↑",
        "with the table ↓",
    ]
    assert ax.get_xlabel() == "target position [mm]"
