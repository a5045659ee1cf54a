"""Lists by chance that keep to the grammar: what can be read can be built, and runs with the same bits in both kernels.

A case is made from its number alone: lists of a random machine with some entries changed, taken out, doubled, or added
from the catalogue. Nothing may raise; without an error finding the tables compile and the kernel accepts them, and with
one they do too: what is wrong does not act, but stops nothing.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from axcomp.fmu import packed_lists
from axcomp.interface import variables_of, with_causality
from axcomp.kernel import tables_fit
from axcomp.kinds import DataType, ListKind, Parameter
from axcomp.lists import CATALOGUE, Document, Reading, machine_documents, read_machine
from axcomp.model import models
from axcomp.native import CompiledRuntime, compiled_kernel
from axcomp.runtime import Runtime

sys.path.append(str(Path(__file__).parents[1] / "reference"))
import random_machines

CYCLES = 12
_WRITTEN = """
0 1 -1 2 3 5 10 20 0.001 0.0001 1e-7 -0.5 100 359.9999 3600000 32767 65535 65536 2147483647 -2147483648 4294967296
9223372036854775807 1e19 1e300 -1e300 1e-300 nan inf 0x10 1,5 TRUE FALSE abc ACHSTYP_ROTATOR GRID SCATTER PATH AUTO
XYZ CXYZ XXYZ "" "a ( 1..2 + - 1_000 ² … 00000000000000000001 ..\\x /x
"""
WORDS = _WRITTEN.split()


class FoundError(AssertionError):
    """A case that shows a defect."""


def bases() -> list[list[Document]]:
    """Return the lists of the example machines."""
    found = []
    for name in ("three_axis", "five_axis", "rotary_table", "machining_centre"):
        if (models() / name).is_dir():
            documents = read_machine(models() / name / "hochlauf.lis").documents.values()
            found.append([Document(one.path.name, one.data, one.kind) for one in documents])
    return found


BASES = bases()


def documents_of(case: int) -> list[Document]:
    """Return the lists of a case."""
    source = random.Random(case)
    if source.random() < 0.25:
        documents = source.choice(BASES)
    else:
        machine = random_machines.machine(np.random.default_rng(case))
        documents = machine_documents(machine, "")
    kinds = {document.path.name: _kind_of(document.path.name) for document in documents}
    texts = {one.path.name: one.data.decode("utf-8", "replace").split("\n") for one in documents}
    for _ in range(source.choice((0, 1, 1, 2, 3, 5, 12))):
        name = source.choice(list(texts))
        _change(texts[name], kinds[name], source)
    return [Document(name, "\n".join(lines).encode("utf-8", "replace")) for name, lines in texts.items()]


def _kind_of(name: str) -> ListKind | None:
    if name == "hochlauf.lis":
        return ListKind.START_UP
    if name.startswith("vol"):
        return ListKind.VOLUMETRIC if name.endswith(".lis") else None
    return ListKind.AXIS if "md" in name else ListKind.COMPENSATION


def _change(lines: list[str], kind: ListKind | None, source: random.Random) -> None:
    """Change something in a list, or in a file of parameters."""
    way = source.random()
    at = source.randrange(len(lines)) if lines else 0
    if not lines or (kind is not None and way < 0.35):
        if kind is not None:
            lines.insert(at, _entry(source.choice(CATALOGUE[kind]), source))
    elif way < 0.7:
        words = lines[at].split()
        if words:
            words[source.randrange(len(words))] = _value(None, source)
            lines[at] = " ".join(words)
    elif way < 0.8:
        del lines[at]
    elif way < 0.88:
        lines.insert(source.randrange(len(lines)), lines[at])
    elif way < 0.94:
        other = source.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    elif way < 0.97:
        lines[at] = lines[at].replace("0", source.choice("1239"), 1)
    else:
        del lines[at:]


def _entry(parameter: Parameter, source: random.Random) -> str:
    indices = [source.choice((0, 0, 1, 1, 2, 3, 4, 9, 19, 31, 100, 10**6)) for _ in range(parameter.name.count("["))]
    name = source.choice((parameter.name, *parameter.aliases))
    for letter, index in zip("ij" if "[i]" in name.split("[j]")[0] else "ji", indices, strict=False):
        name = name.replace(f"[{letter}]", f"[{index}]")
    return f"{name} {_value(parameter, source)}"


def _value(parameter: Parameter | None, source: random.Random) -> str:
    if parameter is None or source.random() < 0.2:
        return source.choice(WORDS) if source.random() < 0.7 else repr(source.uniform(-400, 400))
    if parameter.values or parameter.names:
        return str(source.choice((*parameter.values, *parameter.names, 0)))
    if parameter.type in (DataType.STRING, DataType.BOOLEAN):
        return source.choice(WORDS) if parameter.type is DataType.STRING else source.choice("01")
    inside = parameter.plausible
    edges = (inside.low, inside.low + 1, inside.high - 1, inside.high, inside.low - 1, inside.high + 1)
    return str(source.choice((*edges, parameter.default, 1, 2, 3, 10, 1000, source.randrange(-100_000, 100_000))))


def try_case(case: int) -> str:
    """Try one case; return ``faultless``, ``errors`` or ``no axis``. Whatever is raised is a defect."""
    documents = documents_of(case)
    reading = read_machine("hochlauf.lis", documents=documents)
    errors = sum(finding.severity.value == "error" for finding in reading.findings)
    if not reading.machine.axes:
        return "no axis"
    runtime = Runtime(reading.machine)
    tables, pool = runtime.tables, runtime.pool
    if not tables_fit(tables, pool, len(pool)):
        raise FoundError("the kernel refuses its own tables")
    if case % 20 == 0:
        _pack(reading)
    if case % 4 == 0:
        _compare(runtime, case)
    return "errors" if errors else "faultless"


def _pack(reading: Reading) -> None:
    """Try what ``build`` does with the lists: what is packed reads back to the same machine."""
    start, files = packed_lists(reading)
    again = read_machine(start, documents=[Document(name, data) for name, data in files.items()])
    if again.machine != reading.machine:
        raise FoundError("the packed lists are another machine")


def _compare(one: Runtime, case: int) -> None:
    """Run both kernels over the same inputs."""
    kernel = compiled_kernel()
    if kernel is None:
        return
    source = np.random.default_rng(case)
    two = CompiledRuntime(one.machine, one.tables.cycle_time, kernel)
    variables = variables_of(one.machine, "structured", 1e-3)
    plain = [v for v in variables if v.axis is not None and v.field.isidentifier() and isinstance(v.start, float)]
    given = with_causality(plain, "input")
    rows = np.ascontiguousarray(source.uniform(-400.0, 400.0, (CYCLES, len(given))))
    odd = source.random(rows.shape) < 0.02
    rows[odd] = source.choice([np.nan, np.inf, 1e300, -1e18, 0.0], int(odd.sum()))
    for row in rows:
        for runtime in (one, two):
            for variable, value in zip(given, row.tolist(), strict=True):
                setattr(runtime.inputs.axis[variable.axis or 0], variable.field, value)
            runtime.cycle()
    if one.save() != two.save():
        raise FoundError("Python and C have come to different states")


def cases(first: int) -> Iterator[int]:
    """Yield the numbers of all cases."""
    while True:
        yield first
        first += 1
