"""The recipes of ``docs/architecture.md`` work as they stand there."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from recipes import ROOT, Checkout

NEW_KIND = "Recipe: a new kind of compensation"
NEW_SPELLING = "Recipe: a new spelling in a list"
NEW_FORMAT = "Recipe: a new format to convert from and to"

LISTS = {
    "hochlauf.lis": "zahl_mds 1\nachs_mds[0] achsmd1.lis\nzahl_kw 1\nachs_kw[0] achskw1.lis\n",
    "achsmd1.lis": "kopf.achs_nr 1\nkopf.log_achs_name X\nlr_param.toy 1\n",
    "achskw1.lis": "kopf.achs_nr 1\nkw.toy.position 100000\nkw.toy.gradient 20\nkw.toy.n_cycles 4\n",
}

KNOWN = """
from pathlib import Path
from axcomp import read_machine, write_machine
from axcomp.cli import main
from axcomp.interface.variables import by_name, variables_of
from axcomp.kinds import KIND_NAMES, KINDS
from axcomp.kinds.toy import Toy
from axcomp.sweep.list_variation import Table

assert list(KINDS) == list(KIND_NAMES) and KIND_NAMES.index("toy") == 4
reading = read_machine("lists")
assert reading.findings == (), reading.findings
(axis,) = reading.machine.axes
assert axis.toy == Toy(10.0, 20e-6, 4)
Path("again").mkdir()
write_machine(reading.machine, "again")
assert read_machine("again").machine == reading.machine
assert Table("X.toy").applied(reading.machine, 2.0).axes[0].toy == Toy(10.0, 40e-6, 4)

variables = by_name(variables_of(reading.machine))
assert {"X.toy.switch", "X.toy.active", "X.toy.correction"} <= set(variables)
assert {"X.setpoint", "X.toy.switch", "X.unreferenced"} <= set(variables["X.toy.correction"].depends_on)
assert "X.actual_position" not in variables["X.toy.correction"].depends_on
assert len({one.reference for one in variables.values()}) == len(variables)

assert main(["check", "lists"]) == 0
assert main(["show", "lists", "--kind", "toy", "--output", "shown.csv"]) == 0
Path("lists/achskw1.lis").write_text(Path("lists/achskw1.lis").read_text() + "kw.toy.n_cycles 21\\n")
assert [finding.code for finding in read_machine("lists").findings] == ["AXC-TWICE", "AXC-RANGE"]
"""

RIGHT = """
import numpy as np
from axcomp import Engine
from axcomp.native.library import compiled_kernel
from axcomp.sweep.list_variation import Table

assert (compiled_kernel() is not None) == {compiled}
engine = Engine("again")
position = np.array([0.0, 10.0, 35.0, 35.0, 35.0, 35.0, 35.0, 35.0])
command = np.array(["", "", "", "X[COMP OFF TOY]", "", "", "", "X[COMP ON TOY]"])
result = engine.run({{"X.setpoint": position, "command": command}})
weight = np.sin(0.5 * np.pi * np.array([4, 4, 4, 3, 2, 1, 0, 1]) / 4) ** 2
np.testing.assert_allclose(result["X.toy.correction"], weight * 20e-6 * np.abs(position - 10.0), rtol=0, atol=1e-15)
np.testing.assert_array_equal(result["X.corrected_setpoint"], position + result["X.toy.correction"])
assert result["X.toy.active"].tolist() == [True] * 6 + [False, True]

saved = engine.runtime.save()
before = engine.step({{"X.setpoint": 60.0}})
engine.runtime.restore(saved)
assert engine.step({{"X.setpoint": 60.0}}) == before

