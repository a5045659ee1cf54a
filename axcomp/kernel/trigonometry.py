"""Sine and cosine that give the same bits everywhere: the C libraries' own differ in the last place.

The polynomials are the classic minimax ones for |r| ≤ π/4 (error below one unit in the last place); the argument is
reduced by multiples of π/2, taken in three parts.
"""

from __future__ import annotations

from .record import whole

QUARTER_PI = 0.7853981633974483
HALF_PI = 1.5707963267948966
TWO_OVER_PI = 0.6366197723675814
HALF_PI_HEAD = 1.57079632673412561417
HALF_PI_MIDDLE = 6.07710050630396597660e-11
LARGEST_ANGLE = 1e5  # rad; beyond it the reduction is not exact, and far beyond the turns are no int
HALF_PI_TAIL = 2.02226624879595063154e-21


def sine_polynomial(r: float) -> float:
    """Return sin r for |r| ≤ π/4."""
    z = r * r
    p = 2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)
    p = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * p)
    return r + z * r * (-1.66666666666666324348e-01 + z * p)


def cosine_polynomial(r: float) -> float:
    """Return cos r for |r| ≤ π/4."""
    z = r * r
    p = -2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11)
    p = 4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * (2.48015872894767294178e-05 + z * p))
    h = 0.5 * z
    w = 1.0 - h
    return w + (((1.0 - w) - h) + z * z * p)


def sine_of_quarter(x: float, quarter: int) -> float:
    """Return sin(x + quarter · π/2) for |x| < 10⁵ rad; of anything else, which no table leads to, some number."""
    turns = 0.0
    if -LARGEST_ANGLE < x < LARGEST_ANGLE:
        turns = whole(x * TWO_OVER_PI + 0.5)
    r = x - turns * HALF_PI_HEAD
    r = r - turns * HALF_PI_MIDDLE
    r = r - turns * HALF_PI_TAIL
    q = (int(turns) + quarter) & 3
    if q == 0:
        return sine_polynomial(r)
    if q == 1:
        return cosine_polynomial(r)
    if q == 2:
        return -sine_polynomial(r)
    return -cosine_polynomial(r)


def sine(x: float) -> float:
    """Return sin x, x in rad, |x| < 10⁵."""
    if -QUARTER_PI < x < QUARTER_PI:
        return sine_polynomial(x)
    return sine_of_quarter(x, 0)


def cosine(x: float) -> float:
    """Return cos x, x in rad, |x| < 10⁵."""
    if -QUARTER_PI < x < QUARTER_PI:
        return cosine_polynomial(x)
    return sine_of_quarter(x, 1)
