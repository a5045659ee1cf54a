"""A stranger's lists: nothing outside their folder is opened, listed or written, whatever they name."""

from __future__ import annotations

import os
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import pytest

from axcomp.cli import main
from axcomp.lists import read_machine
from axcomp.model import models

ROOT = Path(__file__).parents[2]
SECRET = "the secret of another folder"

WATCHED = """\
import os, sys, tempfile
from pathlib import Path
folder, allowed = Path(sys.argv[1]), [Path(p) for p in sys.argv[2].split(os.pathsep)]
opened = []
events = {"open", "os.listdir", "os.scandir", "os.rename", "os.remove", "os.mkdir", "os.link", "os.symlink", "os.chmod"}
sys.addaudithook(lambda event, args: event in events and opened.append((event, args[0])))
import axcomp.cli, axcomp.lists, axcomp.analysis.diagnosis
axcomp.lists.read_machine(folder)
axcomp.lists.read_machine(folder / "hochlauf.lis")
for words in (
    ["check"],
    ["build", "--runtime", "python", "--output", str(folder / "x.fmu"), "--diagnosis", "--machine"],
    ["build", "--verbose", "--image", str(folder / "x.bin"), "--machine"],
    ["show", "--output", str(folder / "x.csv")],
    ["diagnose"],
):
    axcomp.cli.main([*words, str(folder)])
real = {(event, os.path.realpath(os.fspath(name))) for event, name in opened if not isinstance(name, int) and name}
print("OUTSIDE", sorted((e, p) for e, p in real if not any(Path(p).is_relative_to(a) for a in allowed)))
"""


def stranger(folder: Path) -> Path:
    """Write lists that reach for what lies beside their folder in every way a list can."""
    lists, outside = folder / "lists", folder / "outside"
    lists.mkdir(parents=True)
    outside.mkdir()
    for name in ("credentials", "achsmd1.lis", "achskw1.lis", "e.csv", "hidden.lis"):
        (outside / name).write_text(f"kopf.achs_nr 1\n# {SECRET}\n")
    (outside / "e.csv").write_text(f"X0X // {SECRET}\n0.01\n")
    (outside / "thesis.docx").write_bytes(b"PK a thesis")
    (outside / "empty.cfg").touch()
    (lists / "link.csv").symlink_to(outside / "e.csv")
    (lists / "linked").symlink_to(outside)
    (lists / "achskw7.lis").symlink_to(outside / "achskw1.lis")
    (lists / "e.csv").write_text("X0X\n0.01\n")
    (lists / "md.lis").write_text("kopf.achs_nr 1\nkopf.log_achs_name X\n")
    entries = [
        "zahl_mds 4",
        "achs_mds[0] md.lis",
        r"achs_mds[1] ..\outside\achsmd1.lis",
        "achs_mds[2] LINKED/ACHSMD1.LIS",
    ]
    entries += [f"achs_mds[3] {outside / 'achsmd1.lis'}", f"default_achs_mds {outside / 'hidden.lis'}"]
    entries += [
        "zahl_kw 3",
        "achs_kw[0] ../outside/achskw1.lis",
        "achs_kw[1] achskw7.lis",
        "achs_kw[2] linked/achskw1.lis",
    ]
    for k in range(5):
        entries += [f"vol_comp[{k}].file_name v{k}.lis", f"vol_comp[{k}].max_records 9"]
    (lists / "hochlauf.lis").write_text("\n".join(entries) + "\n")
    files = ["../outside/credentials", "link.csv", str(outside / "e.csv"), "linked/e.csv", "e.csv"]
    diagnoses = [
        "../outside/thesis.docx",
        "linked/empty.cfg",
        str(outside / "empty.cfg"),
        "../outside/new.xlsx",
        "d.xlsx",
    ]
    for k, (file, diagnosis) in enumerate(zip(files, diagnoses, strict=True)):
        (lists / f"v{k}.lis").write_text(f"x 1\nfile[0] {file}\ndiagnosis_file {diagnosis}\n")
    return lists


