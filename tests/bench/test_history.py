"""Figures are kept from run to run, goals are judged, and nothing else is overwritten."""

from __future__ import annotations

from pathlib import Path

import pytest

from axcomp.bench import HistoryError, Sample, compared, save
from axcomp.cli import main

FIGURES = [
    Sample("a cycle", "ns", (90.0, 110.0, 100.0), 120.0),
    Sample("many / few", ":1", (1.5, 1.6, 1.7), 1.3),
    Sample("speed", "×", (9.0,), 8.0),
    Sample("slowness", "×", (7.0,), 8.0),
    Sample("free", "ms", (3.0,)),
]


def test_goals_are_missed_on_the_side_their_unit_says() -> None:
    assert [one.missed for one in FIGURES] == [False, True, False, True, False]


def test_a_page_has_every_figure_and_the_runs_before(tmp_path: Path) -> None:
    page = tmp_path / "performance.md"
    save(page, FIGURES)
    save(page, [Sample("a cycle", "ns", (50.0,), 120.0), *FIGURES[1:]])
    text = page.read_text(encoding="utf-8")
    assert "| a cycle | 50 ns | 50 … 50 | at most 120 ns ✓ |" in text
    assert "| many / few | 1.6 :1 | 1.5 … 1.7 | at most 1.3 :1 ✗ |" in text
    assert "| a cycle | 100 ns | 50 ns |" in text
    assert compared(page, FIGURES)[0] == "a cycle: 2.00 of 50 ns"
    assert len(compared(page, [*FIGURES, Sample("new", "s", (1.0,))])) == len(FIGURES)


@pytest.mark.parametrize("text", ["", "{}x", "[1]", '[{"figures": 3, "date": "now"}]', '{"a": 1}'])
def test_what_is_no_history_is_left_as_it_is(tmp_path: Path, text: str) -> None:
    page, data = tmp_path / "performance.md", tmp_path / "performance.json"
    data.write_text(text, encoding="utf-8")
    with pytest.raises(HistoryError, match=r"performance\.json"):
        save(page, FIGURES)
    assert (data.read_text(encoding="utf-8"), page.exists()) == (text, False)


def test_there_is_nothing_to_compare_with_before_the_first_run(tmp_path: Path) -> None:
    with pytest.raises(HistoryError, match="no saved run"):
        compared(tmp_path / "performance.md", FIGURES)


@pytest.mark.parametrize(("options", "code"), [((), 0), (("--strict",), 1)])
def test_missed_goals_are_marked_and_strict_fails(
    options: tuple[str, ...], code: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("axcomp.cli.bench._samples", lambda _: iter(FIGURES))
    assert main(["bench", *options]) == code
    out, err = capsys.readouterr()
    assert [line.split("  ")[0] for line in out.splitlines() if line.endswith("MISSED")] == ["many / few", "slowness"]
    assert "goals missed: 2: many / few; slowness" in err
