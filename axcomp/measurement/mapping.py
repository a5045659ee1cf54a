"""Which columns of a recording are which quantities: ``velocity=v_ist[mm/s],current=I,time=t[ms]``."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from ..engine import InputError
from .columns import ANGLES, LENGTHS

_BRACKET = re.compile(r"(.*?)\s*[\[(]([^\[\]()]*)[\])]\s*\Z")
_UNIT = re.compile(r"\s*(\d+\.?\d*)?\s*([a-z]*)\s*(?:/\s*(s2|s|min))?\s*\Z")
_BASES = {
    "mm": {name: factor / LENGTHS["mm"] for name, factor in LENGTHS.items()},
    "deg": {name: factor / ANGLES["deg"] for name, factor in ANGLES.items()},
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6},
}
_PER = {"min": ("s", 1.0 / 60.0), "s": ("s", 1.0), "s2": ("s2", 1.0), None: ("", 1.0)}
_PLAIN = str.maketrans({"µ": "u", "μ": "u", "²": "2", "^": None, ",": ".", "°": "deg"})


def columns_chosen(titles: Sequence[str], mapping: Sequence[str], known: Collection[str]) -> dict[str, tuple[str, str]]:
    """Return title and unit of the column of each quantity in ``known``; InputError if the mapping cannot be used."""
    columns = {title: (title, "") for title in titles}
    for title in titles:
        if title not in known and (found := _BRACKET.match(title)):
            columns[title] = (title, found[2])
            columns.setdefault(found[1], columns[title])
    chosen = {name: columns[name] for name in known if name in columns}
    for word in filter(str.strip, ",".join(mapping).split(",")):
        name, equals, column = (part.strip() for part in word.partition("="))
        if not equals or name not in known:
            quantities = ", ".join(known)
            raise InputError(f"--map: “{word}” is no NAME=COLUMN; the names are {quantities}")
        found = _BRACKET.match(column)
        if found and column not in columns:
            chosen[name] = (columns.get(found[1], (found[1], ""))[0], found[2])
        elif column:
            chosen[name] = columns.get(column, (column, ""))
        else:
            chosen.pop(name, None)
    return chosen


def unit_factor(written: str, unit: str) -> float | None:
    """Return what a unit is worth in ``unit``: mm, 0.1um, deg/min, or a bare factor; None if it is none of it."""
    found = _UNIT.match(written.translate(_PLAIN).lower())
    base, _, per = unit.partition("/")
    if found is None or not (base and found[2]):
        return float(found[1] or 1.0) if found else None if base else 1.0
    given, share = _PER[found[3]]
    return (
        float(found[1] or 1.0) * _BASES[base][found[2]] * share if found[2] in _BASES[base] and given == per else None
    )
