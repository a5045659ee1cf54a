from __future__ import annotations

from dataclasses import replace

import pytest
from fmu_machines import three_axes

from axcomp.fmu import Interface
from axcomp.model import AXES_MAX, Axis, AxisType, Machine, Volumetric

INTERFACE = Interface.of(three_axes(), "machine/hochlauf.lis", 0.001)


def test_it_is_read_back_as_it_was_written() -> None:
    assert Interface.from_json(INTERFACE.to_json()) == INTERFACE
    with pytest.raises((KeyError, TypeError, ValueError)):
        Interface.from_json("[1]")


def test_the_same_machine_fits() -> None:
    assert INTERFACE.fit(three_axes()) == (three_axes(), [])


def test_axes_take_the_order_of_the_variables() -> None:
    x, y, c = three_axes().axes
    assert INTERFACE.fit(Machine((c, x, y))) == (three_axes(), [])


def test_volumetric_compensations_stay() -> None:
    volumetric = (Volumetric(0, (("X", 1), ("Y", 2), ("Z", 3))),)
    machine = replace(three_axes(), volumetric=volumetric)
    assert INTERFACE.fit(machine) == (machine, [])


def test_an_axis_that_is_gone_is_not_corrected() -> None:
    x, _, c = three_axes().axes
    machine, (complaint,) = INTERFACE.fit(Machine((x, c)))
    assert machine.axes == (x, Axis(2, "Y-ACHSE"), c)
    assert "Y-ACHSE is not in the lists" in complaint


def test_a_new_axis_stands_behind_the_others() -> None:
    machine, (complaint,) = INTERFACE.fit(Machine((Axis(9, "W"), *three_axes().axes)))
    assert [axis.number for axis in machine.axes] == [1, 2, 3, 9]
    assert "axis 9 has no variables" in complaint


def test_an_axis_that_has_become_rotary_is_named() -> None:
    x, y, c = three_axes().axes
    _, (complaint,) = INTERFACE.fit(Machine((replace(x, type=AxisType.ROTARY), y, c)))
    assert "axis X has become rotary" in complaint


def test_a_renamed_axis_keeps_the_name_of_its_variables() -> None:
    x, y, c = three_axes().axes
    assert INTERFACE.fit(Machine((replace(x, name="X1"), y, c))) == (three_axes(), [])


def test_too_many_axes_are_not_corrected_at_all() -> None:
    others = tuple(Axis(100 + i, f"A{i}") for i in range(AXES_MAX - 1))
    machine, complaints = INTERFACE.fit(Machine((*others, three_axes().axes[0])))
    assert machine == INTERFACE.bare()
    assert f"more than {AXES_MAX} axes" in complaints[-1]
