"""Parameters of the volumetric list (``vol_comp*.lis``): P-VOLC-00001 … 00020 (manual 003)."""

from __future__ import annotations

from ..kinds import DataType, Manual, Parameter, Quantity
from ..model import FILES_MAX, LETTERS, LINEAR, Interpolation

AUTO = "AUTO"
"""The fifth interpolation mode: GRID for what lies on a grid, SCATTER for the rest."""

ISG_CSV, ETALON_EXCHANGE = "ISG_CSV", "ETALON_EXCHANGE"
"""Formats of parameter files."""

_MODES = (*(mode.value for mode in Interpolation), AUTO)


def _id(number: int) -> dict[Manual, str]:
    return {Manual.VOLUMETRIC: f"P-VOLC-{number:05}"}


VOLUMETRIC = (
    *(
        Parameter(
            letter.lower(),
            f"Logical number of the axis that is {letter}; 0: there is none",
            DataType.UNS16,
            0,
            _id(number),
        )
        for number, letter in enumerate(LETTERS, 1)
    ),
    Parameter("chain", "Kinematic chain from the workpiece to the tool", DataType.STRING, LINEAR, _id(7), length=6),
    Parameter("workpiece_axes", "Axes that carry the workpiece", DataType.UNS16, 0, _id(8), range="[0, 6]"),
    Parameter("negate", "Axes whose correction changes its sign", DataType.STRING, "", _id(9), length=3),
    Parameter("set_to_zero", "Axes whose correction is left out", DataType.STRING, "", _id(10), length=3),
    Parameter("alternative_model", "Rotary axes turn about their displaced axis", DataType.BOOLEAN, 0, _id(11)),
    Parameter(
        "file[j]", "Parameter file", DataType.STRING, "", _id(12), index_max=(FILES_MAX - 1,), index_code="70507"
    ),
    Parameter(
        "file_format[j]",
        "Format of a parameter file",
        DataType.STRING,
        ISG_CSV,
        _id(13),
        values=(ISG_CSV, ETALON_EXCHANGE),
        index_max=(FILES_MAX - 1,),
        index_code="70507",
    ),
    Parameter(
        "interpolation",
        "How parameters are interpolated",
        DataType.STRING,
        Interpolation.GRID.value,
        _id(14),
        values=_MODES,
    ),
    Parameter("enable_splicing", "Repeats the first record of a turn at its end", DataType.BOOLEAN, 0, _id(15)),
    Parameter("diagnosis_file", "Spreadsheet of all records that is written", DataType.STRING, "", _id(16)),
    Parameter("manual_activation", "On only by command", DataType.BOOLEAN, 0, _id(17)),
    Parameter("filter_steps", "Cycles of a switch; 0: at once", DataType.UNS32, 20, _id(18), Quantity.CYCLES),
    Parameter("associate_to_channel", "Program end while on is an error", DataType.BOOLEAN, 0, _id(19)),
    Parameter("use_axis_offsets", "Offsets of the axes count; not modelled", DataType.BOOLEAN, 0, _id(20)),
)
"""``vol_comp*.lis``."""
