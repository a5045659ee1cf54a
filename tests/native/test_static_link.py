"""The sources of FMUs in one C program: of two machines, under an importer's own names, on other processors."""

from __future__ import annotations

import shutil
import struct
import subprocess
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import fmpy
import pytest
from fmu_machines import three_axes

from axcomp.engine import Engine
from axcomp.fmu import BuildError, package_axcomp, package_native
from axcomp.interface import Variable
from axcomp.lists import write_machine

CYCLES = 400
HOST = """
#include <stdio.h>
#include <string.h>

#define FMI2_FUNCTION_PREFIX {name}_
#include "fmi2Functions.h"

/* Saves the state, begins again, and goes back to the state by its bytes. */
static int there_and_back(fmi2Component c)
{{
    static fmi2Byte bytes[65536];
    fmi2FMUstate state = NULL, again = NULL;
    size_t size = 0;
    int status = fmi2GetFMUstate(c, &state) != fmi2OK || fmi2SerializedFMUstateSize(c, state, &size) != fmi2OK
        || size > sizeof bytes || fmi2SerializeFMUstate(c, state, bytes, size) != fmi2OK || fmi2Reset(c) != fmi2OK
        || fmi2DeSerializeFMUstate(c, bytes, size, &again) != fmi2OK || fmi2SetFMUstate(c, again) != fmi2OK;
    bytes[size / 2] ^= 1;
    fmi2FreeFMUstate(c, &again);
    status = status || fmi2DeSerializeFMUstate(c, bytes, size, &again) != fmi2Error;
    fmi2FreeFMUstate(c, &state);
    return status;
}}

/* Moves all real inputs; prints the bits of all real outputs of each cycle. */
int {name}_run(void)
{{
    static const fmi2ValueReference given[] = {{{given}}}, wanted[] = {{{wanted}}};
    enum {{ GIVEN = sizeof given / sizeof given[0], WANTED = sizeof wanted / sizeof wanted[0] }};
    fmi2CallbackFunctions callbacks = {{NULL, NULL, NULL, NULL, NULL}};
    fmi2Component c = fmi2Instantiate("{name}", fmi2CoSimulation, "{guid}", "", &callbacks, fmi2False, fmi2False);
    fmi2Real values[GIVEN], results[WANTED];
    int status = c == NULL || fmi2SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0) != fmi2OK;
    status = status || fmi2EnterInitializationMode(c) != fmi2OK || fmi2ExitInitializationMode(c) != fmi2OK;
    for (int k = 0; k < {cycles} && status == 0; k++) {{
        if (k % 100 == 50 && there_and_back(c) != 0) {{
            return 1;
        }}
        for (int i = 0; i < GIVEN; i++) {{
            values[i] = ((k * (i + 3)) % 101 - 50) * 0.25;
        }}
        status = fmi2SetReal(c, given, GIVEN, values) != fmi2OK || fmi2DoStep(c, 0.001 * k, 0.001, fmi2True) != fmi2OK
            || fmi2GetReal(c, wanted, WANTED, results) != fmi2OK;
        for (int i = 0; i < WANTED; i++) {{
            unsigned long long bits;
            memcpy(&bits, &results[i], sizeof bits);
            printf("%016llx\\n", bits);
        }}
    }}
    fmi2FreeInstance(c);
    return status;
}}
"""
MAIN = "{declared}\nint main(void)\n{{\n    return {called};\n}}\n"
GCC = ("gcc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2", "-ffp-contract=off")
TARGETS = {
    "arm32": (("arm-linux-musleabihf",), "qemu-arm"),
    "i386": (("x86-linux-musl", "-msse2", "-mfpmath=sse"), "qemu-i386"),
    "aarch64": (("aarch64-linux-musl",), "qemu-aarch64"),
    "ppc64, big-endian": (("powerpc64-linux-musl",), "qemu-ppc64"),
}
HEADERS = Path(fmpy.__file__).parent / "c-code"
"""The standard's headers, which importers have; FMPy's do not put a prefix before the names."""


class Machine(NamedTuple):
    """An unpacked FMU, and what its machine computes."""

    name: str
    folder: Path
    description: fmpy.model_description.ModelDescription
    engine: Engine


