"""What ``axcomp bench`` says about the FMUs; how long it takes is no matter of a test."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from axcomp.bench import bench_engine, bench_fmus
from axcomp.fmu import NoCompilerError
from axcomp.lists import read_machine
from axcomp.model import models
from axcomp.native import SWITCH, compiled_kernel


@pytest.mark.slow
def test_both_fmus_are_measured_side_by_side(tmp_path: Path) -> None:
    try:
        samples = list(bench_fmus(models() / "three_axis", tmp_path, 1))
    except NoCompilerError as error:
        pytest.skip(str(error))
    assert [(sample.unit, sample.goal) for sample in samples] == [
        ("µs", 70.0),
        ("ms", None),
        ("s", 1.5),
        ("µs", None),
        ("ms", 10.0),
        ("×", 8.0),
        ("MB", 1.5),
    ]
    assert all(sample.low > 0.0 for sample in samples)
    python, _, _, native, _, ratio, _ = samples
    assert ratio.median == pytest.approx(python.median / native.median)


def test_engines_are_measured_compiled_and_in_python(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(SWITCH, raising=False)
    compiled_kernel.cache_clear()
    there_is_one = compiled_kernel() is not None
    samples = list(bench_engine(read_machine(models() / "rotary_table").machine, "it", 1, 40.0, 1.0))
    names = ["it, inputs set", *(["it in Engine.run, compiled"] if there_is_one else []), "it in Engine.run, Python"]
    assert [sample.name for sample in samples] == [f"cycle of {name}" for name in names]
    assert SWITCH not in os.environ
    assert (compiled_kernel() is not None) is there_is_one
