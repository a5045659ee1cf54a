"""The demonstration: both FMUs coupled, the error of a machine without and with each compensation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .coupling import Batch as Batch, Simulation as Simulation, couple as couple
    from .evaluation import Outcome as Outcome, Trace as Trace, label as label, outcomes as outcomes, table as table
    from .picture import draw as draw
    from .run import BuildError as BuildError, Demo as Demo, DemoError as DemoError, demonstrate as demonstrate
    from .system import write_ssp as write_ssp
    from .trials import (
        TCP as TCP,
        VOLUMETRIC as VOLUMETRIC,
        Trial as Trial,
        trials_of as trials_of,
        volumetric_trials as volumetric_trials,
    )
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        coupling="Batch Simulation couple",
        evaluation="Outcome Trace label outcomes table",
        picture="draw",
        run="BuildError Demo DemoError demonstrate",
        system="write_ssp",
        trials="TCP Trial VOLUMETRIC trials_of volumetric_trials",
    )
