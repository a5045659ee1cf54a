"""The translator: the kernel's restricted Python to readable C99 that computes the same bits."""

from .emit import Translation, translate
from .subset import Refusal, TranslationError

__all__ = ["Refusal", "Translation", "TranslationError", "translate"]
