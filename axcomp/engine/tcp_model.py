"""The error model of a machine over many places at once: its errors there, and what they do to the tool tip.

The formulas are those of the kernel (``kernel.volumetric_model``), written for arrays; a test compares both. Errors
that are interpolated otherwise than linearly over one axis, and corrections, are the kernel's own, place by place.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..kernel import correction_at, correction_with, errors_at, zeros
from ..model import ERRORS, LETTERS, LINEAR, Interpolation, Volumetric, turn_of
from ..runtime import error_model
from .motion import Array

_STEP = 1e-4
"""mm and rad by which errors are changed to see what they do; the model is all but linear in them."""
_TWELVE = len(ERRORS) // len(LETTERS)


class TcpModel:
    """A machine with a volumetric compensation whose errors can be given.

    ``volumetric`` has its chain, centres, directions, offsets and so on, and the errors that are known.
    """

    def __init__(self, volumetric: Volumetric) -> None:
        self._pool, self._table = error_model(volumetric)
        # Axes without known errors get some here.
        self._table.exact[:] = [False] * len(LETTERS)
        self._volumetric = volumetric
        self._directions = np.array(self._table.direction).reshape(len(LETTERS), 3)
        self.centers = np.array(self._table.center).reshape(3, 3)

    def places(self, positions: Array) -> Array:
        """Return where the axes are for the model, (n, 6): with the offsets of the machine."""
        result: Array = positions + np.array(self._table.offset)
        return result

    def errors_and_deviations(self, positions: Array, tool_length: float = 0.0) -> tuple[Array, Array]:
        """Return the known errors, (n, 72), and what they do to the tool tip, (n, 3), at positions (n, 6)."""
        places = self.places(positions)
        errors = self.known_errors(places)
        return errors, self.deviations(places, np.full(len(places), tool_length), errors)

    def known_errors(self, places: Array) -> Array:
        """Return the 72 errors that are known at places, (n, 72), mm and rad."""
        found = np.zeros((len(places), len(ERRORS)))
        tables = self._volumetric.errors
        if any(len(one.arguments) > 1 or one.interpolation is not Interpolation.GRID for one in tables):
            for row, place in zip(found, places.tolist(), strict=True):
                errors = zeros(len(ERRORS))
                errors_at(self._pool, self._table, place, [0] * len(ERRORS), errors)
                row[:] = errors
            return found
        for one in tables:
            column = found[:, ERRORS.index(one.name)]
            if not one.arguments:
                column[:] = one.values[0]
                continue
            at = places[:, LETTERS.index(one.arguments)]
            nodes = np.array([node[0] for node in one.nodes])
            turn = None if one.arguments in LINEAR else turn_of(float(nodes[0]), float(nodes[-1]), None)
            if turn is not None:
                at = turn[0] + np.mod(at - turn[0], turn[1])
            column[:] = np.interp(at, nodes, one.values)
        return found

    def nominal(self, places: Array, tool_lengths: Array) -> Array:
        """Return the tool tip on the workpiece without errors, (n, 3), mm."""
        return self.tips(places, tool_lengths, np.zeros((1, len(ERRORS))))

    def tips(self, places: Array, tool_lengths: Array, errors: Array) -> Array:
        """Return the tool tip on the workpiece, (n, 3), mm, with errors (n, 72)."""
        tip = self._flange(tool_lengths)
        for letter, side in self._inwards():
            tip = self._carried(letter, side, places[:, letter], _of_axis(errors, letter), tip)
        return tip

    def deviations(self, places: Array, tool_lengths: Array, errors: Array) -> Array:
        """Return actual − nominal tool tip on the workpiece, (n, 3), mm, with errors (n, 72)."""
        return self.tips(places, tool_lengths, errors) - self.nominal(places, tool_lengths)

    def corrections(self, places: Array, tool_lengths: Array, errors: Array | None = None) -> Array:
        """Return what X, Y and Z must move so that the tool tip is where it should be, (n, 3), mm.

        ``errors`` (n, 72) are those at the places; without them the known ones count where the axes are moved to.
        Whether the lists negate a correction or leave it out is not in it. nan where the position is singular.
        """
        found = np.full((len(places), len(LINEAR)), np.nan)
        given = [None] * len(places) if errors is None else errors.tolist()
        for row, place, length, wrong in zip(found, places.tolist(), tool_lengths.tolist(), given, strict=True):
            correction = zeros(len(LINEAR))
            if wrong is None:
                usable = correction_at(self._pool, self._table, place, length, [0] * len(ERRORS), correction)
            else:
                usable = correction_with(self._table, place, length, wrong, correction)
            if usable:
                row[:] = correction
        return found

    def derivatives(
        self, places: Array, tool_lengths: Array, errors: Array, which: Sequence[int], *, corrections: bool = False
    ) -> Array:
        """Return what each of some errors does to the tool tip or the corrections, (n, 3, errors), mm per mm or rad."""
        found = np.empty((len(places), len(LINEAR), len(which)))
        if corrections:
            for column, error in enumerate(which):
                sides = []
                for step in (_STEP, -_STEP):
                    changed = errors.copy()
                    changed[:, error] += step
                    sides.append(self.corrections(places, tool_lengths, changed))
                found[:, :, column] = (sides[0] - sides[1]) / (2.0 * _STEP)
            return found
        # An error changes the map of its own axis only: those nearer to the tool give the point that is mapped, those
        # nearer to the workpiece turn the change.
        tips = [self._flange(tool_lengths)]
        axes = list(self._inwards())
        for letter, side in axes:
            tips.append(self._carried(letter, side, places[:, letter], _of_axis(errors, letter), tips[-1]))
        outer = np.broadcast_to(np.eye(3), (len(places), 3, 3))
        for (letter, side), tip in zip(reversed(axes), reversed(tips[:-1]), strict=True):
            at, own = places[:, letter], _of_axis(errors, letter)
            for column, error in enumerate(which):
                if error // _TWELVE == letter:
                    change = np.zeros(_TWELVE)
                    change[error % _TWELVE] = _STEP
                    ahead, behind = (self._carried(letter, side, at, own + sign * change, tip) for sign in (1.0, -1.0))
                    found[:, :, column] = np.einsum("nij,nj->ni", outer, (ahead - behind) / (2.0 * _STEP))
            outer = outer @ self._turns(letter, side, at, own)
        return found

    def center_derivatives(self, places: Array, tool_lengths: Array, errors: Array, letter: str) -> Array:
        """Return what moving the centre of a rotary axis does to the tool tip, (n, 3, 3), mm per mm."""
        found = np.empty((len(places), 3, 3))
        row = self.centers[LETTERS.index(letter) - len(LINEAR)]
        for d in range(3):
            sides = []
            for step in (0.5, -0.5):
                row[d] += step
                sides.append(self.tips(places, tool_lengths, errors))
                row[d] -= step
            found[:, :, d] = sides[0] - sides[1]
        return found

    def _flange(self, tool_lengths: Array) -> Array:
        return np.asarray(
            np.array(self._table.tool_position) + np.outer(tool_lengths, np.array(self._table.tool_orientation))
        )

    def _inwards(self) -> Iterator[tuple[int, float]]:
        """Yield each axis from the tool to the workpiece, and −1 for those that carry the workpiece."""
        for place in reversed(range(self._table.chain_length)):
            yield self._table.chain[place], -1.0 if place < self._table.workpiece_axes else 1.0

    def _carried(self, letter: int, side: float, at: Array, errors: Array, points: Array) -> Array:
        """Map points by an axis, or back if it carries the workpiece; ``errors``: its twelve, (n, 12)."""
        turn, shift = self._map(letter, at, errors)
        if side > 0.0:
            return np.asarray(np.einsum("nij,nj->ni", turn, points) + shift)
        return np.asarray(np.einsum("nji,nj->ni", turn, points - shift))

    def _turns(self, letter: int, side: float, at: Array, errors: Array) -> Array:
        turn, _ = self._map(letter, at, errors)
        return turn if side > 0.0 else np.swapaxes(turn, 1, 2)

    def _map(self, letter: int, at: Array, errors: Array) -> tuple[Array, Array]:
        """Return turns (n, 3, 3) and shifts (n, 3) of an axis: x ↦ turn · x + shift."""
        direction = self._directions[letter]
        where, tilt, shift, turn = (errors[..., k : k + 3] for k in (0, 3, 6, 9))
        if letter < len(LINEAR):
            along = _rotations(tilt) @ direction
            return _rotations(turn), along * at[:, None] + where + shift
        center = self.centers[letter - len(LINEAR)]
        if self._table.alternative:
            held = _rotations(tilt)
            own = _turned(held @ direction, at)
            axis = held @ center + where
            inner, outer, moved = own, _rotations(turn), shift
        else:
            inner, outer, moved = _turned(direction[None, :], at), _rotations(tilt + turn), where + shift
            axis = np.broadcast_to(center, moved.shape)
        stays = axis - np.einsum("nij,nj->ni", inner, np.broadcast_to(axis, (len(inner), 3)))
        return outer @ inner, np.einsum("nij,nj->ni", np.broadcast_to(outer, inner.shape), stays) + moved


def _of_axis(errors: Array, letter: int) -> Array:
    return errors[:, _TWELVE * letter : _TWELVE * (letter + 1)]


def _rotations(angles: Array) -> Array:
    """Return Rz(c)·Ry(b)·Rx(a) for angles (…, 3) in rad, (…, 3, 3)."""
    (sa, sb, sc), (ca, cb, cc) = (np.moveaxis(f(angles), -1, 0) for f in (np.sin, np.cos))
    rows = (
        (cb * cc, sa * sb * cc - ca * sc, ca * sb * cc + sa * sc),
        (cb * sc, sa * sb * sc + ca * cc, ca * sb * sc - sa * cc),
        (-sb, sa * cb, ca * cb),
    )
    return np.stack([np.stack(row, -1) for row in rows], -2)


def _turned(axes: Array, degrees: Array) -> Array:
    """Return rotations about unit vectors (1 or n, 3), (n, 3, 3)."""
    angle = np.radians(np.mod(degrees, 360.0))[:, None, None]
    x, y, z = np.moveaxis(axes, -1, 0)
    nothing = np.zeros_like(x)
    rows = ((nothing, -z, y), (z, nothing, -x), (-y, x, nothing))
    cross = np.stack([np.stack(row, -1) for row in rows], -2)
    outer = axes[:, :, None] * axes[:, None, :]
    return np.asarray(np.cos(angle) * np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * outer)
