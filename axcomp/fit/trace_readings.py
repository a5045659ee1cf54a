"""Readings taken from traces: deviations at targets in either direction, and deviations while a master accelerates."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from ..engine import Array
from ..measurement import AxisTrace, MeasurementError, Positioning
from ..model import shown
from .hat_functions import hats
from .steady import SLIDING, spans_of

TARGETS = 11
"""Over the way that both directions share."""
ACCELERATING = 0.2
"""Share of the largest acceleration from which a stretch counts."""
ALIKE = 0.08
"""Share of the largest acceleration by which it may change within ``SHORTEST`` s."""
SHORTEST = 0.02
"""Of a stretch of constant acceleration, s."""
QUIET = 0.02
"""Share of the largest acceleration up to which nothing deflects."""
APART = 5.0
"""Distance of places that are not the same, mm."""


def deviation_of(trace: AxisTrace) -> tuple[Array, bool]:
    """Return actual − commanded, mm or °, and whether following errors are in it."""
    columns = trace.columns
    if "deviation" in columns:
        return columns["deviation"], not trace.has("position")
    if "actual" in columns:
        for name, follows in (("position", False), ("setpoint", True)):
            if name in columns:
                return columns["actual"] - columns[name], follows
    sentence = (
        "There is no deviation: it takes a column deviation, or actual (second encoder) and position or setpoint."
    )
    raise MeasurementError(trace.source, 0, sentence)


def positioning_of(trace: AxisTrace) -> tuple[Positioning, tuple[str, ...]]:
    """Return what the passes to and fro read at targets, and what there is to say; MeasurementError if they do not."""
    deviation, follows = deviation_of(trace)
    way, velocity = trace.travelled(), trace.velocity()
    direction, settled = _directions(way)
    up, down = way[settled & (direction > 0)], way[settled & (direction < 0)]
    if not (len(up) and len(down)):
        raise MeasurementError(
            trace.source, 0, f"The axis does not go more than {SLIDING:g} mm or ° in both directions."
        )
    low, high = max(up.min(), down.min()), min(up.max(), down.max())
    if high <= low:
        raise MeasurementError(trace.source, 0, "Both directions share no way.")
    notes = list(trace.notes)
    if follows:
        deviation, note = _without_lag(deviation, way, velocity, direction, settled)
        notes += note
    step = (high - low) / TARGETS
    targets = np.round(low + step * (np.arange(TARGETS) + 0.5), 4)
    passes = np.cumsum(np.diff(direction, prepend=direction[0]) != 0)
    rows = []
    counts = {1: 0, -1: 0}
    for number in np.unique(passes):
        here = (passes == number) & settled
        if not here.any():
            continue
        sign = int(direction[here][0])
        counts[sign] += 1
        for target in targets:
            near = here & (np.abs(way - target) <= 0.5 * step)
            away = way[near] - target
            if np.sum(near) >= 3 and away.min() <= 0.0 <= away.max():
                # A line through what is near: the mean would be off where readings lie to one side.
                slope = np.polyfit(away, deviation[near], 1) if np.ptp(away) > 0.1 * step else [deviation[near].mean()]
                rows.append((float(target), counts[sign], sign, shown(trace.unit).factor * float(slope[-1])))
    if len({row[2] for row in rows}) < 2:
        raise MeasurementError(trace.source, 0, "Both directions share no way.")
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    runs, signs = columns[1].astype(np.int64), columns[2].astype(np.int64)
    return Positioning(columns[0], runs, signs, columns[3], trace.unit, source=trace.source), tuple(notes)


def _directions(way: Array) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.bool_]]:
    """Return in which direction the axis moved last, and whether it has gone ``SLIDING`` since it turned."""
    direction, settled = np.zeros(len(way), dtype=np.int64), np.zeros(len(way), dtype=bool)
    sign, turn = 0, float(way[0])
    for k, position in enumerate(way.tolist()):
        # The turning point moves along with the axis; it has turned once it came back by some of the way.
        if sign * (position - turn) > 0.0:
            turn = position
        elif abs(position - turn) > SLIDING:
            sign, turn = (1 if position > turn else -1), position
        direction[k] = sign
        settled[k] = sign != 0 and abs(position - turn) < 0.02 * SLIDING
    return direction, settled


def _without_lag(
    deviation: Array, way: Array, velocity: Array, direction: npt.NDArray[np.int64], settled: npt.NDArray[np.bool_]
) -> tuple[Array, list[str]]:
    """Return deviations against the setpoint less what is proportional to the velocity."""
    speed = np.abs(velocity[settled])
    if np.quantile(speed, 0.95) < 1.5 * np.quantile(speed, 0.05) + 1e-3:
        note = "Deviations are against the setpoint at one speed: a following error would count as backlash."
        return deviation, [note]
    nodes = np.linspace(way[settled].min(), way[settled].max(), 2 * TARGETS)
    matrix = np.column_stack([hats(nodes, way), direction, velocity])[settled]
    solution = np.linalg.lstsq(matrix, deviation[settled], rcond=None)[0]
    late = float(-solution[-1])
    note = f"Deviations are against the setpoint: {1e3 * late:.2f} ms times the velocity are taken for following error."
    return deviation - solution[-1] * velocity, [note]


def accelerations_of(trace: AxisTrace) -> list[tuple[float, int, float, float, float]]:
    """Return acceleration, direction, deviation (µm) against quiet motion, position1 and position2 of each stretch."""
    deviation, _ = deviation_of(trace)
    acceleration, velocity = trace.acceleration("master_"), trace.velocity("master_")
    largest = float(np.quantile(np.abs(acceleration), 0.999))
    if not largest > 0.0:
        raise MeasurementError(trace.source, 0, "The master never accelerates.")
    window = max(3, round(SHORTEST / trace.cycle))
    spread = maximum_filter1d(acceleration, window) - minimum_filter1d(acceleration, window)
    steady = (spread <= ALIKE * largest) & (np.abs(acceleration) >= ACCELERATING * largest)
    quiet = maximum_filter1d(np.abs(acceleration), window) <= QUIET * largest
    if not quiet.any():
        raise MeasurementError(trace.source, 0, "The master never stands or moves evenly: nothing to compare with.")
    at = np.flatnonzero(quiet)
    found = []
    places = [trace.columns.get(f"position{n}", np.zeros(len(deviation))) for n in (1, 2)]
    for first, last in spans_of(steady):
        begin = first + (last - first) // 3
        if last - begin < 3:
            continue
        middle = (begin + last) // 2
        here = np.searchsorted(at, middle)
        before, after = at[max(0, here - window) : here], at[here : here + window]
        around = [float(np.median(deviation[some])) for some in (before, after) if len(some)]
        moved = float(np.median(deviation[begin:last])) - float(np.mean(around))
        direction = 1 if np.median(velocity[begin:last]) > 0.0 else -1
        where = [float(np.mean(place[begin:last])) for place in places]
        found.append(
            (float(np.median(acceleration[begin:last])), direction, shown("mm").factor * moved, where[0], where[1])
        )
    if not found:
        sentence = f"There is no stretch of {SHORTEST:g} s with a constant acceleration."
        raise MeasurementError(trace.source, 0, sentence)
    return found


def same_places(places: Array) -> Array:
    """Return places, shape (n,), those that lie within ``APART`` of each other as their mean, in 0.1 mm."""
    order = np.argsort(places)
    groups = np.cumsum(np.diff(places[order], prepend=places[order[0]]) > APART)
    means = np.bincount(groups, places[order]) / np.bincount(groups)
    result = np.empty_like(places)
    result[order] = np.round(means[groups], 1)
    return result
