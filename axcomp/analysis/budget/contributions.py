"""The contributions to the corrections of every axis along a path.

Axis compensations: what the engine adds to the setpoint, cycle by cycle. Volumetric errors: the correction of X, Y and
Z that each of the 72 alone would lead to, all others zero, at some points of the path. The model is all but linear, so
these add up to the correction of all errors together, up to products of errors: both sums are compared.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...engine import Array, Columns, Engine, InputFile, Result, TcpModel, completed
from ...interface import with_causality
from ...kinds import KINDS
from ...model import ERRORS, LETTERS, LINEAR, Machine, Tabular, Tabulated, Volumetric, shown

POINTS = 200
"""Points of the path at which volumetric errors are evaluated, if nothing else is asked for."""

VOLUMETRIC = "volumetric"

Indices = npt.NDArray[np.int64]
Flags = npt.NDArray[np.bool_]


def largest(values: Array) -> float:
    """Return the largest size."""
    return float(np.max(np.abs(values)))


def rms(values: Array) -> float:
    """Return the root of the mean square."""
    return float(np.sqrt(np.mean(np.square(values))))


@dataclass(frozen=True, eq=False)
class Contribution:
    """What one source (``leadscrew``, or ``volumetric[0] EXX``) adds to the setpoint of the axis of a name.

    ``values``, shape (n,), are in µm or ″, at the ``cycles`` of the path for which there is one.
    """

    axis: str
    source: str
    cycles: Indices
    values: Array

    @property
    def max(self) -> float:
        """Largest size along the path."""
        return largest(self.values)

    @property
    def rms(self) -> float:
        """Root of the mean square along the path."""
        return rms(self.values)

    def at(self, cycle: int) -> float:
        """Return the value at a cycle that is among ``cycles``."""
        return float(self.values[np.searchsorted(self.cycles, cycle)])


@dataclass(frozen=True, eq=False)
class Poses:
    """Where the path is evaluated for one volumetric compensation.

    Attributes
    ----------
    names : tuple of str
        Names of its X, Y and Z.
    poses : array, shape (n, 6)
        For the model.
    tool_lengths : array, shape (n,)
        mm.
    errors : array, shape (n, 72)
        mm and rad.
    """

    volumetric: Volumetric
    model: TcpModel
    names: tuple[str, ...]
    poses: Array
    tool_lengths: Array
    errors: Array


@dataclass(frozen=True, eq=False)
class Budget(Tabular, Mapping[str, Array]):
    """The contributions of a machine along a path.

    Attributes
    ----------
    machine : Machine
    time : array, shape (cycles,)
        s.
    points : array of int, shape (n,)
        Cycles at which volumetric errors were evaluated.
    contributions : tuple of Contribution
        Axis by axis; those that are zero everywhere are left out.
    totals, setpoints : mapping of str to array, shape (cycles,)
        The correction of each axis, from the engine, µm or ″, and its setpoint, mm or °.
    joint : mapping of str to array, shape (n,)
        By linear axis, at the points: the correction of all volumetric errors together.
    currents : mapping of str to array, shape (cycles,)
        Of the friction compensation, by axis, in the drive's own unit.
    settled : array of bool, shape (n,)
        Points at which each volumetric compensation is fully on or off; else what the engine adds is on its way.
    poses : tuple of Poses
        Of the volumetric compensations.
    """

    machine: Machine
    time: Array
    points: Indices
    contributions: tuple[Contribution, ...]
    totals: Mapping[str, Array]
    setpoints: Mapping[str, Array]
    joint: Mapping[str, Array]
    currents: Mapping[str, Array]
    settled: Flags
    poses: tuple[Poses, ...] = ()

    def __getitem__(self, axis: str) -> Array:
        """Return the correction of an axis, shape (cycles,), µm or ″."""
        return self.totals[axis]

    def __iter__(self) -> Iterator[str]:
        return iter(self.totals)

    def __len__(self) -> int:
        return len(self.totals)

    def tabulated(self) -> Tabulated:
        """Return correction and contributions of every axis at the points."""
        columns = {f"{axis}.correction": total[self.points] for axis, total in self.totals.items()}
        for one in self.contributions:
            columns[f"{one.axis}.{one.source}"] = one.values[np.searchsorted(one.cycles, self.points)]
        units = {name: self.units[name.partition(".")[0]] for name in columns}
        return Tabulated("time", self.time[self.points], columns, {"time": "s", **units})

    @property
    def units(self) -> dict[str, str]:
        """Unit of the contributions to each axis."""
        return {axis.name: shown(axis.unit).unit for axis in self.machine.axes}

    def of_axis(self, axis: str) -> tuple[Contribution, ...]:
        """Return the contributions to one axis, the largest first."""
        return tuple(sorted((c for c in self.contributions if c.axis == axis), key=lambda c: -c.max))

    def worst(self, axis: str) -> int:
        """Return the cycle, among the settled points, at which the correction of an axis is largest."""
        sizes = np.abs(self.totals[axis][self.points])
        return int(self.points[np.argmax(np.where(self.settled, sizes, -1.0))])

    def _sum(self, axis: str, only: str = "") -> Array:
        """Return the sum of an axis' contributions at the points, of those whose source begins with ``only``."""
        total = np.zeros(len(self.points))
        for one in self.contributions:
            if one.axis == axis and one.source.startswith(only):
                total += one.values[np.searchsorted(one.cycles, self.points)]
        return total

    def gap_to_joint(self, axis: str) -> float:
        """Return the largest difference between the volumetric contributions' sum and their joint correction."""
        return largest(self._sum(axis, VOLUMETRIC) - self.joint[axis]) if axis in self.joint else 0.0

    def gap_to_engine(self, axis: str) -> float:
        """Return the largest difference between the sum of all contributions and the engine's total.

        At the settled points; more than products of errors are in it where factors below 1 are commanded.
        """
        gaps = np.abs(self._sum(axis) - self.totals[axis][self.points])
        return float(np.max(gaps, where=self.settled, initial=0.0))

    def plot(self, ax: Any = None, axis: str | None = None) -> Any:
        """Draw the waterfall of one axis where its correction is largest; return the Matplotlib axes."""
        from .picture import plot_waterfall

        return plot_waterfall(self, axis or next(iter(self.totals)), ax)

    def to_dict(self) -> dict[str, object]:
        """Return all figures for JSON."""
        axes = {
            axis: {
                "unit": self.units[axis],
                "largest correction": largest(self.totals[axis]),
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
        currents = {axis: {"max": largest(one), "rms": rms(one)} for axis, one in self.currents.items()}
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
        At how many of its cycles volumetric errors are evaluated, evenly spread; at least 2.
    cycle_time : float
        Of the position controller, s.
    tool_length : float or None
        mm; None: what the path says, else 0.

    Raises
    ------
    KeyError
        For a column of the path that is no input of the machine.
    ValueError
        If three linear axes become dependent on the path.
    """
    engine = Engine(machine, cycle_time)
    machine = engine.machine
    columns = path.sampled(cycle_time)
    if tool_length is not None:
        columns["tool_length"] = np.full(len(next(iter(columns.values()))), tool_length)
    if not machine.volumetric:
        columns.pop("tool_length", None)
    columns = completed(columns, {v.name for v in with_causality(engine.variables, "input")}, cycle_time, engine.modulo)
    result = engine.run(columns)
    at = np.unique(np.linspace(0, result.cycles - 1, min(max(points, 2), result.cycles)).round().astype(np.int64))
    found: list[Contribution] = []
    totals, currents, setpoints = {}, {}, {}
    for index, axis in enumerate(machine.axes):
        factor = shown(axis.unit).factor
        names = {v.quantity: v.name for v in engine.variables if v.axis == index}
        totals[axis.name] = factor * result[names["correction"]]
        setpoints[axis.name] = columns.get(names["setpoint"], np.zeros(result.cycles))
        for kind in KINDS:
            name = names.get(f"{kind}.correction")
            if name is not None and result[name].any():
                found.append(Contribution(axis.name, kind, np.arange(result.cycles), factor * result[name]))
        if axis.friction is not None:
            currents[axis.name] = result[names["current"]]
    lengths = columns.get("tool_length", np.zeros(result.cycles))[at]
    poses = tuple(_poses(machine, one, setpoints, lengths, at) for one in machine.volumetric)
    joint = {name: np.zeros(len(at)) for one in poses for name in one.names}
    settled = np.ones(len(at), dtype=bool)
    for one in poses:
        on, still = _activity(one.volumetric, columns, result)
        settled &= still[at]
        alone, together = _of_errors(one, at, on[at])
        found += alone
        for name, values in zip(one.names, together.T, strict=True):
            joint[name] += values
    return Budget(machine, result.time, at, tuple(found), totals, setpoints, joint, currents, settled, poses)


def _poses(
    machine: Machine, volumetric: Volumetric, setpoints: Mapping[str, Array], tool_lengths: Array, at: Indices
) -> Poses:
    names = {letter: machine.numbered(number).name for letter, number in volumetric.axes}
    positions = np.zeros((len(at), len(LETTERS)))
    for letter, name in names.items():
        positions[:, LETTERS.index(letter)] = setpoints[name][at]
    model = TcpModel(volumetric)
    poses = model.places(positions)
    linear = tuple(names.get(letter, "") for letter in LINEAR)
    return Poses(volumetric, model, linear, poses, tool_lengths, model.known_errors(poses))


def _activity(volumetric: Volumetric, columns: Columns, result: Result) -> tuple[Flags, Flags]:
    """Return in which cycles a compensation is on, and in which it is so fully or not at all."""
    name = f"{VOLUMETRIC}[{volumetric.index}]"
    on = np.asarray(result[f"{name}.active"], dtype=bool)
    cycles = np.arange(len(on))
    switched = np.flatnonzero(np.diff(on, prepend=on[:1]))
    last = np.concatenate([[-np.inf], switched])[np.searchsorted(switched, cycles, side="right")]
    off = np.asarray(columns.get(f"{name}.switch", np.where(on, 0.0, -1.0))) < 0.0
    return on, ~on | ((cycles - last > volumetric.filter_steps) & ~off)


def _of_errors(one: Poses, at: Indices, on: Flags) -> tuple[list[Contribution], Array]:
    """Return what each error alone contributes where the compensation is on, and all together, (n, 3)."""
    name = f"{VOLUMETRIC}[{one.volumetric.index}]"
    signs = np.array([*map(one.volumetric.sign, LINEAR)]) * on[:, np.newaxis]

    def corrections(errors: Array) -> Array:
        return shown("mm").factor * signs * one.model.corrections(one.poses, one.tool_lengths, errors)

    together = corrections(one.errors)
    if np.isnan(together).any():
        raise ValueError(f"{name}: X, Y and Z are dependent at a place of the path")
    found = []
    for error in np.flatnonzero(one.errors.any(axis=0)):
        alone = np.zeros_like(one.errors)
        alone[:, error] = one.errors[:, error]
        for axis, values in zip(one.names, corrections(alone).T, strict=True):
            if values.any():
                found.append(Contribution(axis, f"{name} {ERRORS[error]}", at, values))
    return found, together
