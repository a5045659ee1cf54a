"""What each compensation and each error contributes along a path: ``axcomp budget``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.face import face

if TYPE_CHECKING:
    from .contributions import (
        POINTS as POINTS,
        Budget as Budget,
        budget_of as budget_of,
        largest as largest,
        rms as rms,
    )
    from .picture import SHOWN as SHOWN, budget_figure as budget_figure, plot_waterfall as plot_waterfall
    from .propagation import (
        COVERAGE as COVERAGE,
        PLACES as PLACES,
        TRIALS as TRIALS,
        TcpUncertainty as TcpUncertainty,
        tcp_uncertainty as tcp_uncertainty,
    )
    from .uncertainty import (
        Uncertainty as Uncertainty,
        UncertaintyError as UncertaintyError,
        read_uncertainties as read_uncertainties,
    )
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        contributions="Budget POINTS budget_of largest rms",
        picture="SHOWN budget_figure plot_waterfall",
        propagation="COVERAGE PLACES TRIALS TcpUncertainty tcp_uncertainty",
        uncertainty="Uncertainty UncertaintyError read_uncertainties",
    )
