"""Traces of a controller against the engine: how far they differ, and what would explain it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.face import face

if TYPE_CHECKING:
    from .comparison import (
        EXPLAINED as EXPLAINED,
        WITHIN as WITHIN,
        WITHIN_OTHER as WITHIN_OTHER,
        Comparison as Comparison,
        compare as compare,
    )
    from .picture import replay_figure as replay_figure
    from .trace import read_trace as read_trace
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        comparison="Comparison EXPLAINED WITHIN WITHIN_OTHER compare",
        picture="replay_figure",
        trace="read_trace",
    )
