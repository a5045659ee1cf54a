"""The client for VS Code: type-checked, linted, packaged, and its way to the server driven under Node."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

import pytest

import axcomp

ROOT = Path(__file__).parents[2]
CLIENT = ROOT / "editors" / "vscode"
INSTALLED = CLIENT / "node_modules" / "vscode-languageserver-protocol"

needs_packages = pytest.mark.skipif(
    shutil.which("npm") is None or not INSTALLED.is_dir(), reason="npm install in editors/vscode has not been run"
)


def npm(*words: str) -> str:
    program = "import sys; from axcomp.cli import main; sys.exit(main(['lsp', '--stdio']))"
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "AXCOMP_COMMAND": json.dumps([sys.executable, "-c", program])}
    done = subprocess.run(
        ["npm", "run", "--silent", *words], cwd=CLIENT, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@needs_packages
@pytest.mark.slow
@pytest.mark.parametrize("script", ["check", "lint", "test"])
def test_the_client_is_checked_and_gets_answers(script: str) -> None:
    told = npm(script)
    assert script != "test" or "# fail 0" in told


@needs_packages
@pytest.mark.slow
def test_the_package_holds_what_the_editor_needs() -> None:
    npm("package")
    names = set(ZipFile(CLIENT / "axcomp.vsix").namelist())
    manifest = json.loads((CLIENT / "package.json").read_text())
    grammar = manifest["contributes"]["grammars"][0]["path"]
    language = manifest["contributes"]["languages"][0]["configuration"]
    for name in (manifest["main"], grammar, language, "package.json"):
        assert f"extension/{name.removeprefix('./')}" in names


def test_the_manifest_fits_the_server_and_the_version() -> None:
    manifest = json.loads((CLIENT / "package.json").read_text())
    command = manifest["contributes"]["configuration"]["properties"]["axcomp.command"]["default"]
    assert command == ["axcomp", "lsp"]
    assert manifest["version"] == axcomp.__version__
    json.loads((CLIENT / "syntaxes" / "lis.tmLanguage.json").read_text())
    json.loads((CLIENT / "language-configuration.json").read_text())


def test_no_lock_file_is_committed() -> None:
    assert "package-lock.json" in (CLIENT / ".gitignore").read_text().split()
