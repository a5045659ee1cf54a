"""``axcomp sweep`` on the command line: sentences instead of tracebacks."""

from pathlib import Path

import pytest

from axcomp.cli import main


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["none.toml", "--output", "r.csv"], "none.toml: the specification cannot be read"),
        (["s.toml", "--output", "r.xlsx"], "r.xlsx must end in .parquet or .csv"),
        (["s.toml", "--output", "nowhere/r.csv"], "there is no folder nowhere for r.csv"),
        (["s.toml", "--output", "r.csv", "--workers", "0"], "at least one worker"),
        (["s.toml", "--output", "r.csv", "--plot", "p.png"], "--plot needs --x and --y"),
        (["s.toml", "--output", "r.csv"], "s.toml: machine: expected the path"),
    ],
)
def test_what_is_wrong_is_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], arguments, said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("s.toml").write_text("machine = 3\n")
    assert main(["sweep", *arguments]) == 1
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1


def test_help_has_examples(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["sweep", "--help"])
    assert ended.value.code == 0
    assert "examples:\n  axcomp sweep sweep.toml --output results.parquet" in capsys.readouterr().out
