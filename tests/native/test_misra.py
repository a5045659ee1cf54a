"""What cppcheck finds against MISRA C:2012 in the kernel is what the documentation lists, with reasons."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from axcomp.model import fmu_sources

PAGE = Path(__file__).parents[2] / "docs" / "misra.md"
ADVISORY = {"8.7", "12.1", "12.3", "15.5", "17.8"}


@pytest.mark.slow
def test_all_findings_are_listed() -> None:
    if not shutil.which("cppcheck"):
        pytest.skip("cppcheck is not installed")
    page = PAGE.read_text(encoding="utf-8")
    (command,) = re.findall(r"^cppcheck .*$", page, re.MULTILINE)
    run = subprocess.run(
        shlex.split(command), cwd=fmu_sources() / "native", capture_output=True, text=True, check=False
    )
    if "addon" in run.stdout + run.stderr and "misra-c2012" not in run.stderr:
        pytest.skip(f"the addon does not run: {run.stdout}{run.stderr}")
    found = Counter(re.findall(r"^misra-c2012-([\d.]+)$", run.stderr, re.MULTILINE))
    assert found.keys() >= ADVISORY
    listed = {rule: int(places) for rule, places in re.findall(r"^\| ([\d.]+) \| (\d+) \|", page, re.MULTILINE)}
    assert {rule: places for rule, places in found.items() if rule not in ADVISORY} == listed
