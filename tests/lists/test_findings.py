"""Every finding there is, provoked by a list, and what the machine is then."""

from collections.abc import Callable
from itertools import takewhile
from typing import NamedTuple

import pytest

from axcomp.lists import CODES, Finding, Reading, Severity
from axcomp.lists.findings import LIMIT, Findings
from axcomp.machine import Axis

ReadLists = Callable[..., Reading]

UPDATE_ONLY = {"110638", "110639", "110640", "110641"}
"""Codes of an update while the machine runs."""

LEADSCREW = """\
kopf.achs_nr 1
kw.ssfk.unit 1
kw.ssfk.interval 100000
kw.ssfk.kw_nr_max 3
kw.ssfk.table[0].pos 1
kw.ssfk.table[1].pos 2
kw.ssfk.table[2].pos 3
"""
CROSS = """\
kopf.achs_nr 1
kw.crosscomp.unit 1
kw.crosscomp.last_index 1
kw.crosscomp.master_ax_nr 2
kw.crosscomp.table[0].setpoint 0
kw.crosscomp.table[0].correction 1
kw.crosscomp.table[1].setpoint 1000
kw.crosscomp.table[1].correction 2
"""
PLANE = """\
kopf.achs_nr 1
kw.crosscomp2.unit 1
kw.crosscomp2.interval 100000
kw.crosscomp2.master1_ax_nr 2
kw.crosscomp2.master2_ax_nr 3
kw.crosscomp2.table[0][0].correction 5
"""
FRICTION = """\
kopf.achs_nr 1
frict_comp.mode 3
frict_comp.table_entries 2
frict_comp.table[0].in 1000
frict_comp.table[0].out 10
frict_comp.table[1].in 2000
frict_comp.table[1].out 20
"""
CROSSTALK = """\
kopf.achs_nr 1
kw.crosstalk.master_dyn_ax_nr 2
kw.crosstalk.master_pos1_ax_nr 2
kw.crosstalk.master_pos2_ax_nr 3
kw.crosstalk.acceleration 1000
kw.crosstalk.deceleration -1000
"""
OLD_CROSSTALK = """\
kopf.achs_nr 1
kw.crosstalk.master_ax_nr 2
kw.crosstalk.last_index 2
kw.crosstalk.table[0].acceleration -1000
kw.crosstalk.table[0].correction -50
kw.crosstalk.table[1].acceleration 0
kw.crosstalk.table[1].correction 0
kw.crosstalk.table[2].acceleration 1000
kw.crosstalk.table[2].correction 50
"""


def places(*positions: tuple[int, int]) -> str:
    """Return crosstalk tests at given positions of the adaptation axes."""
    return "".join(
        f"kw.crosstalk.position[{i}].ax_1 {a}\nkw.crosstalk.position[{i}].ax_2 {b}\n"
        f"kw.crosstalk.position[{i}].correction_accelerate_dir_pos {i + 1}\n"
        f"kw.crosstalk.position[{i}].correction_decelerate_dir_pos {-i - 1}\n"
        for i, (a, b) in enumerate(positions)
    )


def start_up(*lists: str, axes: tuple[str, ...] = (), more: str = "") -> str:
    """Return a start-up list that names lists."""
    text = f"zahl_kw {len(lists)}\nzahl_mds {len(axes)}\n{more}"
    text += "".join(f"achs_kw[{i}] {name}\n" for i, name in enumerate(lists))
    return text + "".join(f"achs_mds[{i}] {name}\n" for i, name in enumerate(axes))


def axis_list(number: int, text: str = "") -> str:
    return f"kopf.achs_nr {number}\n{text}"


class Case(NamedTuple):
    """A code, lists that provoke it, where it points, and what still acts on axis 1 (None: there is no axis 1)."""

    code: str
    files: dict[str, str | bytes]
    line: int
    parameter: str
    kinds: tuple[str, ...] | None


def one(code: str, text: str, line: int, parameter: str, *kinds: str) -> Case:
    """Return a case of a single compensation list."""
    return Case(code, {"achskw1.lis": text}, line, parameter, kinds)


