"""Lists that provoke findings: one case at least for every code."""

from typing import NamedTuple

from small_lists import LEADSCREW

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
    """Return crosstalk tests at given positions of the adaptation axes, 0.1 mm."""
    return "".join(
        f"kw.crosstalk.position[{i}].ax_1 {1000 * a}\nkw.crosstalk.position[{i}].ax_2 {1000 * b}\n"
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


def one_axis(compensation: str, axis: str) -> dict[str, str | bytes]:
    """Return the lists of a machine with axis 1 only."""
    return {"hochlauf.lis": start_up("kw.lis", axes=MDS), "kw.lis": compensation, "achsmd1.lis": axis_list(1, axis)}


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
    Case("AXC-FOLDER", {"hochlauf.lis": start_up(r"..\kw.lis")}, 3, "achs_kw[0]", None),
    Case("AXC-FOLDER", {"hochlauf.lis": start_up("/kw.lis")}, 3, "achs_kw[0]", None),
    Case("AXC-FOLDER", {"hochlauf.lis": start_up(r"sub\..\..\kw.lis")}, 3, "achs_kw[0]", None),
    # Grammar
    one("AXC-SYNTAX", f"****\n{LEADSCREW}", 1, "", "leadscrew"),
    one("AXC-ELISION", f"{LEADSCREW}...\n", 8, "", "leadscrew"),
    one("AXC-END", f"{LEADSCREW}End\nkw.ssfk.interval 0\n", 9, "", "leadscrew"),
    one("AXC-STRING", f"kopf.log_achs_name X # axis\n{LEADSCREW}", 1, "kopf.log_achs_name", "leadscrew"),
    # Entries
    one("AXC-UNKNOWN", f"{LEADSCREW}kw.ssfk.colour 3\n", 8, "kw.ssfk.colour", "leadscrew"),
    one("AXC-OTHERS", f"kopf.mds_ident 5\n{LEADSCREW}", 0, "", "leadscrew"),
    one("AXC-TYPO", LEADSCREW.replace("interval", "intervall"), 3, "kw.ssfk.intervall", "leadscrew"),
    one("AXC-TWICE", f"{LEADSCREW}KW.SSFK.table[2].pos 4\n", 8, "KW.SSFK.table[2].pos", "leadscrew"),
    one(
        "AXC-INDEX",
        f"{LEADSCREW}kw.crosstalk.table[5].correction 1\n",
        8,
        "kw.crosstalk.table[5].correction",
        "leadscrew",
    ),
    one("AXC-ZEROED", LEADSCREW.replace("pos 2", "pos 2;"), 6, "kw.ssfk.table[1].pos", "leadscrew"),
    one("AXC-ZEROED", LEADSCREW.replace("pos 2", "pos 2147483648"), 6, "kw.ssfk.table[1].pos", "leadscrew"),
    one("AXC-ZEROED", f"{LEADSCREW}kw.ssfk.kw_startpos 10;\n", 8, "kw.ssfk.kw_startpos", "leadscrew"),
    one("AXC-ZEROED", CROSS.replace("last_index 1", "last_index 1;"), 3, "kw.crosscomp.last_index", "cross"),
    Case("AXC-ZEROED", {"hochlauf.lis": "zahl_kw 33\nachs_kw[0] a.lis\n", "a.lis": LEADSCREW}, 1, "zahl_kw", None),
    Case("AXC-ZEROED", {"hochlauf.lis": "zahl_kw 1;\nachs_kw[0] a.lis\n", "a.lis": LEADSCREW}, 1, "zahl_kw", None),
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
        one_axis(LEADSCREW.replace("kw.ssfk.unit 1\n", ""), "lr_param.ssfk 1\ngetriebe[0].wegaufz 4\n"),
        0,
        "kw.ssfk.unit",
        "leadscrew",
    ),
    # Axes
    one("AXC-NUMBER", LEADSCREW.replace("kopf.achs_nr 1\n", ""), 0, "kopf.achs_nr", "leadscrew"),
    one("AXC-NUMBER", LEADSCREW.replace("kopf.achs_nr 1", "kopf.achs_nr 0"), 1, "kopf.achs_nr", "leadscrew"),
    Case(
        "AXC-NUMBER", {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": "lr_param.ssfk 0\n"}, 0, "kopf.achs_nr", None
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
        "AXC-GRADIENT",
        {
            "hochlauf.lis": start_up(axes=MDS),
            "achsmd1.lis": axis_list(1, "lr_param.temp_comp 1\nlr_param.temp_comp_coefficient 1001\n"),
        },
        3,
        "lr_param.temp_comp_coefficient",
        "temperature",
    ),
    machine(
        "AXC-BACKLASH",
        {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": axis_list(1, "lr_param.anwahl_losekomp 1\n")},
        2,
        "lr_param.anwahl_losekomp",
        "backlash",
    ),
    machine(
        "110386",
        {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": axis_list(1, "getriebe[0].wegaufz 0\n")},
        2,
        "getriebe[0].wegaufz",
    ),
    machine(
        "110472",
        {"hochlauf.lis": start_up(axes=MDS), "achsmd1.lis": axis_list(1, "getriebe[0].feed_const_denom 0\n")},
        2,
        "getriebe[0].feed_const_denom",
    ),
    machine(
        "AXC-RESOLUTION",
        {
            "hochlauf.lis": start_up(axes=MDS),
            "achsmd1.lis": axis_list(1, "getriebe[0].incr_per_rev 0\ngetriebe[0].feed_const_num 100\n"),
        },
        2,
        "getriebe[0].incr_per_rev",
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
    machine("AXC-INACTIVE", one_axis(LEADSCREW, ""), 5, "kw.ssfk.table[0].pos"),
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
    machine("AXC-MASTER", one_axis(CROSS, "lr_param.crosscomp 1\n"), 4, "kw.crosscomp.master_ax_nr"),
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
        one_axis(
            f"kw.ssfk.modulo 1\n{LEADSCREW}".replace("interval 100000", "interval 1800001"),
            "lr_param.ssfk 1\nkenngr.achs_typ 2\nkenngr.achs_mode 0x4\n",
        ),
        1,
        "kw.ssfk.modulo",
    ),
    machine(
        "AXC-MODULO-SEAM",
        one_axis(
            f"kw.ssfk.modulo 1\n{LEADSCREW}".replace("interval 100000", "interval 1800000"),
            "lr_param.ssfk 1\nkenngr.achs_typ 2\nkenngr.achs_mode 0x4\n",
        ),
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
    # One stray entry of the new variant does not switch off a list of the old one.
    one("AXC-VARIANT", f"kw.crosstalk.mode 3\n{OLD_CROSSTALK}", 1, "kw.crosstalk.mode", "crosstalk"),
    one("AXC-TESTS", f"kw.crosstalk.mode 2\n{CROSSTALK}{places((0, 0))}", 1, "kw.crosstalk.mode"),
    one("AXC-TESTS", f"kw.crosstalk.mode 3\n{CROSSTALK}{places((0, 0), (1, 1))}", 1, "kw.crosstalk.mode"),
    one("AXC-TESTS", f"kw.crosstalk.mode 3\n{CROSSTALK}{places((0, 0), (1, 3), (-2, -6))}", 1, "kw.crosstalk.mode"),
    one("AXC-TESTS", f"kw.crosstalk.max_points 1\n{CROSSTALK}", 0, "kw.crosstalk.mode"),
    one(
        "AXC-TESTS",
        f"kw.crosstalk.mode 3\nkw.crosstalk.max_points 10\n{CROSSTALK}"
        + places(*((a, b) for a in range(3) for b in range(3))),
        2,
        "kw.crosstalk.max_points",
    ),
    one(
        "AXC-DIRECTION",
        f"{CROSSTALK}{places((0, 0))}kw.crosstalk.position[0].correction_accelerate_dir_neg 3\n",
        11,
        "kw.crosstalk.position[0].correction_accelerate_dir_neg",
        "crosstalk",
    ),
    one(
        "AXC-ADAPTATION",
        "kw.crosstalk.mode 3\n" + CROSSTALK.replace("pos2_ax_nr 3", "pos2_ax_nr 2") + places((0, 0), (9, 0), (5, 5)),
        5,
        "kw.crosstalk.master_pos2_ax_nr",
        "crosstalk",
    ),
    one("AXC-SCALING", f"frict_comp.scaling_factor -1000\n{FRICTION}", 1, "frict_comp.scaling_factor", "friction"),
    one(
        "AXC-LOOKAHEAD",
        f"frict_comp.reversal_lookahead 2\nfrict_comp.delay_cycles 1\n{FRICTION}",
        1,
        "frict_comp.reversal_lookahead",
        "friction",
    ),
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
    machine("70182", one_axis(PLANE, "lr_param.crosscomp2 1\n"), 4, "kw.crosscomp2.master1_ax_nr"),
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
    one("AXC-SLAVE", CROSS.replace("master_ax_nr", "slave_ax_nr"), 4, "kw.crosscomp.slave_ax_nr", "cross"),
    one("70245", CROSS.replace("setpoint 1000", "setpoint 0"), 7, "kw.crosscomp.table[1].setpoint"),
    one("70245", CROSS.replace("last_index 1", "last_index 2"), 7, "kw.crosscomp.table[2].setpoint"),
    machine("70495", one_axis(FRICTION, ""), 4, "frict_comp.table[0].in"),
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
