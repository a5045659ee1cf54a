"""What was read of a machine: its model, the findings, and the lists as documents."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any, Literal

from ..model import Machine, as_html, needed
from .axes import Axes
from .document import Document
from .findings import Finding
from .positions import located, outside

TypeName = Literal["translatory", "rotary", "modulo"]
"""What an axis without axis list can be taken for; ``modulo``: rotary, counting from 0° to 360°."""


@dataclass(frozen=True, eq=False)
class Reading:
    """A machine as its lists describe it, what there was to say about them, and the lists themselves.

    Attributes
    ----------
    machine : Machine
    findings : tuple of Finding
    path : Path
        What was read.
    documents : dict of Path to Document
        Every file that was read, by the path it was named by, the start-up list first.
    start_up : Document or None
        The start-up list, where there is one.
    axes : Axes
        What the lists say about the axes besides their tables.
    axis_type : str or None
        What was said of axes without axis lists.
    inner_findings : tuple of Finding
        The same findings; lists that stand in another file are named themselves, and their own lines counted.
    allow_outside : tuple of Path
        Folders that names in the lists may lead into besides that of the machine.

    Examples
    --------
    >>> from axcomp import models, read_machine
    >>> reading = read_machine(models() / "rotary_table")
    >>> reading.machine.axes[0].kinds, reading.start_up.path.name
    (('leadscrew', 'friction'), 'hochlauf.lis')
    """

    machine: Machine
    findings: tuple[Finding, ...]
    path: Path
    documents: dict[Path, Document] = field(repr=False)
    start_up: Document | None = field(repr=False)
    axes: Axes = field(repr=False)
    _axis_lists: Mapping[int, Document] = field(repr=False)
    _compensation_lists: Mapping[int, Document] = field(repr=False)
    axis_type: TypeName | None = None
    inner_findings: tuple[Finding, ...] = field(default=(), repr=False)
    allow_outside: tuple[Path, ...] = ()

    @property
    def name(self) -> str:
        """What the machine is called: by its folder, or by the list that is all there is of it."""
        path = self.path.resolve()
        if self.start_up is not None and path.is_file():
            return path.parent.name
        return path.stem if path.is_file() else path.name

    def _repr_html_(self) -> str:
        """Return machine and findings as tables, for notebooks."""
        rows = [[f"{f.file}:{f.line}", f.severity.value, f.code, f.parameter, f.message] for f in self.findings]
        findings = as_html(["place", "severity", "code", "parameter", "finding"], rows, "text") if rows else ""
        return f"{self.machine._repr_html_()}{findings or '<p>No findings.</p>'}"

    def to_frame(self) -> Any:
        """Return the findings as a pandas data frame, a row each."""
        rows = [{**asdict(one), "severity": one.severity.value} for one in self.findings]
        return needed("pandas", "frame").DataFrame(rows, columns=[one.name for one in fields(Finding)])

    def axis_list(self, number: int) -> Document | None:
        """Return the list that describes an axis, by its logical ``number``."""
        return self._axis_lists.get(number)

    def compensation_list(self, number: int) -> Document | None:
        """Return the list with the tables of an axis, by its logical ``number``."""
        return self._compensation_lists.get(number)

    def again(self) -> Reading:
        """Read the documents as they are now; those that have not been changed since are not parsed again."""
        from .reader import read_machine  # which makes readings

        return read_machine(
            self.path, documents=self.documents.values(), axis_type=self.axis_type, allow_outside=self.allow_outside
        )

    def located(self, findings: Iterable[Finding]) -> tuple[Finding, ...]:
        """Return ``findings`` about these lists with the columns of the entries they are about."""
        return outside(located(findings, self.documents), self.documents)
