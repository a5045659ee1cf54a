"""From the uncertainty of errors to that of the tool tip, by Monte Carlo through the machine's model (JCGM 101).

In every trial each error is off by a normally distributed amount; the model says by how much the tool tip is off then,
in the directions of X, Y and Z, at each place of the path. The amounts are a Latin hypercube, so that few trials do.
Beside it stands the law of propagation of JCGM 100, from the derivatives of the model: the two agree where the model is
linear enough.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import ndtri

from ...engine.motion import Array
from ...fit.hats import hats
from ...kinds import tables_of
from ...model.machine import AxisType
from ...model.quantity import shown
from ...model.volumetric import ERRORS, LETTERS, LINEAR
from .contributions import Budget, Places
from .uncertainty import Uncertainty

TRIALS = 500
PLACES = 40
"""Places of the path to which uncertainties are carried: they change slowly."""
COVERAGE = 0.95
MICRO = shown("mm").factor

_STEP = 1e-4
"""mm or rad by which an error is changed to see what it does."""


@dataclass(frozen=True, eq=False)
class TcpUncertainty:
    """How well the place of the tool tip is known.

    Attributes
    ----------
    time : array, shape (n,)
        s, of the places.
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
    """Carry uncertainties to the tool tip.

    Parameters
    ----------
    budget : Budget
        Of the path.
    uncertainties : sequence of Uncertainty
        Independent of each other.
    trials : int
        At least 2.
    places : int
        How many of the budget's points, evenly spread.
    seed : int
        The same seed gives the same result.
    """
    if trials < 2 or places < 1:
        raise ValueError("there must be at least 2 trials and 1 place")
    random = np.random.default_rng(seed)
    axes = _axes(budget)
    chosen = np.unique(np.linspace(0, len(budget.points) - 1, min(places, len(budget.points))).round().astype(np.int64))
    off = np.zeros((trials, len(chosen), len(axes)))
    sources: dict[str, Array] = {}
    for one in budget.places:
        mine = [u for u in uncertainties if u.compensation == one.volumetric.index]
        if mine:
            columns = [axes.index(name) for name in one.names]
            off[:, :, columns] += _trials(one, mine, chosen, trials, random, sources, columns, len(axes))
    for u in uncertainties:
        if u.compensation < 0:
            name = u.parameter.rpartition(".")[0]
            if name not in axes:
                raise ValueError(
                    f"{u.parameter}: axis {name} does not move the tool tip in any volumetric compensation"
                )
            weights = _weights_of_table(budget, u, chosen)
            values = MICRO * u.value * _normal(random, trials, weights.shape[1]) @ weights.T
            off[:, :, axes.index(name)] += values
            source = np.zeros((len(chosen), len(axes)))
            source[:, axes.index(name)] = MICRO * u.value * np.linalg.norm(weights, axis=1)
            _add(sources, u.label, source)
    linear = np.sqrt(sum((np.square(values) for values in sources.values()), np.zeros(off.shape[1:])))
    radius = np.quantile(np.linalg.norm(off, axis=2), COVERAGE, axis=0)
    # The errors themselves are the mean that is meant, so all trials are free.
    standard = np.sqrt(np.mean(np.square(off), axis=0))
    return TcpUncertainty(budget.time[budget.points[chosen]], axes, standard, linear, radius, sources, trials)


def _axes(budget: Budget) -> tuple[str, ...]:
    if budget.places:
        return tuple(dict.fromkeys(name for one in budget.places for name in one.names))
    return tuple(axis.name for axis in budget.machine.axes if axis.type is AxisType.TRANSLATORY)


def _trials(
    one: Places,
    uncertainties: Sequence[Uncertainty],
    chosen: Any,
    trials: int,
    random: np.random.Generator,
    sources: dict[str, Array],
    columns: Sequence[int],
    axes: int,
) -> Array:
    """Return by how much the tool tip is off in each trial, (trials, places, 3), µm; add what each source does."""
    places, lengths, errors = one.places[chosen], one.tool_lengths[chosen], one.errors[chosen]
    known = one.model.corrections(places, lengths, errors)
    changed = np.broadcast_to(errors, (trials, *errors.shape)).copy()
    for u in uncertainties:
        column = ERRORS.index(u.parameter)
        weights = _weights_of_error(one, u, places)
        changed[:, :, column] += u.value * _normal(random, trials, weights.shape[1]) @ weights.T
        sides = []
        for step in (_STEP, -_STEP):
            moved = errors.copy()
            moved[:, column] += step
            sides.append(one.model.corrections(places, lengths, moved))
        slope = (sides[0] - sides[1]) / (2.0 * _STEP)
        source = np.zeros((len(chosen), axes))
        source[:, list(columns)] = MICRO * np.abs(slope) * (u.value * np.linalg.norm(weights, axis=1))[:, np.newaxis]
        _add(sources, u.label, source)
    every = one.model.corrections(
        np.tile(places, (trials, 1)), np.tile(lengths, trials), changed.reshape(-1, len(ERRORS))
    )
    result: Array = -MICRO * (every.reshape(trials, len(chosen), len(LINEAR)) - known)
    return result


def _normal(random: np.random.Generator, trials: int, count: int) -> Array:
    """Return standard normal numbers (trials, count) by Latin hypercube: each column has one in each of its strata."""
    strata = random.permuted(np.tile(np.arange(trials), (count, 1)), axis=1).T
    result: Array = ndtri((strata + random.uniform(1e-9, 1.0, (trials, count))) / trials)
    return result


def _add(sources: dict[str, Array], label: str, source: Array) -> None:
    """Add what a source does; an error may be uncertain as a whole and at its nodes."""
    sources[label] = np.hypot(sources.get(label, np.zeros_like(source)), source)


def _weights_of_error(one: Places, uncertainty: Uncertainty, places: Array) -> Array:
    """Return the share of each independent error in the one at each place, (places, errors)."""
    if not uncertainty.nodes:
        return np.ones((len(places), 1))
    table = next(table for table in one.volumetric.errors if table.name == uncertainty.parameter)
    at = places[:, LETTERS.index(table.arguments)]
    knots = np.unique([node[0] for node in table.nodes])
    if knots[0] == 0.0 and knots[-1] == 360.0:
        # 0° and 360° are the same place, measured once.
        weights = hats(knots, np.mod(at, 360.0))
        weights[:, 0] += weights[:, -1]
        return weights[:, :-1]
    return hats(knots, at)


def _weights_of_table(budget: Budget, uncertainty: Uncertainty, chosen: Any) -> Array:
    """Return the share of each independent error of an axis compensation in the correction at each place."""
    count = len(chosen)
    if not uncertainty.nodes:
        return np.ones((count, 1))
    name, _, kind = uncertainty.parameter.rpartition(".")
    [tables] = tables_of(budget.machine, name, kind)
    curve = tables.curves[0]
    return hats(np.array(curve.x), budget.setpoints[curve.over.axis][budget.points[chosen]])
