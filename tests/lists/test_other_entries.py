"""What stands in the lists of a real controller besides compensations."""

from collections.abc import Callable

import pytest

from axcomp.lists import Reading, Severity

ReadLists = Callable[..., Reading]

TABLE = "kw.ssfk.unit 1\nkw.ssfk.interval 10000\nkw.ssfk.kw_nr_max 2\nkw.ssfk.table[0].pos 1\nkw.ssfk.table[1].pos 2\n"

AXIS = [
    "kopf.achs_nr 1",
    "kopf.mds_ident ACHSMDS | RECONFIG",
    "kopf.log_achs_name X",
    "kenngr.achs_typ 0x0001",
    "kenngr.achs_mode 0x00000001",
    "kenngr.swe_pos 5000000 /* 0.1 my */",
    "kenngr.antr_typ 0x0002",
    "kenngr.nocken_laenge 100",
    "lr_param.ssfk 1",
    "lr_param.ext_comp.warn_limit 100",
    "lr_param.suppress_pos_lag_error 0",
    "lr_param.mod_komp 0",
    "lr_hw[0].nummer 1",
    "lr_hw[0].encoder_resolution_num 1",
    "lr_ueberwach.anzahl 2",
    "vorsteuer.shift_time 0",
    "antr.sercos.at[0].ident_len 16",
    "antr.sercos.telegramm_typ ANWENDER | SPEZIAL",
    "handbetrieb.hr.aufl[0] 10",
    "trafo.command_pos.enable 0",
    "cam_gear.anything 1",
    "twincat.anything 1",
    "vb_monitor 100",
]
STEPS = ("a_beschl", "a_brems", "tr_beschl_zu", "tr_beschl_ab", "tr_brems_zu", "tr_brems_ab", "a_grenz", "tr_grenz")
START_UP = """\
kanal_anzahl 2
konfiguration RUNTIME | DEBUG
listen "listen"
sercos_hochlauf 0
default_sda_mds sda_all.lis
sda_mds[0] sda1.lis
wrkz_data[0] tools.lis
pfad[0].prg[0] prg
hmi[0].objects 20
configuration.channel[0].interpolator.function FCT_DEFAULT | FCT_LOOK_AHEAD
zahl_kw 1
achs_kw[0] kw.lis
zahl_mds 1
achs_mds[0] md.lis
achs_mds[1] unused.lis
achs_mds[31] unused.lis
"""


def lists(axis: str = "\n".join(AXIS), start_up: str = START_UP) -> dict[str, str]:
    return {"hochlauf.lis": start_up, "md.lis": axis, "kw.lis": f"kopf.achs_nr 1\nkopf.mds_ident ACHSKW\n{TABLE}"}


def test_an_axis_list_of_300_entries_is_one_line(read_lists: ReadLists) -> None:
    dynamics = [f"getriebe[{step}].slope_profil.{name} 1000" for step in range(35) for name in STEPS]
    reading = read_lists(lists("\n".join(AXIS + dynamics)), "hochlauf.lis")
    assert len(AXIS + dynamics) == 303
    assert [(f.file.rpartition("/")[2], f.code, f.severity, f.line) for f in reading.findings] == [
        (name, "AXC-OTHERS", Severity.INFO, 0) for name in ("hochlauf.lis", "md.lis", "kw.lis")
    ]
    # Five of the entries say what the axis is and what acts on it.
    assert [f.message.split()[0] for f in reading.findings] == ["10", "298", "1"]
    assert [(axis.name, list(axis.kinds)) for axis in reading.machine.axes] == [("X", ["leadscrew"])]


