"""From measurements to lists: measuring a machine, here a simulated one, and making compensation tables of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .columns import (
        ANGLES as ANGLES,
        LENGTHS as LENGTHS,
        Column as Column,
        Columns as Columns,
        MeasurementError as MeasurementError,
    )
    from .iso230 import PARAMETERS as PARAMETERS, SYMBOLS as SYMBOLS, Iso230Result as Iso230Result, evaluate as evaluate
    from .mapping import columns_chosen as columns_chosen, unit_factor as unit_factor
    from .positioning import (
        TARGET_DIGITS as TARGET_DIGITS,
        Positioning as Positioning,
        angular as angular,
        read_positioning as read_positioning,
        unit_of as unit_of,
    )
    from .quadrants import peak_of as peak_of
    from .readings import RUN as RUN, Readings as Readings, joined as joined
    from .trace import AxisTrace as AxisTrace, is_trace as is_trace, read_axis_trace as read_axis_trace
    from .uncertainty import Conditions as Conditions
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        columns="ANGLES Column Columns LENGTHS MeasurementError",
        iso230="Iso230Result PARAMETERS SYMBOLS evaluate",
        mapping="columns_chosen unit_factor",
        positioning="Positioning TARGET_DIGITS angular read_positioning unit_of",
        quadrants="peak_of",
        readings="RUN Readings joined",
        trace="AxisTrace is_trace read_axis_trace",
        uncertainty="Conditions",
    )
