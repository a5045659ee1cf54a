"""One module a compensation: everything that is special about it, for all the rooms above (see ``kind.Kind``)."""

from .backlash import Backlash
from .compiling import CompileError
from .cross import Cross
from .crosstalk_data import Crosstalk, CrosstalkCurve, CrosstalkTest
from .friction import Friction
from .kind import KIND_NAMES, Kind, KindInput
from .leadscrew import Leadscrew
from .plane import Plane
from .registry import KINDS, kind_of, kinds_of
from .tables import Tables, tables_of
from .temperature import Temperature

__all__ = [
    "KINDS",
    "KIND_NAMES",
    "Backlash",
    "CompileError",
    "Cross",
    "Crosstalk",
    "CrosstalkCurve",
    "CrosstalkTest",
    "Friction",
    "Kind",
    "KindInput",
    "Leadscrew",
    "Plane",
    "Tables",
    "Temperature",
    "kind_of",
    "kinds_of",
    "tables_of",
]
