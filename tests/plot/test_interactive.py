"""Volumes that can be turned: what is drawn is what the field holds, on a page that needs nothing beside it."""

from __future__ import annotations

import json
import re
import sys
from base64 import b64decode
from pathlib import Path

import numpy as np
import pytest

from axcomp.cli import main
from axcomp.lists import read_machine
from axcomp.model import models
from axcomp.plot import Field, contents_of

Capture = pytest.CaptureFixture[str]


@pytest.fixture(scope="module")
def field() -> Field:
    [found] = [one for one in contents_of(read_machine(models() / "five_axis").machine) if isinstance(one, Field)]
    return found


def numbers(column: dict[str, str]) -> list[float]:
    assert column["dtype"] == "f8"
    return np.frombuffer(b64decode(column["bdata"])).tolist()


def test_left_is_the_nominal_volume_and_right_the_deformed_one_with_one_scale(field: Field) -> None:
    html = field.interactive()
    data = json.loads(re.search(r'Plotly\.newPlot\(\s*"[^"]+",\s*(\[.*?\}\]),\s*\{', html, re.S)[1])  # type: ignore[index]
    assert [trace["scene"] for trace in data] == ["scene", "scene", "scene2", "scene2", "scene", "scene2"]
    nominal, real = (data[k] for k in (1, 3))
    assert (nominal["marker"]["cmin"], nominal["marker"]["cmax"]) == (0.0, field.largest())
    assert (real["marker"]["cmin"], real["marker"]["cmax"]) == (0.0, field.largest())
    largest = int(field.sizes().argmax())
    assert "size 37.09 µm" in real["text"][largest]
    # 37.09 µm at X −300, Y 250, Z 0; the way between places is 200, 500/3 and 400/3 mm: 4 mm are drawn for each µm.
    for axis, at, error in zip("xyz", (-300.0, 250.0, 0.0), (-35.3, 11.23, -1.86), strict=True):
        assert numbers(nominal[axis])[largest] == at
        assert numbers(real[axis])[largest] == pytest.approx(at + 4.0 * error, abs=0.03)


def test_a_page_holds_the_script_once_and_only_where_it_is_asked_for(tmp_path: Path) -> None:
    flat, turning = tmp_path / "flat.html", tmp_path / "turning.html"
    five_axis = str(models() / "five_axis")
    assert main(["show", five_axis, "--output", str(flat)]) == 0
    assert main(["show", five_axis, "--output", str(turning), "--interactive"]) == 0
    assert "<script" not in flat.read_text(encoding="utf-8")
    text = turning.read_text(encoding="utf-8")
    assert text.count("Plotly.newPlot(") == 1
    assert not re.search(r'<script[^>]*\ssrc=|<link[^>]*\shref="http', text)
    assert len(text) > 1_000_000


def test_without_plotly_there_is_a_sentence_and_no_file(
    tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "plotly", None)
    for command in ("show", "report"):
        output = tmp_path / f"{command}.html"
        assert main([command, str(models() / "five_axis"), "--output", str(output), "--interactive"]) > 0
        assert "pip install 'axcomp[interactive]'" in capsys.readouterr().err
        assert not output.exists()


def test_the_tool_visits_every_node(field: Field) -> None:
    frames = re.findall(r'"traces":\[4,5\]', field.interactive())
    assert len(frames) == len(field.positions)
