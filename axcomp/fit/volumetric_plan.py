"""Where to measure next: of many readings that could be taken those that tell most about the errors together.

The determinant of the information matrix, readings and what machines are like at all (``HELD``), is made as large as it
gets (D-optimal): readings are added one after the other where it grows most, then exchanged one for another while that
makes it larger (Fedorov 1972).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..engine import Array, TcpModel
from ..measurement import joined
from ..model import LETTERS, Volumetric
from .creation import CannotCreateError
from .volumetric_algebra import MICRO, radius_of, without_rigid
from .volumetric_identification import NODES_MAX, Identifier
from .volumetric_readings import DEVIATION, DISPLACEMENT, KINDS, LENGTH, POINT, TcpDeviations

CANDIDATES = 1500
"""Readings among which the best are chosen."""
_PASSES = 3
_GAIN = 1e-3
_FAR = 10.0
"""Standard deviation of what is unknown of a station, mm or mrad: far beyond that of errors, as if nothing were known;
more would leave no figures for the others."""


@dataclass(frozen=True, eq=False)
class Plan:
    """Readings that are proposed.

    Attributes
    ----------
    readings : TcpDeviations
        Where to take them; what they would be on a machine without errors.
    uncertainty, before, random : array, shape (places,)
        Radius around the tip that holds 95 %, all over the volume, µm: with them, with what there is already (nan where
        there is nothing), and with as many at random places.
    exchanged : int
        Readings that were exchanged for better ones.
    """

    readings: TcpDeviations
    uncertainty: Array
    before: Array
    random: Array
    exchanged: int


class _Design:
    """Chosen candidates, each a block of rows, and the inverse of the information that they and others give."""

    def __init__(self, blocks: Array, information: Array) -> None:
        self.blocks = blocks
        self.inverse = _inverse(information)
        self.seen = blocks @ self.inverse

    def gains(self) -> Array:
        """Return the logarithm of the factor by which each candidate would make the determinant larger."""
        spread = np.einsum("nik,njk->nij", self.seen, self.blocks)
        return np.asarray(np.linalg.slogdet(np.eye(spread.shape[1]) + spread)[1])

    def losses(self, chosen: Sequence[int]) -> Array:
        """Return the logarithm of the factor by which it gets smaller without each of the chosen ones."""
        spread = np.einsum("nik,njk->nij", self.seen[chosen], self.blocks[chosen])
        return np.asarray(-np.linalg.slogdet(np.eye(spread.shape[1]) - spread)[1])

    def take(self, place: int, sign: float) -> None:
        """Add a candidate, or with −1 give it back."""
        block = self.blocks[place]
        carried = block @ self.inverse
        change = np.linalg.solve(sign * np.eye(len(block)) + carried @ block.T, carried)
        self.inverse = self.inverse - carried.T @ change
        self.seen = self.seen - (self.seen @ block.T) @ change


def plan_volumetric(
    volumetric: Volumetric,
    volume: Mapping[str, tuple[float, float]],
    count: int,
    kind: str = "deviation",
    *,
    stations: Sequence[Sequence[float]] = (),
    tool_lengths: Sequence[float] = (0.0,),
    errors: Sequence[str] | None = None,
    nodes: int = NODES_MAX,
    scatter: float = 1.0,
    measured: TcpDeviations | None = None,
    seed: int = 0,
) -> Plan:
    """Propose readings.

    Parameters
    ----------
    volumetric : Volumetric
        The kinematics.
    volume : mapping of str to (float, float)
        From where to where each axis of the chain may go, mm or °.
    count : int
        Readings to propose.
    kind : str
        ``deviation``, ``point``, ``length`` or ``displacement``.
    stations : sequence of three floats
        About where they stand on the workpiece, mm; for all kinds but deviations.
    tool_lengths : sequence of float
        That can be mounted, mm.
    errors, nodes : sequence of str, int
        As for the identification.
    scatter : float
        Standard deviation of a reading, µm.
    measured : TcpDeviations, optional
        What there is already.
    seed : int
        Of the candidates.

    Raises
    ------
    CannotCreateError
        An axis lacks its range, or there are no stations.
    """
    missing = ", ".join(letter for letter in volumetric.chain if letter not in volume)
    if missing:
        raise CannotCreateError(f"where may {missing} go? --volume {missing[0]}=0..500 says it")
    if kind not in KINDS[:4] or (kind != "deviation" and not stations):
        raise CannotCreateError(f"readings of the kind {kind} need the places of their stations (--station X Y Z)")
    if count < 1 or not scatter > 0.0 or nodes < 2:
        raise CannotCreateError("a plan has one reading at least, an error two nodes, and the scatter is above 0")
    random = np.random.default_rng(seed)
    candidates = _candidates(volumetric, volume, KINDS.index(kind), stations, tool_lengths, nodes, random)
    given = 0 if measured is None else len(measured.runs)
    every = candidates if measured is None else joined([measured, candidates])
    identifier = Identifier(every, volumetric, errors, nodes, scatter)
    columns = identifier.columns
    rest = _per_limit(identifier)
    blocks = columns * rest / (scatter / MICRO)
    old, new = blocks[:given].reshape(-1, blocks.shape[2]), blocks[given:]
    if KINDS.index(kind) in (LENGTH, DISPLACEMENT):
        new = new[:, :1]
    prior = np.eye(blocks.shape[2]) + old.T @ old
    chosen, exchanged, design = _chosen(new, prior, min(count, len(new)))
    drawn = new[random.choice(len(new), min(count, len(new)), replace=False)].reshape(-1, blocks.shape[2])
    places, slopes = _over_volume(identifier, volumetric, volume, tool_lengths, random)
    if not (every.kinds == DEVIATION).any():
        slopes = without_rigid(slopes, places[:, :3])
    slopes = slopes * rest[-slopes.shape[2] :]

    def left(inverse: Array) -> Array:
        return radius_of(slopes, inverse[-slopes.shape[2] :, -slopes.shape[2] :])

    return Plan(
        candidates.only(np.isin(np.arange(len(new)), chosen)),
        left(design.inverse),
        left(_inverse(prior)) if given else np.full(len(places), np.nan),
        left(_inverse(prior + drawn.T @ drawn)),
        exchanged,
    )


def _inverse(matrix: Array) -> Array:
    return np.asarray(np.linalg.inv(matrix), dtype=np.float64)


def _per_limit(identifier: Identifier) -> Array:
    """Return the standard deviation of each value without any reading: the unit in which information is counted."""
    limits = identifier.limits
    return np.where(np.isfinite(limits), limits, _FAR)


def _chosen(blocks: Array, prior: Array, count: int) -> tuple[list[int], int, _Design]:
    """Return the places of the best blocks, how many were exchanged, and the design with them."""
    design = _Design(blocks, prior)
    chosen: list[int] = []
    free = np.ones(len(blocks), dtype=bool)
    for _ in range(count):
        best = int(np.argmax(np.where(free, design.gains(), -np.inf)))
        design.take(best, 1.0)
        chosen.append(best)
        free[best] = False
    exchanged = 0
    for _ in range(_PASSES if free.any() else 0):
        before = exchanged
        for place in np.argsort(design.losses(chosen)):
            old = chosen[int(place)]
            design.take(old, -1.0)
            free[old] = True
            gains = np.where(free, design.gains(), -np.inf)
            best = int(np.argmax(gains))
            best = best if gains[best] > gains[old] + _GAIN else old
            exchanged += best != old
            design.take(best, 1.0)
            chosen[int(place)], free[best] = best, False
        if exchanged == before:
            break
    return chosen, exchanged, _Design(blocks, _inverse(design.inverse))


def _candidates(
    volumetric: Volumetric,
    volume: Mapping[str, tuple[float, float]],
    kind: int,
    stations: Sequence[Sequence[float]],
    tool_lengths: Sequence[float],
    nodes: int,
    random: np.random.Generator,
) -> TcpDeviations:
    """Return readings at random nodes of the volume, corners among them, each of one station."""
    positions = np.zeros((CANDIDATES, len(LETTERS)))
    for letter in volumetric.chain:
        first, last = volume[letter]
        at = np.round(np.linspace(first, last, nodes), 3)
        positions[:, LETTERS.index(letter)] = random.choice(at, CANDIDATES)
    tools = random.choice(np.array(tool_lengths, dtype=float), CANDIDATES)
    number = random.integers(0, max(len(stations), 1), CANDIDATES)
    model = TcpModel(volumetric)
    tips = model.nominal(model.places(positions), tools)
    measured = np.zeros((CANDIDATES, 3))
    if kind == POINT:
        measured = tips - np.array(stations, dtype=float)[number]
    elif kind in (LENGTH, DISPLACEMENT):
        measured[:, 0] = np.linalg.norm(tips - np.array(stations, dtype=float)[number], axis=1)
    return TcpDeviations(
        positions,
        tools,
        np.zeros((CANDIDATES, 3)),
        np.ones(CANDIDATES, dtype=np.int64),
        kinds=np.full(CANDIDATES, kind),
        stations=np.asarray(number + (kind != DEVIATION), dtype=np.int64),
        measured=measured,
    )


def _over_volume(
    identifier: Identifier,
    volumetric: Volumetric,
    volume: Mapping[str, tuple[float, float]],
    tool_lengths: Sequence[float],
    random: np.random.Generator,
) -> tuple[Array, Array]:
    """Return places all over the volume, and what each value does to the tip there."""
    places = np.zeros((300, len(LETTERS)))
    for letter in volumetric.chain:
        places[:, LETTERS.index(letter)] = random.uniform(*volume[letter], len(places))
    return places, identifier.tip_slopes(places, float(np.max(np.array(tool_lengths))))


def rows_of(plan: Plan, chain: str, kind: str) -> tuple[list[str], npt.NDArray[np.float64]]:
    """Return names and values of the columns of a plan as a table, in an order that is short to travel."""
    found = plan.readings
    letters = [letter for letter in LETTERS if letter in chain]
    names = [letter.lower() for letter in letters] + ["tool_length"]
    columns = [found.positions[:, LETTERS.index(letter)] for letter in letters] + [found.tool_lengths]
    if kind != "deviation":
        names.append("station")
        columns.append(found.stations.astype(np.float64))
    table = np.column_stack(columns)
    order = np.lexsort((*table.T[: len(letters)], found.tool_lengths, found.stations))
    return names, table[order]
