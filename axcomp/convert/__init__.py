"""Compensation tables of other controllers: read, written, and compared with what they came from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .cec import read_cec as read_cec
    from .cec import write_cec as write_cec
    from .enc_comp import read_enc_comp as read_enc_comp
    from .enc_comp import write_enc_comp as write_enc_comp
    from .formats import FORMATS as FORMATS
    from .formats import LISTS as LISTS
    from .formats import Compared as Compared
    from .formats import compared as compared
    from .formats import recognized as recognized
    from .formats import written as written
    from .heidenhain import read_heidenhain as read_heidenhain
    from .heidenhain import write_heidenhain as write_heidenhain
    from .heidenhain import write_itnc as write_itnc
    from .linuxcnc import read_linuxcnc as read_linuxcnc
    from .linuxcnc import write_linuxcnc as write_linuxcnc
    from .machines import CONVERTED as CONVERTED
    from .machines import dropped as dropped
    from .machines import machine_with as machine_with
    from .machines import tables_of as tables_of
    from .plain_csv import read_csv as read_csv
    from .table import CompensationTable as CompensationTable
    from .table import beginning_at as beginning_at
    from .table import largest_difference as largest_difference
    from .table import on_equidistant_points as on_equidistant_points
    from .text import MAX_POINTS as MAX_POINTS
    from .text import CannotHoldError as CannotHoldError
    from .text import FormatError as FormatError
    from .text import Options as Options
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        cec="read_cec write_cec",
        enc_comp="read_enc_comp write_enc_comp",
        formats="Compared FORMATS LISTS compared recognized written",
        heidenhain="read_heidenhain write_heidenhain write_itnc",
        linuxcnc="read_linuxcnc write_linuxcnc",
        machines="CONVERTED dropped machine_with tables_of",
        plain_csv="read_csv",
        table="CompensationTable beginning_at largest_difference on_equidistant_points",
        text="CannotHoldError FormatError MAX_POINTS Options",
    )
