"""What a report holds: a machine, what was found and judged, measured, budgeted, and what a cycle costs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from ..analysis.budget.contributions import Budget, budget_of
from ..analysis.judgement import Evidence, Judgement
from ..bench.clock import Sample
from ..bench.engine import bench_engine
from ..lists import Finding, Reading, Severity
from ..measurement.iso230 import Iso230Result, evaluate
from ..model.machine import CYCLE_TIME, Machine
from ..plot.content import Content
from ..plot.contents import contents_of

REPEATS = 3
"""Of the measurement of what a cycle costs."""


@dataclass(frozen=True, eq=False)
class Report:
    """Everything there is to say about a machine.

    Attributes
    ----------
    reading : Reading
        Of its lists.
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

    reading: Reading
    judgement: Judgement
    contents: tuple[Content, ...] = ()
    evaluations: tuple[Iso230Result, ...] = ()
    budget: Budget | None = None
    costs: tuple[Sample, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def machine(self) -> Machine:
        """As the lists describe it."""
        return self.reading.machine

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Of the reader, then of the judgement."""
        return (*self.reading.findings, *self.judgement.findings)

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
            "path": str(self.reading.path),
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
    reading: Reading, evidence: Evidence | None = None, *, cycle_time: float = CYCLE_TIME, repeats: int = REPEATS
) -> Report:
    """Judge, evaluate and measure.

    Parameters
    ----------
    reading : Reading
        Of the machine.
    evidence : Evidence or None
        Measurements are evaluated, an input file has coverage and budget; None: there is none.
    cycle_time : float
        Of the position controller, s.
    repeats : int
        Of the measurement of costs; 0: they are not in the report.

    Raises
    ------
    ValueError
        A measurement or an input file does not belong to the machine.
    """
    machine, given = reading.machine, evidence or Evidence()
    judgement = given.judge(reading)
    notes = list(given.faults)
    budget = None
    if given.input is not None:
        try:
            budget = budget_of(machine, given.input, cycle_time=cycle_time, tool_length=given.tool_length or None)
        except (KeyError, ValueError) as error:
            notes.append(f"There is no budget: {error.args[0] if error.args else error}.")
    return Report(
        reading,
        judgement,
        tuple(contents_of(machine, tool_length=given.tool_length)),
        tuple(evaluate(measured) for measured in given.readings),
        budget,
        # No goal is set for a machine at large.
        tuple(bench_engine(machine, "this machine", repeats, math.inf)) if repeats > 0 and machine.axes else (),
        tuple(notes),
    )
