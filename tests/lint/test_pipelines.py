"""Hook, action and container recipe: what they call is there. They are read as text; what they run is run here."""

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml
from linting import Write
from small_lists import LEADSCREW

from axcomp.cli import COMMANDS, main

ROOT = Path(__file__).parents[2]


def test_the_hooks_call_commands_that_are_there(write: Write) -> None:
    hooks = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text())
    assert [hook["id"] for hook in hooks] == ["axcomp-check", "axcomp-format"]
    write({"achskw1.lis": LEADSCREW.replace("pos 2", "pos x")})
    for hook, status in zip(hooks, (1, 0), strict=True):
        assert {"id", "name", "entry", "language", "files"} <= set(hook)
        assert all(re.search(hook["files"], name) for name in ("a/achskw1.LIS", "b.tsproj", "c.xti"))
        assert not re.search(hook["files"], "lis.py")
        program, *words = [*hook["entry"].split(), *hook["args"]]
        assert program == "axcomp"
        assert main(words) == status


def test_the_action_checks_what_it_is_given(write: Write) -> None:
    action: dict[str, Any] = yaml.safe_load((ROOT / "action.yml").read_text())
    assert action["runs"]["using"] == "composite"
    *_, check = action["runs"]["steps"]
    given = {name: re.fullmatch(r"\$\{\{ inputs\.([\w-]+) \}\}", value) for name, value in check["env"].items()}
    names = {found[1] for found in given.values() if found}
    assert names | {"python-version"} == set(action["inputs"])
    # Nothing of the inputs is written into the script itself.
    assert "${{" not in check["run"]
    folder = write({"a b/achskw1.lis": LEADSCREW, "c/achskw1.lis": LEADSCREW.replace("pos 2", "pos x")})
    environment = {
        "AXCOMP_PATHS": "c",
        "AXCOMP_FORMAT": "github",
        "AXCOMP_OUTPUT": "",
        "AXCOMP_ARGUMENTS": "--ignore AXC-OTHERS",
        "PATH": "/usr/bin:/bin",
        "PYTHONPATH": str(ROOT),
    }
    program = (
        f'axcomp() {{ "{sys.executable}" -c "import sys; from axcomp.cli import main; sys.exit(main())" "$@"; }}\n'
    )
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", program + check["run"]],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1, done.stderr
    assert done.stdout.startswith("::error file=c/achskw1.lis,line=6")


def test_the_container_is_made_of_what_is_there() -> None:
    text = (ROOT / "Containerfile").read_text()
    for source in re.findall(r"^COPY (?!--)(.+) \S+$", text, re.MULTILINE):
        for name in source.split():
            assert (ROOT / name).exists(), name
    stages = re.findall(r"^FROM (\S+)", text, re.MULTILINE)
    assert all(re.search(r":[\d.]+-slim$", stage) for stage in stages)
    assert re.findall(r"^USER (\S+)", text, re.MULTILINE) == ["lists"]
    [command] = re.findall(r'^CMD \["(\w+)"\]', text, re.MULTILINE)
    assert command in COMMANDS


@pytest.mark.parametrize("name", ["fmu_src", "models", "docs/findings.md"])
def test_the_container_has_what_the_wheel_is_built_from(name: str) -> None:
    assert f"COPY {name} {name}" in (ROOT / "Containerfile").read_text()
    assert f'"{name}"' in (ROOT / "pyproject.toml").read_text()
