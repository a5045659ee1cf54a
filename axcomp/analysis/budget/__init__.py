"""What each compensation and each error contributes along a path: ``axcomp budget``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.face import face

if TYPE_CHECKING:
    from .contributions import POINTS as POINTS
    from .contributions import Budget as Budget
    from .contributions import budget_of as budget_of
    from .contributions import largest as largest
    from .contributions import rms as rms
    from .picture import SHOWN as SHOWN
    from .picture import budget_figure as budget_figure
    from .picture import plot_waterfall as plot_waterfall
    from .propagation import COVERAGE as COVERAGE
    from .propagation import PLACES as PLACES
    from .propagation import TRIALS as TRIALS
    from .propagation import TcpUncertainty as TcpUncertainty
    from .propagation import tcp_uncertainty as tcp_uncertainty
    from .uncertainty import Uncertainty as Uncertainty
    from .uncertainty import UncertaintyError as UncertaintyError
    from .uncertainty import read_uncertainties as read_uncertainties
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        contributions="Budget POINTS budget_of largest rms",
        picture="SHOWN budget_figure plot_waterfall",
        propagation="COVERAGE PLACES TRIALS TcpUncertainty tcp_uncertainty",
        uncertainty="Uncertainty UncertaintyError read_uncertainties",
    )
