"""The C sources in a native FMU: the kernel, and the tables of the machine as initialized records.

They need no file, no log, no heap and nothing of the operating system, and have no name outside that another FMU's
sources could have: several can be linked into one program (FMI 2.0.5, section 2.1.1).
"""

from __future__ import annotations

import re
from xml.etree.ElementTree import Element, SubElement

from ..native import HEADERS, SOURCES, THIRD_HEADERS, THIRD_SOURCES, source_bytes, tables_source
from ..runtime import Compiled
from .content import PACKAGE, Built, Version
from .description import document

TABLES_SOURCE = "tables.c"
_OWN_NAME = re.compile(rb"\baxcomp_(?=\w)")


def sources_of(fmi: Version) -> tuple[str, ...]:
    """Return those to compile."""
    return (*SOURCES, *(THIRD_SOURCES if fmi == "3.0" else ()), TABLES_SOURCE)


def embedded_sources(content: Built, guid: str, fmi: Version, *, real_only: bool = False) -> dict[str, bytes]:
    """Return the files in ``sources``, and what TwinCAT must know to compile them."""
    name = content.description.name
    headers = (*HEADERS, *(THIRD_HEADERS if fmi == "3.0" else ()))
    texts = {
        TABLES_SOURCE: tables_source(content.compiled, guid, real_only=real_only).encode(),
        "config.h": _configuration(name, content.compiled, fmi).encode(),
        **{source: source_bytes(source) for source in (*sources_of(fmi)[:-1], *headers)},
    }
    prefix = b"axcomp_" if name == PACKAGE.name else f"{name}_axcomp_".encode()
    files = {f"sources/{file}": _OWN_NAME.sub(prefix, text) for file, text in texts.items()}
    files["sources/buildDescription.xml"] = _build_description(name, fmi)
    files["documentation/CustomFMU.xml"] = _for_twincat(content.description.tool)
    return files


def _configuration(name: str, compiled: Compiled, fmi: Version) -> str:
    tables, pool = compiled
    third = f"""
#ifndef FMI3_FUNCTION_PREFIX
#define FMI3_FUNCTION_PREFIX {name}_
#endif
#define AXCOMP_NUMBERS {len(pool)} /* of the tables, which a host may change */
"""
    lines = sum(axis.compensation.friction.delay + 1 for axis in tables.axis[: tables.axis_count])
    return f"""\
/* The tables are among these sources (tables.c): no file is read, nothing is allocated, nothing is logged. */
#ifndef AXCOMP_CONFIG_H
#define AXCOMP_CONFIG_H

/* Of each function's name. Whoever compiles a shared library defines FMI2_OVERRIDE_FUNCTION_PREFIX: without it. */
#ifndef FMI2_FUNCTION_PREFIX
#define FMI2_FUNCTION_PREFIX {name}_
#endif

#define AXCOMP_EMBEDDED
#define AXCOMP_AXES {tables.axis_count}
#define AXCOMP_VOLUMETRICS {tables.volumetrics}
#define AXCOMP_LINES {lines} /* numbers in the delay lines of all axes */
{third if fmi == "3.0" else ""}
#endif
"""


def _build_description(name: str, fmi: Version) -> bytes:
    """Return how the sources are built into a shared library, as FMI 3.0 describes it."""
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = SubElement(root, "BuildConfiguration", modelIdentifier=name, description="shared library")
    files = SubElement(configuration, "SourceFileSet", language="C99")
    for source in sources_of(fmi):
        SubElement(files, "SourceFile", name=source)
    for prefix in ("FMI2", "FMI3")[: 1 + (fmi == "3.0")]:
        SubElement(files, "PreprocessorDefinition", name=f"{prefix}_OVERRIDE_FUNCTION_PREFIX")
    SubElement(configuration, "Library", name="m", external="true", description="of the compiler")
    return document(root)


def _for_twincat(tool: str) -> bytes:
    """Return what TE1420 must know of the tool that made the FMU: nothing out of the ordinary."""
    root = Element("CustomConfigurations")
    configuration = SubElement(root, "FmuConfiguration")
    SubElement(configuration, "ToolName").text = tool
    SubElement(configuration, "AdditionalInclude").text = "$(ProjectDir);$(ProjectDir)sources;"
    for empty in ("PreprocessorDefinitions", "ExcludedFromBuild", "CodeReplacements"):
        SubElement(configuration, empty)
    return document(root)
