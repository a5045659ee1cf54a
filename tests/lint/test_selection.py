"""Which findings are told: by options, settings, comments in lists, and what is known already."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from linting import Write
from small_lists import LEADSCREW

from axcomp.cli import main
from axcomp.lint import SettingsError, find_settings

Codes = Callable[..., list[str]]
FAULTS = LEADSCREW + "kw.ssfk.table[2].pos 4\nkw.ssfk.colour 1\nkw.ssfk.table[3].pos 9\n"
"""AXC-TWICE in line 8, AXC-UNKNOWN in 9, AXC-UNUSED in 10."""


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ((), ["AXC-TWICE", "AXC-UNKNOWN", "AXC-UNUSED"]),
        (("--select", "AXC-TWICE"), ["AXC-TWICE"]),
        (("--select", "AXC-UN"), ["AXC-UNKNOWN", "AXC-UNUSED"]),
        (("--select", "AXC-UN,AXC-TWICE", "--ignore", "AXC-UNU"), ["AXC-TWICE", "AXC-UNKNOWN"]),
        (("--ignore", "AXC"), []),
        (("--ignore", "AXC", "--select", "AXC-UNUSED"), ["AXC-UNUSED"]),
        (("--ignore", "ALL", "--select", "AXC-T"), ["AXC-TWICE"]),
        (("--select", "70"), []),
    ],
)
def test_codes_are_chosen_by_their_beginnings_the_closest_decides(
    options: tuple[str, ...], expected: list[str], write: Write, codes: Codes
) -> None:
    write({"achskw1.lis": FAULTS})
    assert codes("achskw1.lis", *options) == expected


@pytest.mark.parametrize("option", ["--select=AXC-NO-SUCH", "--ignore=X", "--select="])
def test_what_is_no_code_is_refused(option: str, write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    write({"achskw1.lis": LEADSCREW})
    assert main(["check", "achskw1.lis", option]) == 2
    assert "no code of a finding" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (FAULTS.replace("colour 1", "colour 1 # axcomp: ignore AXC-UNKNOWN"), ["AXC-TWICE", "AXC-UNUSED"]),
        (FAULTS.replace("colour 1", "colour 1 ( axcomp: ignore AXC-TWICE, AXC-UNK )"), ["AXC-TWICE", "AXC-UNUSED"]),
        (FAULTS.replace("kw.ssfk.colour", "# AXCOMP: ignore AXC-UNKNOWN\nkw.ssfk.colour"), ["AXC-TWICE", "AXC-UNUSED"]),
        (
            FAULTS.replace("kw.ssfk.colour", "# axcomp: ignore AXC-UNKNOWN\n\n# more\nkw.ssfk.colour"),
            ["AXC-TWICE", "AXC-UNUSED"],
        ),
        (f"# axcomp: ignore-file AXC-UN\n{FAULTS}", ["AXC-TWICE"]),
        (
            FAULTS.replace("colour 1", "colour 1 # axcomp: ignore"),
            ["AXC-IGNORE", "AXC-TWICE", "AXC-UNKNOWN", "AXC-UNUSED"],
        ),
        (
            FAULTS.replace("colour 1", "colour 1 # axcomp: ignore QQ"),
            ["AXC-IGNORE", "AXC-TWICE", "AXC-UNKNOWN", "AXC-UNUSED"],
        ),
        (
            FAULTS.replace("kw.ssfk.unit 1", "kw.ssfk.unit 1 # axcomp: ignore AXC-UNKNOWN"),
            ["AXC-TWICE", "AXC-UNKNOWN", "AXC-UNUSED"],
        ),
    ],
)
def test_a_list_hides_findings_about_its_entries(text: str, expected: list[str], write: Write, codes: Codes) -> None:
    write({"achskw1.lis": text})
    assert sorted(codes("achskw1.lis")) == expected


def test_an_error_that_is_hidden_does_not_fail(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    write({"achskw1.lis": LEADSCREW.replace("pos 2", "pos x # axcomp: ignore AXC-ZEROED")})
    assert main(["check", "achskw1.lis"]) == 0
    assert "0 errors, 0 warnings, 0 infos, 1 hidden;" in capsys.readouterr().out


def test_settings_are_found_upwards_and_options_change_them(write: Write, codes: Codes) -> None:
    write(
        {"pyproject.toml": '[tool.axcomp]\nignore = ["AXC-TWICE"]\n', "a/b/achskw1.lis": FAULTS, "a/pyproject.toml": ""}
    )
    assert codes("a") == ["AXC-UNKNOWN", "AXC-UNUSED"]
    assert codes("a", "--ignore", "AXC-UNUSED") == ["AXC-UNKNOWN"]
    write({"a/axcomp.toml": 'select = ["AXC-UNUSED"]\n'})
    assert codes("a/b") == ["AXC-UNUSED"]


def test_files_have_ignores_of_their_own(write: Write, codes: Codes) -> None:
    second = FAULTS.replace("achs_nr 1", "achs_nr 2")
    settings = '[per-file-ignores]\n"old/*" = ["ALL"]\n"achskw2.lis" = ["AXC-UN"]\n'
    write({"axcomp.toml": settings, "achskw1.lis": FAULTS, "achskw2.lis": second, "old/achskw1.lis": FAULTS})
    assert sorted(codes(".")) == ["AXC-TWICE", "AXC-TWICE", "AXC-UNKNOWN", "AXC-UNUSED"]


def test_excluded_folders_are_not_searched(write: Write, codes: Codes) -> None:
    write(
        {
            "axcomp.toml": 'exclude = ["old", "b*/x"]\n',
            "old/achskw1.lis": FAULTS,
            "b1/x/achskw1.lis": FAULTS,
            "c/achskw1.lis": LEADSCREW,
        }
    )
    assert codes(".") == []
    assert codes("old/achskw1.lis") != []


def test_fail_on_and_format_are_settings(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    write({"axcomp.toml": 'fail-on = "warning"\nformat = "json"\n', "achskw1.lis": FAULTS})
    assert main(["check"]) == 1
    assert json.loads(capsys.readouterr().out)["counts"]["warning"] == 3
    assert main(["check", "--fail-on", "error"]) == 0


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("colour = 1", "there is no setting 'colour'; there are select, ignore, per-file-ignores"),
        ('select = "AXC"', "select must be a list of strings"),
        ("ignore = [1]", "ignore must be a list of strings"),
        ('ignore = ["AXC-NONSENSE"]', "'AXC-NONSENSE' is no code of a finding"),
        ('fail-on = "fatal"', "fail-on = 'fatal' is none of error, warning, info"),
        ("baseline = 3", "baseline must be a string"),
        ('per-file-ignores = "x"', "per-file-ignores must be a table"),
        ('per-file-ignores = {a = ["Q"]}', "'Q' is no code of a finding"),
        ("select = [", "axcomp.toml:"),
    ],
)
def test_settings_that_cannot_be_followed_are_refused_with_a_sentence(
    text: str, sentence: str, write: Write, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = write({"axcomp.toml": text, "achskw1.lis": LEADSCREW})
    assert main(["check", "."]) == 2
    told = capsys.readouterr().err
    assert sentence in told
    assert "axcomp.toml" in told
    with pytest.raises(SettingsError):
        find_settings(folder)


def test_what_is_known_is_not_told_again_but_what_is_new_is(write: Write, codes: Codes) -> None:
    folder = write({"achskw1.lis": FAULTS})
    assert main(["check", ".", "--write-baseline", "known.json"]) == 0
    assert codes(".", "--baseline", "known.json") == []
    write({"achskw1.lis": "\n\n" + FAULTS.replace("table[3].pos 9", "table[3].pos 9\nkw.ssfk.colour 7")})
    assert codes(".", "--baseline", "known.json") == ["AXC-UNKNOWN"]
    write({"sub/axcomp.toml": 'baseline = "../known.json"\n', "sub/x.txt": ""})
    assert json.loads((folder / "known.json").read_text())["findings"][0]["file"] == "achskw1.lis"


@pytest.mark.parametrize("content", [None, "{", "[]", '{"version": 9}', '{"version": 1, "findings": [{}]}'])
def test_what_is_no_baseline_is_refused(content: str | None, write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    write({"achskw1.lis": LEADSCREW} | ({} if content is None else {"known.json": content}))
    assert main(["check", ".", "--baseline", "known.json"]) == 2
    assert "known.json" in capsys.readouterr().err
    assert not Path("-").exists()
