"""One module a compensation: everything that is special about it, for all the rooms above (see ``kind.Kind``)."""

from __future__ import annotations

from .backlash import MODE, NEGATIVE, Backlash
from .compiling import AxisCompiler, CompileError, append
from .cross import Cross
from .crosstalk_data import Crosstalk, CrosstalkCurve, CrosstalkTest
from .friction import Friction
from .kind import KIND_NAMES, Kind, KindInput, TableArray
from .leadscrew import Leadscrew
from .parameter import DataType, ListKind, Manual, Parameter, Quantity, Range, Severity, Value, axis, both, key_of
from .plane import Plane
from .registry import KINDS, kind_of, kinds_of
from .shown import ACCELERATION, POSITION, SPEED
from .tables import Tables, tables_of
from .temperature import Temperature
from .units import METRIC, Gear, convert, equidistant, in_list

__all__ = [
    "ACCELERATION",
    "KINDS",
    "KIND_NAMES",
    "METRIC",
    "MODE",
    "NEGATIVE",
    "POSITION",
    "SPEED",
    "AxisCompiler",
    "Backlash",
    "CompileError",
    "Cross",
    "Crosstalk",
    "CrosstalkCurve",
    "CrosstalkTest",
    "DataType",
    "Friction",
    "Gear",
    "Kind",
    "KindInput",
    "Leadscrew",
    "ListKind",
    "Manual",
    "Parameter",
    "Plane",
    "Quantity",
    "Range",
    "Severity",
    "TableArray",
    "Tables",
    "Temperature",
    "Value",
    "append",
    "axis",
    "both",
    "convert",
    "equidistant",
    "in_list",
    "key_of",
    "kind_of",
    "kinds_of",
    "tables_of",
]
