"""The report as one HTML page without script that needs nothing beside it."""

from __future__ import annotations

from collections.abc import Callable
from html import escape
from pathlib import Path
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..analysis.budget.picture import budget_figure
from ..analysis.judgement.dynamics import rate
from ..measurement.iso230 import SYMBOLS, Iso230Result
from ..model.machine import AxisType
from ..model.quantity import symbol
from ..plot.content import Records
from ..plot.page import document, overview, picture, section, table
from ..plot.style import new_figure, printed
from ..plot.terminal import figure as number
from .report import Report

CONTRIBUTIONS_SHOWN = 12
"""Of each axis in the table of the budget."""


class Chapter(NamedTuple):
    """A part of the page: the anchor of its heading, the heading, and its HTML."""

    anchor: str
    title: str
    body: str


def report_page(report: Report) -> str:
    """Return the page."""
    chapters = [chapter for make in _CHAPTERS if (chapter := make(report)) is not None]
    links = "".join(f'<li><a href="#{one.anchor}">{escape(one.title)}</a></li>' for one in chapters)
    notes = "".join(f'<p class="note">{escape(note)}</p>' for note in report.notes)
    parts = "\n".join(f'<h2 id="{one.anchor}">{escape(one.title)}</h2>\n{one.body}' for one in chapters)
    body = f"<p>{_counted(report)}</p>\n{notes}\n<nav><ul>{links}</ul></nav>\n{parts}"
    return document(f"Compensations of {report.path}", body)


def _counted(report: Report) -> str:
    """Return the numbers of findings, each in the colour of its severity."""
    words = [
        f'<span class="{name if count else "info"}">{count} {name}{"" if count == 1 else "s"}</span>'
        for name, count in report.counts().items()
    ]
    compensations = sum(len(axis.compensations) for axis in report.machine.axes) + len(report.machine.volumetric)
    return f"{', '.join(words)}; {len(report.machine.axes)} axes with {compensations} compensations in force."


def _machine(report: Report) -> Chapter:
    rows: list[tuple[str | float, ...]] = []
    for axis in report.machine.axes:
        unit = symbol(axis.unit)
        modulo = f"{axis.modulo.start:g} … {axis.modulo.end:g} {unit}" if axis.modulo is not None else ""
        limit = f"{axis.volumetric_limit:g} mm" if axis.volumetric_limit is not None else ""
        kinds = ", ".join(one.kind for one in axis.compensations)
        rows.append((axis.name, str(axis.number), axis.type.name.lower(), modulo, limit, kinds or "none"))
    columns = ("axis", "number", "type", "modulo range", "s_limit", "compensations in force")
    body = _text(Records(columns, rows))
    if report.machine.volumetric:
        names = {axis.number: axis.name for axis in report.machine.axes}
        found: list[tuple[str | float, ...]] = []
        for one in report.machine.volumetric:
            chain = " | ".join(
                part or "–" for part in (one.chain[: one.workpiece_axes], one.chain[one.workpiece_axes :])
            )
            axes = ", ".join(f"{letter} = {names[n]}" for letter, n in one.axes)
            found.append((str(one.index), axes, chain, str(len(one.errors)), str(one.records())))
        head = ("volumetric compensation", "axes", "chain, workpiece | tool", "errors", "records")
        body += _text(Records(head, found))
    spindles = [axis.name for axis in report.machine.axes if axis.type is AxisType.SPINDLE]
    if spindles:
        body += f"<p>Spindles: {escape(', '.join(spindles))}.</p>"
    return Chapter("machine", "Machine", body)


def _findings(report: Report) -> Chapter:
    if not report.findings:
        return Chapter("findings", "Findings", "<p>Nothing was found in the lists.</p>")
    rows = "".join(
        f'<tr><td class="{one.severity.value}">{one.severity.value}</td>'
        f"<td>{escape(Path(one.file).name)}{f':{one.line}' if one.line else ''}</td>"
        f"<td>{escape(one.code)}</td><td>{escape(printed(one.message))}</td></tr>"
        for one in report.findings
    )
    head = "<tr><th>severity</th><th>place</th><th>code</th><th>finding</th></tr>"
    table_of = f'<div class="wide"><table class="text"><thead>{head}</thead><tbody>{rows}</tbody></table></div>'
    return Chapter("findings", "Findings", table_of)


def _signs(report: Report) -> Chapter | None:
    results = report.judgement.signs
    if not results:
        return None
    rows: list[tuple[str | float, ...]] = []
    for one in results:
        errors = {name: one.error(name) for name in one.evaluations}
        swapped = errors.get("directions interchanged")
        shown = [f"{errors[name]:.2f}" for name in ("without", "as written", "opposite sign")]
        unit = one.evaluations["without"].unit
        figure = f"{SYMBOLS[one.symbol]} [{unit}]"
        rows.append((one.name, figure, *shown, "" if swapped is None else f"{swapped:.2f}", one.verdict))
    columns = ("table", "figure", "without", "as written", "opposite sign", "directions interchanged", "smallest")
    pictures = "".join(_drawn(one.name, one.plot) for one in results)
    return Chapter("sign", "Sign: what the tables do to measured errors", _text(Records(columns, rows)) + pictures)


def _dynamics(report: Report) -> Chapter | None:
    results = [one for one in report.judgement.dynamics if len(one.slopes)]
    if not results:
        return None
    rows: list[tuple[str | float, ...]] = []
    for one in results:
        unit = symbol(one.axis.unit)
        velocities = (one.added_velocity, one.jump_velocity, one.reversal_velocity)
        slope, switching, reversal = (f"{rate(value)} {unit}/s" if value else "" for value in velocities)
        accelerations = (one.added_acceleration, one.smooth_acceleration)
        kink, curvature = (f"{rate(value)} {unit}/s²" if value else "" for value in accelerations)
        rows.append((one.name, f"{one.feed:g} {symbol(one.over.unit)}/s", slope, kink, curvature, switching, reversal))
    columns = ("table", "feed", "slope adds", "a kink adds", "curvature adds", "switching adds", "a reversal adds")
    moving = [one for one in results if one.feed]
    pictures = "".join(_drawn(one.name, one.plot) for one in moving)
    return Chapter("dynamics", "Dynamics: what the tables ask of the drives", _wide(Records(columns, rows)) + pictures)


