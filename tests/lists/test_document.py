"""A table put into a list: what changes, and that nothing else does."""

import pytest
from hypothesis import given, settings, strategies as st

from axcomp.kinds import ListKind
from axcomp.lists import CATALOGUE, Document, Findings, read_values

OWNED = [f"kw.ssfk.{n}" for n in ("unit", "kw_nr_max", "interval", "kw_startpos", "bilateral")]
OWNED += [f"kw.ssfk.table[i].{n}" for n in ("pos", "neg", "setpoint")]
NEW = """\
kw.ssfk.unit 1
kw.ssfk.kw_nr_max 2
kw.ssfk.interval 0
kw.ssfk.bilateral 1
kw.ssfk.table[0].setpoint -5
kw.ssfk.table[0].pos 120000
kw.ssfk.table[0].neg 3
kw.ssfk.table[1].setpoint 4
kw.ssfk.table[1].pos 13
kw.ssfk.table[1].neg 6""".splitlines()

OLD = """\
# my list
kopf.achs_nr  1   (axis X)
kw.ssfk.max_points 300 # keep
kw.ssfk.unit 1
kw.ssfk.kw_nr_max    2      # two
kw.ssfk.interval 100000 /* 10 mm */
kw.ssfk.kw_startpos -5 start
# the table
kw.ssfk.table[ 0].pos  12  first
  kw.ssfk.table[1].pos 13 second

kw.ssfk.table[2].pos 99 third
frict_comp.mode 3
End
kw.ssfk.table[0].pos behind the end
"""

EXPECTED = """\
# my list
kopf.achs_nr  1   (axis X)
kw.ssfk.max_points 300 # keep
kw.ssfk.unit 1
kw.ssfk.kw_nr_max    2      # two
kw.ssfk.interval 0      /* 10 mm */
kw.ssfk.bilateral                        1
# the table
kw.ssfk.table[0].setpoint                -5
kw.ssfk.table[ 0].pos  120000
kw.ssfk.table[0].neg                     3
kw.ssfk.table[1].setpoint                4
  kw.ssfk.table[1].pos 13
kw.ssfk.table[1].neg                     6

frict_comp.mode 3
End
kw.ssfk.table[0].pos behind the end
"""


def edited(data, new, owned, heading, keep_row_comments):
    document = Document("list.lis", data, ListKind.COMPENSATION)
    document.replace_entries(new, owned, heading, keep_row_comments)
    return document.to_bytes()


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_only_the_table_changes_and_the_file_keeps_its_form(newline, mark):
    data = mark + OLD.replace("\n", newline).encode()
    assert edited(data, NEW, OWNED, "Leadscrew", False) == mark + EXPECTED.replace("\n", newline).encode()


def test_comments_of_rows_stay_where_the_rows_stand_for_the_same():
    assert b"kw.ssfk.table[ 0].pos  120000  first" in edited(OLD.encode(), NEW, OWNED, "Leadscrew", True)


def test_latin_letters_stay_latin():
    data = "# Maß für Ä\nkopf.achs_nr 1\n".encode("latin-1")
    assert edited(data, NEW, OWNED, "Leadscrew", False).startswith(data)


@pytest.mark.parametrize(
    ("old", "start"),
    [
        (b"", "# Leadscrew\nkw.ssfk.unit"),
        (b"kopf.achs_nr 1", "kopf.achs_nr 1\n\n# Leadscrew\nkw.ssfk.unit"),
        (b"kopf.achs_nr 1\n", "kopf.achs_nr 1\n\n# Leadscrew\nkw.ssfk.unit"),
        (b"kopf.achs_nr 1\n\nEnd\n", "kopf.achs_nr 1\n\n# Leadscrew\nkw.ssfk.unit"),
    ],
)
def test_a_list_without_table_gets_one_before_its_end(old, start):
    text = edited(old, NEW, OWNED, "Leadscrew", False).decode()
    assert text.startswith(start)
    assert text.endswith("\nEnd\n") == old.endswith(b"End\n")
    assert text.count("kw.ssfk.") == len(NEW)


def test_other_names_of_a_parameter_are_found():
    data = b"kw.ssfk.intervall 100\nKW.SSFK.TABLE[0].SOLLW 7\n"
    text = edited(data, NEW, OWNED, "Leadscrew", False).decode()
    assert "kw.ssfk.intervall 0\n" in text
    assert "KW.SSFK.TABLE[0].SOLLW -5\n" in text
    assert "kw.ssfk.interval " not in text


def test_strings_are_replaced_with_their_quotes():
    text = edited(
        b'kw.crosscomp2.grid "QUADRATIC" (one)\n', ["kw.crosscomp2.grid RECTANGULAR"], ["kw.crosscomp2.grid"], "", True
    )
    assert text == b"kw.crosscomp2.grid RECTANGULAR (one)\n"


def test_binary_files_are_refused():
    with pytest.raises(ValueError, match="no text"):
        edited(b"\0\1\2", NEW, OWNED, "", False)


KEYS = [row.name for row in CATALOGUE[ListKind.COMPENSATION]]
ENTRY = st.builds(
    "{} {}{}".format,
    st.sampled_from(KEYS).map(lambda name: name.replace("[j]", "[0]").replace("[i]", "[1]")),
    st.integers(-1000, 1000),
    st.sampled_from(["", " # why", " (why)", "  /* why */"]),
)
LINES = st.lists(st.one_of(ENTRY, st.text(max_size=12), st.sampled_from(["", "# say", "End", "..."])), max_size=30)


@settings(deadline=None, max_examples=200)
@given(LINES)
def test_any_list_says_the_new_and_else_the_old(lines):
    data = "\n".join(lines).encode("utf-8", "surrogatepass")
    try:
        new = edited(data, NEW, OWNED, "Leadscrew", False)
    except ValueError:
        return
    before, after = (_values(text) for text in (data, new))
    for row in CATALOGUE[ListKind.COMPENSATION]:
        cells = {indices: value for indices, (value, _) in after.cells(row.name).items()}
        if row.name in OWNED:
            name = row.name
            wanted = {
                tuple(map(int, _indices(n))): int(v) for n, v in (x.split() for x in NEW) if _bare(n) == _bare(name)
            }
            assert cells == wanted
        else:
            assert cells == {indices: value for indices, (value, _) in before.cells(row.name).items()}


def _values(data):
    text = data.decode("utf-8", "replace").replace("\r\n", "\n").replace("\r", "\n")
    return read_values(text, "", ListKind.COMPENSATION, Findings())


def _bare(name):
    return "".join(piece.partition("]")[2] if i else piece for i, piece in enumerate(name.split("[")))


def _indices(name):
    return [piece.partition("]")[0] for piece in name.split("[")[1:]]
