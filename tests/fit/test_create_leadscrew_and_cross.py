"""Leadscrew and cross tables made from measurements, and what they do on the example plant."""

import dataclasses
from functools import partial

import numpy as np
import pytest
from creating import copied_lists, measured, plant, positioning_of
from hypothesis import given, settings, strategies as st

from axcomp.engine import Engine
from axcomp.fit import LEFT_OUT, MEASURED, PREDICTED, CannotCreateError, Options, TargetList, create
from axcomp.lists import read_machine
from axcomp.measurement import MeasurementError, evaluate
from axcomp.model import Machine
from axcomp.plant import straightness

create_leadscrew, create_cross = (partial(create, kind) for kind in ("leadscrew", "cross"))
TARGETS = np.arange(-500.0, 501.0, 25.0)


@pytest.fixture
def lists(tmp_path):
    return copied_lists(tmp_path / "m")


def simulated(folder, axis, targets, kind):
    """Measure the plant again, its setpoints corrected by the engine with one kind of compensation of one axis."""
    machine = read_machine(folder, strict=True).machine
    kept = machine.axis(axis)
    alone = Machine(tuple(dataclasses.replace(a, cross=None, plane=None, crosstalk=None, leadscrew=None, friction=None)
                          for a in machine.axes))  # fmt: skip
    changed = dataclasses.replace(alone.axis(axis), **{kind: getattr(kept, kind)})
    engine = Engine(Machine(tuple(changed if a.name == axis else a for a in alone.axes)))
    index = plant().names.index(axis)
    curves = {}
    for direction in (1, -1):
        start = targets[0] - 1.0 if direction > 0 else targets[-1] + 1.0
        path = np.concatenate([[start], targets[::direction]])
        hold = 2 * kept.backlash_cycles + 2
        corrected = engine.run({f"{axis}.setpoint": np.repeat(path, hold)})[f"{axis}.corrected_setpoint"]
        deviations = []
        for setpoint, target in zip(corrected[2 * hold - 1 :: hold], path[1:], strict=True):
            places = [setpoint if name == axis else 0.0 for name in plant().names]
            plant().rest_at(places, [float(direction)] * len(places))
            deviations.append((plant().true[index] - target) * 1e3)
        curves[direction] = np.array(deviations)[::direction]
    return measured(targets, curves, runs=1)


@pytest.mark.parametrize("options", [Options(bound=2.0), Options(bound=4.0, one_sided=True)])
def test_predicted_and_simulated_errors_agree_within_a_tenth(lists, options):
    measurement = positioning_of("X", TARGETS)
    creation = create_leadscrew(measurement, TargetList(lists / "achskw1.lis"), options)
    creation.write()
    after = evaluate(simulated(lists, "X", TARGETS, "leadscrew"))
    for name in ("E", "E_up", "E_down", "M", "B"):
        predicted = creation.figures[PREDICTED][name]
        assert getattr(after, name) == pytest.approx(predicted, rel=0.1, abs=0.1), name
        assert predicted <= creation.figures[MEASURED][name]


def test_a_full_table_leaves_only_rounding_and_scatter(lists):
    measurement = positioning_of("X", TARGETS, scatter=0.5)
    creation = create_leadscrew(measurement, TargetList(lists / "achskw1.lis"))
    assert creation.points == len(TARGETS)
    assert creation.deviation <= 0.05 + 1e-9
    before, after, held_out = (creation.figures[state] for state in (MEASURED, PREDICTED, LEFT_OUT))
    assert before["E"] > 30.0
    assert after["E"] <= 0.2
    assert after["R_up"] == pytest.approx(before["R_up"])
    # A run is 5/4 as far from the mean of the four others as from the mean of all five.
    assert held_out["R_up"] == pytest.approx(before["R_up"] * 1.25, rel=0.03)


@settings(deadline=None, max_examples=40)
@given(
    st.lists(st.floats(-30.0, 30.0), min_size=3, max_size=40),
    st.lists(st.floats(0.5, 40.0), min_size=40, max_size=40),
    st.floats(0.06, 10.0),
)
def test_thinning_never_exceeds_its_bound(tmp_path_factory, deviations, steps, bound):
    targets = np.round(np.cumsum(steps)[: len(deviations)], 4)
    other = np.array(deviations) * 0.7 + 1.0
    measurement = measured(targets, {1: np.array(deviations), -1: other}, runs=2)
    creation = create_leadscrew(
        measurement, TargetList(tmp_path_factory.mktemp("l") / "new.lis", 1), Options(bound=bound, outliers="keep")
    )
    creation.write()
    table = read_machine(creation.path, strict=True).machine.axes[0].leadscrew
    for curve, values in ((deviations, table.positive), (other, table.negative)):
        off = np.abs(np.interp(targets, table.positions, values) * 1e3 - curve)
        assert off.max() <= bound + 1e-9
        assert off.max() <= creation.deviation + 1e-9


