"""Judgement: whether tables that are well-formed are right: their sign, outliers, seams, dynamics, coverage, limits.

All of it works on the machine alone, with NumPy; pictures need Matplotlib.
"""

from .coverage import Coverage
from .dynamics import Demand, DynamicsResult
from .judge import Judgement, judge
from .limits import LargestCorrection
from .sign import SignResult, sign_of

__all__ = [
    "Coverage",
    "Demand",
    "DynamicsResult",
    "Judgement",
    "LargestCorrection",
    "SignResult",
    "judge",
    "sign_of",
]
