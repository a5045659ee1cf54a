"""The demonstration: both FMUs coupled, the error of a machine without and with each compensation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .evaluation import Outcome as Outcome
    from .evaluation import Trace as Trace
    from .evaluation import label as label
    from .evaluation import outcomes as outcomes
    from .evaluation import table as table
    from .picture import draw as draw
    from .run import BuildError as BuildError
    from .run import Demo as Demo
    from .run import DemoError as DemoError
    from .run import demonstrate as demonstrate
    from .trials import TCP as TCP
    from .trials import VOLUMETRIC as VOLUMETRIC
    from .trials import Trial as Trial
    from .trials import trials_of as trials_of
    from .trials import volumetric_trials as volumetric_trials
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        evaluation="Outcome Trace label outcomes table",
        picture="draw",
        run="BuildError Demo DemoError demonstrate",
        trials="TCP Trial VOLUMETRIC trials_of volumetric_trials",
    )
