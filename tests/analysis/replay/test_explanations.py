"""Traces that were made with one thing changed: the comparison finds what it is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from traces import best, compared, example, having, recorded

from axcomp.engine import Engine
from axcomp.kinds import KINDS, Backlash
from axcomp.model import Machine

ROUNDED = 0.06
"""µm: half a step of 0.1 µm, and what setpoints of 1 nm make of it."""

EVERY = [
    (axis.name, one.kind, f"{axis.name}.current" if one.kind == "friction" else f"{axis.name}.correction")
    for axis in example()[0].axes
    for one in axis.compensations
]


@pytest.mark.parametrize(("name", "kind", "output"), EVERY)
def test_an_inverted_sign_is_found(tmp_path: Path, name: str, kind: str, output: str) -> None:
    machine, columns = example()
    other = having(machine, name, KINDS[kind].scaled(getattr(machine.axis(name), kind), -1.0))
    found = compared(tmp_path, machine, recorded(other, columns, output))[output]
    assert best(found) == f"the sign of the {kind} compensation inverted"


@pytest.mark.parametrize(("name", "kind", "output"), EVERY)
def test_a_kind_that_is_off_is_found(tmp_path: Path, name: str, kind: str, output: str) -> None:
    machine, columns = example()
    other = Engine(having(machine, name, **{kind: None})).run(columns)
    trace = {**columns, output: other.get(output, np.zeros(other.cycles))}
    assert best(compared(tmp_path, machine, trace)[output]) == f"the {kind} compensation off"


@pytest.mark.parametrize(("alone", "text"), [(True, "without the other"), (False, "with the other")])
def test_the_order_of_the_leadscrew_is_found(tmp_path: Path, alone: bool, text: str) -> None:
    """Corrections of a few mm, for those of a few µm make no difference to a leadscrew table."""
    machine, columns = example()
    axis = machine.axis("X")
    screw = KINDS["leadscrew"].scaled(axis.leadscrew, 20.0)
    machine = having(machine, "X", KINDS["plane"].scaled(axis.plane, 100.0), screw)
    trace = recorded(having(machine, "X", replace(screw, without_other_compensations=alone)), columns, "X.correction")
    found = compared(tmp_path, having(machine, "X", replace(screw, without_other_compensations=not alone)), trace)
    assert text in best(found["X.correction"])
    assert found["X.correction"].explanations[0].left < ROUNDED


def test_interchanged_directions_of_the_leadscrew_are_found(tmp_path: Path) -> None:
    machine, columns = example()
    screw = machine.axis("X").leadscrew
    swapped = having(machine, "X", replace(screw, positive=screw.negative, negative=screw.positive))
    found = compared(tmp_path, machine, recorded(swapped, columns, "X.correction"))["X.correction"]
    assert best(found) == "the leadscrew's positive and negative tables interchanged"
    unilateral = having(machine, "X", replace(screw, negative=None))
    found = compared(tmp_path, machine, recorded(unilateral, columns, "X.correction"))["X.correction"]
    assert best(found) == "the leadscrew's positive table for both directions"


def test_interchanged_directions_of_crosstalk_are_found(tmp_path: Path) -> None:
    machine, columns = example()
    crosstalk = machine.axis("Y").crosstalk
    tests = tuple(
        replace(
            t,
            accelerate_positive=3.0 * t.accelerate_negative,
            accelerate_negative=t.accelerate_positive,
            decelerate_positive=3.0 * t.decelerate_negative,
            decelerate_negative=t.decelerate_positive,
        )
        for t in crosstalk.tests
    )
    other = tuple(replace(t, accelerate_negative=3.0 * t.accelerate_negative,
                          decelerate_negative=3.0 * t.decelerate_negative) for t in crosstalk.tests)  # fmt: skip
    trace = recorded(having(machine, "Y", replace(crosstalk, tests=tests)), columns, "Y.correction")
    found = compared(tmp_path, having(machine, "Y", replace(crosstalk, tests=other)), trace)["Y.correction"]
    assert best(found) == "the crosstalk's positive and negative values interchanged"


@pytest.mark.parametrize("mode", [1, 2])
def test_the_other_mode_of_backlash_is_found(tmp_path: Path, mode: int) -> None:
    machine, columns = example()
    trace = recorded(having(machine, "X", Backlash(0.012, 3 - mode)), columns, "X.correction")
    found = compared(tmp_path, having(machine, "X", Backlash(0.012, mode)), trace)["X.correction"]
    assert best(found) == f"backlash mode {3 - mode} instead of {mode}"


@pytest.mark.parametrize("cycles", [0, 4])
def test_another_delay_of_the_friction_current_is_found(tmp_path: Path, cycles: int) -> None:
    machine, columns = example()
    friction = replace(machine.axis("X").friction, delay_cycles=1, reversal_lookahead=0)
    machine = having(machine, "X", friction)
    trace = recorded(having(machine, "X", replace(friction, delay_cycles=cycles)), columns, "X.current")
    found = compared(tmp_path, machine, trace)["X.current"]
    assert best(found) == f"delay_cycles {cycles} instead of 1"


@pytest.mark.parametrize(("cycles", "text"), [(3, "3 cycles later"), (1, "1 cycle later"), (-2, "2 cycles earlier")])
def test_outputs_of_another_cycle_are_found(tmp_path: Path, cycles: int, text: str) -> None:
    machine, columns = example()
    trace = recorded(machine, columns, "Y.corrected_setpoint")
    values = trace["Y.corrected_setpoint"]
    trace["Y.corrected_setpoint"] = values[np.clip(np.arange(len(values)) - cycles, 0, len(values) - 1)]
    found = compared(tmp_path, machine, trace)["Y.corrected_setpoint"]
    assert best(found) == f"the engine's output {text}"
    assert found.explanations[0].left < ROUNDED


def switched(columns: dict[str, np.ndarray]) -> int:
    """Switch the plane off while all axes stand between two moves; return the cycle."""
    still = np.flatnonzero(columns["X.velocity"][100:700] == 0.0) + 100
    cycle = int(still[2])
    assert (columns["X.velocity"][cycle - 1 : cycle + 12] == 0.0).all()
    columns["X.plane.switch"] = np.where(np.arange(len(columns["X.velocity"])) < cycle, 0.0, -1.0)
    return cycle


def test_a_switch_without_its_ramp_is_found(tmp_path: Path) -> None:
    machine, columns = example()
    switched(columns)
    other = having(machine, "X", replace(machine.axis("X").plane, n_cycles=0))
    found = compared(tmp_path, machine, recorded(other, columns, "X.correction"))["X.correction"]
    assert best(found) == "the plane compensation switched at once (n_cycles 0 instead of 10)"


def test_a_linear_ramp_of_a_switch_is_found(tmp_path: Path) -> None:
    machine, columns = example()
    cycle = switched(columns)
    always = recorded(machine, {k: v for k, v in columns.items() if "plane" not in k}, "X.plane.correction")
    trace = recorded(machine, columns, "X.correction", "X.leadscrew.correction")
    weight = np.clip(1.0 - (np.arange(len(columns["X.setpoint"])) - cycle + 1) / 10.0, 0.0, 1.0)
    trace["X.correction"] = trace.pop("X.leadscrew.correction") + weight * always["X.plane.correction"]
    found = compared(tmp_path, machine, trace)["X.correction"]
    assert found.time[found.row] - cycle * 0.001 < 0.011
    assert best(found) == "a linear instead of the sin² ramp of the plane compensation"
    assert found.explanations[0].left < ROUNDED


def reversal_share(ways: np.ndarray, cycles: int) -> np.ndarray:
    """Return how far an axis has changed from its positive (0) to its negative (1) values, linear in the cycles."""
    share, step, forward = np.empty(len(ways)), 0, True
    for k, way in enumerate(ways):
        forward = way > 0.0 if abs(way) > 1e-9 else forward
        step = min(max(step + (-1 if forward else 1), 0), cycles)
        share[k] = step / cycles
    return share


def test_a_linear_ramp_of_the_leadscrews_reversal_is_found(tmp_path: Path) -> None:
    machine, columns = example()
    screw = machine.axis("X").leadscrew
    trace = recorded(machine, columns, "X.plane.correction")
    plane = trace.pop("X.plane.correction")
    up, down = (
        np.interp(columns["X.setpoint"] + plane, screw.positions, side) for side in (screw.positive, screw.negative)
    )
    share = reversal_share(np.diff(columns["X.setpoint"], prepend=columns["X.setpoint"][0]), 20)
    trace["X.correction"] = plane - (up + share * (down - up))
    found = compared(tmp_path, machine, trace, within={"": 0.07})["X.correction"]
    assert best(found) == "a linear instead of the sin² ramp of the leadscrew compensation"
    assert found.explanations[0].left < ROUNDED


@pytest.mark.parametrize("mode", [1, 2])
def test_a_linear_ramp_of_backlash_is_found(tmp_path: Path, mode: int) -> None:
    machine, columns = example()
    machine = having(machine, "X", Backlash(0.02, mode), leadscrew=None)
    trace = recorded(machine, columns, "X.plane.correction")
    if mode == 1:
        offset = -0.02 * reversal_share(columns["X.velocity"] * 0.001, 20)
    else:
        # Nothing is added before any motion: like a motion in negative direction before the first cycle.
        offset = 0.02 * reversal_share(-columns["X.velocity"] * 0.001, 20)
    trace["X.correction"] = trace.pop("X.plane.correction") + offset
    found = compared(tmp_path, machine, trace)["X.correction"]
    assert best(found) == "a linear instead of the sin² ramp of the backlash compensation"
    assert found.explanations[0].left < ROUNDED


def test_reversals_without_their_ramp_are_found(tmp_path: Path) -> None:
    machine, columns = example()
    trace = recorded(having(machine, "X", backlash_cycles=0), columns, "X.correction")
    found = compared(tmp_path, machine, trace)["X.correction"]
    assert best(found) == "reversals at once (n_backlash_cyc 0 instead of 20)"


def test_masters_that_count_with_their_corrections_are_found(tmp_path: Path) -> None:
    machine, columns = example()
    machine = having(machine, "X", KINDS["plane"].scaled(machine.axis("X").plane, 200.0))
    cross = KINDS["cross"].scaled(machine.axis("Z").cross, 10.0)
    machine = having(machine, "Z", cross)
    trace = recorded(machine, columns, "X.corrected_setpoint", "Z.correction", "Z.cross.correction")
    wrong = np.interp(trace.pop("X.corrected_setpoint"), cross.positions, cross.corrections)
    trace["Z.correction"] += wrong - trace.pop("Z.cross.correction")
    found = compared(tmp_path, machine, trace)["Z.correction"]
    assert best(found) == "the cross compensation taking the corrected position of X (order)"


def rotary() -> tuple[Machine, dict[str, np.ndarray]]:
    machine, columns = example("rotary_table")
    columns["C.setpoint"] = np.degrees(np.unwrap(np.radians(columns["C.setpoint"])))
    return machine, columns


def test_positions_that_are_not_folded_are_found(tmp_path: Path) -> None:
    machine, columns = rotary()
    plain = having(machine, "C", replace(machine.axis("C").leadscrew, modulo=False), modulo=None)
    found = compared(tmp_path, machine, recorded(plain, columns, "C.correction"))["C.correction"]
    assert best(found) == "positions of C that are not folded (no modulo)"
    folded = having(machine, "C", replace(machine.axis("C").leadscrew, modulo=False))
    found = compared(tmp_path, plain, recorded(folded, columns, "C.correction"))["C.correction"]
    assert best(found) == "positions of C that are folded (modulo)"


def test_a_table_that_does_not_repeat_is_found(tmp_path: Path) -> None:
    """Half a turn of table: one that repeats bridges the other half, one that does not holds its end."""
    machine, columns = rotary()
    screw = machine.axis("C").leadscrew
    kept = [k for k, place in enumerate(screw.positions) if place <= 345.0]
    short = {name: tuple(getattr(screw, name)[k] for k in kept) for name in ("positions", "positive", "negative")
             if getattr(screw, name) is not None}  # fmt: skip
    machine = having(machine, "C", replace(screw, **short))
    held = having(machine, "C", replace(screw, **short, modulo=False))
    found = compared(tmp_path, machine, recorded(held, columns, "C.correction"))["C.correction"]
    assert best(found) == "the leadscrew table not repeated (modulo 0)"


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"negate": "Y"}, "the sign of volumetric[1] inverted"),
        ({"filter_steps": 0}, "volumetric[1] switched at once (filter_steps 0)"),
        (None, "volumetric[1] off"),
    ],
)
def test_volumetric_compensations_are_tried_too(tmp_path: Path, change: dict[str, object] | None, text: str) -> None:
    machine, columns = example("five_axis")
    volumes = [v if v.index != 1 else change and replace(v, **change) for v in machine.volumetric]
    other = replace(machine, volumetric=tuple(filter(None, volumes)))
    known = {variable.name for variable in Engine(other).variables}
    values = Engine(other).run({name: column for name, column in columns.items() if name in known})["Y.correction"]
    found = compared(tmp_path, machine, {**columns, "Y.correction": values})["Y.correction"]
    assert best(found) == text


def test_what_nothing_explains_is_said(tmp_path: Path) -> None:
    machine, columns = example()
    trace = recorded(machine, columns, "X.correction")
    trace["X.correction"] = trace["X.correction"] + 0.01 * np.sin(np.arange(len(trace["X.correction"])) ** 1.5)
    found = compared(tmp_path, machine, trace)["X.correction"]
    assert found.explanations == ()
    assert "no sign, order, ramp or delay that was tried explains it" in found.sentence()


def test_a_start_that_differs_is_not_taken_for_a_delay(tmp_path: Path) -> None:
    """A delay of three cycles cannot be compared in the first three: what differs there is not explained by it."""
    machine, columns = example()
    trace = recorded(machine, columns, "X.correction")
    trace["X.correction"][:3] += 0.01
    found = compared(tmp_path, machine, trace)["X.correction"]
    assert found.row < 3
    assert found.explanations == ()
    assert compared(tmp_path, machine, trace, skip=0.003)["X.correction"].agrees
