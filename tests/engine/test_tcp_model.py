"""The error model over arrays is the kernel's, place by place."""

from dataclasses import replace

import numpy as np
import pytest

from axcomp.engine import TcpModel
from axcomp.kernel import FRAME, carry_to_workpiece, errors_at, zeros
from axcomp.model import ERRORS, ErrorTable, Volumetric

AXES = tuple((letter, k + 1) for k, letter in enumerate("XYZABC"))
TILTED = (0.0, 0.6, 0.8)
MACHINES = [
    Volumetric(0, AXES[:3], "YXZ", tool_position=(10.0, -20.0, -150.0), tool_orientation=(0.0, 0.0, -1.0)),
    Volumetric(
        0, AXES, "CAYXZB", 2, tool_position=(1.0, 2.0, -90.0), tool_orientation=(0.0, 0.0, -1.0),
        centers=((1.0, 2.0, -40.0), (3.0, -5.0, 60.0), (7.0, 8.0, 9.0)), offsets=(1.0, 0.0, 2.0, 0.1, 0.0, -0.2),
        directions=((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), TILTED, (0.0, 0.0, 1.0)),
    ),
]  # fmt: skip


def at_random(seed=0, n=40):
    random = np.random.default_rng(seed)
    places = random.uniform(-400.0, 400.0, (n, 6))
    errors = random.normal(0.0, 1e-3, (n, 72))
    return places, random.uniform(0.0, 200.0, n), errors


@pytest.mark.parametrize("alternative", [False, True])
@pytest.mark.parametrize("machine", MACHINES)
def test_deviations_are_those_of_the_kernel(machine, alternative):
    model = TcpModel(replace(machine, alternative_model=alternative))
    places, lengths, errors = at_random()
    found = model.deviations(places, lengths, errors)
    for row, place, length, wrong in zip(found, places.tolist(), lengths, errors.tolist(), strict=True):
        nominal, actual = zeros(FRAME), zeros(FRAME)
        carry_to_workpiece(model._table, place, float(length), wrong, nominal, actual)
        assert row == pytest.approx(np.array(actual[:3]) - nominal[:3], abs=1e-11)


@pytest.mark.parametrize("alternative", [False, True])
@pytest.mark.parametrize("machine", MACHINES)
def test_derivatives_are_differences_of_the_whole_model(machine, alternative):
    model = TcpModel(replace(machine, alternative_model=alternative))
    places, lengths, errors = at_random(1, 12)
    which = [k for k, name in enumerate(ERRORS) if name[-1] in machine.chain]
    found = model.derivatives(places, lengths, errors, which)
    for column, error in enumerate(which):
        step = np.zeros(72)
        step[error] = 1e-3
        ahead, behind = (model.tips(places, lengths, errors + sign * step) for sign in (1.0, -1.0))
        assert found[:, :, column] == pytest.approx((ahead - behind) / 2e-3, abs=1e-3)
    for letter in set(machine.chain) & set("ABC"):
        moved = list(machine.centers)
        k = "ABC".index(letter)
        moved[k] = tuple(np.add(moved[k], (1.0, -2.0, 3.0)))
        other = TcpModel(replace(machine, alternative_model=alternative, centers=tuple(moved)))
        change = model.center_derivatives(places, lengths, errors, letter) @ [1.0, -2.0, 3.0]
        assert other.tips(places, lengths, errors) - model.tips(places, lengths, errors) == pytest.approx(
            change, abs=1e-9
        )


def test_known_errors_are_those_of_the_kernel():
    turn = tuple((float(q),) for q in range(0, 361, 45))
    tables = (
        ErrorTable("C0Y", (5e-5,)),
        ErrorTable("EXX", (0.0, 0.01, 0.03), "X", ((-300.0,), (0.0,), (250.0,))),
        ErrorTable("EZC", (*np.sin(np.arange(8.0)), 0.0), "C", turn),
        ErrorTable("EZB", (0.01, 0.02), "B", ((-90.0,), (90.0,))),
    )  # fmt: skip
    for errors in (
        tables,
        (*tables, ErrorTable("EYX", (1e-3, 2e-3, 3e-3, 4e-3), "XY", ((0, 0), (0, 9), (9, 0), (9, 9)))),
    ):
        model = TcpModel(replace(MACHINES[1], errors=errors))
        places = np.random.default_rng(2).uniform(-900.0, 900.0, (60, 6))
        for row, place in zip(model.known_errors(places), places.tolist(), strict=True):
            wanted = zeros(72)
            errors_at(model._pool, model._table, place, [0] * 72, wanted)
            assert row == pytest.approx(np.array(wanted), abs=1e-12)
