"""The compensations of a machine's axes as contents: curves and maps with what they mean and their units."""

from __future__ import annotations

import numpy as np

from ..kinds import Tables, tables_of
from ..kinds.shown import SPEED
from ..model.curve import Curve
from ..model.grid import Grid, Scatter
from ..model.machine import Machine
from .content import Content, Subject
from .curves import Curves
from .maps import Layer, Map

SAMPLES = 61
"""Places along each side of a map that is given by scattered tests."""


def contents_of(machine: Machine, axis: str | None = None, kind: str | None = None) -> list[Content]:
    """Return what there is to show of the axes' compensations, axis by axis in the order of a cycle.

    Parameters
    ----------
    machine : Machine
        With every master its compensations name.
    axis, kind : str or None
        Only of this axis, only of this kind.
    """
    return [_content(tables) for tables in tables_of(machine, axis, kind)]


def _content(tables: Tables) -> Content:
    """Return the picture of a compensation: values are shown as they stand in the list."""
    subject = Subject(tables.axis.name, tables.kind)
    first = tables.tables[0]
    if isinstance(first, Curve):
        lines = tuple(one.closed().shown() for one in tables.tables if isinstance(one, Curve))
        reversal = len(tables.curves) == 2
        return Curves(subject, lines, reversal, logarithmic=first.over.name == SPEED, note=first.note)
    if isinstance(first, Grid):
        x, y, points = np.array(first.x), np.array(first.y), np.empty((0, 2))
    else:
        points = np.array(first.places)
        x, y = (np.union1d(side, np.linspace(side.min(), side.max(), SAMPLES)) for side in points.T)
    layers = tuple(Layer.shown(one) for one in tables.tables if isinstance(one, Grid | Scatter))
    return Map(subject, layers, x, y, points, first.note)
