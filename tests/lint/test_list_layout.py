"""The layout of a list: entries, values and comments stay, and a second time there is nothing to do."""

import io
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st
from linting import Write

from axcomp.cli import main
from axcomp.kinds import ListKind
from axcomp.lint import formatted
from axcomp.lists import Document, read_machine
from axcomp.model import models

MESSY = """\



kopf.achs_nr 1   the axis
   kw.ssfk.unit\t1
kw.ssfk.interval    100000 # 10 mm
  # rows



kw.ssfk.kw_nr_max 2
kw.ssfk.table[ 0].pos 1 ( first )
kw.ssfk.table[1].pos 2
/* a remark
     over two lines */
End


"""
NEAT = """\
kopf.achs_nr                             1       the axis
kw.ssfk.unit                             1
kw.ssfk.interval                         100000  # 10 mm
# rows

kw.ssfk.kw_nr_max                        2
kw.ssfk.table[0].pos                     1       ( first )
kw.ssfk.table[1].pos                     2
/* a remark
     over two lines */
End
"""


def test_a_list_gets_its_layout(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    write({"achskw1.lis": MESSY})
    assert main(["format", ".", "--check"]) == 1
    assert capsys.readouterr().out == "achskw1.lis: not in its layout\n"
    assert main(["format", ".", "--diff"]) == 1
    assert "+kopf.achs_nr                             1" in capsys.readouterr().out
    assert Path("achskw1.lis").read_text() == MESSY
    assert main(["format", "."]) == 0
    assert Path("achskw1.lis").read_text() == NEAT
    assert main(["format", ".", "--check"]) == 0


def test_standard_input_is_formatted_to_standard_output(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(MESSY.encode())))
    assert main(["format", "-"]) == 0
    assert capsys.readouterr().out == NEAT


@pytest.mark.parametrize(("codec", "newline"), [("latin-1", "\r\n"), ("utf-16", "\r\n"), ("utf-8-sig", "\n")])
def test_encoding_and_line_ends_stay(codec: str, newline: str, write: Write) -> None:
    write({"achskw1.lis": f"{MESSY}# größer\n".replace("\n", newline).encode(codec)})
    assert main(["format", "."]) == 0
    assert Path("achskw1.lis").read_bytes().decode(codec).startswith(f"kopf.achs_nr{' ' * 29}1")
    text = Path("achskw1.lis").read_bytes().decode(codec)
    assert text.count("\n") == text.count(newline) > 5
    assert "größer" in text


def test_lists_that_are_not_there_are_a_sentence(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    write({})
    assert main(["format", "none.lis"]) == 2
    assert "none.lis: There is no such file." in capsys.readouterr().err.replace(": error AXC-MISSING", "").replace(
        ":0", ""
    )


@pytest.mark.parametrize("path", sorted(models().rglob("*.lis")), ids=lambda path: f"{path.parent.name}/{path.name}")
def test_lists_of_the_examples_mean_the_same(path: Path) -> None:
    for document in read_machine(path).documents.values():
        _check(document)


WORDS = st.sampled_from(
    [
        "kw.ssfk.interval",
        "kw.ssfk.table[0].pos",
        "kopf.log_achs_name",
        "1",
        "-2.5",
        "#",
        "(",
        "/*",
        "*/",
        "End",
        "X",
        '"',
        " ",
        "\t",
        "\n",
        "\n\n\n",
        "ä",
        "…",
    ]
)


@settings(max_examples=300, deadline=None)
@given(st.lists(WORDS, max_size=40).map("".join))
def test_any_text_keeps_its_entries(text: str) -> None:
    _check(Document("any.lis", text.encode(), ListKind.COMPENSATION))


def _check(document: Document) -> None:
    text = formatted(document)
    if text is None:
        return
    after = Document(document.path, text.encode(), document.kind)
    told = [[(one.name, one.value, one.comment) for one in each.entries] for each in (document, after)]
    assert told[0] == told[1]
    if document.kind is not None:
        assert formatted(after) == text


def test_the_layout_is_that_of_the_writer() -> None:
    lists = read_machine(models() / "five_axis").documents.values()
    assert [str(one.path) for one in lists if formatted(one) not in (None, one.text.lstrip())] == []
