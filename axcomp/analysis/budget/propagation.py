"""From the uncertainty of errors to that of the tool tip, by Monte Carlo through the machine's model (JCGM 101).

In every trial each error is off by a normally distributed amount; the model says by how much the tool tip is off then,
in the directions of X, Y and Z, at each point of the path. The amounts are a Latin hypercube, so that few trials do.
Beside it stands the law of propagation of JCGM 100, from the derivatives of the model: the two agree where the model is
linear enough.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.special import ndtri

from ...engine import Array
from ...fit import hats
from ...kinds import tables_of
from ...model import ERRORS, LETTERS, AxisType, shown
from .contributions import Budget, Poses
from .uncertainty import Uncertainty

TRIALS = 500
PLACES = 40
"""Points of the path to which uncertainties are carried: they change slowly."""
COVERAGE = 0.95
MICRO = shown("mm").factor


@dataclass(frozen=True, eq=False)
class TcpUncertainty:
    """How well the position of the tool tip is known.

    Attributes
    ----------
    time : array, shape (n,)
        s, of the points.
    axes : tuple of str
        Names of the axes in whose directions it is given: X, Y and Z of the volumetric compensations, or the
        translatory axes of a machine without any.
    standard : array, shape (n, axes)
        Standard uncertainty, µm, by Monte Carlo.
    linear : array, shape (n, axes)
        The same by the law of propagation.
    radius : array, shape (n,)
        Within this distance, µm, the tool tip is with 95 % probability.
    sources : mapping of str to array, shape (n, axes)
        What each uncertainty contributes on its own, µm, by the derivatives of the model.
    trials : int
    """

    time: Array
    axes: tuple[str, ...]
    standard: Array
    linear: Array
    radius: Array
    sources: Mapping[str, Array]
    trials: int

    def plot(self, ax: Any = None) -> Any:
        """Draw it along the path; return the Matplotlib axes."""
        from .picture import plot_uncertainty

        return plot_uncertainty(self, ax)

    def to_dict(self) -> dict[str, object]:
        """Return all figures for JSON."""
        return {
            "unit": "µm",
            "trials": self.trials,
            "time": self.time.tolist(),
            "axes": {
                name: {"standard": self.standard[:, d].tolist(), "linear propagation": self.linear[:, d].tolist()}
                for d, name in enumerate(self.axes)
            },
            "radius 95 %": self.radius.tolist(),
            "sources": {
                label: {name: float(values[:, d].max()) for d, name in enumerate(self.axes)}
                for label, values in self.sources.items()
            },
        }


def tcp_uncertainty(
    budget: Budget, uncertainties: Sequence[Uncertainty], *, trials: int = TRIALS, places: int = PLACES, seed: int = 1
) -> TcpUncertainty:
    """Carry uncertainties, independent of each other, to the tool tip along the path of a budget.

    ``trials`` are at least 2, ``places`` are so many of the budget's points, evenly spread. The same ``seed`` gives the
    same result.
    """
    if trials < 2 or places < 1:
        raise ValueError("there must be at least 2 trials and 1 place")
    random = np.random.default_rng(seed)
    axes = _axes(budget)
    chosen = np.unique(np.linspace(0, len(budget.points) - 1, min(places, len(budget.points))).round().astype(np.int64))
    off = np.zeros((trials, len(chosen), len(axes)))
    sources: dict[str, Array] = {}

    def add(label: str, columns: list[int], values: Array) -> None:
        # An error may be uncertain as a whole and at its nodes.
        source = sources.setdefault(label, np.zeros(off.shape[1:]))
        source[:, columns] = np.hypot(source[:, columns], values)

    for one in budget.poses:
        mine = [u for u in uncertainties if u.compensation == one.volumetric.index]
        if mine:
            here = replace(
                one, poses=one.poses[chosen], tool_lengths=one.tool_lengths[chosen], errors=one.errors[chosen]
            )
            columns = [axes.index(name) for name in one.names]
            off[:, :, columns] += _trials(here, mine, trials, random)
            for u in mine:
                add(u.label, columns, _effects(here, u))
    for u in (u for u in uncertainties if u.compensation < 0):
        name = u.parameter.rpartition(".")[0]
        if name not in axes:
            raise ValueError(f"{u.parameter}: axis {name} does not move the tool tip in any volumetric compensation")
        weights = MICRO * u.value * _weights_of_table(budget, u, chosen)
        off[:, :, axes.index(name)] += _normal(random, trials, weights.shape[1]) @ weights.T
        add(u.label, [axes.index(name)], np.linalg.norm(weights, axis=1)[:, np.newaxis])
    linear = np.sqrt(sum((np.square(values) for values in sources.values()), np.zeros(off.shape[1:])))
    radius = np.quantile(np.linalg.norm(off, axis=2), COVERAGE, axis=0)
    # The errors themselves are the mean that is meant, so all trials are free.
    standard = np.sqrt(np.mean(np.square(off), axis=0))
    return TcpUncertainty(budget.time[budget.points[chosen]], axes, standard, linear, radius, sources, trials)


def _axes(budget: Budget) -> tuple[str, ...]:
    if budget.poses:
        return tuple(dict.fromkeys(name for one in budget.poses for name in one.names))
    return tuple(axis.name for axis in budget.machine.axes if axis.type is AxisType.TRANSLATORY)


def _trials(one: Poses, uncertainties: Sequence[Uncertainty], trials: int, random: np.random.Generator) -> Array:
    """Return by how much the tool tip is off in each trial, (trials, poses, 3), µm."""
    changed = np.broadcast_to(one.errors, (trials, *one.errors.shape)).copy()
    for u in uncertainties:
        weights = _weights_of_error(one, u)
        changed[:, :, ERRORS.index(u.parameter)] += u.value * _normal(random, trials, weights.shape[1]) @ weights.T
    known = one.model.corrections(one.poses, one.tool_lengths, one.errors)
    every = one.model.corrections(
        np.tile(one.poses, (trials, 1)), np.tile(one.tool_lengths, trials), changed.reshape(-1, len(ERRORS))
    )
    result: Array = -MICRO * (every.reshape(trials, *known.shape) - known)
    return result


def _effects(one: Poses, uncertainty: Uncertainty) -> Array:
    """Return the standard uncertainties that an error leads to by the derivatives of the model, (poses, 3), µm."""
    column = [ERRORS.index(uncertainty.parameter)]
    slopes = one.model.derivatives(one.poses, one.tool_lengths, one.errors, column, corrections=True)[:, :, 0]
    sizes = uncertainty.value * np.linalg.norm(_weights_of_error(one, uncertainty), axis=1)
    result: Array = MICRO * np.abs(slopes) * sizes[:, np.newaxis]
    return result


def _normal(random: np.random.Generator, trials: int, count: int) -> Array:
    """Return standard normal numbers (trials, count) by Latin hypercube: each column has one in each of its strata."""
    strata = random.permuted(np.tile(np.arange(trials), (count, 1)), axis=1).T
    result: Array = ndtri((strata + random.uniform(1e-9, 1.0, (trials, count))) / trials)
    return result


def _weights_of_error(one: Poses, uncertainty: Uncertainty) -> Array:
    """Return the share of each independent error in the one at each pose, (poses, errors)."""
    if not uncertainty.nodes:
        return np.ones((len(one.poses), 1))
    table = next(table for table in one.volumetric.errors if table.name == uncertainty.parameter)
    at = one.poses[:, LETTERS.index(table.arguments)]
    knots = np.unique(table.positions(table.arguments))
    if knots[0] == 0.0 and knots[-1] == 360.0:
        # 0° and 360° are the same position, measured once.
        weights = hats(knots, np.mod(at, 360.0))
        weights[:, 0] += weights[:, -1]
        return weights[:, :-1]
    return hats(knots, at)


def _weights_of_table(budget: Budget, uncertainty: Uncertainty, chosen: Any) -> Array:
    """Return the share of each independent error of an axis compensation in the correction at each point."""
    if not uncertainty.nodes:
        return np.ones((len(chosen), 1))
    name, _, kind = uncertainty.parameter.rpartition(".")
    [tables] = tables_of(budget.machine, name, kind)
    curve = tables.curves[0]
    return hats(np.array(curve.x), budget.setpoints[curve.over.axis][budget.points[chosen]])
