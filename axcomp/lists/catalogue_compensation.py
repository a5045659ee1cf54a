"""Parameters of the compensation value list (``achskw*.lis``): ISG and TwinCAT manuals, and the leadscrew description.

Ids differ between the manuals where they are used twice: P-COMP-00065 … 00067 are other parameters in each.
"""

from __future__ import annotations

from dataclasses import replace

from .parameter import DataType, Manual, Parameter, Quantity

_POSITION, _VELOCITY, _CYCLES = Quantity.POSITION, Quantity.VELOCITY, Quantity.CYCLES
_FLAG, _UNS16, _UNS32 = DataType.BOOLEAN, DataType.UNS16, DataType.UNS32
_SGN16, _SGN32, _SGN64 = DataType.SGN16, DataType.SGN32, DataType.SGN64
_BELOW_MAX = "[MIN, MAX)"
_AXIS_NUMBER = "[1, MAX]"


def _isg(number: str) -> dict[Manual, str]:
    return {Manual.ISG: f"P-COMP-{number}"}


def _twincat(number: str) -> dict[Manual, str]:
    return {Manual.TWINCAT: f"P-COMP-{number}"}


def _both(number: str) -> dict[Manual, str]:
    return _isg(number) | _twincat(number)


def _all(number: str) -> dict[Manual, str]:
    return _both(number) | {Manual.LEADSCREW: ""}


_HEADER = (
    Parameter(
        "kopf.achs_nr",
        "Logical axis number",
        _UNS16,
        0,
        _both("00001"),
        range="(0, MAX)",
        aliases=("kopf.log_achs_nr",),
    ),
    Parameter("kopf.log_achs_name", "Axis name", DataType.STRING, "", _both("00002"), length=16),
)

_CROSS = (
    Parameter("kw.crosscomp.max_points", "Reserved entries; 0: default", _UNS32, 1001, _both("00060")),
    Parameter("kw.crosscomp.unit", "Positions: 0 increments, 1 metric (discontinued)", _FLAG, 0, _isg("00003")),
    Parameter("kw.crosscomp.last_index", "Last index of the table", _SGN32, 0, _both("00004"), range="[0, MAX]"),
    Parameter(
        "kw.crosscomp.master_ax_nr",
        "Logical number of the master",
        _UNS16,
        0,
        _both("00005"),
        range=_AXIS_NUMBER,
        aliases=("kw.crosscomp.slave_ax_nr",),
    ),
    Parameter("kw.crosscomp.n_cycles", "Cycles of smooth switching", _UNS16, 0, _both("00026"), _CYCLES, "[0, 20]"),
    Parameter("kw.crosscomp.manual_activation", "On only by command", _FLAG, 0, _both("00029")),
    Parameter(
        "kw.crosscomp.table[i].setpoint",
        "Position of the master",
        _SGN32,
        0,
        _both("00006"),
        _POSITION,
        _BELOW_MAX,
        aliases=("kw.crosscomp.table[i].sollw",),
    ),
    Parameter(
        "kw.crosscomp.table[i].correction", "Correction of the slave", _SGN32, 0, _both("00007"), _POSITION, _BELOW_MAX
    ),
)

_PLANE = (
    Parameter("kw.crosscomp2.max_points", "Reserved entries; 0: default", _UNS32, 10201, _both("00061")),
    Parameter("kw.crosscomp2.unit", "Positions: 0 increments, 1 metric (discontinued)", _FLAG, 0, _isg("00008")),
    Parameter(
        "kw.crosscomp2.grid",
        "One distance for both masters, or one each",
        DataType.STRING,
        "QUADRATIC",
        _both("00031"),
        values=("QUADRATIC", "RECTANGULAR"),
    ),
    Parameter(
        "kw.crosscomp2.interval", "Distance of points, QUADRATIC", _UNS32, 0, _both("00009"), _POSITION, "(0, MAX)"
    ),
    Parameter(
        "kw.crosscomp2.interval1",
        "Distance of points of master 1, RECTANGULAR",
        _UNS32,
        0,
        _both("00032"),
        _POSITION,
        "(0, MAX)",
    ),
    Parameter(
        "kw.crosscomp2.interval2",
        "Distance of points of master 2, RECTANGULAR",
        _UNS32,
        0,
        _both("00033"),
        _POSITION,
        "(0, MAX)",
    ),
    Parameter(
        "kw.crosscomp2.last_index_master1", "Last index of master 1", _SGN32, 0, _both("00010"), range="[0, MAX]"
    ),
    Parameter(
        "kw.crosscomp2.last_index_master2", "Last index of master 2", _SGN32, 0, _both("00011"), range="[0, MAX]"
    ),
    Parameter(
        "kw.crosscomp2.start_position_master1",
        "First position of master 1",
        _SGN32,
        0,
        _both("00012"),
        _POSITION,
        _BELOW_MAX,
    ),
    Parameter(
        "kw.crosscomp2.start_position_master2",
        "First position of master 2",
        _SGN32,
        0,
        _both("00013"),
        _POSITION,
        _BELOW_MAX,
    ),
    Parameter(
        "kw.crosscomp2.master1_ax_nr", "Logical number of master 1", _UNS16, 0, _both("00014"), range=_AXIS_NUMBER
    ),
    Parameter(
        "kw.crosscomp2.master2_ax_nr", "Logical number of master 2", _UNS16, 0, _both("00015"), range=_AXIS_NUMBER
    ),
    Parameter("kw.crosscomp2.n_cycles", "Cycles of smooth switching", _UNS16, 0, _both("00027"), _CYCLES, "[0, 20]"),
    Parameter("kw.crosscomp2.manual_activation", "On only by command", _FLAG, 0, _both("00030")),
    Parameter(
        "kw.crosscomp2.table[j][i].correction",
        "Correction of the slave; j counts master 2, i master 1",
        _SGN32,
        0,
        _both("00016"),
        _POSITION,
        _BELOW_MAX,
    ),
)

