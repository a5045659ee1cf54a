"""A few seconds of each fuzzer; ``python -m tests.fuzz`` runs them for hours."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from axcomp.cli import main
from axcomp.lists import read_machine
from axcomp.saving import write_whole
from tests.fuzz import native
from tests.fuzz.lists import documents_of, try_case


@pytest.mark.parametrize("part", range(4))
def test_lists_that_keep_to_the_grammar_can_be_read_built_and_run(part: int) -> None:
    told = {try_case(case) for case in range(40 * part, 40 * part + 40)}
    assert {"faultless", "errors"} <= told


def test_what_check_passes_is_built_and_runs(tmp_path: Path) -> None:
    """The same through the commands, of the first lists that have no error."""
    tried = 0
    for case in range(100):
        folder = tmp_path / str(case)
        folder.mkdir()
        for document in documents_of(case):
            write_whole(folder / document.path, document.data)
        if main(["check", str(folder)]) or not read_machine(folder).machine.axes:
            continue
        assert main(["build", "--runtime", "python", "--machine", str(folder), "--output", str(folder / "x.fmu")]) == 0
        assert main(["build", "--machine", str(folder), "--image", str(folder / "x.bin")]) == 0
        tried += 1
        if tried == 6:
            return
    raise AssertionError(tried)


@pytest.fixture(scope="module")
def fuzzer(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[Path]]:
    if os.name == "nt" or native.compiler() is None:
        pytest.skip("there is no compiler with sanitizers on this machine")
    folder = tmp_path_factory.mktemp("fuzz")
    return native.build(folder), native.seed_images(folder)


@pytest.mark.parametrize("what", ["images", "states", "calls"])
def test_what_is_accepted_never_leaves_its_memory(what: str, fuzzer: tuple[Path, list[Path]]) -> None:
    program, images = fuzzer
    said = native.run(program, what, 10**9, 4.0, 0, images)
    tried, _, accepted, _ = said.replace(",", "").split()
    assert int(tried) > 50
    assert what == "calls" or int(accepted) > int(tried) / 20
