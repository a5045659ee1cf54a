"""A dated protocol of a machine: who measured what on which machine with which lists, for a customer's signature."""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from datetime import date
from html import escape
from pathlib import Path
from typing import Any

from .. import __version__
from ..lists import Reading, Severity
from ..measurement import SYMBOLS, BeforeAfter, Iso230Result
from ..model import symbol
from ..plot import Records, document, figure as number, html_table, new_figure, picture, remarks

PROGRAM = "axcomp"
_CHECKSUM = "SHA-256"
_PRINT = """<style>
@page { size: A4; margin: 16mm 14mm; }
@media print {
  body { font-size: 9.5pt; max-width: none; margin: 0; padding: 0; } h1 { font-size: 15pt; margin: 0 0 4mm; }
  h2 { font-size: 12pt; margin: 6mm 0 2mm; padding-top: 2mm; break-after: avoid; }
  h3 { font-size: 10.5pt; break-after: avoid; }
  table { font-size: 8.5pt; break-inside: avoid; }
  th, td { padding: 0.6mm 2mm; } tr, img, .sign { break-inside: avoid; }
  thead { display: table-header-group; } .wide { overflow: visible; } img { max-height: 210mm; object-fit: contain; }
}
.fields td:first-child { color: #4b5560; } .sum { font-family: ui-monospace, monospace; word-break: break-all; }
.sign { display: flex; gap: 3rem; margin-top: 4rem; }
.sign div { flex: 1; border-top: 1px solid #1d2327; padding-top: 0.2rem; }
</style>"""


def _field(meaning: str) -> Any:
    return field(default="", metadata={"meaning": meaning})


@dataclass(frozen=True)
class ProtocolFields:
    """What a protocol says besides figures; what is empty is left to be filled in by hand."""

    machine: str = _field("name or type of the machine")
    serial: str = _field("its serial number")
    axis: str = _field("the axis or axes measured")
    instrument: str = _field("instrument, with serial number and calibration")
    temperature: str = _field("of machine and air, with unit")
    operator: str = _field("who measured")
    program: str = _field("what evaluated the measurements")
    version: str = _field("its version")
    date: str = _field("of the protocol")
    place: str = _field("where it was measured")
    remarks: str = _field("whatever else is to be said")

    @classmethod
    def read(cls, path: Path, given: Mapping[str, str]) -> ProtocolFields:
        """Return the fields of a TOML file, those given in place of its; ValueError if it is not understood."""
        try:
            found = tomllib.loads(path.read_text(encoding="utf-8"))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise ValueError(f"{path}: {error}") from None
        except OSError as error:
            raise ValueError(f"{path}: The file cannot be read: {error.strerror or error}.") from None
        table = found.get("protocol", found)
        known = [one.name for one in fields(cls)]
        for name, value in table.items():
            if name not in known:
                raise ValueError(f"{path}: “{name}” is no field of a protocol; {', '.join(known)} are.")
            if isinstance(value, dict | list):
                raise ValueError(f"{path}: {name} is no single value.")
        return cls(**{**{name: str(value) for name, value in table.items()}, **given})

    def completed(self, reading: Reading, evaluations: Sequence[Iso230Result]) -> ProtocolFields:
        """Return the fields with those that the files and the program know."""
        details: dict[str, str] = {}
        for result in evaluations:
            for name, value in result.readings.details.items():
                details.setdefault(name, value)
        path = reading.path.resolve()
        folder = path if path.is_dir() else path.parent
        known = {
            "machine": details.get("machine", "") or folder.name,
            "serial": details.get("serial no", "") or details.get("serial", ""),
            "axis": ", ".join(dict.fromkeys(result.axis for result in evaluations if result.axis)),
            "instrument": details.get("instrument", ""),
            "temperature": details.get("temperature", ""),
            "operator": details.get("by", "") or details.get("operator", ""),
            "place": details.get("location", ""),
            "program": PROGRAM,
            "version": __version__,
            "date": date.today().isoformat(),
        }
        return replace(self, **{name: value for name, value in known.items() if not getattr(self, name)})


