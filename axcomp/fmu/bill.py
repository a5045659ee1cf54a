"""The bill of materials of an FMU or a wheel, as CycloneDX 1.5 in JSON: every file with its hash, every package."""

from __future__ import annotations

import hashlib
import importlib.metadata
import json
import re
import uuid
import zipfile
from collections.abc import Mapping
from email.parser import BytesParser
from pathlib import Path
from typing import Any

from .. import __version__
from .archive import BuildError, content_guid, generation_date

BILL = "documentation/bom.cdx.json"
"""Where it lies in an FMU."""

_NAME = re.compile(rb'modelName="([^"]*)"')
_REQUIRED = re.compile(r"([\w.-]+)\s*(?:\[[^\]]*\])?\s*\(?([^;)]*)\)?\s*(?:;\s*(.*))?\Z")


def bill_of_fmu(files: Mapping[str, bytes]) -> bytes:
    """Return the bill of an FMU's files: those of axcomp, and of pythonfmu where it is in them."""
    found = _NAME.search(files.get("modelDescription.xml", b""))
    packages = []
    if any(name.startswith("resources/pythonfmu/") for name in files):
        packages.append(_package("pythonfmu", importlib.metadata.version("pythonfmu")))
    return _bill((found[1].decode() if found else "fmu", __version__, "application"), files, packages, packages)


def bill_of_archive(path: Path) -> bytes:
    """Return the bill of an FMU, or of a wheel with what it requires; BuildError if it is neither."""
    try:
        with zipfile.ZipFile(path) as archive:
            files = {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}
    except (OSError, zipfile.BadZipFile) as error:
        raise BuildError(f"{path} cannot be read: {error}") from None
    metadata = next((data for name, data in files.items() if name.endswith(".dist-info/METADATA")), None)
    if metadata is None:
        files.pop(BILL, None)
        return bill_of_fmu(files)
    fields = BytesParser().parsebytes(metadata)
    required = []
    for written in fields.get_all("Requires-Dist", ()):
        match = _REQUIRED.match(str(written))
        if match is None:
            raise BuildError(f"{path}: {written!r} is no requirement")
        extra = (match[3] or "").strip()
        package = _package(match[1], "", match[2].strip())
        package["scope"] = "optional" if extra else "required"
        if extra:
            package["properties"].append({"name": "axcomp:marker", "value": extra})
        required.append(package)
    # A package that several extras require is one component; what is always needed wins.
    unique = {one["bom-ref"]: one for one in sorted(required, key=lambda one: one["scope"] == "required")}
    needed = [one for one in unique.values() if one["scope"] == "required"]
    return _bill((str(fields["Name"]), str(fields["Version"]), "library"), files, list(unique.values()), needed)


def _package(name: str, version: str, range_: str = "") -> dict[str, Any]:
    at = f"@{version}" if version else ""
    found: dict[str, Any] = {"type": "library", "bom-ref": f"pkg:pypi/{name}", "name": name}
    found["purl"] = f"pkg:pypi/{name.lower().replace('_', '-')}{at}"
    if version:
        found["version"] = version
    found["properties"] = [{"name": "axcomp:versions", "value": range_}] if range_ else []
    return found


def _bill(
    what: tuple[str, str, str], files: Mapping[str, bytes], packages: list[dict[str, Any]], needed: list[dict[str, Any]]
) -> bytes:
    """Return a bill; ``what``: name, version and type of the thing itself."""
    name, version, kind = what
    own = f"{name}@{version}"
    bill = {
        "$schema": "http://cyclonedx.org/schema/bom-1.5.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "serialNumber": f"urn:uuid:{uuid.UUID(content_guid(files))}",
        "version": 1,
        "metadata": {
            "timestamp": generation_date(),
            "tools": {"components": [{"type": "application", "name": "axcomp", "version": __version__}]},
            "component": {
                "type": kind,
                "bom-ref": own,
                "name": name,
                "version": version,
                "licenses": [{"license": {"id": "MIT"}}],
            },
        },
        "components": [
            *packages,
            *(
                {
                    "type": "file",
                    "bom-ref": f"file:{file}",
                    "name": file,
                    "hashes": [{"alg": "SHA-256", "content": hashlib.sha256(data).hexdigest()}],
                }
                for file, data in sorted(files.items())
            ),
        ],
        "dependencies": [{"ref": own, "dependsOn": [one["bom-ref"] for one in needed]}],
    }
    return (json.dumps(bill, indent=1, ensure_ascii=False) + "\n").encode()