_LEADSCREW = (
    Parameter("kw.ssfk.max_points", "Reserved entries; 0: default", _UNS32, 1500, _both("00059")),
    Parameter("kw.ssfk.unit", "Positions: 0 increments, 1 metric", _FLAG, 0, _all("00017")),
    Parameter(
        "kw.ssfk.interval",
        "Distance of points; 0: each has its setpoint",
        _SGN32,
        0,
        _all("00018"),
        _POSITION,
        "[0, MAX)",
        typos=("kw.ssfk.intervall",),
    ),
    Parameter("kw.ssfk.kw_startpos", "First position", _SGN32, 0, _all("00019"), _POSITION, _BELOW_MAX),
    Parameter("kw.ssfk.kw_nr_max", "Number of entries", _SGN32, 0, _all("00020"), range="[0, MAX]"),
    Parameter("kw.ssfk.bilateral", "Own values for negative motion", _FLAG, 0, _all("00021")),
    Parameter("kw.ssfk.modulo", "The table repeats with the modulo range", _FLAG, 0, _all("00022")),
    Parameter("kw.ssfk.manual_activation", "On only by command", _FLAG, 0, _both("00028")),
    Parameter("kw.ssfk.set_pos_without_comp", "Other compensations left out of the position", _FLAG, 0, _both("00057")),
    Parameter(
        "kw.ssfk.table[i].pos",
        "Error in positive motion, actual − programmed",
        _SGN32,
        0,
        _all("00023"),
        _POSITION,
        _BELOW_MAX,
    ),
    Parameter(
        "kw.ssfk.table[i].neg",
        "Error in negative motion, actual − programmed",
        _SGN32,
        0,
        _all("00024"),
        _POSITION,
        _BELOW_MAX,
    ),
    Parameter(
        "kw.ssfk.table[i].setpoint",
        "Position of a point",
        _SGN64,
        0,
        _all("00025"),
        _POSITION,
        _BELOW_MAX,
        aliases=("kw.ssfk.table[i].sollw",),
    ),
)


_FRICTION = tuple(
    replace(row, aliases=(f"kw.{row.name}",))
    for row in (
        Parameter("frict_comp.max_points", "Reserved entries; 0: default", _UNS32, 20, _both("00062")),
        Parameter(
            "frict_comp.mode", "0 off, 3 additive current over the velocity", _UNS16, 0, _both("00041"), values=(0, 3)
        ),
        Parameter("frict_comp.table_entries", "Number of entries", _UNS16, 0, _both("00042")),
        Parameter(
            "frict_comp.position_delay",
            "Distance over which the current builds up",
            _SGN32,
            0,
            _both("00043"),
            _POSITION,
            "[0, 10]",
            usable="[0, MAX]",
        ),
        Parameter(
            "frict_comp.reversal_lookahead",
            "Cycles over which the current decays before a reversal",
            _UNS16,
            0,
            _both("00044"),
            _CYCLES,
            "[0, 4]",
        ),
        Parameter(
            "frict_comp.scaling_factor",
            "Factor of all currents",
            _SGN16,
            1000,
            _both("00045"),
            Quantity.PER_MILLE,
            "(MIN, MAX)",
        ),
        Parameter(
            "frict_comp.delay_cycles",
            "Cycles by which the current comes late",
            _SGN16,
            0,
            _both("00058"),
            _CYCLES,
            "[0, 249)",
        ),
        # 0 stands in the vendor's own examples; a negative velocity is the table's fault (110591), not the entry's.
        Parameter(
            "frict_comp.table[i].in", "Velocity", _SGN32, 0, _both("00046"), _VELOCITY, "(0, MAX)", usable=_BELOW_MAX
        ),
        Parameter("frict_comp.table[i].out", "Current", _SGN32, 0, _both("00047"), Quantity.CURRENT, "(MIN, MAX)"),
    )
)


