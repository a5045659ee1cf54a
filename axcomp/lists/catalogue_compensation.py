"""Parameters of the compensation value list (``achskw*.lis``): its header; the kinds declare the rest."""

from __future__ import annotations

from ..kinds import KINDS, DataType, ListKind, Parameter, both

_HEADER = (
    Parameter(
        "kopf.achs_nr",
        "Logical axis number",
        DataType.UNS16,
        0,
        both("00001"),
        range="(0, MAX)",
        aliases=("kopf.log_achs_nr",),
    ),
    Parameter("kopf.log_achs_name", "Axis name", DataType.STRING, "", both("00002"), length=16),
)

COMPENSATION = (
    *_HEADER,
    *(row for kind in KINDS.values() if kind.list_kind is ListKind.COMPENSATION for row in kind.parameters),
)
