"""What holds for any machine and any motion."""

import numpy as np
from driving import OUTPUTS, drive
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from strategies import machines

from axcomp.kinds import KIND_NAMES, Backlash, Cross, Crosstalk, CrosstalkCurve, Friction, Leadscrew, Plane, Temperature
from axcomp.model import Axis, Machine, ModuloRange
from axcomp.runtime import Runtime

EVENTS = ("referenced", "no_move", *(f"{kind}_on" for kind in KIND_NAMES))


def anything(machine: Machine, seed: int, cycles: int = 90) -> dict[str, NDArray[np.float64]]:
    """Motion with stops and reversals around the tables, and switches that are thrown now and then."""
    rng = np.random.default_rng(seed)
    columns: dict[str, NDArray[np.float64]] = {name: rng.random(cycles) < 0.02 for name in ("reset", "program_end")}
    for axis in machine.axes:
        stands = np.repeat(rng.random(cycles // 10 + 1) < 0.4, 10)[:cycles]
        v = np.where(stands, 0.0, rng.choice([1e-6, 1.0, 1e3, 1e6]) * rng.standard_normal(cycles))
        centre = rng.choice([0.0, 1.0, 1000.0, 1e5]) * rng.standard_normal()
        columns[f"{axis.name}.setpoint"] = centre + np.cumsum(v) * 1e-3
        columns[f"{axis.name}.velocity"] = v
        columns[f"{axis.name}.acceleration"] = 1e4 * rng.standard_normal(cycles)
        columns[f"{axis.name}.actual_position"] = rng.standard_normal(cycles)
        for event in EVENTS:
            columns[f"{axis.name}.{event}"] = (np.cumsum(rng.random(cycles) < 0.05) + (rng.random() < 0.3)) % 2 == 0
    return columns


seeds = st.integers(0, 2**32 - 1)
few = settings(max_examples=12)


def same(one: dict[str, NDArray[np.float64]], other: dict[str, NDArray[np.float64]], rows: slice = slice(None)) -> bool:
    """Whether two runs are equal bit by bit."""
    return all(one[name][rows].tobytes() == other[name][rows].tobytes() for name in one)


@few
@given(machines(), seeds)
def test_the_same_inputs_give_the_same_bits(machine: Machine, seed: int) -> None:
    columns = anything(machine, seed)
    assert same(drive(machine, columns), drive(machine, columns))


@few
@given(machines(), seeds, st.integers(0, 89))
def test_save_go_on_restore_go_on_gives_the_same_bits_at_any_cycle(machine: Machine, seed: int, at: int) -> None:
    columns = anything(machine, seed)
    before = {name: column[:at] for name, column in columns.items()}
    after = {name: column[at:] for name, column in columns.items()}
    runtime = Runtime(machine)
    drive(runtime, before)
    snapshot = runtime.save()
    first = drive(runtime, after)
    runtime.restore(snapshot)
    second = drive(runtime, after)
    another = Runtime(machine)
    another.restore(snapshot)
    assert same(first, second)
    assert same(first, drive(another, after))
    assert same(first, {name: values[at:] for name, values in drive(machine, columns).items()})


@few
@given(machines(), machines(), seeds)
def test_two_runtimes_never_influence_each_other(machine: Machine, other: Machine, seed: int) -> None:
    columns, foreign = anything(machine, seed), anything(other, seed + 1)
    alone = drive(machine, columns)
    one, two, twin = Runtime(machine), Runtime(other), Runtime(machine)
    kept: list[dict[str, NDArray[np.float64]]] = []
    for k in range(0, 90, 7):
        rows = slice(k, k + 7)
        kept.append(drive(one, {name: column[rows] for name, column in columns.items()}))
        drive(two, {name: column[rows] for name, column in foreign.items()})
        drive(twin, {name: column[::-1][rows] for name, column in columns.items()})
    together = {name: np.concatenate([part[name] for part in kept]) for name in alone}
    assert same(alone, together)


@few
@given(machines(), seeds, st.sampled_from([float("nan"), float("inf"), float("-inf"), 1e15, -1e300]))
def test_whatever_the_inputs_no_output_is_not_finite(machine: Machine, seed: int, bad: float) -> None:
    rng = np.random.default_rng(seed)
    columns = anything(machine, seed)
    for name in columns:
        if name.rpartition(".")[2] in ("setpoint", "velocity", "acceleration", "actual_position"):
            columns[name] = np.where(rng.random(90) < 0.1, bad, columns[name] * rng.choice([1.0, 1e8]))
    run = drive(machine, columns)
    assert all(np.isfinite(values).all() for values in run.values())


def masters_of(axis: Axis) -> set[int]:
    """Logical numbers of the axes whose motion or reference an axis' outputs depend on."""
    numbers = {axis.number}
    for compensation in axis.compensations:
        for field in ("master", "master1", "master2", "adaptation1", "adaptation2"):
            number = getattr(compensation, field, None)
            if number is not None:
                numbers.add(number)
    return numbers


@few
@given(machines(), seeds, st.data())
def test_an_axis_disturbs_only_those_whose_master_it_is(machine: Machine, seed: int, data: st.DataObject) -> None:
    columns = anything(machine, seed)
    good = drive(machine, columns)
    broken = data.draw(st.sampled_from(machine.axes))
    columns[f"{broken.name}.setpoint"] = np.where(np.arange(90) % 3 == 0, np.nan, 7.0)
    columns[f"{broken.name}.referenced"] = ~columns[f"{broken.name}.referenced"]
    run = drive(machine, columns)
    for axis in machine.axes:
        if broken.number not in masters_of(axis):
            assert same(
                {field: run[f"{axis.name}.{field}"] for field in OUTPUTS},
                {field: good[f"{axis.name}.{field}"] for field in OUTPUTS},
            )


def steepest(x: tuple[float, ...], y: tuple[float, ...]) -> float:
    return max((abs(d / e) for d, e in zip(np.diff(y), np.diff(x), strict=True)), default=0.0)


def largest_step(cycles: int) -> float:
    """Return the largest difference of two consecutive weights of sin²."""
    n = max(cycles, 1)
    return float(np.max(np.diff(np.sin(np.pi / 2 * np.arange(n + 1) / n) ** 2)))


positions = tuple(float(p) for p in np.linspace(-50, 50, 11))
small = st.tuples(*[st.floats(-0.1, 0.1)] * 11)


@few
@given(small, small, small, small, st.integers(0, 20), st.integers(0, 20), st.booleans(), seeds)
def test_no_step_is_larger_than_slopes_ramps_and_reversals_allow(
    cross, plane, positive, negative, n: int, backlash: int, modulo: bool, seed: int
) -> None:
    z = Axis(
        3,
        "Z",
        modulo=ModuloRange(-50.0, 60.0) if modulo else None,
        backlash_cycles=backlash,
        cross=Cross(1, positions, cross, n),
        plane=Plane(1, 2, -50.0, -50.0, 10.0, 20.0, (plane, positive, negative), n),
        crosstalk=CrosstalkCurve(1, (-1e3, 0.0, 1e3), (-0.02, 0.0, 0.03), n),
        leadscrew=Leadscrew(positions, positive, negative, modulo=modulo, without_other_compensations=True),
    )
    machine = Machine((Axis(1, "X"), Axis(2, "Y"), z))
    columns = anything(machine, seed, 200)
    for name in list(columns):
        if name in ("Z.referenced", "Z.leadscrew_on"):
            columns[name] = np.ones(200, bool)  # the leadscrew's switch and the loss of its reference act at once
    for name in "XYZ":
        columns[f"{name}.setpoint"] = np.clip(columns[f"{name}.setpoint"], -70.0, 70.0)
    x, y, s = (np.abs(np.diff(columns[f"{name}.setpoint"])) for name in "XYZ")
    a = np.abs(np.diff(np.clip(columns["X.acceleration"], -1e3, 1e3)))
    run = drive(machine, columns)

    grid = np.abs([plane, positive, negative])
    slope1 = np.max(np.abs(np.diff([plane, positive, negative], axis=1))) / 10.0
    slope2 = np.max(np.abs(np.diff([plane, positive, negative], axis=0))) / 20.0
    closed = [(*values, values[0]) if modulo else values for values in (positive, negative)]
    points = (*positions, 60.0) if modulo else positions
    slope = max(steepest(points, values) for values in closed)
    moving = steepest(positions, cross) * x + slope1 * x + slope2 * y + 3e-5 * a + (1 + slope) * s
    weight = largest_step(n)
    switching = weight * (np.max(np.abs(cross)) + np.max(grid) + 0.03)
    reversal = largest_step(backlash) * np.max(np.abs(np.subtract(positive, negative)))
    released = largest_step(max(n, backlash)) * np.max(np.abs(run["Z.setpoint_shift"]))
    bound = moving + switching + reversal + released + 1e-9
    assert (np.abs(np.diff(run["Z.corrected_setpoint"])) <= bound).all()


@few
@given(machines(), seeds)
def test_whatever_is_off_does_not_correct(machine: Machine, seed: int) -> None:
    run = drive(machine, anything(machine, seed))
    for axis in machine.axes:
        for kind in KIND_NAMES:
            off = ~run[f"{axis.name}.{kind}_active"]
            assert not run[f"{axis.name}.{kind}_correction"][off].any()


@few
@given(machines(), seeds)
def test_no_correction_is_larger_than_the_largest_value_of_its_table(machine: Machine, seed: int) -> None:
    columns = anything(machine, seed)
    run = drive(machine, columns)
    for axis in machine.axes:
        for compensation in axis.compensations:
            output = "current" if compensation.kind == "friction" else f"{compensation.kind}_correction"
            setpoints = columns[f"{axis.name}.setpoint"]
            bound = max(abs(value) for value in values_of(compensation, setpoints))
            assert np.abs(run[f"{axis.name}.{output}"]).max() <= bound * (1 + 1e-6) + 1e-12


def values_of(compensation: object, setpoints: NDArray[np.float64]) -> list[float]:
    match compensation:
        case Temperature():
            growth = compensation.coefficient * (setpoints - compensation.position)
            return (compensation.offset + growth).tolist()
        case Backlash():
            return [compensation.amount]
        case Leadscrew():
            return [*compensation.positive, *(compensation.negative or ())]
        case Plane():
            return [value for row in compensation.corrections for value in row]
        case Friction():
            return [compensation.scaling * current for current in compensation.currents]
        case Crosstalk():
            return [
                value
                for test in compensation.tests
                for value in (
                    test.accelerate_positive, test.accelerate_negative,
                    test.decelerate_positive, test.decelerate_negative,
                )
            ]  # fmt: skip
        case Cross() | CrosstalkCurve():
            return list(compensation.corrections)
    raise TypeError(compensation)
