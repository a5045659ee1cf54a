"""Parameters of the start-up list and of the axis list, as far as they concern compensations."""

from __future__ import annotations

from ..kinds import KINDS, DataType, ListKind, Manual, Parameter, Quantity, axis
from ..model import COMPENSATIONS_MAX


def _start_up(number: str) -> dict[Manual, str]:
    return {Manual.START_UP: f"P-STUP-{number}"}


def _gear(name: str, meaning: str, default: int, number: str, code: str = "AXC-RANGE", low: int = 1) -> Parameter:
    """Return a parameter of the gear steps."""
    return Parameter(
        f"getriebe[i].{name}",
        meaning,
        DataType.UNS32,
        default,
        axis(number),
        range=f"[{low}, MAX]",
        index_max=(15,),
        code=code,
    )


_MODES = {
    "LINEAR": 0x1,
    "MODULO": 0x4,
    "PLANDREHEN": 0x40,
    "LAENGSDREHEN": 0x80,
    "KEINE_AUTO_RPF": 0x100,
    "CAX": 0x200,
    "MODULO_LINEAR": 0x400,
    "CLAMPABLE": 0x800,
    "ROT_TABLE": 0x1000,
    "COLL_CHECK": 0x8000,
    "GANTRY_MASTER": 0x1_0000,
    "GANTRY_SLAVE": 0x2_0000,
    "SPINDLE_EXT_CTRL": 0x4_0000,
}
"""Bits of P-AXIS-00015 by the names the vendor's page gives; only that of modulo matters."""

START_UP = (
    Parameter("zahl_kw", "Number of compensation value lists", DataType.UNS16, 0, _start_up("00016"), range="[0, 32]"),
    Parameter(
        "achs_kw[i]", "File name of a compensation list", DataType.STRING, "", _start_up("00017"), index_max=(31,)
    ),
    Parameter(
        "achs_kw_log_ax_nr[i]",
        "Logical axis number of a compensation list; 0: the list's own counts",
        DataType.UNS16,
        0,
        _start_up("00036"),
        range="[0, MAX)",
        index_max=(31,),
    ),
    Parameter(
        "default_achs_mds",
        "File name of the axis list read first, for all axes",
        DataType.STRING,
        "",
        _start_up("00035"),
    ),
    Parameter(
        "zahl_mds", "Number of axis lists", DataType.SGN16, 0, _start_up("00014"), range="[1, 32]", usable="[0, 32]"
    ),
    Parameter("achs_mds[i]", "File name of an axis list", DataType.STRING, "", _start_up("00015"), index_max=(31,)),
    Parameter(
        "vol_comp[i].max_records",
        "Records reserved for a volumetric compensation",
        DataType.UNS32,
        0,
        _start_up("00100"),
        index_max=(COMPENSATIONS_MAX - 1,),
        index_code="70506",
    ),
    Parameter(
        "vol_comp[i].file_name",
        "File name of a volumetric list",
        DataType.STRING,
        "",
        _start_up("00101"),
        index_max=(COMPENSATIONS_MAX - 1,),
        index_code="70506",
    ),
)
"""``hochlauf.lis``."""

AXIS = (
    Parameter(
        "kopf.achs_nr",
        "Logical axis number",
        DataType.UNS16,
        0,
        axis("00016"),
        range="(0, MAX)",
        aliases=("kopf.log_achs_nr",),
    ),
    Parameter("kopf.log_achs_name", "Axis name", DataType.STRING, "", {Manual.AXIS: ""}, length=16),
    Parameter(
        "kenngr.achs_typ",
        "Axis type: 1 translatory, 2 rotary, 4 spindle",
        DataType.UNS16,
        1,
        axis("00018"),
        values=(1, 2, 4),
        names={"ACHSTYP_TRANSLATOR": 1, "ACHSTYP_ROTATOR": 2, "ACHSTYP_SPINDEL": 4},
    ),
    Parameter(
        "kenngr.achs_mode",
        "Operating mode; bit 0x4: modulo",
        DataType.UNS32,
        1,
        axis("00015"),
        names={f"ACHSMODE_{name}": bit for name, bit in _MODES.items()},
        flags=True,
    ),
    Parameter("kenngr.gantry_ax_nr", "Logical number of the gantry master", DataType.UNS16, 0, axis("00070")),
    *(kind.activator for kind in KINDS.values()),
    *(row for kind in KINDS.values() if kind.list_kind is ListKind.AXIS for row in kind.parameters),
    Parameter(
        "lr_param.n_backlash_cyc",
        "Cycles over which leadscrew and backlash compensation change direction",
        DataType.UNS16,
        0,
        axis("00243"),
        Quantity.CYCLES,
        "[0, 20]",
    ),
    Parameter(
        "lr_param.vol_comp.s_limit",
        "Largest volumetric correction; 0: not defined",
        DataType.UNS32,
        0,
        axis("00525"),
        Quantity.POSITION,
    ),
    Parameter(
        "lr_param.vol_comp.v_limit",
        "Largest velocity of a volumetric correction; 0: not defined",
        DataType.UNS32,
        0,
        axis("00526"),
        Quantity.VELOCITY,
    ),
    _gear("wegaufn", "Path resolution, 0.1 µm or 0.0001°", 1, "00233", "110086"),
    _gear("wegaufz", "Path resolution, increments", 1, "00234", "110386"),
    _gear("incr_per_rev", "Encoder increments per revolution of the motor", 1024, "00092", low=0),
    _gear("gear_fact_num", "Gear: turns of the motor", 1, "00511"),
    _gear("gear_fact_denom", "Gear: turns of the load", 1, "00512"),
    _gear("feed_const_num", "Feed constant, 0.1 µm or 0.0001°", 1, "00362"),
    _gear("feed_const_denom", "Feed constant, revolutions of the load", 1, "00363", "110472"),
    Parameter(
        "getriebe[i].modulou",
        "Lower end of the modulo range",
        DataType.SGN32,
        0,
        axis("00127"),
        Quantity.POSITION,
        index_max=(15,),
    ),
    Parameter(
        "getriebe[i].moduloo",
        "Upper end of the modulo range",
        DataType.SGN32,
        3_600_000,
        axis("00126"),
        Quantity.POSITION,
        index_max=(15,),
    ),
)
"""``achsmd*.lis``; of the gear steps only the first one is used."""
