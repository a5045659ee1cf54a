"""Packs FMUs that run on pythonfmu: the compensations with their lists, or any other slave."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from ..interface import Naming, Types, Variable
from ..lists import TypeName
from ..model import CYCLE_TIME, fmu_sources, sentence
from .archive import BuildError, content_guid, file_bytes, write_fmu
from .bill import BILL, bill_of_fmu
from .content import NAME, PACKAGE, Built, output_path, read_content
from .description import Description, model_description
from .packed_interface import FILE_NAME, Interface
from .sources import renamed_sources


def package_axcomp(
    lists: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    cycle_time: float = CYCLE_TIME,
    naming: Naming = "structured",
    external_tool: bool = True,
    axis_type: TypeName | None = None,
    name: str = NAME,
    types: Types = "own",
    allow_outside: Sequence[str | os.PathLike[str]] = (),
) -> Built:
    """Write the FMU of a machine that runs in Python; parameters as in ``package_native``.

    ``external_tool`` False: the FMU does not say that it needs Python; some hosts refuse FMUs that need something;
    ``axis_type``, ``allow_outside``: as in ``read_machine``.

    Raises
    ------
    BuildError
        If there is no machine, it cannot be run, pythonfmu is missing, or the file cannot be written.
    """
    content = read_content(lists, cycle_time, naming, axis_type, name, types, allow_outside)
    interface = Interface.of(content.machine, content.start, cycle_time, axis_type, types)
    resources = {**content.lists, FILE_NAME: interface.to_json().encode()}
    description = replace(content.description, capabilities={"needsExecutionTool": external_tool})
    sources = (fmu_sources() / "axcomp_slave.py", PACKAGE)
    shown = content.accompanying()
    return content._replace(path=write_python_fmu(output, description, content.variables, sources, resources, shown))


def write_python_fmu(
    output: str | os.PathLike[str],
    description: Description,
    variables: Sequence[Variable],
    sources: tuple[Path, Path],
    resources: Mapping[str, bytes],
    shown: Mapping[str, bytes],
) -> Path:
    """Put an FMU together: slave and package, resources, pythonfmu, model description, and what tools show of it."""
    path = output_path(output, f"{description.name}.fmu")
    module, files = renamed_sources(*sources)
    files = {f"resources/{key}": value for key, value in {**files, **resources}.items()}
    files["resources/slavemodule.txt"] = module.encode()
    files.update(_pythonfmu(description.name))
    undated = model_description(replace(description, generated=""), variables, "")
    guid = content_guid({**files, "modelDescription.xml": undated})
    files.update(shown)
    files["modelDescription.xml"] = model_description(description, variables, guid)
    write_fmu(path, {**files, BILL: bill_of_fmu(files)})
    return path


def _pythonfmu(model_identifier: str) -> dict[str, bytes]:
    """Return pythonfmu's loaders under the name of the model, its Python part, and its license."""
    spec = importlib.util.find_spec("pythonfmu")
    if spec is None or spec.origin is None:
        raise BuildError(sentence("pythonfmu", "python", "An FMU that runs in Python"))
    folder = Path(spec.origin).parent
    files = {f"resources/pythonfmu/{path.name}": file_bytes(path) for path in folder.glob("*.py")}
    binaries = folder / "resources" / "binaries"
    libraries = [path for pattern in ("*.so", "*.dll", "*.dylib") for path in binaries.rglob(pattern)]
    if not libraries:
        raise BuildError(f"pythonfmu has no libraries in {binaries}; install it again.")
    for path in libraries:
        platform = path.parent.relative_to(binaries).as_posix()
        files[f"binaries/{platform}/{model_identifier}{path.suffix}"] = file_bytes(path)
    for license_file in importlib.metadata.files("pythonfmu") or ():
        if license_file.name == "LICENSE":
            files["documentation/licenses/pythonfmu.txt"] = license_file.read_binary()
    return files
