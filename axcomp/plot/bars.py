"""Single values by name, such as the constant errors of a machine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from matplotlib.figure import Figure

from ..model import Quantity
from .content import Content, Records, span
from .style import DOWN, UP, labelled, new_figure, printed

ROWS_OF_PICTURE = 14
"""Bars that an ordinary picture has room for."""


@dataclass(frozen=True, eq=False)
class Bars(Content):
    """Values under names.

    Attributes
    ----------
    quantity : Quantity
        Of the values.
    values : mapping of str to float
        In the order they are shown.
    """

    quantity: Quantity
    values: Mapping[str, float]

    def figure(self) -> Figure:
        """Return a bar for each value."""
        figure = new_figure(max(0.6, len(self.values) / ROWS_OF_PICTURE))
        ax = labelled(figure.add_subplot(), self.title, str(self.quantity), "")
        values = list(self.values.values())
        drawn = ax.barh(list(self.values), values, color=[UP if value >= 0.0 else DOWN for value in values], height=0.6)
        ax.bar_label(drawn, [printed(f"{value:.4g}") for value in values], padding=4, fontsize=10)
        ax.axvline(0.0, color="0.3", lw=0.8)
        ax.invert_yaxis()
        ax.set_axisbelow(True)
        ax.margins(x=0.15)
        return figure

    def records(self) -> Records:
        """Return names and values."""
        return Records(("error", str(self.quantity)), list(self.values.items()))

    def summary(self) -> tuple[str, str, str]:
        """Return how many there are, their names, and their range."""
        values = [round(value, 4) for value in self.values.values()]
        return str(len(values)), " ".join(self.values), span(values, self.quantity.unit)

    def against(self, other: Content) -> Bars:
        """Return other − this one; what one of them lacks is 0."""
        if not isinstance(other, Bars) or self.quantity != other.quantity:
            self.not_comparable("the two tables are of different quantities")
        names = dict.fromkeys((*self.values, *other.values))
        values = {name: other.values.get(name, 0.0) - self.values.get(name, 0.0) for name in names}
        return Bars(self.subject, self.quantity.changed(), values, note="other − this one")
