"""Where the host says the resources are: any URI, any path; and what an instance needs to find there."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from urllib.parse import quote

import fmpy
import pytest
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmu_host import in_child
from fmu_machines import three_axes

from axcomp.fmu import write_image
from axcomp.lists import write_machine
from axcomp.model import models

COSIMULATION = 1
NAMES = ("plain", "with blank", "ü", "+", "(a)", "[a]", "#1", "a,b", "100%", "%41", "ü + ( ) [ ] # , % ' &", "名")


def instantiated(folder: Path, locations: list[bytes | None], guid: str | None = "") -> list[list[str]]:
    """Make an instance with each resource location; return what the log says, ["instance"] where there is one."""
    description = fmpy.read_model_description(folder, validate=False)
    slave = FMU2Slave(
        guid=description.guid, modelIdentifier="axcomp", unzipDirectory=str(folder), instanceName="instance"
    )
    wanted = None if guid is None else (guid or description.guid).encode()
    results = []
    for location in locations:
        texts: list[str] = []
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(
            lambda *args, texts=texts: texts.append(args[-1].decode(errors="replace"))
        )
        callbacks.allocateMemory = defaultCallbacks.allocateMemory
        callbacks.freeMemory = defaultCallbacks.freeMemory
        component = slave.fmi2Instantiate(
            b"instance", COSIMULATION, wanted, location, ctypes.byref(callbacks), False, False
        )
        if component:
            texts.append("instance")
            slave.fmi2FreeInstance(component)
        results.append(texts)
    return results


@pytest.fixture
def unpacked(native_fmu: Path, tmp_path: Path) -> Path:
    return Path(fmpy.extract(native_fmu, tmp_path / "fmu"))


@pytest.mark.parametrize("name", NAMES)
def test_an_fmu_is_found_under_any_name(native_fmu: Path, tmp_path: Path, name: str) -> None:
    folder = Path(fmpy.extract(native_fmu, tmp_path / name / "fmu"))
    resources = folder / "resources"
    escaped = "".join(f"%{byte:02X}" if byte != ord("/") else "/" for byte in os.fsencode(resources))
    locations = [resources.as_uri(), f"file:{quote(str(resources))}", f"file://localhost{quote(str(resources))}"]
    locations += [f"file://{escaped.lower()}", f"{resources.as_uri()}/", str(resources), f"{resources}/"]
    locations += [f"FILE://LocalHost{quote(str(resources))}", f"file:////{quote(str(resources))}"]
    found = in_child(instantiated, folder, [location.encode() for location in locations])
    assert found == [["instance"]] * len(locations)


PATHS = {
    "file:///C:/a%20b": ("/C:/a b", "C:/a b"),
    "file:/c:/a": ("/c:/a", "c:/a"),
    "file:C:/a": ("C:/a", "C:/a"),
    "file://C:/a": ("//C:/a", "C:/a"),
    "file:///C%3A/a": ("/C:/a", "C:/a"),
    "file:///C|/a": ("/C|/a", "C:/a"),
    "FILE://LOCALHOST/C:/a": ("/C:/a", "C:/a"),
    "file://server/share/a": ("//server/share/a", "//server/share/a"),
    "file:////server/share": ("//server/share", "//server/share"),
    "file://///server/share": ("//server/share", "//server/share"),
    "file:/a%2Fb%25": ("/a/b%", "/a/b%"),
    "C:\\a%20b": ("C:\\a%20b", "C:\\a%20b"),
    "filed/a": ("filed/a", "filed/a"),
    "": ("", ""),
}
"""Location → the path that it means where there are no drives, and where there are."""


@pytest.mark.parametrize("drives", [0, 1])
def test_every_form_of_an_uri_means_its_path(tmp_path: Path, drives: int) -> None:
    if not shutil.which("gcc"):
        pytest.skip("gcc is not installed")
    native = models().parent / "fmu_src" / "native"
    library = tmp_path / "resource.so"
    command = ["gcc", "-std=c99", "-shared", "-fPIC", f"-DAXCOMP_DRIVES={drives}", str(native / "resource.c")]
    subprocess.run([*command, "-o", str(library)], check=True)
    path_of = ctypes.CDLL(str(library)).axcomp_path_of
    found = {}
    for location in PATHS:
        path = ctypes.create_string_buffer(5000)
        assert path_of(location.encode(), None, path) == 1
        found[location] = path.value.decode()
    assert found == {location: paths[drives] for location, paths in PATHS.items()}


def test_an_uri_that_is_not_percent_encoded_is_taken_as_it_is(native_fmu: Path, tmp_path: Path) -> None:
    folder = Path(fmpy.extract(native_fmu, tmp_path / "a b ü 5% #" / "fmu"))
    assert in_child(instantiated, folder, [f"file://{folder}/resources".encode()]) == [["instance"]]


def test_a_relative_path_counts_from_the_current_folder(unpacked: Path) -> None:
    relative = os.path.relpath(unpacked / "resources", Path.cwd())
    assert in_child(instantiated, unpacked, [relative.encode()]) == [["instance"]]


def test_without_a_location_the_image_beside_the_library_is_taken(unpacked: Path) -> None:
    assert in_child(instantiated, unpacked, [None, b""]) == [["instance"], ["instance"]]
    (unpacked / "resources" / "tables.bin").unlink()
    ((message,),) = in_child(instantiated, unpacked, [None])
    assert "tables.bin cannot be read" in message


@pytest.mark.parametrize(
    ("location", "text"),
    [
        (b"file:///nowhere", "/nowhere/tables.bin cannot be read"),
        (b"file:///%zz%", "cannot be read"),
        (b"http://somewhere/resources", "cannot be read"),
        (b"/" + b"a" * 5000, "too long"),
        (b"\xff\xfe%s%n%1000d", "cannot be read"),
    ],
)
def test_a_location_without_an_image_is_an_error_in_the_log(unpacked: Path, location: bytes, text: str) -> None:
    if location[0] == 0xFF and sys.platform == "win32":
        pytest.skip("no file name on Windows")
    ((message,),) = in_child(instantiated, unpacked, [location])
    assert text in message


@pytest.mark.parametrize(("guid", "text"), [("{other}", "the guid is {other}, but"), (None, "there is no guid")])
def test_the_guid_is_checked(unpacked: Path, guid: str | None, text: str) -> None:
    ((message,),) = in_child(instantiated, unpacked, [(unpacked / "resources").as_uri().encode()], guid)
    assert text in message


def foreign(image: Path, folder: Path) -> None:
    """Put the image of another machine there."""
    write_machine(three_axes(3.0), folder / "lists")
    write_image(folder / "lists", image)


def altered(image: Path, _: Path) -> None:
    """Alter its last byte."""
    data = image.read_bytes()
    image.write_bytes(data[:-1] + bytes([data[-1] ^ 1]))


def cut(image: Path, _: Path) -> None:
    """Leave half of it."""
    data = image.read_bytes()
    image.write_bytes(data[: len(data) // 2])


def replaced_by_a_folder(image: Path, _: Path) -> None:
    """Let a folder have its name."""
    image.unlink()
    image.mkdir()


@pytest.mark.parametrize(
    ("spoil", "text"),
    [
        (foreign, "but the tables belong to {"),
        (altered, "tables.bin is refused: it has been altered"),
        (cut, "tables.bin is refused: it is truncated"),
        (replaced_by_a_folder, "tables.bin cannot be read"),
        (lambda image, _: image.unlink(), "tables.bin cannot be read"),
    ],
)
def test_an_instance_needs_the_image_of_its_own_fmu(
    unpacked: Path, tmp_path: Path, spoil: Callable[[Path, Path], None], text: str
) -> None:
    spoil(unpacked / "resources" / "tables.bin", tmp_path)
    ((message,),) = in_child(instantiated, unpacked, [(unpacked / "resources").as_uri().encode()])
    assert text in message


def test_the_lists_may_be_taken_out(unpacked: Path) -> None:
    shutil.rmtree(unpacked / "resources" / "machine")
    assert in_child(instantiated, unpacked, [(unpacked / "resources").as_uri().encode()]) == [["instance"]]
