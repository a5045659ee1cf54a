"""Every code has a page, an example that shows it, and a place in the documentation."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from frozen import SEVERITIES
from linting import Write
from small_lists import LEADSCREW

from axcomp.cli import main
from axcomp.lint import PAGE, help_address, page, pages

WITHOUT_EXAMPLE = {"AXC-BINARY", "110638", "110639", "110640", "110641"}
"""No text is no text; an update needs a machine that runs."""


def test_every_code_says_what_it_means_why_it_matters_and_how_it_is_mended() -> None:
    assert {code: one.severity for code, one in pages().items()} == SEVERITIES
    for one in pages().values():
        assert all(text.endswith(".") for text in (one.meaning, one.why, one.mend)), one.code
    assert {code for code, one in pages().items() if not one.example} == WITHOUT_EXAMPLE


@pytest.mark.parametrize("code", sorted(set(SEVERITIES) - WITHOUT_EXAMPLE))
def test_the_example_of_a_code_shows_it(code: str, write: Write, codes: Callable[..., list[str]]) -> None:
    write(pages()[code].files)
    assert code in codes(".", *pages()[code].options)


def test_the_page_is_current_and_has_an_anchor_for_every_code() -> None:
    text = PAGE.read_text("utf-8")
    assert text == page()
    assert all(f"\n## {code}\n" in text for code in SEVERITIES)


def test_help_leads_to_the_page_that_is_installed_or_to_the_one_that_is_set() -> None:
    assert help_address("AXC-GAP") == f"{PAGE.as_uri()}#axc-gap"
    assert help_address("AXC-GAP", "https://here/findings") == "https://here/findings#axc-gap"


def test_a_code_is_explained_on_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "--explain", "axc-gap"]) == 0
    assert "## AXC-GAP" in capsys.readouterr().out
    assert main(["check", "--explain", "AXC-NONSENSE"]) == 2
    assert "there is no code AXC-NONSENSE" in capsys.readouterr().err


def test_the_page_travels_in_the_wheel() -> None:
    text = (Path(__file__).parents[2] / "pyproject.toml").read_text()
    assert 'only-include = ["axcomp", "docs/findings.md"]\nsources = { "docs" = "axcomp/_docs" }' in text


def test_a_binary_file_is_found(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    write({"achskw1.lis": LEADSCREW.encode() + b"\0"})
    assert main(["check", "achskw1.lis", "--format", "json"]) == 1
    assert [one["code"] for one in json.loads(capsys.readouterr().out)["findings"]] == ["AXC-BINARY"]
