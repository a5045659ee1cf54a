"""What a report holds: a machine, what was found and judged, measured, budgeted, and what a cycle costs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ..analysis.budget.contributions import Budget, budget_of
from ..analysis.judgement import Demand, Judgement, judge
from ..analysis.judgement.dynamics import CYCLE_TIME
from ..bench.clock import Sample
from ..bench.engine import bench_engine
from ..engine.trajectory import InputFile
from ..lists import Finding, Reading, Severity
from ..measurement.iso230 import Iso230Result, evaluate
from ..measurement.positioning import Positioning
from ..model.machine import Machine
from ..plot.content import Content
from ..plot.contents import contents_of
from ..plot.volume import volumetric_contents

REPEATS = 3
"""Of the measurement of what a cycle costs."""


@dataclass(frozen=True, eq=False)
class Report:
    """Everything there is to say about a machine.

    Attributes
    ----------
    path : str
        Of its lists.
    machine : Machine
        As they describe it.
    findings : tuple of Finding
        Of the reader, then of the judgement.
    judgement : Judgement
        With the figures behind its findings.
    contents : tuple of Content
        A picture and its numbers for each table.
    evaluations : tuple of Iso230Result
        One for each measurement.
    budget : Budget or None
        Along the input file.
    costs : tuple of Sample
        What a cycle costs on this computer.
    notes : tuple of str
        What could not be done, a sentence each.
    """

    path: str
    machine: Machine
    findings: tuple[Finding, ...]
    judgement: Judgement
    contents: tuple[Content, ...] = ()
    evaluations: tuple[Iso230Result, ...] = ()
    budget: Budget | None = None
    costs: tuple[Sample, ...] = ()
    notes: tuple[str, ...] = ()

    def counts(self) -> dict[str, int]:
        """Return the number of findings by severity."""
        return {severity.value: sum(f.severity is severity for f in self.findings) for severity in Severity}

    def html(self) -> str:
        """Return the page."""
        from .page import report_page

        return report_page(self)

    def to_dict(self) -> dict[str, Any]:
        """Return all figures for JSON."""
        return {
            "path": self.path,
            "counts": self.counts(),
            "findings": [
                {"severity": f.severity.value, "file": f.file, "line": f.line, "code": f.code, "message": f.message}
                for f in self.findings
            ],
            "tables": [content.subject.name for content in self.contents],
            "judgement": self.judgement.to_dict(),
            "iso230": [result.to_dict() for result in self.evaluations],
            "budget": None if self.budget is None else self.budget.to_dict(),
            "cost": [
                {"what": cost.name, "unit": cost.unit, "median": cost.median, "low": cost.low, "high": cost.high}
                for cost in self.costs
            ],
            "notes": list(self.notes),
        }


def make_report(
    reading: Reading,
    *,
    readings: Sequence[Positioning] = (),
    measurements: Sequence[tuple[Positioning, str, str]] = (),
    demand: Demand | None = None,
    given: InputFile | None = None,
    tool_length: float = 0.0,
    cycle_time: float = CYCLE_TIME,
    repeats: int = REPEATS,
    notes: Sequence[str] = (),
) -> Report:
    """Judge, evaluate and measure.

    Parameters
    ----------
    reading : Reading
        Of the machine.
    readings : sequence of Positioning
        To be evaluated by ISO 230-2.
    measurements : sequence of (Positioning, str, str)
        Those that tables are judged by, as ``judge`` takes them.
    demand, tool_length
        As ``judge`` takes them.
    given : InputFile or None
        For coverage and budget; None: neither is in the report.
    cycle_time : float
        Of the position controller, s.
    repeats : int
        Of the measurement of costs; 0: they are not in the report.
    notes : sequence of str
        What could not be done so far.

    Raises
    ------
    ValueError
        A measurement or an input file does not belong to the machine.
    """
    machine = reading.machine
    judgement = judge(
        machine,
        reading,
        measurements=measurements,
        demand=demand,
        trajectory=None if given is None else given.columns,
        tool_length=tool_length,
    )
    said = list(notes)
    budget = None
    if given is not None:
        try:
            budget = budget_of(machine, given, cycle_time=cycle_time, tool_length=tool_length or None)
        except (KeyError, ValueError) as error:
            said.append(f"There is no budget: {error.args[0] if error.args else error}.")
    return Report(
        str(reading.path),
        machine,
        (*reading.findings, *judgement.findings),
        judgement,
        (*contents_of(machine), *volumetric_contents(machine, tool_length=tool_length)),
        tuple(evaluate(measured) for measured in readings),
        budget,
        # No goal is set for a machine at large.
        tuple(bench_engine(machine, "this machine", repeats, math.inf)) if repeats > 0 and machine.axes else (),
        tuple(said),
    )
