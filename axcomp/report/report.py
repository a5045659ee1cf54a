"""The report of a machine: what was found and judged, measured, budgeted, and what a cycle costs, on one HTML page."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes

from ..analysis.budget import Budget, budget_figure, budget_of
from ..analysis.judgement import INTERCHANGED, REVERSED, WITHOUT, WRITTEN, Evidence, Judgement, rate, sentence
from ..bench import Sample, bench_engine
from ..lists import Finding, Reading, Severity
from ..measurement import SYMBOLS, Iso230Result, evaluate_robustly
from ..model import CYCLE_TIME, AxisType, Machine, symbol
from ..plot import (
    Content,
    Records,
    contents_of,
    document,
    figure as number,
    html_table,
    made,
    navigation,
    new_figure,
    overview,
    picture,
    printed,
    remarks,
    script,
    sections,
)

CONTRIBUTIONS_SHOWN = 12
"""Of each axis in the table of the budget."""
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
    turning : bool
        The page has pictures that can be turned: bodies in space, by Plotly's script.
    """

    reading: Reading
    judgement: Judgement
    contents: tuple[Content, ...] = ()
    evaluations: tuple[Iso230Result, ...] = ()
    budget: Budget | None = None
    costs: tuple[Sample, ...] = ()
    notes: tuple[str, ...] = ()
    turning: bool = False

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
        """Return it as one HTML page that needs nothing beside it; NoPlotlyError without Plotly if it needs that."""
        return _page(self)

    def to_dict(self) -> dict[str, Any]:
        """Return all figures for JSON."""
        return {
            "machine": self.reading.name,
            "path": str(self.reading.path),
            "made": made(),
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

    Measurements of the evidence are evaluated; an input file has coverage and budget, for a position controller's
    ``cycle_time`` in s. ``repeats``: of the measurement of costs; 0: they are not in the report.

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
        tuple(evaluate_robustly(measured) for measured in given.readings),
        budget,
        # No goal is set for a machine at large.
        tuple(bench_engine(machine, "this machine", repeats, math.inf)) if repeats > 0 and machine.axes else (),
        tuple(notes),
    )


def _page(report: Report) -> str:
    """Return the page: the chapters that have something to say."""
    chapters = [(anchor, title, body) for anchor, title, make in _CHAPTERS if (body := make(report))]
    links = navigation((anchor, title) for anchor, title, _ in chapters)
    parts = "\n".join(f'<h2 id="{anchor}">{escape(title)}</h2>\n{body}' for anchor, title, body in chapters)
    intro = f"<p>{_counted(report)} Read from {escape(str(report.reading.path))}.</p>"
    body = f"{intro}\n{remarks(report.notes)}\n{links}\n{parts}"
    return document(f"Compensations of {report.reading.name}", body, script() if report.turning else "")


def _counted(report: Report) -> str:
    """Return the numbers of findings, each in the colour of its severity."""
    words = [
        f'<span class="{name if count else "info"}">{count} {name}{"" if count == 1 else "s"}</span>'
        for name, count in report.counts().items()
    ]
    compensations = sum(len(axis.compensations) for axis in report.machine.axes) + len(report.machine.volumetric)
    return f"{', '.join(words)}; {len(report.machine.axes)} axes with {compensations} compensations in force."


def _machine(report: Report) -> str:
    machine = report.machine
    rows = []
    for axis in machine.axes:
        modulo = f"{axis.modulo.start:g} … {axis.modulo.end:g} {symbol(axis.unit)}" if axis.modulo is not None else ""
        limit = f"{axis.volumetric_limit:g} mm" if axis.volumetric_limit is not None else ""
        kinds = ", ".join(one.kind for one in axis.compensations)
        rows.append((axis.name, str(axis.number), axis.type.name.lower(), modulo, limit, kinds or "none"))
    body = _text(("axis", "number", "type", "modulo range", "s_limit", "compensations in force"), rows)
    found = []
    for one in machine.volumetric:
        sides = (one.chain[: one.workpiece_axes], one.chain[one.workpiece_axes :])
        axes = ", ".join(f"{letter} = {machine.numbered(n).name}" for letter, n in one.axes)
        counts = (str(len(one.errors)), str(one.records()))
        found.append((str(one.index), axes, " | ".join(side or "–" for side in sides), *counts))
    if found:
        body += _text(("volumetric compensation", "axes", "chain, workpiece | tool", "errors", "records"), found)
    spindles = [axis.name for axis in machine.axes if axis.type is AxisType.SPINDLE]
    return body + (f"<p>Spindles: {escape(', '.join(spindles))}.</p>" if spindles else "")


def _findings(report: Report) -> str:
    if not report.findings:
        return "<p>Nothing was found in the lists.</p>"
    rows = "".join(
        f'<tr><td class="{one.severity.value}">{one.severity.value}</td>'
        f"<td>{escape(Path(one.file).name)}{f':{one.line}' if one.line else ''}</td>"
        f"<td>{escape(one.code)}</td><td>{escape(printed(one.message))}</td></tr>"
        for one in report.findings
    )
    head = "<tr><th>severity</th><th>place</th><th>code</th><th>finding</th></tr>"
    return f'<div class="wide"><table class="text"><thead>{head}</thead><tbody>{rows}</tbody></table></div>'


def _signs(report: Report) -> str:
    results = report.judgement.signs
    rows = []
    for one in results:
        figure = f"{SYMBOLS[one.symbol]} [{one.evaluations[WITHOUT].unit}]"
        readings = (WITHOUT, WRITTEN, REVERSED, INTERCHANGED)
        errors = (f"{one.error(name):.2f}" if name in one.evaluations else "" for name in readings)
        rows.append((one.name, figure, *errors, one.verdict))
    columns = ("table", "figure", WITHOUT, WRITTEN, REVERSED, INTERCHANGED, "smallest")
    return _text(columns, rows) + "".join(_drawn(one.name, one.plot) for one in results)


