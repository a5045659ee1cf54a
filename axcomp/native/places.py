"""What the C sources must know of the variables: where each value reference is in memory, and the records' layout.

``python -m axcomp.native`` writes ``layout.h`` and ``places.c`` from the declarations of ``fmu.variables``.
"""

from __future__ import annotations

import dataclasses
import re
import zlib
from collections.abc import Iterator
from typing import Any

from ..interface import (
    AXIS_BLOCK,
    AXIS_DECLARATIONS,
    BLOCK,
    MACHINE_BLOCK,
    OF_MACHINE,
    OF_VOLUMETRIC,
    TABLE_BLOCK,
    TIME_REFERENCE,
    TYPE_NAMES,
    VOLUMETRIC_BLOCK,
    Declaration,
    every_array,
)
from ..kernel import AxisTable, Inputs, Outputs, State, VolumetricTable, fields_of
from ..kinds import KIND_NAMES, KINDS
from ..model import CYCLE_TIME_MAX, LARGEST_STEP
from ..runtime import NO_COMMAND, ON_INSTANT
from .records import GENERATED, parts_of, size_of

TABLES = {
    "axcomp_machine_places": MACHINE_BLOCK,
    "axcomp_axis_places": AXIS_BLOCK,
    "axcomp_volumetric_places": VOLUMETRIC_BLOCK,
}
"""Table of places → block of value references that it describes (the first of its kind)."""

NO_PLACE = "{0, 0, 0}"
_KIND = re.compile(r"^(wanted|active|contribution)\[(\d+)\]")


def layout() -> int:
    """Return a number that changes whenever a record changes that lies in an image or in a state."""
    text = "\n".join(line for cls in (AxisTable, VolumetricTable, State, Inputs, Outputs) for line in _fields_in(cls))
    return zlib.crc32(text.encode())


def layout_header() -> str:
    """Return the text of ``layout.h``."""
    return f"""{GENERATED}
#ifndef AXCOMP_LAYOUT_H
#define AXCOMP_LAYOUT_H

#define AXCOMP_LAYOUT 0x{layout():08x}u  /* of the records in images and states */
#define AXCOMP_AXIS_BYTES {size_of(AxisTable)}u  /* of the table of an axis in an image */
#define AXCOMP_VOLUMETRIC_BYTES {size_of(VolumetricTable)}u
#define AXCOMP_ON_INSTANT {ON_INSTANT!r}  /* share of a cycle by which a communication point may miss an instant */
#define AXCOMP_CYCLE_TIME_MAX {CYCLE_TIME_MAX!r}  /* s; cycle times are shorter */

enum {{ AXCOMP_LARGEST_STEP = {LARGEST_STEP} }}; /* cycles of a communication step, unless the host says more */

enum {{ MACHINE_BLOCK = {MACHINE_BLOCK}, AXIS_BLOCK = {AXIS_BLOCK}, VOLUMETRIC_BLOCK = {VOLUMETRIC_BLOCK} }};
/* Of FMI 3.0: the blocks of tables, and the independent variable. */
enum {{ TABLE_BLOCK = {TABLE_BLOCK}, TIME_REFERENCE = {TIME_REFERENCE} }};

#endif
"""


def places_source() -> str:
    """Return the text of ``places.c``."""
    places = dict(_places())
    parts = [f'{GENERATED}\n#include "places.h"\n\n#include <stddef.h>\n\n#include "instance.h"\n']
    for table, block in TABLES.items():
        last = max(reference for reference in places if reference // BLOCK == block) % BLOCK
        rows = [f"    AT({i}) {places.get(BLOCK * block + i, NO_PLACE)}" for i in range(last + 1)]
        parts.append(f"const Place {table}[PLACES] = {{\n" + ",\n".join(rows) + "\n};\n")
    rows = [f"    {row}" for row in (*_arrays(), "{0, 0, 0, 0, 0, 0, NULL}")]
    parts.append("const TableArray axcomp_table_arrays[] = {\n" + ",\n".join(rows) + "\n};\n")
    rows = [
        f"    AT({name.upper()}) " + (f'"{kind.notice}"' if kind.notice else "NULL") for name, kind in KINDS.items()
    ]
    notices = ",\n".join(rows)
    parts.append(f"const char *const axcomp_notices[KINDS] = {{\n{notices}\n}};\n")
    parts.append(f'const char axcomp_no_command[] = "{NO_COMMAND}";\n')
    return "\n".join(parts)


def _places() -> Iterator[tuple[int, str]]:
    blocks = ((MACHINE_BLOCK, OF_MACHINE), (AXIS_BLOCK, AXIS_DECLARATIONS), (VOLUMETRIC_BLOCK, OF_VOLUMETRIC))
    for block, declarations in blocks:
        for declared in declarations:
            kind = TYPE_NAMES[type(declared.start)][0].lower()
            causality = "t" if declared.variability == "tunable" else declared.causality[0]
            place = f"offsetof({_member(block, declared)})"
            yield BLOCK * block + declared.identifier, f"{{'{kind}', '{causality}', {place}}}"


def _arrays() -> Iterator[str]:
    for kind, identifier, array in every_array():
        paths = (array.at, array.points, array.rows, array.argument)
        places = [f"offsetof(AxisTable, compensation.{kind}.{path})" if path else "0" for path in paths]
        yield ",\n     ".join((f"{{{identifier}, '{array.of}'", *places, f'"{kind}.{array.name}"}}'))


def _by_name(found: re.Match[str]) -> str:
    """Return an element of an array over kinds with the kind's name as its index."""
    return f"{found[1]}[{KIND_NAMES[int(found[2])].upper()}]"


def _member(block: int, declared: Declaration) -> str:
    """Return the structure that a variable lies in, and its member there, as C names them."""
    direction = "Outputs" if declared.causality == "output" else "Inputs"
    if block == AXIS_BLOCK:
        return f"Axis{direction}, {_KIND.sub(_by_name, declared.field)}"
    if block == VOLUMETRIC_BLOCK:
        return f"Volumetric{direction}, {declared.field}"
    record = (
        direction.lower() if declared.field in fields_of(Outputs if direction == "Outputs" else Inputs) else "controls"
    )
    return f"Memory, {record}.{declared.field}"


def _fields_in(cls: Any) -> Iterator[str]:
    """Yield the fields of a record, and behind each those of the records in it, with their types and lengths."""
    for part in parts_of(cls):
        yield f"{part.name} {part.type.__name__} {part.length}"
        if dataclasses.is_dataclass(part.type):
            yield from _fields_in(part.type)
