"""Before and after on one scale: what changed from one evaluation to another of the same axis."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .columns import MeasurementError
from .iso230 import SYMBOLS, Iso230Result

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class BeforeAfter:
    """Two evaluations of one axis.

    Raises
    ------
    MeasurementError
        They are of different axes, or in different units.
    """

    before: Iso230Result
    after: Iso230Result

    def __post_init__(self) -> None:
        old, new = self.before, self.after
        if (old.unit, old.position_unit) != (new.unit, new.position_unit):
            raise MeasurementError(new.source, 0, f"It is in {new.unit}, {old.source} in {old.unit}.")
        if old.axis and new.axis and old.axis != new.axis:
            raise MeasurementError(new.source, 0, f"It is of axis {new.axis}, {old.source} of {old.axis}.")

    def differences(self) -> list[tuple[str, float, float, float, float]]:
        """Return symbol, before, after, after − before and what is left in % for each figure that both have."""
        rows = []
        for name, old in self.before.parameters().items():
            new = getattr(self.after, name)
            if not (math.isnan(old) or math.isnan(new)):
                left = 100.0 * new / old if old else math.nan
                rows.append((SYMBOLS[name], old, new, new - old, left))
        return rows

    def notes(self) -> tuple[str, ...]:
        """Return what keeps the two from being of the same."""
        old, new = self.before.positions, self.after.positions
        missing = len(set(old.tolist()) ^ set(new.tolist()))
        return (f"{missing} targets were measured in one of the two only.",) if missing else ()

    def figure(self) -> Figure:
        """Draw both, one above the other, over the same positions and on one scale."""
        from ..plot import new_figure

        figure = new_figure(2.0)
        axes = figure.subplots(2, 1, sharex=True, sharey=True)
        for ax, when, result in zip(axes, ("before", "after"), (self.before, self.after), strict=True):
            result.plot(ax)
            ax.set_title(f"{when}: {Path(result.source).name}\n{ax.get_title()}", fontsize=12)
        return figure

    def to_dict(self) -> dict[str, Any]:
        """Return it for JSON."""
        names = ("figure", "before", "after", "difference", "left_percent")
        plain = [[None if v != v else v for v in row] for row in self.differences()]  # noqa: PLR0124
        return {
            "before": self.before.source,
            "after": self.after.source,
            "unit": self.before.unit,
            "differences": [dict(zip(names, row, strict=True)) for row in plain],
            "notes": list(self.notes()),
        }
