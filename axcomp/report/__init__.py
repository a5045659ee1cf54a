"""The report: everything there is to say about a machine's compensations on one page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .protocol import Protocol as Protocol, ProtocolFields as ProtocolFields, make_protocol as make_protocol
    from .report import REPEATS as REPEATS, Report as Report, make_report as make_report
else:
    __all__, __getattr__, __dir__ = face(
        __name__, protocol="Protocol ProtocolFields make_protocol", report="REPEATS Report make_report"
    )
