"""Whatever stands in lists and settings: a status and sentences, never a traceback, and nothing left to mend."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from axcomp.cli import main

NAMES = """
    kopf.achs_nr kw.ssfk.interval kw.ssfk.intervall kw.ssfk.kw_nr_max kw.ssfk.table[0].pos kw.ssfk.table[1].setpoint
    kw.crosscomp.table[0].setpoint kw.crosscomp.table[1].setpoint zahl_kw achs_kw[0] achskw1.lis frict_comp.table[0].in
    1 -7 2.5 x EXX [EXX] # /* */ ( " AXC-TWICE End <a><![CDATA[ ]]></a> …
"""
WORDS = [*NAMES.split(), "VALUE = 1", "axcomp: ignore", " ", " ", "\n", "\n", "\r\n", "\t", "\x1a"]
TEXTS = st.lists(st.sampled_from(WORDS), max_size=60).map("".join)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("any")


@settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=TEXTS.map(str.encode) | st.binary(max_size=100) | TEXTS.map(lambda text: text.encode("utf-16")))
@pytest.mark.parametrize("name", ["achskw1.lis", "any.xti", "hochlauf.lis"])
def test_any_list_is_checked_mended_and_laid_out(name: str, data: bytes, folder: Path) -> None:
    for old in folder.iterdir():
        old.unlink()
    path = folder / name
    path.write_bytes(data)
    for format_name in ("text", "json", "sarif", "junit", "github", "gitlab"):
        assert main(["check", str(path), "--format", format_name]) in {0, 1}
    assert main(["check", str(folder), "--fix"]) in {0, 1}
    mended = path.read_bytes()
    assert main(["check", str(folder), "--fix"]) in {0, 1}
    assert path.read_bytes() == mended
    assert main(["format", str(path)]) in {0, 2}
    laid_out = path.read_bytes()
    assert main(["format", str(path)]) in {0, 2}
    assert path.read_bytes() == laid_out


@settings(max_examples=100, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    data=st.binary(max_size=60)
    | st.sampled_from([b"select = 1", b"[tool]\naxcomp = 3", b"a.b = []", b"per-file-ignores.x = 1"])
)
@pytest.mark.parametrize("name", ["axcomp.toml", "pyproject.toml", "known.json"])
def test_any_settings_are_followed_or_refused(name: str, data: bytes, folder: Path) -> None:
    for old in folder.iterdir():
        old.unlink()
    (folder / "achskw1.lis").write_text("kopf.achs_nr 1\n")
    (folder / name).write_bytes(data)
    assert main(["check", str(folder), "--baseline", str(folder / "known.json")]) in {0, 1, 2}
