"""Linear algebra of identifications: triangles of decompositions, and what parameters do to the tool tip together."""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_triangular

from ..engine import Array
from ..model import shown

MICRO = shown("mm").factor
_BLOCK = 4096


def radius_of(slopes: Array, covariance: Array) -> Array:
    """Return the radius that holds 95 % of what parameters of a covariance do to tips, by slopes (n, 3, k), in µm.

    |v|² of a normal v with covariance S has the mean tr S and the variance 2 tr S²; mean + 2 standard deviations is the
    95 % point within 1 % for one direction as for three alike.
    """
    spread = np.einsum("ndk,kl,nel->nde", slopes, covariance, slopes, optimize=True)
    mean, square = np.einsum("ndd->n", spread), np.einsum("nde,nde->n", spread, spread)
    return np.asarray(MICRO * np.sqrt(np.maximum(mean + 2.0 * np.sqrt(2.0 * square), 0.0)))


def without_rigid(slopes: Array, points: Array) -> Array:
    """Return what parameters do to points (n, 3), (n, 3, k), less the rigid motion of all that is nearest to it."""
    arms = points - points.mean(axis=0)
    motions = np.zeros((len(points), 3, 6))
    motions[:, :, :3] = np.eye(3)
    for k, axis in enumerate(np.eye(3)):
        motions[:, :, 3 + k] = np.cross(axis, arms) / max(float(np.abs(arms).max()), 1.0)
    flat, rigid = slopes.reshape(-1, slopes.shape[2]), motions.reshape(-1, 6)
    return np.asarray((flat - rigid @ np.linalg.lstsq(rigid, flat, rcond=None)[0]).reshape(slopes.shape))


def triangle(columns: Array) -> Array:
    """Return R of columns (m, k), block by block."""
    size = max(_BLOCK, 2 * columns.shape[1])
    if len(columns) <= size:
        return np.asarray(np.linalg.qr(columns, mode="r"), dtype=np.float64)
    parts = [triangle(columns[k : k + size]) for k in range(0, len(columns), size)]
    return np.asarray(np.linalg.qr(np.vstack(parts), mode="r"), dtype=np.float64)


def inverse_of(root: Array) -> Array:
    """Return the inverse of a triangle."""
    return np.asarray(solve_triangular(root, np.eye(len(root))))
