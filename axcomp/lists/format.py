"""Values and entries as text: what the writers of all lists share."""

from __future__ import annotations

import math
from decimal import Decimal

from ..kinds import ListKind, Parameter, Value, in_list
from .catalogue import parameter
from .grammar import string

_NAME_WIDTH = 40
_CONTROLS = frozenset(map(chr, range(32))) - {"\t"}


class Lines:
    """The entries of one list, checked against the catalogue as they are added.

    Every method raises ValueError for a value that a list cannot hold.
    """

    def __init__(self, kind: ListKind) -> None:
        self._kind = kind
        self._lines: list[str] = []
        self._parameters: dict[str, Parameter] = {}

    def add(self, name: str, value: Value, *indices: int) -> None:
        """Append an entry with a value in the unit of the list."""
        row = self._parameter(name)
        shown = row.named(*indices) if indices else name
        if not row.takes(int(value) if isinstance(value, bool) else value):
            raise ValueError(f"{shown} cannot be {value} in a list")
        self._lines.append(f"{shown:<{_NAME_WIDTH}} {text_of(value, shown, isinstance(value, str))}")

    def add_converted(self, name: str, value: float, *indices: int) -> None:
        """Append an entry with a value in mm, °, mm/s, °/s or a factor."""
        self.add(name, in_list(value, self._parameter(name).quantity), *indices)

    def add_unless_default(self, name: str, value: Value) -> None:
        """Append an entry unless the default says the same."""
        if value != self._parameter(name).default:
            self.add(name, value)

    def heading(self, text: str) -> None:
        """Append a blank line and a comment."""
        self._lines.extend(("", f"# {text}"))

    def text(self) -> str:
        """Return the whole list, closed by ``End``."""
        return "\n".join((*self._lines, "End", ""))

    def _parameter(self, name: str) -> Parameter:
        try:
            return self._parameters[name]
        except KeyError:
            return self._parameters.setdefault(name, parameter(self._kind, name))


def text_of(value: object, name: str, is_string: bool) -> str:
    """Return a value as it stands behind its entry's name.

    Parameters
    ----------
    value : bool, int, float, Decimal or str
        In the unit of the list; for a number also the word that is to stand there.
    name : str
        Of the entry, for the sentence.
    is_string : bool
        Whether the entry is a string: it gets quotes where it needs them.

    Raises
    ------
    ValueError
        The value cannot stand in a list.
    """
    if isinstance(value, (bool, int)):
        return str(int(value))
    if isinstance(value, (float, Decimal)):
        if not math.isfinite(value):
            raise ValueError(f"{name} cannot be {value} in a list")
        return format(value if isinstance(value, Decimal) else Decimal(repr(float(value))), "f")
    text = str(value)
    if is_string:
        return _quoted(text, name)
    if len(text.split()) != 1 or text != text.strip():
        raise ValueError(f"{name} cannot be {value!r} in a list")
    return text


def _quoted(value: str, name: str) -> str:
    """Return a string, in quotes where it needs them; ValueError if even these do not help."""
    for text in (value, f'"{value}"'):
        found = string(text)
        if found.value == value and not found.fault and not found.comment and text and not _CONTROLS & set(text):
            return text
    raise ValueError(f"{name} cannot be {value!r} in a list")
