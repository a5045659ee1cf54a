"""A machine of rigid bodies with geometric errors, by homogeneous matrices: it shares nothing with the product."""

from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

from axcomp.fit import TcpDeviations
from axcomp.model import LETTERS, ErrorTable, Volumetric

DEVIATION, POINT, LENGTH, DISPLACEMENT, SPHERE = range(5)
NODES = {"X": np.linspace(0, 600, 7), "Y": np.linspace(0, 500, 6), "Z": np.linspace(-400, 0, 5)}


def matrices(turns, shifts):
    found = np.tile(np.eye(4), (len(shifts), 1, 1))
    found[:, :3, :3] = turns.as_matrix()
    found[:, :3, 3] = shifts
    return found


@dataclass
class TrueMachine:
    """Chain and errors as semantics §10 has them: errors by name, a number or a table over the own axis."""

    chain: str
    workpiece_axes: int
    errors: dict = field(default_factory=dict)
    centers: dict = field(default_factory=dict)
    tool: tuple = (0.0, 0.0, -100.0)

    def error(self, name, at):
        found = self.errors.get(name, 0.0)
        return np.full(len(at), found) if np.isscalar(found) else np.interp(at, *found)

    def tips(self, positions, lengths, errors=True):
        """Return the tool tip on the workpiece, (n, 3); the tool points to −Z."""
        whole = np.tile(np.eye(4), (len(positions), 1, 1))
        scale = 1.0 if errors else 0.0
        for place, letter in enumerate(self.chain):
            k = LETTERS.index(letter)
            at = positions[:, k]
            turn0, turn1 = (
                scale * np.column_stack([self.error(f"{kind.format(r)}{letter}", at) for r in "ABC"])
                for kind in ("{}0", "E{}")
            )
            shift = scale * np.column_stack(
                [self.error(f"{r}0{letter}", at) + self.error(f"E{r}{letter}", at) for r in "XYZ"]
            )
            axis = np.eye(3)[k % 3]
            if k < 3:
                moved = Rotation.from_euler("xyz", turn0).apply(axis) * at[:, None]
                one = matrices(Rotation.from_euler("xyz", turn1), moved + shift)
            else:
                center = np.array(self.centers.get(letter, (0.0, 0.0, 0.0)), dtype=float)
                spin = Rotation.from_rotvec(np.radians(at)[:, None] * axis)
                one = matrices(Rotation.from_euler("xyz", turn0 + turn1), shift)
                one = one @ matrices(spin, center - spin.apply(center))
            whole = whole @ (np.linalg.inv(one) if place < self.workpiece_axes else one)
        tips = np.column_stack([np.tile(self.tool, (len(positions), 1)), np.ones(len(positions))])
        tips[:, 2] -= lengths
        return np.einsum("nij,nj->ni", whole, tips)[:, :3]

    def described(self, **more):
        """Return the kinematics as a list describes them, without errors."""
        axes = tuple((letter, LETTERS.index(letter) + 1) for letter in LETTERS if letter in self.chain)
        given = {"tool_position": self.tool, "tool_orientation": (0.0, 0.0, -1.0)}
        return Volumetric(0, axes, self.chain, self.workpiece_axes, **(given | more))


def drawn(chain, workpiece_axes=0, seed=0, nodes=NODES, **more):
    """Return a machine with the 21 errors of three axes, linear between nodes, some 20 µm and 30 µrad."""
    random, errors = np.random.default_rng(seed), {}
    for letter, at in nodes.items():
        x = (at - at.mean()) / np.ptp(at)
        for kind, size in (*((k, 0.015) for k in "XYZ"), *((k, 2e-5) for k in "ABC")):
            a, b, c = random.normal(size=3)
            errors[f"E{kind}{letter}"] = (at, size * (a * x + b * x**2 + c * np.sin(5.0 * x) / 2.0))
    for name in ("C0Y", "B0Z", "A0Z"):
        errors[name] = 3e-5 * random.normal()
    return TrueMachine(chain, workpiece_axes, errors, **more)


NAMES = [f"E{kind}{letter}" for letter in "XYZ" for kind in LETTERS] + ["C0Y", "B0Z", "A0Z"]


def readings(kind, positions, lengths, stations, measured=None, deviations=None, runs=None):
    n = len(positions)
    values = np.zeros((n, 3)) if measured is None else np.asarray(measured, dtype=float)
    if values.ndim == 1:
        values = np.column_stack([values, np.zeros((n, 2))])
    return TcpDeviations(
        positions,
        lengths,
        np.zeros((n, 3)) if deviations is None else deviations,
        np.ones(n, dtype=int) if runs is None else runs,
        kinds=np.full(n, kind),
        stations=np.asarray(stations),
        measured=values,
    )


def in_volume(count, random, nodes=NODES, at_nodes=True):
    positions = np.zeros((count, 6))
    for k, (letter, at) in enumerate(nodes.items()):
        assert letter == "XYZ"[k]
        positions[:, k] = random.choice(at, count) if at_nodes else random.uniform(at[0], at[-1], count)
    return positions


def less_rigid(off, points):
    """Return differences less the rigid motion that explains most of them: where the workpiece lies is free."""
    arms = points - points.mean(axis=0)
    motions = np.zeros((len(points), 3, 6))
    motions[:, :, :3] = np.eye(3)
    for k, axis in enumerate(np.eye(3)):
        motions[:, :, 3 + k] = np.cross(axis, arms) / 500.0
    flat = motions.reshape(-1, 6)
    return (off.ravel() - flat @ np.linalg.lstsq(flat, off.ravel(), rcond=None)[0]).reshape(-1, 3)


def found_tables(found):
    return tuple(ErrorTable(one.name, one.values, one.arguments, one.nodes) for one in found.tables())
