"""The mutation run on a toy package: it notices what a test sees, and names what none sees."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from mutation import c_mutants, python_mutants

ROOT = Path(__file__).parents[1]
TESTED = "def above(a, b):\n    return a > b\n"
UNTESTED = "\n\ndef half(a):\n    return a / 2\n"
TEST = """from axcomp.kernel.toy import above


def test_above():
    assert above(2, 1) is True
    assert above(1, 1) is False
"""


def run(root: Path, *options: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "tests.mutation", "--root", str(root), *options]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.fixture
def toy(tmp_path: Path) -> Path:
    for name, text in {
        "axcomp/__init__.py": "",
        "axcomp/kernel/__init__.py": "",
        "tests/kernel/test_toy.py": TEST,
    }.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return tmp_path


def test_a_planted_defect_is_noticed(toy: Path) -> None:
    source = toy / "axcomp/kernel/toy.py"
    source.write_text(TESTED)
    done = run(toy)
    assert (done.returncode, done.stderr) == (0, "")
    assert "| kernel | 2 | 2 |" in done.stdout  # the comparison and the returned value
    assert "survived" not in done.stdout
    assert source.read_text() == TESTED


def test_a_survivor_is_named_and_decides_the_exit_status(toy: Path) -> None:
    (toy / "axcomp/kernel/toy.py").write_text(TESTED + UNTESTED)
    done = run(toy, "axcomp/kernel", "--at-least", "90", "--sample", "0")
    assert (done.returncode, done.stderr) == (1, "")
    assert "axcomp/kernel/toy.py:6:14: survived: / in a / 2 -> *\n" in done.stdout
    assert "| kernel | 2 | 6 |" in done.stdout


def test_tests_that_fail_by_themselves_prove_nothing(toy: Path) -> None:
    (toy / "axcomp/kernel/toy.py").write_text(TESTED.replace(">", "<"))
    done = run(toy)
    assert done.returncode == 2
    assert "kernel: its tests fail without any change" in done.stdout


def test_a_revision_that_is_not_there_is_a_sentence(toy: Path) -> None:
    (toy / "axcomp/kernel/toy.py").write_text(TESTED)
    done = run(toy, "--changed-since", "nowhere")
    assert done.returncode == 1
    assert "since nowhere is not known" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("x = a <= b\n", "x = a < b\n"),
        ("x = a + b\n", "x = a - b\n"),
        ("x = a and b\n", "x = a or b\n"),
        ("x = not a\n", "x = a\n"),
        ("x = 7\n", "x = 8\n"),
        ("x = 7\n", "x = 6\n"),
        ("x = True\n", "x = False\n"),
        ("a.x = b\n", "pass\n"),
        ("# ü\nx = 'ü' + b\n", "# ü\nx = 'ü' - b\n"),
        ("def f():\n    return a\n", "def f():\n    return None\n"),
    ],
)
def test_python_is_changed_in_one_place(before: str, after: str) -> None:
    assert after in [one.of(before.encode()).decode() for one in python_mutants.mutants(before.encode())]


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("    if (a < b) {", "    if (a <= b) {"),
        ("    if (a && !b) {", "    if (a && b) {"),
        ("    x = a[1];", "    x = a[2];"),
        ("    s->x = a;", "    ;"),
        ("    reset(s);", "    ;"),
    ],
)
def test_c_is_changed_in_one_place(before: str, after: str) -> None:
    assert after in [one.of(before.encode()).decode() for one in c_mutants.mutants(before.encode())]


@pytest.mark.parametrize(
    "text", ["/* a < b */", "// a < b", '    f("a < b 1");'.replace("f(", "return ("), "#define A 1"]
)
def test_what_c_does_not_run_is_not_changed(text: str) -> None:
    assert c_mutants.mutants(text.encode()) == []
