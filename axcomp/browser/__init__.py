"""The page: lists looked at in a browser, by this package on Pyodide and by its kernel as WebAssembly."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .course import Column as Column, columns_of as columns_of, digest as digest, drawn as drawn
    from .site import (
        CYCLES as CYCLES,
        PARTS as PARTS,
        PYODIDE as PYODIDE,
        SiteError as SiteError,
        build_site as build_site,
        proof_of as proof_of,
    )
    from .view import cyclic as cyclic, digest_of as digest_of, kernel_of as kernel_of, look as look, shown as shown
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        course="Column columns_of digest drawn",
        site="CYCLES PARTS PYODIDE SiteError build_site proof_of",
        view="cyclic digest_of kernel_of look shown",
    )
