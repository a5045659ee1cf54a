"""Bytes to text, text to entries, words to numbers and strings."""

from decimal import Decimal

import pytest
from hypothesis import given, strategies as st

from axcomp.lists import Entry, decode, entries, number, string


def read(text: str) -> tuple[list[tuple[str, str]], list[tuple[str, int]]]:
    """Return (name, first word) of each entry, and (code, line) of each report."""
    reports: list[tuple[str, int]] = []
    found = [(e.name, e.word) for e in entries(text, lambda code, line, _: reports.append((code, line)))]
    return found, reports


def only(text: str) -> Entry:
    [entry] = entries(text, lambda *report: pytest.fail(str(report)))
    return entry


@pytest.mark.parametrize(
    ("line", "name", "word"),
    [
        ("kopf.achs_nr 3", "kopf.achs_nr", "3"),
        ("\tkopf.achs_nr\t 3  ", "kopf.achs_nr", "3"),
        ("dummy[1] 1 Comment", "dummy[1]", "1"),
        ("dummy[2] 1 # Comment", "dummy[2]", "1"),
        ("dummy[3] 1 ( Comment", "dummy[3]", "1"),
        ("dummy[4] 1 /* Comment", "dummy[4]", "1"),
        ("kw.crosscomp2.table[ 0][ 1].correction   -3", "kw.crosscomp2.table[0][1].correction", "-3"),
        ("kw.ssfk.table[  12 ].pos 4", "kw.ssfk.table[12].pos", "4"),
        ("a[1].b[2].c[3].d 4.5", "a[1].b[2].c[3].d", "4.5"),
        ("a -1.5e3x", "a", "-1.5e3x"),
        ("a 12/* glued", "a", "12/*"),
        ("a", "a", ""),
        ("a /* no value */", "a", ""),
        ("End 5", "End", "5"),
        ("a\u00a01", "a", "1"),
    ],
)
def test_an_entry_is_a_name_and_a_value(line: str, name: str, word: str) -> None:
    entry = only(line)
    assert (entry.name, entry.word) == (name, word)


@pytest.mark.parametrize("line", ["", "   ", "#", "# Data", "#no blank", "   # indented", "#a 1"])
def test_comments_and_blank_lines_are_nothing(line: str) -> None:
    assert read(line) == ([], [])


@pytest.mark.parametrize("line", ["...", ":", "…", "  :  ", "::", ".."])
def test_elisions_are_reported(line: str) -> None:
    assert read(f"a 1\n{line}\nb 2") == ([("a", "1"), ("b", "2")], [("AXC-ELISION", 2)])


@pytest.mark.parametrize(
    "line", ["****", "= 3", "table*/", "a[x] 1", "a[-1] 1", "a[1,2] 1", "5 a", "a[0 1", "/* c", "a[1 2] 3"]
)
def test_what_is_no_entry_is_reported(line: str) -> None:
    assert read(f"{line}\nb 2") == ([("b", "2")], [("AXC-SYNTAX", 1)])


@pytest.mark.parametrize(
    "comment",
    [
        "/* one line */",
        "  /* two\n lines */  ",
        "/*\nb 3\nEnd\n# */",
        "c 4 /* after a value\n b 3 */",
        "c 1.5   /*\n\n*/",
        "c[ 0].d 4 /* after a value */",
        "c /* instead of a value\n b 3 */",
        "c TEXT /* after a value\n b 3 */",
        "c A | B /* after a value\n b 3 */",
    ],
)
def test_comments_go_over_several_lines(comment: str) -> None:
    found, reports = read(f"a 1\n{comment}\nb 2")
    assert [(name, word) for name, word in found if name[0] in "ab"] == [("a", "1"), ("b", "2")]
    assert [name[0] for name, _ in found] == ["a", *"c"[: comment.startswith("c")], "b"]
    assert reports == []


@pytest.mark.parametrize(
    ("text", "names", "reports"),
    [
        # A comment after a value need not be closed: the next line begins another one.
        ("a 1 /* open\nb 2 /* closed */\nc 3", "abc", []),
        ("a 1 /* open\nb 2", "ab", []),
        ("/* open\nb 2", "b", [1]),
        ("# /* no opening\nb 2\n# */", "b", []),
        ('a "/* a string\nb 2\n# */', "ab", []),
        ("a 1 ( /* within\nb 2\n# */", "ab", []),
        ("a 1 # /* within\nb 2\n# */", "ab", []),
        # What stands behind the end of a comment is not taken, and is told.
        ("/* open\n*/ b 2", "", [2]),
        ("/* a */ b 2", "", [1]),
        ("a 1 /* open */ /*\nb 2", "ab", []),
        ("/* a\n*/\n/* b\n*/\nc 3", "c", []),
        ("a 1 /* x\ny */ /* z\nb 2 */", "ab", [2]),
    ],
)
def test_no_entry_is_lost_in_a_comment_that_is_none(text: str, names: str, reports: list[int]) -> None:
    found, reported = read(text)
    assert ("".join(name for name, _ in found), reported) == (names, [("AXC-SYNTAX", line) for line in reports])


