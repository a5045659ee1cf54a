"""What goes into the native FMU, and what is said when it cannot be built."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu
from fmu_machines import three_axes

from axcomp.fmu import HEADERS, SOURCES, BuildError, NoCompilerError, package_axcomp, package_native, write_image
from axcomp.interface import Naming
from axcomp.lists import write_machine
from axcomp.model import fmu_sources
from axcomp.native import (
    LIBRARY_HEADERS,
    LIBRARY_SOURCES,
    PLATFORMS,
    image_of,
    layout_header,
    own_platform,
    places_source,
    prebuilt_path,
    records_source,
)
from axcomp.runtime import compile_tables

NATIVE = fmu_sources() / "native"


def contents(fmu: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(fmu) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_the_committed_layout_and_places_follow_from_the_declarations() -> None:
    assert (NATIVE / "layout.h").read_text("utf-8") == layout_header(), "run python -m axcomp.native"
    assert (NATIVE / "places.c").read_text("utf-8") == places_source(), "run python -m axcomp.native"
    assert (NATIVE / "records.c").read_text("utf-8") == records_source(), "run python -m axcomp.native"


def test_it_holds_library_image_lists_and_all_sources(native_fmu: Path, lists: Path) -> None:
    files = contents(native_fmu)
    description = fmpy.read_model_description(native_fmu)
    for name, platform in PLATFORMS.items():
        assert files[f"binaries/{name}/axcomp{platform.suffix}"] == prebuilt_path(name).read_bytes()
    assert files["resources/tables.bin"] == image_of(compile_tables(three_axes()), description.guid)
    assert files["resources/machine/hochlauf.lis"] == (lists / "hochlauf.lis").read_bytes()
    sources = {name.removeprefix("sources/") for name in files if name.startswith("sources/")}
    assert sources == {*SOURCES, *HEADERS, "tables.c", "config.h", "buildDescription.xml"}
    compiled = description.buildConfigurations[0].sourceFileSets[0].sourceFiles
    assert compiled == [*SOURCES, "tables.c"]
    assert {path.name for path in NATIVE.iterdir()} == {*LIBRARY_SOURCES, *LIBRARY_HEADERS, "embedded.c", "wasm.c"}


@pytest.mark.parametrize("naming", ["structured", "flat"])
def test_variables_units_and_descriptions_are_those_of_the_python_fmu(
    native_fmu: Path, lists: Path, tmp_path: Path, naming: Naming
) -> None:
    assert native_fmu
    native = contents(package_native(lists, tmp_path / "native.fmu", naming=naming).path)["modelDescription.xml"]
    python = contents(package_axcomp(lists, tmp_path / "python.fmu", naming=naming).path)["modelDescription.xml"]
    begin = b"  <UnitDefinitions>"
    assert native.partition(begin)[2] == python.partition(begin)[2]
    assert native.count(b"<ScalarVariable") > 40
    assert b'needsExecutionTool="false"' in native


def test_it_is_valid(native_fmu: Path) -> None:
    assert validate_fmu(str(native_fmu)) == []


def test_building_twice_gives_the_same_bytes(native_fmu: Path, lists: Path, tmp_path: Path) -> None:
    shutil.copytree(lists, tmp_path / "elsewhere")
    again = package_native(tmp_path / "elsewhere", tmp_path / "again.fmu").path
    assert again.read_bytes() == native_fmu.read_bytes()


def test_the_linux_library_runs_on_old_systems_and_takes_its_mathematics_from_them(
    native_fmu: Path, tmp_path: Path
) -> None:
    if not shutil.which("nm"):
        pytest.skip("there is no nm on this machine")
    library = Path(fmpy.extract(native_fmu, tmp_path)) / "binaries" / "linux64" / "axcomp.so"
    command = ["nm", "-D", "--undefined-only", "--format=just-symbols", str(library)]
    symbols = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    versions = [tuple(map(int, symbol.partition("@GLIBC_")[2].split("."))) for symbol in symbols if "@GLIBC_" in symbol]
    assert max(versions) <= (2, 17)
    # Were a helper of the compiler linked in, its own floor and ceil would have come with it.
    assert {"floor@GLIBC_2.2.5", "ceil@GLIBC_2.2.5"} <= set(symbols)


def test_the_guid_follows_the_tables_and_variables_only(
    native_fmu: Path, lists: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    guid = fmpy.read_model_description(native_fmu).guid
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    dated = package_native(lists, tmp_path / "dated.fmu").path
    assert dated.read_bytes() != native_fmu.read_bytes()
    assert fmpy.read_model_description(dated).guid == guid
    slower = package_native(lists, tmp_path / "slower.fmu", cycle_time=0.002).path
    assert fmpy.read_model_description(slower).guid != guid
    flat = package_native(lists, tmp_path / "flat.fmu", naming="flat").path
    assert fmpy.read_model_description(flat).guid != guid
    write_machine(three_axes(2.0), tmp_path / "other")
    assert fmpy.read_model_description(package_native(tmp_path / "other", tmp_path / "o.fmu").path).guid != guid


def test_an_image_is_that_of_the_fmu(native_fmu: Path, lists: Path, tmp_path: Path) -> None:
    built = write_image(lists, tmp_path)
    assert built.path == tmp_path / "tables.bin"
    assert built.path.read_bytes() == contents(native_fmu)["resources/tables.bin"]


def test_an_image_that_cannot_be_written_is_a_sentence(lists: Path, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(BuildError, match="cannot be written"):
        write_image(lists, tmp_path / "file" / "image.bin")


@pytest.fixture
def no_zig(monkeypatch: pytest.MonkeyPatch) -> None:
    """The libraries do not belong to the sources, and there is no cross compiler."""
    monkeypatch.setattr("axcomp.fmu.native_package.why_not_prebuilt", lambda: "they are old")
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)


@pytest.mark.usefixtures("no_zig")
def test_without_a_compiler_a_sentence_says_what_to_install(
    lists: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(
        NoCompilerError,
        match=r"they are old; there is no C compiler: install gcc or clang, or pip install axcomp\[cross\]",
    ):
        package_native(lists, tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("no_zig")
def test_another_platform_needs_a_cross_compiler(lists: Path, tmp_path: Path) -> None:
    other = next(platform for platform in PLATFORMS if platform != own_platform())
    with pytest.raises(NoCompilerError, match=rf"for {other} .* cross compiler is needed: pip install axcomp\[cross\]"):
        package_native(lists, tmp_path, platforms=[own_platform(), other])


@pytest.mark.usefixtures("no_zig")
@pytest.mark.parametrize(
    ("compiler", "sentence"), [("nowhere/cc -m64", "nowhere/cc cannot be run"), ("false", "false has failed")]
)
def test_a_compiler_that_fails_is_named(
    lists: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, compiler: str, sentence: str
) -> None:
    monkeypatch.setenv("CC", compiler)
    with pytest.raises(NoCompilerError, match=sentence):
        package_native(lists, tmp_path)
