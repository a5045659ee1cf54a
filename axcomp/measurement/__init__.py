"""From measurements to lists: measuring a machine, here a simulated one, and making compensation tables of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .before_after import BeforeAfter as BeforeAfter
    from .circles import (
        Circle as Circle,
        Zone as Zone,
        least_squares_circle as least_squares_circle,
        minimum_zone as minimum_zone,
    )
    from .circular import (
        CircularPath as CircularPath,
        CircularTest as CircularTest,
        is_circular as is_circular,
        joined_tests as joined_tests,
        read_circular as read_circular,
    )
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
    from .iso230_4 import (
        AFTER as AFTER,
        BEFORE as BEFORE,
        CircularResult as CircularResult,
        PathResult as PathResult,
        evaluate_circular as evaluate_circular,
        window_of as window_of,
    )
    from .mapping import columns_chosen as columns_chosen, unit_factor as unit_factor
    from .outliers import Outlier as Outlier, find_outliers as find_outliers
    from .positioning import (
        TARGET_DIGITS as TARGET_DIGITS,
        Positioning as Positioning,
        angular as angular,
        read_positioning as read_positioning,
        read_positionings as read_positionings,
        unit_of as unit_of,
    )
    from .quadrants import peak_of as peak_of
    from .readings import RUN as RUN, Readings as Readings, joined as joined, whole_runs as whole_runs
    from .trace import AxisTrace as AxisTrace, is_trace as is_trace, read_axis_trace as read_axis_trace
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
        circles="Circle Zone least_squares_circle minimum_zone",
        circular="CircularPath CircularTest is_circular joined_tests read_circular",
        iso230_4="AFTER BEFORE CircularResult PathResult evaluate_circular window_of",
        mapping="columns_chosen unit_factor",
        quadrants="peak_of",
        trace="AxisTrace is_trace read_axis_trace",
        uncertainty="Conditions",
    )
