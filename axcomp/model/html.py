"""What notebooks show of an object: tables as HTML."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape


def as_html(header: Sequence[str], rows: Iterable[Sequence[str]], kind: str = "", caption: str = "") -> str:
    """Return a table that scrolls where it is too wide; ``kind``: its class, ``text`` or none."""
    head = "".join(f"<th>{escape(column)}</th>" for column in header)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    classed = f' class="{kind}"' if kind else ""
    said = f"<caption>{escape(caption)}</caption>" if caption else ""
    table = f"<table{classed}>{said}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
    return f'<div class="wide" style="overflow-x: auto">{table}</div>'
