"""Every parameter of every list, declared once; reader, writer, checks, documentation and commands come from here."""

from __future__ import annotations

from typing import NamedTuple

from ..kinds import KINDS, ListKind, Parameter, key_of
from .catalogue_compensation import COMPENSATION
from .catalogue_machine import AXIS, START_UP
from .catalogue_volumetric import VOLUMETRIC

CATALOGUE: dict[ListKind, tuple[Parameter, ...]] = {
    ListKind.START_UP: START_UP,
    ListKind.AXIS: AXIS,
    ListKind.COMPENSATION: COMPENSATION,
    ListKind.VOLUMETRIC: VOLUMETRIC,
}
"""The parameters of each kind of list, in the order of the manuals."""


ZEROED: dict[ListKind, set[str]] = {
    ListKind.START_UP: {"zahl_kw", "zahl_mds"},
    ListKind.AXIS: set(),
    ListKind.COMPENSATION: {
        row.key
        for kind in KINDS.values()
        for row in kind.parameters
        if "[" in row.name or row.name in (*kind.sizes, *kind.places)
    },
    ListKind.VOLUMETRIC: set(),
}
"""Parameters by ``key_of`` that leave nothing, or not what was meant, of a table or of all lists where they are 0."""


class Spelling(NamedTuple):
    """A name of a parameter: the parameter, and whether a list that uses this name gets a warning."""

    parameter: Parameter
    typo: bool


def _spellings(parameters: tuple[Parameter, ...]) -> dict[str, Spelling]:
    found: dict[str, Spelling] = {}
    for parameter in parameters:
        for name in (parameter.name, *parameter.aliases, *parameter.typos):
            if key_of(name) in found:
                raise ValueError(f"{name} is declared twice")
            found[key_of(name)] = Spelling(parameter, name in parameter.typos)
    return found


SPELLINGS: dict[ListKind, dict[str, Spelling]] = {kind: _spellings(rows) for kind, rows in CATALOGUE.items()}
"""For each kind of list every name it may use, by ``key_of``."""


def parameter(kind: ListKind, name: str) -> Parameter:
    """Return the parameter of a list by any of its names; KeyError if the list has none of that name."""
    return SPELLINGS[kind][key_of(name)].parameter
