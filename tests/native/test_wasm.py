"""The kernel as WebAssembly under Node gives the bits of the native one and of the one in Python."""

from __future__ import annotations

import base64
import json
import re
import shutil
import struct
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from strategies import machines

from axcomp import Engine
from axcomp.browser import columns_of, digest_of, drawn, kernel_of, proof_of
from axcomp.interface import with_causality
from axcomp.lists import read_machine
from axcomp.model import Machine, models
from axcomp.native import CompilerError, image_of, wasm_kernel
from axcomp.runtime import compile_tables

ROOT = Path(__file__).parents[2]
NODE = shutil.which("node")
MACHINES = sorted(path.name for path in models().iterdir() if any(path.glob("*.lis")))


@pytest.fixture(scope="session")
def wasm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if NODE is None:
        pytest.skip("there is no node on this machine")
    try:
        kernel = wasm_kernel()
    except CompilerError as error:
        pytest.skip(str(error))
    path = tmp_path_factory.mktemp("wasm") / "kernel.wasm"
    path.write_bytes(kernel)
    return path


def run(wasm: Path, folder: Path, jobs: Sequence[dict[str, Any]]) -> list[str]:
    (folder / "job.json").write_text(json.dumps(jobs))
    script = Path(__file__).with_name("wasm_runner.mjs")
    command = [NODE, script, ROOT / "axcomp" / "browser" / "static", wasm, folder / "job.json"]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.split("\n")[:-1]


def by_chance(wasm: Path, folder: Path, cycles: int) -> None:
    """Compare digests over all models: inputs, and what they are drawn from, are the same in Python and JavaScript."""
    proof = proof_of(cycles)
    told = run(wasm, folder, [{"kernel": one["kernel"], "cycles": cycles} for one in proof["machines"]])
    assert [int(line) for line in told] == [one["digest"] for one in proof["machines"]]
    assert len({*told}) == len(told) == 5


def test_all_models_over_inputs_by_chance(wasm: Path, tmp_path: Path) -> None:
    by_chance(wasm, tmp_path, 2_500)


@pytest.mark.slow
def test_a_million_cycles(wasm: Path, tmp_path: Path) -> None:
    by_chance(wasm, tmp_path, 200_000)


def test_the_kernel_in_python_gives_the_same_digest(wasm: Path, tmp_path: Path) -> None:
    machine = read_machine(models() / "three_axis").machine
    told = run(wasm, tmp_path, [{"kernel": kernel_of(machine), "cycles": 200}])
    assert int(told[0]) == digest_of(machine, 200)


def job_of(
    engine: Engine, rows: np.ndarray[Any, Any], inputs: Sequence[Any], folder: Path, name: str
) -> dict[str, Any]:
    rows.astype("<f8").tofile(folder / f"{name}.in")
    return {
        "image": base64.b64encode(image_of(compile_tables(engine.machine), "")).decode(),
        "inputs": [variable.reference for variable in inputs],
        "outputs": [variable.reference for variable in with_causality(engine.variables, "output")],
        "from": str(folder / f"{name}.in"),
        "to": str(folder / f"{name}.out"),
    }