@dataclass(frozen=True, eq=False)
class Protocol:
    """A protocol; evaluations of the same axis one after the other are before and after.

    Attributes
    ----------
    fields : ProtocolFields
    reading : Reading
        Of the machine's lists.
    evaluations : tuple of Iso230Result
    checksums : mapping of str to str
        SHA-256 of each list and measurement, by its name.
    notes : tuple of str
        What could not be done.
    """

    fields: ProtocolFields
    reading: Reading
    evaluations: tuple[Iso230Result, ...] = ()
    checksums: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def compared(self) -> list[BeforeAfter]:
        """Return the pairs of the same axis, before and after."""
        found = []
        for axis in dict.fromkeys(one.axis for one in self.evaluations):
            mine = [one for one in self.evaluations if one.axis == axis]
            found += [BeforeAfter(mine[0], last) for last in mine[1:2] if mine[0].unit == last.unit]
        return found

    def html(self) -> str:
        """Return it as one HTML page that needs nothing beside it and prints to A4."""
        chapters = [
            ("", _fields(self.fields)),
            ("Findings in the lists", _findings(self.reading)),
            *(("Before and after", _difference(pair)) for pair in self.compared),
            *(
                (f"Positioning by ISO 230-2: {_title(one)}", _evaluation(one, self.compared))
                for one in self.evaluations
            ),
            ("Files", _checksums(self.checksums)),
        ]
        parts = (f"{f'<h2>{escape(title)}</h2>' if title else ''}\n{body}" for title, body in chapters if body)
        sign = '<div class="sign"><div>Date, operator</div><div>Date, customer</div></div>'
        title = f"Protocol: {self.fields.machine or 'machine'}"
        return document(title, "\n".join([_PRINT, remarks(self.notes), *parts, sign]))

    def to_dict(self) -> dict[str, Any]:
        """Return it for JSON."""
        return {
            "fields": {one.name: getattr(self.fields, one.name) for one in fields(self.fields)},
            "evaluations": [one.to_dict() for one in self.evaluations],
            "differences": [one.to_dict() for one in self.compared],
            "checksums": dict(self.checksums),
            "notes": list(self.notes),
        }


def make_protocol(
    reading: Reading, evaluations: Sequence[Iso230Result], given: ProtocolFields, notes: Sequence[str] = ()
) -> Protocol:
    """Return the protocol of a machine with checksums of its lists and of the measurements' files."""
    sums = {str(path): hashlib.sha256(one.data).hexdigest() for path, one in reading.documents.items()}
    for name in dict.fromkeys(file for one in evaluations for file in one.source.split(", ")):
        file = Path(name if Path(name).is_file() else name.partition("[")[0])
        if file.is_file():
            sums[str(file)] = hashlib.sha256(file.read_bytes()).hexdigest()
    return Protocol(given.completed(reading, evaluations), reading, tuple(evaluations), sums, tuple(notes))


def _fields(found: ProtocolFields) -> str:
    rows = [(one.name.capitalize(), getattr(found, one.name)) for one in fields(found)]
    body = "".join(f"<tr><td>{name}</td><td>{escape(value) or '&nbsp;' * 60}</td></tr>" for name, value in rows)
    return f'<table class="text fields"><tbody>{body}</tbody></table>'


def _findings(reading: Reading) -> str:
    counts = {severity: sum(f.severity is severity for f in reading.findings) for severity in Severity}
    said = ", ".join(f"{count} {one.value}{'' if count == 1 else 's'}" for one, count in counts.items())
    errors = [str(one.message) for one in reading.findings if one.severity is Severity.ERROR]
    return f"<p>{said}.</p>{remarks(errors)}"


def _difference(pair: BeforeAfter) -> str:
    columns = ("figure", f"before [{pair.before.unit}]", "after", "after − before", "left [%]")
    rows = [(name, *map(number, values), number(left, 0)) for name, *values, left in pair.differences()]
    names = f"<p>{escape(Path(pair.before.source).name)} → {escape(Path(pair.after.source).name)}</p>"
    table = html_table(Records(columns, rows))
    return f"{names}{table}{remarks(pair.notes())}{picture('Before and after', pair.figure())}"


def _title(result: Iso230Result) -> str:
    axis = f"axis {result.axis}, " if result.axis else ""
    return f"{axis}{Path(result.source).name}"


def _evaluation(result: Iso230Result, compared: Sequence[BeforeAfter]) -> str:
    columns: tuple[str, ...] = ("ISO 230-2:2014", f"[{result.unit}]", "U (k = 2)")
    robust = result.robust
    if robust is not None:
        columns += ("without outliers",)
    rows = []
    for name, value in result.parameters().items():
        cells = (SYMBOLS[name], number(value), number(result.uncertainty.get(name, float("nan"))))
        rows.append(cells if robust is None else (*cells, number(getattr(robust, name))))
    drawn = ""
    if not any(result in (pair.before, pair.after) for pair in compared):
        drawing = new_figure()
        result.plot(drawing.add_subplot())
        drawn = picture(_title(result), drawing)
    target = f"target [{symbol(result.position_unit)}]"
    each = {"x̄↑": result.mean_up, "x̄↓": result.mean_down, "B": result.reversal, "s↑": result.s_up, "s↓": result.s_down}
    lines = [(f"{at:g}", *(number(float(c[i])) for c in each.values())) for i, at in enumerate(result.positions)]
    body = html_table(Records(columns, rows)) + remarks(result.notes) + drawn
    return body + html_table(Records((target, *each), lines))


def _checksums(sums: Mapping[str, str]) -> str:
    rows = "".join(
        f'<tr><td>{escape(Path(name).name)}</td><td class="sum">{one}</td></tr>' for name, one in sums.items()
    )
    head = f"<thead><tr><th>file</th><th>{_CHECKSUM}</th></tr></thead>"
    return f'<table class="text">{head}<tbody>{rows}</tbody></table>' if rows else ""
