"""The correction against the machine itself: its errors are those where it stands, at q + Δ (semantics §10)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from rigid_bodies import (
    compensated,
    interpolated_errors,
    kernel_tool_place,
    machine_of,
    tool_place,
    volumetric,
    with_constant_errors,
)

from axcomp.kernel import volumetric_model
from axcomp.model import ERRORS, LETTERS, LINEAR, ErrorTable, Volumetric, is_angle
from axcomp.runtime import Runtime

POSITIONS = np.linspace(-400.0, 400.0, 801)
CENTERS = ((10.0, 20.0, -30.0), (-40.0, 5.0, 60.0), (70.0, -80.0, -550.0))
PLACE = {"X": 123.4, "Y": -234.3, "Z": 145.7, "A": 21.0, "B": -33.0, "C": 205.0}


def cyclic(name: str, over: str, share: float = 1.0, phase: float = 0.0) -> ErrorTable:
    """Return 0.5 mm or 1 mrad with a cycle of 20 µm or 20 µrad in 10 mm or 10°."""
    constant, ripple = (1e-3, 20e-6) if is_angle(name) else (0.5, 0.02)
    values = share * (constant + ripple * np.sin(2.0 * np.pi * POSITIONS / 10.0 + phase))
    return ErrorTable(name, tuple(values.tolist()), over, tuple((x,) for x in POSITIONS.tolist()))


def residual(machine: Volumetric, place: dict[str, float], tool_length: float = 0.0) -> float:
    """Return how far the tool is from its nominal place when the machine has its errors where it stands, mm."""
    moved = compensated(machine, place, tool_length)
    actual = tool_place(machine, moved, interpolated_errors(machine, moved), tool_length)
    return float(np.linalg.norm(actual - tool_place(machine, place, {}, tool_length)))


@pytest.mark.parametrize("alternative_model", [False, True])
@pytest.mark.parametrize("workpiece_axes", [0, 2, 6])
def test_large_errors_with_a_short_cycle_leave_less_than_50_nm(alternative_model: bool, workpiece_axes: int) -> None:
    errors = tuple(
        cyclic(name, name[-1], 1.0, 0.3 * number)
        if name[0] == "E"
        else ErrorTable(name, (cyclic(name, "X").values[0],))
        for number, name in enumerate(ERRORS)
    )
    machine = volumetric(
        "CBYXZA",
        errors=errors,
        workpiece_axes=workpiece_axes,
        alternative_model=alternative_model,
        centers=CENTERS,
        tool_orientation=(0.0, 0.0, -1.0),
    )
    for step in range(12):
        place = {letter: q + 0.83 * step for letter, q in PLACE.items()}
        assert residual(machine, place, 80.0) <= 50e-6


def test_a_rotary_error_acts_about_the_origin_of_the_machine() -> None:
    # 1 mrad about y: what is 550 mm below and 70 mm beside the origin moves by 0.55 mm in x and 0.07 mm in z.
    machine = volumetric("CXYZ", centers=CENTERS)
    found = kernel_tool_place(machine, {"X": 70.0, "Y": -80.0, "Z": -550.0}, {"B0C": 1e-3})
    assert found == pytest.approx([70.0 - 0.55, -80.0, -550.0 - 0.07], abs=1e-3)


def vectors(size: float) -> st.SearchStrategy[tuple[float, ...]]:
    return st.tuples(*[st.floats(-size, size)] * 3)


@st.composite
def machines(draw: st.DrawFn) -> Volumetric:
    """Return a machine of 3 to 6 axes with constant errors and cyclic ones over any axis of its."""
    rotary = draw(st.permutations("ABC"))[: draw(st.integers(0, 3))]
    # X, Y and Z side by side: a turning axis between them can make two of them parallel.
    blocks = [*rotary, "".join(draw(st.permutations(LINEAR)))]
    chain = "".join(draw(st.permutations(blocks)))
    names = draw(st.lists(st.sampled_from([name for name in ERRORS if name[-1] in chain]), unique=True, max_size=24))
    errors = []
    for name in names:
        share, phase = draw(st.floats(-1.0, 1.0)), draw(st.floats(0.0, 6.0))
        over = draw(st.sampled_from(["", *chain]))
        table = cyclic(name, over, share, phase)
        errors.append(table if over else ErrorTable(name, table.values[:1]))
    return volumetric(
        chain,
        errors=tuple(errors),
        workpiece_axes=draw(st.integers(0, len(chain))),
        alternative_model=draw(st.booleans()),
        tool_position=draw(vectors(50.0)),
        tool_orientation=draw(st.sampled_from([(0.0, 0.0, -1.0), (0.0, 0.6, 0.8)])),
        centers=tuple(draw(vectors(200.0)) for _ in "ABC"),
        offsets=(*draw(vectors(20.0)), *draw(vectors(0.1))),
    )


@settings(max_examples=80)
@given(machines(), st.data())
def test_any_machine_is_brought_to_its_nominal_place(machine: Volumetric, data: st.DataObject) -> None:
    place = {letter: data.draw(st.floats(-300.0, 300.0)) for letter in LETTERS}
    length = data.draw(st.floats(0.0, 200.0))
    assert residual(machine, place, length) <= 50e-6
    constant = with_constant_errors(machine, interpolated_errors(machine, place))
    assert residual(constant, place, length) <= 1e-6


def evaluations(machine: Volumetric, monkeypatch: pytest.MonkeyPatch) -> int:
    """Return how often the model is evaluated in a cycle."""
    count = 0
    carry = volumetric_model.carry_to_workpiece

    def counted(*arguments: object) -> None:
        nonlocal count
        count += 1
        carry(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(volumetric_model, "carry_to_workpiece", counted)
    compensated(machine, PLACE)
    return count


def test_the_model_is_evaluated_no_more_often_than_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    def line(name: str, over: str, slope: float) -> ErrorTable:
        return ErrorTable(name, (-400.0 * slope, 400.0 * slope), over, ((-400.0,), (400.0,)))

    constant = with_constant_errors(volumetric("XYZ"), {"X0X": 0.5, "EAY": 1e-3})
    assert evaluations(constant, monkeypatch) == 1
    over_a_rotary_axis = volumetric("CXYZ", errors=(line("EXC", "C", 1e-3),))
    assert evaluations(over_a_rotary_axis, monkeypatch) == 1
    usual = volumetric("XYZ", errors=tuple(line(f"EX{letter}", letter, 1e-4) for letter in LINEAR))
    assert evaluations(usual, monkeypatch) == 2
    assert evaluations(volumetric("XYZ", errors=(cyclic("EXX", "X"),)), monkeypatch) == 3


def test_the_number_of_evaluations_does_not_show_in_the_path() -> None:
    machine = volumetric("XYZ", errors=(cyclic("EXX", "X"), cyclic("EYX", "X"), cyclic("EBX", "X")))
    runtime = Runtime(machine_of(machine))
    path = []
    for step in range(2000):
        runtime.inputs.axis[0].setpoint = 10.0 + 0.01 * step
        runtime.cycle()
        path.append(runtime.outputs.axis[0].volumetric_correction)
    # The ripple itself has second differences of 20 µm · (2π · 0.01/10)² = 0.8 nm.
    assert np.abs(np.diff(path, 2)).max() < 0.3e-3
