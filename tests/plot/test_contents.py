"""What is shown is what the lists hold and what the kernel does with it."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import LinearNDInterpolator
from shown_machines import MACHINE, MEASURED, PLANE, SCATTERED, SCREW, VOLUMETRIC, table

from axcomp.engine import TcpModel
from axcomp.kinds import Leadscrew
from axcomp.model import Axis, Curve, Machine, Quantity, Volumetric
from axcomp.plot import Bars, Content, Curves, Field, Map, NotComparableError, Subject, contents_of, spread
from axcomp.runtime import Runtime


def _content(machine: Machine, axis: str, kind: str) -> Any:
    [content] = contents_of(machine, axis, kind)
    return content


def test_every_compensation_is_there_in_the_order_of_a_cycle() -> None:
    assert [content.subject.name for content in contents_of(MACHINE)] == [
        "X-plane",
        "X-crosstalk",
        "X-leadscrew",
        "Y-cross",
        "Y-crosstalk",
        "Z-crosstalk",
        "Z-friction",
        "W-crosstalk",
        "C-leadscrew",
    ]


def test_a_leadscrew_shows_the_values_of_the_list_in_micrometres_and_their_difference() -> None:
    records = _content(MACHINE, "X", "leadscrew").records()
    assert records.columns == ("position of X [mm]", "positive motion [µm]", "negative motion [µm]", "difference [µm]")
    assert np.allclose(records.rows, [(0, 0, 1, -1), (10, 4, 6, -2), (40, -2, 1, -3)])


def test_a_modulo_leadscrew_is_closed_and_in_seconds_of_arc() -> None:
    curves = _content(MACHINE, "C", "leadscrew")
    assert curves.records().columns == ("position of C [°]", "both directions [″]")
    assert np.allclose(curves.records().rows, [(0, 0), (90, 3.6), (180, 10.8), (270, 7.2), (360, 0)])
    assert np.allclose(curves.lines[0].at(np.array([-90.0, 315.0, 450.0])), [7.2, 3.6, 3.6])


def test_a_cross_table_shows_corrections_over_its_master() -> None:
    curves = _content(MACHINE, "Y", "cross")
    assert (str(curves.x), str(curves.y)) == ("position of X [mm]", "correction of Y [µm]")
    assert np.allclose(curves.records().rows, [(0, 0), (100, 20)])


def test_friction_currents_are_scaled() -> None:
    assert np.allclose(_content(MACHINE, "Z", "friction").records().rows, [(1, 150), (10, 125), (100, 200)])


def test_a_plane_is_shown_as_the_kernel_interpolates_it() -> None:
    axes = tuple(replace(axis, crosstalk=None, leadscrew=None, cross=None, friction=None) for axis in MACHINE.axes)
    machine = Machine(axes)
    shown = _content(machine, "X", "plane")
    assert [str(q) for q in (shown.x, shown.y, shown.z)] == [
        "position of Y [mm]",
        "position of Z [mm]",
        "correction of X [µm]",
    ]
    across, up = np.array([-30.0, -10.0, -3.0, 4.0, 10.0, 25.0]), np.array([0.0, 5.0, 11.0, 25.0, 90.0])
    runtime = Runtime(machine)
    expected = np.empty((len(up), len(across)))
    for j, z in enumerate(up):
        for i, y in enumerate(across):
            runtime.inputs.axis[1].setpoint, runtime.inputs.axis[2].setpoint = y, z
            runtime.cycle()
            expected[j, i] = 1e3 * runtime.outputs.axis[0].corrected_setpoint
    assert np.allclose(shown.at(across, up)[0], expected, atol=1e-12)
    assert shown.records().rows[1] == pytest.approx((0.0, 5.0, 10.0))


def test_a_plane_of_one_row_is_constant_across_it() -> None:
    flat = replace(PLANE, corrections=((0.0, 0.01, 0.02),))
    machine = Machine((replace(MACHINE.axes[0], plane=flat), *MACHINE.axes[1:]))
    shown = _content(machine, "X", "plane")
    assert np.allclose(shown.at(np.array([-10.0, 0.0, 5.0]), np.array([-5.0, 99.0]))[0], [[0.0, 10.0, 15.0]] * 2)
    assert shown.figure().axes


def test_crosstalk_of_one_test_is_linear_up_to_its_acceleration_and_then_held() -> None:
    rows = _content(MACHINE, "X", "crosstalk").records().rows
    assert np.allclose(rows, [(-3250, -9, -8), (-2500, -9, -8), (0, 0, 0), (3000, 12, 10), (3900, 12, 10)])


def test_crosstalk_over_one_axis_shows_its_tests() -> None:
    records = _content(MACHINE, "Y", "crosstalk").records()
    states = [f"{limit} mm/s², {motion} motion" for limit in ("+3000", "-2500") for motion in ("positive", "negative")]
    assert records.columns == ("position of Z [mm]", *(f"{state} [µm]" for state in states))
    assert np.allclose(records.rows, [(p, p, 1, -p, 2) for p in (-50.0, 0.0, 80.0)])


def test_crosstalk_over_two_axes_is_shown_as_scipy_interpolates_its_tests() -> None:
    shown = _content(MACHINE, "Z", "crosstalk")
    assert np.allclose(shown.records().rows, [(p, q, p / 50 + q * q / 4000, p) for p, q in SCATTERED], atol=1e-12)
    x, y = np.linspace(-150.0, 200.0, 15), np.linspace(-120.0, 150.0, 13)
    reference = LinearNDInterpolator(np.array(SCATTERED), [p / 50 + q * q / 4000 for p, q in SCATTERED])(
        *np.meshgrid(x, y)
    )
    inside = ~np.isnan(reference)
    assert inside.sum() > 50
    assert np.allclose(shown.at(x, y)[0][inside], reference[inside], atol=1e-9)


def test_the_errors_of_a_measured_machine_are_shown_axis_by_axis() -> None:
    found = {content.subject.part: content for content in contents_of(MEASURED, kind="volumetric")}
    assert list(found) == [
        "linear errors of X",
        "angular errors of X",
        "EZY",
        "linear errors of Z",
        "constant angular errors",
        "TCP error",
    ]
    linear = found["linear errors of X"]
    assert isinstance(linear, Curves)
    assert [line.label for line in linear.lines] == ["EXX", "EYX"]
    assert np.allclose(linear.records().rows, [(-100, -10, 3), (0, 0, 2), (100, 20, 1)])
    angular = found["angular errors of X"]
    assert angular.records().columns == ("position of X [mm]", "ECX [µrad]")
    assert np.allclose(angular.records().rows, [(-100, -20), (100, 30)])
    constant = found["constant angular errors"]
    assert isinstance(constant, Bars)
    assert constant.values == {"C0Y": pytest.approx(30.0)}
    surface = found["EZY"]
    assert isinstance(surface, Map)
    assert np.allclose(surface.at(np.array([-40.0, 70.0]), np.array([10.0]))[0], [[-0.02, 0.09]])


def test_errors_of_one_axis_only_on_request() -> None:
    assert [content.subject.part for content in contents_of(MEASURED, "Z", "volumetric")] == ["linear errors of Z"]


def test_the_tcp_error_is_that_of_the_first_order_formula() -> None:
    """Chain YXZ, all axes on the tool's side (semantics §10)."""
    model = TcpModel(VOLUMETRIC)
    for x, y, z in ((-80.0, 30.0, 150.0), (0.0, 0.0, 0.0), (60.0, -45.0, 20.0)):
        exx = np.interp(x, [-100, 0, 100], [-0.01, 0.0, 0.02])
        eyx = np.interp(x, [-100, 100], [0.003, 0.001])
        ezz, ezy = np.interp(z, [0, 200], [0, 0.004]), 1e-6 * x + 2e-6 * y
        expected = (exx - 30e-6 * y, eyx, ezz + ezy)
        assert np.allclose(model.errors_and_deviations(np.array([[x, y, z, 0.0, 0.0, 0.0]]))[1], expected, atol=1e-7)
    # A tool of 100 mm along Y swings with the yaw of X: 30 µrad · 100 mm.
    long = TcpModel(replace(VOLUMETRIC, tool_orientation=(0.0, 1.0, 0.0)))
    place = np.array([[100.0, 0, 0, 0, 0, 0]])
    swing = long.errors_and_deviations(place, 100.0)[1] - long.errors_and_deviations(place)[1]
    assert swing[0, 0] == pytest.approx(-100.0 * 30e-6, abs=1e-7)


