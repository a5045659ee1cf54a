"""From measurements to lists: measuring a machine, here a simulated one, and making compensation tables of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .before_after import BeforeAfter as BeforeAfter
    from .columns import (
        ANGLES as ANGLES,
        LENGTHS as LENGTHS,
        Column as Column,
        Columns as Columns,
        MeasurementError as MeasurementError,
        SeveralAxesError as SeveralAxesError,
        of_axis as of_axis,
        read_columns as read_columns,
    )
    from .iso230 import (
        PARAMETERS as PARAMETERS,
        SYMBOLS as SYMBOLS,
        Iso230Result as Iso230Result,
        evaluate as evaluate,
        evaluate_robustly as evaluate_robustly,
    )
    from .outliers import Outlier as Outlier, find_outliers as find_outliers
    from .positioning import (
        TARGET_DIGITS as TARGET_DIGITS,
        Positioning as Positioning,
        angular as angular,
        read_positioning as read_positioning,
        read_positionings as read_positionings,
        unit_of as unit_of,
    )
    from .readings import RUN as RUN, Readings as Readings, joined as joined, whole_runs as whole_runs
    from .uncertainty import Conditions as Conditions
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        before_after="BeforeAfter",
        columns="ANGLES Column Columns LENGTHS MeasurementError SeveralAxesError of_axis read_columns",
        iso230="Iso230Result PARAMETERS SYMBOLS evaluate evaluate_robustly",
        outliers="Outlier find_outliers",
        positioning="Positioning TARGET_DIGITS angular read_positioning read_positionings unit_of",
        readings="RUN Readings joined whole_runs",
        uncertainty="Conditions",
    )