@pytest.mark.parametrize("end", ["End", "END", "end  ", " End"])
def test_end_ends_the_list(end: str) -> None:
    assert read(f"a 1\n{end}\n\n") == ([("a", "1")], [])
    assert read(f"a 1\n{end}\n\nb 2\nc 3") == ([("a", "1")], [("AXC-END", 4)])


@pytest.mark.parametrize(
    ("data", "text"),
    [
        ("ä ″ °".encode(), "ä ″ °"),
        ("\ufeffä".encode(), "ä"),
        ("ä °".encode("latin-1"), "ä °"),
        ("\ufeffä °\r\n".encode("utf-16-le"), "ä °\n"),
        ("\ufeffä °\r\n".encode("utf-16-be"), "ä °\n"),
        (b"a 1\r\nb 2\rc 3\n", "a 1\nb 2\nc 3\n"),
        (b"a 1\n\x1a", "a 1\n"),
        (b"", ""),
    ],
)
def test_text_is_utf16_with_its_mark_utf8_or_latin1_with_any_line_ends(data: bytes, text: str) -> None:
    assert decode(data) == text


@pytest.mark.parametrize(
    "data",
    [
        b"a\0b",
        "a 1".encode("utf-16-le"),
        b"\xff\xfea",
        b"\xff\xfe\x00\xd8a\x00",
        "\ufeffa\0".encode("utf-16-be"),
        bytes(range(32)) * 3,
        b"\x7fELF\x02\x01\x01\0",
    ],
)
def test_what_is_no_text_is_refused(data: bytes) -> None:
    assert decode(data) is None


@pytest.mark.parametrize(
    ("text", "value", "comment"),
    [
        ("STRING_WITH_STANDARD_CHARACTERS!", "STRING_WITH_STANDARD_CHARACTERS!", ""),
        ("STRING_1 (comment)", "STRING_1", "(comment)"),
        ("STRING_1(comment)", "STRING_1", "(comment)"),
        ("″STRING_WITH_COMMENT( # /*)_CHARACTERS″", "STRING_WITH_COMMENT( # /*)_CHARACTERS", ""),
        ("″STRING_WITH_POST_SPACES   ″", "STRING_WITH_POST_SPACES", ""),
        ("“STRING_(2)” (comment)", "STRING_(2)", "(comment)"),
        ('"a b"(c', "a b", "(c"),
        ('""', "", ""),
        ("\x93a b\x94", "a b", ""),
    ],
)
def test_a_string_ends_at_a_bracket_or_its_quote(text: str, value: str, comment: str) -> None:
    found = string(text)
    assert (found.value, found.comment, found.fault) == (value, comment, "")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("file.lis # comment", "file.lis # comment"),
        ("file.lis /* comment */", "file.lis /* comment */"),
        ("two words", "two words"),
        ('"not closed', "not closed"),
        ('"closed" # comment', "closed"),
    ],
)
def test_strings_that_need_quotes_are_taken_with_a_fault(text: str, value: str) -> None:
    found = string(text)
    assert found.value == value
    assert found.fault


def test_a_quote_may_follow_the_name_at_once() -> None:
    assert string(only("beispiel[1].bezeichnung″ STRING_(2)″ (comment)").text).value == " STRING_(2)"


@pytest.mark.parametrize(
    ("word", "value"),
    [
        ("0", 0),
        ("-200000", -200000),
        ("+5", 5),
        ("007", 7),
        ("1.0", 1),
        ("1.50", Decimal("1.50")),
        (".5", Decimal("0.5")),
        ("5.", 5),
        ("-1e-3", Decimal("-0.001")),
        ("2E2", 200),
        ("0x204", 516),
        ("123456789012345678901234567890.1", Decimal("123456789012345678901234567890.1")),
    ],
)
def test_numbers_are_kept_exactly(word: str, value: int | Decimal) -> None:
    found = number(word)
    assert found == value
    assert type(found) is type(value)


@pytest.mark.parametrize(
    "word", ["", "a", "1_000", "1,5", "٣", "²", "nan", "inf", "1e9999", "0x", "--1", "1-", "9" * 401, "1/*"]
)
def test_other_words_are_no_numbers(word: str) -> None:
    assert number(word) is None


@given(st.text() | st.text('a[]. 0123456789\n"#(:-'))
def test_every_line_is_an_entry_or_a_comment_or_reported(text: str) -> None:
    reports: list[int] = []
    lines = decode(text.replace("\0", "").encode("utf-8", "surrogatepass"))
    if lines is None:
        return
    found = {entry.line for entry in entries(lines, lambda _, line, __: reports.append(line))}
    assert found.isdisjoint(reports)
    for at, line in enumerate(lines.split("\n"), 1):
        stripped = line.strip()
        if stripped.lower() == "end":
            break
        assert (at in found or at in reports) == bool(stripped and not stripped.startswith("#")), (at, line)


@given(
    st.from_regex(r"[a-z]{1,5}(\[ ?(0|[1-9][0-9]{0,3}) ?\]){0,2}(\.[a-z]+)?", fullmatch=True),
    st.integers(-(2**31), 2**31),
)
def test_entries_survive_any_layout(name: str, value: int) -> None:
    entry = only(f" {name}\t {value} (c)")
    assert entry.name == name.replace(" ", "")
    assert int(entry.word) == value
