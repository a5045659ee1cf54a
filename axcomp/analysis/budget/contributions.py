"""The contributions to the corrections of every axis along a path.

Axis compensations: what the engine adds to the setpoint, cycle by cycle. Volumetric errors: the correction of X, Y and
Z that each of the 72 alone would lead to, all others zero, at some places of the path. The model is all but linear, so
these add up to the correction of all errors together, up to products of errors: both sums are compared.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...engine.engine import Engine, Result
from ...engine.motion import Array
from ...engine.trajectory import Columns, InputFile, completed
from ...interface.variable import Variable, with_causality
from ...kinds import KINDS
from ...model.machine import Axis, Machine
from ...model.quantity import shown
from ...model.volumetric import ERRORS, LETTERS, LINEAR, Volumetric
from .model import CorrectionModel

POINTS = 200
"""Places along the path at which volumetric errors are evaluated, if nothing else is asked for."""

VOLUMETRIC = "volumetric"

Indices = npt.NDArray[np.int64]
Names = Mapping[tuple[int | None, str], Variable]
"""Variables by the place of their axis and their field."""


@dataclass(frozen=True, eq=False)
class Contribution:
    """What one source adds to the setpoint of one axis.

    Attributes
    ----------
    axis : str
        Name of the axis.
    source : str
        ``leadscrew``, or ``volumetric[0] EXX``.
    cycles : array of int, shape (n,)
        Cycles of the path at which there is a value.
    values : array, shape (n,)
        µm or ″.
    """

    axis: str
    source: str
    cycles: Indices
    values: Array

    @property
    def max(self) -> float:
        """Largest size along the path."""
        return float(np.max(np.abs(self.values)))

    @property
    def rms(self) -> float:
        """Root of the mean square along the path."""
        return float(np.sqrt(np.mean(np.square(self.values))))

    def at(self, cycle: int) -> float:
        """Return the value at a cycle that is among ``cycles``."""
        return float(self.values[np.searchsorted(self.cycles, cycle)])


@dataclass(frozen=True, eq=False)
class Places:
    """Where the path is evaluated for one volumetric compensation.

    Attributes
    ----------
    volumetric : Volumetric
    model : CorrectionModel
    names : tuple of str
        Names of its X, Y and Z.
    places : array, shape (n, 6)
        For the model.
    tool_lengths : array, shape (n,)
        mm.
    errors : array, shape (n, 72)
        mm and rad.
    """

    volumetric: Volumetric
    model: CorrectionModel
    names: tuple[str, ...]
    places: Array
    tool_lengths: Array
    errors: Array


@dataclass(frozen=True, eq=False)
class Budget:
    """The contributions of a machine along a path.

    Attributes
    ----------
    machine : Machine
    time : array, shape (cycles,)
        s.
    points : array of int, shape (n,)
        Cycles at which volumetric errors were evaluated.
    units : mapping of str to str
        Unit of the contributions to each axis.
    contributions : tuple of Contribution
        Axis by axis; those that are zero everywhere are left out.
    totals : mapping of str to array, shape (cycles,)
        The correction of each axis, from the engine.
    volumetric_sum, volumetric_joint : mapping of str to array, shape (n,)
        By linear axis, at the points: the sum of the errors' contributions, and the correction of all errors together.
    currents : mapping of str to (max, rms)
        Of the friction compensation, by axis, in the drive's own unit.
    setpoints : mapping of str to array, shape (cycles,)
        Of each axis, mm or °.
    settled : array of bool, shape (n,)
        Points at which each volumetric compensation is fully on or off; else what the engine adds is on its way.
    places : tuple of Places
        Of the volumetric compensations.
    """

    machine: Machine
    time: Array
    points: Indices
    units: Mapping[str, str]
    contributions: tuple[Contribution, ...]
    totals: Mapping[str, Array]
    volumetric_sum: Mapping[str, Array]
    volumetric_joint: Mapping[str, Array]
    currents: Mapping[str, tuple[float, float]]
    setpoints: Mapping[str, Array]
    settled: npt.NDArray[np.bool_]
    places: tuple[Places, ...] = ()

    def of_axis(self, axis: str) -> tuple[Contribution, ...]:
        """Return the contributions to one axis, the largest first."""
        return tuple(sorted((c for c in self.contributions if c.axis == axis), key=lambda c: -c.max))

    def worst(self, axis: str) -> int:
        """Return the cycle, among the settled points, at which the correction of an axis is largest."""
        sizes = np.abs(self.totals[axis][self.points])
        return int(self.points[np.argmax(np.where(self.settled, sizes, -1.0))])

    def gap_to_joint(self, axis: str) -> float:
        """Return the largest difference between the volumetric contributions' sum and their joint correction."""
        if axis not in self.volumetric_sum:
            return 0.0
        return float(np.max(np.abs(self.volumetric_sum[axis] - self.volumetric_joint[axis])))

    def gap_to_engine(self, axis: str) -> float:
        """Return the largest difference between the sum of all contributions and the engine's total.

        At the settled points; more than products of errors are in it where factors below 1 are commanded.
        """
        total = np.zeros(len(self.points))
        for one in self.contributions:
            if one.axis == axis:
                total += one.values[np.searchsorted(one.cycles, self.points)]
        return float(np.max(np.abs(total - self.totals[axis][self.points]), where=self.settled, initial=0.0))

    def plot(self, ax: Any = None, axis: str | None = None) -> Any:
        """Draw the waterfall of one axis where its correction is largest; return the Matplotlib axes."""
        from .picture import plot_waterfall

        return plot_waterfall(self, axis or next(iter(self.totals)), ax)

    def to_dict(self) -> dict[str, object]:
        """Return all figures for JSON."""
        axes = {
            axis: {
                "unit": self.units[axis],
                "largest correction": float(np.max(np.abs(self.totals[axis]))),
                "largest at": float(self.time[self.worst(axis)]),
                "contributions": [
                    {"source": c.source, "max": c.max, "rms": c.rms, "at largest": c.at(self.worst(axis))}
                    for c in self.of_axis(axis)
                ],
                "sum minus joint volumetric correction": self.gap_to_joint(axis),
                "sum minus engine": self.gap_to_engine(axis),
            }
            for axis in self.totals
        }
        currents = {axis: {"max": largest, "rms": rms} for axis, (largest, rms) in self.currents.items()}
        return {"cycles": len(self.time), "points": len(self.points), "axes": axes, "currents": currents}


