"""What the commands do, as functions for scripts and notebooks; ``axcomp`` offers them all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .functions import (
        Tables as Tables,
        budget as budget,
        build_fmu as build_fmu,
        check as check,
        convert as convert,
        create as create,
        measure as measure,
        show as show,
    )
else:
    __all__, __getattr__, __dir__ = face(
        __name__, functions="Tables budget build_fmu check convert create measure show"
    )
