"""NC commands that switch compensations: ``X[COMP …]``, ``#VOLCOMP …`` and the variables ``V.G.VOLCOMP[i]…``."""

from .commands import parse_block
from .control import NcControl
from .scanner import NcError

__all__ = ["NcControl", "NcError", "parse_block"]
