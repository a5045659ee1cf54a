"""FMPy's own command reproduces the expected output of the example machines with the FMUs built from their lists."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from axcomp.demo.examples import EXPECTED, INPUT, TRAJECTORIES, read_csv
from axcomp.fmu import package_axcomp
from axcomp.model import models


@pytest.mark.parametrize("name", sorted(TRAJECTORIES))
def test_fmpy_simulate_reproduces_the_expected_output(name: str, tmp_path: Path) -> None:
    model, output = models() / name, tmp_path / "output.csv"
    fmu = package_axcomp(model, tmp_path).path
    command = ["simulate", str(fmu), "--input-file", str(model / INPUT), "--output-file", str(output)]
    subprocess.run([sys.executable, "-m", "fmpy", *command], cwd=tmp_path, capture_output=True, check=False)
    # The file counts, not the exit status: pythonfmu may abort while the process exits.
    output.write_text(output.read_text().replace("True", "1").replace("False", "0"))
    simulated, expected = read_csv(output), read_csv(model / EXPECTED)
    assert set(simulated) == set(expected)
    for column, values in expected.items():
        assert simulated[column].shape == values.shape
        assert np.allclose(simulated[column], values, rtol=0.0, atol=1e-8), column