def _coverage(report: Report) -> Chapter | None:
    results = report.judgement.coverage
    if not results:
        return None
    rows: list[tuple[str | float, ...]] = [
        (
            one.table,
            f"{one.quantity} [{one.unit}]",
            f"{one.held[0]:g} … {one.held[1]:g}",
            f"{one.used[0]:g} … {one.used[1]:g}",
            f"{100.0 * one.outside:.3g} %",
        )
        for one in results
    ]
    columns = ("table", "over", "points", "in use", "outside")
    return Chapter("coverage", "Coverage: what the input file uses of the tables", _text(Records(columns, rows)))


def _limits(report: Report) -> Chapter | None:
    results = report.judgement.limits
    if not results:
        return None
    rows: list[tuple[str | float, ...]] = [
        (
            one.axis.name,
            str(one.index),
            f"{one.correction:.4f} mm",
            "none" if one.share is None else f"{one.axis.volumetric_limit:g} mm",
            "" if one.share is None else f"{100.0 * one.share:.0f} %",
            ", ".join(f"{name} = {position:g}" for name, position in one.position.items()),
        )
        for one in results
    ]
    columns = ("axis", "compensation", "largest correction", "s_limit", "share", "at")
    return Chapter("limits", "Limits of the volumetric corrections", _text(Records(columns, rows)))


def _iso230(report: Report) -> Chapter | None:
    if not report.evaluations:
        return None
    return Chapter("iso230", "Positioning by ISO 230-2", "".join(map(_evaluation, report.evaluations)))


def _evaluation(result: Iso230Result) -> str:
    figures: list[tuple[str | float, ...]] = [
        (SYMBOLS[name], number(value)) for name, value in result.parameters().items()
    ]
    columns = [result.count_up, result.count_down, result.mean_up, result.mean_down, result.reversal]
    columns += [result.s_up, result.s_down, result.repeatability]
    names = ("n↑", "n↓", "x̄↑", "x̄↓", "B", "s↑", "s↓", "R")
    rows: list[tuple[str | float, ...]] = [
        (f"{position:g}", *(number(float(c[i]), 0 if n[0] == "n" else 2) for n, c in zip(names, columns, strict=True)))
        for i, position in enumerate(result.positions)
    ]
    notes = "".join(f'<p class="note">{escape(note)}</p>' for note in result.notes)
    axis = f", axis {result.axis}" if result.axis else ""
    title = f"{Path(result.source).name}{axis}"
    target = f"target [{symbol(result.position_unit)}]"
    return f"""<section><h3>{escape(title)}</h3>
{_drawn(title, result.plot, heading=False)}
{table(Records(("ISO 230-2:2014", result.unit), figures))}{notes}
<details><summary>Targets</summary>{_wide(Records((target, *names), rows))}</details></section>"""


def _budget(report: Report) -> Chapter | None:
    budget = report.budget
    if budget is None:
        return None
    rows: list[tuple[str | float, ...]] = []
    for axis, unit in budget.units.items():
        for one in budget.of_axis(axis)[:CONTRIBUTIONS_SHOWN]:
            rows.append((f"{axis}: {one.source}", f"{one.max:.3f}", f"{one.rms:.3f}", unit))
    if not rows:
        return Chapter("budget", "Budget along the input file", "<p>Nothing is corrected along it.</p>")
    body = _wide(Records(("contribution", "largest", "rms", "unit"), rows))
    return Chapter("budget", "Budget along the input file", picture("Budget", budget_figure(budget)) + body)


def _tables(report: Report) -> Chapter:
    if not report.contents:
        return Chapter("tables", "Tables", "<p>No compensation is in force.</p>")
    body = "\n".join(section(content, "h3") for content in report.contents)
    return Chapter("tables", "Tables", f'<div class="wide">{table(overview(report.contents))}</div>\n{body}')


def _cost(report: Report) -> Chapter | None:
    if not report.costs:
        return None
    rows: list[tuple[str | float, ...]] = [
        (one.name, f"{one.median:.2f} {one.unit}", f"{one.low:.2f} … {one.high:.2f}") for one in report.costs
    ]
    intro = "<p>Of the engine in Python and over whole trajectories, on the computer that made this page.</p>"
    columns = ("what", "median", "least … greatest")
    return Chapter("cost", "Cost of a cycle", intro + table(Records(columns, rows)))


_CHAPTERS: tuple[Callable[[Report], Chapter | None], ...] = (
    _machine,
    _findings,
    _signs,
    _dynamics,
    _coverage,
    _limits,
    _iso230,
    _budget,
    _tables,
    _cost,
)


def _drawn(title: str, plot: Callable[[Axes], object], *, heading: bool = True) -> str:
    """Return what a result draws of itself as an embedded picture."""
    drawing: Figure = new_figure()
    plot(drawing.add_subplot())
    name = f"{title[0].upper()}{title[1:]}" if title else title
    above = f"<h3>{escape(name)}</h3>\n" if heading else ""
    return f"<section>{above}{picture(name, drawing)}</section>"


def _text(records: Records) -> str:
    return _wide(records).replace("<table>", '<table class="text">')


def _wide(records: Records) -> str:
    return f'<div class="wide">{table(records)}</div>'
