"""The page in Chromium: findings of the command line, bits of the native kernel, nothing sent, an empty console."""

from __future__ import annotations

import functools
import http.server
import json
import shutil
import subprocess
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from axcomp import Engine
from axcomp.browser import SiteError, build_site
from axcomp.cli import main
from axcomp.interface import with_causality
from axcomp.model import models
from axcomp.native import CompilerError

HERE = Path(__file__).parent
PACKAGES = HERE / "node_modules"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
WIDTHS = (1200, 390)

needs_packages = pytest.mark.skipif(
    shutil.which("npx") is None or not (PACKAGES / "playwright-core").is_dir(),
    reason="npm install in tests/browser has not been run",
)
pytestmark = pytest.mark.slow


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("page") / "site"
    pyodide = PACKAGES / "pyodide"
    try:
        build_site(folder, pyodide=pyodide if pyodide.is_dir() else None, cycles=2_000)
    except (SiteError, CompilerError) as error:
        pytest.skip(str(error))
    return folder


class Silent(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_: Any) -> None:
        pass


@pytest.fixture
def address(site: Path) -> Iterator[str]:
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Silent, directory=str(site)))
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield f"http://127.0.0.1:{server.server_address[1]}/"
    server.shutdown()
    server.server_close()
    thread.join()


def driven(address: str, job: dict[str, Any], folder: Path) -> dict[str, Any]:
    if CHROMIUM is None:
        pytest.skip("there is no chromium on this machine")
    (folder / "job.json").write_text(json.dumps(job))
    command = ["node", str(HERE / "drive.mjs"), CHROMIUM, address, str(folder / "job.json")]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode == 0, done.stderr
    told: dict[str, Any] = json.loads(done.stdout)
    assert told["console"] == []
    assert {method for method, _ in told["requests"]} == {"GET"}
    assert [url for _, url in told["requests"] if not url.startswith((address, "blob:"))] == []
    return told


def checked(path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> tuple[str, list[Any]]:
    """Return the last line and the findings of ``axcomp check``, run in the folder above."""
    monkeypatch.chdir(path.parent)
    main(["check", path.name])
    summary = capsys.readouterr().out.splitlines()[-1]
    main(["check", "--format", "json", path.name])
    findings = []
    for one in json.loads(capsys.readouterr().out)["findings"]:
        line = f":{one['line']}" if one["line"] else ""
        line += f":{one['column']}" if line and one["column"] else ""
        findings.append([one["severity"], f"{one['file']}{line}", one["code"], one["message"]])
    return summary, findings


def broken(folder: Path) -> Path:
    """Return two machines in a folder, with what judgement finds: an outlier, and a volumetric correction too large."""
    shutil.copytree(models() / "three_axis", folder / "cell" / "one")
    shutil.copytree(models() / "five_axis", folder / "cell" / "two")
    for path in (folder / "cell").rglob("*.lis"):
        text = path.read_text(encoding="latin-1")
        if path.name == "achsmd1.lis":
            text = "\n".join(
                "lr_param.vol_comp.s_limit 100" if "s_limit" in line else line for line in text.splitlines()
            )
            path.write_text(text, encoding="latin-1")
    path = folder / "cell" / "one" / "achskw2.lis"
    lines = path.read_text(encoding="latin-1").splitlines()
    place = next(k for k, line in enumerate(lines) if line.startswith("kw.ssfk.table[30].pos"))
    lines[place] = "kw.ssfk.table[30].pos 5000 # Tippfehler: größer"
    lines.insert(0, "kw.nonsense 1")
    path.write_text("\n".join(lines), encoding="latin-1")
    return folder / "cell"


@needs_packages
def test_findings_are_those_of_the_command_line(
    address: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folders = [path for path in sorted(models().iterdir()) if path.is_dir()]
    folders += [broken(tmp_path), models() / "three_axis" / "achskw1.lis"]
    job = {"folders": [str(path) for path in folders], "shots": str(tmp_path), "widths": WIDTHS}
    told = driven(address, job | {"drop": str(folders[0])}, tmp_path)
    assert told["native"].startswith("✓ same bits as the native kernel")
    for path, seen in zip(folders, told["machines"], strict=True):
        assert (seen["summary"], seen["findings"]) == checked(path, monkeypatch, capsys), path.name
        assert "python" not in seen or seen["python"].startswith("✓ same bits as the kernel in Python")
        assert [seen[f"overflow{width}"] for width in WIDTHS] == [False, False]
    codes = {finding[2] for seen in told["machines"] for finding in seen["findings"]}
    assert {"AXC-UNKNOWN", "AXC-OUTLIER", "AXC-LIMIT-EXCEEDED", "AXC-GAP"} <= codes
    assert len(told["machines"][0]["limits"]) == 6
    three = told["machines"][folders.index(models() / "three_axis")]
    assert len(three["tables"]) == 10
    assert [axis["values"] for axis in three["moved"]] == moved(models() / "three_axis", three["moved"])


def moved(folder: Path, axes: list[dict[str, Any]]) -> list[dict[str, str]]:
    """Return what the page must show when the axes stand at their targets, each reached from below, by the Engine."""
    engine = Engine(folder)
    ways = np.linspace(-1.0, 0.0, 500).tolist() + [0.0] * 200
    names = [axis.name for axis in engine.machine.axes]
    course = {
        f"{name}.setpoint": [axis["target"] + way for way in ways] for name, axis in zip(names, axes, strict=True)
    }
    found = engine.run(course)
    shown = []
    for name in names:
        values = {"shift": f"{1000.0 * found[f'{name}.setpoint_shift'][-1]:.2f} µm"}
        for variable in with_causality(engine.variables, "output"):
            if variable.name.startswith(f"{name}.") and variable.quantity.endswith("correction"):
                what = variable.quantity.split(".")[0].replace("correction", "sum")
                values[what] = f"{1000.0 * found[variable.name][-1]:.2f} µm".replace("-", "−")
        values["current"] = f"{found[f'{name}.current'][-1]:.2f}"
        shown.append(values)
    return shown


@needs_packages
def test_a_kernel_with_other_bits_is_told(site: Path, address: str, tmp_path: Path) -> None:
    proof = json.loads((site / "proof.json").read_text())
    altered = json.loads(json.dumps(proof))
    altered["machines"][1]["digest"] ^= 1
    try:
        (site / "proof.json").write_text(json.dumps(altered))
        told = driven(address, {"folders": []}, tmp_path)
    finally:
        (site / "proof.json").write_text(json.dumps(proof))
    assert told["native"] == f"✗ NOT the bits of {proof['by']}: {altered['machines'][1]['name']}"


@needs_packages
def test_the_scripts_are_well_typed() -> None:
    done = subprocess.run(["npm", "run", "--silent", "check"], cwd=HERE, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_a_folder_with_something_else_is_refused(tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(SiteError, match="holds something else than the page"):
        build_site(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_a_package_that_is_none_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("axcomp.browser.site.wasm_kernel", lambda: b"")
    assert main(["page", "--output", str(tmp_path / "site"), "--pyodide", str(tmp_path)]) == 1
    assert "is not the npm package pyodide: pyodide.mjs" in capsys.readouterr().err
    monkeypatch.setattr("axcomp.browser.site.shutil.which", lambda _: None)
    assert main(["page", "--output", str(tmp_path / "site")]) == 1
    assert "npm is needed" in capsys.readouterr().err


def test_no_lock_file_is_committed() -> None:
    assert "package-lock.json" in (HERE / ".gitignore").read_text().split()
