"""Packs the FMU that needs nothing: the translated kernel as libraries and as sources, and the tables."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

from ..interface import Naming
from ..lists import TypeName
from ..model import CYCLE_TIME, fmu_sources
from ..native import PLATFORMS, CompilerError, compile_library, compiler_of, image_of, image_source, own_platform
from .archive import BuildError, content_guid, file_bytes, write_file, write_fmu
from .content import NAME, Built, output_path, read_content
from .description import model_description

_PARTS = ("fmu", "image", "instance", "kernel", "model_exchange", "places", "resource", "states", "values")
SOURCES = tuple(f"{part}.c" for part in _PARTS)
HEADERS = ("fmi2.h", "image.h", "instance.h", "kernel.h", "layout.h", "places.h", "resource.h")
"""Of the library, in ``fmu_src/native``; with them goes ``config.h``, which is another one in an FMU."""

TABLES_SOURCE = "tables.c"
CONFIGURATION = """\
/* How this library gets its tables: they are among the sources (tables.c). No file is read.
 *
 * Whoever links the sources statically defines FMI2_FUNCTION_PREFIX as axcomp_; see fmi2.h. */
#define AXCOMP_EMBEDDED
"""

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
    allow_outside: Sequence[str | os.PathLike[str]] = (),
) -> Built:
    """Write the FMU of a machine; a folder as output: ``axcomp.fmu`` in it.

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
        Those of ``PLATFORMS`` that get a library; none: the one this Python runs on.
    axis_type, allow_outside
        As in ``read_machine``.

    Raises
    ------
    NoCompilerError
        If a library cannot be compiled.
    BuildError
        If there is no machine, it cannot be run, or the file cannot be written.
    """
    content = read_content(lists, cycle_time, naming, axis_type, allow_outside)
    files = {f"resources/{name}": data for name, data in content.lists.items()}
    files.update(_libraries(platforms or (own_platform(),)))
    description = replace(
        content.description, capabilities={"needsExecutionTool": False}, source_files=(*SOURCES, TABLES_SOURCE)
    )
    guid = _guid(content)
    image = image_of(content.compiled, guid, content.findings)
    files[f"resources/{IMAGE}"] = image
    files.update((f"sources/{name}", _source(name)) for name in (*SOURCES, *HEADERS))
    files[f"sources/{TABLES_SOURCE}"] = image_source(image).encode()
    files["sources/config.h"] = CONFIGURATION.encode()
    files["modelDescription.xml"] = model_description(description, content.variables, guid)
    path = output_path(output, f"{NAME}.fmu")
    write_fmu(path, files)
    return content._replace(path=path)


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
    write_file(path, image_of(content.compiled, _guid(content), content.findings))
    return content._replace(path=path)


def _guid(content: Built) -> str:
    """Return a guid that depends on variables and tables, not on date, compiler and platforms."""
    description = model_description(replace(content.description, generated=""), content.variables, "")
    return content_guid({"modelDescription.xml": description, IMAGE: image_of(content.compiled, "", content.findings)})


def _libraries(platforms: Sequence[str]) -> dict[str, bytes]:
    files = {}
    for platform in platforms:
        try:
            library = _library(platform, tuple(compiler_of(platform)))
        except CompilerError as error:
            raise NoCompilerError(str(error)) from None
        files[f"binaries/{platform}/{NAME}{PLATFORMS[platform].suffix}"] = library
    return files


@cache
def _library(platform: str, compiler: tuple[str, ...]) -> bytes:
    """Return the library for a platform; it is the same for every machine."""
    folder = fmu_sources() / "native"
    with tempfile.TemporaryDirectory() as work:
        output = Path(work) / f"{NAME}{PLATFORMS[platform].suffix}"
        compile_library([folder / name for name in SOURCES], output, compiler=compiler, platform=platform)
        return output.read_bytes()


def _source(name: str) -> bytes:
    """Return a source with the same line ends on every system."""
    return file_bytes(fmu_sources() / "native" / name).replace(b"\r\n", b"\n")
