"""Friction compensations from pairs of velocity and motor current or torque, or from traces."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..kinds import Friction
from ..measurement import RUN, AxisTrace, Column, Readings, joined
from ..plot import DOWN, UP, labelled
from .creation import CannotCreateError, Report
from .driver import MAX_POINTS, NEW_LIST, TRACE, Fit, bound
from .levels import Levels, levels_of
from .reversal_trace import ReversalSettings, reversals_of
from .steady import Steady, steady_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

VELOCITIES = {
    "mm/s": 1.0,
    "um/s": 1e-3,
    "m/s": 1e3,
    "mm/min": 1.0 / 60.0,
    "m/min": 1e3 / 60.0,
    "deg/s": 1.0,
    "rpm": 6.0,
}
"""Units of velocity, in mm/s or °/s."""

UNIT = "drive unit"
_WHOLE_FROM = 100.0
_BIAS_SHOWN = 0.01
_WITHIN = 5.0


@dataclass(frozen=True, eq=False)
class FrictionReadings(Readings):
    """What the motor needs at constant velocities.

    Attributes
    ----------
    velocities : array, shape (n,)
        With sign, mm/s or °/s.
    currents : array, shape (n,)
        With sign, in the unit the drive takes the additional current in.
    errors : array, shape (n,)
        Standard errors of the currents, NaN where they are not known.
    traces : tuple of (AxisTrace, Steady)
        What they were taken from, if not given themselves.
    """

    velocities: Annotated[Array, Column("velocity", VELOCITIES, "mm/s", aliases=("speed",))]
    currents: Annotated[Array, Column("current", aliases=("torque", "force"))]
    runs: Annotated[npt.NDArray[np.int64], RUN]
    source: str = ""
    errors: Array | None = None
    traces: tuple[tuple[AxisTrace, Steady], ...] = ()

    @classmethod
    def of(cls, trace: AxisTrace) -> FrictionReadings:
        """Return a reading for each stretch of constant velocity; every pass through all velocities is a run."""
        steady = steady_of(trace)
        velocities, currents, errors, _ = (np.array(column) for column in zip(*steady.stretches, strict=True))
        runs = np.ones(len(velocities), dtype=np.int64)
        return cls(velocities, currents, runs, trace.source, errors, ((trace, steady),))


class FrictionFit(Fit[FrictionReadings, tuple[Array, Array]]):
    """The current over the amount of the velocity, the mean of both directions.

    The factor that the list has already (``scaling_factor``) stays, and the table is divided by it.
    """

    name = "friction"
    counted = "velocities"
    meaning = "friction table from motor currents at constant velocities, or from a trace"
    columns = (
        "columns velocity (mm/s), current, and run where there are several; a trace has time (s), setpoint, position "
        "or velocity, and current, named so or by --map"
    )
    example = (
        "axcomp create friction --from currents.csv --into achskw1.lis --bound 20\n"
        '  axcomp create friction --from trace.csv --into achskw1.lis --map "velocity=v[mm/min],current=I,time=t[ms]"'
    )
    arguments: ClassVar = {
        "bound": bound(UNIT, ""),
        "max-points": MAX_POINTS,
        **NEW_LIST,
        **TRACE,
        "bin": {"type": float, "default": _WITHIN, "metavar": "%", "help": "velocities so close count as one (5)"},
        "reversal": {"action": "store_true", "help": "put what a trace says of its reversals into the list, too"},
    }
    read = FrictionReadings.read

    @classmethod
    def load(
        cls, paths: Sequence[Path], given: Mapping[str, Any], read: Callable[[Path], FrictionReadings]
    ) -> FrictionReadings:
        """Read pairs, or traces: files with times, or with columns that are mapped."""
        found = [super(FrictionFit, cls).load([path], given, read) for path in paths]
        if len({one.errors is None for one in found}) > 1:
            raise CannotCreateError("traces and pairs of velocity and current do not go together")
        return replace(joined(found), traces=tuple(trace for one in found for trace in one.traces))

    @classmethod
    def of_trace(cls, trace: AxisTrace) -> FrictionReadings:
        """Return a reading for each stretch of constant velocity."""
        return FrictionReadings.of(trace)

    def counts_in(self) -> str:
        """Return what the axis is known to count in: velocities of either fit."""
        for trace, _ in self.readings.traces:
            if trace.unit == "deg":
                return "deg"
        return self.target.unit or "mm"

    def prepare(self) -> None:
        """Look at the factor of the list, and leave out what stands still."""
        super().prepare()
        self.within = (_WITHIN if self.options.bin is None else self.options.bin) / 100.0
        if not 0.0 <= self.within < 1.0:
            raise CannotCreateError(f"--bin {100.0 * self.within:g}: velocities within 0 to 100 % can count as one")
        self.scaling = self.target.values.converted("frict_comp.scaling_factor")
        if self.scaling == 0.0:
            raise CannotCreateError("frict_comp.scaling_factor of the list is 0: no table has an effect")
        moving = self.readings.velocities != 0.0
        if not moving.any():
            raise CannotCreateError("there is no reading in motion")
        self.standing = int(np.sum(~moving))
        self.readings = self.readings.only(moving)
        self.levels = self._levels(self.readings)
        self.curve = self.levels.curve()
        self.resolution = _resolution(self.readings.currents / self.scaling)
        self.small, self.lost = UNIT, 0.5 * self.resolution * abs(self.scaling)

    def _levels(self, readings: FrictionReadings) -> Levels:
        errors = np.full(len(readings.velocities), np.nan) if readings.errors is None else readings.errors
        return levels_of(readings.velocities, readings.currents, errors, self.within)

    def measured(self, readings: FrictionReadings) -> Array:
        """Return the currents."""
        return readings.currents

    def means(self, readings: FrictionReadings) -> FrictionReadings:
        """Return the current at each level, as it turns as rarely as the readings allow."""
        levels = self._levels(readings)
        return FrictionReadings(levels.speeds, levels.curve(), np.ones(len(levels.speeds), dtype=np.int64))

    def table(self, means: FrictionReadings) -> tuple[Array, Array]:
        """Return speeds, and currents as the list's factor makes them of whole steps."""
        places = self.chosen(means.velocities, means.currents[None, :])
        currents = np.round(means.currents[places] / self.scaling / self.resolution)
        return means.velocities[places], currents * self.resolution * self.scaling

    def removed(self, table: tuple[Array, Array], readings: FrictionReadings) -> Array:
        """Return the current against the direction of motion."""
        direction = np.where(readings.velocities < 0.0, -1.0, 1.0)
        return np.asarray(direction * np.interp(np.abs(readings.velocities), *table))

    def compensation(self, table: tuple[Array, Array]) -> Friction:
        """Return the table divided by the factor."""
        steps = np.round(table[1] / self.scaling / self.resolution)
        made = Friction(tuple(table[0].tolist()), tuple((steps * self.resolution).round(9).tolist()), self.scaling)
        settings = self.reversal() if self.options.reversal else None
        if settings is None:
            return made
        return replace(
            made,
            position_delay=settings.position_delay,
            reversal_lookahead=settings.reversal_lookahead,
            delay_cycles=settings.delay_cycles or 0,
        )

    @property
    def settled(self) -> tuple[str, ...]:
        """What the list is to say besides the table."""
        if self.options.reversal and self.reversal() is None:
            raise CannotCreateError("--reversal needs a trace in which the axis reverses")
        return ("position_delay", "reversal_lookahead", "delay_cycles") if self.options.reversal else ()

    def reversal(self) -> ReversalSettings | None:
        """Return what the reversals of the traces propose, of the one with most of them."""
        offset = np.nan_to_num(self.levels.shares().offset)
        found = [
            reversals_of(trace, self.levels.speeds, self.curve, float(offset), steady.inertia)
            for trace, steady in self.readings.traces
        ]
        return max((one for one in found if one is not None), key=lambda one: one.reversals, default=None)

    def report(self, table: tuple[Array, Array]) -> Report:
        """Say what does not count, and what no table can hold, too."""
        levels, shares = self.levels, self.levels.shares()
        made = super().report(table)
        _, error = levels.friction()
        sentences = [
            f"{len(levels.speeds)} levels of velocity; velocities within {100.0 * self.within:g} % count as one."
        ]
        if np.isfinite(error).any():
            sentences.append(f"Each is known within {2.0 * np.nanmax(error):.3g} {UNIT} (k = 2).")
        for _, steady in self.readings.traces:
            about = "" if np.isnan(steady.inertia_error) else f" ± {2.0 * steady.inertia_error:.2g} (k = 2)"
            sentences.append(
                f"{len(steady.stretches)} stretches of constant velocity; the inertia takes "
                f"{steady.inertia:.4g}{about} {UNIT} per {'mm' if self.unit == 'mm' else '°'}/s²."
            )
        settings = self.reversal()
        if settings is not None:
            late = "" if settings.delay_cycles is None else f", delay_cycles {settings.delay_cycles}"
            sentences.append(
                f"{settings.reversals} reversals propose position_delay {1e4 * settings.position_delay:.0f} (0.1 µm or "
                f"0.0001°), reversal_lookahead {settings.reversal_lookahead}{late}"
                + ("; the list says so now." if self.options.reversal else "; --reversal puts them into the list.")
            )
        standing = f"{self.standing} readings at standstill are left out." if self.standing else ""
        dropped = f"{levels.dropped} readings lie far off the others of their level and do not count." * bool(
            levels.dropped
        )
        notes = [note for trace, steady in self.readings.traces for note in (*trace.notes, *steady.notes)]
        details = {
            "levels": {
                "velocities": levels.speeds.tolist(),
                "positive": _listed(levels.sides[0]),
                "negative": _listed(levels.sides[1]),
                "uncertainty_positive": _listed(2.0 * levels.errors[0]),
                "uncertainty_negative": _listed(2.0 * levels.errors[1]),
                "table": self.curve.tolist(),
            },
            **{name: None if np.isnan(value) else value for name, value in shares._asdict().items()},
            "inertia": [[steady.inertia, 2.0 * steady.inertia_error] for _, steady in self.readings.traces],
            "reversal": None if settings is None else settings._asdict(),
        }
        return Report((*made.sentences, *sentences), made.notes, details=details).noted(
            standing, dropped, *dict.fromkeys(notes), *self._shape()
        )

    def _shape(self) -> tuple[str, ...]:
        """Return what a table that both directions share cannot hold."""
        levels, shares = self.levels, self.levels.shares()
        if not levels.both.any():
            return ("One direction was measured: a weight or a bias of the drive would count as friction.",)
        found, mean = [], float(np.mean(np.abs(self.curve)))
        known = "" if np.isnan(shares.offset_uncertainty) else f" (± {shares.offset_uncertainty:.2g}, 95 %)"
        if abs(shares.offset) > max(_BIAS_SHOWN * mean, np.nan_to_num(shares.offset_uncertainty)):
            found.append(
                f"There is a constant current of {shares.offset:.3g}{known} beside friction, which no friction "
                "table can hold."
            )
        if abs(shares.asymmetry) > max(_BIAS_SHOWN, np.nan_to_num(shares.asymmetry_uncertainty)):
            ratio = (1.0 + shares.asymmetry) / (1.0 - shares.asymmetry)
            found.append(
                f"Friction is {100.0 * shares.asymmetry:+.1f} % (± {100.0 * shares.asymmetry_uncertainty:.1f} %, 95 %) "
                f"off the mean of both directions in the positive one, {ratio:.3f} times that of the negative one; a "
                "table holds the mean."
            )
        both = levels.sides[:, levels.both]
        if found:
            left = float(np.max(np.abs(0.5 * (both[0] - both[1]))))
            found.append(f"Together they leave up to {left:.3g} {UNIT} in either direction.")
        elif shares.asymmetry_uncertainty > 0.5:
            found.append("Friction is too alike at all velocities to tell a constant current from an asymmetry.")
        return tuple(found)

    def draw(self, ax: Axes, table: tuple[Array, Array]) -> None:
        """Draw readings and table over the speed."""
        velocities, levels = self.readings.velocities, self.levels
        ax.plot(
            np.abs(velocities), self.readings.currents * np.sign(velocities), ".", color="0.55", ms=4, label="measured"
        )
        for side, error, color, name in zip(levels.sides, levels.errors, (UP, DOWN), ("↑", "↓"), strict=True):
            spread = 2.0 * np.nan_to_num(error)
            ax.errorbar(levels.speeds, side, spread, fmt="_", color=color, lw=1.0, label=f"{name} ± U (k = 2)")
        between = np.linspace(0.0, table[0][-1], 4000)
        ax.plot(between, np.interp(between, *table), "-", color="#0b62a4", lw=1.4)
        ax.plot(*table, "o", color="#0b62a4", ms=4, label="table × scaling")
        ax.set_xscale("symlog", linthresh=1.0)
        labelled(ax, "", "|velocity| [mm/s or °/s]", f"current [{UNIT}]")
        ax.legend(loc="best", fontsize=10)


FIT = FrictionFit


def _listed(values: Array) -> list[float | None]:
    return [float(value) if np.isfinite(value) else None for value in values]


def _resolution(currents: Array) -> float:
    """Return what currents are rounded to: whole numbers, as the manual has them, unless these are too coarse."""
    largest = float(np.max(np.abs(currents)))
    return 1.0 if largest >= _WHOLE_FROM or largest == 0.0 else 10.0 ** (math.floor(math.log10(largest)) - 2)
