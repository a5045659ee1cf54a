"""What there is to show of a compensation: one object that draws itself, lists its numbers and compares itself."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, NoReturn, TypeVar

from matplotlib.figure import Figure

Cell = float | str
VOLUMETRIC = "volumetric"

_Row = TypeVar("_Row")


class Records(NamedTuple):
    """Numbers under column names that carry their units."""

    columns: Sequence[str]
    rows: Sequence[Sequence[Cell]]


@dataclass(frozen=True)
class Subject:
    """What is shown.

    Attributes
    ----------
    axis : str
        Name of the axis, or of the compensation where it belongs to none.
    kind : str
        One of ``KINDS``, or ``VOLUMETRIC``.
    part : str
        Tells several pictures of one compensation apart; "" where there is one.
    """

    axis: str
    kind: str
    part: str = ""

    @property
    def name(self) -> str:
        """File name without suffix: ``X-leadscrew``."""
        return "-".join(word for word in (self.axis, self.kind, self.part.replace(" ", "-")) if word)

    @property
    def title(self) -> str:
        """Heading: ``Axis X: leadscrew compensation``."""
        part = f", {self.part}" if self.part else ""
        if self.kind == VOLUMETRIC:
            return f"Volumetric {self.axis}{part}"
        return f"Axis {self.axis}: {self.kind} compensation{part}"


class NotComparableError(ValueError):
    """Two contents that have no difference; the message says why."""


@dataclass(frozen=True, eq=False)
class Content(ABC):
    """One thing to show.

    Attributes
    ----------
    subject : Subject
        What it is of.
    note : str
        Added to the title.
    """

    subject: Subject
    note: str = field(default="", kw_only=True)

    @property
    def title(self) -> str:
        """Heading of the picture."""
        return f"{self.subject.title} ({self.note})" if self.note else self.subject.title

    @abstractmethod
    def figure(self) -> Figure:
        """Return its picture."""

    def interactive(self) -> str:
        """Return a picture to be turned, as HTML, "" where a flat one shows all; NoPlotlyError without Plotly."""
        return ""

    @abstractmethod
    def records(self) -> Records:
        """Return all its numbers."""

    def extract(self, rows: int) -> Records:
        """Return its numbers, at most about so many rows of them, evenly spread."""
        everything = self.records()
        return Records(everything.columns, picked(everything.rows, rows))

    @abstractmethod
    def summary(self) -> tuple[str, str, str]:
        """Return its size, its range and that of its values, in words."""

    @abstractmethod
    def against(self, other: Content) -> Content:
        """Return what the other one has more than this one; NotComparableError if they are not alike."""

    def not_comparable(self, why: str) -> NoReturn:
        """Say why this one and another have no difference."""
        raise NotComparableError(f"{self.subject.title}: {why}")


def spread(count: int, wanted: int) -> list[int]:
    """Return numbers of rows evenly spread, the first and the last among them; all if ``wanted`` is 0."""
    if wanted <= 0 or count <= wanted:
        return list(range(count))
    wanted = max(wanted, 2)
    return [round(index * (count - 1) / (wanted - 1)) for index in range(wanted)]


def picked(rows: Sequence[_Row], wanted: int) -> list[_Row]:
    """Return some of the rows, as ``spread`` chooses them."""
    return [rows[index] for index in spread(len(rows), wanted)]


def span(values: Sequence[float], unit: str) -> str:
    """Return the range of some values in words."""
    return f"{min(values):g} … {max(values):g} {unit}" if len(values) else "none"
