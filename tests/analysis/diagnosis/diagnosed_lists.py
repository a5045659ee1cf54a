"""Lists of a small machine, and what a workbook holds."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import openpyxl

Rows = list[dict[str, object]]


class Sheet(NamedTuple):
    header: tuple[object, ...]
    rows: Rows


def write_lists(folder: Path, *entries: str, start_up: str = "vol_comp[0].max_records 1000", **files: str) -> Path:
    """Write lists of X, Y, Z and a table C, compensated by ``vol_comp0.lis``; in keywords _ is a dot."""
    folder.mkdir(parents=True, exist_ok=True)
    lists = "\n".join(["x 1", "y 2", "z 3", "c 6", "chain CXYZ", "workpiece_axes 1", *entries])
    texts = {"hochlauf.lis": f"vol_comp[0].file_name vol_comp0.lis\n{start_up}\n", "vol_comp0.lis": lists}
    for name, text in (texts | {name.replace("_", "."): text for name, text in files.items()}).items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def sheets(path: Path) -> dict[str, Sheet]:
    with path.open("rb") as file:
        book = openpyxl.load_workbook(file)
    found = {}
    for sheet in book:
        header, *rows = sheet.iter_rows(values_only=True)
        found[sheet.title] = Sheet(header, [dict(zip(map(str, header), row, strict=True)) for row in rows])
    return found


def settings(path: Path) -> dict[str, object]:
    return {str(row["entry"]): row["value"] for row in sheets(path)["settings"].rows}