def test_the_bound_holds_for_rounded_values_too(tmp_path):
    """Ends of 0.04 µm become 0: the point between, 0.96 µm off before, is 1 µm off then."""
    measurement = measured(np.array([0.0, 1.0, 2.0]), {1: np.array([0.04, 1.0, 0.04])})
    for bound, points in ((0.96, 3), (1.02, 2)):
        creation = create_leadscrew(measurement, TargetList(tmp_path / "new.lis", 1), Options(bound=bound))
        assert creation.points == points
        assert creation.deviation <= bound


def test_a_bound_that_takes_too_many_points_is_refused_with_what_is_possible(lists):
    measurement = positioning_of("X", TARGETS)
    with pytest.raises(CannotCreateError, match=r"0.1 µm take \d+ points, but the list has room for 10, which keep"):
        create_leadscrew(measurement, TargetList(lists / "achskw1.lis"), Options(bound=0.1, max_points=10))
    with pytest.raises(CannotCreateError, match=r"rounded to 0\.1 µm"):
        create_leadscrew(measurement, TargetList(lists / "achskw1.lis"), Options(bound=0.01))


def test_without_a_bound_the_closest_table_of_the_list_s_size_is_made(lists):
    measurement = positioning_of("X", TARGETS)
    target = TargetList(lists / "achskw1.lis")
    creation = create_leadscrew(measurement, target, Options(max_points=10))
    assert creation.points <= 10
    assert b"kw.ssfk.max_points                       10\n" in creation.data
    assert any("110638" in note for note in creation.notes)
    assert creation.deviation < create_leadscrew(measurement, target, Options(max_points=6)).deviation


def test_the_signs_are_those_of_the_controller(lists):
    """Actual − programmed of the own axis is subtracted; the slave gets minus its deviation."""
    measurement = measured(TARGETS, {1: TARGETS * 0.01, -1: TARGETS * 0.01})
    leadscrew = create_leadscrew(measurement, TargetList(lists / "achskw1.lis")).compensation
    cross = create_cross(measurement, TargetList(lists / "achskw3.lis")).compensation
    assert leadscrew.positive[-1] == pytest.approx(0.005)
    assert cross.corrections[-1] == pytest.approx(-0.005)
    assert cross.master == 1


def test_what_a_compensation_left_is_put_on_top_of_it(lists):
    target = TargetList(lists / "achskw1.lis")
    before = read_machine(lists).machine.axis("X").leadscrew
    residual = measured(TARGETS, {1: np.full(len(TARGETS), 3.0), -1: np.full(len(TARGETS), -1.0)})
    after = create_leadscrew(residual, target, Options(on_top=True)).compensation
    at = np.linspace(-490.0, 490.0, 50)
    for new, old, shift in ((after.positive, before.positive, 0.003), (after.negative, before.negative, -0.001)):
        expected = np.interp(at, before.positions, old) + shift
        assert np.interp(at, after.positions, new) == pytest.approx(expected, abs=1.1e-4)


def test_a_cross_table_is_put_on_top_too_and_agrees_with_the_plant(lists):
    targets = np.arange(-500.0, 501.0, 50.0)
    deviations = np.array(straightness(plant(), "Z", "X", targets.tolist())) * 1e3
    target = TargetList(lists / "achskw3.lis")
    creation = create_cross(measured(targets, {1: deviations, -1: deviations}), target, Options(bound=0.5))
    assert creation.figures[PREDICTED]["E"] <= 1.0
    table = creation.compensation
    assert np.interp(targets, table.positions, table.corrections) * 1e3 == pytest.approx(-deviations, abs=0.5)
    before = read_machine(lists).machine.axis("Z").cross
    flat = measured(targets, {1: np.full(21, 2.0), -1: np.full(21, 2.0)})
    on_top = create_cross(flat, target, Options(on_top=True)).compensation
    assert np.interp(targets, on_top.positions, on_top.corrections) == pytest.approx(
        np.interp(targets, before.positions, before.corrections) - 0.002, abs=6e-5
    )


@pytest.mark.parametrize("bound", [None, 3.0])
def test_the_deviation_of_a_table_on_top_is_that_from_the_old_one_and_the_measured_rest(lists, bound):
    target = TargetList(lists / "achskw1.lis")
    before = read_machine(lists).machine.axis("X").leadscrew
    rest = {1: 4.0 * np.sin(TARGETS / 100.0), -1: 3.0 * np.cos(TARGETS / 150.0)}
    creation = create_leadscrew(measured(TARGETS, rest), target, Options(on_top=True, bound=bound))
    after = creation.compensation
    off = [
        np.abs(1e3 * np.interp(TARGETS, after.positions, new) - 1e3 * np.interp(TARGETS, before.positions, old) - error)
        for new, old, error in ((after.positive, before.positive, rest[1]), (after.negative, before.negative, rest[-1]))
    ]
    assert creation.deviation == pytest.approx(np.max(off), abs=1e-6)
    assert creation.deviation <= (bound or 0.05) + 1e-9