def compare(wasm: Path, folder: Path, engines: Sequence[Engine], cycles: int) -> None:
    """Run machines over inputs drawn with NumPy; every output of every cycle is the same bits."""
    jobs, expected = [], []
    for number, engine in enumerate(engines):
        rng = np.random.default_rng(number)
        inputs = with_causality(engine.variables, "input")
        columns = []
        for variable in inputs:
            blocks = np.repeat(rng.uniform(-1.0, 1.0, cycles // 8 + 1), 8)[:cycles]
            if isinstance(variable.start, bool):
                columns.append((blocks > 0.9) * 1.0)
            elif isinstance(variable.start, int):
                columns.append(np.floor(blocks * 1.5 + 0.5))
            else:
                ramp = 0.0 if "coefficient" in variable.name else rng.normal(0.0, 1.0, cycles)
                size = 300.0 if "position" in variable.name or "setpoint" in variable.name else 50.0
                columns.append(1e-4 * blocks if "coefficient" in variable.name else size * blocks + ramp)
        rows = np.column_stack(columns)
        jobs.append(job_of(engine, rows, inputs, folder, str(number)))
        found = engine.run({variable.name: rows[:, k] for k, variable in enumerate(inputs)})
        outputs = with_causality(engine.variables, "output")
        expected.append(np.column_stack([found[variable.name].astype("<f8") for variable in outputs]).tobytes())
    assert run(wasm, folder, jobs) == []
    for job, bits in zip(jobs, expected, strict=True):
        assert Path(job["to"]).read_bytes() == bits


def test_every_output_of_the_models_over_other_inputs(wasm: Path, tmp_path: Path) -> None:
    compare(wasm, tmp_path, [Engine(read_machine(models() / name).machine) for name in MACHINES], 800)


@settings(max_examples=3, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(machines(), min_size=4, max_size=4))
def test_any_machine(wasm: Path, tmp_path: Path, drawn_machines: list[Machine]) -> None:
    compare(wasm, tmp_path, [Engine(machine) for machine in drawn_machines], 400)


def test_columns_are_drawn_alike_for_a_row_and_for_an_array() -> None:
    engine = Engine(models() / "three_axis")
    rows = np.arange(300, dtype=np.uint64)
    for number, column in enumerate(columns_of(engine.variables)):
        together = np.asarray(drawn(column, number, rows), dtype=float)
        assert together.tolist() == [drawn(column, number, row) for row in range(300)]


def test_images_that_are_none_are_refused_with_the_sentence_of_the_c_sources(wasm: Path, tmp_path: Path) -> None:
    (tmp_path / "empty").write_bytes(b"")
    image = image_of(compile_tables(read_machine(models() / "warm_axis").machine), "")
    damaged = [b"", b"AXCOMPT3", b"X" * 400, image[:-1], image[:400] + bytes([image[400] ^ 1]) + image[401:]]
    layout = image[:8] + struct.pack("<I", struct.unpack_from("<I", image, 8)[0] ^ 1) + image[12:]
    empty = {"inputs": [], "outputs": [], "from": str(tmp_path / "empty"), "to": str(tmp_path / "out")}
    jobs = [{"image": base64.b64encode(one).decode(), **empty} for one in (*damaged, layout)]
    assert run(wasm, tmp_path, jobs) == [
        "the image is refused: it is truncated",
        "the image is refused: it is truncated",
        "the image is refused: it is no image of axcomp's tables",
        "the image is refused: it is truncated, or has bytes too many",
        "the image is refused: it has been altered: its checksum does not fit",
        "the image is refused: it belongs to another version of axcomp",
    ]


def test_a_reference_without_variable_is_told(wasm: Path, tmp_path: Path) -> None:
    (tmp_path / "empty").write_bytes(b"")
    image = image_of(compile_tables(read_machine(models() / "warm_axis").machine), "")
    files = {"from": str(tmp_path / "empty"), "to": str(tmp_path / "out")}
    job = {"image": base64.b64encode(image).decode(), "inputs": [64 * 3 + 1], "outputs": [], **files}
    assert run(wasm, tmp_path, [job]) == ["there is no variable with the value reference 193"]


def test_the_program_on_the_page_runs(wasm: Path, tmp_path: Path) -> None:
    page = (ROOT / "docs" / "browser.md").read_text(encoding="utf-8")
    (program,) = re.findall(r"```js\n(.*?)```", page, re.DOTALL)
    (tmp_path / "program.mjs").write_text(program)
    shutil.copyfile(ROOT / "axcomp" / "browser" / "static" / "kernel.js", tmp_path / "kernel.js")
    shutil.copyfile(wasm, tmp_path / "wasm32.wasm")
    machine = read_machine(models() / "three_axis").machine
    (tmp_path / "tables.bin").write_bytes(image_of(compile_tables(machine), ""))
    done = subprocess.run([str(NODE), "program.mjs"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    numbers = [float(word) for word in re.findall(r"-?\d+\.\d+(?:e-\d+)?", done.stdout)]
    engine = Engine(machine)
    assert numbers == [engine.step({"X.setpoint": x})["X.correction"] for x in (0.0, 0.1, 0.2)]
