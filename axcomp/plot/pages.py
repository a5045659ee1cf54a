"""Contents as one HTML page that needs nothing beside it: pictures embedded, tables foldable, no script."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Sequence
from html import escape

from matplotlib.figure import Figure

from ..model import as_html
from .content import Cell, Content, Records
from .style import png, printed

ROWS_SHOWN = 60
"""Rows of a table in the page; all of them are in the CSV file."""

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #1d2327; max-width: 1240px; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; }
h2 { font-size: 1.2rem; margin-top: 2.5rem; border-top: 1px solid #d5dadd; padding-top: 1rem; }
h3 { font-size: 1.05rem; margin-top: 1.8rem; }
img { width: 100%; height: auto; max-width: 1200px; } nav { columns: 3 16rem; } nav ul { margin: 0; }
table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums; margin: 0.5rem 0; }
th, td { padding: 0.15rem 0.8rem; text-align: right; border-bottom: 1px solid #e4e8ea; }
th:first-child, td:first-child { text-align: left; } th { background: #f3f5f6; }
.text th, .text td { text-align: left; vertical-align: top; } .text td:nth-child(-n+3) { white-space: nowrap; }
summary { cursor: pointer; } .wide { overflow-x: auto; } .note { color: #6b4a00; }
.error { color: #a11212; font-weight: 600; } .warning { color: #6b4a00; font-weight: 600; } .info { color: #4b5560; }
@media print { nav { display: none; } section { break-inside: avoid; } }
"""


def page(title: str, contents: Sequence[Content], notes: Sequence[str] = ()) -> str:
    """Return a page with an overview and a section for each content."""
    sections = "\n".join(section(content) for content in contents)
    links = [(one.subject.name, one.subject.title) for one in contents]
    return document(title, f"{remarks(notes)}\n{navigation(links)}\n{html_table(overview(contents))}\n{sections}")


def document(title: str, body: str) -> str:
    """Return a page with a heading and what stands below it, as HTML; it needs nothing beside it and no script."""
    return f"""<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,"><title>{escape(title)}</title><style>{_STYLE}</style></head>
<body>
<h1>{escape(title)}</h1>
{body}
</body>
</html>
"""


def navigation(links: Iterable[tuple[str, str]]) -> str:
    """Return links to the parts of a page, from their anchors and titles."""
    items = "".join(f'<li><a href="#{escape(anchor)}">{escape(title)}</a></li>' for anchor, title in links)
    return f"<nav><ul>{items}</ul></nav>"


def remarks(notes: Iterable[str]) -> str:
    """Return sentences as paragraphs of their own."""
    return "".join(f'<p class="note">{escape(note)}</p>' for note in notes)


def section(content: Content, heading: str = "h2") -> str:
    """Return one content: heading, picture, and its numbers to unfold."""
    title = content.subject.title
    shown = content.extract(ROWS_SHOWN)
    return f"""<section id="{escape(content.subject.name)}"><{heading}>{escape(title)}</{heading}>
{picture(title, content.figure())}
<details><summary>Numbers</summary>{html_table(shown)}</details></section>"""


def picture(title: str, figure: Figure) -> str:
    """Return a figure as an embedded picture."""
    data = b64encode(png(figure)).decode()
    return f'<img alt="{escape(title)}" src="data:image/png;base64,{data}">'


def overview(contents: Sequence[Content]) -> Records:
    """Return a row for each content: what it is, how many points, which range, which values."""
    rows = [(content.subject.title, *content.summary()) for content in contents]
    return Records(("compensation", "points", "range", "values"), rows)


def html_table(records: Records, kind: str = "") -> str:
    """Return numbers as an HTML table that scrolls where it is too wide; ``kind``: its class, ``text`` or none."""
    return as_html(records.columns, ([shown(cell) for cell in row] for row in records.rows), kind)


def shown(cell: Cell) -> str:
    """Return a cell as readers want it: five significant digits, true minus signs."""
    return printed(cell if isinstance(cell, str) else f"{cell + 0.0:.5g}")