@pytest.fixture(scope="module")
def two(tmp_path_factory: pytest.TempPathFactory) -> list[Machine]:
    found = []
    for number, name in enumerate(("mill", "lathe_2"), 1):
        folder = tmp_path_factory.mktemp(name)
        write_machine(three_axes(float(number)), folder / "lists")
        built = package_native(folder / "lists", folder, name=name, platforms=("linux64",))
        assert built.path == folder / f"{name}.fmu"
        fmpy.extract(built.path, folder / "fmu")
        found.append(
            Machine(name, folder / "fmu", fmpy.read_model_description(built.path), Engine(three_axes(float(number))))
        )
    return found


def variables(machine: Machine, causality: str) -> list[Variable]:
    return [v for v in machine.engine.variables if v.causality == causality and type(v.start) is float]


def expected(machine: Machine) -> list[str]:
    given, wanted = variables(machine, "input"), variables(machine, "output")
    engine, lines = Engine(machine.engine.machine), []
    for k in range(CYCLES):
        row = {v.name: ((k * (i + 3)) % 101 - 50) * 0.25 for i, v in enumerate(given)}
        values = engine.step(row)
        lines += [struct.pack(">d", values[v.name]).hex() for v in wanted]
    return lines


def write_host(machine: Machine, folder: Path, prefix: str = "") -> Path:
    def numbers(found: Sequence[Variable]) -> str:
        return ", ".join(f"{v.reference}u" for v in found)

    path = folder / f"{machine.name}_host.c"
    text = HOST.format(
        name=machine.name,
        given=numbers(variables(machine, "input")),
        wanted=numbers(variables(machine, "output")),
        guid=machine.description.guid,
        cycles=CYCLES,
    )
    path.write_text(text.replace(f"PREFIX {machine.name}_", f"PREFIX {prefix or machine.name + '_'}"))
    return path


def standard_header(folder: Path) -> Path:
    """Write the header as the standard has it; FMPy's copy says itself where it has left the prefix out."""
    include = folder / "include"
    include.mkdir()
    for name in ("fmi2TypesPlatform.h", "fmi2FunctionTypes.h"):
        shutil.copy(HEADERS / name, include)
    text = (HEADERS / "fmi2Functions.h").read_text()
    paste = "#define PASTE(a, b) a##b\n#define PASTE_B(a, b) PASTE(a, b)\n"
    paste += "#define fmi2FullName(name) PASTE_B(FMI2_FUNCTION_PREFIX, name)"
    assert "#define fmi2FullName(name) name" in text
    (include / "fmi2Functions.h").write_text(text.replace("#define fmi2FullName(name) name", paste))
    return include


def objects(command: Sequence[str], machine: Machine, folder: Path, *options: str) -> list[str]:
    """Compile the sources that the model description names, each by itself."""
    (sources,) = machine.description.buildConfigurations[0].sourceFileSets
    found = []
    for name in sources.sourceFiles:
        output = folder / f"{machine.name}_{name}.o"
        run(*command, *options, "-c", str(machine.folder / "sources" / name), "-o", str(output))
        found.append(str(output))
    return found


def run(*command: str) -> list[str]:
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, f"{command}\n{result.stderr}"
    return result.stdout.splitlines()


def link(command: Sequence[str], machines: Sequence[Machine], folder: Path, *options: str, prefix: str = "") -> Path:
    include = f"-I{standard_header(folder)}"
    parts = [part for machine in machines for part in objects(command, machine, folder, include, *options)]
    hosts = [str(write_host(machine, folder, prefix)) for machine in machines]
    main = folder / "main.c"
    names = [f"{machine.name}_run" for machine in machines]
    declared = "\n".join(f"int {name}(void);" for name in names)
    main.write_text(MAIN.format(declared=declared, called=" || ".join(f"{name}()" for name in names)))
    program = folder / "program"
    run(*command, include, str(main), *hosts, *parts, "-o", str(program), "-lm")
    return program


def test_two_machines_in_one_program_compute_what_each_does_alone(two: list[Machine], tmp_path: Path) -> None:
    if not shutil.which("gcc"):
        pytest.skip("there is no gcc on this machine")
    assert run(str(link(GCC, two, tmp_path))) == expected(two[0]) + expected(two[1])


