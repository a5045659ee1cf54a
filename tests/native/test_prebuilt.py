"""The libraries that come with the package: what is in them, that they follow from the sources, and what if not."""

from __future__ import annotations

import hashlib
import importlib.metadata
import importlib.util
import os
import shutil
import struct
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from axcomp.cli import main
from axcomp.fmu import package_native
from axcomp.model import fmu_sources, models
from axcomp.native import PLATFORMS, WASM, own_platform, prebuild, prebuilt, prebuilt_path, why_not_prebuilt

ELF = {"linux64": (2, 62), "aarch64-linux": (2, 183), "linux32": (1, 3)}
"""Class (1: 32 bit, 2: 64 bit) and e_machine."""
PE = {"win64": 0x8664, "win32": 0x14C}
MACH_O = {"x86_64": 0x01000007, "arm64": 0x0100000C}


def binaries(fmu: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(fmu) as archive:
        return {name: archive.read(name) for name in archive.namelist() if name.startswith("binaries/")}


def test_they_are_those_of_the_committed_sources() -> None:
    assert why_not_prebuilt() == "", "run python -m axcomp.native.prebuild"
    assert {path.name for path in prebuilt.FOLDER.iterdir()} == {
        *(prebuilt_path(platform).name for platform in (*PLATFORMS, WASM)),
        "manifest.json",
    }


@pytest.mark.parametrize("platform", (*PLATFORMS, WASM))
def test_nothing_in_them_tells_where_or_when_they_were_built(platform: str) -> None:
    data = prebuilt_path(platform).read_bytes()
    for word in (b"/root", b"/home", b"/tmp", b"/work", b"zig-cache", b".zig", b"GNU\0", b".pdb", b".c\0"):
        assert word not in data
    if platform in ELF:
        assert data[:4] == b"\x7fELF"
        assert (data[4], struct.unpack_from("<H", data, 18)[0]) == ELF[platform]
    elif platform in PE:
        start = struct.unpack_from("<I", data, 60)[0]
        # The time stamp behind them is a hash of the content: see the test that builds again.
        assert struct.unpack_from("<4sH", data, start) == (b"PE\0\0", PE[platform])


def slices() -> Iterator[tuple[int, bytes]]:
    """Yield processor and bytes of each library in the universal one."""
    data = prebuilt_path("darwin64").read_bytes()
    magic, count = struct.unpack_from(">2I", data)
    assert magic == 0xCAFEBABE
    for i in range(count):
        processor, _, offset, size, alignment = struct.unpack_from(">5I", data, 8 + 20 * i)
        assert offset % (1 << alignment) == 0
        yield processor, data[offset : offset + size]
        if i == count - 1:
            assert offset + size == len(data)


def load_commands(data: bytes) -> dict[int, bytes]:
    place, found = 32, {}
    for _ in range(struct.unpack_from("<I", data, 16)[0]):
        command, size = struct.unpack_from("<2I", data, place)
        found[command] = data[place : place + size]
        place += size
    return found


def test_macos_gets_one_library_for_both_processors() -> None:
    found = dict(slices())
    assert set(found) == set(MACH_O.values())
    for processor, data in found.items():
        magic, own, _, kind = struct.unpack_from("<4I", data)
        assert (magic, own, kind) == (0xFEEDFACF, processor, 6)  # 64 bit, dynamic library


def test_the_library_for_apples_processors_is_signed_ad_hoc() -> None:
    """They run nothing unsigned. Every page has the hash that the code directory says."""
    data = dict(slices())[MACH_O["arm64"]]
    offset, size = struct.unpack_from("<2I", load_commands(data)[0x1D], 8)
    blob = data[offset : offset + size]
    magic, _, count = struct.unpack_from(">3I", blob)
    assert magic == 0xFADE0CC0
    places = dict(struct.unpack_from(">2I", blob, 12 + 8 * i) for i in range(count))
    directory = blob[places[0] :]
    fields = struct.unpack_from(">9I4B", directory)
    assert fields[0] == 0xFADE0C02
    flags, hashes, pages, limit, hash_size, hash_kind, page = (
        *(fields[i] for i in (3, 4, 7, 8, 9, 10)),
        1 << fields[12],
    )
    assert flags & 2  # ad hoc
    assert (hash_size, hash_kind, limit) == (32, 2, offset)  # SHA-256 of everything before the signature
    for i in range(pages):
        end = min(limit, (i + 1) * page)
        expected = directory[hashes + 32 * i : hashes + 32 * (i + 1)]
        assert hashlib.sha256(data[i * page : end]).digest() == expected


@pytest.mark.slow
def test_building_them_again_anywhere_gives_the_same_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if importlib.util.find_spec("ziglang") is None or importlib.metadata.version("ziglang") != prebuild.COMPILER:
        pytest.skip(f"ziglang {prebuild.COMPILER} is not installed: pip install axcomp[cross]")
    shutil.copytree(fmu_sources(), tmp_path / "some where")
    monkeypatch.setattr("axcomp.native.sources.fmu_sources", lambda: tmp_path / "some where")
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    built = prebuild.build_libraries(tmp_path / "built")
    assert [name for name, data in built.items() if data != prebuilt_path(name).read_bytes()] == []


def without_compilers(folder: Path, *command: str) -> subprocess.CompletedProcess[str]:
    """Run Python where neither PATH nor the packages have a compiler."""
    environment = {**os.environ, "PATH": str(folder / "nothing"), "XDG_CACHE_HOME": str(folder / "cache")}
    environment.pop("CC", None)
    hide = "import importlib.util as u; f = u.find_spec; u.find_spec = lambda n, p=None: n != 'ziglang' and f(n, p)\n"
    return subprocess.run(
        [sys.executable, "-c", hide + command[0], *command[1:]],
        env=environment,
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )


BUILD = """
import sys, time
from axcomp.cli import main
status = main(["build", "--machine", sys.argv[1], "--output", "all.fmu"])
print(time.process_time())
sys.exit(status)
"""


def test_an_fmu_for_all_platforms_needs_no_compiler_little_time_and_little_room(tmp_path: Path) -> None:
    run = without_compilers(tmp_path, BUILD, str(models() / "three_axis"))
    assert run.returncode == 0, run.stderr
    assert set(binaries(tmp_path / "all.fmu")) == {
        f"binaries/{name}/axcomp{platform.suffix}" for name, platform in PLATFORMS.items()
    }
    assert (tmp_path / "all.fmu").stat().st_size <= 1_500_000
    assert float(run.stdout.splitlines()[-1]) <= 1.5


def test_the_engine_needs_no_compiler_for_its_kernel(tmp_path: Path) -> None:
    run = without_compilers(tmp_path, "from axcomp.native import compiled_kernel as c; print(c()._name)")
    assert run.stdout.strip() == str(prebuilt_path(own_platform())), run.stderr
    assert not (tmp_path / "cache").exists()


@pytest.fixture
def changed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Sources in which somebody has changed something."""
    folder = tmp_path / "changed"
    shutil.copytree(fmu_sources(), folder)
    monkeypatch.setattr("axcomp.native.sources.fmu_sources", lambda: folder)
    with (folder / "native" / "kernel.c").open("a", encoding="utf-8") as file:
        file.write("\n/* changed */\n")
    why_not_prebuilt.cache_clear()
    yield folder
    why_not_prebuilt.cache_clear()


def test_changed_sources_are_compiled_for_this_machine_and_that_is_said(
    changed: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert changed.is_dir()
    if not any(map(shutil.which, ("cc", "gcc", "clang"))):
        pytest.skip("there is no C compiler on this machine")
    assert main(["build", "--machine", str(models() / "three_axis"), "--output", str(tmp_path / "own.fmu")]) == 0
    own = own_platform()
    assert f"note: {prebuilt.STALE}: compiled for {own}" in capsys.readouterr().err
    assert list(binaries(tmp_path / "own.fmu")) == [f"binaries/{own}/axcomp{PLATFORMS[own].suffix}"]


def test_line_ends_are_no_change(changed: Path) -> None:
    for path in (changed / "native").iterdir():
        original = (fmu_sources() / "native" / path.name).read_bytes()
        path.write_bytes(original.replace(b"\n", b"\r\n"))
    assert why_not_prebuilt() == ""


def test_a_library_that_was_altered_is_not_packed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "prebuilt"
    shutil.copytree(prebuilt.FOLDER, folder)
    (folder / "win64.dll").write_bytes(b"MZ")
    monkeypatch.setattr(prebuilt, "FOLDER", folder)
    why_not_prebuilt.cache_clear()
    assert why_not_prebuilt() == "win64.dll is not the library that was built"
    monkeypatch.setattr(prebuilt, "MANIFEST", folder / "no.json")
    why_not_prebuilt.cache_clear()
    assert "cannot be read" in why_not_prebuilt()
    why_not_prebuilt.cache_clear()


def test_some_platforms_can_be_asked_for(tmp_path: Path) -> None:
    built = package_native(models() / "three_axis", tmp_path / "two.fmu", platforms=("win64", "aarch64-linux"))
    assert set(binaries(built.path)) == {"binaries/win64/axcomp.dll", "binaries/aarch64-linux/axcomp.so"}