def _correction(motion: str, direction: str, meaning: str, number: str) -> Parameter:
    name = f"kw.crosstalk.position[i].correction_{motion}_{direction}"
    return Parameter(name, meaning, _SGN64, 0, _isg(number), _POSITION, _BELOW_MAX, index_max=(14,))


_CROSSTALK = (
    Parameter(
        "kw.crosstalk.master_dyn_ax_nr",
        "Logical number of the accelerating axis",
        _UNS16,
        0,
        _both("00063"),
        range=_AXIS_NUMBER,
        aliases=("kw.crosstalk.master_ax_nr",),
    ),
    Parameter("kw.crosstalk.n_cycles", "Cycles of smooth switching", _UNS16, 0, _both("00064"), _CYCLES, "[0, 20]"),
    Parameter(
        "kw.crosstalk.manual_activation",
        "On only by command",
        _FLAG,
        0,
        _isg("00065") | _twincat("00073"),
        # So it stands in the overview of the TwinCAT manual.
        typos=("kw.crosstalk.master_ax_nr.manual_activation",),
    ),
    Parameter(
        "kw.crosstalk.acceleration",
        "Acceleration of the tests",
        _SGN32,
        0,
        _isg("00066"),
        Quantity.ACCELERATION,
        "(0, MAX)",
    ),
    Parameter(
        "kw.crosstalk.deceleration",
        "Negative acceleration of the tests",
        _SGN32,
        0,
        _isg("00067"),
        Quantity.ACCELERATION,
        "[MIN, 0)",
    ),
    Parameter(
        "kw.crosstalk.master_pos1_ax_nr",
        "Logical number of adaptation axis 1",
        _UNS16,
        0,
        _isg("00080"),
        range="(0, MAX)",
    ),
    Parameter(
        "kw.crosstalk.master_pos2_ax_nr",
        "Logical number of adaptation axis 2",
        _UNS16,
        0,
        _isg("00081"),
        range="(0, MAX)",
    ),
    Parameter(
        "kw.crosstalk.mode",
        "1 constant, 2 over one adaptation axis, 3 over two",
        DataType.UNS08,
        1,
        _isg("00082"),
        range="[1, 3]",
    ),
    Parameter(
        "kw.crosstalk.max_points", "Number of tests; 0: as many as given", _UNS32, 0, _isg("00083"), range="[0, 15]"
    ),
    Parameter(
        "kw.crosstalk.velocity_dependent", "Corrections differ by the master's direction", _FLAG, 0, _isg("00084")
    ),
    Parameter(
        "kw.crosstalk.position[i].ax_1",
        "Position of adaptation axis 1",
        _SGN64,
        0,
        _isg("00085"),
        _POSITION,
        _BELOW_MAX,
        index_max=(14,),
    ),
    Parameter(
        "kw.crosstalk.position[i].ax_2",
        "Position of adaptation axis 2",
        _SGN64,
        0,
        _isg("00086"),
        _POSITION,
        _BELOW_MAX,
        index_max=(14,),
    ),
    _correction("accelerate", "dir_pos", "Correction, speeding up in positive motion", "00087"),
    _correction("accelerate", "dir_neg", "Correction, speeding up in negative motion", "00088"),
    _correction("decelerate", "dir_pos", "Correction, slowing down in positive motion", "00089"),
    _correction("decelerate", "dir_neg", "Correction, slowing down in negative motion", "00090"),
    Parameter("kw.crosstalk.last_index", "Last index of the table", _SGN32, 0, _twincat("00065"), range="[0, 5)"),
    Parameter(
        "kw.crosstalk.table[i].acceleration",
        "Acceleration of the master, with sign",
        _SGN32,
        0,
        _twincat("00066"),
        Quantity.ACCELERATION,
        _BELOW_MAX,
        index_max=(4,),
    ),
    Parameter(
        "kw.crosstalk.table[i].correction",
        "Correction of the slave",
        _SGN32,
        0,
        _twincat("00067"),
        _POSITION,
        _BELOW_MAX,
        index_max=(4,),
    ),
)

COMPENSATION = (*_HEADER, *_CROSS, *_PLANE, *_LEADSCREW, *_FRICTION, *_CROSSTALK)
