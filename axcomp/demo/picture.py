"""The demonstration's picture: one panel for each kind of compensation or volumetric trial, and one for all of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..engine import Array
from ..model import Machine
from ..plot import save
from .evaluation import Outcome, motion_of
from .trials import TCP, VOLUMETRIC, Cycles, Stage, Trial, name_of

WITHOUT, WITH = "#d1602b", "#1f6fa8"
LEGEND = ((WITHOUT, "without compensation"), (WITH, "with compensation"))
WIDTH, DPI = 12.0, 100
"""Inches and dots an inch: 1200 pixels."""


def draw(path: Path, machine: Machine, results: Sequence[Outcome], cycle_time: float) -> None:
    """Write the picture as PNG, 1200 pixels wide."""
    stage = Stage(machine, cycle_time)
    shown = {kind: _telling(stage, results, kind) for kind in PANELS}
    panels = {kind: outcome for kind, outcome in shown.items() if outcome is not None}
    volumes = {id(result.trial): result.trial for result in results if result.trial.kind == VOLUMETRIC}
    count = len(panels) + len(volumes) + 1
    columns = 2 if count in (2, 4) else min(3, count)
    rows = -(-count // columns)
    figure = Figure(figsize=(WIDTH, 0.6 + 4.0 * rows), dpi=DPI, layout="constrained")
    FigureCanvasAgg(figure)
    free = iter(figure.subplots(rows, columns, squeeze=False).flat)
    for kind, outcome in panels.items():
        PANELS[kind](next(free), stage, outcome)
    for trial in volumes.values():
        _volume(next(free), [result for result in results if result.trial is trial])
    for ax in figure.axes[: count - 1]:
        ax.grid(alpha=0.3)
    _summary(next(free), results)
    for ax in free:
        ax.set_axis_off()
    lines = [Line2D([], [], color=color, marker="o", label=label) for color, label in LEGEND]
    figure.legend(handles=lines, loc="outside upper center", ncols=len(lines), frameon=False, fontsize=12)
    save(figure, path)


def _telling(stage: Stage, results: Sequence[Outcome], kind: str) -> Outcome | None:
    """Return the outcome of a kind that shows most: of a bilateral leadscrew, else the largest error."""
    axes = {name_of(axis): axis for axis in stage.machine.axes}

    def rank(result: Outcome) -> tuple[bool, float]:
        leadscrew = axes[result.axis].leadscrew
        bilateral = kind == "leadscrew" and leadscrew is not None and leadscrew.negative is not None
        return bilateral, result.largest[0]

    return max((result for result in results if result.trial.kind == kind), key=rank, default=None)


def _curves(ax: Axes, x: Array, result: Outcome, style: str = "-") -> None:
    _pair(ax, x, result.without, result.compensated, style)
    ax.set_ylabel(f"error of {result.axis} [{result.unit}]")


def _pair(ax: Axes, x: Array, without: Array, compensated: Array, style: str) -> None:
    for values, color in ((without, WITHOUT), (compensated, WITH)):
        ax.plot(x, values, style, color=color, ms=4, lw=1.5)


def _position(result: Outcome, axis: str) -> Array:
    return result.trial.setpoints[axis].position[result.cycles]


def _leadscrew(ax: Axes, stage: Stage, result: Outcome) -> None:  # noqa: ARG001
    unit = "mm" if result.unit == "µm" else "°"
    _curves(ax, _position(result, result.axis), result, "o-")
    ax.set_xlabel(f"position of {result.axis} [{unit}]")
    ax.set_title(f"Leadscrew: {result.axis} forth and back")


def _cross(ax: Axes, stage: Stage, result: Outcome) -> None:
    cross = stage.axis(result.axis).cross
    assert cross is not None
    master = stage.names[cross.master]
    _curves(ax, _position(result, master), result, "o-")
    ax.set_xlabel(f"position of {master} [mm]")
    ax.set_title(f"Cross: sag of {result.axis} over {master}")


def _plane(ax: Axes, stage: Stage, result: Outcome) -> None:
    """Draw the error as a height over lines of the plane."""
    plane = stage.axis(result.axis).plane
    assert plane is not None
    first, second = stage.names[plane.master1], stage.names[plane.master2]
    across, lines = _position(result, first), _position(result, second)
    levels = np.unique(lines)
    scale = 0.8 * float(np.min(np.diff(levels))) / result.largest[0]
    for level in levels:
        row = np.flatnonzero(lines == level)
        row = row[np.argsort(across[row])]
        ax.axhline(level, color="0.6", lw=0.7)
        heights = [level + scale * errors[row] for errors in (result.without, result.compensated)]
        _pair(ax, across[row], heights[0], heights[1], "o-")
    bar = 10.0 ** np.floor(np.log10(result.largest[0]))
    right, top = across.max() + 0.12 * np.ptp(across), float(levels[-1])
    ax.plot([right, right], [top, top + scale * bar], color="0.2", lw=3, solid_capstyle="butt")
    ax.annotate(f"{bar:g} {result.unit}", (right, top), (0, -4), textcoords="offset points", ha="center", va="top")
    ax.set_xlabel(f"position of {first} [mm]")
    ax.set_ylabel(f"position of {second} [mm], error of {result.axis} as height")
    ax.set_title(f"Plane: {result.axis} over {first} and {second}")


def _crosstalk(ax: Axes, stage: Stage, result: Outcome) -> None:
    crosstalk = stage.axis(result.axis).crosstalk
    assert crosstalk is not None
    time: Array = stage.cycle_time * result.cycles.astype(np.float64)
    time[1:][np.diff(result.cycles) > 1] = np.nan  # no line across the cycles that do not count
    _curves(ax, time, result)
    ax.set_xlabel("time [s]")
    ax.set_title(f"Crosstalk: {result.axis} while {stage.names[crosstalk.master]} changes speed")


def _friction(ax: Axes, stage: Stage, result: Outcome) -> None:
    velocity = result.trial.setpoints[result.axis].velocity[result.cycles]
    reversal = int(np.flatnonzero(velocity[:-1] * velocity[1:] <= 0.0)[0])
    first, last = max(0, reversal - 30), reversal + 90
    near = replace(result, without=result.without[first:last], compensated=result.compensated[first:last])
    _curves(ax, (result.cycles[first:last] - result.cycles[reversal]) * stage.cycle_time * 1e3, near)
    ax.set_xlabel("time after the setpoint's reversal [ms]")
    ax.set_title(f"Friction: {result.axis} reverses on a circle")


def _volume(ax: Axes, results: Sequence[Outcome]) -> None:
    """Draw the components of the error of the tool tip."""
    x, label = _way(results[0].trial, results[0].cycles)
    styles = dict(zip((f"{TCP} {k}" for k in "xyz"), ("o-", "s--", "^:"), strict=True))
    for result in results:
        if result.axis in styles:
            _pair(ax, x, result.without, result.compensated, styles[result.axis])
    lines = [Line2D([], [], color="0.3", marker=s[0], ls=s[1:], ms=4, label=name) for name, s in styles.items()]
    ax.legend(handles=lines, fontsize=9, ncols=len(lines), loc="best")
    ax.margins(y=0.2)
    ax.set_xlabel(label)
    ax.set_ylabel("error of the tool tip [µm]")
    ax.set_title(f"Volumetric: {motion_of(results[0].trial)}")


def _way(trial: Trial, cycles: Cycles) -> tuple[Array, str]:
    """Return how far the axes have moved, and what to call it."""
    positions = np.array([trial.setpoints[name].position[cycles] for name in trial.moving])
    if len(positions) == 1:
        return positions[0], f"position of {trial.moving[0]} [°]"
    return np.linalg.norm(positions.T - positions[:, 0], axis=1), f"way along {', '.join(trial.moving)} [mm]"


def _summary(ax: Axes, results: Sequence[Outcome]) -> None:
    for line, result in enumerate(results):
        without, compensated = result.largest
        ax.plot([compensated, without], [line, line], color="0.75", lw=2, zorder=1)
        ax.scatter([without, compensated], [line, line], color=[WITHOUT, WITH], s=36, zorder=2)
        if result.beyond > 0.0:
            ax.plot(result.beyond, line, "k|", ms=14, mew=1.6, zorder=3)
        text = f"{100.0 * result.ratio:.1f} %"
        ax.annotate(text, (without, line), (7, 0), textcoords="offset points", va="center", fontsize=9)
    ax.set_xscale("log")
    ax.margins(x=0.24)
    shorts = [motion_of(result.trial) if result.trial.kind == VOLUMETRIC else result.trial.kind for result in results]
    ax.set_yticks(range(len(results)), [f"{r.axis} {short}" for r, short in zip(results, shorts, strict=True)])
    ax.invert_yaxis()
    ax.set_xlabel(f"largest error [{' or '.join(sorted({result.unit for result in results}))}]")
    ax.grid(axis="x", alpha=0.3)
    more = "\n(|: no table removes)" if any(result.beyond for result in results) else ""
    ax.set_title(f"Largest errors, and what is left{more}")


PANELS: dict[str, Callable[[Axes, Stage, Outcome], None]] = {
    "leadscrew": _leadscrew,
    "cross": _cross,
    "plane": _plane,
    "crosstalk": _crosstalk,
    "friction": _friction,
}
