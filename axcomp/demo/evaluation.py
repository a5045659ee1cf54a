"""From positions to errors: what a trial has shown without and with the compensation."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..engine import Array
from ..model import Machine, shown
from .trials import TCP, VOLUMETRIC, Cycles, Trial, name_of

BEFORE, AFTER = 10, 120
"""Cycles around a reversal of the setpoint in which the quadrant peak is looked for."""


class Trace(NamedTuple):
    """What a simulation shows of each axis, by its name, at the end of each cycle, shape (cycles,); mm or °.

    ``beyond``: the part of true − measured position that no table holds. ``tip_error``: of the tool tip as the
    workpiece sees it, shape (cycles, 3), mm, or (cycles, 0) if it is not known.
    """

    true_position: Mapping[str, Array]
    following_error: Mapping[str, Array]
    beyond: Mapping[str, Array]
    tip_error: Array

    @classmethod
    def of(cls, axes: Sequence[str], recorded: Array) -> Trace:
        """Return what ``coupling.couple`` has recorded, for axes of these names."""
        *columns, tip = np.split(recorded, [n * len(axes) for n in (1, 2, 3)], axis=1)
        half = tip.shape[1] // 2
        true, lag, beyond = (dict(zip(axes, column.T, strict=True)) for column in columns)
        return cls(true, lag, beyond, tip[:, :half] - tip[:, half:])


@dataclass(frozen=True)
class Outcome:
    """The error of one axis, or of the tool tip, in one trial, in µm or ″ (``unit``).

    ``axis``: its name; ``TCP x`` … for the tool tip, ``TCP`` for how far it is off. ``without`` and ``compensated``:
    tool error, true position − target, at the ``cycles`` that count. ``following_error``: the largest in these, with
    compensation. ``beyond``: what no table can take off, 0 of a plant without memory: of geometric errors the largest
    part of them that depends on neither position nor acceleration at the moment, of friction the peak that the same
    table leaves with the parameters that serve best.
    """

    trial: Trial
    axis: str
    unit: str
    cycles: Cycles
    without: Array
    compensated: Array
    following_error: float
    beyond: float = 0.0

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


def outcomes(machine: Machine, trials: Sequence[Trial], traces: Sequence[tuple[Trace, Trace]]) -> Iterator[Outcome]:
    """Yield the error of each axis in each trial; ``traces``: without and with compensation."""
    units = {name_of(axis): shown(axis.unit) for axis in machine.axes}
    linear = [name_of(axis) for axis in machine.axes if axis.unit == "mm"]
    for trial, (without, compensated) in zip(trials, traces, strict=True):
        if trial.kind == VOLUMETRIC:
            yield from _of_tip(trial, without, compensated, linear)
            continue
        for axis, cycles in trial.watched.items():
            target, (factor, unit) = trial.target(axis), units[axis]
            errors = [factor * (trace.true_position[axis] - target)[cycles] for trace in (without, compensated)]
            following = factor * float(np.max(np.abs(compensated.following_error[axis][cycles])))
            beyond = factor * float(np.max(np.abs(compensated.beyond[axis][cycles])))
            yield Outcome(trial, axis, unit, cycles, errors[0], errors[1], following, beyond)


def _of_tip(trial: Trial, without: Trace, compensated: Trace, linear: Sequence[str]) -> Iterator[Outcome]:
    cycles = trial.watched[TCP]
    factor, unit = shown("mm")
    errors = [factor * trace.tip_error[cycles] for trace in (without, compensated)]
    following = factor * max(float(np.max(np.abs(compensated.following_error[name][cycles]))) for name in linear)
    for column, k in enumerate("xyz"):
        yield Outcome(trial, f"{TCP} {k}", unit, cycles, errors[0][:, column], errors[1][:, column], following)
    distances = [np.linalg.norm(error, axis=1) for error in errors]
    yield Outcome(trial, TCP, unit, cycles, distances[0], distances[1], following)


def table(results: Sequence[Outcome], remembering: bool = False) -> str:
    """Return the errors as a table for the terminal; of a plant that remembers, with what no table can remove."""
    rows: list[tuple[str, ...]] = [("axis", "compensation", "without", "with", "", "left", "following error")]
    rows[0] += ("no table removes",) * remembering
    for result in results:
        figures = [f"{figure:.2f}" for figure in (*result.largest, result.following_error)]
        left = f"{100.0 * result.ratio:.1f} %"
        beyond = (f"{result.beyond:.2f}",) * remembering
        rows.append((result.axis, label(result.trial), *figures[:2], result.unit, left, figures[2], *beyond))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    layout = "  ".join(f"{{:{side}{width}}}" for side, width in zip("<<>><>>>", widths, strict=False))
    lines = [layout.format(*row).rstrip() for row in rows]
    lines.insert(1, "-" * max(map(len, lines)))
    return "\n".join(lines)


def label(trial: Trial) -> str:
    """Return what a trial is called in the table."""
    notes = {"all": "diagonal", "friction": "peaks"}
    note = motion_of(trial) if trial.kind == VOLUMETRIC else notes.get(trial.kind)
    return f"{trial.kind} ({note})" if note else trial.kind


def motion_of(trial: Trial) -> str:
    """Return what a volumetric trial does."""
    if len(trial.moving) > 1:
        return "diagonal"
    (name,) = trial.moving
    travel = np.ptp(trial.setpoints[name].position)
    return f"{'turn' if travel > 300.0 else 'swing'} of {name}"