def test_the_field_covers_the_work_volume_that_was_measured() -> None:
    field = contents_of(MEASURED, kind="volumetric")[-1]
    assert isinstance(field, Field)
    assert np.ptp(field.positions, axis=0).tolist() == [200.0, 100.0, 200.0]
    size = np.array(field.records().rows)
    assert np.allclose(size[:, 6], np.linalg.norm(size[:, 3:6], axis=1))


def test_a_table_with_its_axis_displaced_swings_once_a_turn() -> None:
    """Workpiece on C, EXC = 10 µm: the tip is displaced by −Rot(−q)·(10, 0, 0) in the workpiece."""
    axes = (*((letter, number) for number, letter in enumerate("XYZC", 1)),)
    errors = (table("EXC", "C", [0.0, 360.0], [0.01, 0.01]), table("EXX", "X", [0.0, 400.0], [0.0, 0.0]))
    turning = Volumetric(1, axes, "CXYZ", 1, errors)
    machine = Machine(tuple(Axis(number, letter) for letter, number in axes), (turning,))
    curves = contents_of(machine, kind="volumetric")[-1]
    assert isinstance(curves, Curves)
    assert curves.subject.part == "TCP error over C"
    assert curves.note == "X = 200, Y = 0, Z = 0"
    q, along_x, along_y, along_z = np.array(curves.records().rows).T
    assert np.allclose(along_x, -10.0 * np.cos(np.radians(q)), atol=1e-9)
    assert np.allclose(along_y, 10.0 * np.sin(np.radians(q)), atol=1e-9)
    assert np.allclose(along_z, 0.0, atol=1e-9)


