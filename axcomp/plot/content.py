"""What there is to show of a compensation: one object that draws itself, lists its numbers and compares itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from matplotlib.figure import Figure

Cell = float | str


class Records(NamedTuple):
    """Numbers under column names that carry their units."""

    columns: tuple[str, ...]
    rows: list[tuple[Cell, ...]]


@dataclass(frozen=True)
class Subject:
    """What is shown.

    Attributes
    ----------
    axis : str
        Name of the axis, or of the compensation where it belongs to none.
    kind : str
        One of ``KINDS``, or ``volumetric``.
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
        who = f"Axis {self.axis}" if self.kind != "volumetric" else f"Volumetric {self.axis}"
        return f"{who}: {self.kind} compensation{part}" if self.kind != "volumetric" else f"{who}{part}"


class NotComparableError(ValueError):
    """Two contents that have no difference; the message says why."""


class Content(Protocol):
    """One thing to show."""

    @property
    def subject(self) -> Subject:
        """What it is of."""

    def figure(self) -> Figure:
        """Return its picture."""

    def records(self) -> Records:
        """Return all its numbers."""

    def extract(self, rows: int) -> Records:
        """Return its numbers, at most about so many rows of them."""

    def summary(self) -> tuple[str, str, str]:
        """Return its size, its range and that of its values, in words."""

    def against(self, other: Content) -> Content:
        """Return what the other one has more than this one; NotComparableError if they are not alike."""


def spread(count: int, wanted: int) -> list[int]:
    """Return numbers of rows evenly spread, the first and the last among them; all if ``wanted`` is 0."""
    if wanted <= 0 or count <= wanted:
        return list(range(count))
    wanted = max(wanted, 2)
    return [round(index * (count - 1) / (wanted - 1)) for index in range(wanted)]


def span(values: Sequence[float], unit: str) -> str:
    """Return the range of some values in words."""
    return f"{min(values):g} … {max(values):g} {unit}" if len(values) else "none"
