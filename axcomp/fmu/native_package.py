"""Packs the FMU that needs nothing: the translated kernel as libraries and as sources, and the tables."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

from ..interface import Naming, Types, arrays_of
from ..lists import TypeName
from ..model import CYCLE_TIME
from ..native import (
    LIBRARY_SOURCES,
    PLATFORMS,
    CompilerError,
    compile_library,
    compiler_of,
    cross_compile,
    has_cross_compiler,
    image_of,
    own_platform,
    prebuilt_path,
    source_path,
    why_not_prebuilt,
)
from .archive import BuildError, content_guid, file_bytes, write_file, write_fmu
from .bill import BILL, bill_of_fmu
from .content import NAME, Built, Version, output_path, read_content
from .description import Description, model_description
from .description3 import model_description_3
from .embedded import embedded_sources, sources_of

IMAGE = "tables.bin"
"""Name of the image in ``resources``, which the prebuilt libraries read."""


class NoCompilerError(BuildError):
    """There is no compiler that could build the FMU, or it has failed."""


def package_native(
    lists: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    cycle_time: float = CYCLE_TIME,
    naming: Naming = "structured",
    platforms: Sequence[str] = (),
    axis_type: TypeName | None = None,
    name: str = NAME,
    types: Types = "own",
    with_lists: bool = True,
    fmi: Version = "2.0",
    allow_outside: Sequence[str | os.PathLike[str]] = (),
) -> Built:
    """Write the FMU of a machine; a folder as output: a file of the model's name in it.

    Parameters
    ----------
    lists : path
        As in ``read_machine``. Everything it reads goes into the FMU.
    output : path
        File to write; replaced if it is there.
    cycle_time : float
        Of the position controller, s.
    naming : str
        ``structured`` or ``flat``.
    platforms : sequence of str
        Those of ``PLATFORMS`` that get a library; none: all of them.
    axis_type, allow_outside
        As in ``read_machine``.
    name : str
        Name and identifier of the model; all that is visible outside its sources begins with it.
    types : str
        ``own``, or ``real``: Real instead of Boolean and Integer, for importers that take everything as Real.
    with_lists : bool
        False: of the lists only the tables that were compiled from them go into the FMU.

    fmi : str
        Version of FMI: ``2.0`` or ``3.0``. One library serves both.

    Raises
    ------
    NoCompilerError
        If the libraries that come with the package do not serve, and none can be compiled.
    BuildError
        If there is no machine, it cannot be run, or the file cannot be written.
    """
    content = read_content(lists, cycle_time, naming, axis_type, name, types, allow_outside)
    files = {f"resources/{file}": data for file, data in content.lists.items()} if with_lists else {}
    libraries = _libraries(platforms)
    for platform, library in libraries.items():
        for folder in PLATFORMS[platform].third if fmi == "3.0" else (platform,):
            files[f"binaries/{folder}/{name}{PLATFORMS[platform].suffix}"] = library
    description = replace(
        content.description,
        capabilities={"needsExecutionTool": False, "canInterpolateInputs": True},
        source_files=sources_of(fmi),
    )
    arrays = arrays_of(content.machine, *content.compiled, naming) if fmi == "3.0" else ()

    def described(told: Description, guid: str) -> bytes:
        if fmi == "3.0":
            return model_description_3(told, content.variables, arrays, guid)
        return model_description(told, content.variables, guid)

    guid = _guid(content, described)
    image = image_of(content.compiled, guid, content.findings, real_only=types == "real")
    files[f"resources/{IMAGE}"] = image
    files.update(embedded_sources(content, guid, fmi, real_only=types == "real"))
    files["modelDescription.xml"] = described(description, guid)
    files.update(content.accompanying(with_tables=with_lists))
    if fmi == "3.0":
        del files["model.png"]  # its icon is that of the terminals
    path = output_path(output, f"{name}.fmu")
    write_fmu(path, {**files, BILL: bill_of_fmu(files)})
    reason = why_not_prebuilt()
    return content._replace(path=path, note=f"{reason}: compiled for {', '.join(libraries)}" if reason else "")


def write_image(
    lists: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    cycle_time: float = CYCLE_TIME,
    axis_type: TypeName | None = None,
    allow_outside: Sequence[str | os.PathLike[str]] = (),
) -> Built:
    """Write the image of a machine's tables, which the input ``reload`` takes; a folder: ``tables.bin`` in it.

    It is written for lists with errors too, and carries them: ``reload`` refuses it then.

    Raises
    ------
    BuildError
        If there is no machine, it cannot be run, or the file cannot be written.
    """
    content = read_content(lists, cycle_time, axis_type=axis_type, allow_outside=allow_outside)
    path = output_path(output, IMAGE)
    guid = _guid(content, lambda told, guid: model_description(told, content.variables, guid))
    write_file(path, image_of(content.compiled, guid, content.findings))
    return content._replace(path=path)


def _guid(content: Built, described: Callable[[Description, str], bytes]) -> str:
    """Return a guid that depends on variables and tables, not on date, compiler and platforms."""
    description = described(replace(content.description, generated=""), "")
    return content_guid({"modelDescription.xml": description, IMAGE: image_of(content.compiled, "", content.findings)})


def _libraries(platforms: Sequence[str]) -> dict[str, bytes]:
    """Return the library of each platform, without any: of all, or of this machine's where they must be compiled.

    They come with the package; where those do not serve, a compiler makes them.
    """
    reason = why_not_prebuilt()
    libraries = {}
    for platform in platforms or ((own_platform(),) if reason else PLATFORMS):
        try:
            library = _compiled(platform, (*compiler_of(platform),)) if reason else file_bytes(prebuilt_path(platform))
        except CompilerError as error:
            raise NoCompilerError(f"{reason}; {error}") from None
        libraries[platform] = library
    return libraries


@cache
def _compiled(platform: str, compiler: tuple[str, ...]) -> bytes:
    """Return a library that this compiler, or the cross compiler, has just made."""
    sources = [source_path(name) for name in LIBRARY_SOURCES]
    with tempfile.TemporaryDirectory() as work:
        output = Path(work) / f"{NAME}{PLATFORMS[platform].suffix}"
        if has_cross_compiler():
            cross_compile(sources, output, platform=platform)
        else:
            compile_library(sources, output, compiler=compiler, platform=platform)
        return output.read_bytes()
