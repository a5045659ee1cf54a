"""The records lie in memory as C expects them, and come back from it."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import pytest

from axcomp.kernel import Inputs, Outputs, State, Tables, fields_of, zero
from axcomp.native import ctypes_of, from_c, to_c

SOURCES = Path(__file__).parents[2] / "fmu_src" / "native"


@dataclass(slots=True)
class Part:
    """A record in a record."""

    on: bool
    weight: float


@dataclass(slots=True)
class Whole:
    """A record with everything there is."""

    count: int
    part: Part
    parts: Annotated[list[Part], 3]
    flags: Annotated[list[bool], 3]
    numbers: Annotated[list[int], 2]
    line: Annotated[list[float], 2]


def test_what_goes_to_c_comes_back() -> None:
    whole = zero(Whole)
    whole.count, whole.flags, whole.numbers, whole.line = -7, [True, False, True], [3, -4], [0.1, -0.0]
    whole.parts[2].on, whole.parts[2].weight = True, 2.5
    struct = ctypes_of(Whole)()
    to_c(whole, struct)
    back = zero(Whole)
    from_c(struct, back)
    assert back == whole


def test_a_list_that_was_cut_fills_the_front_of_its_array() -> None:
    whole = zero(Whole)
    del whole.parts[1:]
    del whole.numbers[1:]
    whole.parts[0].weight, whole.numbers[0] = 1.5, 9
    struct = ctypes_of(Whole)()
    to_c(whole, struct)
    whole.parts[0].weight, whole.numbers[0] = 0.0, 0
    from_c(struct, whole)
    assert (whole.parts[0].weight, whole.numbers, len(whole.parts)) == (1.5, [9], 1)


@pytest.mark.parametrize("record", [Tables, State, Inputs, Outputs])
def test_every_field_of_the_kernel_lies_where_the_compiler_puts_it(record: type, tmp_path: Path) -> None:
    if not shutil.which("gcc"):
        pytest.skip("there is no gcc on this machine")
    name = record.__name__
    fields = list(fields_of(record))
    prints = "".join(f'    printf("%zu\\n", offsetof({name}, {field}));\n' for field in fields)
    (tmp_path / "probe.c").write_text(
        f'#include <stddef.h>\n#include <stdio.h>\n#include "kernel.h"\n\nint main(void)\n{{\n{prints}'
        f'    printf("%zu\\n", sizeof({name}));\n    return 0;\n}}\n'
    )
    command = ["gcc", "-std=c99", "-I", str(SOURCES), "-o", str(tmp_path / "probe"), str(tmp_path / "probe.c")]
    subprocess.run(command, check=True)
    found = subprocess.run([tmp_path / "probe"], capture_output=True, text=True, check=True).stdout.split()
    struct = ctypes_of(record)
    expected = [getattr(struct, field).offset for field in fields] + [ctypes.sizeof(struct)]
    assert [int(number) for number in found] == expected
