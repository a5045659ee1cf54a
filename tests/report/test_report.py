"""The report: one page with everything, which needs nothing beside it."""

from __future__ import annotations

import io
import json
import re
import shutil
import subprocess
from contextlib import redirect_stdout
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote
from xml.etree import ElementTree

import numpy as np
import pytest

from axcomp.cli import main
from axcomp.demo.examples import TRAJECTORIES
from axcomp.kinds import Cross, Friction, Leadscrew
from axcomp.lists import read_machine, write_machine
from axcomp.model import Axis, AxisType, ErrorTable, Machine, ModuloRange, Volumetric, models
from axcomp.report import make_report

Capture = pytest.CaptureFixture[str]

X = tuple(20.0 * k for k in range(11))
PITCH = tuple(round(0.012 * k / 10 + 0.004 * np.sin(k), 4) for k in range(11))
ERRORS = (ErrorTable("EXX", (0.0, 0.01), "X", ((0.0,), (200.0,))), ErrorTable("C0Y", (1e-5,)))
MACHINE = Machine(
    (
        Axis(1, "X", volumetric_limit=0.5, leadscrew=Leadscrew(X, PITCH), friction=Friction((1.0, 9.0), (30.0, 20.0))),
        Axis(2, "Y", volumetric_limit=0.5, cross=Cross(1, (0.0, 100.0, 200.0), (0.0, 0.009, 0.0), n_cycles=10)),
        Axis(3, "Z", volumetric_limit=0.5),
        Axis(4, "C", AxisType.ROTARY, ModuloRange(), leadscrew=Leadscrew((0.0, 340.0), (0.0, 0.004), modulo=True)),
    ),
    (Volumetric(0, (("X", 1), ("Y", 2), ("Z", 3)), errors=ERRORS),),
)
CHAPTERS = ["machine", "findings", "sign", "dynamics", "coverage", "limits", "iso230", "budget", "tables", "cost"]
CHROMIUM = shutil.which("chromium")
FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--enable-logging=stderr",
    "--dump-dom",
)
VOID = {"meta", "link", "img", "br"}


class Page(HTMLParser):
    """Reads a page and notes what it would load, run or link to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.sources: list[str] = []
        self.handlers: list[str] = []
        self.open: list[str] = []
        self.text = ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs) -> None:
        self.tags.append(tag)
        if tag not in VOID:
            self.open.append(tag)
        for name, value in attrs:
            if name == "id":
                self.ids.append(value)
            elif name in {"href", "src", "action", "data", "srcset"}:
                (self.links if name == "href" else self.sources).append(value)
            elif name.startswith("on"):
                self.handlers.append(name)

    def handle_endtag(self, tag) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data) -> None:
        self.text += data


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Lists, a measurement of X that its table suits, and an input file that leaves the table."""
    folder = tmp_path_factory.mktemp("machine")
    write_machine(MACHINE, folder)
    rows = [
        f"{x},{run},{d},{1e3 * p + 0.1 * run:.3f}\n"
        for x, p in zip(X, PITCH, strict=True)
        for run in (1, 2, 3)
        for d in "+-"
    ]
    (folder / "x.csv").write_text("# axis: X\ntarget,run,direction,deviation\n" + "".join(rows))
    places = np.linspace(-10.0, 190.0, 60)
    (folder / "input.csv").write_text("X.setpoint,Y.setpoint\n" + "".join(f"{p},{p / 2}\n" for p in places))
    return folder


@pytest.fixture(scope="module")
def everything(folder: Path) -> Path:
    """Return a page with all chapters."""
    options = ["--measurement", str(folder / "x.csv"), "--feed", "30000", "--max-acceleration", "1"]
    options += ["--input", str(folder / "input.csv"), "--repeats", "1", "--format", "json"]
    with redirect_stdout(io.StringIO()) as printed:
        assert main(["report", str(folder), "--output", str(folder / "all.html"), *options]) == 0
    (folder / "all.json").write_text(printed.getvalue(), encoding="utf-8")
    return folder / "all.html"


def test_the_page_has_all_chapters_in_their_order(everything: Path) -> None:
    page = Page(everything.read_text(encoding="utf-8"))
    assert [one for one in page.ids if one in CHAPTERS] == CHAPTERS


def test_the_page_needs_nothing_beside_it(everything: Path) -> None:
    text = everything.read_text(encoding="utf-8")
    page = Page(text)
    assert not page.open
    assert not page.handlers
    assert not {"script", "iframe", "object", "embed", "form", "base"} & set(page.tags)
    assert page.sources
    drawn = [unquote(source) for source in page.sources if source.startswith("data:image/svg+xml,")]
    assert drawn
    assert all("<svg" in one and not re.search(r"href='(?!#)|url\((?!#)|<script", one) for one in drawn)
    assert all(ElementTree.fromstring(one.partition(",")[2]).get("viewBox") for one in drawn)
    pictures = sum(source.startswith("data:image/png;base64,") for source in page.sources)
    assert pictures + len(drawn) == len(page.sources)
    anchors = [link for link in page.links if link != "data:,"]
    assert {link.removeprefix("#") for link in anchors} <= set(page.ids)
    assert len(set(page.ids)) == len(page.ids)
    assert not re.search(r"url\(|@import|https?://", text)


