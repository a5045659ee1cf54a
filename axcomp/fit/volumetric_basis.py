"""What a volumetric identification seeks: values of errors at nodes, and which of them the data tell apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..model import ERRORS, LETTERS, ROTARY
from .hat_functions import hats

FULL_TURN = 360.0
_OFTEN, _ALL_OVER, _BEYOND = 0.02, 0.5, 0.02
"""Share of the readings at one position that makes it a node, of the travel that such positions cover, and beyond which
the ends of the travel are nodes too."""

_DIGITS = 6
_DEPENDENT = 1e-7
"""A column is taken to depend on others if so little of it is left without them, relative to its length."""

_ALIAS = 1e-5
"""Smallest part of a column, relative to its length, by which another one is said to take part in it."""


@dataclass(frozen=True, eq=False)
class Sought:
    """One error that is sought.

    Attributes
    ----------
    name : str
        One of ``volumetric.ERRORS``.
    argument : str
        Letter of the axis it depends on, "" for a constant.
    nodes : array, shape (k,)
        Positions at which its values are sought, mm or °; one that does not matter for a constant.
    periodic : bool
        The value at the first node is that one turn later too.
    rigid : bool
        No error, but what is unknown of a station or sphere: it is kept before all errors.
    """

    name: str
    argument: str
    nodes: Array
    periodic: bool = False
    rigid: bool = False

    def weights(self, places: Array) -> Array:
        """Return the share of each value in the error at places (n, 6), shape (n, k)."""
        if not self.argument:
            return np.ones((len(places), 1))
        at = places[:, LETTERS.index(self.argument)]
        if not self.periodic:
            return hats(self.nodes, at)
        first = self.nodes[0]
        around = hats(np.append(self.nodes, first + FULL_TURN), first + np.mod(at - first, FULL_TURN))
        around[:, 0] += around[:, -1]
        return around[:, :-1]

    @property
    def label(self) -> str:
        """What the values are of."""
        return f"{self.name} over {self.argument}" if self.argument else self.name


@dataclass(frozen=True)
class Redundancy:
    """An error of which the data do not tell everything.

    Attributes
    ----------
    name : str
        The error.
    part : str
        ``all of it``, ``its constant part``, ``its linear part``, ``its constant and linear parts``, ``a part of it``.
    others : tuple of str
        The errors that the same deviations could come from; empty if it has no effect on the deviations at all.
    """

    name: str
    part: str
    others: tuple[str, ...]

    def __str__(self) -> str:
        """One sentence."""
        if not self.others:
            return f"{self.name}: {self.part} has no effect on what was measured; it is 0."
        return f"{self.name}: {self.part} cannot be told from {', '.join(self.others)}; it is 0 here."


def sought_errors(names: Sequence[str], places: Array, nodes_max: int) -> list[Sought]:
    """Return what is sought for errors, given the places of the measurement (n, 6).

    Position errors are constants; component errors depend on their own axis and have their nodes where it was measured,
    or at as many equal distances as there may be. Component errors of an axis that did not move are left out.
    """
    found = []
    for name in (error for error in ERRORS if error in names):
        if name[0] != "E":
            found.append(Sought(name, "", np.zeros(1)))
            continue
        letter = name[-1]
        nodes, periodic = _nodes(letter, places[:, LETTERS.index(letter)], nodes_max)
        if len(nodes) > 1:
            found.append(Sought(name, letter, nodes, periodic))
    return found


def _nodes(letter: str, at: Array, nodes_max: int) -> tuple[Array, bool]:
    """Return the nodes over an axis, and whether they go all the way round."""
    distinct = np.unique(np.round(at, _DIGITS))
    if letter in ROTARY:
        folded = np.unique(np.round(np.mod(distinct, FULL_TURN), _DIGITS))
        gaps = np.diff(np.append(folded, folded[0] + FULL_TURN))
        full = distinct[-1] - distinct[0] >= FULL_TURN
        if len(folded) > 2 and (full or gaps.max() <= 2.0 * np.median(gaps)):
            if len(folded) <= nodes_max:
                return np.asarray(folded, dtype=np.float64), True
            around = _equidistant(0.0, FULL_TURN, min(len(folded), nodes_max) + 1)
            return around[:-1], True
    if len(distinct) <= nodes_max:
        return np.asarray(distinct, dtype=np.float64), False
    often = _often(distinct, at)
    if 2 < len(often) <= nodes_max:
        return often, False
    return _equidistant(float(distinct[0]), float(distinct[-1]), nodes_max), False


def _often(distinct: Array, at: Array) -> Array:
    """Return where it was measured often, with the ends of the axis; none if that is not all over it."""
    counts = np.unique(np.round(at, _DIGITS), return_counts=True)[1]
    found = distinct[counts >= max(3.0, _OFTEN * len(at))]
    span = float(np.ptp(distinct))
    if len(found) < 3 or np.ptp(found) < _ALL_OVER * span:
        return np.zeros(0)
    ends = [end for end in (distinct[0], distinct[-1]) if np.min(np.abs(found - end)) > _BEYOND * span]
    return np.unique(np.append(found, ends))


def _equidistant(first: float, last: float, count: int) -> Array:
    return np.asarray(np.linspace(first, last, count).round(_DIGITS), dtype=np.float64)


class Selection:
    """Which values the data determine, if the others are 0.

    Position errors are kept before component errors, and of these the values between the ends before those at the ends
    and at the place nearest to 0: so it is usually there that component errors become 0, as ISO 230-1 has it.

    Parameters
    ----------
    sought : sequence of Sought
    columns : array, shape (readings, values)
        What each value does to the readings, or R of its QR decomposition.

    Attributes
    ----------
    kept : array of int
        Places of the values that are determined, in the order of the columns.
    redundancies : tuple of Redundancy
        What is not determined, by error.
    """

    def __init__(self, sought: Sequence[Sought], columns: Array) -> None:
        self._sought = list(sought)
        self._owner = np.repeat(np.arange(len(sought)), [len(s.nodes) for s in sought])
        lengths = np.linalg.norm(columns, axis=0)
        scale = float(lengths.max(initial=0.0))
        basis = np.empty((columns.shape[0], min(columns.shape)))
        rank = 0
        kept: list[int] = []
        dropped: list[int] = []
        for value in self._order():
            column = columns[:, value]
            if lengths[value] <= _DEPENDENT * scale:
                dropped.append(value)
                continue
            left = column.copy()
            for _ in range(2):
                left -= basis[:, :rank] @ (basis[:, :rank].T @ left)
            size = float(np.linalg.norm(left))
            if size <= _DEPENDENT * lengths[value] or rank == basis.shape[1]:
                dropped.append(value)
            else:
                basis[:, rank] = left / size
                rank += 1
                kept.append(value)
        self.kept: npt.NDArray[np.int64] = np.sort(np.array(kept, dtype=np.int64))
        self.redundancies = tuple(self._named(dropped, columns, lengths, _DEPENDENT * scale))

    def _order(self) -> list[int]:
        order: list[tuple[int, int]] = []
        first = 0
        for sought in self._sought:
            count = len(sought.nodes)
            reference = int(np.argmin(np.abs(sought.nodes)))
            for i in range(count):
                late = 1 + (i in (0, count - 1)) + 2 * (i == reference) if sought.argument else -int(sought.rigid)
                order.append((late, first + i))
            first += count
        return [value for _, value in sorted(order)]

    def _named(self, dropped: Sequence[int], columns: Array, lengths: Array, nothing: float) -> list[Redundancy]:
        """Return a redundancy for each error that has values which are not determined."""
        found: list[Redundancy] = []
        if not dropped:
            return found
        shares = np.linalg.lstsq(columns[:, self.kept], columns[:, list(dropped)], rcond=None)[0]
        for place, sought in enumerate(self._sought):
            mine = [i for i, value in enumerate(dropped) if self._owner[value] == place]
            if not mine:
                continue
            others: set[int] = set()
            shapes = np.zeros((len(mine), len(sought.nodes)))
            first = int(np.flatnonzero(self._owner == place)[0])
            for row, i in zip(shapes, mine, strict=True):
                row[dropped[i] - first] = 1.0
                if lengths[dropped[i]] <= nothing:
                    continue
                parts = shares[:, i] * lengths[self.kept] / lengths[dropped[i]]
                for k in np.flatnonzero(np.abs(parts) > _ALIAS):
                    if self._owner[self.kept[k]] == place:
                        row[self.kept[k] - first] = -shares[k, i]
                    else:
                        others.add(int(self._owner[self.kept[k]]))
            names = tuple(self._sought[o].name for o in sorted(others))
            found.append(Redundancy(sought.name, _part(sought, shapes), names))
        return found


def _part(sought: Sought, shapes: Array) -> str:
    """Return which part of an error the shapes (some, nodes) span."""
    count = len(sought.nodes)
    if len(shapes) == count:
        return "all of it"
    flat, straight = np.ones(count), np.column_stack([np.ones(count), sought.nodes])
    if not sought.periodic and len(shapes) == 2 and _inside(shapes, straight):
        return "its constant and linear parts"
    if len(shapes) == 1 and _inside(shapes, flat[:, None]):
        return "its constant part"
    if len(shapes) == 1 and not sought.periodic and _inside(shapes, straight):
        return "its linear part"
    return "a part of it"


def _inside(shapes: Array, space: Array) -> bool:
    """Tell whether all shapes lie in a space."""
    left = shapes.T - space @ np.linalg.lstsq(space, shapes.T, rcond=None)[0]
    return bool(np.max(np.abs(left)) <= 1e-3 * np.max(np.abs(shapes)))
