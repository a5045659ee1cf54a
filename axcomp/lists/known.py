"""Entries of the controller's lists that are no business of compensation: known, not used, not worth a word each.

The vendor's lists have more names than can be listed here. So a list's structures are known too: whatever stands below
``lr_hw`` is the axis' own, unless it looks like a slip in a name that is used here.
"""

from __future__ import annotations

import difflib
import re
from functools import lru_cache

from ..kinds import ListKind
from .catalogue import SPELLINGS

_CHANNEL_HEADS = "gruppe m_synch prog_start speed_limit_look_ahead spindel vector"
_HEADS = {
    ListKind.START_UP: f"{_CHANNEL_HEADS} channel configuration hmi pfad sercos ve_var",
    ListKind.AXIS: f"{_CHANNEL_HEADS} antr bahnrg cam_gear getriebe handbetrieb kenngr kopf lr_hw lr_param "
    "lr_ueberwach trafo twincat vorsteuer",
    ListKind.COMPENSATION: f"{_CHANNEL_HEADS} kopf",
    ListKind.VOLUMETRIC: "",
}
"""Structures of each kind of list, by the first part of a name; those of channels, which have own lists, everywhere."""

_CHANNEL = (
    "cax_face_id channel_type corr_v_trans_jerk default_ax_name_of_spindle dpl_input_cycles einrechnen_mit_t "
    "einzelschrittmodus ext_wzv_vorhanden start_init_prog_file"
)
_NAMES = {
    ListKind.START_UP: f"{_CHANNEL} at_tslot_type default_sda_mds hand_mds kanal_anzahl konfiguration listen "
    "mds_time_slots nullp_data[] online_prod_time_opt pzv_data[] rtconf_lis sda_mds[] sercos_hochlauf "
    "sercos_ring_anzahl wrkz_data[]",
    ListKind.AXIS: f"{_CHANNEL} fixed_stop_nbr_cycles ident[].wert param[] parameter2 parameter3 parameter5 vb_monitor",
    ListKind.COMPENSATION: _CHANNEL,
    ListKind.VOLUMETRIC: "",
}
"""Names outside these structures, by ``kinds.parameter.key_of``."""

_STRUCTURES = {kind: frozenset(heads.split()) for kind, heads in _HEADS.items()}
_SINGLE = {kind: frozenset(names.split()) for kind, names in _NAMES.items()}
_SHORT = 8
"""Letters of a name up to which one slip is likely; in longer ones two are."""


def is_structure(kind: ListKind, key: str) -> bool:
    """Tell whether an entry belongs to a structure that such lists have and channels have not, be it used or not."""
    head = _head(key)
    return head in _STRUCTURES[kind] and head not in _CHANNEL_HEADS.split()


def is_known(kind: ListKind, key: str) -> bool:
    """Tell whether an entry is one of the controller's that nothing here uses.

    Parameters
    ----------
    kind : ListKind
        Of the list it stands in.
    key : str
        See ``kinds.parameter.key_of``; no name that is used.
    """
    return key in _SINGLE[kind] or (_head(key) in _STRUCTURES[kind] and not similar(kind, key))


def similar(kind: ListKind, key: str) -> str:
    """Return the name of the parameter that an unknown one resembles, "" if none does."""
    return next(iter(all_similar(kind, key)), "")


@lru_cache(maxsize=4096)
def all_similar(kind: ListKind, key: str) -> tuple[str, ...]:
    """Return the names of all parameters that an unknown one resembles."""
    if len(key) > 80:
        return ()
    used = SPELLINGS[kind]
    head = _head(key)
    if head in _STRUCTURES[kind]:
        tail = key[len(head) :]
        slips = 1 if len(tail) - 1 <= _SHORT else 2
        near = [other for other in used if _head(other) == head and _distance(tail, other[len(head) :]) <= slips]
    else:
        near = difflib.get_close_matches(key, used, 3, 0.85)
    return tuple(dict.fromkeys(used[other].parameter.name for other in near))


def _head(key: str) -> str:
    return re.split(r"[.\[]", key, maxsplit=1)[0]


def _distance(a: str, b: str) -> int:
    """Return how many letters are missing, too many, wrong, or interchanged with their neighbours."""
    if abs(len(a) - len(b)) > 2:
        return 3
    before: list[int] = []
    last = list(range(len(b) + 1))
    for i, letter in enumerate(a, 1):
        row = [i]
        for j, other in enumerate(b, 1):
            row.append(min(last[j] + 1, row[-1] + 1, last[j - 1] + (letter != other)))
            if i > 1 and j > 1 and (letter, a[i - 2]) == (b[j - 2], other):
                row[-1] = min(row[-1], before[j - 2] + 1)
        before, last = last, row
    return last[-1]
