"""Judgement: whether tables that are well-formed are right: their sign, outliers, seams, dynamics, coverage, limits.

All of it works on the machine alone, with NumPy; pictures need Matplotlib.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.face import face

if TYPE_CHECKING:
    from .coverage import Coverage as Coverage
    from .coverage import setpoints as setpoints
    from .dynamics import Demand as Demand
    from .dynamics import DynamicsResult as DynamicsResult
    from .dynamics import dynamics_of as dynamics_of
    from .dynamics import ramp_rates as ramp_rates
    from .dynamics import rate as rate
    from .judgement import Evidence as Evidence
    from .judgement import Judgement as Judgement
    from .judgement import judge as judge
    from .limits import LargestCorrection as LargestCorrection
    from .limits import largest_corrections as largest_corrections
    from .outliers import spikes as spikes
    from .positions import Positions as Positions
    from .positions import sentence as sentence
    from .seam import seam_of as seam_of
    from .sign import INTERCHANGED as INTERCHANGED
    from .sign import REVERSED as REVERSED
    from .sign import WITHOUT as WITHOUT
    from .sign import WRITTEN as WRITTEN
    from .sign import SignResult as SignResult
    from .sign import sign_of as sign_of
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