def test_the_deviation_of_a_cross_table_on_top_is_that_from_the_old_one_and_the_measured_rest(lists):
    target = TargetList(lists / "achskw3.lis")
    before = read_machine(lists).machine.axis("Z").cross
    rest = 4.0 * np.sin(TARGETS / 100.0)
    creation = create_cross(measured(TARGETS, {1: rest, -1: rest}), target, Options(on_top=True, bound=1.0))
    after = creation.compensation
    old = 1e3 * np.interp(TARGETS, before.positions, before.corrections)
    off = 1e3 * np.interp(TARGETS, after.positions, after.corrections) - (old - rest)
    assert creation.deviation == pytest.approx(np.max(np.abs(off)), abs=1e-6)
    assert creation.deviation <= 1.0


def test_the_ends_of_a_full_turn_become_one_value(tmp_path):
    file = tmp_path / "c.lis"
    file.write_text("kopf.achs_nr 6\nkw.ssfk.modulo 1\n")
    targets = np.arange(0.0, 361.0, 30.0)
    curve = 3.6 * np.concatenate([5.0 * np.sin(np.radians(targets[:-1])), [1.0]])
    creation = create_leadscrew(measured(targets, {1: curve}, unit="deg"), TargetList(file))
    assert creation.compensation.positive[0] == creation.compensation.positive[-1] == pytest.approx(0.0005)
    with pytest.raises(CannotCreateError, match="spans 360°"):
        create_leadscrew(measured(targets * 1.5, {1: curve}, unit="deg"), TargetList(file))


def test_one_direction_makes_a_unilateral_table_and_missing_targets_are_said(lists):
    target = TargetList(lists / "achskw1.lis")
    one = measured(TARGETS, {1: TARGETS * 0.01})
    assert create_leadscrew(one, target).compensation.negative is None
    two = measured(TARGETS, {1: TARGETS * 0.01, -1: TARGETS * 0.01}, runs=1)
    creation = create_leadscrew(two.only((two.targets != 0.0) | (two.directions > 0)), target)
    assert creation.points == len(TARGETS) - 1
    assert "1 targets lack readings in a direction that is needed; they are left out." in creation.notes
    assert "With one run there is no check by leaving runs out." in creation.notes
    assert LEFT_OUT not in creation.figures


def test_what_cannot_be_is_refused(lists, tmp_path):
    measurement = positioning_of("X", TARGETS)
    with pytest.raises(CannotCreateError, match="which axis is the master"):
        create_cross(measurement, TargetList(tmp_path / "new.lis", 1))
    with pytest.raises(CannotCreateError, match="on top"):
        create_leadscrew(measurement, TargetList(tmp_path / "new.lis", 1), Options(on_top=True))
    with pytest.raises(MeasurementError, match="counts in mm, the measurement in deg"):
        create_leadscrew(dataclasses.replace(measurement, unit="deg"), TargetList(lists / "achskw1.lis"))
    with pytest.raises(MeasurementError, match="does not say which axis"):
        TargetList(tmp_path / "new.lis")
    with pytest.raises(MeasurementError, match=r"achskw1.lis:\d+: The list is for axis 1, not 2"):
        TargetList(lists / "achskw1.lis", 2)
    close = measured(np.array([0.0, 0.00004, 1.0]), {1: np.zeros(3)})
    with pytest.raises(CannotCreateError, match=r"less than 0\.0001 apart"):
        create_leadscrew(close, TargetList(lists / "achskw1.lis"))


def test_settings_and_other_tables_of_the_list_stay(lists):
    before = read_machine(lists).machine
    create_leadscrew(positioning_of("X", TARGETS), TargetList(lists / "achskw1.lis"), Options(bound=1.0)).write()
    reading = read_machine(lists)
    x = reading.machine.axis("X")
    assert not reading.findings
    assert dataclasses.replace(x, leadscrew=None) == dataclasses.replace(before.axis("X"), leadscrew=None)
    assert x.leadscrew.without_other_compensations == before.axis("X").leadscrew.without_other_compensations
    assert reading.machine.axes[1:] == before.axes[1:]


def test_a_table_that_no_axis_parameter_activates_is_said(lists):
    axis = lists / "achsmd1.lis"
    axis.write_text(axis.read_text().replace("lr_param.ssfk", "# lr_param.ssfk"))
    creation = create_leadscrew(positioning_of("X", TARGETS), TargetList(lists / "achskw1.lis"))
    assert "lr_param.ssfk of the axis list has to be 1 for the table to act." in creation.notes


def test_the_picture_shows_both_directions_and_the_table(lists):
    ax = create_leadscrew(positioning_of("X", TARGETS), TargetList(lists / "achskw1.lis")).plot()
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels == ["measured x̄↑", "predicted x̄↑", "measured x̄↓", "predicted x̄↓", "table"]
