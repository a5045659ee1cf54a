"""The bill of materials: valid CycloneDX, every file with its hash, the same bytes for the same FMU."""

from __future__ import annotations

import hashlib
import json
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator

import axcomp
from axcomp.fmu import BuildError, bill_of_archive, package_axcomp, package_native
from axcomp.model import models

BILL = "documentation/bom.cdx.json"


def bill_in(path: Path) -> tuple[dict[str, Any], dict[str, bytes]]:
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    text = files.pop(BILL).decode()
    assert JsonStrictValidator(SchemaVersion.V1_5).validate_str(text) is None
    return json.loads(text), files


@pytest.mark.parametrize("package", [package_native, package_axcomp])
def test_an_fmu_lists_every_file_and_what_it_is_made_of(package: Any, tmp_path: Path) -> None:
    built = package(models() / "rotary_table", tmp_path / "one.fmu", name="table")
    bill, files = bill_in(built.path)
    listed = {one["name"]: one["hashes"][0]["content"] for one in bill["components"] if one["type"] == "file"}
    assert listed == {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
    own = bill["metadata"]["component"]
    assert (own["name"], own["version"], own["licenses"]) == ("table", axcomp.__version__, [{"license": {"id": "MIT"}}])
    libraries = [one["name"] for one in bill["components"] if one["type"] == "library"]
    assert libraries == (["pythonfmu"] if package is package_axcomp else [])
    assert bill_of_archive(built.path) == json_bytes(built.path)
    again = package(models() / "rotary_table", tmp_path / "two.fmu", name="table")
    assert again.path.read_bytes() == built.path.read_bytes()


def json_bytes(path: Path) -> bytes:
    with zipfile.ZipFile(path) as archive:
        return archive.read(BILL)


def test_a_wheel_lists_what_it_requires(tmp_path: Path) -> None:
    wheel = tmp_path / "axcomp-1.0-py3-none-any.whl"
    metadata = (
        "Metadata-Version: 2.4\nName: axcomp\nVersion: 1.0\nRequires-Dist: numpy>=1.26\n"
        "Requires-Dist: matplotlib>=3.8; extra == 'plot'\nRequires-Dist: matplotlib>=3.8; extra == 'demo'\n"
        "Requires-Dist: dask[distributed]>=2024.8; extra == 'sweep'\n"
    )
    with zipfile.ZipFile(wheel, "w") as archive:
        archive.writestr("axcomp/__init__.py", "")
        archive.writestr("axcomp-1.0.dist-info/METADATA", metadata)
    done = subprocess.run([sys.executable, "-m", "axcomp.fmu", wheel], capture_output=True, text=True, check=True)
    assert JsonStrictValidator(SchemaVersion.V1_5).validate_str(done.stdout) is None
    bill = json.loads(done.stdout)
    scopes = {one["name"]: one["scope"] for one in bill["components"] if one["type"] == "library"}
    assert scopes == {"numpy": "required", "matplotlib": "optional", "dask": "optional"}
    assert bill["dependencies"] == [{"ref": "axcomp@1.0", "dependsOn": ["pkg:pypi/numpy"]}]


def test_what_is_no_archive_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.fmu").write_text("no archive")
    with pytest.raises(BuildError, match=r"x\.fmu cannot be read"):
        bill_of_archive(tmp_path / "x.fmu")
