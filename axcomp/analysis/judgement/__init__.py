"""Judgement: whether tables that are well-formed are right: their sign, outliers, seams, dynamics, coverage, limits.

All of it works on the machine alone, with NumPy; pictures need Matplotlib.
"""

from typing import TYPE_CHECKING

from ...model.face import face

if TYPE_CHECKING:
    from .coverage import Coverage as Coverage
    from .dynamics import Demand as Demand
    from .dynamics import DynamicsResult as DynamicsResult
    from .judgement import Evidence as Evidence
    from .judgement import Judgement as Judgement
    from .judgement import judge as judge
    from .limits import LargestCorrection as LargestCorrection
    from .sign import SignResult as SignResult
    from .sign import sign_of as sign_of

__all__, __getattr__, __dir__ = face(
    __name__,
    coverage="Coverage",
    dynamics="Demand DynamicsResult",
    judgement="Evidence Judgement judge",
    limits="LargestCorrection",
    sign="SignResult sign_of",
)
