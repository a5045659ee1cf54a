"""Engine: names of the FMU's variables, steps and whole trajectories."""

import struct
from pathlib import Path

import numpy as np
import pytest

from axcomp import Engine, Machine
from axcomp.kinds import Cross, Friction, Leadscrew
from axcomp.model import Axis
from axcomp.native import compiled_kernel


@pytest.fixture(params=["compiled", "python"], autouse=True)
def kernel(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run every test with the compiled kernel and without."""
    if request.param == "python":
        monkeypatch.setattr("axcomp.engine.engine.compiled_kernel", lambda: None)
    elif compiled_kernel() is None:
        pytest.skip("there is no C compiler on this machine")


def machine() -> Machine:
    positions = tuple(float(x) for x in range(-50, 51, 10))
    x = Axis(
        1,
        "X",
        backlash_cycles=4,
        leadscrew=Leadscrew(positions, tuple(np.sin(positions) / 100), tuple(np.cos(positions) / 100)),
        friction=Friction((0.0, 10.0, 100.0), (1.0, 2.0, 5.0), reversal_lookahead=2, delay_cycles=3),
    )
    z = Axis(3, "Z", cross=Cross(1, positions, tuple(np.cos(positions) / 50), n_cycles=5))
    return Machine((x, z))


def trajectory(cycles: int) -> dict[str, np.ndarray]:
    t = 1e-3 * np.arange(cycles)
    return {
        "X.setpoint": 40 * np.sin(3 * t),
        "X.velocity": 120 * np.cos(3 * t),
        "Z.setpoint": np.where(t < 0.1, 0.0, t - 0.1),
        "Z.cross.switch": np.where((t < 0.05) | (t > 0.3), 1, -1),
    }


def bits(values: dict[str, object]) -> bytes:
    return b"".join(struct.pack("d", float(value)) for value in values.values())


def test_a_run_gives_the_same_bits_as_as_many_steps() -> None:
    cycles = 5000  # more than one chunk
    inputs = trajectory(cycles)
    run = Engine(machine()).run(inputs)
    stepped = Engine(machine())
    for k in range(cycles):
        outputs = stepped.step({name: values[k] for name, values in inputs.items()})
        assert bits(outputs) == bits({name: run[name][k] for name in outputs}), k


def test_two_runs_continue_each_other() -> None:
    inputs = trajectory(600)
    whole = Engine(machine()).run(inputs)
    engine = Engine(machine())
    first = engine.run({name: values[:250] for name, values in inputs.items()})
    second = engine.run({name: values[250:] for name, values in inputs.items()})
    for name, values in whole.items():
        assert np.array_equal(values, np.concatenate([first[name], second[name]]))
    assert np.array_equal(whole.time, np.concatenate([first.time, second.time]))


def test_the_corrected_setpoint_is_the_setpoint_minus_the_leadscrew_table() -> None:
    leadscrew = machine().axes[0].leadscrew
    assert leadscrew is not None
    x = np.linspace(-60, 60, 333)
    result = Engine(machine()).run({"X.setpoint": x})
    expected = x - np.interp(x, leadscrew.positions, leadscrew.positive)
    np.testing.assert_allclose(result["X.corrected_setpoint"], expected, rtol=0, atol=1e-14)


def test_an_unknown_name_is_refused_with_the_known_ones() -> None:
    engine = Engine(machine())
    with pytest.raises(KeyError, match=r"X\.setpont is no input; the inputs are .*X\.setpoint"):
        engine.step({"X.setpont": 1.0})
    with pytest.raises(KeyError, match=r"X\.current is no input"):
        engine.run({"X.current": [1.0]})


@pytest.mark.parametrize(
    "columns", [{}, {"X.setpoint": [1.0], "Z.setpoint": [1.0, 2.0]}, {"X.setpoint": [[1.0], [2.0]]}]
)
def test_columns_that_do_not_fit_are_refused(columns: dict[str, list[float]]) -> None:
    with pytest.raises(ValueError, match="trajectory"):
        Engine(machine()).run(columns)


def test_a_result_written_as_csv_reads_back_to_the_same_bits(tmp_path: Path) -> None:
    result = Engine(machine()).run(trajectory(300))
    result.to_csv(tmp_path / "result.csv")
    table = np.genfromtxt(tmp_path / "result.csv", delimiter=",", names=True, deletechars="")
    assert table.dtype.names == ("time", *result)
    for name, values in result.items():
        assert np.array_equal(table[name], values.astype(float))


def test_flat_names_are_the_same_variables() -> None:
    structured, flat = Engine(machine()), Engine(machine(), naming="flat")
    structured.step({"X.setpoint": 5.0})
    flat.step({"X_setpoint": 5.0})
    assert list(structured.get().values()) == list(flat.get().values())
    assert "X_leadscrew_correction" in flat.get()