def test_the_page_says_what_was_found(everything: Path, folder: Path) -> None:
    text = Page(everything.read_text(encoding="utf-8")).text
    for piece in (
        "4 axes with 5 compensations in force",
        "AXC-SEAM",
        "AXC-SIGN",
        "the leadscrew table of X",
        "as written",
        "AXC-COVERAGE",
        "up to 10 mm below",
        "AXC-DYNAMICS-KINK",
        "volumetric[0] EXX",
        "X: leadscrew",
        "Axis Y: cross compensation",
        "x.csv, axis X",
        "cycle of this machine",
    ):
        assert piece in text
    assert str(folder) in text


def test_chapters_without_content_are_left_out(tmp_path: Path) -> None:
    write_machine(Machine((Axis(1, "X"),)), tmp_path)
    page = Page(make_report(read_machine(tmp_path), repeats=0).html())
    assert page.ids == ["machine", "findings", "tables"]
    assert "Nothing was found in the lists." in page.text


def test_names_from_lists_are_no_html(tmp_path: Path) -> None:
    axis = replace(MACHINE.axes[0], name="<b>x</b>&amp;", friction=None, volumetric_limit=None)
    write_machine(Machine((axis,)), tmp_path)
    page = Page(make_report(read_machine(tmp_path), repeats=0).html())
    assert "b" not in page.tags
    assert not page.open


def test_figures_as_json(everything: Path) -> None:
    found = json.loads(everything.with_suffix(".json").read_text(encoding="utf-8"))
    assert found["output"] == str(everything)
    assert found["counts"]["error"] == 0
    assert "X-leadscrew" in found["tables"]
    assert found["judgement"]["signs"][0]["verdict"] == "as written"
    assert found["iso230"][0]["parameters"]["B"] == pytest.approx(0.0, abs=1e-9)
    assert found["budget"]["axes"]["X"]["contributions"]
    assert all(cost["low"] <= cost["median"] <= cost["high"] for cost in found["cost"])


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--measurement", "none.csv"], "none.csv: The file cannot be read"),
        (["--input", "none.csv"], "none.csv: The file cannot be read"),
        (["--feed", "much"], "“much” is no [AXIS=]VALUE"),
    ],
)
def test_what_cannot_be_followed_is_on_the_page_and_counts(
    options: list[str], sentence: str, tmp_path: Path, capsys: Capture
) -> None:
    write_machine(Machine((Axis(1, "X"),)), tmp_path)
    output = tmp_path / "r.html"
    assert main(["report", str(tmp_path), "--output", str(output), "--repeats", "0", *options]) == 1
    assert sentence in capsys.readouterr().err
    assert sentence in Page(output.read_text(encoding="utf-8")).text


def test_an_input_with_an_unknown_column_has_no_budget_but_a_report(tmp_path: Path, capsys: Capture) -> None:
    write_machine(Machine((replace(MACHINE.axes[0], friction=None),)), tmp_path)
    (tmp_path / "in.csv").write_text("X.setpoint,Q.setpoint\n0,0\n1,0\n")
    output = tmp_path / "r.html"
    options = ["--input", str(tmp_path / "in.csv"), "--output", str(output), "--repeats", "0"]
    assert main(["report", str(tmp_path), *options]) == 1
    assert "There is no budget: Q.setpoint is no input" in capsys.readouterr().err
    assert "coverage" in Page(output.read_text(encoding="utf-8")).ids


def test_without_a_machine_there_is_no_page(tmp_path: Path, capsys: Capture) -> None:
    assert main(["report", str(tmp_path / "none"), "--output", str(tmp_path / "r.html")]) == 1
    printed = capsys.readouterr().err
    assert "AXC-MISSING" in printed
    assert "there is no machine in" in printed
    assert not (tmp_path / "r.html").exists()


def test_a_folder_that_is_not_there_is_a_sentence(folder: Path, tmp_path: Path, capsys: Capture) -> None:
    assert main(["report", str(folder), "--output", str(tmp_path / "no" / "r.html")]) == 1
    assert "there is no folder" in capsys.readouterr().err


def test_help_has_an_example(capsys: Capture) -> None:
    with pytest.raises(SystemExit, match="0"):
        main(["report", "--help"])
    assert "axcomp report models" in capsys.readouterr().out.partition("examples:")[2]


def console_of(page: Path, profile: Path) -> list[str]:
    """Open a page in a headless browser and return what its console says."""
    assert CHROMIUM is not None
    command = [CHROMIUM, *FLAGS, f"--user-data-dir={profile}", page.as_uri()]
    result = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    assert "</html>" in result.stdout
    return [line for line in result.stderr.splitlines() if "CONSOLE" in line]


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="Chromium is not installed")
def test_the_console_of_a_browser_has_no_error(everything: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken.html"
    broken.write_text("<!DOCTYPE html><script>missing()</script>")
    assert any("missing is not defined" in line for line in console_of(broken, tmp_path / "first"))
    assert console_of(everything, tmp_path / "second") == []


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="Chromium is not installed")
@pytest.mark.parametrize("model", sorted(TRAJECTORIES))
def test_reports_of_the_examples_open_without_an_error(model: str, tmp_path: Path) -> None:
    output = tmp_path / "report.html"
    given = models() / model / "input.csv"
    options = ["--input", str(given)] if given.exists() else []
    assert main(["report", str(models() / model), "--output", str(output), "--repeats", "1", *options]) == 0
    assert console_of(output, tmp_path / "profile") == []
