"""Every parameter of every list, declared once; reader, writer, checks, documentation and commands come from here."""

from __future__ import annotations

from typing import NamedTuple

from ..kinds.parameter import ListKind, Parameter, key_of
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