def budget_of(
    machine: Machine | str | os.PathLike[str],
    path: InputFile,
    *,
    points: int = POINTS,
    cycle_time: float = 0.001,
    tool_length: float | None = None,
) -> Budget:
    """Return the contributions of a machine along a path.

    Parameters
    ----------
    machine : Machine or path
        As ``Engine`` takes it.
    path : InputFile
        Setpoints, and whatever other inputs there are.
    points : int
        At how many places of it volumetric errors are evaluated, evenly spread; at least 2.
    cycle_time : float
        Of the position controller, s.
    tool_length : float or None
        mm; None: what the path says, else 0.

    Raises
    ------
    KeyError
        For a column of the path that is no input of the machine.
    ValueError
        If three linear axes become dependent at a place of the path.
    """
    engine = Engine(machine, cycle_time)
    machine = engine.machine
    columns = path.sampled(cycle_time)
    if tool_length is not None:
        columns["tool_length"] = np.full(len(next(iter(columns.values()))), tool_length)
    if not machine.volumetric:
        columns.pop("tool_length", None)
    columns = completed(columns, {v.name for v in with_causality(engine.variables, "input")}, cycle_time)
    result = engine.run(columns)
    names: Names = {(v.axis, v.quantity): v for v in engine.variables}
    at = np.unique(np.linspace(0, len(result) - 1, min(max(points, 2), len(result))).round().astype(np.int64))
    found: list[Contribution] = []
    totals, units, currents, setpoints = {}, {}, {}, {}
    for place, axis in enumerate(machine.axes):
        factor, units[axis.name] = shown(axis.unit)
        totals[axis.name] = factor * result[names[place, "correction"].name]
        setpoints[axis.name] = columns.get(names[place, "setpoint"].name, np.zeros(len(result)))
        found += _of_kinds(axis, place, names, result)
        if axis.friction is not None:
            current = result[names[place, "current"].name]
            currents[axis.name] = float(np.max(np.abs(current))), float(np.sqrt(np.mean(current**2)))
    places = tuple(_places(machine, one, columns, names, at) for one in machine.volumetric)
    total = {name: np.zeros(len(at)) for one in places for name in one.names}
    joint = {name: np.zeros(len(at)) for name in total}
    settled = np.ones(len(at), dtype=bool)
    for one in places:
        on, still = _activity(one.volumetric, columns, result)
        settled &= still[at]
        for contribution in _of_errors(one, at, joint, on[at]):
            total[contribution.axis] += contribution.values
            if contribution.values.any():
                found.append(contribution)
    return Budget(
        machine, result.time, at, units, tuple(found), totals, total, joint, currents, setpoints, settled, places
    )


