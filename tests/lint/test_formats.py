"""What is printed for programs, against the schemas of the formats, and for people."""

import io
import json
import os
import pty
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest
from frozen import SEVERITIES
from jsonschema import Draft202012Validator
from linting import Write
from pydantic_sarif.model import StaticAnalysisResultsFormatSarifVersion210JsonSchema as Sarif
from small_lists import LEADSCREW

from axcomp.cli import main
from axcomp.lint import Style

ROOT = Path(__file__).parents[2]
Printed = Callable[..., str]
FAULTY = {
    "ä b/achskw1.lis": LEADSCREW.replace("pos 2", "pos x") + "\tkw.ssfk.table[2].pos 4\n",
    "good/achskw1.lis": LEADSCREW,
}


@pytest.fixture
def printed(write: Write, capsys: pytest.CaptureFixture[str]) -> Printed:
    def text(*options: str, files: dict[str, str] | None = None) -> str:
        write(FAULTY if files is None else files)
        capsys.readouterr()
        main(["check", ".", *options])
        return capsys.readouterr().out

    return text


def test_sarif_is_valid_and_has_rules_columns_and_help(printed: Printed) -> None:
    text = printed("--format", "sarif")
    Sarif.model_validate_json(text)
    [run] = json.loads(text)["runs"]
    rules = run["tool"]["driver"]["rules"]
    assert {rule["id"] for rule in rules} == set(SEVERITIES)
    levels = {"error": "error", "warning": "warning", "info": "note"}
    assert {rule["id"]: rule["defaultConfiguration"]["level"] for rule in rules} == {
        c: levels[s] for c, s in SEVERITIES.items()
    }
    assert all(rule["helpUri"].endswith(f"findings.md#{rule['id'].lower()}") for rule in rules)
    first, second = run["results"]
    assert [rules[one["ruleIndex"]]["id"] for one in (first, second)] == ["AXC-ZEROED", "AXC-TWICE"]
    place = second["locations"][0]["physicalLocation"]
    assert place["artifactLocation"]["uri"] == "%C3%A4%20b/achskw1.lis"
    assert place["region"] == {"startLine": 8, "startColumn": 2, "endColumn": 22}
    assert run["columnKind"] == "unicodeCodePoints"


def test_fingerprints_stay_when_lines_move_and_differ(printed: Printed) -> None:
    def prints(text: str) -> list[str]:
        results = json.loads(text)["runs"][0]["results"]
        return [one["partialFingerprints"]["axcomp/v1"] for one in results]

    twice = LEADSCREW + "kw.ssfk.colour 1\nkw.ssfk.colour 1\n"
    before = prints(printed("--format", "sarif", files={"achskw1.lis": twice}))
    after = prints(printed("--format", "sarif", files={"achskw1.lis": f"\n\n{twice}"}))
    assert before == after
    assert len(set(before)) == 2


def test_json_is_as_its_published_schema_says(printed: Printed) -> None:
    schema = json.loads((ROOT / "docs" / "check.schema.json").read_text())
    Draft202012Validator.check_schema(schema)
    for options in ((), ("--feed", "1000")):
        told = json.loads(printed("--format", "json", *options))
        Draft202012Validator(schema).validate(told)
        assert f"urn:axcomp:check:{told['version']}" == schema["$id"]
    assert [one["path"] for one in told["machines"]] == ["good", "ä b"]


def test_junit_has_a_case_for_every_finding_and_one_for_what_is_well(printed: Printed) -> None:
    root = ElementTree.fromstring(printed("--format", "junit").encode())
    assert (root.tag, root.get("tests"), root.get("failures")) == ("testsuites", "3", "1")
    cases = {case.get("name"): [child.tag for child in case] for case in root.iter("testcase")}
    assert cases == {
        "good": [],
        "ä b/achskw1.lis:6 AXC-ZEROED": ["failure"],
        "ä b/achskw1.lis:8 AXC-TWICE": ["system-out"],
    }
    root = ElementTree.fromstring(printed("--format", "junit", "--fail-on", "warning").encode())
    assert root.get("failures") == "2"


def test_junit_holds_what_xml_cannot(printed: Printed) -> None:
    ElementTree.fromstring(
        printed("--format", "junit", files={"achskw1.lis": LEADSCREW + 'kw.ssfk.a\f<&"]]> 1\n'}).encode()
    )


def test_annotations_of_github_are_escaped(printed: Printed) -> None:
    first, second = printed("--format", "github").splitlines()
    assert first.startswith("::error file=ä b/achskw1.lis,line=6,col=1,title=AXC-ZEROED::kw.ssfk.table[1].pos = x")
    assert second.startswith("::warning file=ä b/achskw1.lis,line=8,col=2,title=AXC-TWICE::")
    [escaped] = printed(
        "--format", "github", files={"ä b/achskw1.lis": LEADSCREW, "a,b:c%/achskw1.lis": LEADSCREW + "50% %\n"}
    ).splitlines()
    assert escaped.startswith("::warning file=a%2Cb%3Ac%25/achskw1.lis,line=8,title=AXC-SYNTAX::“50%25 %25”")


def test_code_quality_of_gitlab(printed: Printed) -> None:
    rows = json.loads(printed("--format", "gitlab"))
    assert [(row["check_name"], row["severity"], row["location"]["lines"]["begin"]) for row in rows] == [
        ("AXC-ZEROED", "critical", 6),
        ("AXC-TWICE", "minor", 8),
    ]
    assert all(set(row) == {"description", "check_name", "fingerprint", "severity", "location"} for row in rows)
    assert len({row["fingerprint"] for row in rows}) == 2


def test_a_pipe_gets_a_line_for_each_finding_and_no_colour(printed: Printed) -> None:
    lines = printed().splitlines()
    assert lines[0].startswith("ä b/achskw1.lis:6:1: error AXC-ZEROED: kw.ssfk.table[1].pos")
    assert len(lines) == 3
    assert "\033" not in "".join(lines)


@pytest.mark.parametrize(
    ("environment", "terminal", "colour"),
    [
        ({}, True, True),
        ({}, False, False),
        ({"NO_COLOR": "1"}, True, False),
        ({"NO_COLOR": ""}, True, True),
        ({"TERM": "dumb"}, True, False),
        ({"FORCE_COLOR": "1"}, False, True),
        ({"FORCE_COLOR": "1", "NO_COLOR": "1"}, False, False),
    ],
)
def test_colour_is_for_terminals(environment: dict[str, str], terminal: bool, colour: bool) -> None:
    class Stream(io.StringIO):
        def isatty(self) -> bool:
            return terminal

    assert Style.of(Stream(), environment).colour is colour


def test_a_terminal_of_80_columns_gets_lines_that_fit(write: Write) -> None:
    write(FAULTY)
    master, slave = pty.openpty()
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "80", "TERM": "xterm"}
    environment.pop("NO_COLOR", None)
    command = [sys.executable, "-c", "from axcomp.cli import main; main(['check', '.'])"]
    process = subprocess.Popen(command, stdout=slave, env=environment)
    os.close(slave)
    told = b""
    while chunk := _read(master):
        told += chunk
    process.wait()
    os.close(master)
    assert b"\033[31merror AXC-ZEROED\033[0m" in told
    lines = re.sub(r"\033\[\d*m", "", told.decode()).splitlines()
    assert len(lines) > 3
    assert max(map(len, lines)) <= 80


def _read(descriptor: int) -> bytes:
    try:
        return os.read(descriptor, 4096)
    except OSError:
        return b""
