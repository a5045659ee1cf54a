"""What there is to be checked below a path, and the exit status."""

import io
import json
import sys
import time
from pathlib import Path

import pytest
from linting import Write
from small_lists import LEADSCREW

from axcomp.cli import main
from axcomp.lint import Settings, find_machines
from axcomp.model import models

Capture = pytest.CaptureFixture[str]
START = "zahl_kw 1\nachs_kw[0] kw.lis\n"


def names(*paths: str) -> list[str]:
    return [path.as_posix() for path, _ in find_machines(map(Path, paths), Settings())]


def test_a_folder_is_searched_for_machines(write: Write) -> None:
    write(
        {
            "a/hochlauf.lis": START,
            "a/kw.lis": LEADSCREW,
            "a/sub/readme.txt": "kw.ssfk.unit 1",
            "b/achskw1.lis": LEADSCREW,
            "c/start.lis": "zahl_kw 1\nachs_kw[0] lists/achskw1.lis\n",
            "c/lists/achskw1.lis": LEADSCREW,
            "d/any.lis": "x 1\ny 2\nz 3\nchain XYZ\n",
            ".hidden/achskw1.lis": LEADSCREW,
            "node_modules/achskw1.lis": LEADSCREW,
        }
    )
    assert names(".") == ["a", "b", "c/start.lis", "d/any.lis"]
    assert names("a", "b/achskw1.lis") == ["a", "b/achskw1.lis"]


def test_a_list_beside_a_machine_that_does_not_name_it_is_checked_alone(write: Write) -> None:
    write({"hochlauf.lis": START, "kw.lis": LEADSCREW, "old.lis": LEADSCREW, "achskw7.lis": LEADSCREW})
    assert names(".") == [".", "achskw7.lis", "old.lis"]


def test_the_example_machines_are_found() -> None:
    assert [Path(name).name for name in names(str(models()))] == [
        "five_axis",
        "manual_examples",
        "rotary_table",
        "three_axis",
        "warm_axis",
    ]


def test_several_machines_are_summed_up(write: Write, capsys: Capture) -> None:
    write({"a/achskw1.lis": LEADSCREW, "b/achskw1.lis": LEADSCREW.replace("pos 2", "pos x")})
    assert main(["check", "a", "b"]) == 1
    assert capsys.readouterr().out.splitlines()[-1] == (
        "1 error, 0 warnings, 0 infos; 2 machines, 2 axes with 2 compensations."
    )


@pytest.mark.parametrize(
    ("text", "options", "status"),
    [
        (LEADSCREW, [], 0),
        (LEADSCREW, ["--fail-on", "info"], 0),
        (LEADSCREW.replace("pos 2", "pos x"), [], 1),
        (LEADSCREW.replace("pos 2", "pos x").replace("pos 3", "pos y"), [], 1),
        (LEADSCREW.replace("pos 2", "pos x"), ["--exit-zero"], 0),
        (f"{LEADSCREW}kw.ssfk.colour 1\n", [], 0),
        (f"{LEADSCREW}kw.ssfk.colour 1\n", ["--fail-on", "warning"], 1),
        (f"{LEADSCREW}kopf.mds_ident 1\n", ["--fail-on", "warning"], 0),
        (f"{LEADSCREW}kopf.mds_ident 1\n", ["--fail-on", "info"], 1),
        (LEADSCREW, ["--feed", "fast"], 2),
        (LEADSCREW, ["--select", "nothing"], 2),
        (LEADSCREW, ["--feed", "fast", "--exit-zero"], 2),
    ],
)
def test_the_exit_status_is_that_of_a_linter(text: str, options: list[str], status: int, write: Write) -> None:
    write({"achskw1.lis": text})
    assert main(["check", ".", *options]) == status


@pytest.mark.parametrize("options", [["--format", "xml"], ["--fail-on", "fatal"], ["--fix", "--diff"]])
def test_a_wrong_command_line_is_2_too(options: list[str], write: Write) -> None:
    write({"achskw1.lis": LEADSCREW})
    with pytest.raises(SystemExit, match="2"):
        main(["check", ".", *options])


def test_quiet_is_silent_where_nothing_is_found(write: Write, capsys: Capture) -> None:
    write({"achskw1.lis": LEADSCREW, "sub/achskw1.lis": f"{LEADSCREW}kw.ssfk.colour 1\n"})
    assert main(["check", "achskw1.lis", "-q"]) == 0
    assert capsys.readouterr().out == ""
    main(["check", "sub", "-q"])
    assert len(capsys.readouterr().out.splitlines()) == 1


