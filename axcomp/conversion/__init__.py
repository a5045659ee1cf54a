"""Compensation tables of other controllers: read, written, and compared with what they came from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .cec import read_cec as read_cec, write_cec as write_cec
    from .enc_comp import read_enc_comp as read_enc_comp, write_enc_comp as write_enc_comp
    from .formats import (
        FORMATS as FORMATS,
        LISTS as LISTS,
        Compared as Compared,
        compared as compared,
        recognized as recognized,
        written as written,
    )
    from .heidenhain import (
        read_heidenhain as read_heidenhain,
        write_heidenhain as write_heidenhain,
        write_itnc as write_itnc,
    )
    from .linuxcnc import read_linuxcnc as read_linuxcnc, write_linuxcnc as write_linuxcnc
    from .machines import (
        CONVERTED as CONVERTED,
        dropped as dropped,
        machine_with as machine_with,
        tables_of as tables_of,
    )
    from .plain_csv import read_csv as read_csv
    from .table import (
        CompensationTable as CompensationTable,
        beginning_at as beginning_at,
        largest_difference as largest_difference,
        on_equidistant_points as on_equidistant_points,
    )
    from .text import (
        MAX_POINTS as MAX_POINTS,
        CannotHoldError as CannotHoldError,
        FormatError as FormatError,
        Options as Options,
    )
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
