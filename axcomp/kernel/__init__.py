"""The compensations of one cycle, in a subset of Python that translates line by line to C99.

Numbers are double and int32, tables lie in one pool of doubles, and nothing is allocated or raised: two runs, in any
language and on any machine, give the same bits. ``record`` is the only module that C does not see.
"""

from __future__ import annotations

from .adopt import adopt_axis, adopt_volumetrics, keep_declared, move_axis_table, update_error
from .compensations import (
    BACKLASH,
    CROSS,
    CROSSTALK,
    FRICTION,
    LEADSCREW,
    PLANE,
    TEMPERATURE,
    CompensationTables,
    has_notice,
)
from .crosstalk import (
    CROSSTALK_CONSTANT,
    CROSSTALK_CURVE,
    CROSSTALK_GRID,
    CROSSTALK_LINE,
    CROSSTALK_TRIANGLES,
    CrosstalkTable,
)
from .cycle import cycle
from .fit import given_fits, state_fits, tables_fit
from .friction import DELAY_LINE, LOOKAHEAD_MAX
from .interpolation import LARGEST, Curve, Lookup, curve_value, fold, nearest
from .motion import Argument, is_motion
from .record import APART, Vec, fields_of, zero, zeros
from .records import (
    ERROR_INPUT,
    ERROR_SWITCH,
    ERROR_UPDATE,
    AxisInputs,
    AxisOutputs,
    AxisTable,
    Inputs,
    Outputs,
    State,
    Tables,
)
from .switching import CYCLES_MAX, ramp
from .trigonometry import cosine, sine
from .volumetric import LARGEST_TOOL
from .volumetric_errors import errors_at, find_cell
from .volumetric_model import FRAME, carry_to_workpiece, correction_at, correction_with
from .volumetric_records import (
    ERROR_LIMIT_EXCEEDED,
    ERROR_LIMIT_UNDEFINED,
    ERROR_PROGRAM_END,
    ERROR_SINGULAR,
    IN_BOX,
    INTERPOLATE_GRID,
    INTERPOLATE_PATH,
    INTERPOLATE_SCATTER,
    TOGETHER,
    ErrorBlock,
    VolumetricTable,
)
from .volumetric_switching import adopt_volumetric

EXPORTS = (
    "cycle",
    "has_notice",
    "update_error",
    "adopt_axis",
    "keep_declared",
    "adopt_volumetrics",
    "move_axis_table",
    "tables_fit",
    "state_fits",
    "given_fits",
)
"""The functions that C calls by name; the translation has them and what they call."""

__all__ = [
    "APART",
    "BACKLASH",
    "CROSS",
    "CROSSTALK",
    "CROSSTALK_CONSTANT",
    "CROSSTALK_CURVE",
    "CROSSTALK_GRID",
    "CROSSTALK_LINE",
    "CROSSTALK_TRIANGLES",
    "CYCLES_MAX",
    "DELAY_LINE",
    "ERROR_INPUT",
    "ERROR_LIMIT_EXCEEDED",
    "ERROR_LIMIT_UNDEFINED",
    "ERROR_PROGRAM_END",
    "ERROR_SINGULAR",
    "ERROR_SWITCH",
    "ERROR_UPDATE",
    "FRAME",
    "FRICTION",
    "INTERPOLATE_GRID",
    "INTERPOLATE_PATH",
    "INTERPOLATE_SCATTER",
    "IN_BOX",
    "LARGEST",
    "LARGEST_TOOL",
    "LEADSCREW",
    "LOOKAHEAD_MAX",
    "PLANE",
    "TEMPERATURE",
    "TOGETHER",
    "Argument",
    "AxisInputs",
    "AxisOutputs",
    "AxisTable",
    "CompensationTables",
    "CrosstalkTable",
    "Curve",
    "ErrorBlock",
    "Inputs",
    "Lookup",
    "Outputs",
    "State",
    "Tables",
    "Vec",
    "VolumetricTable",
    "adopt_axis",
    "adopt_volumetric",
    "adopt_volumetrics",
    "carry_to_workpiece",
    "correction_at",
    "correction_with",
    "cosine",
    "curve_value",
    "cycle",
    "errors_at",
    "fields_of",
    "find_cell",
    "fold",
    "given_fits",
    "has_notice",
    "is_motion",
    "keep_declared",
    "move_axis_table",
    "nearest",
    "ramp",
    "sine",
    "state_fits",
    "tables_fit",
    "update_error",
    "zero",
    "zeros",
]
