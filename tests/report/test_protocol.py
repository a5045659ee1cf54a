"""The protocol: what it says, where that comes from, and that it prints to A4."""

import hashlib
import json
import re
import shutil
from datetime import date

import pytest

from axcomp.cli import main
from axcomp.model import models

SAMPLES = models() / "measurements"
LISTS = models() / "three_axis"
PAIR = ["--measurement", str(SAMPLES / "x.csv"), "--measurement", str(SAMPLES / "x_after.csv")]
JOB = 'machine = "Mill 7"\nserial = 12345\noperator = "N. N."\ntemperature = "20.3 °C"\n'


def protocol(tmp_path, *words):
    assert main(["report", str(LISTS), "--protocol", "--output", str(tmp_path / "p.html"), *words]) == 0
    return (tmp_path / "p.html").read_text()


def test_fields_come_from_a_file_and_from_options_which_go_before_it(tmp_path):
    (tmp_path / "job.toml").write_text(JOB)
    words = ["--fields", str(tmp_path / "job.toml"), "--serial", "777 <b>", "--instrument", "XL-80"]
    page = protocol(tmp_path, *words, *PAIR)
    cells = dict(re.findall(r"<tr><td>(\w+)</td><td>(.*?)</td></tr>", page))
    assert cells["Machine"] == "Mill 7"
    assert cells["Serial"] == "777 &lt;b&gt;"
    assert cells["Temperature"] == "20.3 °C"
    assert cells["Instrument"] == "XL-80"
    assert cells["Operator"] == "N. N."
    assert cells["Axis"] == "X"
    assert cells["Program"] == "axcomp"
    assert cells["Date"] == date.today().isoformat()
    assert set(cells["Remarks"]) == set("&nbsp;")


def test_what_a_measurement_says_of_itself_is_taken(tmp_path):
    page = protocol(tmp_path, "--measurement", str(SAMPLES / "x.rtl"))
    cells = dict(re.findall(r"<tr><td>(\w+)</td><td>(.*?)</td></tr>", page))
    assert (cells["Machine"], cells["Serial"], cells["Operator"], cells["Place"]) == (
        "Mill 7",
        "12345",
        "N. N.",
        "hall 2",
    )


def test_every_list_and_measurement_has_its_checksum(tmp_path):
    page = protocol(tmp_path, *PAIR)
    for file in [*LISTS.glob("*.lis"), SAMPLES / "x.csv", SAMPLES / "x_after.csv"]:
        assert f'<td>{file.name}</td><td class="sum">{hashlib.sha256(file.read_bytes()).hexdigest()}</td>' in page


def test_before_and_after_have_a_table_of_differences(tmp_path, capsys):
    page = protocol(tmp_path, *PAIR, "--format", "json")
    found = json.loads(capsys.readouterr().out)["differences"][0]["differences"]
    rows = {row["figure"]: row for row in found}
    assert rows["B̄"]["difference"] == pytest.approx(-3.0, abs=0.01)
    assert rows["A"]["left_percent"] == pytest.approx(100.0 * rows["A"]["after"] / rows["A"]["before"])
    assert "after − before" in page
    assert "@page { size: A4" in page


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ('colour = "red"', "“colour” is no field of a protocol"),
        ("serial = ", "job.toml: "),
        ("serial = [1]", "no single"),
    ],
)
def test_a_wrong_file_of_fields_is_said(tmp_path, capsys, text, sentence):
    (tmp_path / "job.toml").write_text(text)
    words = [
        "report",
        str(LISTS),
        "--protocol",
        "--fields",
        str(tmp_path / "job.toml"),
        "--output",
        str(tmp_path / "p.html"),
    ]
    assert main(words) == 1
    assert sentence in capsys.readouterr().err
    assert not (tmp_path / "p.html").exists()
    assert main(["report", str(LISTS), "--serial", "1", "--output", str(tmp_path / "p.html")]) == 1


@pytest.mark.skipif(shutil.which("chromium") is None, reason="needs chromium")
@pytest.mark.slow
def test_it_prints_to_a4(tmp_path):
    import subprocess

    protocol(tmp_path, *PAIR)
    pdf = tmp_path / "p.pdf"
    flags = ["--headless", "--no-sandbox", "--disable-gpu", f"--print-to-pdf={pdf}", f"file://{tmp_path}/p.html"]
    subprocess.run(["chromium", *flags], check=True, capture_output=True, timeout=120)
    assert re.search(rb"/MediaBox\s*\[\s*0 0 59[45][.\d]* 84[12]", pdf.read_bytes())
