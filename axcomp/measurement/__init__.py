"""From measurements to lists: measuring a machine, here a simulated one, and making compensation tables of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .columns import ANGLES as ANGLES
    from .columns import LENGTHS as LENGTHS
    from .columns import Column as Column
    from .columns import Columns as Columns
    from .columns import MeasurementError as MeasurementError
    from .iso230 import PARAMETERS as PARAMETERS
    from .iso230 import SYMBOLS as SYMBOLS
    from .iso230 import Iso230Result as Iso230Result
    from .iso230 import evaluate as evaluate
    from .positioning import TARGET_DIGITS as TARGET_DIGITS
    from .positioning import Positioning as Positioning
    from .positioning import angular as angular
    from .positioning import read_positioning as read_positioning
    from .positioning import unit_of as unit_of
    from .readings import RUN as RUN
    from .readings import Readings as Readings
    from .readings import joined as joined
    from .uncertainty import Conditions as Conditions
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        columns="ANGLES Column Columns LENGTHS MeasurementError",
        iso230="Iso230Result PARAMETERS SYMBOLS evaluate",
        positioning="Positioning TARGET_DIGITS angular read_positioning unit_of",
        readings="RUN Readings joined",
        uncertainty="Conditions",
    )
