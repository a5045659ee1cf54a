"""Which kind of list a file is, by what stands in it, wherever it lies and however it is called."""

from __future__ import annotations

import re
from collections import Counter
from fnmatch import fnmatchcase

from ..kinds import ListKind, key_of
from ..model import LETTERS, PARAMETERS
from .catalogue import SPELLINGS
from .catalogue_volumetric import ETALON_EXCHANGE, ISG_CSV
from .known import is_structure

START_UP_NAME = "hochlauf.lis"

_NAME = re.compile(r"^[^\S\n]*([^\W0-9][\w.]*(?:\[[0-9 ]*\][\w.]*)*)(?=\s|$|[\"“])", re.M)
_LOOKED_AT = 100_000
"""Characters from which the kind of a list is told: an entry of its own comes long before."""

_START_UP_ENTRY = re.compile(r"^\s*(?:zahl_kw|zahl_mds|achs_kw|achs_mds|default_achs_mds|vol_comp\s*\[)", re.I | re.M)


def kind_of(name: str, text: str) -> ListKind | None:
    """Return the kind of a list: by its entries, else by the name of its file; None where neither tells."""
    if name.lower() == START_UP_NAME or _START_UP_ENTRY.search(text) is not None:
        return ListKind.START_UP
    counts: Counter[ListKind] = Counter()
    for key, count in Counter(key_of(found) for found in _NAME.findall(text[:_LOOKED_AT])).items():
        for kind, spellings in SPELLINGS.items():
            # The header is the same in several kinds.
            if not key.startswith("kopf.") and (key in spellings or is_structure(kind, key)):
                counts[kind] += count
    if counts:
        return max(counts, key=counts.__getitem__)
    return next((kind for kind in ListKind if fnmatchcase(name.lower(), kind.value)), None)


def parameter_format(text: str) -> str | None:
    """Return the format of a file of volumetric parameters, None for any other text."""
    for line in text[:_LOOKED_AT].split("\n"):
        cells = re.split(r"[\s,;\"]+", line.partition("//")[0].strip().strip('"'))
        if cells == [""] or cells[0].startswith("#"):
            continue
        if re.fullmatch(r"\[\w+\]", cells[0]):
            return ETALON_EXCHANGE
        names = [cell.upper() for cell in cells]
        known = sum(cell in PARAMETERS for cell in names)
        return ISG_CSV if known and known + sum(cell in LETTERS for cell in names) > len(names) // 2 else None
    return None
