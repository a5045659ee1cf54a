"""What the C sources must know of the variables: where each value reference is in memory, and the records' layout.

``python -m axcomp.native`` writes ``layout.h`` and ``places.c`` from the declarations of ``fmu.variables``.
"""

from __future__ import annotations

import ctypes
import zlib
from collections.abc import Iterator
from typing import Any

from ..interface.variable import BLOCK, TYPE_NAMES
from ..interface.variables import AXIS_BLOCK, MACHINE_BLOCK, VOLUMETRIC_BLOCK, Controls, every_place
from ..kernel.record import zero
from ..kernel.records import AxisTable, Inputs, Outputs, State
from ..kernel.volumetric_records import VolumetricTable
from ..runtime.compile import CYCLE_TIME_MAX
from ..runtime.runtime import ON_INSTANT
from .layout import ctypes_of

GENERATED = "/* Generated from axcomp/interface/variables.py by `python -m axcomp.native`; do not edit. */"
TABLES = {
    "axcomp_machine_places": MACHINE_BLOCK,
    "axcomp_axis_places": AXIS_BLOCK,
    "axcomp_volumetric_places": VOLUMETRIC_BLOCK,
}
"""Table of places → block of value references that it describes (the first of its kind)."""

NO_PLACE = "    {0, 0, 0}"


def layout() -> int:
    """Return a number that changes whenever a record changes that lies in an image or in a state."""
    text = "\n".join(line for cls in (AxisTable, VolumetricTable, State, Inputs, Outputs) for line in _layout_of(cls))
    return zlib.crc32(text.encode())


def layout_header() -> str:
    """Return the text of ``layout.h``."""
    return f"""{GENERATED}
#ifndef AXCOMP_LAYOUT_H
#define AXCOMP_LAYOUT_H

#define AXCOMP_LAYOUT 0x{layout():08x}u  /* of the records in images and states */
#define AXCOMP_POINTER {ctypes.sizeof(ctypes.c_void_p)}u  /* bytes of a pointer in them */
#define AXCOMP_ON_INSTANT {ON_INSTANT!r}  /* share of a cycle by which a communication point may miss an instant */
#define AXCOMP_CYCLE_TIME_MAX {CYCLE_TIME_MAX!r}  /* s; cycle times are shorter */

enum {{ MACHINE_BLOCK = {MACHINE_BLOCK}, AXIS_BLOCK = {AXIS_BLOCK}, VOLUMETRIC_BLOCK = {VOLUMETRIC_BLOCK} }};

#endif
"""


def places_source() -> str:
    """Return the text of ``places.c``."""
    places = dict(_places())
    parts = [f'{GENERATED}\n#include "places.h"\n\n#include <stddef.h>\n\n#include "instance.h"\n']
    for table, block in TABLES.items():
        rows = [places.get(BLOCK * block + identifier, NO_PLACE) for identifier in range(BLOCK)]
        parts.append(f"const Place {table}[PLACES] = {{\n" + ",\n".join(rows) + "\n};\n")
    return "\n".join(parts)


def _places() -> Iterator[tuple[int, str]]:
    inputs, outputs, controls = zero(Inputs), zero(Outputs), Controls()
    containers = {
        id(inputs): ("Memory", "inputs."),
        id(outputs): ("Memory", "outputs."),
        id(controls): ("Memory", "controls."),
        id(inputs.axis[0]): ("AxisInputs", ""),
        id(outputs.axis[0]): ("AxisOutputs", ""),
        id(inputs.volumetric[0]): ("VolumetricInputs", ""),
        id(outputs.volumetric[0]): ("VolumetricOutputs", ""),
    }
    for reference, declaration, record in every_place(1, inputs, outputs, controls, volumetrics=1):
        if id(record) not in containers:
            continue
        structure, prefix = containers[id(record)]
        kind = TYPE_NAMES[type(declaration.start)][0].lower()
        causality = "t" if declaration.variability == "tunable" else declaration.causality[0]
        offset = f"offsetof({structure}, {prefix}{declaration.field})"
        yield reference, f"    {{'{kind}', '{causality}', {offset}}}"


def _layout_of(cls: Any) -> list[str]:
    structure = ctypes_of(cls)
    lines = [f"{cls.__name__} {ctypes.sizeof(structure)}"]
    for name, kind, *_ in structure._fields_:
        place = getattr(structure, name)
        lines.append(f"{name} {kind.__name__} {place.offset} {place.size}")
        inner = getattr(kind, "_type_", kind)
        if isinstance(inner, type) and issubclass(inner, ctypes.Structure):
            lines += [f"  {field[0]} {getattr(inner, field[0]).offset}" for field in inner._fields_]
    return lines
