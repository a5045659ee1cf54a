from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
from frozen import GUID

from axcomp.fmu import BuildError, content_guid, generation_date, write_fmu

FILES = {"resources/b.txt": b"b", "modelDescription.xml": b"<x/>", "binaries/a.so": b"a" * 1000}


def test_the_order_of_the_files_does_not_matter(tmp_path: Path) -> None:
    write_fmu(tmp_path / "one.fmu", FILES)
    write_fmu(tmp_path / "two.fmu", dict(reversed(FILES.items())))
    assert (tmp_path / "one.fmu").read_bytes() == (tmp_path / "two.fmu").read_bytes()
    with zipfile.ZipFile(tmp_path / "one.fmu") as archive:
        assert archive.namelist() == ["modelDescription.xml", "binaries/a.so", "resources/b.txt"]
        assert archive.testzip() is None


def test_a_guid_depends_on_names_and_contents() -> None:
    guids = {content_guid(parts) for parts in ({}, {"a": b"b"}, {"ab": b""}, {"a": b"", "b": b""}, {"a": b"c"})}
    assert len(guids) == 5
    assert all(len(guid) == 38 and guid[0] == "{" and guid[-1] == "}" for guid in guids)
    assert content_guid({"b/c": b"", "a": b"one"}) == GUID


def test_a_file_that_cannot_be_written_leaves_the_old_one(tmp_path: Path) -> None:
    path = tmp_path / "old.fmu"
    path.mkdir()
    with pytest.raises(BuildError, match=r"old\.fmu cannot be written"):
        write_fmu(path, FILES)
    assert [entry.name for entry in tmp_path.iterdir()] == ["old.fmu"]


def test_the_date_is_constant_unless_the_environment_gives_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    assert generation_date() == generation_date()
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    assert generation_date() == "2023-11-14T22:13:20Z"
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    with pytest.raises(BuildError, match="yesterday"):
        generation_date()
