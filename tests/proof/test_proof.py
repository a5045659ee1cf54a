"""For a machine's tables no input and no number of cycles leads to undefined behaviour, and the analysis is awake."""

from __future__ import annotations

from pathlib import Path

import pytest
from eva import alarms, is_installed

from axcomp.lists import read_machine
from axcomp.model import fmu_sources, models

MACHINE = "rotary_table"
MUTANTS = {
    "an index beyond the delay line": ("state->line[state->head]", "state->line[state->head + 1]"),
    "an interval beyond the last": ("return int_min(int_max(low, 0), end - 1);", "return low + 1;"),
    "a cast of any number": ("if (intervals == intervals && -end < intervals && intervals < end) {", "{"),
}

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not is_installed(), reason="Frama-C is not here (Debian: frama-c-base)"),
]


def test_nothing_is_left_to_be_excluded(tmp_path: Path) -> None:
    assert alarms(read_machine(models() / MACHINE).machine, tmp_path) == []


@pytest.mark.parametrize("mutant", MUTANTS)
def test_a_defect_gives_an_alarm(mutant: str, tmp_path: Path) -> None:
    text = (fmu_sources() / "native" / "kernel.c").read_text(encoding="utf-8")
    old, new = MUTANTS[mutant]
    assert old in text
    assert alarms(read_machine(models() / MACHINE).machine, tmp_path, kernel=text.replace(old, new, 1)) != []