engine = Engine("again")
old, new = 20e-6 * 25.0, 60e-6 * 25.0
assert engine.step({{"X.setpoint": 35.0}})["X.toy.correction"] == old
engine.runtime.update(Table("X.toy").applied(engine.machine, 3.0))
found = [engine.step()["X.toy.correction"] for _ in range(5)]
left = np.sin(0.5 * np.pi * np.array([3, 2, 1, 0, 0]) / 4) ** 2
np.testing.assert_allclose(found, new + left * (old - new), rtol=0, atol=1e-15)
"""

IN_HOST = """
import sys
import numpy as np
from fmpy import simulate_fmu
from axcomp.cli import main

assert main(["build", "--machine", "again", "--runtime", sys.argv[1], "--output", "one.fmu"]) == 0
given = np.array([(0.0, 0.0), (0.001, 35.0)], dtype=[("time", float), ("X.setpoint", float)])
result = simulate_fmu("one.fmu", input=given, output=["X.toy.correction"], stop_time=0.003, step_size=0.001,
                      output_interval=0.001)
np.testing.assert_allclose(result["X.toy.correction"][[0, -1]], [2e-4, 5e-4], rtol=0, atol=1e-15)
"""


@pytest.fixture(scope="module")
def with_toy(tmp_path_factory: pytest.TempPathFactory) -> Checkout:
    checkout = Checkout(tmp_path_factory.mktemp("kind"))
    checkout.carry_out(NEW_KIND)
    (checkout.folder / "lists").mkdir()
    for name, text in LISTS.items():
        (checkout.folder / "lists" / name).write_text(text, encoding="utf-8")
    checkout.run("-c", KNOWN)
    return checkout


def test_a_new_kind_is_two_new_files_and_a_few_lines_in_a_third(with_toy: Checkout) -> None:
    assert with_toy.written == ["axcomp/kernel/toy.py", "axcomp/kernel/compensations.py", "axcomp/kinds/toy.py"]
    assert (with_toy.folder / "shown.csv").read_text(encoding="utf-8").count("\n") > 3


def test_a_new_kind_computes_the_right_value_in_python(with_toy: Checkout) -> None:
    with_toy.run("-c", RIGHT.format(compiled=False), AXCOMP_KERNEL="python")


def test_a_new_kind_computes_the_right_value_in_c(with_toy: Checkout) -> None:
    has_compiler = "from axcomp.native.compiler import compiler_of, own_platform; compiler_of(own_platform())"
    if subprocess.run([sys.executable, "-c", has_compiler], capture_output=True, check=False).returncode:
        pytest.skip("there is no C compiler")
    with_toy.run("-c", RIGHT.format(compiled=True))


def test_a_new_kind_is_translated_formatted_and_documented(with_toy: Checkout) -> None:
    with_toy.run("-m", "axcomp.translate", "--check")
    pages = {name: (with_toy.folder / "docs" / name).read_text("utf-8") for name in ("lists.md", "fmu-reference.md")}
    assert "| `kw.toy.gradient` |" in pages["lists.md"]
    assert "| `NAME.toy.correction` |" in pages["fmu-reference.md"]
    axis_list = (with_toy.folder / "models" / "rotary_table" / "achsmd6.lis").read_text(encoding="utf-8")
    assert re.search(r"^lr_param.toy +0$", axis_list, re.MULTILINE)


@pytest.mark.slow
@pytest.mark.parametrize("runtime", ["python", "native"])
def test_a_new_kind_acts_in_the_fmu(with_toy: Checkout, runtime: str) -> None:
    with_toy.run("-c", IN_HOST, runtime)


def test_a_new_spelling_is_taken_and_a_typo_with_a_warning(tmp_path: Path) -> None:
    checkout = Checkout(tmp_path)
    checkout.carry_out(NEW_SPELLING)
    begin = "kopf.achs_nr 1\nkw.crosscomp.unit 1\nkw.crosscomp.last_index 1\nkw.crosscomp.master_ax_nr 2\n"
    rows = "kw.crosscomp.table[0].setpoint 0\nkw.crosscomp.table[1].setpoint 10000\n"
    for name, word in (("usual", "correction"), ("alias", "korrektur"), ("typo", "corection")):
        values = f"kw.crosscomp.table[0].{word} 5\nkw.crosscomp.table[1].{word} 7\n"
        (tmp_path / f"{name}.lis").write_text(begin + rows + values, encoding="utf-8")
    checkout.run(
        "-c",
        "from axcomp import read_machine\n"
        "usual, alias, typo = (read_machine(f'{name}.lis') for name in ('usual', 'alias', 'typo'))\n"
        "assert usual.machine.axes[0].cross.corrections == (5e-4, 7e-4)\n"
        "assert usual.machine == alias.machine == typo.machine\n"
        "assert usual.findings == alias.findings == ()\n"
        "assert [(one.code, one.line) for one in typo.findings] == [('AXC-TYPO', 7)], typo.findings\n",
    )
    page = (tmp_path / "docs" / "lists.md").read_text(encoding="utf-8")
    assert "`kw.crosscomp.table[i].korrektur`" in page
    assert checkout.written == ["axcomp/kinds/cross.py"]


def test_a_new_format_is_converted_from_and_to(tmp_path: Path) -> None:
    checkout = Checkout(tmp_path)
    checkout.carry_out(NEW_FORMAT)
    convert = ("-m", "axcomp", "convert")
    checkout.run(*convert, "models/three_axis", "--axis", "Y", "--kind", "leadscrew", "--to", "columns",
                 "--output", "y.txt")  # fmt: skip
    text = (tmp_path / "y.txt").read_text(encoding="utf-8")
    listed = (ROOT / "models" / "three_axis" / "achskw2.lis").read_text(encoding="utf-8")
    units = [int(value) for value in re.findall(r"^kw\.ssfk\.table\[\d+\]\.pos +(-?\d+)$", listed, re.MULTILINE)]
    rows = [line.split() for line in text.splitlines()[1:]]
    assert [(float(x), float(y)) for x, y in rows] == [(-300.0 + 10.0 * i, u / 1e4) for i, u in enumerate(units)]
    checkout.run(*convert, "y.txt", "--from", "columns", "--axis", "Y", "--to", "csv", "--output", "y.csv")
    assert (tmp_path / "y.csv").read_text(encoding="utf-8").count("\n") > len(units)
    (tmp_path / "wrong.txt").write_text("% Y\n0 1\n0 2\n", encoding="utf-8")
    failing = "import sys; from axcomp.cli import main; sys.exit(main(sys.argv[1:]) == 0)"
    wrong = ("wrong.txt", "--from", "columns", "--axis", "Y", "--to", "csv")
    checkout.run("-c", failing, "convert", *wrong)
    assert checkout.written == ["axcomp/conversion/columns.py", "axcomp/conversion/formats.py"]


@pytest.mark.slow
@pytest.mark.parametrize("heading", [NEW_KIND, NEW_SPELLING, NEW_FORMAT])
def test_what_the_recipes_write_keeps_the_rules_of_style(heading: str, tmp_path: Path) -> None:
    checkout = Checkout(tmp_path)
    checkout.carry_out(heading)
    for rule in (["ruff", "format", "--check"], ["ruff", "check"], ["mypy", "--strict"]):
        checkout.run("-m", *rule, *checkout.written)


def test_few_files_name_a_kind_besides_its_own_modules() -> None:
    """The word has another meaning in ``axcomp measure``, and the example machine is given it as an input."""
    rooms = {"kinds", "kernel", "fit", "plant"}
    naming = {
        path.relative_to(ROOT / "axcomp").as_posix()
        for path in (ROOT / "axcomp").rglob("*.py")
        if re.search(r"\btemperature\b", path.read_text(encoding="utf-8"))
    }
    others = {name for name in naming if name.split("/")[0] not in rooms}
    assert {"kinds/temperature.py", "kernel/compensations.py"} <= naming
    assert len(others) <= 2, others
