"""Piecewise linear curves: the last interval, its neighbours, then a guess from the way gone: many points cost few."""

from __future__ import annotations

from dataclasses import dataclass

from .record import Vec, whole

LARGEST = 1e15  # a number beyond this is taken for infinite: sums with it could overflow
SHORTEST_PERIOD = 1e-6  # ° or mm, of what repeats


@dataclass(slots=True)
class Curve:
    """Piecewise linear y(x): ``points`` abscissae and as many ordinates in the pool."""

    points: int
    x: int
    y: int


@dataclass(slots=True)
class Lookup:
    """Where a search ended last time."""

    interval: int


def find_interval(pool: Vec, first: int, points: int, x: float, lookup: Lookup) -> int:
    """Return i with x[i] ≤ x < x[i + 1], for x within the abscissae pool[first …] and points ≥ 2."""
    i = lookup.interval
    if pool[first + i] <= x < pool[first + i + 1]:
        return i
    lookup.interval = search_interval(pool, first, points, x, i)
    return lookup.interval


def search_interval(pool: Vec, first: int, points: int, x: float, last: int) -> int:
    """Return the interval of x, which is not the ``last`` one: a neighbour, or near a guess by the mean interval.

    From a guess that is wrong the search goes out in steps that double, then bisects the last of them: at most
    2 · log2(points) comparisons.
    """
    end = points - 1
    if x >= pool[first + last]:
        if last + 2 >= points or x < pool[first + last + 2]:
            return min(last + 1, end - 1)
    elif last > 0 and x >= pool[first + last - 1]:
        return last - 1
    intervals = (x - pool[first + last]) / (pool[first + end] - pool[first]) * end
    low = last
    if intervals == intervals and -end < intervals < end:  # the first is said for the proof
        low += int(intervals)
    low = min(max(low, 0), end - 1)
    high = low + 1
    step = 1
    if x < pool[first + low]:
        while low > 0 and x < pool[first + low]:  # at most 32 times
            high = low
            low = max(high - step, 0)
            step = min(step + step, end)
    else:
        while high < end and x >= pool[first + high]:  # at most 32 times
            low = high
            high = min(low + step, end)
            step = min(step + step, end)
    while high - low > 1:  # at most 32 times
        middle = (low + high) >> 1
        if x < pool[first + middle]:
            high = middle
        else:
            low = middle
    return min(max(low, 0), end - 1)


def curve_value(pool: Vec, curve: Curve, x: float, lookup: Lookup) -> float:
    """Return y(x): linear between the points, the end values held outside; what is no number counts as the lowest x."""
    i = lookup.interval
    if i + 1 < curve.points and pool[curve.x + i] < x < pool[curve.x + i + 1]:
        return section_value(pool, curve, i, x)
    if not x > pool[curve.x]:
        return pool[curve.y]
    last = curve.points - 1
    if x >= pool[curve.x + last]:
        return pool[curve.y + last]
    i = find_interval(pool, curve.x, curve.points, x, lookup)
    return section_value(pool, curve, i, x)


def section_value(pool: Vec, curve: Curve, i: int, x: float) -> float:
    """Return y(x) on the straight line through points i and i + 1."""
    x0 = pool[curve.x + i]
    y0 = pool[curve.y + i]
    return y0 + (x - x0) / (pool[curve.x + i + 1] - x0) * (pool[curve.y + i + 1] - y0)


def fold(x: float, start: float, length: float) -> float:
    """Return x moved by whole lengths into [start, start + length)."""
    folded = x - length * whole((x - start) / length)
    return folded if folded < start + length else start


def within(x: float, low: float, high: float) -> float:
    """Return x held between two bounds; what is no number is the lower one."""
    if not x >= low:
        return low
    return min(x, high)


def nearest(change: float, length: float) -> float:
    """Return a change moved by whole lengths into [−length/2, length/2): the short way round. Length 0: unchanged."""
    if length > 0.0:
        return change - length * whole(change / length + 0.5)
    return change


def ascending(pool: Vec, first: int, points: int, numbers: int) -> bool:
    """Tell whether so many numbers lie in the pool, ascend strictly and span a finite length."""
    if not range_fits(first, points, numbers):
        return False
    for k in range(points - 1):
        if not pool[first + k] < pool[first + k + 1]:
            return False
    length = pool[first + points - 1] - pool[first]
    return length - length == 0.0  # finite


def range_fits(first: int, count: int, numbers: int) -> bool:
    """Tell whether so many numbers from ``first`` on lie in the pool."""
    return first >= 0 and 0 < count <= numbers and first <= numbers - count


def curve_fits(pool: Vec, curve: Curve, numbers: int) -> bool:
    """Tell whether a curve lies in the pool and its abscissae ascend."""
    return ascending(pool, curve.x, curve.points, numbers) and range_fits(curve.y, curve.points, numbers)


def lookup_fits(lookup: Lookup, points: int) -> bool:
    """Tell whether a search may go on from where it ended, in so many points."""
    return lookup.interval == 0 or 0 < lookup.interval < points - 1


def period_fits(period: float) -> bool:
    """Tell whether positions can repeat after so many mm or °; 0: they do not."""
    return period == 0.0 or SHORTEST_PERIOD <= period < LARGEST


def move_curve(curve: Curve, by: int) -> None:
    """Follow the numbers of a curve to another place in the pool."""
    curve.x += by
    curve.y += by


def forget(lookup: Lookup) -> None:
    """Start the next search from the front: a new table may be shorter."""
    lookup.interval = 0
