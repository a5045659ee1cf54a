from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from rigid_bodies import (
    compensated,
    corrections,
    kernel_tool_place,
    small_turn,
    tool_place,
    volumetric,
    with_constant_errors,
)
from scipy.spatial.transform import Rotation

from axcomp.model import ERRORS, LETTERS, LINEAR, Volumetric, is_angle

TOOL = {"tool_position": (3.0, -4.0, 50.0), "tool_orientation": (0.0, 0.6, -0.8)}
CENTERS = ((10.0, 20.0, -30.0), (-40.0, 5.0, 60.0), (70.0, -80.0, 9.0))
SIX_AXES = volumetric("CBYXZA", workpiece_axes=3, centers=CENTERS, **TOOL)
PLACE = {"X": 123.0, "Y": -234.0, "Z": 345.0, "A": 21.0, "B": -33.0, "C": 205.0}


def magnitude(name: str) -> float:
    return 1e-3 if is_angle(name) else 1.0


@pytest.mark.parametrize("alternative_model", [False, True])
@pytest.mark.parametrize("name", ERRORS)
def test_each_error_alone_moves_the_tool_as_a_model_of_matrices_says(name: str, alternative_model: bool) -> None:
    machine = volumetric("CBYXZA", workpiece_axes=3, centers=CENTERS, alternative_model=alternative_model, **TOOL)
    errors = {name: magnitude(name)}
    expected = tool_place(machine, PLACE, errors, 25.0)
    assert kernel_tool_place(machine, PLACE, errors, 25.0) == pytest.approx(expected, abs=1e-9)
    nominal = tool_place(machine, PLACE, {}, 25.0)
    moved = compensated(with_constant_errors(machine, errors), PLACE, 25.0)
    assert tool_place(machine, moved, errors, 25.0) == pytest.approx(nominal, abs=1e-9)


@pytest.mark.parametrize("name", ["A0X", "B0Y", "C0Z"])
def test_a_linear_axis_may_be_turned_about_itself(name: str) -> None:
    assert corrections(with_constant_errors(SIX_AXES, {name: 1e-3}), PLACE) == dict.fromkeys(LINEAR, 0.0)


@pytest.mark.parametrize("name", ["A0A", "B0B", "C0C", "X0A", "Y0B", "Z0C"])
def test_in_the_alternative_model_a_rotary_axis_may_be_displaced_along_itself(name: str) -> None:
    errors = {name: magnitude(name)}
    # L turns about the origin of the machine: only an axis through it may be turned about itself.
    centers = ((10.0, 0.0, 0.0), (0.0, 5.0, 0.0), (0.0, 0.0, 9.0)) if is_angle(name) else CENTERS
    alternative = volumetric("CBYXZA", workpiece_axes=3, centers=centers, alternative_model=True, **TOOL)
    found = corrections(with_constant_errors(alternative, errors), PLACE)
    assert list(found.values()) == pytest.approx([0.0] * 3, abs=1e-12)
    usual = corrections(with_constant_errors(SIX_AXES, errors), PLACE)
    assert max(abs(value) for value in usual.values()) > 1e-3


def test_errors_are_actual_minus_nominal() -> None:
    found = corrections(with_constant_errors(volumetric("XYZ"), {"EXX": 0.01}), {"X": 5.0, "Y": 6.0, "Z": 7.0})
    assert found == pytest.approx({"X": -0.01, "Y": 0.0, "Z": 0.0}, abs=1e-12)


def first_order(errors: dict[str, float], x: float, y: float, z: float, tip: np.ndarray) -> np.ndarray:
    """Return the error of the tool of a YXZ machine, as semantics §10 writes it out."""
    e = errors
    shift = [sum(e[f"E{k}{axis}"] + e[f"{k}0{axis}"] for axis in LINEAR) for k in LINEAR]
    shift[0] += -e["C0Y"] * y + e["B0Z"] * z + (e["EBY"] + e["EBX"]) * z
    shift[1] += e["C0X"] * x - e["A0Z"] * z + e["ECY"] * x - (e["EAY"] + e["EAX"]) * z
    shift[2] += -e["B0X"] * x + e["A0Y"] * y - e["EBY"] * x
    turns = [e[f"E{k}Y"] + e[f"E{k}X"] + e[f"E{k}Z"] for k in "ABC"]
    return np.array(shift) + np.cross(turns, tip)


