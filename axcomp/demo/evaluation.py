"""From positions to errors: what a trial has shown without and with the compensation."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..engine.motion import Array
from ..model.machine import Machine
from ..model.quantity import shown
from .trials import TCP, VOLUMETRIC, Cycles, Trial, name_of

BEFORE, AFTER = 10, 120
"""Cycles around a reversal of the setpoint in which the quadrant peak is looked for."""


@dataclass(frozen=True)
class Record:
    """What a run has recorded of each axis, by its name, at the end of each cycle, shape (cycles,); mm or °.

    ``tip_error``: of the tool tip as the workpiece sees it, shape (cycles, 3), mm.
    """

    true_position: Mapping[str, Array]
    following_error: Mapping[str, Array]
    tip_error: Array


@dataclass(frozen=True)
class Outcome:
    """The error of one axis, or of the tool tip, in one trial, in µm or ″.

    Attributes
    ----------
    trial : Trial
    axis : str
        Its name; ``TCP x`` … for the tool tip, ``TCP`` for how far it is off.
    unit : str
        ``µm`` or ``″``.
    cycles : array of int
        The cycles that count.
    without, compensated : array, shape as cycles
        Tool error: true position − place where the axis should be.
    following_error : float
        Largest in these cycles, with compensation.
    """

    trial: Trial
    axis: str
    unit: str
    cycles: Cycles
    without: Array
    compensated: Array
    following_error: float

    @property
    def largest(self) -> tuple[float, float]:
        """Largest error without and with compensation; of friction: the highest peak above what surrounds it."""
        if self.trial.kind == "friction":
            return self._peak(self.without), self._peak(self.compensated)
        return float(np.max(np.abs(self.without))), float(np.max(np.abs(self.compensated)))

    @property
    def ratio(self) -> float:
        """Error with ÷ error without compensation."""
        without, compensated = self.largest
        return compensated / without if without else 0.0

    def _peak(self, error: Array) -> float:
        velocity = self.trial.setpoints[self.axis].velocity
        reversals = np.flatnonzero(velocity[:-1] * velocity[1:] <= 0.0)
        peaks = []
        for reversal in reversals:
            near = error[(self.cycles >= reversal - BEFORE) & (self.cycles <= reversal + AFTER)]
            if len(near) > BEFORE + AFTER:
                peaks.append(np.max(np.abs(near - np.linspace(near[0], near[-1], len(near)))))
        return float(max(peaks, default=0.0))


def outcomes(machine: Machine, trials: Sequence[Trial], records: Sequence[tuple[Record, Record]]) -> Iterator[Outcome]:
    """Yield the error of each axis in each trial; ``records``: of the runs without and with compensation."""
    units = {name_of(axis): shown(axis.unit) for axis in machine.axes}
    for trial, (without, compensated) in zip(trials, records, strict=True):
        if trial.kind == VOLUMETRIC:
            yield from _of_tip(
                trial, without, compensated, [name_of(axis) for axis in machine.axes if axis.unit == "mm"]
            )
            continue
        for axis, cycles in trial.watched.items():
            place, (factor, unit) = trial.place(axis), units[axis]
            errors = [factor * (record.true_position[axis] - place)[cycles] for record in (without, compensated)]
            following = factor * float(np.max(np.abs(compensated.following_error[axis][cycles])))
            yield Outcome(trial, axis, unit, cycles, errors[0], errors[1], following)


def _of_tip(trial: Trial, without: Record, compensated: Record, linear: Sequence[str]) -> Iterator[Outcome]:
    cycles = trial.watched[TCP]
    factor, unit = shown("mm")
    errors = [factor * record.tip_error[cycles] for record in (without, compensated)]
    following = factor * max(float(np.max(np.abs(compensated.following_error[name][cycles]))) for name in linear)
    for place, k in enumerate("xyz"):
        yield Outcome(trial, f"{TCP} {k}", unit, cycles, errors[0][:, place], errors[1][:, place], following)
    distances = [np.linalg.norm(error, axis=1) for error in errors]
    yield Outcome(trial, TCP, unit, cycles, distances[0], distances[1], following)


def table(results: Sequence[Outcome]) -> str:
    """Return the errors as a table for the terminal."""
    heads = ("axis", "compensation", "without", "with", "", "left", "following error")
    rows = [heads]
    for result in results:
        without, compensated = result.largest
        rows.append(
            (
                result.axis,
                label(result.trial),
                f"{without:.2f}",
                f"{compensated:.2f}",
                result.unit,
                f"{100.0 * result.ratio:.1f} %",
                f"{result.following_error:.2f}",
            )
        )
    widths = [max(len(row[column]) for row in rows) for column in range(len(heads))]
    left = {0, 1, 4}
    lines = []
    for row in rows:
        cells = [c.ljust(w) if n in left else c.rjust(w) for n, (c, w) in enumerate(zip(row, widths, strict=True))]
        lines.append("  ".join(cells).rstrip())
    lines.insert(1, "-" * max(len(line) for line in lines))
    return "\n".join(lines)


def label(trial: Trial) -> str:
    """Return what a trial is called in the table."""
    if trial.kind == VOLUMETRIC:
        return f"volumetric ({motion_of(trial)})"
    return LABELS[trial.kind]


def motion_of(trial: Trial) -> str:
    """Return what a volumetric trial does."""
    if len(trial.moving) > 1:
        return "diagonal"
    (name,) = trial.moving
    travel = np.ptp(trial.setpoints[name].position)
    return f"{'turn' if travel > 300.0 else 'swing'} of {name}"


LABELS = {
    "all": "all (diagonal)",
    "leadscrew": "leadscrew",
    "cross": "cross",
    "plane": "plane",
    "crosstalk": "crosstalk",
    "friction": "friction (peaks)",
}
