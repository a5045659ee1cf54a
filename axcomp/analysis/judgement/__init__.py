"""Judgement: whether tables that are well-formed are right: their sign, outliers, seams, dynamics, coverage, limits.

All of it works on the machine alone; what needs a course or a measurement needs NumPy, pictures need Matplotlib.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.face import face

if TYPE_CHECKING:
    from .coverage import Coverage as Coverage, setpoints as setpoints
    from .dynamics import (
        Demand as Demand,
        DynamicsResult as DynamicsResult,
        dynamics_of as dynamics_of,
        ramp_rates as ramp_rates,
        rate as rate,
    )
    from .judgement import Evidence as Evidence, Judgement as Judgement, judge as judge
    from .limits import LargestCorrection as LargestCorrection, largest_corrections as largest_corrections
    from .outliers import spikes as spikes
    from .positions import Positions as Positions, sentence as sentence
    from .seam import seam_of as seam_of
    from .sign import (
        INTERCHANGED as INTERCHANGED,
        REVERSED as REVERSED,
        WITHOUT as WITHOUT,
        WRITTEN as WRITTEN,
        SignResult as SignResult,
        sign_of as sign_of,
    )
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        coverage="Coverage setpoints",
        dynamics="Demand DynamicsResult dynamics_of ramp_rates rate",
        judgement="Evidence Judgement judge",
        limits="LargestCorrection largest_corrections",
        outliers="spikes",
        positions="Positions sentence",
        seam="seam_of",
        sign="INTERCHANGED REVERSED SignResult WITHOUT WRITTEN sign_of",
    )