@given(st.lists(st.floats(-1, 1), min_size=36, max_size=36), st.tuples(*[st.floats(-200, 200)] * 3), st.floats(0, 100))
def test_small_errors_are_compensated_to_first_order(
    shares: list[float], place: tuple[float, float, float], tool_length: float
) -> None:
    names = [name for name in ERRORS if name[-1] in LINEAR]
    errors = {name: share * (1e-6 if is_angle(name) else 1e-3) for name, share in zip(names, shares, strict=True)}
    machine = volumetric("YXZ", **TOOL)
    tip = np.add(TOOL["tool_position"], tool_length * np.array(TOOL["tool_orientation"]))
    found = corrections(with_constant_errors(machine, errors), dict(zip(LINEAR, place, strict=True)), tool_length)
    assert list(found.values()) == pytest.approx(-first_order(errors, *place, tip), abs=1e-7)


def vectors(size: float) -> st.SearchStrategy[tuple[float, ...]]:
    return st.tuples(*[st.floats(-size, size)] * 3)


@st.composite
def machines(draw: st.DrawFn) -> Volumetric:
    rotary = draw(st.permutations("ABC"))[: draw(st.integers(0, 3))]
    chain = "".join(draw(st.permutations([*LINEAR, *rotary])))
    directions = [Rotation.from_euler("xyz", draw(vectors(0.2))).apply(row) for row in np.tile(np.eye(3), (2, 1))]
    return volumetric(
        chain,
        workpiece_axes=draw(st.integers(0, len(chain))),
        alternative_model=draw(st.booleans()),
        tool_position=draw(vectors(100.0)),
        tool_orientation=tuple(Rotation.from_euler("xyz", draw(vectors(3.0))).apply([0.0, 0.0, 1.0])),
        centers=tuple(draw(vectors(200.0)) for _ in "ABC"),
        directions=tuple(map(tuple, directions)),
        offsets=(*draw(vectors(100.0)), *draw(vectors(1.0))),
    )


@settings(max_examples=60)
@given(machines(), st.data())
def test_the_compensated_axes_bring_the_tool_to_its_nominal_place(machine: Volumetric, data: st.DataObject) -> None:
    drawn = data.draw(st.dictionaries(st.sampled_from(ERRORS), st.floats(-1, 1), max_size=72))
    errors = {name: share * magnitude(name) for name, share in drawn.items() if name[-1] in machine.chain}
    # A turning axis between two linear ones can make them parallel; such places have a test of their own.
    spread = 500.0 if "".join(letter for letter in machine.chain if letter in LINEAR) in machine.chain else 10.0
    place = {letter: data.draw(st.floats(-spread, spread)) for letter in LETTERS}
    length = data.draw(st.floats(0.0, 200.0))
    moved = compensated(with_constant_errors(machine, errors), place, length)
    nominal = tool_place(machine, place, {}, length)
    assert tool_place(machine, moved, errors, length) == pytest.approx(nominal, abs=1e-9)


@pytest.mark.parametrize("chain", ["CBYXZA", "XYZ", "CYXZ", "XYZBC"])
def test_the_largest_errors_all_at_once_are_compensated_exactly(chain: str) -> None:
    errors = {name: magnitude(name) for name in ERRORS if name[-1] in chain}
    machine = volumetric(chain, centers=CENTERS, **TOOL)
    place = {letter: 3 * q for letter, q in PLACE.items()}
    moved = compensated(with_constant_errors(machine, errors), place, 300.0)
    assert tool_place(machine, moved, errors, 300.0) == pytest.approx(tool_place(machine, place, {}, 300.0), abs=1e-9)