def test_they_do_nothing_undefined(two: list[Machine], tmp_path: Path) -> None:
    if not shutil.which("gcc"):
        pytest.skip("there is no gcc on this machine")
    sanitized = (*GCC, "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    assert run(str(link(sanitized, two, tmp_path))) == expected(two[0]) + expected(two[1])


def test_an_importer_can_give_the_functions_another_prefix(two: list[Machine], tmp_path: Path) -> None:
    if not shutil.which("gcc"):
        pytest.skip("there is no gcc on this machine")
    options = "-DFMI2_FUNCTION_PREFIX=our_own_"
    assert run(str(link(GCC, two[:1], tmp_path, options, prefix="our_own_"))) == expected(two[0])


@pytest.mark.slow
@pytest.mark.parametrize("target", TARGETS)
def test_any_byte_order_and_pointer_size_gives_the_same_bits(two: list[Machine], target: str, tmp_path: Path) -> None:
    (triple, *flags), emulator = TARGETS[target]
    if find_spec("ziglang") is None or not (found := shutil.which(emulator) or shutil.which(f"{emulator}-static")):
        pytest.skip(f"the package ziglang or {emulator} is not installed")
    zig = [sys.executable, "-m", "ziglang", "cc", "-target", triple, "-static", *flags, "-std=c99", "-O2"]
    program = link([*zig, "-ffp-contract=off", "-Wall", "-Wextra", "-Werror"], two[:1], tmp_path)
    assert run(found, str(program)) == expected(two[0])


def test_every_name_that_another_file_could_see_begins_with_that_of_the_model(
    two: list[Machine], tmp_path: Path
) -> None:
    if not shutil.which("gcc") or not shutil.which("nm"):
        pytest.skip("there is no gcc or nm on this machine")
    for machine in two:
        found = run("nm", "-g", "--defined-only", "--format=just-symbols", *objects(GCC, machine, tmp_path))
        names = [name for name in found if name and not name.endswith(":")]
        assert len(names) > 60
        assert [name for name in names if not name.startswith(f"{machine.name}_")] == []


def test_they_call_nothing_of_the_system(two: list[Machine], tmp_path: Path) -> None:
    """No file, no log, no heap; what is left are moves of memory and mathematics."""
    if not shutil.which("gcc") or not shutil.which("nm"):
        pytest.skip("there is no gcc or nm on this machine")
    found = set(run("nm", "-u", "--format=just-symbols", *objects(GCC, two[0], tmp_path)))
    outside = {name for name in found if name and not name.endswith(":") and not name.startswith("mill_")}
    standard = {"memcpy", "memmove", "memset", "memcmp", "strlen", "strcmp", "floor", "ceil", "sqrt"}
    standard |= {"fegetround", "fesetround"}
    assert outside - standard <= {"__stack_chk_fail", "_GLOBAL_OFFSET_TABLE_"}
    text = "".join(path.read_text() for path in (two[0].folder / "sources").glob("*.[ch]"))
    for word in ("windows.h", "dlfcn.h", "stdio.h", "stdlib.h", "malloc", "calloc", "fopen", "printf"):
        assert word not in text


def test_the_name_is_that_of_model_identifier_and_libraries(two: list[Machine]) -> None:
    for machine in two:
        assert machine.description.modelName == machine.description.coSimulation.modelIdentifier == machine.name
        assert (machine.folder / "binaries" / "linux64" / f"{machine.name}.so").is_file()
    assert two[0].description.guid != two[1].description.guid


def test_the_python_fmu_has_the_name_too(two: list[Machine], tmp_path: Path) -> None:
    built = package_axcomp(two[0].folder.parent / "lists", tmp_path, name="saw")
    assert built.path.name == "saw.fmu"
    assert fmpy.read_model_description(built.path).coSimulation.modelIdentifier == "saw"


@pytest.mark.parametrize("name", ["", "2nd", "a-b", "a b", "ü"])
def test_a_name_that_c_cannot_have_is_a_sentence(two: list[Machine], name: str, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match="is no model name"):
        package_native(two[0].folder.parent / "lists", tmp_path, name=name)