def test_a_field_without_errors_is_drawn_without_arrows() -> None:
    field = Field(Subject("0", "volumetric"), np.zeros((2, 3)), np.full((2, 3), 1e-9))
    assert field.largest() == 0.0
    [ax, _] = field.figure().axes
    assert ax.get_title().endswith("none at these places")


def test_a_machine_does_not_differ_from_itself() -> None:
    for content in (*contents_of(MACHINE), *contents_of(MEASURED, kind="volumetric")):
        rows = content.against(content).records().rows
        skipped = 1 if isinstance(content, (Curves, Bars)) else 3 if isinstance(content, Field) else 2
        assert np.allclose([[float(cell) for cell in row[skipped:]] for row in rows], 0.0)


def _difference(one: Leadscrew, other: Leadscrew) -> Content:
    contents = [contents_of(Machine((Axis(1, "X", leadscrew=screw),)))[0] for screw in (one, other)]
    return contents[0].against(contents[1])


def test_a_difference_is_taken_at_the_points_of_both_machines() -> None:
    other = Leadscrew((0.0, 20.0), (0.001, 0.003))
    records = _difference(SCREW, other).records()
    x = np.array([0.0, 10.0, 20.0, 40.0])
    theirs = np.interp(x, [0, 20], [1, 3])
    up, down = np.interp(x, SCREW.positions, [0, 4, -2]), np.interp(x, SCREW.positions, [1, 6, 1])
    assert np.allclose(records.rows, np.column_stack([x, theirs - up, theirs - down]))
    back = _difference(other, SCREW).records()
    assert np.allclose(np.array(back.rows)[:, 1:], -np.array(records.rows)[:, 1:])


def test_an_error_that_the_other_machine_lacks_is_zero_there() -> None:
    fewer = replace(VOLUMETRIC, errors=(table("EXX", "X", [-100.0, 100.0], [0.0, 0.01]),))
    one, other = (contents_of(replace(MEASURED, volumetric=(v,)), kind="volumetric")[0] for v in (VOLUMETRIC, fewer))
    records = one.against(other).records()
    assert records.columns[1:] == ("EXX [µm]", "EYX [µm]")
    assert np.allclose(records.rows, [(-100, 10, -3), (0, 5, -2), (100, -10, -1)])


def test_constant_errors_that_one_of_two_machines_lacks_are_zero_there() -> None:
    quantity = Quantity("error", "µrad")
    one = Bars(Subject("0", "volumetric"), quantity, {"C0Y": 30.0, "A0Z": 5.0})
    other = Bars(Subject("0", "volumetric"), quantity, {"B0Z": -7.0, "C0Y": 10.0})
    assert one.against(other).values == {"C0Y": -20.0, "A0Z": -5.0, "B0Z": -7.0}
    assert other.against(one).values == {"B0Z": 7.0, "C0Y": 20.0, "A0Z": 5.0}
    assert one.against(other).records().rows == [("C0Y", -20.0), ("A0Z", -5.0), ("B0Z", -7.0)]


def test_tables_over_different_quantities_are_not_compared() -> None:
    crosstalks = [_content(MACHINE, name, "crosstalk") for name in ("X", "Y", "Z")]
    for one, other in ((0, 1), (1, 2), (2, 0)):
        with pytest.raises(NotComparableError, match="different quantities"):
            crosstalks[one].against(crosstalks[other])


def test_rows_are_spread_over_the_whole_table() -> None:
    assert spread(10, 4) == [0, 3, 6, 9]
    assert spread(3, 12) == [0, 1, 2]
    assert spread(5, 0) == [0, 1, 2, 3, 4]


def test_a_line_holds_its_ends() -> None:
    quantity = Quantity("position", "mm")
    assert Curve((0.0, 1.0), (2.0, 4.0), quantity, quantity).at(np.array([-1.0, 0.5, 9.0])) == [2.0, 3.0, 4.0]
    assert Subject("0", "volumetric", "TCP error").name == "0-volumetric-TCP-error"