def machine(code: str, files: dict[str, str | bytes], line: int, parameter: str, *kinds: str) -> Case:
    """Return a case of a whole machine."""
    return Case(code, files, line, parameter, kinds)


MDS = ("achsmd1.lis",)
THREE_AXES = {"achsmd1.lis": axis_list(1), "achsmd2.lis": axis_list(2), "achsmd3.lis": axis_list(3)}

CASES = [
    # Files
    Case("AXC-MISSING", {"hochlauf.lis": start_up("a.lis")}, 3, "achs_kw[0]", None),
    Case("AXC-MISSING", {"hochlauf.lis": "zahl_kw 1\n"}, 1, "achs_kw[0]", None),
    Case("AXC-MISSING", {"hochlauf.lis": "default_achs_mds no.lis\n"}, 1, "default_achs_mds", None),
    Case("AXC-UNREADABLE", {"hochlauf.lis": start_up("sub"), "sub/file": ""}, 0, "", None),
    Case("AXC-BINARY", {"achskw1.lis": b"kopf.achs_nr 1\0"}, 0, "", None),
    Case("AXC-EMPTY", {"achskw1.lis": ""}, 0, "", None),
    Case("AXC-EMPTY", {"achskw1.lis": "# nothing but this\n"}, 0, "", None),
    Case("AXC-EMPTY", {"hochlauf.lis": "\n"}, 0, "", None),
    Case("AXC-KIND", {"hochlauf.lis": start_up("a.lis"), "a.lis": axis_list(1, "lr_param.ssfk 1\n")}, 0, "", None),
    machine("AXC-PATH", {"hochlauf.lis": start_up("KW.LIS"), "kw.lis": LEADSCREW}, 3, "achs_kw[0]", "leadscrew"),
    machine(
        "AXC-PATH", {"hochlauf.lis": start_up(r"C:\cnc\kw.lis"), "kw.lis": LEADSCREW}, 3, "achs_kw[0]", "leadscrew"
    ),
    # Grammar
    one("AXC-SYNTAX", f"****\n{LEADSCREW}", 1, "", "leadscrew"),
    one("AXC-ELISION", f"{LEADSCREW}...\n", 8, "", "leadscrew"),
    one("AXC-END", f"{LEADSCREW}End\nkw.ssfk.interval 0\n", 9, "", "leadscrew"),
    one("AXC-STRING", f"kopf.log_achs_name X # axis\n{LEADSCREW}", 1, "kopf.log_achs_name", "leadscrew"),
    # Entries
    one("AXC-UNKNOWN", f"{LEADSCREW}kw.ssfk.colour 3\n", 8, "kw.ssfk.colour", "leadscrew"),
    one("AXC-TYPO", LEADSCREW.replace("interval", "intervall"), 3, "kw.ssfk.intervall", "leadscrew"),
    one("AXC-TWICE", f"{LEADSCREW}KW.SSFK.table[2].pos 4\n", 8, "KW.SSFK.table[2].pos", "leadscrew"),
    one(
        "AXC-INDEX",
        f"{LEADSCREW}kw.crosstalk.table[5].correction 1\n",
        8,
        "kw.crosstalk.table[5].correction",
        "leadscrew",
    ),
    one("AXC-VALUE", LEADSCREW.replace("pos 2", "pos two"), 6, "kw.ssfk.table[1].pos", "leadscrew"),
    one("AXC-VALUE", f"kw.ssfk.bilateral 2\n{LEADSCREW}", 1, "kw.ssfk.bilateral", "leadscrew"),
    one("AXC-VALUE", f"kw.ssfk.bilateral\n{LEADSCREW}", 1, "kw.ssfk.bilateral", "leadscrew"),
    one("AXC-VALUE", f"kw.crosscomp.n_cycles 1.5\n{CROSS}", 1, "kw.crosscomp.n_cycles", "cross"),
    one("AXC-RANGE", f"kw.crosscomp.n_cycles 21\n{CROSS}", 1, "kw.crosscomp.n_cycles", "cross"),
    one("AXC-RANGE", f"frict_comp.mode 2\n{LEADSCREW}", 1, "frict_comp.mode", "leadscrew"),
    one("AXC-OUTSIDE", f"frict_comp.position_delay 30\n{FRICTION}", 1, "frict_comp.position_delay", "friction"),
    one("AXC-OUTSIDE", f"kopf.log_achs_name {'X' * 17}\n{LEADSCREW}", 1, "kopf.log_achs_name", "leadscrew"),
    one("AXC-UNUSED", f"{LEADSCREW}kw.ssfk.table[3].pos 9\n", 8, "kw.ssfk.table[3].pos", "leadscrew"),
    one("AXC-UNUSED", f"{LEADSCREW}kw.ssfk.table[0].neg 9\n", 8, "kw.ssfk.table[0].neg", "leadscrew"),
    one("AXC-UNUSED", f"{LEADSCREW}kw.ssfk.table[0].setpoint 9\n", 8, "kw.ssfk.table[0].setpoint", "leadscrew"),
    machine("AXC-UNUSED", {"hochlauf.lis": "achs_kw[0] a.lis\n"}, 0, "zahl_kw"),
    machine(
        "AXC-UNUSED",
        {"hochlauf.lis": "zahl_kw 1\nachs_kw[0] a.lis\nachs_kw[1] b.lis\n", "a.lis": LEADSCREW},
        3,
        "achs_kw[1]",
        "leadscrew",
    ),
    machine(
        "AXC-UNIT",
        {
            "hochlauf.lis": start_up("kw.lis", axes=MDS),
            "kw.lis": LEADSCREW.replace("kw.ssfk.unit 1\n", ""),
            "achsmd1.lis": axis_list(1, "lr_param.ssfk 1\ngetriebe[0].wegaufz 4\n"),
        },
        0,
        "kw.ssfk.unit",
        "leadscrew",
    ),
    # Axes
    one("AXC-NUMBER", LEADSCREW.replace("kopf.achs_nr 1\n", ""), 0, "kopf.achs_nr", "leadscrew"),
    one("AXC-NUMBER", LEADSCREW.replace("kopf.achs_nr 1", "kopf.achs_nr 0"), 1, "kopf.achs_nr", "leadscrew"),
    Case(
        "AXC-NUMBER",
        {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": "lr_param.ssfk 0\n"},
        0,
        "kopf.achs_nr",
        None,
    ),
    machine("AXC-NUMBER-TWICE", {"achskw1.lis": LEADSCREW, "achskw2.lis": CROSS}, 1, "kopf.achs_nr", "leadscrew"),
    machine(
        "AXC-NAME",
        {"achskw1.lis": f"{LEADSCREW}kopf.log_achs_name X\n", "achskw2.lis": "kopf.achs_nr 2\nkopf.log_achs_name X\n"},
        2,
        "kopf.log_achs_name",
        "leadscrew",
    ),
    machine(
        "AXC-AXES",
        {f"achskw{i}.lis": LEADSCREW.replace("nr 1", f"nr {i}") for i in range(1, 32)}
        | {"achskw32.lis": CROSS.replace("nr 1", "nr 32").replace("ax_nr 2", "ax_nr 99")},
        4,
        "kw.crosscomp.master_ax_nr",
        "leadscrew",
    ),
    machine(
        "AXC-NO-AXIS-LIST",
        {"hochlauf.lis": start_up("kw.lis", axes=MDS), "kw.lis": LEADSCREW.replace("nr 1", "nr 7"), **THREE_AXES},
        1,
        "kopf.achs_nr",
    ),
    Case(
        "110229",
        {"hochlauf.lis": start_up("kw.lis", more="achs_kw_log_ax_nr[0] 2\n"), "kw.lis": LEADSCREW},
        3,
        "achs_kw_log_ax_nr[0]",
        None,
    ),
    machine(
        "110086",
        {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": axis_list(1, "getriebe[0].wegaufn 0\n")},
        2,
        "getriebe[0].wegaufn",
    ),
    machine(
        "110386",
        {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": axis_list(1, "getriebe[0].wegaufz 0\n")},
        2,
        "getriebe[0].wegaufz",
    ),
    machine(
        "110052",
        {
            "hochlauf.lis": start_up(axes=MDS),
            "achsmd1.lis": axis_list(1, "kenngr.achs_typ 2\nkenngr.achs_mode 4\ngetriebe[0].moduloo -5\n"),
        },
        4,
        "getriebe[0].moduloo",
    ),
    # Compensations
    machine(
        "AXC-INACTIVE",
        {"hochlauf.lis": start_up("kw.lis", axes=MDS), "kw.lis": LEADSCREW, "achsmd1.lis": axis_list(1)},
        5,
        "kw.ssfk.table[0].pos",
    ),
    one("AXC-INACTIVE", FRICTION.replace("mode 3", "mode 0"), 2, "frict_comp.mode"),
    machine(
        "AXC-NO-TABLE",
        {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": axis_list(1, "lr_param.ssfk 1\n")},
        2,
        "lr_param.ssfk",
    ),
    one("AXC-SIZE", LEADSCREW.replace("nr_max 3", "nr_max 0"), 4, "kw.ssfk.kw_nr_max"),
    one("AXC-GAP", LEADSCREW.replace("kw.ssfk.table[1].pos 2\n", ""), 5, "kw.ssfk.table[1].pos", "leadscrew"),
    one("AXC-GAP", LEADSCREW.replace("kw.ssfk.table[0].pos 1\n", ""), 5, "kw.ssfk.table[0].pos", "leadscrew"),
    one("AXC-GAP", f"{PLANE}kw.crosscomp2.last_index_master1 3\n", 6, "kw.crosscomp2.table[0][1].correction", "plane"),
    one("AXC-MASTER", CROSS.replace("kw.crosscomp.master_ax_nr 2\n", ""), 0, "kw.crosscomp.master_ax_nr"),
    machine(
        "AXC-MASTER",
        {
            "hochlauf.lis": start_up("kw.lis", axes=MDS),
            "kw.lis": CROSS,
            "achsmd1.lis": axis_list(1, "lr_param.crosscomp 1\n"),
        },
        4,
        "kw.crosscomp.master_ax_nr",
    ),
    machine(
        "AXC-MASTER",
        {
            "hochlauf.lis": start_up("kw.lis", axes=tuple(THREE_AXES)),
            "kw.lis": CROSSTALK + places((0, 0)),
            **THREE_AXES,
            "achsmd1.lis": axis_list(1, "lr_param.crosstalk 1\n"),
            "achsmd2.lis": axis_list(2, "kenngr.achs_typ ACHSTYP_ROTATOR\n"),
        },
        2,
        "kw.crosstalk.master_dyn_ax_nr",
    ),
    one(
        "AXC-MASTER",
        (CROSSTALK + places((0, 0), (1, 0), (2, 0))).replace("kw.crosstalk.master_pos1_ax_nr 2", "kw.crosstalk.mode 2"),
        0,
        "kw.crosstalk.master_pos1_ax_nr",
    ),
    one("AXC-MASTER-SELF", CROSS.replace("ax_nr 2", "ax_nr 1"), 4, "kw.crosscomp.master_ax_nr", "cross"),
    one("AXC-ORDER", f"{LEADSCREW}kw.ssfk.interval 0\n", 0, "kw.ssfk.table[1].setpoint"),
    one(
        "AXC-ORDER",
        OLD_CROSSTALK.replace("acceleration 1000", "acceleration 0"),
        8,
        "kw.crosstalk.table[2].acceleration",
    ),
    one("AXC-INTERVAL", PLANE.replace("kw.crosscomp2.interval 100000\n", ""), 0, "kw.crosscomp2.interval"),
    one(
        "AXC-INTERVAL",
        f"kw.crosscomp2.grid RECTANGULAR\nkw.crosscomp2.interval1 1\n{PLANE}",
        0,
        "kw.crosscomp2.interval2",
    ),
    one("AXC-MODULO-AXIS", f"kw.ssfk.modulo 1\n{LEADSCREW}", 1, "kw.ssfk.modulo", "leadscrew"),
    machine(
        "AXC-MODULO-SPAN",
        {
            "hochlauf.lis": start_up("kw.lis", axes=MDS),
            "kw.lis": f"kw.ssfk.modulo 1\n{LEADSCREW}".replace("interval 100000", "interval 1800001"),
            "achsmd1.lis": axis_list(1, "lr_param.ssfk 1\nkenngr.achs_typ 2\nkenngr.achs_mode 0x4\n"),
        },
        1,
        "kw.ssfk.modulo",
    ),
    machine(
        "AXC-MODULO-SEAM",
        {
            "hochlauf.lis": start_up("kw.lis", axes=MDS),
            "kw.lis": f"kw.ssfk.modulo 1\n{LEADSCREW}".replace("interval 100000", "interval 1800000"),
            "achsmd1.lis": axis_list(1, "lr_param.ssfk 1\nkenngr.achs_typ 2\nkenngr.achs_mode 0x4\n"),
        },
        1,
        "kw.ssfk.modulo",
        "leadscrew",
    ),
    machine(
        "AXC-AXIS-TYPE",
        {
            "hochlauf.lis": start_up("kw.lis", axes=tuple(THREE_AXES)),
            "kw.lis": CROSSTALK + places((0, 0)),
            **THREE_AXES,
            "achsmd1.lis": axis_list(1, "lr_param.crosstalk 1\nkenngr.achs_typ 2\n"),
        },
        2,
        "kw.crosstalk.master_dyn_ax_nr",
    ),
    one(
        "AXC-VARIANT",
        OLD_CROSSTALK + CROSSTALK.replace("kopf.achs_nr 1\nkw.crosstalk.master_dyn_ax_nr 2\n", "") + places((0, 0)),
        4,
        "kw.crosstalk.table[0].acceleration",
        "crosstalk",
    ),
    one("AXC-TESTS", f"kw.crosstalk.mode 2\n{CROSSTALK}{places((0, 0))}", 1, "kw.crosstalk.mode"),
    one("AXC-TESTS", f"kw.crosstalk.mode 3\n{CROSSTALK}{places((0, 0), (1, 1))}", 1, "kw.crosstalk.mode"),
    one("AXC-TESTS", f"kw.crosstalk.mode 3\n{CROSSTALK}{places((0, 0), (1, 3), (-2, -6))}", 1, "kw.crosstalk.mode"),
    one("AXC-TESTS", f"kw.crosstalk.max_points 1\n{CROSSTALK}", 0, "kw.crosstalk.mode"),
    one(
        "AXC-TESTS-FEW",
        f"kw.crosstalk.mode 2\n{CROSSTALK}{places((0, 0), (9, 0))}",
        1,
        "kw.crosstalk.mode",
        "crosstalk",
    ),
    one(
        "AXC-TESTS-TWICE",
        f"kw.crosstalk.mode 2\n{CROSSTALK}{places((0, 0), (9, 0), (0, 5), (5, 0))}",
        16,
        "kw.crosstalk.position[2].ax_1",
        "crosstalk",
    ),
    one(
        "AXC-ACCELERATION",
        CROSSTALK.replace("kw.crosstalk.deceleration -1000\n", "") + places((0, 0)),
        0,
        "kw.crosstalk.deceleration",
    ),
    one(
        "AXC-AT-REST",
        OLD_CROSSTALK.replace("correction 0", "correction 5"),
        5,
        "kw.crosstalk.table[0].correction",
        "crosstalk",
    ),
    one("70182", PLANE.replace("kw.crosscomp2.master2_ax_nr 3\n", ""), 0, "kw.crosscomp2.master2_ax_nr"),
    machine(
        "70182",
        {
            "hochlauf.lis": start_up("kw.lis", axes=MDS),
            "kw.lis": PLANE,
            "achsmd1.lis": axis_list(1, "lr_param.crosscomp2 1\n"),
        },
        4,
        "kw.crosscomp2.master1_ax_nr",
    ),
    one("70183", "kopf.achs_nr 1\nkw.crosscomp2.last_index_master1 4\n", 2, "kw.crosscomp2.last_index_master1"),
    machine(
        "70183",
        {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": axis_list(1, "lr_param.crosscomp2 1\n")},
        2,
        "lr_param.crosscomp2",
    ),
    machine(
        "70184",
        {
            "hochlauf.lis": start_up("kw.lis", axes=tuple(THREE_AXES)),
            "kw.lis": PLANE,
            **THREE_AXES,
            "achsmd1.lis": axis_list(1, "lr_param.crosscomp2 1\n"),
            "achsmd3.lis": axis_list(3, "kenngr.achs_typ ACHSTYP_SPINDEL\n"),
        },
        5,
        "kw.crosscomp2.master2_ax_nr",
    ),
    one("70245", CROSS.replace("setpoint 1000", "setpoint 0"), 7, "kw.crosscomp.table[1].setpoint"),
    one("70245", CROSS.replace("last_index 1", "last_index 2"), 7, "kw.crosscomp.table[2].setpoint"),
    machine(
        "70495",
        {"hochlauf.lis": start_up("kw.lis", axes=MDS), "kw.lis": FRICTION, "achsmd1.lis": axis_list(1)},
        4,
        "frict_comp.table[0].in",
    ),
    one("110591", FRICTION.replace("in 2000", "in 500"), 6, "frict_comp.table[1].in"),
    one("110591", FRICTION.replace("in 1000", "in -1000"), 4, "frict_comp.table[0].in"),
    one("110647", f"kw.ssfk.max_points 2\n{LEADSCREW}", 5, "kw.ssfk.kw_nr_max"),
    one("110647", LEADSCREW.replace("nr_max 3", "nr_max 1501"), 4, "kw.ssfk.kw_nr_max"),
    one("110647", f"kw.crosscomp.max_points 1\n{CROSS}", 4, "kw.crosscomp.last_index"),
    one("110647", f"kw.crosscomp2.last_index_master2 101\n{PLANE}", 1, "kw.crosscomp2.last_index_master2"),
    one(
        "110647",
        f"kw.crosscomp2.max_points 11\nkw.crosscomp2.last_index_master1 3\nkw.crosscomp2.last_index_master2 2\n{PLANE}",
        2,
        "kw.crosscomp2.last_index_master1",
    ),
    one("110647", FRICTION.replace("entries 2", "entries 21"), 3, "frict_comp.table_entries"),
    one(
        "110647",
        f"kw.ssfk.max_points 4000000000\n{LEADSCREW}".replace("nr_max 3", "nr_max 2000000000"),
        5,
        "kw.ssfk.kw_nr_max",
    ),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.code)
def test_lists_provoke_a_finding_at_its_place_and_the_rest_keeps_working(case: Case, read_lists: ReadLists) -> None:
    reading = read_lists(case.files)
    found = [f for f in reading.findings if f.code == case.code]
    assert (case.line, case.parameter) in [(f.line, f.parameter) for f in found], reading.findings
    for finding in found:
        assert finding.severity is CODES[case.code][0]
        assert finding.message.endswith(".")
        assert finding.file
    axis = next((axis for axis in reading.machine.axes if axis.number == 1), None)
    assert (None if axis is None else tuple(kind for kind, _ in axis.compensations())) == (
        case.kinds if case.kinds or axis is not None else None
    )


def test_every_code_is_provoked() -> None:
    # The volumetric compensation, whose codes come last, has its own tests.
    of_lists = set(takewhile(lambda code: code != "70468", CODES))
    assert {case.code for case in CASES} == of_lists - UPDATE_ONLY


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        (LEADSCREW, "leadscrew"),
        (CROSS, "cross"),
        (PLANE, "plane"),
        (FRICTION, "friction"),
        (OLD_CROSSTALK, "crosstalk"),
        (CROSSTALK + places((0, 0)), "crosstalk"),
        (f"kw.crosstalk.mode 3\n{CROSSTALK}{places((0, 0), (9, 0), (5, 5))}", "crosstalk"),
    ],
)
def test_the_lists_these_cases_begin_with_are_faultless(text: str, kind: str, read_lists: ReadLists) -> None:
    reading = read_lists({"achskw1.lis": text})
    assert reading.findings == ()
    assert [found for found, _ in reading.machine.axes[0].compensations()] == [kind]


def test_the_same_fault_in_every_row_is_counted_not_repeated(read_lists: ReadLists) -> None:
    rows = "".join(f"kw.crosscomp2.table[{j}][{i}].correction no\n" for j in range(100) for i in range(100))
    last = "kw.crosscomp2.last_index_master1 99\nkw.crosscomp2.last_index_master2 99\n"
    reading = read_lists({"achskw1.lis": f"{PLANE.rsplit(chr(10), 2)[0]}\n{last}{rows}kw.ssfk.nothing 1\n"})
    values = [f for f in reading.findings if f.code == "AXC-VALUE"]
    assert len(values) == LIMIT + 1
    assert "9,990 more" in values[-1].message
    assert "AXC-UNKNOWN" in [f.code for f in reading.findings]


def test_slips_are_not_lost_among_entries_of_other_functions(read_lists: ReadLists) -> None:
    strangers = "".join(f"antr.parameter_{i} 1\n" for i in range(300))
    files = {
        "hochlauf.lis": start_up(axes=MDS),
        "achsmd1.lis": axis_list(1, f"{strangers}lr_param.sskf 1\n"),
    }
    reading = read_lists(files)
    [slip] = [f for f in reading.findings if f.parameter == "lr_param.sskf"]
    assert "lr_param.ssfk" in slip.message
    assert len(reading.findings) == LIMIT + 2


def test_findings_come_file_by_file_in_the_order_of_the_lines() -> None:
    findings = Findings()
    for file, line in (("a", 5), ("b", 2), ("a", 1), ("b", 1)):
        findings.add("AXC-SYNTAX", file, line, "", "?")
    assert [(f.file, f.line) for f in findings.all()] == [("a", 1), ("a", 5), ("b", 1), ("b", 2)]


def test_a_finding_reads_like_a_compilers() -> None:
    finding = Finding(Severity.WARNING, "achskw1.lis", 3, "kw.ssfk.unit", "AXC-VALUE", "Something.")
    assert str(finding) == "achskw1.lis:3: warning AXC-VALUE: Something."


@pytest.mark.parametrize(
    ("entry", "expected"),
    [
        ("kw.ssfk.bilateral TRUE", True),
        ("kw.ssfk.bilateral false", False),
        ("kw.ssfk.bilateral 1 # both", True),
        ("kw.ssfk.bilateral 3", False),
        ("kw.ssfk.bilateral 1\nkw.ssfk.bilateral 0", False),
    ],
)
def test_booleans_are_numbers_or_words(entry: str, expected: bool, read_lists: ReadLists) -> None:
    reading = read_lists({"achskw1.lis": f"{LEADSCREW}{entry}\n"})
    table = reading.machine.axes[0].leadscrew
    assert table is not None
    assert (table.negative is not None) == expected


def test_each_axis_without_findings_is_equal_to_one_made_by_hand(read_lists: ReadLists) -> None:
    files = {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": axis_list(1, "kopf.log_achs_name X (first axis)\n")}
    assert read_lists(files).machine.axes == (Axis(1, "X"),)


@pytest.mark.parametrize(
    ("interval", "ends_differ", "expected", "acts"),
    [
        (900_000, True, [], True),  # 180° of 360°: the gap is interpolated
        (1_800_000, True, ["AXC-MODULO-SEAM"], True),
        (1_800_000, False, [], True),
        (1_800_001, False, ["AXC-MODULO-SPAN"], False),
    ],
)
def test_a_modulo_table_is_compared_with_the_range_wherever_that_begins(
    interval: int, ends_differ: bool, expected: list[str], acts: bool, read_lists: ReadLists
) -> None:
    table = f"{LEADSCREW}kw.ssfk.modulo 1\nkw.ssfk.kw_startpos -1800000\n".replace("100000", str(interval), 1)
    files = {
        "achskw1.lis": table if ends_differ else table.replace("pos 3", "pos 1"),
        "achsmd1.lis": axis_list(
            1,
            "lr_param.ssfk 1\nkenngr.achs_typ 2\nkenngr.achs_mode ACHSMODE_MODULO\n"
            "getriebe[0].modulou -1800000\ngetriebe[0].moduloo 1800000\n",
        ),
    }
    reading = read_lists(files)
    assert [finding.code for finding in reading.findings] == expected
    leadscrew = reading.machine.axes[0].leadscrew
    assert (leadscrew is not None) == acts
    assert leadscrew is None or leadscrew.modulo