def _dynamics(report: Report) -> str:
    results = [one for one in report.judgement.dynamics if len(one.slopes)]
    rows = []
    for one in results:
        unit = symbol(one.axis.unit)
        slope, switching, reversal, kink, curvature = (
            f"{rate(value)} {unit}/{per}" if value else ""
            for value, per in (
                (one.added_velocity, "s"),
                (one.jump.velocity, "s"),
                (one.reversal.velocity, "s"),
                (one.added_acceleration, "s²"),
                (one.smooth_acceleration, "s²"),
            )
        )
        rows.append((one.name, f"{one.feed:g} {symbol(one.over.unit)}/s", slope, kink, curvature, switching, reversal))
    columns = ("table", "feed", "slope adds", "a kink adds", "curvature adds", "switching adds", "a reversal adds")
    pictures = "".join(_drawn(one.name, one.plot) for one in results if one.feed)
    return html_table(Records(columns, rows)) + pictures if rows else ""


def _coverage(report: Report) -> str:
    rows = [
        (
            one.table,
            f"{one.quantity} [{one.unit}]",
            f"{one.held[0]:g} … {one.held[1]:g}",
            f"{one.used[0]:g} … {one.used[1]:g}",
            f"{100.0 * one.outside:.3g} %",
        )
        for one in report.judgement.coverage
    ]
    return _text(("table", "over", "points", "in use", "outside"), rows)


def _limits(report: Report) -> str:
    rows = [
        (
            one.axis.name,
            str(one.index),
            f"{one.correction:.4f} mm",
            "none" if one.share is None else f"{one.axis.volumetric_limit:g} mm",
            "" if one.share is None else f"{100.0 * one.share:.0f} %",
            ", ".join(f"{name} = {position:g}" for name, position in one.position.items()),
        )
        for one in report.judgement.limits
    ]
    return _text(("axis", "compensation", "largest correction", "s_limit", "share", "at"), rows)


def _iso230(report: Report) -> str:
    return "".join(map(_evaluation, report.evaluations))


def _evaluation(result: Iso230Result) -> str:
    figures = [(SYMBOLS[name], number(value)) for name, value in result.parameters().items()]
    columns = {"n↑": result.count_up, "n↓": result.count_down, "x̄↑": result.mean_up, "x̄↓": result.mean_down}
    columns |= {"B": result.reversal, "s↑": result.s_up, "s↓": result.s_down, "R": result.repeatability}
    rows = [
        (f"{position:g}", *(number(float(c[i]), 0 if name[0] == "n" else 2) for name, c in columns.items()))
        for i, position in enumerate(result.positions)
    ]
    axis = f", axis {result.axis}" if result.axis else ""
    title = f"{Path(result.source).name}{axis}"
    target = f"target [{symbol(result.position_unit)}]"
    return f"""<section><h3>{escape(title)}</h3>
{_drawn(title, result.plot, heading=False)}
{html_table(Records(("ISO 230-2:2014", result.unit), figures))}{remarks(result.notes)}
<details><summary>Targets</summary>{html_table(Records((target, *columns), rows))}</details></section>"""


def _budget(report: Report) -> str:
    budget = report.budget
    if budget is None:
        return ""
    rows = [
        (f"{axis}: {one.source}", f"{one.max:.3f}", f"{one.rms:.3f}", unit)
        for axis, unit in budget.units.items()
        for one in budget.of_axis(axis)[:CONTRIBUTIONS_SHOWN]
    ]
    if not rows:
        return "<p>Nothing is corrected along it.</p>"
    return picture("Budget", budget_figure(budget)) + html_table(
        Records(("contribution", "largest", "rms", "unit"), rows)
    )


def _tables(report: Report) -> str:
    if not report.contents:
        return "<p>No compensation is in force.</p>"
    return f"{html_table(overview(report.contents))}\n{sections(report.contents, 'h3', turning=report.turning)}"


def _cost(report: Report) -> str:
    if not report.costs:
        return ""
    rows = [(one.name, f"{one.median:.2f} {one.unit}", f"{one.low:.2f} … {one.high:.2f}") for one in report.costs]
    intro = "<p>Of the engine in Python and over whole trajectories, on the computer that made this page.</p>"
    return intro + html_table(Records(("what", "median", "least … greatest"), rows))


_CHAPTERS: tuple[tuple[str, str, Callable[[Report], str]], ...] = (
    ("machine", "Machine", _machine),
    ("findings", "Findings", _findings),
    ("sign", "Sign: what the tables do to measured errors", _signs),
    ("dynamics", "Dynamics: what the tables ask of the drives", _dynamics),
    ("coverage", "Coverage: what the input file uses of the tables", _coverage),
    ("limits", "Limits of the volumetric corrections", _limits),
    ("iso230", "Positioning by ISO 230-2", _iso230),
    ("budget", "Budget along the input file", _budget),
    ("tables", "Tables", _tables),
    ("cost", "Cost of a cycle", _cost),
)
"""Anchor, heading, and what makes the HTML of each part; "" leaves it out."""


def _drawn(title: str, plot: Callable[[Axes], object], *, heading: bool = True) -> str:
    """Return what a result draws of itself as an embedded picture."""
    drawing = new_figure()
    plot(drawing.add_subplot())
    name = sentence(title)
    above = f"<h3>{escape(name)}</h3>\n" if heading else ""
    return f"<section>{above}{picture(name, drawing)}</section>"


def _text(columns: tuple[str, ...], rows: Sequence[Sequence[str]]) -> str:
    """Return a table of words, "" without rows."""
    return html_table(Records(columns, rows), "text") if rows else ""
