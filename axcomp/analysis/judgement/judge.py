"""All judgements of a machine in one object."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ...engine.motion import Array
from ...lists import Finding, Reading
from ...lists.findings import Findings
from ...measurement.positioning import Positioning
from ...model.machine import Machine
from .coverage import Coverage, judge_coverage
from .dynamics import Demand, DynamicsResult, judge_dynamics
from .limits import LargestCorrection, judge_limits
from .outliers import judge_outliers
from .positions import Positions
from .seam import judge_seams
from .sign import SignResult, judge_signs


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
        As ``sweep.trajectory.read_input(path).columns``; None: coverage is not judged.
    tool_length : float
        For volumetric corrections, mm.

    Raises
    ------
    ValueError
        A measurement or a trajectory does not belong to the machine.
    """
    positions, findings = Positions(reading), Findings()
    judge_outliers(machine, positions, findings)
    judge_seams(machine, positions, findings)
    limits = judge_limits(machine, positions, findings, tool_length)
    signs = judge_signs(machine, measurements, positions, findings)
    dynamics = [] if demand is None else judge_dynamics(machine, demand, positions, findings)
    coverage = [] if trajectory is None else judge_coverage(machine, trajectory, positions, findings)
    said = findings.all() if reading is None else reading.located(findings.all())
    return Judgement(said, tuple(signs), tuple(dynamics), tuple(coverage), tuple(limits))