def _of_kinds(axis: Axis, place: int, names: Names, result: Result) -> Iterator[Contribution]:
    """Yield what the axis compensations of one axis contribute."""
    factor, _ = shown(axis.unit)
    for kind in KINDS:
        variable = names.get((place, f"{kind}.correction"))
        if variable is not None and result[variable.name].any():
            yield Contribution(axis.name, kind, np.arange(len(result)), factor * result[variable.name])


def _places(
    machine: Machine,
    volumetric: Volumetric,
    columns: Columns,
    names: Names,
    at: Indices,
) -> Places:
    positions = np.zeros((len(at), len(LETTERS)))
    linear = [""] * len(LINEAR)
    for letter, number in volumetric.axes:
        axis = machine.index_of(number)
        column = columns.get(names[axis, "setpoint"].name)
        if column is not None:
            positions[:, LETTERS.index(letter)] = column[at]
        if letter in LINEAR:
            linear[LINEAR.index(letter)] = machine.axes[axis].name
    model = CorrectionModel(volumetric)
    places = model.places(positions)
    lengths = columns["tool_length"][at] if "tool_length" in columns else np.zeros(len(at))
    return Places(volumetric, model, tuple(linear), places, lengths, model.known_errors(places))


def _activity(
    volumetric: Volumetric, columns: Columns, result: Result
) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
    """Return in which cycles a compensation is on, and in which it is so fully or not at all."""
    name = f"{VOLUMETRIC}[{volumetric.index}]"
    on = np.asarray(result[f"{name}.active"], dtype=bool)
    cycles = np.arange(len(on))
    switched = np.flatnonzero(np.diff(on, prepend=on[:1]))
    last = np.concatenate([[-np.inf], switched])[np.searchsorted(switched, cycles, side="right")]
    wanted = np.asarray(columns.get(f"{name}.enable", on), dtype=bool)
    return on, ~on | ((cycles - last > volumetric.filter_steps) & wanted)


def _of_errors(
    one: Places, at: Indices, joint: Mapping[str, Array], on: npt.NDArray[np.bool_]
) -> Iterator[Contribution]:
    """Yield what each error alone contributes where the compensation is on; add all together to ``joint``."""
    factor, _ = shown("mm")
    signs = np.array([_sign(one.volumetric, letter) for letter in LINEAR]) * on[:, np.newaxis]
    together = factor * signs * one.model.corrections(one.places, one.tool_lengths, one.errors)
    if np.isnan(together).any():
        raise ValueError(f"volumetric[{one.volumetric.index}]: X, Y and Z are dependent at a place of the path")
    for d, name in enumerate(one.names):
        joint[name][:] += together[:, d]
    for place in np.flatnonzero(one.errors.any(axis=0)):
        alone = np.zeros_like(one.errors)
        alone[:, place] = one.errors[:, place]
        values = factor * signs * one.model.corrections(one.places, one.tool_lengths, alone)
        for d, name in enumerate(one.names):
            yield Contribution(name, f"{VOLUMETRIC}[{one.volumetric.index}] {ERRORS[place]}", at, values[:, d])


def _sign(volumetric: Volumetric, letter: str) -> float:
    if letter in volumetric.set_to_zero:
        return 0.0
    return -1.0 if letter in volumetric.negate else 1.0
