"""The language server: what the linter says, while one types, and all there is to know about an entry."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .server import serve as serve
    from .sources import Sources as Sources
    from .text import Text as Text
else:
    __all__, __getattr__, __dir__ = face(__name__, server="serve", sources="Sources", text="Text")
