"""What is in the library: nothing but libc behind it, no memory of its own, and neither heap nor files in a step."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path

import pytest
from host_program import LOADER, NATIVE, Program

from axcomp.native import LIBRARY_SOURCES

FUNCTIONS = {f"fmi2{name}" for name in re.findall(r"FUNCTION\([^,]+, (\w+),", (LOADER / "fmu_library.h").read_text())}
SAME_EVERYWHERE = {"ceil", "floor", "fabs", "sqrt"}
"""What IEEE 754 and the C standard fix to the last bit; all else of libm differs between systems."""

LIBC = {
    "calloc",
    "malloc",
    "realloc",
    "free",
    "fopen",
    "fclose",
    "fread",
    "fseek",
    "ftell",
    "memcpy",
    "memmove",
    "memset",
    "memcmp",
    "bcmp",
}
LIBC |= {"memchr", "open", "stat", "fstat", "close", "fdopen"}
LIBC |= {"__xstat", "__fxstat"}  # what stat and fstat are in a glibc before 2.33
ROUNDING = {"fegetround", "fesetround"}
LIBC |= ROUNDING | {"strlen", "strcmp", "strncmp", "vsnprintf", "dladdr"}
LIBC |= {f"__{name}_chk" for name in ("memcpy", "memmove", "memset", "vsnprintf", "fread")} | {"__stack_chk_fail"}
STARTUP = {"__cxa_finalize", "__gmon_start__", "_ITM_deregisterTMCloneTable", "_ITM_registerTMCloneTable"}
PURE = {*ROUNDING, "memcpy", "memmove", "memset", "memcmp", "strlen", "vsnprintf", "__stack_chk_fail", *SAME_EVERYWHERE}
PURE |= {f"__{name}_chk" for name in ("memcpy", "memmove", "memset", "vsnprintf")}


def symbols(library: Path, *options: str) -> list[tuple[str, str]]:
    """Return letter and name of the symbols that nm prints."""
    if not shutil.which("nm"):
        pytest.skip("nm is not installed")
    text = subprocess.run(["nm", *options, str(library)], capture_output=True, text=True, check=True).stdout
    return [(words[-2], words[-1].split("@")[0]) for line in text.splitlines() if len(words := line.split()) > 1]


@pytest.mark.parametrize("way", ["gcc", "gcc-avx2", pytest.param("linux64", marks=pytest.mark.slow)])
def test_the_library_needs_libc_only(host: Callable[[str], Program], way: str) -> None:
    needed = {name for _, name in symbols(host(way).library, "-D", "--undefined-only")}
    assert needed <= LIBC | SAME_EVERYWHERE | STARTUP


def test_the_library_exports_the_functions_of_fmi_and_no_more(host: Callable[[str], Program]) -> None:
    exported = {name for letter, name in symbols(host("gcc").library, "-D", "--defined-only") if letter == "T"}
    assert len(FUNCTIONS) > 40
    third = {name for name in exported if name.startswith("fmi3")}  # those of FMI 3.0: see test_fmi3.py
    assert exported - third == FUNCTIONS | {"axcomp_run", "axcomp_layout"}


def test_instances_share_nothing_but_tables(host: Callable[[str], Program]) -> None:
    """There is nothing else that can be written but what the compiler puts there.

    Arrays of pointers are constant once the library is loaded.
    """
    written = {name for letter, name in symbols(host("gcc").library) if letter in "bBdDcC"}
    constant = {"_DYNAMIC", "_GLOBAL_OFFSET_TABLE_", "axcomp_log_categories", "axcomp_notices", "axcomp_table_arrays"}
    constant |= {name for name in written if name.endswith("_parts")}
    left = {name for name in written - constant if not name.startswith(("__", "completed.", "_"))}
    assert left == {"shared", "locked"}


@cache
def calls(work: Path) -> dict[str, set[str]]:
    """Return which functions each function calls, as the compiler sees it without inlining anything."""
    graph: dict[str, set[str]] = {}
    for source in LIBRARY_SOURCES:
        assembly = work / f"{source}.s"
        command = ["gcc", "-std=c99", "-O1", "-fno-inline", "-fno-optimize-sibling-calls", "-fno-jump-tables"]
        command += ["-S", "-o", str(assembly)]
        subprocess.run([*command, str(NATIVE / source)], check=True)
        function = ""
        for line in assembly.read_text().splitlines():
            if match := re.match(r"^([A-Za-z_][\w.]*):", line):
                function = match[1]
                graph.setdefault(function, set())
            elif match := re.match(r"^\s+(?:call|jmp|bl)q?\s+(\*?)([A-Za-z_%][\w.]*)", line):
                graph[function].add("a pointer" if match[1] or match[2].startswith("%") else match[2])
            elif re.match(r"^\s+callq?\s+\*", line):
                graph[function].add("a pointer")
    return graph


def reached(graph: dict[str, set[str]], begin: Iterable[str]) -> set[str]:
    found: set[str] = set()
    waiting = list(begin)
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += graph.get(name, ())
    return found


def test_a_step_reaches_neither_the_heap_nor_files(tmp_path: Path) -> None:
    """Whatever the inputs are: no function that could do so is called, from the step down. The logger is the host's."""
    if not shutil.which("gcc"):
        pytest.skip("gcc is not installed")
    graph = calls(tmp_path)
    step = reached(graph, ["fmi2DoStep", "fmi3DoStep", "fmi3UpdateDiscreteStates", "fmi3GetFloat64"])
    assert {"axcomp_cycle", "axcomp_say", "axcomp_adopt_axis"} <= step
    assert step - set(graph) - {"a pointer"} <= PURE
    with_pointers = {name for name in step if "a pointer" in graph.get(name, ())}
    assert with_pointers == {"axcomp_say"}
    # fmi2SetReal sets `reload` where everything is Real, and fmi2SetBoolean where it is not: that reads a file.
    for call in ("fmi2GetReal", "fmi2SetInteger", "fmi2GetInteger", "fmi2GetBoolean", "fmi2SetRealInputDerivatives"):
        assert not reached(graph, [call]) & {"malloc", "calloc", "realloc", "free", "fopen"}
    assert {"calloc", "fdopen"} <= reached(graph, ["fmi2Instantiate"])