def on_the_tool_side(letter: str, errors: dict[str, float]) -> dict[str, float]:
    """Return the errors of a linear axis that moves the tool by −q, for one that moves the workpiece by q.

    A = Trans(e·q + t)·R, so A⁻¹ = Trans(−R⁻¹·e·q − R⁻¹·t)·R⁻¹.
    """
    back = small_turn(*(errors[f"E{k}{letter}"] for k in "ABC")).inv()
    shift = -back.apply([errors[f"E{k}{letter}"] + errors[f"{k}0{letter}"] for k in LINEAR])
    direction = back * small_turn(*(errors[f"{k}0{letter}"] for k in "ABC"))
    turned = dict(zip((f"E{k}{letter}" for k in "ABC"), back.as_euler("xyz"), strict=True))
    inclined = dict(zip((f"{k}0{letter}" for k in "ABC"), direction.as_euler("xyz"), strict=True))
    return turned | inclined | dict(zip((f"E{k}{letter}" for k in LINEAR), shift, strict=True))


@given(st.lists(st.floats(-1, 1), min_size=36, max_size=36), st.integers(1, 3))
def test_an_axis_may_be_described_at_the_workpiece_or_at_the_tool(shares: list[float], workpiece_axes: int) -> None:
    names = [name for name in ERRORS if name[-1] in LINEAR]
    errors = {name: share * magnitude(name) for name, share in zip(names, shares, strict=True)}
    at_workpiece = volumetric("YXZ", workpiece_axes=workpiece_axes, **TOOL)
    moved = "YXZ"[:workpiece_axes]
    others = {name: value for name, value in errors.items() if name[-1] not in moved}
    swapped = {name: value for letter in moved for name, value in on_the_tool_side(letter, errors).items()}
    directions = tuple(
        tuple(-x if letter in moved else x for x in direction)
        for letter, direction in zip(LETTERS, at_workpiece.directions, strict=True)
    )
    at_tool = volumetric("YXZ", directions=directions, **TOOL)
    # W = A₁⁻¹·A₂⁻¹ …: taken to the tool's side, the axes keep their order.
    found = corrections(with_constant_errors(at_tool, others | swapped), PLACE, 20.0)
    assert found == pytest.approx(corrections(with_constant_errors(at_workpiece, errors), PLACE, 20.0), abs=1e-9)


def test_a_displaced_rotary_axis_is_the_same_at_workpiece_and_tool_when_it_turns_the_other_way() -> None:
    shift = np.array([0.2, -0.3, 0.1])
    at_workpiece = volumetric("CXYZ", workpiece_axes=1, centers=CENTERS, **TOOL)
    moved = compensated(with_constant_errors(at_workpiece, dict(zip(("X0C", "Y0C", "Z0C"), shift, strict=True))), PLACE)
    # A⁻¹ = Trans(P)·Rot(−q)·Trans(−t)·Trans(−P) = Trans(P)·Trans(−Rot(−q)·t)·Rot(−q)·Trans(−P)
    back = -Rotation.from_euler("z", -PLACE["C"], degrees=True).apply(shift)
    at_tool = volumetric("CXYZ", centers=CENTERS, directions=(*at_workpiece.directions[:5], (0.0, 0.0, -1.0)), **TOOL)
    expected = compensated(with_constant_errors(at_tool, dict(zip(("X0C", "Y0C", "Z0C"), back, strict=True))), PLACE)
    assert moved == pytest.approx(expected, abs=1e-9)


def test_offsets_are_added_to_the_setpoints_before_anything_else() -> None:
    errors = {"EBY": 1e-3, "X0C": 0.2, "ECC": 1e-3}
    machine = with_constant_errors(volumetric("CYXZ", workpiece_axes=1, centers=CENTERS), errors)
    shifted = with_constant_errors(
        volumetric("CYXZ", workpiece_axes=1, centers=CENTERS, offsets=(0.0, 0.0, -550.0, 0.0, 0.0, np.radians(30.0))),
        errors,
    )
    place = {"X": 10.0, "Y": 20.0, "Z": 650.0, "C": 40.0}
    same = {"X": 10.0, "Y": 20.0, "Z": 100.0, "C": 70.0}
    assert corrections(shifted, place) == pytest.approx(corrections(machine, same), abs=1e-12)