@pytest.mark.parametrize(
    ("slip", "meant"),
    [
        ("lr_param.sskf 1", "lr_param.ssfk"),
        ("lr_param.crosscmp 1", "lr_param.crosscomp"),
        ("lr_param.n_backlash_cycle 1", "lr_param.n_backlash_cyc"),
        ("getriebe[0].fed_const_num 1", "getriebe[i].feed_const_num"),
        ("getriebe[0].wegauz 1", "getriebe[i].wegaufz"),
        ("kenngr.achstyp 1", "kenngr.achs_typ"),
        ("kopf.achsnr 1", "kopf.achs_nr"),
    ],
)
def test_a_slip_in_a_name_that_is_used_stays_a_warning(slip: str, meant: str, read_lists: ReadLists) -> None:
    findings = read_lists(lists("\n".join([*AXIS, slip])), "hochlauf.lis").findings
    [found] = [finding for finding in findings if finding.code == "AXC-UNKNOWN"]
    assert (found.severity, found.line) == (Severity.WARNING, len(AXIS) + 1)
    assert f"; {meant} may be meant" in found.message


@pytest.mark.parametrize(
    ("name", "meant"), [("zahl_kv 1", "zahl_kw"), ("acsh_kw[0] a.lis", "achs_kw[i]"), ("zahl_msd 1", "zahl_mds")]
)
def test_a_slip_in_a_start_up_list_stays_a_warning(name: str, meant: str, read_lists: ReadLists) -> None:
    findings = read_lists(lists(start_up=f"{START_UP}{name}\n"), "hochlauf.lis").findings
    [found] = [finding for finding in findings if finding.code == "AXC-UNKNOWN"]
    assert f"; {meant} may be meant" in found.message


def test_a_name_that_no_list_of_the_controller_has_stays_a_warning(read_lists: ReadLists) -> None:
    findings = read_lists(lists("\n".join([*AXIS, "spline.order 3"])), "hochlauf.lis").findings
    assert [f.parameter for f in findings if f.code == "AXC-UNKNOWN"] == ["spline.order"]


def test_a_default_axis_list_may_say_nothing_about_compensations(read_lists: ReadLists) -> None:
    files = lists(start_up=f"{START_UP}default_achs_mds all.lis\n") | {"all.lis": "lr_hw[0].nummer 1\n"}
    assert {finding.code for finding in read_lists(files, "hochlauf.lis").findings} == {"AXC-OTHERS"}


def test_a_channel_list_is_told_from_a_list_of_tables_in_a_few_lines(read_lists: ReadLists) -> None:
    channel = "einzelschrittmodus 0\ngruppe[0].achs_anzahl 3\n" + "".join(
        f"gruppe[0].achse[{i}].bezeichnung X{i}\nspindel[{i}].bezeichnung S{i}\n" for i in range(32)
    )
    findings = read_lists({"sda.lis": channel}, "sda.lis").findings
    assert sorted(finding.code for finding in findings) == ["AXC-EMPTY", "AXC-OTHERS"]


@pytest.mark.parametrize(
    ("mode", "modulo"),
    [
        ("ACHSMODE_MODULO | ACHSMODE_CLAMPABLE", True),
        ("ACHSMODE_CLAMPABLE|ACHSMODE_MODULO /* both */", True),
        ("0x800 | 0x4", True),
        ("2048 | 4 # both", True),
        ("4", True),
        ("achsmode_linear | ACHSMODE_CAX", False),
        ("0x800 ACHSMODE_MODULO", False),
        ("0x801 ( | 4", False),
    ],
)
def test_modes_of_an_axis_may_be_joined(mode: str, modulo: bool, read_lists: ReadLists) -> None:
    axis = f"kopf.achs_nr 1\nkenngr.achs_typ 2\nkenngr.achs_mode {mode}\nlr_param.ssfk 1\n"
    reading = read_lists({"achsmd1.lis": axis, "achskw1.lis": f"kopf.achs_nr 1\n{TABLE}"})
    assert reading.findings == ()
    assert (reading.machine.axes[0].modulo is not None) == modulo


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_lists_in_utf_16_are_read(encoding: str, read_lists: ReadLists) -> None:
    files = {name: f"\ufeff{text}".encode(encoding) for name, text in lists().items()}
    reading = read_lists(files, "hochlauf.lis")
    assert [(axis.name, list(axis.kinds)) for axis in reading.machine.axes] == [("X", ["leadscrew"])]
    assert {finding.code for finding in reading.findings} == {"AXC-OTHERS"}
