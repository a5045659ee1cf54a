"""Contents as one HTML page that needs nothing beside it: pictures embedded, tables foldable, no script."""

from __future__ import annotations

import multiprocessing
import os
import sys
import warnings
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from html import escape

from matplotlib.figure import Figure

from .. import __version__
from ..model import as_html
from .content import Cell, Content, Records
from .interactive import script
from .style import embedded, printed

PICTURES_A_PROCESS = 16
"""With fewer pictures a process is not worth its start."""
ROWS_SHOWN = 60
"""Rows of a table in the page; all of them are in the CSV file."""

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #1d2327; max-width: 1240px; margin: 2rem auto; padding: 0 1rem;
  overflow-wrap: anywhere; }
h1 { font-size: 1.6rem; }
h2 { font-size: 1.2rem; margin-top: 2.5rem; border-top: 1px solid #d5dadd; padding-top: 1rem; }
h3 { font-size: 1.05rem; margin-top: 1.8rem; }
img { width: 100%; height: auto; max-width: 1200px; } nav { columns: 3 16rem; } nav ul { margin: 0; }
table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums; margin: 0.5rem 0; }
th, td { padding: 0.15rem 0.8rem; text-align: right; border-bottom: 1px solid #e4e8ea; }
th:first-child, td:first-child { text-align: left; } th { background: #f3f5f6; }
.text th, .text td { text-align: left; vertical-align: top; } .text td:nth-child(-n+3) { white-space: nowrap; }
summary { cursor: pointer; } .wide { overflow: auto; max-height: 32rem; overflow-wrap: normal; }
thead th { position: sticky; top: 0; }
.made { color: #4b5560; margin-top: -0.6rem; } .note { color: #6b4a00; }
.error { color: #a11212; font-weight: 600; } .warning { color: #6b4a00; font-weight: 600; } .info { color: #4b5560; }
@media print { .wide { max-height: none; } nav { display: none; } section { break-inside: avoid; } }
"""


def page(title: str, contents: Sequence[Content], notes: Sequence[str] = (), *, turning: bool = False) -> str:
    """Return a page with an overview and a section for each content; ``turning``: as in ``section``."""
    links = navigation((one.subject.name, one.subject.title) for one in contents)
    parts = (remarks(notes), links, html_table(overview(contents)), sections(contents, turning=turning))
    return document(title, "\n".join(parts), script() if turning else "")


def document(title: str, body: str, head: str = "") -> str:
    """Return a page with a heading and what stands below it, as HTML; it needs nothing beside it.

    ``head``: the script of pictures that can be turned; without it there is none.
    """
    return f"""<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,"><title>{escape(title)}</title><style>{_STYLE}</style>{head}</head>
<body>
<h1>{escape(title)}</h1>
<p class="made">{escape(made())}</p>
{body}
</body>
</html>
"""


def made(moment: datetime | None = None) -> str:
    """Return the version of axcomp and the date; SOURCE_DATE_EPOCH stands for now where it is set."""
    epoch = os.environ.get("SOURCE_DATE_EPOCH", "")
    now = moment or (datetime.fromtimestamp(int(epoch), UTC) if epoch.isdecimal() else datetime.now(UTC))
    return f"axcomp {__version__}, {now:%Y-%m-%d %H:%M} UTC"


def navigation(links: Iterable[tuple[str, str]]) -> str:
    """Return links to the parts of a page, from their anchors and titles."""
    items = "".join(f'<li><a href="#{escape(anchor)}">{escape(title)}</a></li>' for anchor, title in links)
    return f"<nav><ul>{items}</ul></nav>"


def remarks(notes: Iterable[str]) -> str:
    """Return sentences as paragraphs of their own."""
    return "".join(f'<p class="note">{escape(note)}</p>' for note in notes)


def section(content: Content, heading: str = "h2", *, turning: bool = False) -> str:
    """Return one content: heading, picture, and its numbers to unfold.

    ``turning``: where it is a body in space also one that can be turned, for a page with ``script`` in its head.
    """
    title = content.subject.title
    shown = content.extract(ROWS_SHOWN)
    return f"""<section id="{escape(content.subject.name)}"><{heading}>{escape(title)}</{heading}>
{picture(title, content.figure())}{content.interactive() if turning else ""}
<details><summary>Numbers</summary>{html_table(shown)}</details></section>"""


def sections(contents: Sequence[Content], heading: str = "h2", *, turning: bool = False) -> str:
    """Return all contents as ``section`` does; many are drawn on all processors where processes are cheap."""
    processes = min(os.cpu_count() or 1, len(contents) // PICTURES_A_PROCESS)
    if processes < 2 or sys.platform != "linux" or multiprocessing.current_process().daemon:
        return "\n".join(section(content, heading, turning=turning) for content in contents)
    with warnings.catch_warnings():
        # The threads that it warns of are those of the linear algebra, which wait.
        warnings.simplefilter("ignore", DeprecationWarning)
        with multiprocessing.get_context("fork").Pool(processes, _inherit, (contents, heading, turning)) as pool:
            return "\n".join(pool.map(_inherited, range(len(contents)), chunksize=4))


_work: tuple[Sequence[Content], str, bool] = ((), "", False)


def _inherit(contents: Sequence[Content], heading: str, turning: bool) -> None:
    """Keep in a process what it has inherited: contents cannot be sent."""
    global _work  # noqa: PLW0603
    _work = (contents, heading, turning)


def _inherited(number: int) -> str:
    contents, heading, turning = _work
    return section(contents[number], heading, turning=turning)


def picture(title: str, figure: Figure) -> str:
    """Return a figure as an embedded picture."""
    return f'<img alt="{escape(title)}" loading="lazy" src="{embedded(figure)}">'


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
