"""What the two kinds of volumetric parameter file have in common: blocks of parameters over the same arguments."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from ..model import ERRORS, LENGTH_MAX, LETTERS, PARAMETERS, is_angle, largest
from .findings import Findings

ELISIONS = frozenset(("...", "…", ":"))
"""What the manuals write where their examples leave something out."""


@dataclass
class ParameterBlock:
    """Records of some parameters over the same arguments, as they stand in one place of a file.

    Attributes
    ----------
    file : str
    line : int
        Where the parameters are named.
    arguments, names : tuple of str
        Letters of the axes and names of the parameters, in the order of the columns.
    rows : list of list of float
        Values of the arguments, then of the parameters.
    lines : list of int
        Where each row stands; empty for a block that has not been read.
    """

    file: str
    line: int
    arguments: tuple[str, ...]
    names: tuple[str, ...]
    rows: list[list[float]] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)

    def take(self, rows: Sequence[list[float]], line: int) -> None:
        """Add records that stand in lines from ``line`` on."""
        self.rows += rows
        self.lines += range(line, line + len(rows))


def regular_rows(lines: Sequence[str], at: int, width: int) -> list[list[float]]:
    """Return the records of the lines from ``at`` on that hold ``width`` plain numbers and nothing else.

    What is in any way special ends them: ``numbers`` and its callers know what to make of it.
    """
    rows: list[list[float]] = []
    for i in range(at, len(lines)):
        try:
            row = list(map(float, lines[i].split()))
        except ValueError:
            break
        # Python takes digits grouped by _, and names of infinity, for numbers.
        if len(row) != width or "_" in lines[i] or not all(map(math.isfinite, row)):
            break
        rows.append(row)
    return rows


def check_name(name: str, file: str, line: int, findings: Findings) -> bool:
    """Tell whether a parameter exists, with finding 70468 if not."""
    if name in PARAMETERS:
        return True
    message = f"{name} is neither a parameter nor an axis; the compensation stays off."
    findings.add("70468", file, line, name, message, group="")
    return False


def numbers(cells: list[str], file: str, line: int, parameter: str, findings: Findings) -> list[float] | None:
    """Return the numbers of a record, which may have decimal commas; None, with a finding, if a cell is none."""
    try:
        row = [float(cell if "." in cell else cell.replace(",", ".", 1)) for cell in cells]
    except ValueError:
        row = [math.nan]
    # Python takes digits grouped by _ and names of infinity for numbers; a parameter file does not.
    if all(map(math.isfinite, row)) and not any("_" in cell for cell in cells):
        return row
    message = f"{' '.join(cells)!r} should be numbers only; the compensation stays off."
    findings.add("AXC-RECORD", file, line, parameter, message, group="")
    return None


def note_elision(mark: str, file: str, line: int, findings: Findings) -> None:
    """Note that something was left out of a file, as the manuals do in their examples."""
    findings.add("AXC-ELISION", file, line, "", f"{mark!r} stands for something left out; it is not taken.")


def check_values(block: ParameterBlock, findings: Findings) -> None:
    """Find values no machine has: angles in degrees, lengths in µm, slips of the keyboard."""
    for column, label in enumerate(block.arguments + block.names):
        bound = LENGTH_MAX if label in LETTERS else largest(label)
        beyond = next((i for i, row in enumerate(block.rows) if abs(row[column]) > bound), None)
        if beyond is not None:
            value = block.rows[beyond][column]
            unit = "mm" if bound == LENGTH_MAX else "rad"
            message = f"{label} = {value:g} is beyond ±{bound:g} {unit}; the compensation stays off."
            findings.add("AXC-MAGNITUDE", block.file, block.lines[beyond], label, message)
        elif label in ERRORS:
            plain, unit, other = (0.1, "rad", "°") if is_angle(label) else (10.0, "mm", "µm")
            large = next((i for i, row in enumerate(block.rows) if abs(row[column]) > plain), None)
            if large is not None:
                value = block.rows[large][column]
                message = f"{label} = {value:g} {unit} is no error of a machine: it may be in {other}."
                findings.add("AXC-LARGE", block.file, block.lines[large], label, message)