def test_nothing_outside_the_folder_is_opened_listed_or_written(tmp_path: Path) -> None:
    if os.name == "nt":
        pytest.skip("links need rights there")
    lists = stranger(tmp_path / "cnc")
    before = {path: path.read_bytes() for path in (tmp_path / "cnc" / "outside").iterdir()}
    own = [ROOT, Path(sys.prefix), Path(sys.base_prefix), Path("/usr"), Path("/etc"), Path("/proc"), Path("/lib")]
    allowed = os.pathsep.join(map(str, [lists, *map(Path.resolve, own)]))
    places = dict.fromkeys(("HOME", "TMPDIR", "MPLCONFIGDIR"), str(lists))
    environment = {**os.environ, **places, "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"}
    words = [sys.executable, "-c", WATCHED, str(lists), allowed]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "OUTSIDE []"
    assert {path: path.read_bytes() for path in (tmp_path / "cnc" / "outside").iterdir()} == before
    assert (lists / "d.xlsx").is_file()
    with zipfile.ZipFile(lists / "x.fmu") as archive:
        assert not [name for name in archive.namelist() if SECRET.encode() in archive.read(name)]
    found = [finding for finding in read_machine(lists).findings if finding.code == "AXC-FOLDER"]
    assert len(found) == 12
    assert {f.severity.value for f in found} == {"error"}
    assert SECRET not in done.stdout + done.stderr


def test_a_start_up_list_that_is_a_link_elsewhere_is_refused(tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("zahl_kw 0\n")
    (tmp_path / "lists").mkdir()
    (tmp_path / "lists" / "hochlauf.lis").symlink_to("../secret")
    for path in (tmp_path / "lists", tmp_path / "lists" / "hochlauf.lis"):
        assert [f.code for f in read_machine(path).findings] == ["AXC-FOLDER"]
    assert not [f for f in read_machine(path, allow_outside=[tmp_path]).findings if f.code == "AXC-FOLDER"]


def test_a_folder_that_is_a_link_is_a_folder(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(models() / "three_axis")
    assert read_machine(tmp_path / "link").machine == read_machine(models() / "three_axis").machine


def test_a_parameter_file_beyond_max_records_is_refused_before_it_is_read(tmp_path: Path) -> None:
    (tmp_path / "hochlauf.lis").write_text("vol_comp[0].file_name v.lis\nvol_comp[0].max_records 1000\n")
    (tmp_path / "v.lis").write_text("x 1\ny 2\nz 3\nfile[0] e.csv\n")
    with (tmp_path / "e.csv").open("w") as file:
        file.write("X EXX\n")
        for k in range(4_000):
            file.write("".join(f"{k}.{i:03} 0.001\n" for i in range(1000)))
    size = (tmp_path / "e.csv").stat().st_size
    assert size > 50_000_000
    begin = time.process_time()
    [finding] = [f for f in read_machine(tmp_path).findings if f.severity.value == "error"]
    assert time.process_time() - begin < 1.0
    assert (finding.code, f"{size:,} bytes" in finding.message) == ("AXC-UNREADABLE", True)


def test_build_names_what_it_packs_and_replaces_nothing_of_others(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    machine = str(models() / "three_axis")
    assert main(["build", "--machine", machine, "--runtime", "python", "--verbose", "--output", str(tmp_path)]) == 0
    told = [line for line in capsys.readouterr().out.splitlines() if line.startswith("packed: ")]
    with zipfile.ZipFile(tmp_path / "axcomp.fmu") as archive:
        assert [line.split()[1] for line in told] == archive.namelist()
    assert f"packed: resources/machine/hochlauf.lis from {machine}/hochlauf.lis" in told
    first = (tmp_path / "axcomp.fmu").read_bytes()
    assert main(["build", "--machine", machine, "--runtime", "python", "--output", str(tmp_path)]) == 0
    assert (tmp_path / "axcomp.fmu").read_bytes() == first
    for content in (b"", b"PK a thesis", b"text\n", (b"PK\5\6" + bytes(18))):
        for option in ("--output", "--image"):
            path = tmp_path / "mine"
            path.write_bytes(content)
            assert main(["build", "--machine", machine, "--runtime", "python", option, str(path)]) == 1
            assert "was not written by axcomp; it stays as it is" in capsys.readouterr().err
            assert path.read_bytes() == content


def test_a_workbook_that_somebody_has_gone_on_with_is_theirs(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    path = tmp_path / "d.xlsx"
    words = ["diagnose", str(models() / "five_axis"), "--id", "0", "--output", str(path)]
    assert [main(words), main(words)] == [0, 0]
    book = openpyxl.load_workbook(path)
    book.properties.lastModifiedBy = "a user"
    book.save(path)
    mine = path.read_bytes()
    assert main(words) == 1
    assert path.read_bytes() == mine
