"""What the page shows of lists, without a browser."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from axcomp.browser import look, shown
from axcomp.cli import main
from axcomp.model import models

ROOT = Path(__file__).parents[2]
PROGRAM = """
import json, sys
for name in ("numpy", "scipy", "matplotlib", "fmpy", "ctypes.util"):
    sys.modules[name] = None
from axcomp.browser import digest_of, look, shown
for path in sys.argv[1:]:
    found = look(path)
    assert json.loads(shown(found, path))["machines"]
    assert digest_of(found[0].machine, 5)
"""


def test_it_needs_the_standard_library_only() -> None:
    """In a browser there is nothing else: volumetric machines are judged too."""
    paths = [str(models() / name) for name in ("three_axis", "five_axis", "rotary_table", "warm_axis")]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    subprocess.run([sys.executable, "-c", PROGRAM, *paths], env=environment, check=True)


@pytest.mark.parametrize("name", ["manual_examples", "five_axis", "measurements"])
def test_findings_and_summary_are_those_of_the_command_line(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(models())
    told = json.loads(shown(look(name), name))
    main(["check", "--format", "json", name])
    assert told["check"] == json.loads(capsys.readouterr().out)
    main(["check", name])
    assert told["text"] == capsys.readouterr().out
    assert set(told["codes"]) == {finding["code"] for finding in told["check"]["findings"]}


def test_every_table_is_there_with_its_numbers() -> None:
    told = json.loads(shown(look(str(models() / "three_axis")), str(models() / "three_axis")))
    (machine,) = told["machines"]
    assert [axis["name"] for axis in machine["axes"]] == ["X", "Y", "Z"]
    shapes = {table["title"]: [part["shape"] for part in table["parts"]] for table in machine["tables"]}
    assert shapes["X: plane compensation"] == ["grid"]
    assert shapes["Y: crosstalk compensation"] == ["scatter"] * 4
    (leadscrew,) = (table for table in machine["tables"] if table["title"] == "X: leadscrew error compensation")
    positive = leadscrew["parts"][0]
    # In the list, 0.1 µm: table[7].pos.
    text = (models() / "three_axis" / "achskw1.lis").read_text(encoding="latin-1")
    (line,) = (line for line in text.splitlines() if line.startswith("kw.ssfk.table[7].pos"))
    assert positive["y"][7] == pytest.approx(0.1 * float(line.split()[1]))
    assert positive["of"]["unit"] == "µm"


def test_what_is_no_machine_has_its_finding_and_no_kernel() -> None:
    told = json.loads(shown(look(str(models() / "measurements")), str(models() / "measurements")))
    assert [finding["code"] for finding in told["check"]["findings"]] == ["AXC-MISSING"]
    assert [(machine["kernel"], machine["axes"]) for machine in told["machines"]] == [(None, [])]