def test_the_version_is_told(capsys: Capture) -> None:
    with pytest.raises(SystemExit, match="0"):
        main(["--version"])
    assert capsys.readouterr().out.startswith("axcomp 0.")


def test_standard_input_is_a_list_of_any_kind(write: Write, monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    write({"sub/kw.lis": LEADSCREW})

    def told(text: str, *options: str) -> list[tuple[str, str]]:
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text.encode("latin-1"))))
        main(["check", "-", "--format", "json", *options])
        return [(one["file"], one["code"]) for one in json.loads(capsys.readouterr().out)["findings"]]

    assert told(LEADSCREW + "# ä\n") == []
    assert told(LEADSCREW.replace("pos 2", "pos x")) == [("-", "AXC-ZEROED")]
    assert told("lr_param.ssfk 1\n") == [("-", "AXC-NUMBER")]
    assert told(START) == [("-", "AXC-MISSING")] * len(told(START))
    assert told(START, "--stdin-filename", "sub/hochlauf.lis") == []


def _sixteen_axes(folder: Path) -> None:
    folder.mkdir()
    kinds = "".join(f"antr.parameter_{i} {i}\nkenngr.other_{i} 5\n" for i in range(100))
    names = ["zahl_kw 16\nzahl_mds 16\n"]
    for axis in range(1, 17):
        names.append(f"achs_kw[{axis - 1}] achskw{axis}.lis\nachs_mds[{axis - 1}] achsmd{axis}.lis\n")
        rows = "".join(f"kw.ssfk.table[{i}].pos {i % 50}\n" for i in range(300))
        head = f"kopf.achs_nr {axis}\nkw.ssfk.unit 1\nkw.ssfk.interval 10000\nkw.ssfk.kw_nr_max 300\n"
        (folder / f"achskw{axis}.lis").write_text(f"{head}{rows}kopf.mds_ident 3\n".replace("% 50", ""))
        (folder / f"achsmd{axis}.lis").write_text(f"kopf.achs_nr {axis}\nlr_param.ssfk 1\n{kinds}")
    (folder / "hochlauf.lis").write_text("".join(names))


def test_a_real_machine_that_is_well_is_told_in_ten_lines(tmp_path: Path, capsys: Capture) -> None:
    _sixteen_axes(tmp_path / "real")
    start = time.process_time()
    assert main(["check", str(tmp_path / "real"), "--ignore", "AXC-OUTLIER,AXC-SEAM"]) == 0
    assert time.process_time() - start < 2.0  # on a busy machine; alone it takes a quarter of that
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) <= 10, lines
    assert "In 32 files: Entries of the controller" in lines[0]


def _machine(**more: str) -> dict[str, str]:
    return {"m/hochlauf.lis": START, "m/kw.lis": LEADSCREW} | more


@pytest.mark.parametrize(
    "files",
    [
        _machine(),
        {"m/hochlauf.lis": "zahl_kw 0\n"},
        {"m/hochlauf.lis": "zahl_mds 1\nachs_mds[0] a.lis\n", "m/a.lis": "kopf.achs_nr 1\n"},
        {"m/hochlauf.lis": START.replace("kw.lis", "HERE/m/kw.lis"), "m/kw.lis": LEADSCREW},
        {"m/hochlauf.lis": START.replace("kw.lis", "../other/kw.lis"), "other/kw.lis": LEADSCREW},
        {"m/hochlauf.lis": START.replace("kw.lis", "HERE/other/kw.lis"), "other/kw.lis": LEADSCREW},
        {"m/achskw1.lis": LEADSCREW},
        {"m/vol_comp0.lis": "x 1\ny 2\nz 3\nfile[0] e.csv\n", "m/e.csv": "X EXX\n0 1e-3\n"},
    ],
)
def test_what_build_refuses_has_an_error(files: dict[str, str], write: Write, capsys: Capture) -> None:
    folder = write({})
    write({name: text.replace("HERE", str(folder)) for name, text in files.items()})
    path = next((name for name in files if "vol_comp" in name), "m")
    refused = main(["build", "--machine", path, "--image", "tables.bin"]) != 0
    assert main(["check", path]) == int(refused), capsys.readouterr()
