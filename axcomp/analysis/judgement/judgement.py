"""All judgements of a machine in one object."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...kinds import tables_of
from ...lists import Finding, Findings, Reading
from ...model import Machine
from .positions import Positions
from .seam import judge_seams

if TYPE_CHECKING:
    from ...engine import Array, InputFile
    from ...measurement import Positioning
    from .coverage import Coverage
    from .dynamics import Demand, DynamicsResult
    from .limits import LargestCorrection
    from .sign import SignResult

JUDGED_LEAST = 11
"""Fewest points of a table that is judged: 7 have two neighbours on both sides, and an outlier disturbs 3 of them."""


@dataclass(frozen=True)
class Judgement:
    """What there is to say about the tables of a machine beyond their grammar.

    Attributes
    ----------
    findings : tuple of Finding
        Warnings and infos, never errors.
    signs : tuple of SignResult
        One for each measurement.
    dynamics : tuple of DynamicsResult
        One for each table; empty without feed and limits.
    coverage : tuple of Coverage
        One for each table and quantity; empty without an input file.
    limits : tuple of LargestCorrection
        One for each axis of each volumetric compensation.
    """

    findings: tuple[Finding, ...]
    signs: tuple[SignResult, ...] = ()
    dynamics: tuple[DynamicsResult, ...] = ()
    coverage: tuple[Coverage, ...] = ()
    limits: tuple[LargestCorrection, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return the figures for JSON; the findings stand with those of the reader."""
        names = ("signs", "dynamics", "coverage", "limits")
        return {name: [result.to_dict() for result in getattr(self, name)] for name in names}


def judge(
    machine: Machine,
    reading: Reading | None = None,
    *,
    measurements: Sequence[tuple[Positioning, str, str]] = (),
    demand: Demand | None = None,
    trajectory: Mapping[str, Array] | None = None,
    tool_length: float = 0.0,
) -> Judgement:
    """Judge the tables of a machine.

    Parameters
    ----------
    machine : Machine
        Whose tables.
    reading : Reading or None
        Of its lists, so that findings name file, line and column.
    measurements : sequence of (Positioning, str, str)
        Taken without the compensation, with the names of the axis that deviates and of the one that moved.
    demand : Demand or None
        Feed and limits; None: dynamics are not judged.
    trajectory : mapping of str to array or None
        As ``engine.trajectory.read_input(path).columns``; None: coverage is not judged.
    tool_length : float
        For volumetric corrections, mm.

    Raises
    ------
    ValueError
        A measurement or a trajectory does not belong to the machine.
    """
    positions, findings = Positions(reading), Findings()
    signs: list[SignResult] = []
    dynamics: list[DynamicsResult] = []
    coverage: list[Coverage] = []
    limits: list[LargestCorrection] = []
    # A small machine is judged without what the rest needs: NumPy takes longer to load than its lists to read.
    if _has_large_tables(machine):
        from .outliers import judge_outliers

        judge_outliers(machine, positions, findings)
    judge_seams(machine, positions, findings)
    if machine.volumetric:
        from .limits import judge_limits

        limits = judge_limits(machine, positions, findings, tool_length)
    if measurements:
        from .sign import judge_signs

        signs = judge_signs(machine, measurements, positions, findings)
    if demand is not None:
        from .dynamics import judge_dynamics

        dynamics = judge_dynamics(machine, demand, positions, findings)
    if trajectory is not None:
        from .coverage import judge_coverage

        coverage = judge_coverage(machine, trajectory, positions, findings)
    said = findings.all() if reading is None else reading.located(findings.all())
    return Judgement(said, tuple(signs), tuple(dynamics), tuple(coverage), tuple(limits))


@dataclass(frozen=True)
class Evidence:
    """What there is beside the lists of a machine to judge them by.

    Attributes
    ----------
    measurements : tuple of (Positioning, str, str)
        As ``judge`` takes them; only those whose table there is.
    readings : tuple of Positioning
        All measurements that could be read.
    demand : Demand or None
    input : InputFile or None
        What it moves is in the machine.
    tool_length : float
        mm.
    faults : tuple of str
        A sentence for each piece of evidence that cannot be used.
    """

    measurements: tuple[tuple[Positioning, str, str], ...] = ()
    readings: tuple[Positioning, ...] = ()
    demand: Demand | None = None
    input: InputFile | None = None
    tool_length: float = 0.0
    faults: tuple[str, ...] = ()

    def judge(self, reading: Reading) -> Judgement:
        """Judge a machine by all there is."""
        return judge(
            reading.machine,
            reading,
            measurements=self.measurements,
            demand=self.demand,
            trajectory=None if self.input is None else self.input.columns,
            tool_length=self.tool_length,
        )


def _has_large_tables(machine: Machine) -> bool:
    """Tell whether a table has enough values along a side to judge one of them by the others."""
    for tables in tables_of(machine):
        sides = [curve.x for curve in tables.curves] + [side for grid in tables.grids for side in (grid.x, grid.y)]
        if any(len(side) >= JUDGED_LEAST for side in sides):
            return True
    return False
